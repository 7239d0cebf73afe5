#include "render/gl_list.h"

#include <algorithm>

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

}  // namespace

GpuList::GpuList(const Scene& scene, const DrawList& list, const GpuStep& step,
                 const ValueScale& scale)
    : scene_(scene), step_(step), cubes_(scene.lattice.cubes()) {
    if (const auto* sorted = std::get_if<Sorted>(&list)) {
        const std::vector<SortedPoint> points = gathered(scene, *sorted, scale);
        sorted_.emplace(std::span<const SortedPoint>(points));
        sortedCount_ = static_cast<GLsizei>(points.size());
    } else {
        for (const Layer& layer : scene.layers) runs_.push_back(layer.runs);
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
            array.attach({3, step.place(), 1, GL_UNSIGNED_SHORT, 2, 0, divisor});
            if (step.values() != nullptr)
                array.attach({1, *step.values(), 1, GL_FLOAT, 4, 0, divisor});
        }
    }
}

void GpuList::draw(bool quads, std::optional<std::size_t> layer) const {
    glBindVertexArray((quads ? quads_ : points_).id());
    if (sorted_) {
        // Every point, wherever it stands.
        glVertexAttribI4ui(3, 0, 0, 0, 1);
        glVertexAttribI4ui(4, 0, 0xffffffffu, 0, 0);
        if (quads)
            glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, sortedCount_);
        else
            glDrawArrays(GL_POINTS, 0, sortedCount_);
        return;
    }
    for (std::size_t k = 0; k < runs_.size(); ++k) {
        if (layer && *layer != k) continue;
        // Attributes without an array: one value for all.
        glVertexAttribI4ui(2, static_cast<GLuint>(k), 0, 0, 1);
        if (step_.values() == nullptr) glVertexAttrib1f(1, 0);
        for (const timeseries::Run& run : runs_[k]) drawBlocksOf(run, quads);
    }
}

void GpuList::drawBlocksOf(const timeseries::Run& run, bool quads) const {
    constexpr std::uint64_t kBlock = GpuStep::kBlock;
    const std::uint64_t last = run.first + run.count - 1;
    const std::uint64_t from = run.first / kBlock * kBlock;
    const std::uint64_t to = std::min((last / kBlock + 1) * kBlock, scene_.step.size());
    const auto first = static_cast<GLint>(from);
    const auto count = static_cast<GLsizei>(to - from);
    glVertexAttribI4ui(4, static_cast<GLuint>(run.first), static_cast<GLuint>(last),
                       static_cast<GLuint>(from), 0);
    if (quads)
        glDrawArraysInstancedBaseInstance(GL_TRIANGLE_STRIP, 0, 4, count,
                                          static_cast<GLuint>(first));
    else
        glDrawArrays(GL_POINTS, first, count);
}

}  // namespace render
