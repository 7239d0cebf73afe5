#include "render/splat/seen_cells.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/splat/seen_cells.cpp"
#include <hwy/foreach_target.h>  // the first of these
//
#include <hwy/highway.h>
//
#include "render/splat/cell_outline-inl.h"
#include "render/splat/lanes-inl.h"

#ifndef RENDER_SEEN_CELLS_ROWS
#define RENDER_SEEN_CELLS_ROWS
namespace render {
namespace {

// What is found of a PieceBatch: of SeenCells, a row a field, and names as in CellSplat.
struct SeenRows {
    template <typename T>
    using Row = PieceBatch::Row<T>;
    std::array<Row<float>, seen_cell::kFloats> field;
    Row<float> crossesLeast, crossesMost;
    Row<double> reference, extent;
    Row<std::int32_t> isSeen;
    Row<std::int32_t> tileX, tileY, lastTileX, lastTileY;
};

}  // namespace
}  // namespace render
#endif

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE D yes(hn::Mask<Doubles> is) { return hn::IfThenElseZero(is, d(1)); }
HWY_INLINE void put(F v, PieceBatch::Row<float>& row, std::size_t at) {
    hn::StoreU(v, Floats(), row.data() + at);
}
HWY_INLINE void put(I v, PieceBatch::Row<std::int32_t>& row, std::size_t at) {
    hn::StoreU(v, Ints(), row.data() + at);
}

// A vector of pieces. What needs doubles is done in two halves.
struct SeenLanes {
    const CellView& view;
    const PieceBatch& pieces;
    SeenRows& rows;
    std::size_t at;
    bool isPerCrossing;
    D seen[3][2] = {}, edge[3][3][2] = {};  // of edge a, half of it along k
    D visible[2] = {}, whole[2] = {};  // 1 where something, and where all, is beyond the near plane
    D windowWhole[2][2] = {}, windowPart[2][2] = {};

    // The piece in the view, and its range.
    HWY_INLINE void takeHalf(std::size_t h) {
        const std::size_t from = at + h * hn::Lanes(Doubles());
        const auto load = [&](const PieceBatch::Row<double>& row)
                              HWY_ATTR { return hn::LoadU(Doubles(), row.data() + from); };
        const PixelRays& rays = view.seen.rays;
        D middle[3], size[3], perSize[3];
        for (std::size_t a = 0; a < 3; ++a) {
            const D first = load(pieces.from[a]), last = load(pieces.to[a]);
            size[a] = hn::Sub(last, first);
            middle[a] = hn::Mul(d(0.5), hn::Add(first, last));
            perSize[a] = hn::Div(d(1), size[a]);
        }
        const auto& m = view.seen.viewFromAxes;
        for (int k = 0; k < 3; ++k) {
            D sum = d(m[3][k]);
            for (int a = 0; a < 3; ++a) {
                sum = hn::MulAdd(middle[a], d(m[a][k]), sum);
                edge[a][k][h] = hn::Mul(size[a], d(0.5 * m[a][k]));
            }
            seen[k][h] = sum;
        }
        const D depth = hn::Neg(seen[2][h]);
        D deep = hn::Zero(Doubles());
        for (const auto& e : edge) deep = hn::Add(deep, hn::Abs(e[2][h]));
        const auto isWhole = hn::Gt(hn::Sub(depth, deep), d(rays.near));
        visible[h] =
            hn::And(takeField(from, perSize), yes(hn::Gt(hn::Add(depth, deep), d(rays.near))));
        whole[h] = yes(isWhole);
        D centre[2];
        for (int k = 0; k < 2; ++k) {
            centre[k] =
                hn::IfThenElseZero(isWhole, hn::Div(hn::Mul(seen[k][h], d(rays.focal[k])), depth));
            constexpr double kMost = 1e9;  // beside any picture
            const D window = hn::Min(
                hn::Max(hn::Add(centre[k], d(view.centre[static_cast<std::size_t>(k)])), d(-kMost)),
                d(kMost));
            windowWhole[k][h] = hn::Floor(window);
            windowPart[k][h] = hn::Sub(window, windowWhole[k][h]);
        }
        for (int a = 0; a < 3; ++a) {
            const D ray = hn::MulAdd(centre[0], d(rays.perPixelX[a]),
                                     hn::MulAdd(centre[1], d(rays.perPixelY[a]), d(rays.axis[a])));
            const D fromEye = hn::Mul(hn::Sub(d(rays.eye[a]), middle[a]), perSize[a]);
            const auto axis = static_cast<std::size_t>(a);
            store(hn::IfThenZeroElse(isWhole, fromEye), rows.field[seen_cell::kAt + axis], from);
            store(hn::Mul(ray, perSize[a]), rows.field[seen_cell::kRay + axis], from);
            store(perSize[a], rows.field[seen_cell::kPerSize + axis], from);
        }
    }
    static HWY_INLINE void store(D v, PieceBatch::Row<float>& row, std::size_t to) {
        hn::StoreU(hn::DemoteTo(HalfFloats(), v), HalfFloats(), row.data() + to);
    }

