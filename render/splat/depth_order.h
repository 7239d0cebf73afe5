// The draw list of a frame: which splats are drawn one after another. Pure.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "render/model/scene.h"
#include "render/splat/distances.h"
#include "render/splat/splat_source.h"

namespace render {

// The keys by which points are put in order: the nearer to the eye, the larger, in equal steps over
// the sphere about the grid's box: (radius - (distance - the origin's)) perUnit, rounded.
struct DepthKeys {
    static constexpr unsigned kBits = 22;
    static constexpr double kLast = (1u << kBits) - 1;
    double radius;    // of the points about the world's origin
    double farthest;  // away from the eye, that any may be
    double perUnit;   // 0 where all are equally far away

    std::uint32_t of(double away) const {
        const double key = std::max(farthest - away, 0.0) * perUnit + 0.5;
        return static_cast<std::uint32_t>(std::min(key, kLast));
    }
};
DepthKeys depthKeysOf(const Scene& scene, const glm::dvec3& midEye);

// Made once for both eyes: distance from the point midway between them, so that turning the head
// changes nothing. Keys are the distance in 2^22 steps over the sphere about the grid's box; ties
// keep the order of value. Cells come in an order of their own, and have no list. Serves one frame
// after another, and keeps what it makes them in: pages that are new cost as much as what is done
// with them.
class DepthOrder {
 public:
    // All at once.
    DrawList operator()(const Scene& scene, const glm::dvec3& midEye);

    // In slices, for those who cannot wait. The scene must outlive them.
    void begin(const Scene& scene, const glm::dvec3& midEye);
    // Does so many splats' share of what is to be done, which passes over them three times.
    // REQUIRES: begin(), and not done.
    void goOn(std::uint64_t splats);
    bool done() const { return phase_ == Phase::Done; }
    double share() const;  // of what is to be done, [0, 1]
    DrawList take();       // REQUIRES: done
    // Gives back what is kept of a list that was larger than pictures that move have.
    void shrink();

 private:
    using Keyed = std::uint64_t;
    enum class Phase { List, Lower, Upper, Done };
    void list(std::uint64_t splats);
    void findKeys(std::span<Keyed> slice);
    void enter(Phase phase);
    template <typename Put>
    void sortBy(unsigned half, std::span<const Keyed> slice, const Put& put);

    Phase phase_ = Phase::Done;
    bool ordered_ = false;
    const Scene* scene_ = nullptr;
    std::optional<SplatSource> source_;
    std::optional<Distances> distances_;
    DepthKeys keys_{};
    std::uint64_t all_ = 0;   // splats, those clipped included
    std::size_t count_ = 0;   // that are listed
    std::size_t passed_ = 0;  // of them, in this phase
    SplatPoints points_;
    std::vector<Keyed> splats_, byLower_;
    // Where the next splat goes, of each value of the lower and of the upper half of the keys;
    // while they are listed, how many there are.
    std::array<std::vector<std::uint32_t>, 2> next_;
    Sorted list_;
};

// One frame's alone.
DrawList order(const Scene& scene, const glm::dvec3& midEye);

}  // namespace render
