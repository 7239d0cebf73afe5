#include "app/headset/seen_error.h"

#include <utility>

#include "app/picture/error_text.h"

namespace app::headset {
namespace {

// What an error is of, at any step and from wherever it is seen.
Explorer selectionOf(Explorer e) {
    e.steps.reset();
    e.view = {};
    e.stereo = {};
    e.size = {};
    e.play = {};
    e.light = {};
    e.lamp = {};
    return e;
}

// Cells are looked for by another thread first.
bool isReady(const Screen& screen) {
    if (!hasDepthError(*screen.sorted)) return false;
    return !needsCells(screen.explorer, *screen.sorted) ||
           screen.sorted->cellsIfMade(cellsNeeded(screen.explorer, screen.sorted->type()));
}

}  // namespace

void SeenError::update(const Screen& screen, const render::View& view, Clock::time_point now,
                       Parts parts) {
    Explorer selection = selectionOf(screen.explorer);
    if (selection != selection_ || since_ == Clock::time_point()) {
        error_.forget();
        asked_.reset();
        errors_.reset();
        selection_ = std::move(selection);
        since_ = now;
        if (const auto& step = *screen.sorted; !hasDepthError(step))
            errors_.emplace().whyNone = step.whyNoCells();
    }
    const bool isKnown = errors_ && (parts == Parts::None || known_ == Parts::All);
    if (isKnown || now - since_ < kStands || !isReady(screen)) return;
    if (!asked_ || asked_->parts != parts) {
        asked_ = {screen.sorted, screen.explorer, view, parts};
        asked_->view.hidden.reset();
    }
    auto found = error_.of(*asked_);
    if (!found) return;
    errors_ = std::move(found);
    known_ = parts;
    asked_.reset();
}

std::optional<double> SeenError::of(const Explorer& explorer) const {
    if (!errors_ || selectionOf(explorer) != selection_) return std::nullopt;
    return errors_->of({modelOf(explorer)});
}

std::string SeenError::text(const Rung& drawn) const {
    if (since_ == Clock::time_point()) return "";
    const RungError* const error = errors_ ? errors_->find(drawn) : nullptr;
    if (error == nullptr) return unknownErrorText(errors_, drawn);
    const std::string depth = depthErrorText(error->depth, boundOf(*error, drawn));
    return depth.empty() ? "" : depth + lightErrorText(*error, errors_->ordering);
}

}  // namespace app::headset
