// Points that lie one by one, and the cells that they stand for. Pure geometry: no values.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "timeseries/grid/curvilinear.h"
#include "timeseries/grid/lower_triangle.h"
#include "timeseries/grid/mesh_about.h"
#include "timeseries/grid/pages.h"
#include "timeseries/grid/shaped_point.h"

namespace timeseries {

class SolidCells;  // timeseries/grid/solid_cells.h

// Where a point lies, and the rows of any J whose columns are the sides of its cell: one along each
// coordinate of the file's space.
// Its volume is |det J| / 2^widened: timeseries/grid/axis_rings.h.
struct MeshPoint {
    glm::dvec3 at;
    std::array<glm::dvec3, 3> rows;
    unsigned widened = 0;
};

class Mesh {
 public:
    // A curvilinear grid. Throws std::invalid_argument when the places are not as many as `size`
    // says, none is finite, or no cell of them has a volume.
    explicit Mesh(const MeshPlaces& places);
    // One whose places and cells are known, x fastest, where neighbours are at most `longestWay`
    // apart along each coordinate. `between` and `point` as below.
    Mesh(const std::array<std::size_t, 3>& size, std::span<const glm::dvec3> between,
         const glm::dvec3& longestWay, const std::function<MeshPoint(std::uint64_t index)>& point);
    // Points without neighbours, as many as `count`, which lie between these, with splats that are
    // `spread` times as wide as the cells. `point` is called by several threads at once, and what
    // it throws is thrown. With levels, as MeshPlaces has them, each is the column of points at
    // these, of cells as high as the levels are apart; those of `point` are as high as the first.
    Mesh(std::uint64_t count, std::span<const glm::dvec3> between, double spread,
         const std::function<MeshPoint(std::uint64_t index)>& point,
         const std::vector<double>& levels = {});
    // As many levels of so many columns, each point of which is told: index % columns is its
    // column.
    Mesh(std::uint64_t columns, std::size_t levels, std::span<const glm::dvec3> between,
         double spread, const std::function<MeshPoint(std::uint64_t index)>& point);
    // The same of a function that tells several at once, kMostAtOnce or fewer from `first` on.
    using MeshPoints = std::function<void(std::uint64_t first, std::span<MeshPoint> points)>;
    static constexpr std::size_t kMostAtOnce = 64;
    Mesh(std::uint64_t count, std::span<const glm::dvec3> between, double spread,
         const MeshPoints& points, const std::vector<double>& levels = {});

    // Points along the indices i, j and k: those before and after a point are its neighbours, if
    // there are neighbours.
    const std::array<std::size_t, 3>& size() const { return size_; }
    bool hasNeighbours() const { return hasNeighbours_; }
    // Between points without neighbours, where the file says so; null: nothing is known.
    const std::shared_ptr<const SolidCells>& solids() const { return solids_; }
    // By who made it, before others have it. REQUIRES: no neighbours. `period` as MeshPlaces has
    // it.
    void setSolids(std::shared_ptr<const SolidCells> solids,
                   const glm::dvec3& period = glm::dvec3(0)) {
        solids_ = std::move(solids);
        period_ = period;
    }
    // Likewise, after that, where the solids have middles: where their nodes lie, in the file's
    // space, those that cells have in this box; of others none. REQUIRES: no levels.
    struct Box {
        glm::dvec3 lo, hi;
    };
    void setNodes(std::span<const glm::dvec3> nodes, const Box& box);
    // Likewise. REQUIRES: `types` of all points, or of none.
    void setAbout(MeshAbout about) { about_ = std::move(about); }
    const MeshAbout& about() const { return about_; }
    // As MeshPlaces has it.
    const glm::dvec3& period() const { return period_; }
    std::uint64_t count() const;
    // In the file's space: to a 2^24th of the mesh's extent. Not finite where the point has none.
    glm::dvec3 position(std::uint64_t index) const;
    // As it is kept, for who works position() and cell() out elsewhere. Relative to the origin, in
    // the mesh's units, powers of two near the extent. Of columns the cells of all levels are alike
    // but for their height.
    using Point = ShapedPoint;
    // The same of what is kept of it.
    glm::dvec3 position(const Point& point, std::uint64_t index) const;
    // Of a corner of solids(): a point, or of those that are numbered on from the last a node.
    std::uint64_t corners() const { return count() + nodes_.size(); }
    glm::dvec3 cornerPosition(std::uint64_t corner) const {
        if (nodes_.empty() || corner < stored_) return position(corner);
        return origin_ + unit_ * glm::dvec3(nodes_[corner - stored_]);
    }
    // The least and greatest of each coordinate of points, and of nodes that cells have.
    Box cornersBox() const { return nodes_.empty() ? Box{lo_, hi_} : cornersBox_; }
    // Its least and greatest along a coordinate.
    struct Ends {
        double least, most;
    };
    Ends ends(int axis) const {
        const Box box = cornersBox();
        return {box.lo[axis], box.hi[axis]};
    }
    // The shape of the cell that the point stands for, `spread` times as wide. Zero where nothing
    // is drawn: no place, no volume, or folded, turned inside out beside most of the others.
    LowerTriangle<double> cell(std::uint64_t index) const;
    double volume(std::uint64_t index) const { return volumeOf(cell(index), index); }
    // The same of that cell in other units: volumes of small and large extents leave the doubles.
    double volumeOf(const LowerTriangle<double>& cell, std::uint64_t index) const {
        return std::ldexp(std::abs(cell.determinant()) * volumePerDeterminant(),
                          -static_cast<int>(widened(index)));
    }
    unsigned widened(std::uint64_t index) const {  // as MeshPoint has it
        return points_.data()[levels_.empty() ? index : index % stored_].widened();
    }
    double spread() const { return spread_; }
    // The volume of a cell that is not widened over its determinant: columns of several levels are
    // as high as these are apart.
    double volumePerDeterminant() const {
        return 1 / (spread_ * spread_ * (levels_.size() > 1 ? 1 : spread_));
    }
    // Begins to load what these are made of: points that are asked for by value lie anywhere.
    void prefetch(std::uint64_t index) const {
        asm volatile("");  // or compilers take this for a function without an effect
        const Point* const at = points_.data() + (levels_.empty() ? index : index % stored_);
        __builtin_prefetch(at);
        __builtin_prefetch(reinterpret_cast<const char*>(at + 1) - 1);
    }

