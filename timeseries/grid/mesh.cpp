#include "timeseries/grid/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "timeseries/grid/grid.h"
#include "timeseries/grid/solid_cells.h"
#include "timeseries/together.h"

namespace timeseries {
namespace {

// Dividing by them changes no digit. Where all lie in a plane, cells are about as high as wide.
glm::dvec3 powersOfTwoBeside(const glm::dvec3& lengths) {
    const double longest = std::max({lengths.x, lengths.y, lengths.z});
    glm::dvec3 powers(1);
    for (int c = 0; c < 3 && longest > 0; ++c)
        powers[c] = std::ldexp(1.0, std::ilogb(lengths[c] > 0 ? lengths[c] : longest));
    return powers;
}

struct Bounds {
    glm::dvec3 lo{std::numeric_limits<double>::infinity()}, hi = -lo;
    void add(const glm::dvec3& at) {
        lo = glm::min(lo, at);
        hi = glm::max(hi, at);
    }
    void add(const Bounds& other) {
        lo = glm::min(lo, other.lo);
        hi = glm::max(hi, other.hi);
    }
};

// Of those that are places.
Bounds boundsOf(std::span<const glm::dvec3> all) {
    std::vector<Bounds> bounds(threadsFor(all.size(), 1 << 14));
    const auto threads = static_cast<unsigned>(bounds.size());
    together(threads, [&](unsigned k) {
        Bounds own;
        for (std::size_t i = all.size() * k / threads; i < all.size() * (k + 1) / threads; ++i)
            if (isPlace(all[i])) own.add(all[i]);
        bounds[k] = own;
    });
    for (const Bounds& other : bounds) bounds[0].add(other);
    return bounds[0];
}

// The L of L L^T = J J^T, of rows of J that need not be orthogonalised where they are such already.
LowerTriangle<double> shapeOf(const std::array<glm::dvec3, 3>& rows) {
    if (rows[0].y != 0 || rows[0].z != 0 || rows[1].z != 0) return factorOf(rows);
    const double first = std::copysign(1, rows[0].x), second = std::copysign(1, rows[1].y);
    return {{std::abs(rows[0].x), std::abs(rows[1].y), std::abs(rows[2].z)},
            {first * rows[1].x, first * rows[2].x, second * rows[2].y}};
}

Mesh::MeshPoints oneByOne(const std::function<MeshPoint(std::uint64_t)>& point) {
    return [&](std::uint64_t first, std::span<MeshPoint> points) {
        for (MeshPoint& each : points) each = point(first++);
    };
}

}  // namespace

// What a part of the mesh adds up to, in its units: of the cells turned each way.
struct Mesh::Sums {
    std::array<double, 2> volume{};
    std::array<std::uint64_t, 2> cells{};
    std::uint64_t flat = 0, absent = 0;
    glm::dvec3 widest2{0};  // squared
    Bounds bounds;

