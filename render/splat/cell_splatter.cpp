#include "render/splat/cell_splatter.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "render/model/cell_splat.h"
#include "render/splat/rows_in_turns.h"

namespace render {
namespace {

using timeseries::CellIndex;
using timeseries::Interval;

constexpr std::uint64_t kAtOnce = 1 << 15;

struct CellOfLayer {
    std::uint32_t cell;
    std::uint8_t layer;
};

// Of these layers, as their candidates lie.
std::vector<CellOfLayer> candidates(const Scene& scene, std::size_t layer, std::size_t last) {
    std::vector<CellOfLayer> cells;
    std::uint64_t count = 0;
    for (std::size_t k = layer; k < last; ++k) count += cellCount(scene.layers[k]);
    cells.reserve(count);
    for (; layer < last; ++layer)
        for (const timeseries::Run& run : scene.layers[layer].cells.candidates)
            for (std::uint64_t i = 0; i < run.count; ++i)
                cells.push_back(
                    {scene.cells->cell(run.first + i), static_cast<std::uint8_t>(layer)});
    return cells;
}

// Before which point of its axis a place lies: the index of the cell that holds it.
int cellAlong(const std::vector<double>& positions, double place) {
    const bool down = positions.front() > positions.back();
    const auto before = [&](double at) { return down ? at > place : at < place; };
    return static_cast<int>(std::ranges::partition_point(positions, before) - positions.begin());
}

// The nearest first. What hides a part of a cell lies, along each axis, no farther from the eye's
// cell than it does, and nearer along one: the sum of these distances, in cells, is an order.
void orderByDepth(const Scene& scene, const View& view, std::vector<CellOfLayer>& cells) {
    const glm::dvec3 eye = pixelRays(scene.placed.inAxes(view)).eye;
    const glm::uvec3 size = scene.cells->size();
    glm::ivec3 at;
    for (int a = 0; a < 3; ++a)
        at[a] = cellAlong(scene.placed.positions()[static_cast<std::size_t>(a)], eye[a]);
    const auto distance = [&](const CellOfLayer& c) {
        const glm::ivec3 from = glm::ivec3(timeseries::indicesOf(c.cell, size)) - at;
        return static_cast<std::size_t>(std::abs(from.x) + std::abs(from.y) + std::abs(from.z));
    };
    std::vector<std::size_t> next(std::size_t{size.x} + size.y + size.z + 1);
    for (const CellOfLayer& c : cells) ++next[distance(c)];
    std::size_t first = 0;
    for (std::size_t& n : next) first += std::exchange(n, first);
    std::vector<CellOfLayer> ordered(cells.size());
    for (const CellOfLayer& c : cells) ordered[next[distance(c)]++] = c;
    cells = std::move(ordered);
}

// A piece of a cell that a range reaches into, ready to be drawn.
struct Placed {
    CellSplat<float> splat;
    PixelSpan x, y;
    std::uint8_t layer = 0;
};

class SeenCells {
 public:
    SeenCells(const Scene& scene, const View& view, Channels channels)
        : scene_(scene),
          view_(view),
          channels_(channels),
          seen_(scene.placed, view),
          axis_(seen_.rays.centre),
          slope_(1.0 / seen_.rays.focal) {
        for (const Layer& layer : scene.layers)
            depthPerWeight_.push_back(
                static_cast<float>(opticalDepthPerWeight(layer.style.opacity)));
    }

    // Adds the cell's pieces in the box, in the order in which they stand.
    void place(const CellOfLayer& cell, const PixelBox& box, std::vector<Placed>& into) const;
    // Adds to the pixels of row y, the box's first one first.
    void addRow(const Placed& placed, int y, const PixelBox& box, const float* opaqueRow,
                float* row) const;

 private:
    void placePiece(const ValuedCell& piece, std::size_t layer, const PixelBox& box,
                    std::vector<Placed>& into) const;
    void placeOctants(const ValuedCell& cell, unsigned octants, std::size_t layer,
                      const PixelBox& box, std::vector<Placed>& into) const;
    void deposit(const Placed& placed, const CellFragment<float>& fragment, float* pixel) const;
    float viewDepth(float windowDepth) const {
        const glm::dmat4& m = view_.clipFromView;
        return static_cast<float>(m[3][2] / (static_cast<double>(windowDepth) + m[2][2]));
    }