    // As seeField() and seeRange(). 1 where the piece takes something of the range.
    HWY_INLINE D takeField(std::size_t from, const D* perSize) const {
        const auto load = [&](const PieceBatch::Row<double>& row)
                              HWY_ATTR { return hn::LoadU(Doubles(), row.data() + from); };
        const D zero = hn::Zero(Doubles()), half = d(0.5);
        D f[8];
        for (std::size_t c = 0; c < 8; ++c) f[c] = load(pieces.corners[c]);
        D least = f[0], greatest = f[0];
        for (std::size_t c = 1; c < 8; ++c) {
            least = hn::Min(least, f[c]);
            greatest = hn::Max(greatest, f[c]);
        }
        const D lo = load(pieces.lo), hi = load(pieces.hi);
        const D reference = hn::MulAdd(half, least, hn::Mul(half, greatest));
        const D extent = hn::Sub(hn::Mul(half, greatest), hn::Mul(half, least));
        hn::StoreU(reference, Doubles(), rows.reference.data() + from);
        hn::StoreU(extent, Doubles(), rows.extent.data() + from);
        const auto changes = hn::Gt(extent, zero);
        const D divisor = hn::IfThenElse(changes, extent, d(1));
        for (D& corner : f) corner = hn::Div(hn::Sub(corner, reference), divisor);
        storeCoefficients(f, from);

        D passages = zero;  // of a length that f may pass the range in
        if (isPerCrossing)
            passages =
                hn::Mul(hn::Div(extent, hn::Sub(hi, lo)),
                        hn::Mul(d(2 * view.seen.unitLength), hn::Sqrt(dot(perSize, perSize))));
        const auto isThin = hn::And(changes, hn::Gt(passages, d(1)));
        const auto within = [&](D end) HWY_ATTR {  // in halves, the whole may overflow
            return hn::Mul(d(2),
                           hn::Div(hn::Sub(hn::Mul(half, end), hn::Mul(half, reference)), divisor));
        };
        const auto ifLeast = hn::And(changes, hn::Or(isThin, hn::Lt(least, lo)));
        const auto ifMost = hn::And(changes, hn::Or(isThin, hn::Gt(greatest, hi)));
        store(yes(ifLeast), rows.crossesLeast, from);
        store(yes(ifMost), rows.crossesMost, from);
        store(hn::IfThenElseZero(ifLeast, within(lo)), rows.field[seen_cell::kLeast], from);
        store(hn::IfThenElseZero(ifMost, within(hi)), rows.field[seen_cell::kMost], from);
        store(yes(isThin), rows.field[seen_cell::kPerRange], from);
        const D steep = hn::Min(hn::Div(d(view.steep), divisor), d(kSteepest));
        store(hn::IfThenElse(changes, steep, d(kSteepest)), rows.field[seen_cell::kSteep], from);
        const auto reaches = hn::And(hn::Lt(least, hi), hn::Gt(greatest, lo));
        const auto touches = hn::And(hn::Le(least, hi), hn::Ge(greatest, lo));
        return yes(hn::Or(reaches, hn::And(touches, hn::Or(isThin, hn::Eq(least, greatest)))));
    }
    // As cell::coefficients().
    HWY_INLINE void storeCoefficients(D* f, std::size_t from) const {
        toCoefficients(f);
        constexpr std::size_t kOrder[] = {0, 1, 2, 4, 3, 5, 6, 7};
        for (std::size_t c = 0; c < 8; ++c)
            store(f[kOrder[c]], rows.field[seen_cell::kF + c], from);
    }

