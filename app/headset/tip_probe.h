// The point of the grid that a hand's tip is at, and its value: the probe by hand. Pure.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>

#include "app/drawing/drawn.h"
#include "app/exploration/reading.h"
#include "app/headset/point_search.h"
#include "xr/pose.h"

namespace app::headset {

// The placed point nearest to a place in axis coordinates (render/points/placed_points.h), along
// each axis by itself, so that among oblique axes it is the point whose cell holds the place. None
// outside the box of the points; a box that is flat is as thick as its cells.
std::optional<std::array<std::size_t, 3>> pointAt(const render::PlacedPoints& placed,
                                                  const glm::dvec3& place);

class TipProbe {
 public:
    // A frame looks through no more: under a millisecond.
    static constexpr std::uint64_t kPointsAFrame = std::uint64_t{1} << 22;

    enum class Value { Sought, Found, None };  // None: missing there, or not kept
    struct At {
        std::size_t hand;
        Reading reading;  // its value once that is found
        Value value;
    };

    // `tips` in the stage: of the hands that have nothing else to do. The hand that was first in
    // the box goes on, until it leaves.
    void update(const std::optional<Drawn>& drawn, const xr::Placement& placement,
                const std::array<std::optional<glm::dvec3>, 2>& tips);
    const std::optional<At>& at() const { return at_; }

 private:
    std::optional<At> at_;
    PointSearch search_;
};

// Of a tip in the stage.
bool isInBox(const Drawn& drawn, const xr::Placement& placement, const glm::dvec3& tip);
// All of it at once, however long the search; none outside the box and where there is no value.
std::optional<Reading> readingAt(const Drawn& drawn, const xr::Placement& placement,
                                 const glm::dvec3& tip);

}  // namespace app::headset
