#include "render/gl_list.h"

#include <algorithm>

#include "render/block_order.h"

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

// What is sent to the vertex shader, of the points as they lie on the GPU.
struct Slices {
    std::vector<GLint> first;
    std::vector<GLsizei> count;
    void add(std::uint64_t from, std::uint64_t points) {
        first.push_back(static_cast<GLint>(from));
        count.push_back(static_cast<GLsizei>(points));
    }
};

// All that lies in the blocks that the run touches, or their beginnings, which hold the subset.
Slices slicesOf(const timeseries::Run& run, std::uint32_t stride, std::uint64_t points) {
    constexpr std::uint64_t kBlock = GpuStep::kBlock;
    const std::uint64_t from = run.first / kBlock * kBlock;
    const std::uint64_t end = run.first + run.count;
    const std::uint64_t to = std::min((end + kBlock - 1) / kBlock * kBlock, points);
    Slices slices;
    const std::uint32_t prefix = prefixStride(stride);
    if (prefix == 1) {
        slices.add(from, to - from);
        return slices;
    }
    for (std::uint64_t at = from; at < to; at += kBlock)
        slices.add(at, subsetCount({at, std::min(kBlock, to - at)}, prefix));
    return slices;
}

void drawRun(const timeseries::Run& run, std::uint32_t stride, std::uint64_t points, bool quads) {
    const Slices slices = slicesOf(run, stride, points);
    const auto first = static_cast<GLuint>(run.first);
    const auto last = static_cast<GLuint>(run.first + run.count - 1);
    const auto ranks = static_cast<GLuint>(kSubsetPeriod / stride);
    glVertexAttribI4ui(4, first, last, 0, ranks);
    if (!quads) {
        glMultiDrawArrays(GL_POINTS, slices.first.data(), slices.count.data(),
                          static_cast<GLsizei>(slices.first.size()));
        return;
    }
    for (std::size_t i = 0; i < slices.first.size(); ++i) {
        const auto at = static_cast<GLuint>(slices.first[i]);
        glVertexAttribI4ui(4, first, last, at, ranks);  // gl_InstanceID counts from 0
        glDrawArraysInstancedBaseInstance(GL_TRIANGLE_STRIP, 0, 4, slices.count[i], at);
    }
}

}  // namespace

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
            array.attach({3, step.placeInBlock(), 1, GL_UNSIGNED_SHORT, 2, 0, divisor});
            if (step.values() != nullptr)
                array.attach({1, *step.values(), 1, GL_FLOAT, 4, 0, divisor});
        }
    }
}

void GpuList::drawSorted(bool quads) const {
    // Every point, wherever it stands.
    glVertexAttribI4ui(3, 0, 0, 0, 1);
    glVertexAttribI4ui(4, 0, 0xffffffffu, 0, kSubsetPeriod);
    if (quads)
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, sortedCount_);
    else
        glDrawArrays(GL_POINTS, 0, sortedCount_);
}

void GpuList::draw(bool quads, std::optional<std::size_t> layer) const {
    glBindVertexArray((quads ? quads_ : points_).id());
    if (sorted_) return drawSorted(quads);
    for (std::size_t k = 0; k < scene_.layers.size(); ++k) {
        if (layer && *layer != k) continue;
        // Attributes without an array: one value for all.
        glVertexAttribI4ui(2, static_cast<GLuint>(k), 0, 0, 1);
        if (step_.values() == nullptr) glVertexAttrib1f(1, 0);
        const std::uint32_t stride = strideOf(scene_.layers[k], scene_.stride);
        for (const timeseries::Run& run : scene_.layers[k].runs)
            drawRun(run, stride, scene_.step.size(), quads);
    }
}

}  // namespace render
