// Where the volume stood before: what "undo move" goes back through. Pure.
#pragma once

#include <cstddef>
#include <deque>

#include "xr/pose.h"

namespace app::headset {

// Placements in which the volume came to rest: a carry that ended, a turn, a call to the user. Not
// part of the Explorer's history: where the volume stands in a room is no part of a picture.
class PlacementHistory {
 public:
    static constexpr std::size_t kSteps = 100;  // that can be undone

    // The volume rests here now; nothing where it rested here before.
    void settle(const xr::Placement& placement);
    bool canUndo() const { return rests_.size() > 1; }
    // Where the volume rested before it came to rest last. REQUIRES: canUndo().
    xr::Placement undo();

 private:
    std::deque<xr::Placement> rests_;
};

}  // namespace app::headset