    // The least and greatest of each coordinate.
    const glm::dvec3& lo() const { return lo_; }
    const glm::dvec3& hi() const { return hi_; }
    // Of the cells that are drawn. Long: volumes of small and large extents leave the doubles.
    long double meanVolume() const { return meanVolume_; }
    // Lengths of the rows of cell(), at most: a cell's splat reaches no farther along a coordinate
    // than this, times its radius.
    const glm::dvec3& widest() const { return widest_; }
    // How far neighbours are apart along each coordinate, at most, the shorter way round; of points
    // without neighbours 0.
    const glm::dvec3& longestWay() const { return longestWay_; }
    std::uint64_t folded() const { return folded_; }  // points whose cells are
    std::uint64_t flat() const { return flat_; }      // whose cells have no volume
    std::uint64_t absent() const { return absent_; }  // that have no place
    std::uint64_t bytes() const;

    friend bool operator==(const Mesh& a, const Mesh& b);

    // In the file's units, from the origin.
    struct Level {
        double at, height;
    };
    struct Stored {
        std::span<const Point> points;  // [j][i] where there are levels
        std::span<const Level> levels;  // heights stand for those of cells where there are several
        glm::dvec3 origin, unit;
        bool turned;  // that the cells are which are drawn
    };
    Stored stored() const;

 private:
    struct Sums;
    void takeColumns(std::uint64_t stored, std::span<const glm::dvec3> between,
                     const std::vector<double>& levels, const MeshPoints& points);
    void takeUnits(std::span<const glm::dvec3> at, double lowest, double highest);
    void takeLevels(const std::vector<double>& levels);
    void takePoints(std::uint64_t count, const MeshPoints& points);
    void takeSums(const Sums& sums);

    std::array<std::size_t, 3> size_;
    bool hasNeighbours_ = true;
    std::shared_ptr<const SolidCells> solids_;
    MeshAbout about_;
    glm::dvec3 period_{0};
    double spread_ = 1;
    glm::dvec3 origin_{0}, unit_{1};
    std::uint64_t stored_ = 0;
    Pages<Point> points_;  // [stored_]
    std::vector<Level> levels_;
    PageVector<glm::vec3> nodes_;  // relative to the origin, in the mesh's units
    Box cornersBox_{};             // if there are any
    glm::dvec3 lo_{0}, hi_{0}, widest_{0}, longestWay_{0};
    long double meanVolume_ = 0;
    bool turned_ = false;  // that most cells are
    std::uint64_t folded_ = 0, flat_ = 0, absent_ = 0;
};

inline glm::dvec3 Mesh::position(const Point& point, std::uint64_t index) const {
    const glm::dvec3 at = origin_ + unit_ * glm::dvec3(point.at());
    return levels_.empty() ? at : at + glm::dvec3(0, 0, levels_[index / stored_].at);
}

// What of a mesh is not drawn as it is, a sentence each.
std::vector<std::string> notesOf(const Mesh& mesh);

}  // namespace timeseries
