// Where the outline of what is drawn stands so that a legend in the upper left corner of the
// picture covers none of it. Pure.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>

namespace app {

// In pixels from the middle of the picture, y up.
struct RoomInPicture {
    glm::dvec2 half;          // what may be used reaches so far to every side
    glm::dvec2 legendCorner;  // the legend's lower right
};

// How far the outline has to be moved at least, so that a line through the legend's corner has all
// of the legend on one side and all of the outline on the other; none where there is no room.
// REQUIRES: an outline within `half`.
std::optional<glm::dvec2> leastShift(std::span<const glm::dvec2> outline,
                                     const RoomInPicture& room);

}  // namespace app