    void addCell(const std::array<glm::dvec3, 3>& rows, double turned) {
        if (!(std::abs(turned) > 0)) {
            ++flat;
            return;
        }
        volume[turned < 0] += std::abs(turned);
        ++cells[turned < 0];
        for (int c = 0; c < 3; ++c) widest2[c] = std::max(widest2[c], glm::dot(rows[c], rows[c]));
    }
    void add(const Sums& other) {
        for (const std::size_t way : {0u, 1u}) {
            volume[way] += other.volume[way];
            cells[way] += other.cells[way];
        }
        flat += other.flat;
        absent += other.absent;
        widest2 = glm::max(widest2, other.widest2);
        bounds.add(other.bounds);
    }
};

Mesh::Mesh(const MeshPlaces& places) : size_(places.size), period_(places.period) {
    const auto [ni, nj, nk] = size_;
    const bool columns = !places.levels.empty();
    const std::uint64_t stored = columns ? std::uint64_t{ni} * nj : count();
    if (count() == 0 || places.at.size() != stored || (columns && places.levels.size() != nk))
        throw std::invalid_argument("a mesh with places of another number of points");
    const CurvilinearCells cells(places);
    longestWay_ = cells.longestWay();
    takeColumns(stored, places.at, places.levels, oneByOne([&](std::uint64_t i) {
                    if (!isPlace(places.at[i])) return MeshPoint{places.at[i], {}};
                    const CurvilinearCells::Cell cell = cells(i);
                    const glm::dmat3 rows = glm::transpose(cell.steps);
                    return MeshPoint{places.at[i], {rows[0], rows[1], rows[2]}, cell.widened};
                }));
    if (absent_ > 0) about_.oneSided = cells.oneSided() * (columns ? nk : 1);
}

Mesh::Mesh(const std::array<std::size_t, 3>& size, std::span<const glm::dvec3> between,
           const glm::dvec3& longestWay, const std::function<MeshPoint(std::uint64_t)>& point)
    : size_(size), longestWay_(longestWay) {
    takeColumns(count(), between, {}, oneByOne(point));
}

Mesh::Mesh(std::uint64_t count, std::span<const glm::dvec3> between, double spread,
           const std::function<MeshPoint(std::uint64_t)>& point, const std::vector<double>& levels)
    : Mesh(count, between, spread, oneByOne(point), levels) {}

Mesh::Mesh(std::uint64_t count, std::span<const glm::dvec3> between, double spread,
           const MeshPoints& points, const std::vector<double>& levels)
    : size_{count, 1, std::max<std::size_t>(levels.size(), 1)},
      hasNeighbours_(false),
      spread_(spread) {
    takeColumns(count, between, levels, points);
}

Mesh::Mesh(std::uint64_t columns, std::size_t levels, std::span<const glm::dvec3> between,
           double spread, const std::function<MeshPoint(std::uint64_t)>& point)
    : size_{columns, 1, levels}, hasNeighbours_(false), spread_(spread) {
    takeColumns(count(), between, {}, oneByOne(point));
}

void Mesh::takeColumns(std::uint64_t stored, std::span<const glm::dvec3> between,
                       const std::vector<double>& levels, const MeshPoints& points) {
    double lowest = 0, highest = 0;
    if (!levels.empty()) std::tie(lowest, highest) = std::minmax(levels.front(), levels.back());
    takeUnits(between, lowest, highest);
    takeLevels(levels);
    takePoints(stored, points);
    lo_.z += lowest;
    hi_.z += highest;
}

std::uint64_t Mesh::count() const { return std::uint64_t{size_[0]} * size_[1] * size_[2]; }

// From the bounds of these, whose third coordinates have so much added to them.
void Mesh::takeUnits(std::span<const glm::dvec3> at, double lowest, double highest) {
    auto [lo, hi] = boundsOf(at);
    lo.z += lowest;
    hi.z += highest;
    if (!isPlace(lo) || !isPlace(hi) || !isPlace(hi - lo))
        throw std::invalid_argument("no point has a place that is finite");
    origin_ = 0.5 * lo + 0.5 * hi;
    unit_ = powersOfTwoBeside(0.5 * (hi - lo));
}

void Mesh::takeLevels(const std::vector<double>& levels) {
    const Axis axis{"", "", levels};
    for (std::size_t k = 0; k < levels.size(); ++k)
        levels_.push_back({levels[k] - origin_.z, levels.size() > 1 ? std::abs(axis.width(k)) : 0});
}

// In pieces of one size, added up in their order: the same for any number of threads.
void Mesh::takePoints(std::uint64_t count, const MeshPoints& pointsOf) {
    constexpr std::uint64_t kPiece = 1 << 14;
    static_assert(kPiece % kMostAtOnce == 0);
    stored_ = count;
    points_ = Pages<Point>(stored_);
    const glm::dvec3 below(origin_.x, origin_.y, levels_.empty() ? origin_.z : 0.0);
    const glm::dvec3 unit = unit_, perUnit = spread_ / unit_;
    const auto right = levels_.size() > 1 ? Point::Right::Area : Point::Right::Volume;
    const auto take = [&](MeshPoint& point, Sums& sums) -> Point {
        if (!isPlace(point.at)) {
            ++sums.absent;
            return Point(glm::dvec3(std::numeric_limits<double>::quiet_NaN()));
        }
        sums.bounds.add(point.at);
        const glm::dvec3 place = (point.at - below) / unit;
        for (int c = 0; c < 3; ++c) point.rows[c] *= perUnit[c];
        const auto& rows = point.rows;
        const double wide = glm::dot(rows[0], glm::cross(rows[1], rows[2]));
        const double turned = std::ldexp(wide, -static_cast<int>(point.widened));
        sums.addCell(rows, turned);
        if (!(std::abs(turned) > 0)) return Point(place);
        return Point(place, shapeOf(rows), turned < 0, point.widened, right);
    };
    const auto takePiece = [&](std::uint64_t begin, std::uint64_t end) {
        Sums sums;
        std::array<MeshPoint, kMostAtOnce> some;
        for (std::uint64_t first = begin; first < end; first += kMostAtOnce) {
            const std::size_t size = std::min<std::uint64_t>(kMostAtOnce, end - first);
            pointsOf(first, std::span(some).first(size));
            for (std::size_t i = 0; i < size; ++i) points_.data()[first + i] = take(some[i], sums);
        }
        return sums;
    };
    std::vector<Sums> sums((stored_ + kPiece - 1) / kPiece);
    std::atomic<std::size_t> next = 0;
    sharing(threadsFor(sums.size(), 1), [&](unsigned) {
        for (std::size_t piece = next++; piece < sums.size(); piece = next++)
            sums[piece] = takePiece(piece * kPiece, std::min(stored_, (piece + 1) * kPiece));
    });
    Sums all;
    for (const Sums& some : sums) all.add(some);
    takeSums(all);
}

void Mesh::takeSums(const Sums& sums) {
    const std::size_t most = sums.cells[1] > sums.cells[0] ? 1 : 0;
    turned_ = most == 1;
    lo_ = sums.bounds.lo;
    hi_ = sums.bounds.hi;
    if (sums.cells[most] == 0) throw std::invalid_argument("no cell of the points has a volume");
    meanVolume_ = sums.volume[most] / static_cast<double>(sums.cells[most]);
    for (int c = 0; c < 3; ++c) meanVolume_ *= static_cast<long double>(unit_[c] / spread_);
    widest_ = unit_ * glm::sqrt(sums.widest2);
    // Cells above each other are as wide, and were looked at on the first level.
    std::uint64_t levels = 1;
    if (levels_.size() > 1) {
        double sum = 0, highest = 0;
        for (const Level& level : levels_) {
            sum += level.height;
            highest = std::max(highest, level.height);
        }
        levels = levels_.size();
        const double first = levels_[0].height;
        meanVolume_ *= static_cast<long double>(sum / static_cast<double>(levels) / first);
        const double wide = spread_ * first;
        const double aside = std::max(widest_.z * widest_.z - wide * wide, 0.0);
        widest_.z = std::sqrt(aside + highest * highest);
    }
    folded_ = sums.cells[1 - most] * levels;
    flat_ = sums.flat * levels;
    absent_ = sums.absent * levels;
}

void Mesh::setNodes(std::span<const glm::dvec3> nodes, const Box& box) {
    if (nodes.empty()) return;
    constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();
    constexpr double kMost = 0x1p100;  // no cell is so large
    nodes_.resize(nodes.size());
    inParts(nodes.size(), threadsFor(nodes.size(), 1 << 14), [&](std::size_t i, std::size_t last) {
        for (; i < last; ++i) {
            const glm::dvec3 at = (nodes[i] - origin_) / unit_;
            const glm::dvec3 away = glm::abs(at);
            const bool isNear = away.x < kMost && away.y < kMost && away.z < kMost;
            nodes_[i] = isNear ? glm::vec3(at) : glm::vec3(kNowhere);
        }
    });
    cornersBox_ = {glm::min(lo_, box.lo), glm::max(hi_, box.hi)};
}

glm::dvec3 Mesh::position(std::uint64_t index) const {
    return position(points_.data()[levels_.empty() ? index : index % stored_], index);
}

LowerTriangle<double> Mesh::cell(std::uint64_t index) const {
    const bool columns = levels_.size() > 1;
    const Point& point = points_.data()[columns ? index % stored_ : index];
    if (!point.hasCell() || point.turned() != turned_) return {};
    auto cell = point.cell().as<double>().scaled(unit_);
    // The steps to the sides lead along all coordinates, those to the levels along the third.
    if (columns) cell.diagonal.z = levels_[index / stored_].height;
    return cell;
}

Mesh::Stored Mesh::stored() const {
    return {{points_.data(), stored_}, levels_, origin_, unit_, turned_};
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
    add(mesh.about().apart, "they are corners of no cell");
    add(mesh.flat() - mesh.about().apart, "their cells have no volume");
    const auto addGuess = [&](std::uint64_t points, std::string_view what) {
        if (points > 0)
            notes.push_back(fmt::format("{} of {} points {}", points, mesh.count(), what));
    };
    addGuess(mesh.about().beside,
             "are corners of cells without a volume, too: they stand for the others");
    addGuess(mesh.about().oneSided,
             "have a neighbour without a place: their cells are as wide as to its other side");
    return notes;
}

std::uint64_t Mesh::bytes() const {
    return stored_ * sizeof(Point) + levels_.size() * sizeof(Level) +
           nodes_.size() * sizeof(nodes_[0]) + (solids_ ? solids_->bytes() : 0) +
           about_.types.size();
}

bool operator==(const Mesh& a, const Mesh& b) {
    const auto sameLevel = [](const Mesh::Level& one, const Mesh::Level& other) {
        return one.at == other.at && one.height == other.height;
    };
    const bool sameSolids =
        a.solids_ == b.solids_ || (a.solids_ && b.solids_ && *a.solids_ == *b.solids_);
    return sameSolids && a.about_ == b.about_ && a.size_ == b.size_ &&
           a.hasNeighbours_ == b.hasNeighbours_ && a.spread_ == b.spread_ &&
           a.period_ == b.period_ && a.origin_ == b.origin_ && a.unit_ == b.unit_ &&
           std::ranges::equal(a.levels_, b.levels_, sameLevel) &&
           a.nodes_.size() == b.nodes_.size() && a.stored_ == b.stored_ &&
           (a.nodes_.empty() || std::memcmp(a.nodes_.data(), b.nodes_.data(),
                                            a.nodes_.size() * sizeof(glm::vec3)) == 0) &&
           std::ranges::equal(a.stored().points, b.stored().points);
}

}  // namespace timeseries
