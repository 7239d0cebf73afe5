#include "timeseries/grid/grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <mutex>
#include <numeric>
#include <stdexcept>

namespace timeseries {
namespace {

double meanStep(const Axis& axis) {
    const auto& c = axis.coordinates;
    return (c.back() - c.front()) / static_cast<double>(c.size() - 1);
}

}  // namespace

std::vector<double> indexCoordinates(std::uint64_t length) {
    std::vector<double> index(length);
    std::iota(index.begin(), index.end(), 0.0);
    return index;
}

std::string flawOf(const std::vector<double>& c) {
    if (!std::ranges::all_of(c, [](double v) { return std::isfinite(v); }))
        return "its coordinates are not all finite";
    const bool ascending = c.back() > c.front();
    for (std::size_t i = 1; i < c.size(); ++i)
        if (ascending ? !(c[i] > c[i - 1]) : !(c[i] < c[i - 1]))
            return "its coordinates are not strictly monotonic";
    return "";
}

std::optional<std::array<int, 3>> alignedWith(const glm::dmat3& directions) {
    constexpr double kRounding = 1e-6;
    std::array<int, 3> along{};
    std::array<bool, 3> taken{};
    for (int axis = 0; axis < 3; ++axis) {
        for (int c = 0; c < 3; ++c)
            if (std::abs(directions[axis][c]) > 1 - kRounding)
                along[axis] = c;
            else if (!(std::abs(directions[axis][c]) <= kRounding))
                return std::nullopt;
        taken[along[axis]] = true;
    }
    if (!taken[0] || !taken[1] || !taken[2]) return std::nullopt;
    return along;
}

std::string flawOf(const glm::dmat3& directions) {
    // Far flatter than any real cell; floats would no longer draw it.
    constexpr double kFlattest = 1e-3;
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(glm::length(directions[axis]) - 1) < 1e-9))
            return "an axis has no direction";
    return std::abs(glm::determinant(directions)) < kFlattest ? "its axes lie in one plane" : "";
}

bool Axis::uniform() const {
    if (coordinates.size() < 3) return true;
    const double step = meanStep(*this);
    for (std::size_t i = 1; i < coordinates.size(); ++i)
        if (std::abs(coordinates[i] - coordinates[i - 1] - step) > 1e-4 * std::abs(step))
            return false;
    return true;
}

double Axis::width(std::size_t i) const {
    const std::size_t last = coordinates.size() - 1;
    if (last == 0) return 0;
    if (i == 0) return coordinates[1] - coordinates[0];
    if (i == last) return coordinates[last] - coordinates[last - 1];
    // Halved before the difference: the sum of two huge coordinates may overflow.
    return 0.5 * coordinates[i + 1] - 0.5 * coordinates[i - 1];
}

struct Grid::Elsewhere {
    std::mutex making, guard;  // `making` is taken first
    struct Made {
        double of;
        std::weak_ptr<const Mesh> mesh;
    };
    std::vector<Made> made;
};

Grid::Grid(std::array<Axis, 3> axes, CoordinateFrame frame)
    : axes_(std::move(axes)), frame_(std::move(frame)), elsewhere_(std::make_shared<Elsewhere>()) {
    if (const std::string flaw = flawOf(frame_.directions); !flaw.empty())
        throw std::invalid_argument("directions: " + flaw);
    std::uint64_t count = 1;
    for (const Axis& axis : axes_) {
        if (axis.coordinates.empty())
            throw std::invalid_argument(fmt::format("axis {} has no points", axis.name));
        if (const std::string flaw = flawOf(axis.coordinates); !flaw.empty())
            throw std::invalid_argument(fmt::format("axis {}: {}", axis.name, flaw));
        const std::uint64_t n = axis.coordinates.size();
        if (count > (std::uint64_t{1} << 63) / n)
            throw std::invalid_argument("the grid has more than 2^63 points");
        count *= n;
    }
}

Grid::Grid(std::array<Axis, 3> space, std::shared_ptr<const Mesh> mesh, bool ofOneStep)
    : axes_(std::move(space)),
      mesh_(std::move(mesh)),
      ofOneStep_(ofOneStep),
      elsewhere_(std::make_shared<Elsewhere>()) {
    // What rounding leaves across one layer of cells, beside how thick they are: no extent. Points
    // alone, one of which may be far from all others and stand for much, were not rounded.
    const auto points = mesh_->about().points;
    const bool areAlone =
        points == MeshAbout::Points::Scattered || points == MeshAbout::Points::Particles;
    const double rounding = areAlone ? 0 : 0x1p-24;
    for (int a = 0; a < 3; ++a) {
        if (!axes_[a].coordinates.empty()) continue;
        const auto [lo, hi] = mesh_->ends(a);
        axes_[a].coordinates = {lo};
        if (hi - lo > rounding * mesh_->widest()[a]) axes_[a].coordinates.push_back(hi);
    }
}

std::array<Axis, 3> spaceAxes() {
    return {Axis{"x", "", {}}, Axis{"y", "", {}}, Axis{"z", "", {}}};
}

