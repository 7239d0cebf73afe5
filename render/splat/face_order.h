// Cells of a mesh put in the order in which they hide each other.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

#include "render/model/scene.h"
#include "render/splat/mesh_cells.h"
#include "timeseries/grid/pages.h"

namespace render {

struct CellOfLayer {
    std::uint32_t cell;
    std::uint8_t layer;
};

// Of two cells with a face between them the one on the eye's side of it hides the other (Williams,
// "Visibility ordering meshed polyhedra", 1992): whatever shapes they have, that is exact, where
// the distance of a cell's middle is not. A face that is not flat is the triangles that cells part
// it into, and the eye is on the side that most of what it sees of them faces.
//
// Each cell of the list is passed after those in front of it that it shares a face with, and these
// after theirs; cells that no faces join stay as they came, and so does one of a ring of cells of
// which each hides the next. Done in slices; not a bit depends on these or on threads. The scene
// and the list, which it puts in order, must outlive it.
class FaceOrder {
 public:
    // `eye` in axis coordinates. REQUIRES: scene.placed.isMesh().
    FaceOrder(const Scene& scene, const glm::dvec3& eye, std::span<CellOfLayer> nearestFirst,
              unsigned threads);
    // Passes over so many cells, or a few more; all that are listed are passed over twice, and all
    // of the mesh as often, or more often where very many are listed.
    void goOn(std::uint64_t cells);
    bool done() const { return phase_ == Phase::Done; }

 private:
    enum class Phase { Find, Count, Place, Match, Walk, Done };
    struct Face {
        FaceKey key;
        std::uint32_t node;  // a place in the list
        std::int32_t eye;    // > 0 on the other side, < 0 on the cell's; 0 is not told
    };
    // One that is to be passed before another, and where in the list of all the next of these is.
    struct InFront {
        std::uint32_t node, next;
    };
    static constexpr std::uint32_t kNone = 0xffffffffu;

    void find(std::uint64_t cells);
    // use(its bucket of this round's, key, side, node) of all that so many of the mesh's cells
    // have.
    template <typename Use>
    void forEachFace(std::uint64_t cells, const Use& use);
    void match(std::uint64_t buckets);
    // use(the one before, the one behind)
    template <typename Use>
    void related(std::span<Face> bucket, const Use& use) const;
    void walk(std::uint64_t cells);
    void enter(Phase phase);

    const Scene& scene_;
    glm::dvec3 eye_;
    std::span<CellOfLayer> list_;
    unsigned threads_;
    Phase phase_ = Phase::Find;
    std::uint64_t passed_ = 0;  // of what is passed over in this phase
    // Of each of the mesh's cells a node, and of each node another one of its cell: cells are gone
    // through as they are numbered, for those beside each other lie beside each other in memory.
    std::vector<std::uint32_t> nodeOf_, another_;
    // Faces are looked for in rounds, so that few of them are held at once: each has its part of
    // all buckets, in which faces of one key meet.
    std::uint32_t round_ = 0, rounds_, buckets_;
    std::vector<std::uint32_t> ends_;  // of this round's buckets
    timeseries::Pages<Face> faces_;
    std::vector<InFront> inFront_;
    std::vector<std::uint32_t> first_;  // of each node, in inFront_
    std::vector<CellOfLayer> before_;   // the list as it came
    std::vector<std::uint32_t> open_;   // nodes that wait for what is in front of them
    std::vector<bool> taken_;
    std::uint64_t walked_ = 0;
};

}  // namespace render
