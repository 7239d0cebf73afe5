// The tetrahedra of an unstructured grid's solid cells (timeseries/grid/solid_cells.h), in the
// place of MeshCells (render/splat/mesh_cells.h). One that lies across where coordinates begin anew
// is drawn whole on one side, that of its first corner; one about a pole only on a globe.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "render/model/scene.h"
#include "render/splat/mesh_cells.h"
#include "timeseries/grid/solid_cells.h"

namespace render {

// A tetrahedron of which a corner has no value, or is beside a clip box that does not cut cells
// (TetClip), is drawn where the others are the nearest in shares: of each of these the hexahedron
// between it and the middles of the edges, faces and tetrahedron that it is of, in which the field
// goes on as it was. What it is made of must outlive it.
class SolidTets {
 public:
    // REQUIRES: the placed points' mesh, and the field's grid's, has solids().
    SolidTets(const PlacedPoints& placed, const timeseries::Field& field, const IndexBox& clip,
              const timeseries::PointGradients* gradients = nullptr, bool byMiddles = false)
        : placed_(placed),
          cells_(*placed.mesh()->solids()),
          field_(field),
          clip_(clip),
          cut_(placed, clip),
          gradients_(placed, gradients),
          byPoints_(!clip.holdsAll() && !cut_.cuts()),
          byMiddles_(byMiddles),
          period_(placed.period()),
          comesRound_(period_ != glm::dvec3(0)),
          mapFrom_(placed.pointsBox().lo.x),
          mapTo_(placed.pointsBox().hi.x),
          reach_(MeshCells::reachOf(
              placed, placed.globe() ? longestOn(*placed.globe()) : cells_.longest())) {}

    std::uint64_t count() const { return cells_.count(); }
    // As MeshCells has them.
    glm::dvec3 about(std::uint32_t cell) const {
        return placed_.alongAxes(cells_.firstCorner(cell));
    }
    const glm::dvec3& reach() const { return reach_; }
    template <typename CellAhead>
    void prefetch(const CellAhead& cellAhead) const {
        constexpr std::uint64_t kAhead = 16;
        if (const auto cell = cellAhead(3 * kAhead)) cells_.prefetchEnds(*cell);
        if (const auto cell = cellAhead(2 * kAhead)) cells_.prefetchCorners(*cell);
        if (const auto cell = cellAhead(kAhead)) placed_.prefetch(cells_.firstCorner(*cell));
    }
    std::pair<double, double> extentOf(std::uint32_t cell) const {
        timeseries::SolidCells::Room room;
        return timeseries::finiteExtent(field_, cells_.corners(cell, room));
    }
    std::uint64_t pointOf(std::uint32_t cell, unsigned corner) const {
        return cells_.haveMiddles() ? cells_.middle(cell) : corner;
    }
    template <typename Use>
    void forEachFace(std::uint32_t cell, const Use& use) const;
    std::uint64_t faceKeys() const { return placed_.mesh()->corners() - cells_.firstNode(); }
    template <typename Use>
    void forEachTriangle(std::uint32_t cell, const FaceKey& key, const glm::dvec3& eye,
                         const Use& use) const;
    template <typename MayBeSeen, typename Use>
    void forEachTet(std::uint32_t cell, const glm::dvec3* eye, const MayBeSeen& mayBeSeen,
                    const Use& use) const;

 private:
    using Tetrahedron = MeshCells::Tetrahedron;
    // In whatever direction degrees and heights lead there.
    glm::dvec3 longestOn(const Globe& globe) const;
    template <typename Use>
    void forEachKey(std::uint32_t cell, const Use& use) const;
    struct Drawn {
        Tetrahedron tet;
        unsigned seen;
        bool mayBeSeen = false;
        double away = 0;
    };
    // pass(part) for each of a cell's before what it hides, as FaceOrder has cells
    // (render/splat/face_order.h). REQUIRES: the nearest first, and no more.
    static constexpr std::size_t kMostByFaces = 64;
    template <typename Pass>
    static void inFrontFirst(std::span<const Drawn> parts, const glm::dvec3& eye, const Pass& pass);
    // A bit for each of the parts that share a face with this one and are before it.
    static std::uint64_t inFrontOf(const Drawn& part, std::span<const Drawn> parts,
                                   const glm::dvec3& eye);
    // use(tet) for what is seen of it; a bit of `seen` for each corner.
    template <typename Use>
    static void forEachSeen(const Tetrahedron& tet, unsigned seen, const glm::dvec3* eye,
                            const Use& use);
    // Whether a cell that is drawn where its first corner is has this one elsewhere than others.
    bool isDrawnElsewhere(std::uint32_t cell, std::uint32_t corner) const {
        const glm::dvec3 first = placed_.alongAxes(cells_.firstCorner(cell));
        return way(first, corner) != placed_.cornerAlongAxes(corner) - first;
    }
    // From a place to a point, the shorter way round.
    glm::dvec3 way(const glm::dvec3& from, std::uint32_t to) const {
        const glm::dvec3 direct = placed_.cornerAlongAxes(to) - from;
        return comesRound_ ? timeseries::shorterWay(direct, period_) : direct;
    }
    glm::dvec3 middle(std::uint32_t cell) const;
    // Of a face of so many points, the least of which has this place, and a cell with this middle.
    template <typename PointAt>
    double sideOfFace(const glm::dvec3& middle, std::size_t size, std::size_t least,
                      const PointAt& pointAt, const glm::dvec3& eye) const;
    // All that a tetrahedron is, and which of its corners are seen.
    unsigned take(const std::array<std::uint32_t, 4>& points, Tetrahedron& tet) const;

