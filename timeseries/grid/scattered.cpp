#include "timeseries/grid/scattered.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <nanoflann.hpp>
#include <numbers>

#include "timeseries/together.h"

namespace timeseries {
namespace {

constexpr std::size_t kNearest = 16;
constexpr std::size_t kPointsAThread = 1 << 10;

// The points that are somewhere, as the tree asks for them.
struct Places {
    std::vector<glm::dvec3> at;
    std::size_t kdtree_get_point_count() const { return at.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t c) const { return at[i][static_cast<int>(c)]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};
using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Places>,
                                                 Places, 3, std::uint32_t>;

// What each stands for; of one point alone 1. REQUIRES: finite places, at least one.
std::vector<double> volumesOf(const Places& places) {
    const std::size_t near = std::min(kNearest, places.at.size() - 1);
    std::vector<double> volumes(places.at.size(), 1.0);
    if (near == 0) return volumes;
    const Tree tree(3, places);
    inParts(volumes.size(), threadsFor(volumes.size(), kPointsAThread),
            [&](std::size_t first, std::size_t last) {
                // The point itself is among those that are found.
                std::array<std::uint32_t, kNearest + 1> found;
                std::array<double, kNearest + 1> squares;
                for (std::size_t point = first; point < last; ++point) {
                    const std::size_t count =
                        tree.knnSearch(&places.at[point].x, near + 1, found.data(), squares.data());
                    const double reach = std::sqrt(squares[count - 1]);
                    const double ball = 4 * std::numbers::pi / 3 * reach * reach * reach;
                    volumes[point] = std::isfinite(ball) ? ball / static_cast<double>(near) : 0;
                }
            });
    return volumes;
}

Mesh meshOf(std::span<const glm::dvec3> at, const std::vector<double>& volumes, double spread,
            MeshAbout::Points points) {
    Mesh mesh(at.size(), at, spread, [&](std::uint64_t i) {
        const bool stands = volumes[i] > 0 && std::isfinite(volumes[i]);
        const double width = stands ? std::cbrt(volumes[i]) : 0;
        return MeshPoint{at[i], {glm::dvec3(width, 0, 0), {0, width, 0}, {0, 0, width}}};
    });
    MeshAbout about;
    about.points = points;
    mesh.setAbout(std::move(about));
    return mesh;
}

}  // namespace

Mesh meshOfScattered(std::span<const glm::dvec3> at) {
    Places places;
    for (const glm::dvec3& place : at)
        if (isPlace(place)) places.at.push_back(place);
    std::vector<double> volumes(at.size());
    if (!places.at.empty()) {
        const std::vector<double> own = volumesOf(places);
        auto next = own.begin();
        for (std::size_t i = 0; i < at.size(); ++i)
            if (isPlace(at[i])) volumes[i] = *next++;
    }
    return meshOf(at, volumes, kScatteredSpread, MeshAbout::Points::Scattered);
}

Mesh meshOfVolumes(std::span<const glm::dvec3> at, const std::vector<double>& volumes,
                   double spread) {
    return meshOf(at, volumes, spread, MeshAbout::Points::Particles);
}

}  // namespace timeseries
