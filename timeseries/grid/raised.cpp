#include "timeseries/grid/raised.h"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <utility>
#include <vector>

#include "timeseries/grid/solid_cells.h"
#include "timeseries/together.h"

namespace timeseries {
namespace {

// Of the prisms between levels, from their lowest corner to their highest.
double highest(std::span<const SolidCells::Foot> feet, std::uint64_t places,
               std::span<const double> heights) {
    const std::uint64_t cells = feet.size() * (heights.size() / places - 1);
    const unsigned threads = threadsFor(cells, 1 << 14);
    std::vector<double> of(threads);
    together(threads, [&](unsigned k) {
        for (std::uint64_t cell = cells * k / threads; cell < cells * (k + 1) / threads; ++cell) {
            double lo = INFINITY, hi = -INFINITY;
            for (const std::uint32_t column : feet[cell % feet.size()])
                for (const std::uint64_t level : {cell / feet.size(), cell / feet.size() + 1}) {
                    const double at = heights[level * places + column];
                    lo = at < lo ? at : lo;  // not where there is none
                    hi = at > hi ? at : hi;
                }
            of[k] = std::max(of[k], hi - lo);
        }
    });
    return std::ranges::max(of);
}

}  // namespace

Mesh raised(const Mesh& prisms, std::span<const double> heights) {
    const std::uint64_t places = prisms.size()[0], levels = heights.size() / places;
    const auto pointAt = [&](std::uint64_t index) {
        glm::dvec3 at = prisms.position(index % places);
        at.z = heights[index];
        return at;
    };
    // Between a level and the next one below or above; not a number where there is none.
    const auto between = [&](std::uint64_t index, bool above) {
        const std::uint64_t level = index / places;
        if (above ? level + 1 == levels : level == 0) return std::nan("");
        return std::abs(heights[above ? index + places : index - places] - heights[index]);
    };
    const auto thickness = [&](std::uint64_t index) {
        const double below = between(index, false), above = between(index, true);
        if (std::isnan(below)) return std::isnan(above) ? 0 : above;
        return std::isnan(above) ? below : 0.5 * (below + above);
    };
    // The farthest of each coordinate, for as many points as there are would take a while.
    std::vector<glm::dvec3> corners{prisms.lo(), prisms.hi()};
    double lo = INFINITY, hi = -INFINITY;
    for (const double height : heights) {
        if (!std::isfinite(height)) continue;
        lo = std::min(lo, height);
        hi = std::max(hi, height);
    }
    corners[0].z = lo;
    corners[1].z = hi;
    const double spread = prisms.spread();
    Mesh mesh(places, levels, corners, spread, [&](std::uint64_t index) {
        const auto rows = prisms.cell(index % places).rows();
        return MeshPoint{pointAt(index),
                         {rows[0] / spread, rows[1] / spread, {0, 0, thickness(index)}}};
    });
    MeshAbout about = prisms.about();
    for (std::uint64_t* const points : {&about.apart, &about.beside})
        *points = *points / prisms.size()[2] * levels;
    mesh.setAbout(std::move(about));
    if (prisms.solids()) {
        const auto& feet = prisms.solids()->feet();
        const glm::dvec3 longest(glm::dvec2(prisms.solids()->longest()),
                                 highest(*feet, places, heights));
        mesh.setSolids(SolidCells::ofColumns(feet, places, levels, longest), prisms.period());
    }
    return mesh;
}

}  // namespace timeseries