    const PlacedPoints& placed_;
    const timeseries::SolidCells& cells_;
    const timeseries::Field& field_;
    const IndexBox& clip_;
    TetClip cut_;
    MeshGradients gradients_;
    bool byPoints_;   // the box clips so
    bool byMiddles_;  // a cell's tetrahedra come so, as Scene::byMiddles
    glm::dvec3 period_;
    bool comesRound_;
    double mapFrom_, mapTo_;  // where the points are, along what comes round
    glm::dvec3 reach_;
};

// use(cells): as MeshCells or as SolidTets, whichever the mesh has, of the scene, which is of this
// field. REQUIRES: one of them.
template <typename Use>
void withTets(const Scene& scene, const timeseries::Field& field, const Use& use) {
    const PlacedPoints& placed = scene.placed;
    const timeseries::PointGradients* const gradients = scene.gradients.get();
    if (!placed.hasNeighbours())
        return use(SolidTets(placed, field, scene.clip, gradients, scene.byMiddles));
    use(MeshCells(placed, timeseries::CellCorners(field), scene.clip, gradients));
}

template <typename Use>
void SolidTets::forEachSeen(const Tetrahedron& tet, unsigned seen, const glm::dvec3* eye,
                            const Use& use) {
    if (seen == 15) return use(tet);
    std::array<unsigned, 4> order{0, 1, 2, 3};
    if (eye)
        std::ranges::sort(order, {}, [&](unsigned i) { return glm::distance(*eye, tet.at[i]); });
    for (const unsigned corner : order) {
        if ((seen >> corner & 1) == 0) continue;
        MeshCells::Hexahedron part{};
        for (unsigned c = 0; c < 8; ++c) {
            unsigned of = 1u << corner;  // whose middle this is
            for (unsigned side = 0, i = 0; i < 4; ++i)
                if (i != corner && (c >> side++ & 1)) of |= 1u << i;
            const double share = 1.0 / std::popcount(of);
            for (unsigned i = 0; i < 4; ++i) {
                if ((of >> i & 1) == 0) continue;
                part.at[c] += share * tet.at[i];
                part.values[c] += share * tet.values[i];
                part.gradients[c] += share * tet.gradients[i];
            }
        }
        MeshCells::forEachTetIn(part, eye, [&](Tetrahedron some) {
            some.corners.fill(tet.corners[corner]);
            use(some);
        });
    }
}

// use(key, size, the place of its least point, pointAt) for those that are faces: a key is the
// three least of its points, of which collapsed ones have some more than once. No face has a
// middle.
template <typename Use>
void SolidTets::forEachKey(std::uint32_t cell, const Use& use) const {
    cells_.forEachFace(cell, [&](std::size_t size, const auto& pointAt) {
        constexpr std::uint32_t kNone = 0xffffffffu;
        FaceKey key{kNone, kNone, kNone};
        std::size_t least = 0;
        for (std::size_t i = 0; i < size; ++i) {
            auto point = static_cast<std::uint32_t>(pointAt(i) - cells_.firstNode());
            if (pointAt(i) < pointAt(least)) least = i;
            for (std::uint32_t& kept : key) {
                if (point == kept) break;
                if (point < kept) std::swap(point, kept);
            }
        }
        if (key[2] != kNone) use(key, size, least, pointAt);
    });
}

template <typename Use>
void SolidTets::forEachTriangle(std::uint32_t cell, const FaceKey& key, const glm::dvec3& eye,
                                const Use& use) const {
    const glm::dvec3 inside = middle(cell);
    forEachKey(
        cell, [&](const FaceKey& of, std::size_t size, std::size_t least, const auto& pointAt) {
            if (of != key) return;
            const glm::dvec3 apex = placed_.cornerAlongAxes(pointAt(least));
            const auto place = [&](std::size_t i) { return apex + way(apex, pointAt(i % size)); };
            const double side = sideOfFace(inside, size, least, pointAt, eye);
            for (std::size_t i = 1; i + 1 < size; ++i)
                use(std::array{apex, place(least + i), place(least + i + 1)}, side);
        });
}

template <typename Use>
void SolidTets::forEachFace(std::uint32_t cell, const Use& use) const {
    std::optional<glm::dvec3> middleOf;  // when it is asked for
    forEachKey(cell,
               [&](const FaceKey& key, std::size_t size, std::size_t least, const auto& pointAt) {
                   if (comesRound_ && isDrawnElsewhere(cell, pointAt(least))) return;
                   use(key, [&](const glm::dvec3& eye) {
                       if (!middleOf) middleOf = middle(cell);
                       return sideOfFace(*middleOf, size, least, pointAt, eye);
                   });
               });
}

// The fan from its least point, as it is parted.
template <typename PointAt>
double SolidTets::sideOfFace(const glm::dvec3& middle, std::size_t size, std::size_t least,
                             const PointAt& pointAt, const glm::dvec3& eye) const {
    const glm::dvec3 apex = placed_.cornerAlongAxes(pointAt(least));
    glm::dvec3 normal(0);
    glm::dvec3 before = way(apex, pointAt((least + 1) % size));
    for (std::size_t i = 2; i < size; ++i) {
        const glm::dvec3 next = way(apex, pointAt((least + i) % size));
        normal += glm::cross(before, next);
        before = next;
    }
    const double own = glm::dot(normal, middle - apex), side = glm::dot(normal, eye - apex);
    return own > 0 ? -side : own < 0 ? side : 0;
}

template <typename Pass>
void SolidTets::inFrontFirst(std::span<const Drawn> parts, const glm::dvec3& eye,
                             const Pass& pass) {
    std::array<std::uint64_t, kMostByFaces> before;
    for (std::size_t k = 0; k < parts.size(); ++k) before[k] = inFrontOf(parts[k], parts, eye);
    std::uint64_t left = ~std::uint64_t{0} >> (kMostByFaces - parts.size());
    while (left != 0) {
        auto k = static_cast<std::size_t>(std::countr_zero(left));  // of a ring the first
        for (std::uint64_t some = left; some != 0; some &= some - 1) {
            const auto free = static_cast<std::size_t>(std::countr_zero(some));
            if ((before[free] & left) != 0) continue;
            k = free;
            break;
        }
        left &= ~(std::uint64_t{1} << k);
        pass(parts[k]);
    }
}

template <typename MayBeSeen, typename Use>
void SolidTets::forEachTet(std::uint32_t cell, const glm::dvec3* eye, const MayBeSeen& mayBeSeen,
                           const Use& use) const {
    thread_local std::vector<Drawn> parts;
    parts.clear();
    cells_.forEachTet(cell, [&](const std::array<std::uint32_t, 4>& points) {
        Drawn part{};
        part.seen = take(points, part.tet);
        if (part.seen == 0) return;
        part.mayBeSeen = mayBeSeen(part.tet.at);
        parts.push_back(part);
    });
    if (std::ranges::none_of(parts, &Drawn::mayBeSeen)) return;
    // All are put in order, so that what is seen of some does not depend on what is of others.
    const auto pass = [&](const Drawn& part) {
        if (!part.mayBeSeen) return;
        if (!cut_.cuts()) return forEachSeen(part.tet, part.seen, eye, use);
        forEachSeen(part.tet, part.seen, eye, [&](const Tetrahedron& tet) { cut_(tet, eye, use); });
    };
    if (eye && parts.size() > 1) {
        for (Drawn& part : parts) {
            const auto& at = part.tet.at;
            part.away = glm::distance(*eye, 0.25 * (at[0] + at[1] + at[2] + at[3]));
        }
        std::ranges::stable_sort(parts, {}, &Drawn::away);
        if (!byMiddles_ && parts.size() <= kMostByFaces) return inFrontFirst(parts, *eye, pass);
    }
    std::ranges::for_each(parts, pass);
}

}  // namespace render
