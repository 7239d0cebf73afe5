#include "app/drawing/telling.h"

#include <utility>

#include "render/frame/mean_depth.h"

namespace app {

render::Legend Telling::legend(const Screen& screen, const render::Scene& scene, bool atRest) {
    Explorer e = screen.explorer;
    e.view = {};                                  // nothing is said of it
    const bool byCells = scene.cells != nullptr;  // they may come later
    const bool givenUp = screen.sorted->cellsAreGivenUp();
    if (!legend_ || of_ != e || step_.lock() != screen.sorted || byCells_ != byCells ||
        givenUp_ != givenUp) {
        if (!sameData(of_, e)) mixed_ = false;
        legend_ = makeLegend(screen.explorer, screen.variable, screen.step, scene,
                             screen.explorer.play.tick);
        of_ = std::move(e);
        step_ = screen.sorted;
        byCells_ = byCells;
        givenUp_ = givenUp;
        view_.reset();
    }
    if (atRest && view_ != screen.explorer.view) {
        mixed_ = isMixed(screen.explorer, scene);
        view_ = screen.explorer.view;
    }
    render::Legend legend = *legend_;
    if (mixed_ && render::mixesColors(scene)) legend.notes.emplace_back(kMixedColors);
    return legend;
}

bool Telling::isOf(const Screen& screen, const render::Scene& scene) const {
    return view_ == screen.explorer.view || !render::mixesColors(scene);
}

}  // namespace app