    const Scene& scene_;
    const View& view_;
    Channels channels_;
    PointsView seen_;
    glm::vec2 axis_;   // window position of the view axis
    glm::vec2 slope_;  // x / -z and y / -z a pixel
    std::vector<float> depthPerWeight_;
};

// The grid's coordinates of a cell's two ends along an axis: points, or half a cell beyond them.
std::pair<double, double> endsAlong(const PlacedPoints& placed, std::size_t axis,
                                    std::uint32_t cell) {
    const auto &at = placed.positions()[axis], &width = placed.widths()[axis];
    const double up = at.front() > at.back() ? -0.5 : 0.5;
    return {cell == 0 ? at.front() - up * width.front() : at[cell - 1],
            cell == at.size() ? at.back() + up * width.back() : at[cell]};
}

void SeenCells::place(const CellOfLayer& of, const PixelBox& box, std::vector<Placed>& into) const {
    const glm::uvec3 at = timeseries::indicesOf(of.cell, scene_.cells->size());
    ValuedCell cell{};
    cell.corners = scene_.cells->corners(at);
    for (int a = 0; a < 3; ++a)
        std::tie(cell.from[a], cell.to[a]) =
            endsAlong(scene_.placed, static_cast<std::size_t>(a), at[a]);
    // What is nearest to a missing point, or to one outside the clip box, is nowhere.
    unsigned octants = 0;
    double sum = 0;
    int valid = 0;
    for (unsigned c = 0; c < 8; ++c) {
        if (std::isnan(cell.corners[c])) continue;
        sum += cell.corners[c] / 8;
        ++valid;
        if (scene_.clip.holds(scene_.cells->pointAt(at, c))) octants |= 1u << c;
    }
    if (octants == 0) return;
    for (double& v : cell.corners)
        if (std::isnan(v)) v = sum * (8.0 / valid);
    for (const Interval<double>& range : scene_.layers[of.layer].cells.ranges) {
        cell.lo = range.lo;
        cell.hi = range.hi;
        if (octants == 255)
            placePiece(cell, of.layer, box, into);
        else
            placeOctants(cell, octants, of.layer, box, into);
    }
}

// Each with the field's values at its own corners.
void SeenCells::placeOctants(const ValuedCell& cell, unsigned octants, std::size_t layer,
                             const PixelBox& box, std::vector<Placed>& into) const {
    for (unsigned o = 0; o < 8; ++o) {
        if ((octants >> o & 1) == 0) continue;
        ValuedCell piece = cell;
        const glm::dvec3 first(o & 1 ? 0.5 : 0, o & 2 ? 0.5 : 0, o & 4 ? 0.5 : 0);
        piece.from = glm::mix(cell.from, cell.to, first);
        piece.to = glm::mix(cell.from, cell.to, first + 0.5);
        for (unsigned c = 0; c < 8; ++c)
            piece.corners[c] = render::cell::valueAt(
                cell.corners, first + 0.5 * glm::dvec3(c & 1, c >> 1 & 1, c >> 2));
        placePiece(piece, layer, box, into);
    }
}

void SeenCells::placePiece(const ValuedCell& piece, std::size_t layer, const PixelBox& box,
                           std::vector<Placed>& into) const {
    Placed placed;
    placed.splat = cellSplatAt<float>(seen_, piece);
    const CellSplat<float>& s = placed.splat;
    if (!s.visible) return;
    const auto span = [&](int a) {
        const PixelSpan whole =
            pixelSpan(axis_[a] + s.centre[a], s.lo[a], s.hi[a], Kernel::Quartic, view_.size[a]);
        return PixelSpan{std::max(whole.first, box.at[a]),
                         std::min(whole.last, box.at[a] + box.size[a])};
    };
    placed.x = span(0);
    placed.y = span(1);
    placed.layer = static_cast<std::uint8_t>(layer);
    if (placed.x.first < placed.x.last && placed.y.first < placed.y.last) into.push_back(placed);
}

void SeenCells::addRow(const Placed& placed, int y, const PixelBox& box, const float* opaqueRow,
                       float* row) const {
    const CellSplat<float>& s = placed.splat;
    const std::size_t floats = floatsPerPixel(channels_);
    const float atY = static_cast<float>(y) + 0.5f - axis_.y;
    for (int x = placed.x.first; x < placed.x.last; ++x) {
        const float atX = static_cast<float>(x) + 0.5f - axis_.x;
        const glm::vec2 at(atX, atY);
        const float opaque =
            opaqueRow ? viewDepth(opaqueRow[x]) : std::numeric_limits<float>::max();
        const CellFragment<float> fragment = fragmentOn(s, at - s.centre, at * slope_, opaque);
        if (fragment.weight > 0)
            deposit(placed, fragment, row + static_cast<std::size_t>(x - box.at.x) * floats);
    }
}

void SeenCells::deposit(const Placed& placed, const CellFragment<float>& fragment,
                        float* pixel) const {
    if (channels_ == Channels::Weight) {
        *pixel += fragment.weight;
        return;
    }
    if (channels_ == Channels::Count) {
        *pixel += 1;
        return;
    }
    const RangeStyle& style = scene_.layers[placed.layer].style;
    const glm::vec4 color(
        glm::vec3(colorOf(style, placed.splat.reference + static_cast<double>(fragment.value))), 1);
    const float taken =
        channels_ == Channels::WeightedColor
            ? fragment.weight
            : (1 - pixel[3]) * -std::expm1(-depthPerWeight_[placed.layer] * fragment.weight);
    for (int c = 0; c < 4; ++c) pixel[c] += taken * color[c];
}

}  // namespace

std::uint64_t cellCount(const Scene& scene, Channels channels, std::size_t layer) {
    const bool all = channels == Channels::Over || channels == Channels::Count;
    std::uint64_t count = 0;
    for (std::size_t k = all ? 0 : layer; k < (all ? scene.layers.size() : layer + 1); ++k)
        count += cellCount(scene.layers[k]);
    return count;
}

struct CellSum::Work {
    SeenCells seen;
    PixelBox box;
    std::size_t rowFloats, pictureWidth;
    std::span<const float> opaqueDepth;
    unsigned threads;
    std::vector<float> plane;
    std::vector<CellOfLayer> cells;
    std::size_t passed = 0;
    std::vector<std::vector<Placed>> placed;  // a part of those in work a thread

