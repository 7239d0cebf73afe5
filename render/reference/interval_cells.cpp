#include "render/reference/interval_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <utility>

namespace render {
namespace {

using timeseries::Interval;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr unsigned kAllOctants = 255;
// Of a cell's change: a range of one value is crossed where the field passes it, and in none of two
// cells more than in both.
constexpr double kThinnestPassage = 1e-6;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

double finiteOrNan(double v) { return std::isfinite(v) ? v : kNan; }

// Of a point at the cell's corner on a side, along an axis of so many points.
std::uint32_t pointBeside(std::uint32_t cell, std::uint32_t side, std::uint32_t points) {
    return std::clamp(cell + side, 1u, points) - 1;
}

// A scale on which a cell's values go from 0 to 1, however large, small or near each other they
// are. REQUIRES: least < greatest.
class OwnScale {
 public:
    OwnScale(double least, double greatest)
        : exponent_(-std::ilogb(std::max(std::abs(least), std::abs(greatest)))),
          least_(std::ldexp(least, exponent_)),
          extent_(std::ldexp(greatest, exponent_) - least_) {}
    double operator()(double value) const {
        return (std::ldexp(value, exponent_) - least_) / extent_;
    }

 private:
    int exponent_;
    double least_, extent_;
};

// Where a line from a to b, places in a cell, passes from one octant to another: [0, 1] in pieces.
struct Octants {
    std::array<double, 5> at{0, 1, 1, 1, 1};
    std::size_t count = 1;

    Octants(const glm::dvec3& a, const glm::dvec3& b) {
        for (int axis = 0; axis < 3; ++axis) {
            if ((a[axis] < 0.5) == (b[axis] < 0.5)) continue;
            at[count] = (0.5 - a[axis]) / (b[axis] - a[axis]);
            for (std::size_t i = count++; at[i] < at[i - 1]; --i) std::swap(at[i], at[i - 1]);
        }
    }
};

// Each corner without a value has the mean of those that have one and are the fewest edges away.
void fillGaps(std::array<double, 8>& values) {
    const std::array<double, 8> known = values;
    for (unsigned c = 0; c < 8; ++c)
        for (int edges = 1; std::isnan(values[c]) && edges <= 3; ++edges) {
            double quarters = 0, least = kInfinity, greatest = -kInfinity;
            int count = 0;
            for (unsigned other = 0; other < 8; ++other) {
                const double v = known[other];
                if (std::isnan(v) || std::popcount(c ^ other) != edges) continue;
                quarters += v / 4;
                least = std::min(least, v);
                greatest = std::max(greatest, v);
                ++count;
            }
            if (count > 0) values[c] = std::clamp(quarters * (4.0 / count), least, greatest);
        }
}

unsigned octantOf(const glm::dvec3& place) {
    return (place.x < 0.5 ? 0u : 1u) + (place.y < 0.5 ? 0u : 2u) + (place.z < 0.5 ? 0u : 4u);
}

// use(piece) for those of the line between two places that lie in one of these octants.
template <typename Use>
void forEachPieceOf(unsigned octants, const glm::dvec3& from, const glm::dvec3& to,
                    const Use& use) {
    if (octants == kAllOctants) return use(LinePart{0, 1});
    const Octants pieces(from, to);
    for (std::size_t i = 0; i < pieces.count; ++i) {
        const LinePart piece{pieces.at[i], pieces.at[i + 1]};
        if (octants >> octantOf(glm::mix(from, to, 0.5 * (piece.from + piece.to))) & 1) use(piece);
    }
}

}  // namespace

IntervalCells::IntervalCells(const timeseries::FieldSlab& slab, const IndexBox& clip,
                             std::vector<Interval<double>> ranges, unsigned threads, Look look,
                             OpacityPer per)
    : slab_(slab),
      clip_(clip),
      ranges_(std::move(ranges)),
      per_(per),
      size_(glm::uvec3(slab.points[0], slab.points[1], slab.points[2]) + 1u) {
    if (look == Look::WhenAsked) return;
    kinds_.resize(std::size_t{size_.x} * size_.y * size_.z);
    inParts(std::size_t{size_.y} * size_.z, threads, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row) {
            glm::uvec3 cell(timeseries::indicesOf(row * size_.x, glm::vec<3, std::size_t>(size_)));
            for (; cell.x < size_.x; ++cell.x) kinds_[numberOf(cell)] = kindOf(cornersOf(cell));
        }
    });
}

