// How far the picture before the eyes is from the field between its points: worked out beside the
// frames by one thread, once of a selection that has stood for a while. A head never rests, and
// from wherever it looks the error is about the same.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "app/drawing/picture_error.h"
#include "app/drawing/screen.h"

namespace app::headset {

class SeenError {
 public:
    using Clock = std::chrono::steady_clock;
    // Of shorter ones nobody reads a figure.
    static constexpr std::chrono::milliseconds kStands{1000};

    // Once a frame: what is before the eyes, what one of them sees of it, and whether anybody looks
    // at what an error comes from.
    void update(const Screen& screen, const render::View& view, Clock::time_point now,
                Parts parts = Parts::None);
    // Of the ways to draw that selection; none while they are not known.
    const std::optional<DepthErrors>& errors() const { return errors_; }
    // Of all that this selects, drawn whole.
    std::optional<double> of(const Explorer& explorer) const;
    // Of what is drawn, as it is said: "error about 3 %", or that it is not known, or not yet; ""
    // where nothing is seen, or nothing was yet.
    std::string text(const Rung& drawn) const;

 private:
    PictureError error_;
    Explorer selection_;
    Clock::time_point since_{};  // that selection
    std::optional<PictureError::Picture> asked_;
    std::optional<DepthErrors> errors_;
    Parts known_ = Parts::None;  // of these
};

}  // namespace app::headset
