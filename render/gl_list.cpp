#include "render/gl_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

GpuStep::GpuStep(const timeseries::SortedStep& step, const Lattice& lattice)
    : gridIndex_(drawable(step).gridIndex()),
      axisPoints_(std::span<const glm::vec2>(axisTable(lattice))),
      axisTexture_(GL_RG32F, axisPoints_) {}

void GpuStep::needValues(const timeseries::SortedStep& step, const ValueScale& scale) {
    if (values_ && scale == scale_) return;
    std::vector<float> values(step.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = scale(timeseries::toDouble(step.value(i)));
    values_.emplace(std::span<const float>(values));
    scale_ = scale;
}

std::size_t GpuStep::bytes() const {
    return gridIndex_.bytes() + axisPoints_.bytes() + (values_ ? values_->bytes() : 0);
}

GpuList::GpuList(const Scene& scene, const DrawList& list, const GpuStep& step,
                 const ValueScale& scale)
    : scene_(scene), step_(step), cubes_(scene.lattice.cubes()) {
    if (const auto* sorted = std::get_if<Sorted>(&list)) {
        const std::vector<SortedPoint> points = gathered(scene, *sorted, scale);
        sorted_.emplace(std::span<const SortedPoint>(points));
        sortedCount_ = static_cast<GLsizei>(points.size());
    } else {
        for (const Layer& layer : scene.layers) {
            LayerRuns& runs = runs_.emplace_back();
            for (const timeseries::Run& run : layer.runs) {
                runs.first.push_back(static_cast<GLint>(run.first));
                runs.count.push_back(static_cast<GLsizei>(run.count));
            }
        }
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

void GpuList::draw(bool quads, std::optional<std::size_t> layer) const {
    glBindVertexArray((quads ? quads_ : points_).id());
    if (sorted_) {
        if (quads)
            glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, sortedCount_);
        else
            glDrawArrays(GL_POINTS, 0, sortedCount_);
        return;
    }
    for (std::size_t k = 0; k < runs_.size(); ++k) {
        if (layer && *layer != k) continue;
        const LayerRuns& runs = runs_[k];
        // Attributes without an array: one value for all.
        glVertexAttribI4ui(2, static_cast<GLuint>(k), 0, 0, 1);
        if (step_.values() == nullptr) glVertexAttrib1f(1, 0);
        if (!quads) {
            glMultiDrawArrays(GL_POINTS, runs.first.data(), runs.count.data(),
                              static_cast<GLsizei>(runs.first.size()));
            continue;
        }
        for (std::size_t r = 0; r < runs.first.size(); ++r)
            glDrawArraysInstancedBaseInstance(GL_TRIANGLE_STRIP, 0, 4, runs.count[r],
                                              static_cast<GLuint>(runs.first[r]));
    }
}

}  // namespace render
