#include "app/headset/placards.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace app::headset {
namespace {

constexpr double kRayHalfWidth = 0.0015, kEdgeHalfWidth = 0.001, kLitHalfWidth = 0.002;
constexpr double kRayLength = 0.6, kHandHalf = 0.006, kMarkHalf = 0.004;
constexpr glm::vec3 kAccent(0.07f, 0.54f, 0.43f), kQuiet(0.3f, 0.33f, 0.37f),
    kMark(0.7f, 0.74f, 0.8f);

// A thin line, its flat side to the head.
Plate lineOf(const glm::dvec3& from, const glm::dvec3& to, double halfWidth, const xr::Pose& head) {
    const glm::dvec3 along = glm::normalize(to - from), middle = 0.5 * (from + to);
    glm::dvec3 across = glm::cross(along, head.position - middle);
    // Looked at along itself, a line is a point whatever way it is turned.
    if (glm::length(across) < 1e-6)
        across =
            glm::cross(along, std::abs(along.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
    const glm::dvec3 x = glm::normalize(across);
    return {{glm::quat_cast(glm::dmat3(x, along, glm::cross(x, along))), middle},
            {halfWidth, 0.5 * glm::distance(from, to)}};
}

// The hand that the readout stands near.
std::optional<xr::Pose> readoutHand(const HandInteraction& interaction,
                                    const std::array<xr::Hand, 2>& hands) {
    if (interaction.tip() && hands[interaction.tip()->hand].grip)
        return hands[interaction.tip()->hand].grip;
    return hands[1].grip ? hands[1].grip : hands[0].grip;
}

}  // namespace

std::vector<render::Placard> placardsOf(const HandInteraction& interaction,
                                        const std::array<xr::Hand, 2>& hands, const xr::Pose& head,
                                        const Boards& boards) {
    std::vector<render::Placard> placards;
    const auto put = [&](const Plate& plate,
                         const std::variant<const render::Board*, glm::vec3>& face) {
        placards.push_back({worldFromPlacard(plate, interaction.placement()), face});
    };
    if (interaction.panel() && boards.panel != nullptr) put(*interaction.panel(), boards.panel);
    for (std::size_t i = 0; i < 2; ++i) {
        const xr::Hand& hand = hands[i];
        const glm::vec3& color =
            interaction.holds(i) || interaction.holdsFace(i) ? kAccent : kQuiet;
        if (hand.grip) put(facingHead(hand.grip->position, head, glm::dvec2(kHandHalf)), color);
        if (!hand.aim || interaction.holds(i)) continue;
        const auto hit =
            interaction.panel() ? hitOf(*hand.aim, *interaction.panel()) : std::nullopt;
        const glm::dvec3 from = hand.aim->position;
        const glm::dvec3 along = hand.aim->orientation * glm::dvec3(0, 0, -1);
        put(lineOf(from, from + (hit ? hit->distance : kRayLength) * along, kRayHalfWidth, head),
            hit ? kAccent : color);
    }
    if (boards.readout != nullptr) {
        // Without hands: under the volume.
        const glm::dvec3 under =
            interaction.placement().stageFromVolume.position - glm::dvec3(0, 0.45, 0);
        const xr::Pose at = readoutHand(interaction, hands).value_or(xr::Pose{{1, 0, 0, 0}, under});
        put(readoutNear(at, head, boards.readoutHalf), boards.readout);
    }
    const auto inStage = [&](const glm::dvec3& world) {
        return glm::dvec3(xr::stageFromWorld(interaction.placement()) * glm::dvec4(world, 1));
    };
    const auto mark = [&](const glm::dvec3& world, const glm::vec3& color) {
        put(facingHead(inStage(world), head, glm::dvec2(kMarkHalf)), color);
    };
    if (boards.kept) mark(*boards.kept, kMark);
    if (interaction.tip()) mark(interaction.tip()->reading.world, kAccent);
    for (const ClipHand::Edge& edge : interaction.clipEdges())
        put(lineOf(inStage(edge.from), inStage(edge.to), edge.lit ? kLitHalfWidth : kEdgeHalfWidth,
                   head),
            edge.lit ? kAccent : kQuiet);
    return placards;
}

}  // namespace app::headset