    void sum(std::span<const CellOfLayer> part);
    void addRows(const Placed& p, unsigned thread);
};

void CellSum::Work::addRows(const Placed& p, unsigned thread) {
    forEachRowOf(thread, threads, p.y, [&](int y) {
        seen.addRow(p, y, box,
                    opaqueDepth.empty() ? nullptr
                                        : &opaqueDepth[static_cast<std::size_t>(y) * pictureWidth],
                    &plane[static_cast<std::size_t>(y - box.at.y) * rowFloats]);
    });
}

void CellSum::Work::sum(std::span<const CellOfLayer> part) {
    together(threads, [&](unsigned k) {
        placed[k].clear();
        for (std::size_t i = part.size() * k / threads; i < part.size() * (k + 1) / threads; ++i)
            seen.place(part[i], box, placed[k]);
    });
    together(threads, [&](unsigned k) {
        for (const std::vector<Placed>& some : placed)
            for (const Placed& p : some) addRows(p, k);
    });
}

CellSum::CellSum(const Scene& scene, const View& view, Channels channels, std::size_t layer,
                 std::span<const float> opaqueDepth, unsigned threads, std::vector<float> memory) {
    threads = std::max(threads, 1u);
    const PixelBox box = coveredPixels(scene, view);
    const std::size_t rowFloats = static_cast<std::size_t>(box.size.x) * floatsPerPixel(channels);
    memory.assign(rowFloats * static_cast<std::size_t>(box.size.y), 0);
    const bool all = channels == Channels::Over || channels == Channels::Count;
    auto cells = candidates(scene, all ? 0 : layer, all ? scene.layers.size() : layer + 1);
    if (channels == Channels::Over) orderByDepth(scene, view, cells);
    work_.reset(new Work{.seen{scene, view, channels},
                         .box = box,
                         .rowFloats = rowFloats,
                         .pictureWidth = static_cast<std::size_t>(view.size.x),
                         .opaqueDepth = opaqueDepth,
                         .threads = threads,
                         .plane = std::move(memory),
                         .cells = std::move(cells),
                         .placed = std::vector<std::vector<Placed>>(threads)});
}

CellSum::CellSum(CellSum&&) noexcept = default;
CellSum::~CellSum() = default;

std::uint64_t CellSum::add(std::uint64_t cells) {
    std::uint64_t added = 0;
    while (!done() && added < cells) {
        const std::span<const CellOfLayer> all(work_->cells);
        const std::uint64_t count =
            std::min({kAtOnce, cells - added, std::uint64_t{all.size() - work_->passed}});
        work_->sum(all.subspan(work_->passed, count));
        work_->passed += count;
        added += count;
    }
    return added;
}

bool CellSum::done() const { return work_->passed == work_->cells.size(); }
const PixelBox& CellSum::box() const { return work_->box; }
std::vector<float>& CellSum::plane() { return work_->plane; }
std::vector<float> CellSum::takeMemory() { return std::move(work_->plane); }

}  // namespace render
