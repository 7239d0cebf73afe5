// What stands in the room beside the volume, as placards in the volume's world. Pure.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "app/headset/hand_interaction.h"
#include "render/annotate/placard.h"

namespace app::headset {

struct Boards {
    const render::Board* panel = nullptr;  // drawn where the room has one
    // Near the hand whose tip is in the volume, else the right hand, the left, below the volume.
    const render::Board* readout = nullptr;
    glm::dvec2 readoutHalf{0};       // metres
    std::optional<glm::dvec3> kept;  // the point kept of a probe, in the world
};
std::vector<render::Placard> placardsOf(const HandInteraction& interaction,
                                        const std::array<xr::Hand, 2>& hands, const xr::Pose& head,
                                        const Boards& boards);

}  // namespace app::headset
