#include "timeseries/grid/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <stdexcept>

#include "timeseries/grid/grid.h"
#include "timeseries/together.h"

namespace timeseries {
namespace {

bool isPlace(const glm::dvec3& at) {
    return std::isfinite(at.x) && std::isfinite(at.y) && std::isfinite(at.z);
}

// The shortest way round.
glm::dvec3 wayBetween(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& period) {
    glm::dvec3 way = to - from;
    for (int c = 0; c < 3; ++c)
        if (period[c] > 0) way[c] -= period[c] * std::round(way[c] / period[c]);
    return way;
}

glm::dvec3 perpendicularTo(const glm::dvec3& v) {
    const glm::dvec3 a = glm::abs(v);
    if (a.x <= a.y && a.x <= a.z) return glm::cross(v, glm::dvec3(1, 0, 0));
    return glm::cross(v, a.y <= a.z ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1));
}

// Gives the columns along indices of one point this length, across the others, right-handed.
void thicken(glm::dmat3& cell, const std::array<std::size_t, 3>& size, double thickness) {
    const auto isThin = [&](int a) { return size[static_cast<std::size_t>(a % 3)] == 1; };
    const auto along = [&](const glm::dvec3& v) {
        const double length = glm::length(v);
        return length > 0 ? v / length * thickness : glm::dvec3(0);
    };
    if (isThin(0) && isThin(1) && isThin(2)) cell = glm::dmat3(thickness);
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        if (isThin(a) && !isThin(b) && !isThin(c)) cell[a] = along(glm::cross(cell[b], cell[c]));
        if (!isThin(a) && isThin(b) && isThin(c)) {
            cell[b] = along(perpendicularTo(cell[a]));
            cell[c] = along(glm::cross(cell[a], cell[b]));
        }
    }
}

}  // namespace

// What a part of the mesh adds up to: of the cells turned each way.
struct Mesh::Sums {
    std::array<double, 2> volume{};
    std::array<std::uint64_t, 2> cells{};
    std::uint64_t flat = 0, absent = 0;
    double width = 0;  // of a surface's cells their area, of a line's their length
    glm::dvec3 widest{0};
};

Mesh::Mesh(MeshPlaces places)
    : size_(places.size), levels_(std::move(places.levels)), period_(places.period) {
    const auto [ni, nj, nk] = size_;
    const std::uint64_t stored = levels_.empty() ? count() : std::uint64_t{ni} * nj;
    if (count() == 0 || places.at.size() != stored || (!levels_.empty() && levels_.size() != nk))
        throw std::invalid_argument("a mesh with places of another number of points");
    takePlaces(places);
    measure();
}

std::uint64_t Mesh::count() const { return std::uint64_t{size_[0]} * size_[1] * size_[2]; }

void Mesh::takePlaces(const MeshPlaces& places) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    lo_ = glm::dvec3(kInfinity);
    hi_ = -lo_;
    for (const glm::dvec3& at : places.at)
        if (isPlace(at)) {
            lo_ = glm::min(lo_, at);
            hi_ = glm::max(hi_, at);
        }
    if (!levels_.empty()) {
        const auto [least, most] = std::ranges::minmax(levels_);
        lo_.z += least;
        hi_.z += most;
    }
    if (!isPlace(lo_) || !isPlace(hi_) || !isPlace(hi_ - lo_))
        throw std::invalid_argument("no point has a place that is finite");
    origin_ = 0.5 * lo_ + 0.5 * hi_;
    const glm::dvec3 below(origin_.x, origin_.y, levels_.empty() ? origin_.z : 0.0);
    stored_ = places.at.size();
    at_ = Pages<glm::vec3>(stored_);
    std::ranges::transform(places.at, at_.data(), [&](const glm::dvec3& at) {
        return isPlace(at) ? glm::vec3(at - below)
                           : glm::vec3(std::numeric_limits<float>::quiet_NaN());
    });
    for (double& level : levels_) level -= origin_.z;
}

glm::dvec3 Mesh::position(std::uint64_t index) const {
    if (levels_.empty()) return origin_ + glm::dvec3(stored()[index]);
    const std::uint64_t column = index % stored_;
    return origin_ + glm::dvec3(stored()[column]) + glm::dvec3(0, 0, levels_[index / stored_]);
}

glm::dvec3 Mesh::placeAt(const std::array<std::size_t, 3>& ijk) const {
    const std::uint64_t row = ijk[0] + size_[0] * std::uint64_t{ijk[1]};
    if (levels_.empty())
        return origin_ + glm::dvec3(stored()[row + size_[0] * size_[1] * std::uint64_t{ijk[2]}]);
    return origin_ + glm::dvec3(stored()[row]) + glm::dvec3(0, 0, levels_[ijk[2]]);
}

glm::dmat3 Mesh::stepsAt(const std::array<std::size_t, 3>& ijk) const {
    const glm::dvec3 here = placeAt(ijk);
    glm::dmat3 steps(0.0);
    for (std::size_t a = 0; a < 3; ++a) {
        if (size_[a] == 1) continue;
        glm::dvec3 sum(0);
        int ways = 0;
        for (const int way : {-1, 1}) {
            if (way < 0 ? ijk[a] == 0 : ijk[a] + 1 == size_[a]) continue;
            auto neighbour = ijk;
            neighbour[a] += static_cast<std::size_t>(way);
            const glm::dvec3 there = placeAt(neighbour);
            if (!isPlace(there)) continue;
            sum += static_cast<double>(way) * wayBetween(here, there, period_);
            ++ways;
        }
        if (ways > 0) steps[static_cast<int>(a)] = sum / static_cast<double>(ways);
    }
    return steps;
}