std::shared_ptr<const Grid> gridOfStep(const std::shared_ptr<const Grid>& series,
                                       const std::shared_ptr<const Grid>& step) {
    if (series == step || *series == *step) return series;
    // What the series knows of its columns holds for all of its steps.
    if (step->earth() != series->earth() && step->size() == series->size())
        return gridOfStep(series, std::make_shared<const Grid>(step->withEarth(series->earth())));
    if (!series->mesh() || !step->mesh()) return nullptr;
    // Cells that name their corners may come and go.
    const bool named = !series->mesh()->hasNeighbours() && !step->mesh()->hasNeighbours();
    if (!named && series->size() != step->size()) return nullptr;
    const auto sameSpace = [](const Axis& a, const Axis& b) {
        return a.name == b.name && a.units == b.units && a.down == b.down;
    };
    if (!std::ranges::equal(series->axes(), step->axes(), sameSpace)) return nullptr;
    return std::make_shared<const Grid>(
        Grid(series->axes(), step->mesh(), true).withEarth(step->earth()));
}

std::array<std::size_t, 3> Grid::size() const {
    if (mesh_) return mesh_->size();
    return {axes_[0].coordinates.size(), axes_[1].coordinates.size(), axes_[2].coordinates.size()};
}

std::uint64_t Grid::count() const {
    const auto n = size();
    return std::uint64_t{n[0]} * n[1] * n[2];
}

bool Grid::uniform() const {
    return !mesh_ && axes_[0].uniform() && axes_[1].uniform() && axes_[2].uniform();
}

Grid::Ends Grid::ends(std::size_t axis) const {
    const auto& c = axes_[axis].coordinates;
    return {std::min(c.front(), c.back()), std::max(c.front(), c.back())};
}

std::optional<Grid::Places> Grid::placesWithin(std::size_t axis, double lo, double hi) const {
    const auto& c = axes_[axis].coordinates;
    const auto isWithin = [&](double x) { return lo <= x && x <= hi; };
    const auto first = std::find_if(c.begin(), c.end(), isWithin);
    if (first == c.end()) return std::nullopt;
    const auto past = std::find_if_not(first, c.end(), isWithin);  // monotonic: one stretch
    return Places{static_cast<std::size_t>(first - c.begin()),
                  static_cast<std::size_t>(past - c.begin() - 1)};
}

double Grid::nearestPlane(std::size_t axis, double coordinate) const {
    return *std::ranges::min_element(axes_[axis].coordinates, {},
                                     [&](double plane) { return std::abs(plane - coordinate); });
}

Grid Grid::relabelled(const std::array<std::string, 3>& names,
                      const std::array<bool, 3>& flip) const {
    Grid same = *this;
    same.elsewhere_ = std::make_shared<Elsewhere>();
    for (std::size_t a = 0; a < 3; ++a) {
        if (flip[a]) same.axes_[a].down = !same.axes_[a].down;
        if (!names[a].empty()) same.axes_[a].name = names[a];
    }
    return same;
}

Grid Grid::withEarth(std::shared_ptr<const EarthPlaces> earth) const {
    assert(!earth || earth->count() == std::uint64_t{size()[0]} * size()[1]);
    Grid same = *this;
    same.elsewhere_ = std::make_shared<Elsewhere>();
    same.earth_ = std::move(earth);
    return same;
}

glm::vec<3, std::uint64_t> Grid::indices(std::uint64_t index) const {
    const auto n = size();
    return indicesOf(index, glm::vec<3, std::uint64_t>(n[0], n[1], n[2]));
}

glm::dvec3 Grid::position(std::uint64_t index) const {
    if (mesh_) return mesh_->position(index);
    const auto at = indices(index);
    const glm::dvec3 along(axes_[0].coordinates[at[0]], axes_[1].coordinates[at[1]],
                           axes_[2].coordinates[at[2]]);
    return frame_.origin + frame_.directions * along;
}

glm::dmat3 Grid::cell(std::uint64_t index) const {
    const auto at = indices(index);
    double smallest = std::numeric_limits<double>::infinity();
    for (const Axis& axis : axes_)
        if (axis.coordinates.size() > 1) smallest = std::min(smallest, std::abs(meanStep(axis)));
    if (!std::isfinite(smallest)) smallest = 1;
    glm::dmat3 steps(0.0);
    for (int a = 0; a < 3; ++a) {
        const double width = axes_[a].width(at[a]);
        steps[a][a] = axes_[a].coordinates.size() > 1 ? width : smallest;
    }
    return frame_.directions * steps;
}

std::shared_ptr<const Mesh> Grid::elsewhere(
    double of, const std::function<std::shared_ptr<const Mesh>()>& make) const {
    if (auto mesh = elsewhereIfMade(of)) return mesh;
    const std::scoped_lock making(elsewhere_->making);
    if (auto mesh = elsewhereIfMade(of)) return mesh;
    auto mesh = make();
    const std::scoped_lock lock(elsewhere_->guard);
    std::erase_if(elsewhere_->made, [](const auto& each) { return each.mesh.expired(); });
    if (mesh) elsewhere_->made.push_back({of, mesh});
    return mesh;
}

std::shared_ptr<const Mesh> Grid::elsewhereIfMade(double of) const {
    const std::scoped_lock lock(elsewhere_->guard);
    for (const auto& each : elsewhere_->made)
        if (each.of == of)
            if (auto mesh = each.mesh.lock()) return mesh;
    return nullptr;
}

}  // namespace timeseries
