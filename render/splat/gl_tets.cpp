#include "render/splat/gl_tets.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "render/splat/cell_view.h"
#include "render/together.h"
#include "timeseries/grid/solid_cells.h"

namespace render {
namespace {

constexpr double kSixAboutADiagonal = 6;

// False where it takes nothing of the range; slopes where light falls on it.
bool takeTet(GlTet& t, GlTetSlopes& slopes, const ValuedTet& tet, const CellOfLayer& of,
             const Scene& scene, double steep) {
    const auto [low, high] = std::minmax_element(tet.values.begin(), tet.values.end());
    if (!cell::touches(*low, *high, tet.lo, tet.hi) || isFlat(tet.at, turnOf(tet.at))) return false;
    TetSplat<float> s;
    std::array<double, 4> f{};
    if (!tet::seeField(s, tet, *low, *high, tet::slopesOf(tet.at), scene.placed.unitLength(), f))
        return false;
    for (std::size_t i = 0; i < 4; ++i)
        t.corners[i] = glm::vec4(glm::dvec4(i == 0 ? tet.at[0] : tet.at[i] - tet.at[0], f[i]));
    t.least = s.least;
    t.most = s.most;
    t.perRange = s.perRange;
    t.steep = steepnessIn(s.extent, steep);
    t.map = glMapPlaceOf(scene.layers[of.layer].style, cell::coloredField(s, tet));
    t.kind = static_cast<std::uint32_t>(s.crossesLeast) << 4 |
             static_cast<std::uint32_t>(s.crossesMost) << 5 | std::uint32_t{of.layer} << 8;
    t.cell = of.cell;
    if (scene.light == Light::Off) return true;
    const std::array<glm::dvec3, 4> gradients =
        tet::gradientsOf(s, tet.gradients, tet.gradientUnit);
    for (int a = 0; a < 3; ++a)
        slopes[static_cast<std::size_t>(a)] = glm::vec4(
            glm::dvec4(gradients[0][a], gradients[1][a], gradients[2][a], gradients[3][a]));
    return true;
}

// Of each of these, where it comes, the nearest first.
std::vector<std::uint32_t> placesInOrder(const Scene& scene, const View& view,
                                         std::span<const CellOfLayer> cells) {
    const CellRank rank(scene, view);
    const std::vector<CellOfLayer> inOrder = cellsOf(scene, Channels::Over, 0, &rank);
    std::vector<std::uint32_t> places(cells.size()), ofCell;
    for (std::size_t layer = 0; layer < scene.layers.size(); ++layer) {
        for (std::uint32_t at = 0; at < inOrder.size(); ++at) {
            if (inOrder[at].layer != layer) continue;
            if (inOrder[at].cell >= ofCell.size()) ofCell.resize(inOrder[at].cell + std::size_t{1});
            ofCell[inOrder[at].cell] = at;
        }
        for (std::size_t i = 0; i < cells.size(); ++i)
            if (cells[i].layer == layer) places[i] = ofCell[cells[i].cell];
    }
    return places;
}

}  // namespace

double GlTets::perCell(const Scene& scene) {
    const auto& solids = scene.placed.mesh()->solids();
    return solids ? static_cast<double>(solids->tets()) / static_cast<double>(solids->count())
                  : kSixAboutADiagonal;
}

GlTets::GlTets(const Scene& scene, std::uint64_t mostBytes)
    : GlPieces(scene), mostBytes_(mostBytes), listing_(Listing{}) {
    listing_->all = cellsOf(scene, Channels::Over, 0);
    listing_->firsts.resize(scene.layers.size() + 1);
}

double GlTets::goOn(const Scene& scene, std::uint64_t cells) {
    constexpr double kListing = 0.8;  // of the work
    if (!listing_) return 1;
    Listing& l = *listing_;
    const auto share = [](std::size_t done, std::size_t all) {
        return static_cast<double>(done) / static_cast<double>(all + 1);
    };
    if (l.listed < l.all.size()) {
        list(scene, cells);
        return kListing * share(l.listed, l.all.size());
    }
    const bool isLit = scene.light != Light::Off;
    if (!sending_) {
        sending_ = std::make_unique<gl::Buffer>(l.count * sizeof(GlTet));
        if (isLit) slopes_ = std::make_unique<gl::Buffer>(l.count * sizeof(GlTetSlopes));
    }
    if (l.sent < l.parts.size()) {
        send(isLit);
        return kListing + (1 - kListing) * share(l.sent, l.parts.size());
    }
    std::partial_sum(l.firsts.begin(), l.firsts.end(), l.firsts.begin());
    take(std::move(sending_), std::move(l.firsts));
    cells_.emplace(std::span<const std::uint32_t>(l.cells));
    middles_.emplace(std::span<const glm::vec4>(l.middles));
    listing_.reset();
    return 1;
}

void GlTets::list(const Scene& scene, std::uint64_t cells) {
    constexpr std::size_t kWorthAThread = 1 << 10;
    Listing& l = *listing_;
    const double steep = steepnessOf(scene);
    const auto some =
        std::span(l.all).subspan(l.listed, std::min<std::uint64_t>(cells, l.all.size() - l.listed));
    const unsigned shared = threadsFor(some.size(), kWorthAThread, sharingThreads());
    const std::size_t before = l.parts.size();
    l.parts.resize(before + shared);
    sharing(shared, [&](unsigned k) {
        const std::size_t first = some.size() * k / shared, last = some.size() * (k + 1) / shared;
        forEachTet(scene, some.subspan(first, last - first), nullptr,
                   [&](const ValuedTet& tet, const CellOfLayer& of) {
                       GlTet piece{};
                       GlTetSlopes slopes;
                       if (!takeTet(piece, slopes, tet, of, scene, steep)) return;
                       l.parts[before + k].tets.push_back(piece);
                       if (scene.light != Light::Off) l.parts[before + k].slopes.push_back(slopes);
                   });
    });
    for (std::size_t k = before; k < l.parts.size(); ++k) keep(scene, l.parts[k].tets);
    if (l.count * sizeof(GlTet) > mostBytes_) throw std::runtime_error(kTooManyPieces);
    l.listed += some.size();
}

void GlTets::keep(const Scene& scene, const std::vector<GlTet>& part) {
    Listing& l = *listing_;
    for (const GlTet& piece : part) {
        const std::uint32_t layer = piece.kind >> 8;
        if (of_.empty() || of_.back().cell != piece.cell || of_.back().layer != layer) {
            const glm::dvec3 middle = middleOfCell(scene, piece.cell);
            radius_ = std::max(radius_, glm::length(middle));
            l.middles.emplace_back(glm::dvec4(middle, 0));
            of_.push_back({piece.cell, static_cast<std::uint8_t>(layer)});
        }
        l.cells.push_back(static_cast<std::uint32_t>(l.middles.size() - 1));
        ++l.firsts[layer + 1];
    }
    l.count += part.size();
}

void GlTets::send(bool isLit) {
    constexpr std::uint64_t kAtOnce = (std::uint64_t{16} << 20) / sizeof(GlTet);
    Listing& l = *listing_;
    for (std::uint64_t tets = 0; l.sent < l.parts.size() && tets < kAtOnce; ++l.sent) {
        Part& part = l.parts[l.sent];
        const std::size_t count = part.tets.size();
        sending_->write(l.sentTets * sizeof(GlTet), count * sizeof(GlTet), part.tets.data());
        if (isLit)
            slopes_->write(l.sentTets * sizeof(GlTetSlopes), count * sizeof(GlTetSlopes),
                           part.slopes.data());
        l.sentTets += count;
        tets += count;
        part = {};
    }
}

std::uint64_t GlTets::bytes() const {
    std::uint64_t sum = GlPieces::bytes();
    for (const auto* held : {&sending_, &slopes_})
        if (*held) sum += (*held)->bytes();
    for (const auto* held : {&cells_, &middles_})
        if (*held) sum += (*held)->bytes();
    return sum;
}

glm::dvec3 GlTets::keyOf(const Scene&, const View& view) const { return pixelRays(view).eye; }

std::shared_ptr<const gl::Buffer> GlTets::order(const Scene& scene, const View& view,
                                                GlPieceOrder& order) const {
    std::optional<gl::Buffer> places;
    if (!scene.byMiddles)
        places.emplace(std::span<const std::uint32_t>(placesInOrder(scene, view, of_)));
    return order(
        TetsToOrder{count(), radius_, pieces(), *cells_, *middles_, places ? &*places : nullptr},
        keyOf(scene, view));
}

}  // namespace render
