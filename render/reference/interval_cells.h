// What of each cell lies in ranges of a field that is trilinear between its points: the interval
// volume, exactly, cell by cell. The definition that CellSum approximates and shares with it:
// constant half cells beyond the outermost points; a missing corner has the mean of the cell's
// others, and what is nearest to it, or to a point beside the clip box, is nowhere.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "render/model/scene.h"
#include "render/points/placed_points.h"
#include "render/reference/cubic_on_line.h"
#include "render/together.h"
#include "timeseries/index/field_slabs.h"
#include "timeseries/index/range_set.h"

namespace render {

// The slab's values must outlive it; only its cells may be asked for.
class IntervalCells {
 public:
    // For every ray of a picture each cell is looked at once, before; for a few rays, when one
    // comes to it. Memory: a byte a cell, or none.
    enum class Look { Before, WhenAsked };
    // `ranges`: disjoint, as timeseries::betweenPoints gives them.
    // REQUIRES of Look::Before: all cells.
    IntervalCells(const timeseries::FieldSlab& slab, const IndexBox& clip,
                  std::vector<timeseries::Interval<double>> ranges,
                  unsigned threads = sharingThreads(), Look look = Look::Before,
                  OpacityPer per = OpacityPer::Length);

    enum class Kind : std::uint8_t { Nothing, Whole, Part };
    Kind kind(const glm::uvec3& cell) const {
        if (!kinds_.empty()) return kinds_[numberOf(cell)];
        return isBeyond(cell) ? Kind::Nothing : kindOf(cornersOf(cell));
    }
    // What rays of one thread have lately met: rays of a pixel pass the same cells.
    class Lately;
    Kind kind(const glm::uvec3& cell, Lately& lately) const;
    void addParts(const glm::uvec3& cell, const glm::dvec3& from, const glm::dvec3& to,
                  std::vector<LinePart>& into, Lately& lately) const;
    // Of crossings, W of the line between two places of the cell, of which the length alone makes
    // so much. REQUIRES: made for OpacityPer::Crossing.
    double passage(const glm::uvec3& cell, const glm::dvec3& from, const glm::dvec3& to,
                   double whole, Lately& lately) const;
    // The parts of that line which lie in a range, and how wide that is in a measure of the cell's
    // own, to ask what passage() has of a line in it; infinite where only lengths count.
    struct Passage {
        LinePart part;
        double width;
    };
    void addPassages(const glm::uvec3& cell, const glm::dvec3& from, const glm::dvec3& to,
                     std::vector<Passage>& into, Lately& lately) const;
    double passageInside(const glm::uvec3& cell, const glm::dvec3& from, const glm::dvec3& to,
                         double whole, double width, Lately& lately) const;
    // Adds the parts, of [0, 1], of the line between two places of the cell (in units of it) on
    // which the field is in the ranges. Disjoint.
    void addParts(const glm::uvec3& cell, const glm::dvec3& from, const glm::dvec3& to,
                  std::vector<LinePart>& into) const;
    // The field in a cell that has a point which is not missing, at places in it.
    class CellField {
     public:
        double valueAt(const glm::dvec3& place) const;
        bool isEven() const { return least_ == greatest_; }

     private:
        friend class IntervalCells;
        std::array<double, 8> values_;
        double least_, greatest_;
    };
    // REQUIRES: kind(cell) is not Nothing.
    CellField fieldIn(const glm::uvec3& cell, Lately& lately) const;
    double valueAt(const glm::uvec3& cell, const glm::dvec3& place) const {
        return fieldOf(cornersOf(cell)).valueAt(place);
    }

 private:
    struct Corners {
        std::array<double, 8> values{};  // no NaN unless all are
        double least, greatest;          // of them
        unsigned octants = 0;            // bit c: what is nearest to corner c is somewhere
        std::array<double, 8> scaled{};  // the values from 0 to 1, of a part
    };
    struct Cut {
        double lo, hi, width;
    };
    // use(cut) for the ranges that a cell's values reach or touch, on their own scale.
    template <typename Use>
    void forEachCut(const Corners& corners, const Use& use) const;
    struct Met;
    const Met& meet(const glm::uvec3& cell, Lately& lately) const;
    Corners cornersOf(const glm::uvec3& cell) const;
    static CellField fieldOf(const Corners& corners);
    // Whether all corners have values, and none reaches into a range: of most cells, and soon told.
    bool isBeyond(const glm::uvec3& cell) const;
    void addParts(const Corners& corners, const glm::dvec3& from, const glm::dvec3& to,
                  std::vector<LinePart>& into) const;
    // Of a piece of the line, [0, 1].
    void addParts(const Corners& corners, const glm::dvec3& from, const glm::dvec3& to,
                  const LinePart& piece, std::vector<LinePart>& into) const;
    double passage(const Corners& corners, const glm::dvec3& from, const glm::dvec3& to,
                   double whole) const;
    Kind kindOf(const Corners& corners) const;
    // Of a cell that is a part.
    Corners scaledCornersOf(const glm::uvec3& cell) const;
    std::size_t numberOf(const glm::uvec3& cell) const {
        return cell.x + std::size_t{size_.x} * (cell.y + std::size_t{size_.y} * cell.z);
    }

    timeseries::FieldSlab slab_;
    IndexBox clip_;
    std::vector<timeseries::Interval<double>> ranges_;
    OpacityPer per_;
    glm::uvec3 size_{0};  // cells
    std::vector<Kind> kinds_;
};

struct IntervalCells::Met {
    std::size_t number = std::numeric_limits<std::size_t>::max();
    Kind kind = Kind::Nothing;
    Corners corners{};  // unless Nothing
};

inline IntervalCells::Kind IntervalCells::kind(const glm::uvec3& cell, Lately& lately) const {
    return kinds_.empty() ? meet(cell, lately).kind : kinds_[numberOf(cell)];
}

// Of one IntervalCells.
class IntervalCells::Lately {
 private:
    friend class IntervalCells;
    static constexpr int kBits = 12;  // more than a pixel's rays meet in a large field
    std::vector<Met> met_ = std::vector<Met>(std::size_t{1} << kBits);
    std::vector<LinePart> parts_;  // of one call
};

}  // namespace render
