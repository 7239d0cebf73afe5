#include "app/headset/placards.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace app::headset {
namespace {

constexpr double kRayHalfWidth = 0.0015, kRayLength = 0.6, kHandHalf = 0.006, kMarkHalf = 0.004;
constexpr glm::vec3 kAccent(0.07f, 0.54f, 0.43f), kQuiet(0.3f, 0.33f, 0.37f),
    kMark(0.7f, 0.74f, 0.8f);

// Along -z of the pose, its flat side to the head.
Plate rayOf(const xr::Pose& aim, const xr::Pose& head, double length) {
    const glm::dvec3 along = aim.orientation * glm::dvec3(0, 0, -1);
    const glm::dvec3 middle = aim.position + 0.5 * length * along;
    const glm::dvec3 across = glm::cross(along, head.position - middle);
    // Looked at along itself, a ray is a point whatever way it is turned.
    const glm::dvec3 x =
        glm::length(across) > 1e-6 ? glm::normalize(across) : aim.orientation * glm::dvec3(1, 0, 0);
    return {{glm::quat_cast(glm::dmat3(x, along, glm::cross(x, along))), middle},
            {kRayHalfWidth, 0.5 * length}};
}

// The hand that the readout stands near.
std::optional<xr::Pose> readoutHand(const Room& room, const std::array<xr::Hand, 2>& hands) {
    if (room.tip() && hands[room.tip()->hand].grip) return hands[room.tip()->hand].grip;
    return hands[1].grip ? hands[1].grip : hands[0].grip;
}

}  // namespace

std::vector<render::Placard> placardsOf(const Room& room, const std::array<xr::Hand, 2>& hands,
                                        const xr::Pose& head, const RoomBoards& boards) {
    std::vector<render::Placard> placards;
    const auto put = [&](const Plate& plate,
                         const std::variant<const render::Board*, glm::vec3>& face) {
        placards.push_back({worldFromPlacard(plate, room.placement()), face});
    };
    if (room.panel() && boards.panel != nullptr) put(*room.panel(), boards.panel);
    for (std::size_t i = 0; i < 2; ++i) {
        const xr::Hand& hand = hands[i];
        const glm::vec3& color = room.holds(i) ? kAccent : kQuiet;
        if (hand.grip) put(facingHead(hand.grip->position, head, glm::dvec2(kHandHalf)), color);
        if (!hand.aim || room.holds(i)) continue;
        const auto hit = room.panel() ? hitOf(*hand.aim, *room.panel()) : std::nullopt;
        put(rayOf(*hand.aim, head, hit ? hit->distance : kRayLength), hit ? kAccent : color);
    }
    if (boards.readout != nullptr) {
        // Without hands: under the volume.
        const glm::dvec3 under = room.placement().stageFromVolume.position - glm::dvec3(0, 0.45, 0);
        const xr::Pose at = readoutHand(room, hands).value_or(xr::Pose{{1, 0, 0, 0}, under});
        put(readoutNear(at, head, boards.readoutHalf), boards.readout);
    }
    const auto mark = [&](const glm::dvec3& world, const glm::vec3& color) {
        const glm::dvec4 place = xr::stageFromWorld(room.placement()) * glm::dvec4(world, 1);
        put(facingHead(glm::dvec3(place), head, glm::dvec2(kMarkHalf)), color);
    };
    if (boards.kept) mark(*boards.kept, kMark);
    if (room.tip()) mark(room.tip()->world, kAccent);
    return placards;
}

}  // namespace app::headset
