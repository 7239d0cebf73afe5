// The points of a grid on a globe, and the cells that they stand for there.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "render/points/globe.h"
#include "timeseries/together.h"

namespace render {
namespace {

using timeseries::Axis;
using timeseries::Grid;
using timeseries::Mesh;
using timeseries::MeshPoint;

// The part of an axis from half the way to the point before to half the way to the one after, at
// an end as far beyond it.
struct Stretch {
    double from, to;
    double length() const { return to - from; }
};
Stretch aboutPoint(const Axis& axis, std::size_t i) {
    const double half = 0.5 * std::abs(axis.width(i));
    return {axis.coordinates[i] - half, axis.coordinates[i] + half};
}

// Where the last point is the first, once round, both share the cells there.
bool comesRound(const Axis& longitude) {
    constexpr double kOnePlace = 1e-3;  // of a step
    const auto& c = longitude.coordinates;
    const double beyond = std::abs(std::abs(c.back() - c.front()) - 360);
    return c.size() > 2 && beyond < kOnePlace * std::abs(longitude.width(0));
}

bool goesRound(const Axis& longitude) {
    constexpr double kAll = 359.9;
    const auto& c = longitude.coordinates;
    return std::abs(c.back() - c.front()) + std::abs(longitude.width(0)) > kAll;
}

// Cells of an upright grid: between two meridians, two parallels and two spheres, whose volume is
// (sin b2 - sin b1) (a2 - a1) (r2^3 - r1^3) / 3.
class UprightCells {
 public:
    UprightCells(const Grid& grid, const Globe& globe)
        : axes_(grid.axes()),
          globe_(globe),
          size_(axes_[0].coordinates.size(), axes_[1].coordinates.size(),
                axes_[2].coordinates.size()) {
        const bool halves = comesRound(axes_[0]);
        for (std::size_t i = 0; i < size_.x; ++i) {
            const bool isEnd = i == 0 || i + 1 == size_.x;
            sharesWith_.push_back(halves && isEnd ? 1 : 0);
            degreesEast_.push_back(size_.x > 1 ? axes_[0].width(i) : 1);
            longitude_.emplace_back(axes_[0].coordinates[i]);
        }
        for (std::size_t j = 0; j < size_.y; ++j) {
            const double sense = axes_[1].width(j) < 0 ? -1 : 1;
            const Stretch b =
                size_.y > 1 ? aboutPoint(axes_[1], j)
                            : Stretch{axes_[1].coordinates[j] - 0.5, axes_[1].coordinates[j] + 0.5};
            const double from = std::max(b.from, -90.0), to = std::min(b.to, 90.0);
            degreesNorth_.push_back(sense * std::max(to - from, 0.0));
            const double sines = std::sin(to * kPerDegree) - std::sin(from * kPerDegree);
            cosine_.push_back(to > from ? sines / ((to - from) * kPerDegree) : 0);
            latitude_.emplace_back(axes_[1].coordinates[j]);
            // Where longitudes go round, in degrees of a great circle.
            const double away = std::cos(axes_[1].coordinates[j] * kPerDegree) / kPerDegree;
            ring_.push_back(goesRound(axes_[0]) ? timeseries::AxisRing{away, b.length()}
                                                : timeseries::AxisRing{});
        }
        double area = 0;
        for (std::size_t j = 0; j < size_.y; ++j)
            area += std::abs(degreesNorth_[j] * cosine_[j]) / static_cast<double>(size_.y);
        const double wide = (axes_[0].coordinates.back() - axes_[0].coordinates.front()) /
                            std::max(static_cast<double>(size_.x) - 1, 1.0);
        thickness_ = std::sqrt(area * std::max(std::abs(wide), 1e-9)) * kPerDegree;
        for (std::size_t k = 0; k < size_.z; ++k) {
            const Stretch third = aboutPoint(axes_[2], k);
            const double middle = globe.radius(axes_[2].coordinates[k]);
            double r1 = globe.radius(third.from), r2 = globe.radius(third.to);
            if (size_.z == 1) r1 = middle - thickness_ / 2, r2 = middle + thickness_ / 2;
            outwards_.push_back((axes_[2].width(k) < 0 ? -1 : 1) * (r2 - r1));
            meanRadius_.push_back(std::sqrt((r1 * r1 + r1 * r2 + r2 * r2) / 3));
            radius_.push_back(middle);
        }
    }

