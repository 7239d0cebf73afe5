#include "render/gpu_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace render {
namespace {

std::vector<glm::vec2> axisTable(const Lattice& lattice) {
    std::vector<glm::vec2> table;
    for (int a = 0; a < 3; ++a)
        for (std::size_t i = 0; i < lattice.positions()[a].size(); ++i)
            table.emplace_back(lattice.positions()[a][i], lattice.widths()[a][i]);
    return table;
}

constexpr std::uint64_t kMostDrawable = std::numeric_limits<GLint>::max();

const timeseries::SortedStep& drawable(const timeseries::SortedStep& step) {
    if (step.size() > kMostDrawable)
        throw std::length_error(
            fmt::format("{} kept points are more than the {} that can be drawn: keep fewer",
                        step.size(), kMostDrawable));
    return step;
}

constexpr std::uint32_t kCells = 32;  // along an axis

// The five bits of a cell's number along one axis, each followed by two zeros.
std::uint32_t spread(std::uint32_t cell) {
    return (cell & 1) | (cell & 2) << 2 | (cell & 4) << 4 | (cell & 8) << 6 | (cell & 16) << 8;
}

// Per axis, by index along it: the axis's part of a cell's number on the curve.
std::array<std::vector<std::uint32_t>, 3> curveTables(glm::uvec3 size) {
    std::array<std::vector<std::uint32_t>, 3> tables;
    for (int a = 0; a < 3; ++a)
        for (std::uint64_t i = 0; i < size[a]; ++i)
            tables[a].push_back(spread(static_cast<std::uint32_t>(i * kCells / size[a])) << a);
    return tables;
}

}  // namespace

ValueScale ValueScale::of(const std::vector<Layer>& layers) {
    ValueScale narrowest;
    for (const Layer& layer : layers) {
        const auto* map = std::get_if<ByValue>(&layer.style.color);
        if (map == nullptr) continue;
        const double halfWidth = map->halfWidth();
        if (halfWidth > 0 && (narrowest.halfWidth == 0 || halfWidth < narrowest.halfWidth))
            narrowest = {map->lo, halfWidth};
    }
    return narrowest;
}

float ValueScale::operator()(double value) const {
    if (halfWidth == 0) return 0;
    constexpr double kMost = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp((0.5 * value - 0.5 * lo) / halfWidth, -kMost, kMost));
}

std::vector<std::uint16_t> nearOrder(std::span<const std::uint32_t> gridIndex, glm::uvec3 size) {
    const auto tables = curveTables(size);
    std::vector<std::uint16_t> cell;
    cell.reserve(gridIndex.size());
    for (const std::uint32_t i : gridIndex)
        cell.push_back(static_cast<std::uint16_t>(tables[0][i % size.x] |
                                                  tables[1][i / size.x % size.y] |
                                                  tables[2][i / size.x / size.y]));
    std::vector<std::uint32_t> next(kCells * kCells * kCells + 1);
    for (const std::uint16_t c : cell) ++next[c + 1u];
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::vector<std::uint16_t> order(cell.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        order[next[cell[i]]++] = static_cast<std::uint16_t>(i);
    return order;
}

GpuStep::GpuStep(const timeseries::SortedStep& step, const Lattice& lattice)
    : gridIndex_(drawable(step).size() * sizeof(std::uint32_t)),
      place_(step.size() * sizeof(std::uint16_t)),
      axisPoints_(std::span<const glm::vec2>(axisTable(lattice))),
      axisTexture_(GL_RG32F, axisPoints_),
      present_((step.size() + kBlock - 1) / kBlock) {}

void GpuStep::need(const Scene& scene, const std::optional<ValueScale>& scale) {
    if (scale && !(values_ && *scale == scale_)) {
        if (!values_) values_.emplace(scene.step.size() * sizeof(float));
        scale_ = *scale;
        present_.assign(present_.size(), false);
    }
    for (const Layer& layer : scene.layers)
        for (const timeseries::Run& run : layer.runs)
            for (std::uint64_t b = run.first / kBlock; b * kBlock < run.first + run.count; ++b)
                if (!present_[b]) upload(scene, b);
}

void GpuStep::upload(const Scene& scene, std::uint64_t block) {
    const std::uint64_t first = block * kBlock;
    const std::uint64_t count = std::min(kBlock, scene.step.size() - first);
    const auto index = scene.step.gridIndex().subspan(first, count);
    const std::vector<std::uint16_t> places = nearOrder(index, scene.lattice.size());
    std::vector<std::uint32_t> ordered;
    for (const std::uint16_t place : places) ordered.push_back(index[place]);
    gridIndex_.write(first * sizeof ordered[0], count * sizeof ordered[0], ordered.data());
    place_.write(first * sizeof places[0], count * sizeof places[0], places.data());
    if (values_) {
        std::vector<float> values;
        for (const std::uint16_t place : places)
            values.push_back(scale_(timeseries::toDouble(scene.step.value(first + place))));
        values_->write(first * sizeof values[0], count * sizeof values[0], values.data());
    }
    present_[block] = true;
}

std::size_t GpuStep::blocksUploaded() const {
    return static_cast<std::size_t>(std::count(present_.begin(), present_.end(), true));
}

}  // namespace render