    // Ranges that are thin beside what a cell changes have two ends.
    HWY_INLINE void widenThin() const {
        const F isThin = hn::LoadU(Floats(), rows.field[seen_cell::kPerRange].data() + at);
        const auto thin = hn::Gt(isThin, hn::Zero(Floats()));
        if (hn::AllFalse(Floats(), thin)) return;
        const F least = hn::LoadU(Floats(), rows.field[seen_cell::kLeast].data() + at);
        const F most = hn::LoadU(Floats(), rows.field[seen_cell::kMost].data() + at);
        const F middle = hn::Mul(f(0.5f), hn::Add(least, most));
        const F way = hn::Max(hn::Sub(most, middle), f(static_cast<float>(kThinnest / 2)));
        put(hn::IfThenElse(thin, hn::Sub(middle, way), least), rows.field[seen_cell::kLeast], at);
        put(hn::IfThenElse(thin, hn::Add(middle, way), most), rows.field[seen_cell::kMost], at);
        put(hn::IfThenElseZero(thin, hn::Div(f(0.5f), way)), rows.field[seen_cell::kPerRange], at);
    }

    // Which pixels the corners of each lie between.
    HWY_INLINE void takePixels() const {
        constexpr float kAll = 1e9f;
        const auto isWhole = hn::Gt(joined(whole), hn::Zero(Floats()));
        const auto isVisible = hn::Gt(joined(visible), hn::Zero(Floats()));
        F middle[3], half[3][3];
        for (int k = 0; k < 3; ++k) {
            middle[k] = joined(seen[k]);
            for (int a = 0; a < 3; ++a) half[a][k] = joined(edge[a][k]);
        }
        put(hn::IfThenElseZero(isWhole, hn::Neg(middle[2])), rows.field[seen_cell::kBase], at);
        const CellOutline outline(view, middle, half, isWhole);
        F first[2], last[2];
        for (int k = 0; k < 2; ++k) {
            const F part = joined(windowPart[k]), from = joined(windowWhole[k]);
            const F focal = f(static_cast<float>(view.focal[static_cast<std::size_t>(k)]));
            const auto reach = [&](F offset, F by) HWY_ATTR {
                const F begins = hn::Add(hn::MulAdd(offset, focal, part), hn::Sub(by, f(0.5f)));
                return hn::Ceil(hn::Min(hn::Max(begins, f(-kAll)), f(kAll)));
            };
            const F more = outline.more[k];
            const F low = reach(outline.least[k], hn::Neg(more));
            const F high = reach(outline.most[k], more);
            // Whole numbers of floats: what lies in the picture is below 2^24.
            const F limit = f(static_cast<float>(view.box.size[k])), zero = hn::Zero(Floats());
            first[k] = hn::Min(hn::Max(hn::Add(from, low), zero), limit);
            last[k] = hn::Min(hn::Max(hn::Add(from, high), zero), limit);
            put(hn::Sub(hn::Sub(hn::Add(first[k], f(0.5f)), from), part),
                k ? rows.field[seen_cell::kOy] : rows.field[seen_cell::kOx], at);
            putInts(hn::ConvertTo(Ints(), first[k]), k ? seen_cell::kY : seen_cell::kX);
            const F perTile = f(1 / static_cast<float>(view.tile[k]));
            const auto tileOf = [&](F pixel) HWY_ATTR {  // of its middle, far from a tile's edge
                return hn::ConvertTo(Ints(), hn::Mul(hn::Add(pixel, f(0.5f)), perTile));
            };
            put(tileOf(first[k]), k ? rows.tileY : rows.tileX, at);
            put(tileOf(hn::Sub(last[k], f(1))), k ? rows.lastTileY : rows.lastTileX, at);
        }
        const auto columns = hn::Sub(last[0], first[0]), lines = hn::Sub(last[1], first[1]);
        const auto some = hn::And(isVisible, hn::And(hn::Gt(columns, hn::Zero(Floats())),
                                                     hn::Gt(lines, hn::Zero(Floats()))));
        put(hn::ConvertTo(Ints(), hn::IfThenElseZero(some, f(1))), rows.isSeen, at);
        const I lastColumn = hn::ConvertTo(Ints(), hn::Sub(columns, f(1)));
        const I lastLine = hn::ConvertTo(Ints(), hn::Sub(lines, f(1)));
        putInts(hn::Or(lastColumn, hn::ShiftLeft<16>(lastLine)), seen_cell::kLastPixels);
        takeFlags(columns, lines);
    }
    HWY_INLINE void putInts(I v, std::size_t field) const {
        put(hn::BitCast(Floats(), v), rows.field[field], at);
    }
    HWY_INLINE void takeFlags(F columns, F lines) const {
        constexpr double kLess = 1e-5;  // than arithmetic loses
        F widest;
        const auto grazes = grazing(columns, lines, widest);
        const F base = hn::LoadU(Floats(), rows.field[seen_cell::kBase].data() + at);
        const auto flat =
            hn::Gt(hn::Mul(base, widest), f(static_cast<float>(kOrdinaryStep * (1 - kLess))));
        const auto flag = [&](hn::Mask<Floats> is, SeenPiece::PieceFlag bit) HWY_ATTR {
            return hn::IfThenElseZero(hn::RebindMask(Ints(), is),
                                      hn::Set(Ints(), static_cast<std::int32_t>(bit)));
        };
        const auto crosses = [&](const PieceBatch::Row<float>& row) HWY_ATTR {
            return hn::Gt(hn::LoadU(Floats(), row.data() + at), hn::Zero(Floats()));
        };
        const I ends = hn::Or(flag(crosses(rows.crossesLeast), SeenPiece::kCrossesLeast),
                              flag(crosses(rows.crossesMost), SeenPiece::kCrossesMost));
        const I lies = hn::Or(flag(grazes, SeenPiece::kGrazes), flag(flat, SeenPiece::kMayBeFlat));
        putInts(hn::Or(ends, lies), seen_cell::kFlags);
    }

