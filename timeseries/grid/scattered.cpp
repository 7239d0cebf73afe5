#include "timeseries/grid/scattered.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <nanoflann.hpp>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

#include "timeseries/together.h"

namespace timeseries {
namespace {

constexpr std::size_t kNearest = 16;
constexpr std::size_t kPointsAThread = 1 << 10;

// The places at which there are points, each once, as the tree asks for them.
struct Places {
    std::vector<glm::dvec3> at;
    std::vector<std::uint64_t> points;  // there
    std::size_t kdtree_get_point_count() const { return at.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t c) const { return at[i][static_cast<int>(c)]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};
using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Places>,
                                                 Places, 3, std::uint32_t>;

// Of the points that are somewhere, which of the places each is at.
std::pair<Places, std::vector<std::uint32_t>> placesOf(std::span<const glm::dvec3> at) {
    std::vector<std::uint32_t> order;
    for (std::size_t i = 0; i < at.size(); ++i)
        if (isPlace(at[i])) order.push_back(static_cast<std::uint32_t>(i));
    std::ranges::sort(order, {},
                      [&](std::uint32_t i) { return std::tuple(at[i].x, at[i].y, at[i].z); });
    Places places;
    std::vector<std::uint32_t> placeOf(at.size());
    for (const std::uint32_t i : order) {
        if (places.at.empty() || places.at.back() != at[i]) {
            places.at.push_back(at[i]);
            places.points.push_back(0);
        }
        ++places.points.back();
        placeOf[i] = static_cast<std::uint32_t>(places.at.size() - 1);
    }
    return {std::move(places), std::move(placeOf)};
}

// What each of the nearest points to a place stands for, of the ball that just holds these, or of
// the stretch of a line through it; and how wide the former is beside how far the fourth is away:
// about 1 where points fill space, 1.4 on a surface, 2.5 on a line.
struct Nearest {
    double volume = 0, ofLine = 0, wide = 0;
};

Nearest nearestOf(const Places& places, const Tree& tree, std::size_t place, std::uint64_t near) {
    constexpr std::size_t kFourth = 4;
    // The place itself is among those that are found.
    std::array<std::uint32_t, kNearest + 1> found;
    std::array<double, kNearest + 1> squares;
    const std::size_t count =
        tree.knnSearch(&places.at[place].x, near + 1, found.data(), squares.data());
    std::size_t farthest = 0;
    std::uint64_t others = places.points[found[0]] - 1;
    while (farthest + 1 < count && (others < near || farthest == 0))
        others += places.points[found[++farthest]];
    const double reach = std::sqrt(squares[farthest]),
                 along = 2 * reach / static_cast<double>(others);
    const double ball = 4 * std::numbers::pi / 3 * reach * reach * reach;
    const double fourth = std::sqrt(squares[std::min(kFourth, farthest)]);
    if (!std::isfinite(ball) || !(fourth > 0)) return {};  // squares leave the doubles
    const double volume = ball / static_cast<double>(others);
    return {volume, along * along * along, std::cbrt(volume) / fourth};
}

// What each point of a place stands for; all of one place alone, for 1. REQUIRES: at least one.
std::vector<double> volumesOf(const Places& places) {
    constexpr double kOnALine = 2;
    const std::uint64_t all =
        std::accumulate(places.points.begin(), places.points.end(), std::uint64_t{0});
    if (places.at.size() == 1) return {1 / static_cast<double>(all)};
    const std::uint64_t near = std::min<std::uint64_t>(kNearest, all - 1);
    std::vector<Nearest> nearest(places.at.size());
    const Tree tree(3, places);
    inParts(nearest.size(), threadsFor(nearest.size(), kPointsAThread),
            [&](std::size_t first, std::size_t last) {
                for (; first < last; ++first) nearest[first] = nearestOf(places, tree, first, near);
            });
    std::vector<double> wide, volumes;
    for (const Nearest& of : nearest) wide.push_back(of.wide);
    const auto middle = wide.begin() + static_cast<std::ptrdiff_t>(wide.size() / 2);
    std::ranges::nth_element(wide, middle);
    // Most lie along lines, of which balls would fill the space between.
    const bool areLines = near == kNearest && *middle > kOnALine;
    for (const Nearest& of : nearest) volumes.push_back(areLines ? of.ofLine : of.volume);
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
    const auto [places, placeOf] = placesOf(at);
    std::vector<double> volumes(at.size());
    if (!places.at.empty()) {
        const std::vector<double> ofPlace = volumesOf(places);
        for (std::size_t i = 0; i < at.size(); ++i)
            if (isPlace(at[i])) volumes[i] = ofPlace[placeOf[i]];
    }
    return meshOf(at, volumes, kScatteredSpread, MeshAbout::Points::Scattered);
}

Mesh meshOfVolumes(std::span<const glm::dvec3> at, const std::vector<double>& volumes,
                   double spread) {
    return meshOf(at, volumes, spread, MeshAbout::Points::Particles);
}

}  // namespace timeseries
