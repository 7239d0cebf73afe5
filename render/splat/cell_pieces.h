// What is drawn of a scene's cells: which of them, in which order, and of each what is to be seen.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "render/model/cell_splat.h"
#include "render/model/scene.h"
#include "render/points/view.h"
#include "render/splat/face_order.h"
#include "render/splat/solid_tets.h"
#include "render/together.h"
#include "timeseries/grid/pages.h"

namespace render {

// The layers, of so many, that a plane of these channels takes: from the first to before the
// second. All of them for Over and Count, else `layer`.
std::pair<std::size_t, std::size_t> layersOf(std::size_t count, Channels channels,
                                             std::size_t layer);
std::uint64_t cellCount(const Scene& scene, Channels channels, std::size_t layer);

// Of a mesh's cell, in axis coordinates.
glm::dvec3 middleOfCell(const Scene& scene, std::uint32_t cell);

// Of an upright grid, which one the eye is in, or beside.
glm::uvec3 cellOfEye(const Scene& scene, const View& view);

// An order by depth. What hides a part of a cell lies, along each axis, no farther from the eye's
// cell than it does and on the same side, and nearer along one: the sum of these distances is an
// order, in bricks of cells first, then in cells within a brick, of which each is passed in one go:
// their values lie together in memory. Any such order draws the same picture, for a ray meets its
// cells one by one.
//
// Where points lie one by one: by the distance of a cell's middle from the eye. Of neighbours of
// one shape the one in front is nearer; where cells lean, or grow, a few are out of order, which
// FaceOrder mends. The scene must outlive it then.
class CellRank {
 public:
    CellRank(const Scene& scene, const View& view);
    std::uint32_t operator()(const glm::uvec3& cell) const {
        std::uint32_t brick = 0, within = 0;
        for (int a = 0; a < 3; ++a) {
            const auto& [at, inside] = places_[static_cast<std::size_t>(a)][cell[a]];
            brick += at;
            within += inside;
        }
        return first_[brick] + within;
    }
    std::uint32_t operator()(std::uint32_t cell) const {
        return scene_ ? ofMiddle(middleOfCell(*scene_, cell)) : (*this)(along_(cell));
    }
    // Of a mesh, that of a cell whose middle is there.
    std::uint32_t ofMiddle(const glm::dvec3& middle) const;
    std::size_t count() const { return count_; }  // all less
    const View& view() const { return view_; }
    const glm::ivec3& eye() const { return eye_; }  // of an upright grid, the eye's cell

 private:
    void takeDistances(const Scene& scene, const View& view);
    void takeBricks(const Scene& scene, const View& view);

    // Of a cell's place along an axis: its brick's, times what the axes before it have, and how far
    // it lies behind that one's first.
    struct Place {
        std::uint32_t brick, within;
    };

    glm::uvec3 size_;
    timeseries::IndicesAlong along_;
    glm::ivec3 eye_{0};
    std::array<std::vector<Place>, 3> places_;
    std::vector<std::uint32_t> first_;  // of a brick, its least rank
    std::size_t count_ = 0;
    View view_;
    const Scene* scene_ = nullptr;  // of a mesh
    glm::dvec3 from_{0};
    double nearest_ = 0, perDistance_ = 0;
};

// A counting sort by rank, whose two passes may be made a little at a time: every rank is counted,
// then placed; those of one rank stay as they come.
class NearestFirst {
 public:
    explicit NearestFirst(std::size_t ranks) : next_(ranks) {}
    explicit NearestFirst(const CellRank& rank) : NearestFirst(rank.count()) {}
    void count(std::size_t rank) { ++next_[rank]; }
    void allCounted() { allCounted({this, 1}); }
    // Of one sort, each with some of what is sorted: those of one rank part by part.
    static void allCounted(std::span<NearestFirst> parts) {
        std::size_t first = 0;
        for (std::size_t rank = 0; rank < parts.front().next_.size(); ++rank)
            for (NearestFirst& part : parts) first += std::exchange(part.next_[rank], first);
    }
    std::size_t place(std::size_t rank) { return next_[rank]++; }

 private:
    std::vector<std::size_t> next_;
};

// The cells of a plane, each that is looked at, listed a slice at a time: layer by layer as their
// candidates lie, or the nearest first, those of a mesh in FaceOrder unless the scene is by
// middles. The scene and the rank must outlive it.
class CellList {
 public:
    CellList(const Scene& scene, Channels channels, std::size_t layer,
             const CellRank* nearestFirst = nullptr, unsigned threads = sharingThreads());
    // Goes through so many, or a few more, or what is left; all are gone through once, or twice to
    // be put in order. Returns how many.
    std::uint64_t goOn(std::uint64_t cells);
    bool done() const {
        return listed_ == count_ && (rank_ == nullptr || placed_ == count_) &&
               (!byFaces_ || byFaces_->done());
    }
    // REQUIRES: done().
    std::span<const CellOfLayer> cells() const { return {cells_.data(), count_}; }

