// What the pictures of `render` have said of their error, and how true each is drawn.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/choices/options.h"
#include "app/exploration/step_source.h"
#include "app/files/frame_files.h"
#include "app/picture/depth_error.h"

namespace app {

struct FrameError {
    std::optional<double> depth = {};
    std::string text = {};     // as it is said
    std::string whyNone = {};  // where nobody knows it
    std::filesystem::path of;  // the picture that it is of
    Rung rung;                 // and what is drawn of it
};

// Of all pictures what the one in the middle has, or the nearest to it that shows something, since
// working it out takes longer than drawing a picture; or, where that is asked for, of each its own.
class FrameErrors {
 public:
    // All but the step source must outlive it. Throws as StepSource::get() of no picture.
    FrameErrors(const RenderOptions& options, const Explorer& explorer, const FrameFiles& frames,
                StepSource& source);
    // Of a picture of this step.
    const FrameError& of(const FrameAt& frame, const timeseries::SortedStep& step);
    // Once all are drawn, on stdout. `saysNothing`: what is seen is said otherwise, and why there
    // is no error is left out.
    void tell(bool saysNothing) const;

 private:
    void tellMiddle() const;
    void tellEach(bool saysNothing) const;
    void tellRungs() const;

    const RenderOptions& options_;
    const Explorer& explorer_;
    const FrameFiles& frames_;
    std::vector<FrameError> errors_;  // of the one in the middle, or of those drawn by now
};

}  // namespace app