glm::dmat3 Mesh::cell(std::uint64_t index) const {
    const auto at = indicesOf(index, glm::vec<3, std::uint64_t>(size_[0], size_[1], size_[2]));
    glm::dmat3 steps = stepsAt({at.x, at.y, at.z});
    if (thickness_ > 0) thicken(steps, size_, thickness_);
    return steps;
}

double Mesh::volume(const glm::dmat3& cell) const {
    const double turned = sign_ * glm::determinant(cell);
    return turned > 0 ? turned : 0;
}

// From the sums over the first level to those over all.
void Mesh::addLevels(Sums& sums) const {
    const Axis levels{"", "", levels_};
    double thick = 0, thickest = 0;
    for (std::size_t k = 0; k < levels_.size(); ++k) {
        thick += std::abs(levels.width(k));
        thickest = std::max(thickest, std::abs(levels.width(k)));
    }
    for (double& volume : sums.volume) volume *= thick / std::abs(levels.width(0));
    for (std::uint64_t* count : {&sums.cells[0], &sums.cells[1], &sums.flat, &sums.absent})
        *count *= levels_.size();
    sums.widest.z = thickest;
}

// In pieces of one size, added up in their order: the same for any number of threads. Of columns
// with levels one level is added up, for all cells above each other are as wide.
void Mesh::measure() {
    const std::uint64_t measured = stored_;
    const auto added = [this, measured](const auto& addOne) {
        constexpr std::uint64_t kPiece = 1 << 14;
        std::vector<Sums> sums((measured + kPiece - 1) / kPiece);
        std::atomic<std::size_t> next = 0;
        together(threadsFor(sums.size(), 4), [&](unsigned) {
            for (std::size_t piece = next++; piece < sums.size(); piece = next++)
                for (std::uint64_t i = piece * kPiece; i < std::min(measured, (piece + 1) * kPiece);
                     ++i)
                    if (isPlace(position(i)))
                        addOne(cell(i), sums[piece]);
                    else
                        ++sums[piece].absent;
        });
        Sums all;
        for (const Sums& some : sums) {
            for (const std::size_t way : {0u, 1u}) {
                all.volume[way] += some.volume[way];
                all.cells[way] += some.cells[way];
            }
            all.flat += some.flat;
            all.absent += some.absent;
            all.width += some.width;
            all.widest = glm::max(all.widest, some.widest);
        }
        return all;
    };
    const auto thin = std::ranges::count(size_, 1u);
    if (thin > 0) {
        const Sums flat = added([&](const glm::dmat3& steps, Sums& to) {
            glm::dvec3 one(0), other(0);  // the columns that are not 0
            for (int a = 0; a < 3; ++a)
                if (size_[static_cast<std::size_t>(a)] > 1)
                    (one == glm::dvec3(0) ? one : other) = steps[a];
            to.width += thin == 1 ? glm::length(glm::cross(one, other)) : glm::length(one);
        });
        const double mean = flat.width / static_cast<double>(measured - flat.absent);
        thickness_ = thin == 3 ? 1 : thin == 2 ? mean : std::sqrt(mean);
    }
    Sums all = added([&](const glm::dmat3& steps, Sums& to) {
        const double turned = glm::determinant(steps);
        if (!(std::abs(turned) > 0)) {
            ++to.flat;
            return;
        }
        to.volume[turned < 0] += std::abs(turned);
        ++to.cells[turned < 0];
        const glm::dmat3 rows = glm::transpose(steps);
        for (int c = 0; c < 3; ++c) to.widest[c] = std::max(to.widest[c], glm::length(rows[c]));
    });
    if (levels_.size() > 1) addLevels(all);
    const std::size_t most = all.cells[1] > all.cells[0] ? 1 : 0;
    sign_ = most == 1 ? -1 : 1;
    if (all.cells[most] == 0) throw std::invalid_argument("no cell of the points has a volume");
    meanVolume_ = all.volume[most] / static_cast<double>(all.cells[most]);
    widest_ = all.widest;
    folded_ = all.cells[1 - most];
    flat_ = all.flat;
    absent_ = all.absent;
}

std::vector<std::string> notesOf(const Mesh& mesh) {
    std::vector<std::string> notes;
    const auto add = [&](std::uint64_t points, std::string_view what) {
        if (points > 0)
            notes.push_back(
                fmt::format("{} of {} points are not drawn: {}", points, mesh.count(), what));
    };
    add(mesh.absent(), "the file gives them no place");
    add(mesh.folded(), "their cells are folded, inside out beside most of the others");
    add(mesh.flat(), "their cells have no volume");
    return notes;
}

std::uint64_t Mesh::bytes() const {
    return stored_ * sizeof(glm::vec3) + levels_.size() * sizeof(double);
}

}  // namespace timeseries