IntervalCells::Corners IntervalCells::cornersOf(const glm::uvec3& cell) const {
    const glm::uvec3 points = size_ - 1u;
    const std::vector<bool>& missing = slab_.values.missing;
    Corners out{.least = kInfinity, .greatest = -kInfinity};
    std::visit(
        [&](const auto& values) {
            for (unsigned c = 0; c < 8; ++c) {
                const glm::uvec3 p(pointBeside(cell.x, c & 1, points.x),
                                   pointBeside(cell.y, c >> 1 & 1, points.y),
                                   pointBeside(cell.z, c >> 2, points.z));
                const std::size_t i = slab_.indexOf(p.x, p.y, p.z);
                const bool isMissing = !missing.empty() && missing[i];
                const double v = isMissing ? kNan : finiteOrNan(static_cast<double>(values[i]));
                out.values[c] = v;
                if (std::isnan(v)) continue;
                out.least = std::min(out.least, v);
                out.greatest = std::max(out.greatest, v);
                if (clip_.holds(p)) out.octants |= 1u << c;
            }
        },
        slab_.values.values);
    fillGaps(out.values);
    return out;
}

IntervalCells::Corners IntervalCells::scaledCornersOf(const glm::uvec3& cell) const {
    Corners corners = cornersOf(cell);
    if (!(corners.least < corners.greatest)) return corners;
    const OwnScale scale(corners.least, corners.greatest);
    for (std::size_t c = 0; c < 8; ++c) corners.scaled[c] = scale(corners.values[c]);
    return corners;
}

bool IntervalCells::isBeyond(const glm::uvec3& cell) const {
    if (!slab_.values.missing.empty()) return false;
    const glm::uvec3 points = size_ - 1u;
    const glm::uvec3 from = glm::max(cell, 1u) - 1u, to = glm::min(cell + 1u, points) - 1u;
    return std::visit(
        [&]<typename T>(const std::vector<T>& values) {
            T least = std::numeric_limits<T>::max(), greatest = std::numeric_limits<T>::lowest();
            double sum = 0;  // finite where all are, or too large to tell
            for (const unsigned z : {from.z, to.z})
                for (const unsigned y : {from.y, to.y}) {
                    const T* row = &values[slab_.indexOf(0, y, z)];
                    for (const T v : {row[from.x], row[to.x]}) {
                        least = std::min(least, v);
                        greatest = std::max(greatest, v);
                        if constexpr (std::is_floating_point_v<T>) sum += static_cast<double>(v);
                    }
                }
            if (!std::isfinite(sum)) return false;
            const auto lo = static_cast<double>(least), hi = static_cast<double>(greatest);
            return std::ranges::none_of(ranges_, [&](const Interval<double>& range) {
                return lo <= range.hi && hi >= range.lo;
            });
        },
        slab_.values.values);
}

IntervalCells::Kind IntervalCells::kindOf(const Corners& corners) const {
    if (corners.octants == 0) return Kind::Nothing;
    Kind kind = Kind::Nothing;
    for (const Interval<double>& range : ranges_) {
        if (corners.least >= range.lo && corners.greatest <= range.hi)
            return corners.octants == kAllOctants ? Kind::Whole : Kind::Part;
        // What only touches a range has no length in it, but may have half of a crossing.
        if (per_ == OpacityPer::Crossing ? corners.least <= range.hi && corners.greatest >= range.lo
                                         : corners.least < range.hi && corners.greatest > range.lo)
            kind = Kind::Part;
    }
    return kind;
}

const IntervalCells::Met& IntervalCells::meet(const glm::uvec3& cell, Lately& lately) const {
    const std::size_t number = numberOf(cell);
    constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15U;  // Knuth's multiplicative hash
    Met& met = lately.met_[number * kGolden >> (64 - Lately::kBits)];
    if (met.number == number) return met;
    met.number = number;
    met.kind = kind(cell);
    if (met.kind != Kind::Nothing) met.corners = scaledCornersOf(cell);
    return met;
}

void IntervalCells::addParts(const glm::uvec3& cell, const glm::dvec3& from, const glm::dvec3& to,
                             std::vector<LinePart>& into, Lately& lately) const {
    const Met& met = meet(cell, lately);
    if (met.kind == Kind::Part) addParts(met.corners, from, to, into);
}

void IntervalCells::addParts(const glm::uvec3& cell, const glm::dvec3& from, const glm::dvec3& to,
                             std::vector<LinePart>& into) const {
    const Corners corners = scaledCornersOf(cell);
    if (kindOf(corners) != Kind::Nothing) addParts(corners, from, to, into);
}

void IntervalCells::addParts(const Corners& corners, const glm::dvec3& from, const glm::dvec3& to,
                             std::vector<LinePart>& into) const {
    forEachPieceOf(corners.octants, from, to,
                   [&](const LinePart& piece) { addParts(corners, from, to, piece, into); });
}