    // Whether some of these rays, or a little beside them, go along a face: along an axis of the
    // cell they are what the middle one is, and so much at most more or less. And how much of a
    // cell a pixel's step is at most, a unit of depth.
    HWY_INLINE hn::Mask<Floats> grazing(F columns, F lines, F& widest) const {
        constexpr float kMore = 8;  // pixels of a vector, and what arithmetic loses
        const F ox = hn::LoadU(Floats(), rows.field[seen_cell::kOx].data() + at);
        const F oy = hn::LoadU(Floats(), rows.field[seen_cell::kOy].data() + at);
        const auto farthest = [&](F first, F count) HWY_ATTR {
            return hn::Max(hn::Abs(hn::Sub(first, f(kMore))),
                           hn::Abs(hn::Add(first, hn::Add(count, f(kMore)))));
        };
        const F x = farthest(ox, columns), y = farthest(oy, lines);
        F some = hn::Zero(Floats());
        widest = some;
        for (std::size_t a = 0; a < 3; ++a) {
            const F ray = hn::LoadU(Floats(), rows.field[seen_cell::kRay + a].data() + at);
            const F perSize = hn::LoadU(Floats(), rows.field[seen_cell::kPerSize + a].data() + at);
            const F right = hn::Mul(perSize, f(view.perPixelX[a]));
            const F up = hn::Mul(perSize, f(view.perPixelY[a]));
            widest = hn::Max(widest, hn::Max(hn::Abs(right), hn::Abs(up)));
            const F shift = hn::MulAdd(x, hn::Abs(right), hn::Mul(y, hn::Abs(up)));
            const F one = f(1), zero = hn::Zero(Floats());
            some = hn::Max(some, hn::IfThenElse(hn::Gt(hn::Abs(ray), shift), zero, one));
        }
        return hn::Gt(some, hn::Zero(Floats()));
    }

