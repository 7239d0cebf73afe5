// How what is shown lies while the globe that it is to lie on is made beside it.
#include <fmt/format.h>

#include <utility>

#include "app/exploration/exploration_state.h"

namespace app {

bool Exploration::liesAsAsked() const {
    const Explorer& e = explorer();
    const Open::Globe& globe = open_->globe;
    return e.map == render::Map::Flat || (globe.made.mesh && globe.stretch == e.scale);
}

// As is asked for once that is there; until then as before.
void Exploration::lay() {
    const Explorer& e = explorer();
    Open::Globe& globe = open_->globe;
    if (e.map == render::Map::Flat) {
        globe = {};
        open_->awaited = {};
        return open_->globes.forget();
    }
    wantGlobe(*open_->sorted);
    if (auto made = open_->globes.made({open_->sorted->sharedGrid(), e.scale}))
        globe = {std::move(*made), e.scale};
}

// explorer(), but for that.
const Explorer& Exploration::laid() const {
    if (liesAsAsked()) return explorer();
    const Open::Globe& globe = open_->globe;
    Explorer now = explorer();
    if (globe.made.mesh)
        now.scale = globe.stretch;
    else
        now.map = render::Map::Flat;
    if (open_->laid != now) open_->laid = std::move(now);
    return open_->laid;
}

// Whether it is begun.
bool Exploration::wantGlobe(const timeseries::SortedStep& step) {
    return explorer().map == render::Map::Globe &&
           open_->globes.want({step.sharedGrid(), explorer().scale});
}

// Whether that step, once it is shown, lies at once as what is shown does.
bool Exploration::canLie(const timeseries::SortedStep& step) const {
    return explorer().map == render::Map::Flat ||
           step.sharedGrid() == open_->sorted->sharedGrid() ||
           open_->globes.made({step.sharedGrid(), explorer().scale});
}

std::string Exploration::waitingForGlobe() const {
    if (liesAsAsked()) return "";
    const std::string& whyFlat = open_->globe.made.whyFlat;
    if (whyFlat.empty()) return "making the globe";
    return fmt::format("step {} lies flat: {}", open_->step, whyFlat);
}

}  // namespace app
