#include "render/gl_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

namespace render {
namespace {

// One entry of a sorted list as splat.vert reads it.
struct SortedPoint {
    std::uint32_t gridIndex;
    float value;
    std::uint32_t layer;
};

std::vector<SortedPoint> gathered(const Scene& scene, const Sorted& list, const ValueScale& scale) {
    std::vector<SortedPoint> out;
    out.reserve(list.point.size());
    for (std::size_t i = 0; i < list.point.size(); ++i) {
        const std::uint32_t p = list.point[i];
        out.push_back({scene.step.gridIndex()[p], scale(timeseries::toDouble(scene.step.value(p))),
                       list.layer[i]});
    }
    return out;
}

std::vector<glm::vec2> axisTable(const Lattice& lattice) {
    std::vector<glm::vec2> table;
    for (int a = 0; a < 3; ++a)
        for (std::size_t i = 0; i < lattice.positions()[a].size(); ++i)
            table.emplace_back(lattice.positions()[a][i], lattice.widths()[a][i]);
    return table;
}

// Values from the first-th point on, as many as `into` takes.
void scaled(const timeseries::SortedStep& step, std::uint64_t first, const ValueScale& scale,
            std::vector<float>& into) {
    std::visit(
        [&](const auto& values) {
            for (std::size_t i = 0; i < into.size(); ++i)
                into[i] = scale(static_cast<double>(values[first + i]));
        },
        step.values());
}

constexpr std::uint64_t kMostDrawable = std::numeric_limits<GLint>::max();

const timeseries::SortedStep& drawable(const timeseries::SortedStep& step) {
    if (step.size() > kMostDrawable)
        throw std::length_error(
            fmt::format("{} kept points are more than the {} that can be drawn: keep fewer",
                        step.size(), kMostDrawable));
    return step;
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

bool ValueScale::serves(const ValueScale& wanted) const {
    // A float's error of 2^-24 grows by how far the two are apart and how much they differ in
    // width, in widths of the wanted one.
    constexpr double kMostWidths = 1024;
    if (!(wanted.halfWidth > 0)) return true;
    return halfWidth > 0 &&
           halfWidth / wanted.halfWidth + std::abs(0.5 * lo - 0.5 * wanted.lo) / wanted.halfWidth <=
               kMostWidths;
}

GpuStep::GpuStep(const timeseries::SortedStep& step, const Lattice& lattice)
    : count_(drawable(step).size()),
      gridIndex_(count_ * sizeof(std::uint32_t)),
      axisPoints_(std::span<const glm::vec2>(axisTable(lattice))),
      axisTexture_(GL_RG32F, axisPoints_) {}

void GpuStep::place(const Lattice& lattice) {
    const std::vector<glm::vec2> table = axisTable(lattice);
    axisPoints_.write(0, table.size() * sizeof table[0], table.data());
}

void GpuStep::upload(const timeseries::SortedStep& step, const std::optional<ValueScale>& scale,
                     std::uint64_t bytes) {
    std::uint64_t left = bytes / sizeof(float);  // points and values have one size
    const std::uint64_t points = std::min(left, count_ - points_);
    gridIndex_.write(points_ * sizeof(std::uint32_t), points * sizeof(std::uint32_t),
                     step.gridIndex().data() + points_);
    points_ += points;
    left -= points;
    if (!scale || (values_ && values_->scale == *scale)) {
        coming_.reset();
        return;
    }
    if (!coming_ || coming_->scale != *scale)
        coming_.emplace(ScaledValues{gl::Buffer(count_ * sizeof(float)), *scale});
    constexpr std::uint64_t kChunk = std::uint64_t{1} << 16;
    std::vector<float> chunk;
    for (; left > 0 && coming_->count < count_; left -= chunk.size()) {
        chunk.resize(std::min({left, kChunk, count_ - coming_->count}));
        scaled(step, coming_->count, *scale, chunk);
        coming_->buffer.write(coming_->count * sizeof(float), chunk.size() * sizeof(float),
                              chunk.data());
        coming_->count += chunk.size();
    }
    if (coming_->count < count_) return;
    values_.emplace(std::move(*coming_));
    coming_.reset();
}

std::uint64_t GpuStep::missingBytes(const std::optional<ValueScale>& scale) const {
    std::uint64_t missing = count_ - points_;
    if (scale && !(values_ && values_->scale == *scale))
        missing += count_ - (coming_ && coming_->scale == *scale ? coming_->count : 0);
    return missing * sizeof(float);
}

std::uint64_t GpuStep::bytes() const {
    std::uint64_t bytes = gridIndex_.bytes() + axisPoints_.bytes();
    for (const auto& values : {std::cref(values_), std::cref(coming_)})
        if (values.get()) bytes += values.get()->buffer.bytes();
    return bytes;
}

std::optional<ValueScale> neededScale(const Scene& scene) {
    const auto byValue = [](const Layer& layer) {
        return std::holds_alternative<ByValue>(layer.style.color);
    };
    if (scene.order != Order::None || std::ranges::none_of(scene.layers, byValue)) return {};
    return ValueScale::of(scene.layers);
}

GpuList::GpuList(const Scene& scene, const DrawList& list, const GpuStep& step,
                 const ValueScale& scale)
    : scene_(scene), step_(step), cubes_(scene.lattice.cubes()) {
    if (const auto* sorted = std::get_if<Sorted>(&list)) {
        const std::vector<SortedPoint> points = gathered(scene, *sorted, scale);
        sorted_.emplace(std::span<const SortedPoint>(points));
        sortedCount_ = static_cast<GLsizei>(points.size());
    }
    for (const GLuint divisor : {0u, 1u}) {
        gl::VertexArray& array = divisor == 0 ? points_ : quads_;
        if (sorted_) {
            constexpr GLsizei kStride = sizeof(SortedPoint);
            array.attach({0, *sorted_, 1, GL_UNSIGNED_INT, kStride, 0, divisor});
            array.attach({1, *sorted_, 1, GL_FLOAT, kStride, 4, divisor});
            array.attach({2, *sorted_, 1, GL_UNSIGNED_INT, kStride, 8, divisor});
        } else {
            array.attach({0, step.gridIndex(), 1, GL_UNSIGNED_INT, 4, 0, divisor});
            if (step.values() != nullptr)
                array.attach({1, *step.values(), 1, GL_FLOAT, 4, 0, divisor});
        }
    }
}

void GpuList::drawSorted(bool quads) const {
    if (quads)
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, sortedCount_);
    else
        glDrawArrays(GL_POINTS, 0, sortedCount_);
}

void GpuList::drawRun(const timeseries::Run& run, bool quads) {
    // The run's first point becomes the arrays' first, its stride theirs.
    gl::VertexArray& array = quads ? quads_ : points_;
    const std::size_t first = run.first * sizeof(std::uint32_t);
    const auto stride = static_cast<GLsizei>(scene_.stride * sizeof(std::uint32_t));
    array.move(0, step_.gridIndex(), first, stride);
    if (step_.values() != nullptr) array.move(1, *step_.values(), first, stride);
    const auto count = static_cast<GLsizei>((run.count + scene_.stride - 1) / scene_.stride);
    if (quads)
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
    else
        glDrawArrays(GL_POINTS, 0, count);
}

void GpuList::draw(bool quads, std::optional<std::size_t> layer) {
    glBindVertexArray((quads ? quads_ : points_).id());
    if (sorted_) return drawSorted(quads);
    for (std::size_t k = 0; k < scene_.layers.size(); ++k) {
        if (layer && *layer != k) continue;
        // Attributes without an array: one value for all.
        glVertexAttribI4ui(2, static_cast<GLuint>(k), 0, 0, 1);
        if (step_.values() == nullptr) glVertexAttrib1f(1, 0);
        for (const timeseries::Run& run : scene_.layers[k].runs) drawRun(run, quads);
    }
}

}  // namespace render