    // Those that are seen, from this place on; returns the place behind them.
    HWY_INLINE SeenCell* write(SeenCell* to) const {
        SeenCell beside;  // for the others
        SeenCell* places[kLanes];
        for (std::size_t k = 0; k < kLanes; ++k) {
            const bool isSeen = at + k < pieces.count && rows.isSeen[at + k] != 0;
            places[k] = isSeen ? to++ : &beside;
        }
        for (std::size_t i = 0; i < seen_cell::kFloats; i += 4) {
            F fields[4];
            for (std::size_t r = 0; r < 4; ++r)
                fields[r] = hn::LoadU(Floats(), rows.field[i + r].data() + at);
            storeFours(fields,
                       [&](std::size_t k) { return reinterpret_cast<float*>(places[k]) + i; });
        }
        return to;
    }
};

// Returns the place behind the last.
HWY_ATTR SeenCell* FindCells(const CellView& view, bool isPerCrossing, const PieceBatch& pieces,
                             SeenRows& rows, SeenCell* to) {
    static_assert(PieceBatch::kMost % kLanes == 0);
    for (std::size_t i = 0; i < pieces.count; i += kLanes) {
        SeenLanes lanes{view, pieces, rows, i, isPerCrossing};
        lanes.takeHalf(0);
        lanes.takeHalf(1);
        lanes.widenThin();
        lanes.takePixels();
        to = lanes.write(to);
    }
    return to;
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace render {
HWY_EXPORT(FindCells);

namespace {

// Of those that are seen.
void addSlopes(const PointSlopes& points, const PieceBatch& pieces, const SeenRows& rows,
               timeseries::PageVector<CellSlopes>& slopes) {
    static_assert(SlopeBatch::kMost == PieceBatch::kMost);
    SlopeBatch whole;
    std::array<std::size_t, PieceBatch::kMost> piece;
    SlopeBatch::Row isNone;
    const auto sizeOf = [&](std::size_t i) {
        return glm::dvec3(pieces.to[0][i] - pieces.from[0][i], pieces.to[1][i] - pieces.from[1][i],
                          pieces.to[2][i] - pieces.from[2][i]);
    };
    for (std::size_t i = 0; i < pieces.count; ++i) {
        if (rows.isSeen[i] == 0) continue;
        piece[whole.count] = i;
        points.add(pieces.cell[i], sizeOf(i), rows.extent[i], whole);
    }
    const std::size_t before = slopes.size();
    slopes.resize(before + whole.count);
    whole.take(slopes.data() + before, isNone);
    PointSlopes::OfOctants last;
    for (std::size_t k = 0; k < whole.count; ++k)
        if (const std::size_t i = piece[k]; isNone[k] != 0 || pieces.octant[i] != kWholeCell)
            slopes[before + k] =
                points.in(pieces.cell[i], pieces.octant[i], sizeOf(i), rows.extent[i], last);
}

}  // namespace

void seeCells(const CellView& view, const Scene& scene, const PointSlopes* points,
              const PieceBatch& pieces, timeseries::PageVector<SeenCell>& cells,
              timeseries::PageVector<CellSlopes>& slopes, std::vector<TileSpan>& spans) {
    SeenRows rows;
    for (std::size_t k = seen_cell::kTints; k < seen_cell::kSteep; ++k) rows.field[k].fill(0);
    std::size_t seen = cells.size();
    cells.resize(seen + pieces.count);
    const SeenCell* const end = HWY_DYNAMIC_DISPATCH(FindCells)(
        view, scene.opacityPer == OpacityPer::Crossing, pieces, rows, cells.data() + seen);
    for (std::size_t i = 0; i < pieces.count; ++i) {
        if (rows.isSeen[i] == 0) continue;
        spans.push_back({static_cast<std::uint32_t>(rows.tileY[i] * view.tiles.x + rows.tileX[i]),
                         static_cast<std::uint16_t>(rows.lastTileX[i] - rows.tileX[i] + 1),
                         static_cast<std::uint16_t>(rows.lastTileY[i] - rows.tileY[i] + 1)});
        SeenCell& c = cells[seen++];
        takeTints(c, view, pieces.layer[i], scene.layers[pieces.layer[i]].style,
                  cell::coloredField({rows.reference[i], rows.extent[i]}, c.perRange > 0,
                                     pieces.lo[i], pieces.hi[i]));
    }
    cells.resize(static_cast<std::size_t>(end - cells.data()));
    if (view.light != Light::Off) addSlopes(*points, pieces, rows, slopes);
}
}  // namespace render
#endif
