// How far the picture on the screen is from the interval volume of the field between its points:
// worked out on a thread of its own, which nobody waits for, when the picture rests.
#pragma once

#include <memory>
#include <optional>

#include "app/picture/depth_error.h"
#include "render/points/view.h"
#include "timeseries/index/sorted_step.h"

namespace app {

// See app/picture/depth_error.h.
class PictureError {
 public:
    PictureError() = default;
    PictureError(const PictureError&) = delete;
    PictureError& operator=(const PictureError&) = delete;
    ~PictureError();
    struct Picture {
        std::shared_ptr<const timeseries::SortedStep> sorted;
        Explorer explorer;
        render::View view;
        Parts parts = Parts::None;
        friend bool operator==(const Picture&, const Picture&) = default;
    };
    // Of the ways to draw it, once they are known: begins to work them out, one picture at a time.
    // None where they could not be, and why. REQUIRES: hasDepthError(*picture.sorted).
    std::optional<DepthErrors> of(const Picture& picture);
    void forget();  // the picture changes: nobody wants it any more

 private:
    struct Work;
    std::shared_ptr<Work> work_;  // the one that was begun last, which its thread shares
};

}  // namespace app
