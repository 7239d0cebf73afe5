#include "render/splat/gl_cell_splatter.h"

#include <algorithm>
#include <string>

#include "render/gl/pass.h"
#include "render/model/footprint.h"
#include "render/shader_sources.h"
#include "render/splat/cell_view.h"
#include "render/splat/gl_targets.h"

namespace render {
namespace {

// GLSL mirror: CellView in shaders/cell.vert and shaders/cell.frag.
struct CellViewBlock {
    glm::mat4 viewFromAxes;
    glm::vec4 eye, rayAxis, perPixelX, perPixelY, window, depths, squares, products;
    glm::uvec4 cells;
};

CellViewBlock blockOf(const Scene& scene, const View& view, Channels channels) {
    const PointsView seen(scene.placed, view);
    const PixelRays& rays = seen.rays;
    const std::array<float, 6> metric = gradientMetric(scene.placed);
    const auto light = channels == Channels::Over ? static_cast<float>(scene.light) : 0.0f;
    CellViewBlock b{};
    b.viewFromAxes = glm::mat4(seen.viewFromAxes);
    b.eye = glm::vec4(glm::dvec4(rays.eye, rays.near));
    b.rayAxis = glm::vec4(glm::dvec4(rays.axis, seen.rayLength / seen.unitLength));
    b.perPixelX = glm::vec4(glm::dvec4(rays.perPixelX, rays.focal.x));
    b.perPixelY = glm::vec4(glm::dvec4(rays.perPixelY, rays.focal.y));
    b.window = {glm::vec2(rays.centre), glm::vec2(view.size)};
    b.depths = {view.clipFromView[3][2], -view.clipFromView[2][2], seen.rayLength, 0};
    b.squares = {metric[0], metric[1], metric[2], light};
    b.products = {metric[3], metric[4], metric[5], 0};
    b.cells = {scene.cells->size(), 0};
    return b;
}

class GlCellPlane final : public PlaneSum {
 public:
    GlCellPlane(GlCellSplatter& splatter, const Scene& scene, std::shared_ptr<GlCells> cells,
                const View& view, Channels channels, std::size_t plane, GlTargets& targets)
        : splatter_(splatter),
          scene_(scene),
          cells_(std::move(cells)),
          view_(view),
          channels_(channels),
          plane_(plane),
          targets_(targets) {
        std::tie(next_, end_) = cells_->placesOf(channels, plane);
        if (channels == Channels::Over) order_ = cells_->farthestFirst(CellRank(scene, view));
    }
    std::uint64_t add(std::uint64_t splats) override {
        const auto count = static_cast<std::uint32_t>(
            std::min<std::uint64_t>(std::max(splats, kLeast), end_ - next_));
        splatter_.draw({scene_, *cells_, order_.get(), view_, channels_, next_, count}, plane_,
                       targets_);
        next_ += count;
        return count;
    }
    bool done() const override { return next_ == end_; }

 private:
    static constexpr std::uint64_t kLeast = 1 << 10;
    GlCellSplatter& splatter_;
    const Scene& scene_;
    std::shared_ptr<GlCells> cells_;
    std::shared_ptr<const gl::Buffer> order_;
    const View& view_;
    Channels channels_;
    std::size_t plane_;
    GlTargets& targets_;
    std::uint32_t next_ = 0, end_ = 0;
};

class GlCellFrame final : public SplatFrame {
 public:
    GlCellFrame(GlCellSplatter& splatter, const Scene& scene, std::shared_ptr<GlCells> cells)
        : splatter_(splatter), scene_(scene), cells_(std::move(cells)) {}

    std::uint64_t splats(Channels channels, std::size_t layer) const override {
        const auto [first, end] = cells_->placesOf(channels, layer);
        return end - first;
    }
    std::unique_ptr<PlaneSum> begin(const View& view, Channels channels, std::size_t layer,
                                    Targets& targets) override {
        GlTargets& onGl = targets.onGl();
        onGl.clearedPlane(layer, channels);
        glTextureBarrier();  // the opaque scene's depth, which shaders read
        return std::make_unique<GlCellPlane>(splatter_, scene_, cells_, view, channels, layer,
                                             onGl);
    }

 private:
    GlCellSplatter& splatter_;
    const Scene& scene_;
    std::shared_ptr<GlCells> cells_;
};

}  // namespace

GlCellSplatter::GlCellSplatter(const GlSplatter& layers)
    : layers_(layers), view_(sizeof(CellViewBlock)) {}

std::uint64_t GlCellSplatter::mostBytes() {
    GLint blocks = 0;  // GL 4.5 promises none to vertices
    glGetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &blocks);
    if (blocks < 2) return 0;
    constexpr GLint64 kMost = 1 << 29;
    GLint64 bound = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bound);
    return static_cast<std::uint64_t>(std::min(bound, kMost));
}

const gl::Program& GlCellSplatter::program(const Variant& variant) {
    if (const auto found = programs_.find(variant); found != programs_.end()) return found->second;
    std::string defines = defineOf(variant.channels);
    if (variant.ordered) defines += "#define ORDERED\n";
    return programs_
        .emplace(variant,
                 gl::Program("cell", shaders::cell_vert, shaders::cell_frag, defines.c_str()))
        .first->second;
}

std::unique_ptr<SplatFrame> GlCellSplatter::prepare(const Scene& scene, DrawList, const GlStep&) {
    if (!cells_ || !cells_->areOf(scene)) {
        cells_.reset();  // before there are others
        cells_ = std::make_shared<GlCells>(scene);
    }
    return std::make_unique<GlCellFrame>(*this, scene, cells_);
}

void GlCellSplatter::draw(const Draw& what, std::size_t plane, GlTargets& targets) {
    if (what.count == 0) return;
    const CellViewBlock block = blockOf(what.scene, what.view, what.channels);
    view_.write(0, sizeof block, &block);
    const gl::Program& with = program({what.channels, what.order != nullptr});
    gl::begin(
        {.framebuffer = targets.planeFramebuffer(plane),
         .size = what.view.size,
         .blend = what.channels == Channels::Over ? gl::Blend::Premultiplied : gl::Blend::Add});
    glUseProgram(with.id());
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, view_.id());
    glBindBufferBase(GL_UNIFORM_BUFFER, 1, layers_.layerBlock().id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, what.cells.pieces().id());
    if (what.order) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, what.order->id());
    glBindTextureUnit(0, what.cells.sides().id());
    glBindTextureUnit(1, layers_.colorMaps().id());
    // Read where it is also attached, which is defined after a barrier as long as nothing writes
    // it.
    glBindTextureUnit(2, targets.depth().id());
    glProgramUniform1ui(with.id(), 0, what.first);
    glBindVertexArray(nothing_.id());
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(6 * what.count));
}

}  // namespace render
