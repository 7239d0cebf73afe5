// The legend of what is on the screen.
#pragma once

#include <memory>
#include <optional>

#include "app/drawing/screen.h"
#include "render/annotate/legend.h"

namespace app {

// Made anew only where something that it says has changed. Whether colours are mixed is worked out
// for a picture at rest alone; a moving one says what the one before it said of the same data.
class Telling {
 public:
    render::Legend legend(const Screen& screen, const render::Scene& scene, bool atRest);
    // Whether that was worked out for this picture. REQUIRES: its legend was asked for last.
    bool isOf(const Screen& screen, const render::Scene& scene) const;

 private:
    std::optional<render::Legend> legend_;
    Explorer of_;
    std::weak_ptr<const timeseries::SortedStep> step_;
    std::optional<ViewChoice> view_;  // for which `mixed_` is known
    bool mixed_ = false, byCells_ = false, givenUp_ = false;
};

}  // namespace app