void IntervalCells::addParts(const Corners& corners, const glm::dvec3& from, const glm::dvec3& to,
                             const LinePart& piece, std::vector<LinePart>& into) const {
    if (corners.least == corners.greatest) {
        into.push_back(piece);
        return;
    }
    const std::size_t before = into.size();
    const OwnScale scale(corners.least, corners.greatest);
    const Cubic cubic =
        cubicOnLine(corners.scaled, glm::mix(from, to, piece.from), glm::mix(from, to, piece.to));
    for (const Interval<double>& range : ranges_) {
        if (!(corners.least < range.hi && corners.greatest > range.lo)) continue;
        // An end that no corner is beyond is left out: rounding must not cross it.
        addPartsWithin(cubic, corners.least < range.lo ? scale(range.lo) : -kInfinity,
                       corners.greatest > range.hi ? scale(range.hi) : kInfinity, into);
    }
    const double length = piece.to - piece.from;
    for (std::size_t i = before; i < into.size(); ++i)
        into[i] = {piece.from + length * into[i].from, piece.from + length * into[i].to};
}

double IntervalCells::passage(const glm::uvec3& cell, const glm::dvec3& from, const glm::dvec3& to,
                              double whole, Lately& lately) const {
    const Met& met = meet(cell, lately);
    if (met.kind == Kind::Nothing) return 0;
    double sum = 0;
    forEachPieceOf(met.corners.octants, from, to, [&](const LinePart& piece) {
        sum += passage(met.corners, glm::mix(from, to, piece.from), glm::mix(from, to, piece.to),
                       whole * (piece.to - piece.from));
    });
    return sum;
}

template <typename Use>
void IntervalCells::forEachCut(const Corners& corners, const Use& use) const {
    const OwnScale scale(corners.least, corners.greatest);
    for (const Interval<double>& range : ranges_) {
        if (!(corners.least <= range.hi && corners.greatest >= range.lo)) continue;
        double lo = scale(range.lo), hi = scale(range.hi);
        const double width = std::max(hi - lo, kThinnestPassage);
        if (hi - lo < width) {
            const double middle = 0.5 * (lo + hi);
            lo = middle - 0.5 * width;
            hi = middle + 0.5 * width;
        } else {  // as of parts
            if (corners.least >= range.lo) lo = -kInfinity;
            if (corners.greatest <= range.hi) hi = kInfinity;
        }
        use(Cut{lo, hi, width});
    }
}

double IntervalCells::passage(const Corners& corners, const glm::dvec3& from, const glm::dvec3& to,
                              double whole) const {
    if (corners.least == corners.greatest) return whole;
    const Cubic cubic = cubicOnLine(corners.scaled, from, to);
    double sum = 0;
    forEachCut(corners, [&](const Cut& cut) {
        sum += passageWithin(cubic, cut.lo, cut.hi, cut.width, whole);
    });
    return sum;
}

void IntervalCells::addPassages(const glm::uvec3& cell, const glm::dvec3& from,
                                const glm::dvec3& to, std::vector<Passage>& into,
                                Lately& lately) const {
    const Met& met = meet(cell, lately);
    const Kind kind = met.kind;
    const Corners& corners = met.corners;
    std::vector<LinePart>& parts = lately.parts_;
    parts.clear();
    if (kind == Kind::Nothing) return;
    if (per_ == OpacityPer::Length) {
        if (kind == Kind::Whole) parts.push_back({0, 1});
        if (kind == Kind::Part) addParts(corners, from, to, parts);
        for (const LinePart& part : parts) into.push_back({part, kInfinity});
        return;
    }
    forEachPieceOf(corners.octants, from, to, [&](const LinePart& piece) {
        if (corners.least == corners.greatest) return into.push_back({piece, kInfinity});
        const Cubic cubic = cubicOnLine(corners.scaled, glm::mix(from, to, piece.from),
                                        glm::mix(from, to, piece.to));
        forEachCut(corners, [&](const Cut& cut) {
            parts.clear();
            addPartsWithin(cubic, cut.lo, cut.hi, parts);
            for (const LinePart& part : parts)
                into.push_back({{std::lerp(piece.from, piece.to, part.from),
                                 std::lerp(piece.from, piece.to, part.to)},
                                cut.width});
        });
    });
}

double IntervalCells::passageInside(const glm::uvec3& cell, const glm::dvec3& from,
                                    const glm::dvec3& to, double whole, double width,
                                    Lately& lately) const {
    if (!std::isfinite(width)) return whole;
    return passageWithin(cubicOnLine(meet(cell, lately).corners.scaled, from, to), -kInfinity,
                         kInfinity, width, whole);
}

IntervalCells::CellField IntervalCells::fieldIn(const glm::uvec3& cell, Lately& lately) const {
    return fieldOf(meet(cell, lately).corners);
}

IntervalCells::CellField IntervalCells::fieldOf(const Corners& corners) {
    CellField field;
    field.values_ = corners.values;
    field.least_ = corners.least;
    field.greatest_ = corners.greatest;
    return field;
}

double IntervalCells::CellField::valueAt(const glm::dvec3& place) const {
    double sum = 0;
    for (unsigned c = 0; c < 8; ++c)
        sum += values_[c] * (c & 1 ? place.x : 1 - place.x) * (c & 2 ? place.y : 1 - place.y) *
               (c & 4 ? place.z : 1 - place.z);
    return std::clamp(sum, least_, greatest_);
}

}  // namespace render
