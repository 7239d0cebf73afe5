// What stands in the room beside the volume, as placards in the volume's world. Pure.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "app/headset/room.h"
#include "render/placard.h"

namespace app::headset {

struct RoomBoards {
    const render::Board* panel = nullptr;  // drawn where the room has one
    // Near the right hand, else the left, else below the volume.
    const render::Board* readout = nullptr;
    glm::dvec2 readoutHalf{0};  // metres
};
std::vector<render::Placard> placardsOf(const Room& room, const std::array<xr::Hand, 2>& hands,
                                        const xr::Pose& head, const RoomBoards& boards);

}  // namespace app::headset