 private:
    // What a thread goes through: places in the list, and where it has come to.
    struct Part {
        std::uint64_t next, end;
        std::size_t layer, run = 0;
        std::uint64_t inRun = 0;
    };
    std::vector<Part> partsFrom(std::size_t layer) const;
    template <typename Use>
    std::uint64_t pass(std::vector<Part>& parts, std::uint64_t cells, const Use& use);
    template <typename Use>
    void pass(Part& part, std::uint64_t cells, const Use& use) const;
    std::uint64_t list(std::uint64_t cells);
    void ranksToPlaces();
    std::uint64_t place(std::uint64_t cells);

    const Scene& scene_;
    std::uint64_t count_, listed_ = 0, placed_ = 0;
    unsigned sharing_, threads_;  // that may, and that are worth it
    std::vector<Part> listing_, placing_;
    const CellRank* rank_;                    // where they are to be put in order
    std::vector<NearestFirst> orders_;        // of each part, then, unless they are few
    timeseries::Pages<std::uint32_t> ranks_;  // of few, when all are listed, their places
    timeseries::Pages<CellOfLayer> cells_;
    std::optional<FaceOrder> byFaces_;  // of a mesh, when they have been placed
};
// All of them at once.
std::vector<CellOfLayer> cellsOf(const Scene& scene, Channels channels, std::size_t layer,
                                 const CellRank* nearestFirst = nullptr);

// The two ends of a cell along an axis, in axis coordinates: points, or half a cell beyond them.
std::pair<double, double> endsAlong(const PlacedPoints& placed, std::size_t axis,
                                    std::uint32_t cell);

// Of a cell, of which all is seen, or some of its octants: those nearest to points that are there,
// and inside the clip box.
struct SeenOctants {
    ValuedCell cell{};
    unsigned octants = 0;  // a bit each, numbered x fastest
};
SeenOctants seenOctants(const Scene& scene, std::uint32_t number);
// A corner of an octant, in its cell, [0, 1] along each axis.
inline glm::dvec3 placeInOctant(unsigned octant, unsigned corner) {
    const auto side = [](unsigned bits) { return glm::dvec3(bits & 1, bits >> 1 & 1, bits >> 2); };
    return 0.5 * (side(octant) + side(corner));
}
// One of them.
ValuedCell octantOf(const ValuedCell& cell, unsigned octant);

// Calls use(piece, octant) for what is to be seen of a cell: all of it (octant kWholeCell), or
// octants.
inline constexpr unsigned kWholeCell = 8;
template <typename Use>
void forEachPiece(const Scene& scene, std::uint32_t number, const Use& use) {
    SeenOctants seen = seenOctants(scene, number);
    if (seen.octants == 255) return use(seen.cell, kWholeCell);
    for (unsigned o = 0; o < 8; ++o) {
        if ((seen.octants >> o & 1) == 0) continue;
        ValuedCell piece = octantOf(seen.cell, o);
        use(piece, o);
    }
}

// The tetrahedra of several cells of a mesh, with each range of their layers: use(tet, of); from an
// eye that is given, those of a cell each before what it hides. Only of what may be seen:
// mayBeSeen.within(how far at most)(from a place), and mayBeSeen(places that it lies between).
template <typename MayBeSeen, typename Use>
void forEachTet(const Scene& scene, std::span<const CellOfLayer> cells, const glm::dvec3* eye,
                const MayBeSeen& mayBeSeen, const Use& use) {
    const double unit = scene.gradients ? scene.gradients->range() : 1;
    withTets(scene, scene.cells->field(), [&](const auto& tets) {
        const auto isNear = mayBeSeen.within(tets.reach());
        for (const CellOfLayer& of : cells) {
            if (!isNear(tets.about(of.cell))) continue;
            tets.forEachTet(of.cell, eye, mayBeSeen, [&](const MeshCells::Tetrahedron& tet) {
                for (const auto& range : scene.layers[of.layer].cells.ranges)
                    use({tet.at, tet.values, range.lo, range.hi, scene.opacityPer,
                         scene.gradients ? &tet.gradients : nullptr, unit},
                        of);
            });
        }
    });
}
struct SeenAnywhere {
    bool operator()(const auto&) const { return true; }
    SeenAnywhere within(const glm::dvec3&) const { return {}; }
};
template <typename Use>
void forEachTet(const Scene& scene, std::span<const CellOfLayer> cells, const glm::dvec3* eye,
                const Use& use) {
    forEachTet(scene, cells, eye, SeenAnywhere(), use);
}

// The octants of several cells, with each range of their layers: use(piece, of, octant).
template <typename Use>
void forEachPiece(const Scene& scene, std::span<const CellOfLayer> cells, const Use& use) {
    constexpr std::size_t kAhead = 16;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (i + kAhead < cells.size()) scene.cells->prefetch(cells[i + kAhead].cell);
        const CellOfLayer& of = cells[i];
        forEachPiece(scene, of.cell, [&](ValuedCell& piece, unsigned octant) {
            for (const auto& range : scene.layers[of.layer].cells.ranges) {
                piece.lo = range.lo;
                piece.hi = range.hi;
                use(piece, of, octant);
            }
        });
    }
}

}  // namespace render
