// Cells of a mesh put in the order in which they hide each other.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "render/model/scene.h"
#include "render/points/view.h"
#include "render/splat/gap_order.h"
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
// after theirs, and so across gaps, as the picture's rays meet what is beside them (GapOrder);
// otherwise as they came, as is one of a ring of cells of which each hides the next. Of a cell in
// several layers all come together, as they did. Done in slices; not a bit depends on these or on
// threads. The scene and the list, which it puts in order, must outlive it.
class FaceOrder {
 public:
    // REQUIRES: scene.placed.isMesh().
    FaceOrder(const Scene& scene, const View& view, std::span<CellOfLayer> nearestFirst,
              unsigned threads);
    // Passes over so many of the list's cells, or a few more; all are passed over nine times, or
    // eighteen where they are very many. Throws std::bad_alloc.
    void goOn(std::uint64_t cells);
    bool done() const { return phase_ == Phase::Done; }

 private:
    // Gather and Sort: cells as they are numbered, for those beside each other lie beside each
    // other in memory. Count and Place: their faces into buckets, where those of one key meet.
    // Match: which cell is in front of which. See, Follow: and across gaps. Walk: the list anew.
    enum class Phase { Spread, Gather, Sort, Count, Place, Match, See, Follow, Walk, Done };
    struct Listed {
        std::uint32_t cell, node;  // a place in the list
        friend auto operator<=>(const Listed&, const Listed&) = default;
    };
    struct Face {
        FaceKey key;
        std::uint32_t at;  // where its cell is first in listed_
        std::int32_t eye;  // > 0 on the other side, < 0 on the cell's; 0 is not told
        friend auto operator<=>(const Face&, const Face&) = default;
    };
    // One that no other cell has.
    struct Outer {
        FaceKey key;
        std::uint32_t at;
    };
    // A cell that is to be passed before another, and where in the list of all the next of these
    // is.
    struct InFront {
        std::uint32_t at, next;
    };
    static constexpr std::uint32_t kNone = 0xffffffffu;

    void spread(std::uint64_t cells);
    void gather(std::uint64_t cells);
    void sort(std::uint64_t blocks);
    bool isFirst(std::size_t at) const {
        return at == 0 || listed_[at - 1].cell != listed_[at].cell;
    }
    std::uint64_t bucketOf(const FaceKey& key, std::uint64_t keys) const;
    // use(its bucket of this round's, key, side, at) of all that so many of listed_ have.
    template <typename Use>
    void forEachFace(std::uint64_t cells, const Use& use);
    void match(std::uint64_t buckets);
    void see(std::uint64_t cells);
    void follow(std::uint64_t cells);
    void putBefore(std::uint32_t before, std::uint32_t behind) {
        inFront_.push_back({before, first_[behind]});
        first_[behind] = static_cast<std::uint32_t>(inFront_.size() - 1);
    }
    void walk(std::uint64_t cells);
    void pass(std::uint32_t at);
    void enter(Phase phase);
    // How many blocks or buckets are so many of the list's share.
    std::uint64_t shareOf(std::uint64_t cells, std::uint64_t all) const;

    const Scene& scene_;
    glm::dvec3 eye_;
    std::span<CellOfLayer> list_;
    unsigned threads_, shift_ = 0;  // of a cell's number, to its block's
    Phase phase_ = Phase::Spread;
    std::uint64_t passed_ = 0;  // of what is passed over in this phase
    std::vector<Listed> listed_;
    std::vector<std::uint32_t> ofNode_;  // where the node's cell is first there
    // Of each block, and then of each of this round's buckets, where it ends. In a round are the
    // faces of some of all buckets, so that fewer of them are held at once.
    std::vector<std::uint32_t> ends_;
    std::uint32_t round_ = 0, rounds_, buckets_;
    timeseries::Pages<Face> faces_;
    std::vector<Outer> outer_;
    std::optional<GapOrder> gaps_;  // until they are followed
    std::vector<InFront> inFront_;
    std::vector<std::uint32_t> first_;  // of each cell, in inFront_
    std::vector<CellOfLayer> before_;   // the list as it came
    std::vector<std::uint32_t> open_;   // cells that wait for what is in front of them
    std::vector<bool> taken_;
    std::uint64_t walked_ = 0;
};

}  // namespace render
