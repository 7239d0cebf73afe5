// How far the picture on the screen is from the interval volume of the field between its points:
// worked out on a thread of its own, which nobody waits for, when the picture rests.
#pragma once

#include <memory>
#include <optional>

#include "app/choices/explorer.h"
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
        friend bool operator==(const Picture&, const Picture&) = default;
    };
    // Of a picture that is drawn whole, once it is known: begins to work it out, one at a time.
    // NaN where it could not be. REQUIRES: hasDepthError(*picture.sorted).
    std::optional<double> of(const Picture& picture);
    void forget();  // the picture changes: nobody wants it any more

 private:
    struct Work;
    std::shared_ptr<Work> work_;  // the one that was begun last, which its thread shares
};

}  // namespace app
