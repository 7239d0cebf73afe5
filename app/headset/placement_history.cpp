#include "app/headset/placement_history.h"

#include <cassert>

namespace app::headset {

void PlacementHistory::settle(const xr::Placement& placement) {
    if (!rests_.empty() && rests_.back() == placement) return;
    rests_.push_back(placement);
    if (rests_.size() > kSteps + 1) rests_.pop_front();
}

xr::Placement PlacementHistory::undo() {
    assert(canUndo());
    rests_.pop_back();
    return rests_.back();
}

}  // namespace app::headset