    MeshPoint operator()(std::uint64_t index) const {
        const auto at = timeseries::indicesOf(index, size_);
        const auto [east, north, up] = globe_.directionsAt(longitude_[at.x], latitude_[at.y]);
        const double r = meanRadius_[at.z] * kPerDegree;
        const double wide = cosine_[at.y] * degreesEast_[at.x];
        const unsigned wider = timeseries::wideningOn(ring_[at.y], std::abs(wide));
        const glm::dmat3 rows =
            glm::transpose(glm::dmat3(r * std::ldexp(wide, static_cast<int>(wider)) * east,
                                      r * degreesNorth_[at.y] * north, outwards_[at.z] * up));
        return {radius_[at.z] * up,
                {rows[0], rows[1], rows[2]},
                std::min(wider + sharesWith_[at.x], timeseries::kMostWidened)};
    }
    // Neighbours are no farther apart along any coordinate.
    double longestWay() const {
        const auto longest = [](const std::vector<double>& v) {
            double most = 0;
            for (const double each : v) most = std::max(most, std::abs(each));
            return most;
        };
        const double farthest = *std::ranges::max_element(meanRadius_);
        // A step between two points is no longer than twice what one of them stands for.
        return 2 * std::max(farthest * 1.1 * kPerDegree *
                                std::max(longest(degreesEast_), longest(degreesNorth_)),
                            longest(outwards_));
    }

 private:
    const std::array<Axis, 3>& axes_;
    const Globe& globe_;
    glm::vec<3, std::uint64_t> size_;
    std::vector<Globe::Angle> longitude_, latitude_;
    // Of each point along its axis: signed along increasing index; the mean cosine of latitude and
    // the root of the mean square of the radius in its cells.
    std::vector<double> degreesEast_, degreesNorth_, cosine_, outwards_, meanRadius_;
    std::vector<double> radius_;
    std::vector<unsigned> sharesWith_;        // of each longitude, how many others its cells
    std::vector<timeseries::AxisRing> ring_;  // of each latitude, about the poles' axis
    double thickness_ = 0;                    // of one level: as thick as its cells are wide
};

struct NotWanted {};

// Points with neighbours have the cells that lie between these, wherever they are.
std::shared_ptr<const Mesh> curvilinear(const Grid& grid, const Globe& globe,
                                        const std::atomic<bool>& wanted) {
    timeseries::MeshPlaces places{.size = grid.size(), .at = {}};
    places.at.resize(grid.count());
    timeseries::inParts(
        grid.count(), timeseries::threadsFor(grid.count(), 1 << 14),
        [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last && wanted; ++i) {
                const glm::dvec3 own = grid.position(i);
                places.at[i] = globe.at(grid.earth() ? glm::dvec3(onEarth(grid, i), own.z) : own);
            }
        });
    if (!wanted) throw NotWanted();
    return std::make_shared<const Mesh>(places);
}

// Others the ones of the file, of which the globe turns, shears and stretches each.
MeshPoint onGlobe(const Mesh& file, const Globe& globe, std::uint64_t i) {
    const glm::dvec3 place = file.position(i);
    const auto rows = file.cell(i).rows();
    const glm::dmat3 sides = glm::transpose(glm::dmat3(rows[0], rows[1], rows[2])) / file.spread();
    const glm::dmat3 there = glm::transpose(globe.waysAt(place) * sides);
    return {globe.at(place), {there[0], there[1], there[2]}};
}

}  // namespace

std::shared_ptr<const Mesh> Globe::meshOf(const Grid& grid, const std::atomic<bool>& wanted) const {
    const auto goOn = [&] {
        if (!wanted) throw NotWanted();
    };
    const auto make = [&]() -> std::shared_ptr<const Mesh> {
        const Box bounds = box();
        const std::vector between{bounds.lo, bounds.hi};
        const Mesh* const file = grid.mesh().get();
        if (grid.earth() || (file && file->hasNeighbours()))
            return curvilinear(grid, *this, wanted);
        if (file == nullptr) {
            const UprightCells cells(grid, *this);
            const auto point = [&](std::uint64_t i) { return goOn(), cells(i); };
            return std::make_shared<const Mesh>(grid.size(), between,
                                                glm::dvec3(cells.longestWay()), point);
        }
        const auto point = [&](std::uint64_t i) { return goOn(), onGlobe(*file, *this, i); };
        auto mesh = std::make_shared<Mesh>(file->count(), between, file->spread(), point);
        mesh->setSolids(file->solids());
        std::vector<glm::dvec3> nodes;
        for (std::uint64_t i = file->count(); i < file->corners(); ++i)
            goOn(), nodes.push_back(at(file->cornerPosition(i)));
        Mesh::Box around{bounds.lo, bounds.hi};
        for (const glm::dvec3& node : nodes) {
            if (!timeseries::isPlace(node)) continue;
            around.lo = glm::min(around.lo, node);
            around.hi = glm::max(around.hi, node);
        }
        mesh->setNodes(nodes, around);
        return mesh;
    };
    try {
        return grid.elsewhere(perUnit_, make);
    } catch (const NotWanted&) {
        return nullptr;
    }
}

}  // namespace render
