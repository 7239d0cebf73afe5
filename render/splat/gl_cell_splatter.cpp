#include "render/splat/gl_cell_splatter.h"

#include <algorithm>
#include <limits>
#include <string>
#include <tuple>

#include "render/gl/pass.h"
#include "render/model/footprint.h"
#include "render/model/rays_across.h"
#include "render/shader_sources.h"
#include "render/splat/cell_view.h"
#include "render/splat/gl_ray_means.h"
#include "render/splat/gl_targets.h"

namespace render {
namespace {

// GLSL mirror: CellView in shaders/cell_view.glsl.
struct CellViewBlock {
    glm::mat4 viewFromAxes;
    glm::vec4 eye, rayAxis, perPixelX, perPixelY, window, depths, squares, products;
    glm::vec4 lamp, lampOfWay;
    glm::uvec4 cells;
    glm::ivec4 part;
};

CellViewBlock blockOf(const Scene& scene, const View& view, Channels channels, const PixelBox& part,
                      int raysAcross) {
    const CellsView seen(scene.placed, finer(view, raysAcross));
    const PixelRays& rays = seen.rays;
    const std::array<float, 6> metric = gradientMetric(scene.placed);
    const auto light = channels == Channels::Over ? static_cast<float>(scene.light) : 0.0f;
    CellViewBlock b{};
    b.viewFromAxes = glm::mat4(seen.viewFromAxes);
    b.eye = glm::vec4(glm::dvec4(rays.eye, rays.near));
    b.rayAxis = glm::vec4(glm::dvec4(rays.axis, seen.rayLength / seen.unitLength));
    b.perPixelX = glm::vec4(glm::dvec4(rays.perPixelX, rays.focal.x));
    b.perPixelY = glm::vec4(glm::dvec4(rays.perPixelY, rays.focal.y));
    const glm::dvec2 first(raysAcross * part.at);
    b.window = {glm::vec2(rays.centre - first), glm::vec2(raysAcross * part.size)};
    b.depths = {view.clipFromView[3][2], -view.clipFromView[2][2], seen.rayLength, 0};
    b.squares = {metric[0], metric[1], metric[2], light};
    b.products = {metric[3], metric[4], metric[5], 0};
    if (const auto lamp = axisLamp(scene, channels)) {
        b.lamp = {lamp->ofGradient, 1};
        b.lampOfWay = {lamp->ofWay, 0};
    }
    b.cells = {scene.cells->size(), 0};
    b.part = {part.at, raysAcross, 0};
    return b;
}

}  // namespace

class GlCellPlane final : public PlaneSum {
 public:
    GlCellPlane(GlCellSplatter& splatter, const Scene& scene, std::shared_ptr<GlPieces> pieces,
                const View& view, Channels channels, std::size_t plane, GlTargets& targets)
        : splatter_(splatter),
          scene_(scene),
          pieces_(std::move(pieces)),
          view_(view),
          channels_(channels),
          plane_(targets.planeFramebuffer(plane)),
          targets_(targets) {
        std::tie(first_, end_) = pieces_->placesOf(channels, plane);
        next_ = first_;
        if (first_ == end_) return;
        if (channels == Channels::Over)
            order_ = pieces_->farthestFirst(scene, view, splatter.order_);
        if (const int rays = raysAcross(scene, view); rays > 1)
            means_.emplace(coveredPixels(scene, view), formatOf(channels), rays,
                           splatter.rayBytes_);
        parts_ = means_ ? means_->parts() : std::vector{PixelBox{{}, view.size}};
    }
    // So many in each part.
    std::uint64_t add(std::uint64_t splats) override {
        const std::uint64_t count = std::min<std::uint64_t>(std::max(splats, kLeast), left());
        for (std::uint64_t todo = count * parts_.size(); todo > 0;) {
            const auto some =
                static_cast<std::uint32_t>(std::min<std::uint64_t>(todo, end_ - next_));
            draw(parts_[part_], some);
            todo -= some;
        }
        added_ += count;
        return count;
    }
    bool done() const override { return left() == 0; }

 private:
    static constexpr std::uint64_t kLeast = 1 << 10;
    static GLenum formatOf(Channels channels) {
        return floatsPerPixel(channels) == 1 ? GL_R32F : GL_RGBA32F;
    }
    std::uint64_t left() const { return parts_.empty() ? 0 : end_ - first_ - added_; }
    void draw(const PixelBox& part, std::uint32_t count) {
        GLuint framebuffer = plane_;
        if (means_) framebuffer = next_ == first_ ? means_->cleared(part) : means_->framebuffer();
        splatter_.draw({scene_, *pieces_, order_.get(), view_, channels_, next_, count, part,
                        means_ ? means_->raysAcross() : 1, framebuffer},
                       targets_);
        next_ += count;
        if (next_ < end_) return;
        if (means_) means_->putMeans(part, plane_, splatter_.mean(), splatter_.nothing_);
        next_ = first_;
        ++part_;
    }

    GlCellSplatter& splatter_;
    const Scene& scene_;
    std::shared_ptr<GlPieces> pieces_;
    std::shared_ptr<const gl::Buffer> order_;
    const View& view_;
    Channels channels_;
    GLuint plane_;
    GlTargets& targets_;
    std::optional<GlRayMeans> means_;
    std::vector<PixelBox> parts_;
    std::size_t part_ = 0;
    std::uint32_t first_ = 0, end_ = 0, next_ = 0;  // of the pieces
    std::uint64_t added_ = 0;
};

namespace {

class GlCellFrame final : public SplatFrame {
 public:
    GlCellFrame(GlCellSplatter& splatter, const Scene& scene, std::shared_ptr<GlPieces> pieces)
        : splatter_(splatter), scene_(scene), pieces_(std::move(pieces)) {}

    std::uint64_t splats(Channels channels, std::size_t layer) const override {
        const auto [first, end] = pieces_->placesOf(channels, layer);
        return end - first;
    }
    std::unique_ptr<PlaneSum> begin(const View& view, Channels channels, std::size_t layer,
                                    Targets& targets) override {
        GlTargets& onGl = targets.onGl();
        onGl.clearedPlane(layer, channels);
        glTextureBarrier();  // the opaque scene's depth, which shaders read
        return std::make_unique<GlCellPlane>(splatter_, scene_, pieces_, view, channels, layer,
                                             onGl);
    }

 private:
    GlCellSplatter& splatter_;
    const Scene& scene_;
    std::shared_ptr<GlPieces> pieces_;
};

}  // namespace

GlCellSplatter::GlCellSplatter(const GlSplatter& layers, std::uint64_t rayBytes)
    : layers_(layers), rayBytes_(rayBytes), view_(sizeof(CellViewBlock)) {}

std::uint64_t GlCellSplatter::mostBytes() {
    GLint blocks = 0;  // GL 4.5 promises none to vertices
    glGetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &blocks);
    if (blocks < 2) return 0;
    constexpr GLint64 kMost = 1 << 30;
    GLint64 bound = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bound);
    return static_cast<std::uint64_t>(std::min(bound, kMost));
}

const gl::Program& GlCellSplatter::program(const Variant& variant) {
    if (const auto found = programs_.find(variant); found != programs_.end()) return found->second;
    std::string defines = defineOf(variant.channels);
    if (variant.ordered) defines += "#define ORDERED\n";
    const std::string vertex = std::string(shaders::cell_view_glsl) + shaders::cell_vertex_glsl +
                               (variant.tets ? std::string(shaders::tet_vert)
                                             : std::string(shaders::grid_indices_glsl) +
                                                   shaders::cell_piece_glsl + shaders::cell_vert);
    const std::string fragment = std::string(shaders::cell_view_glsl) + shaders::cell_range_glsl +
                                 (variant.tets ? shaders::tet_frag : shaders::cell_frag);
    return programs_
        .emplace(variant, gl::Program(variant.tets ? "tet" : "cell", vertex.c_str(),
                                      fragment.c_str(), defines.c_str()))
        .first->second;
}

const gl::Program& GlCellSplatter::mean() {
    if (!mean_) mean_.emplace("mean", shaders::viewport_vert, shaders::mean_frag);
    return *mean_;
}

double GlCellSplatter::make(const Scene& scene, std::uint64_t cells) {
    if (holds(scene)) return 1;
    if (isWhole_ || !pieces_ || !pieces_->areOf(scene)) {
        isWhole_ = false;
        pieces_.reset();  // before there are others
        pieces_ = GlPieces::begin(scene, mostBytes(), lister_);
    }
    try {
        const double share = pieces_->goOn(scene, cells);
        isWhole_ = share == 1;
        return share;
    } catch (...) {
        pieces_.reset();
        throw;
    }
}

void GlCellSplatter::rest() {
    if (!isWhole_) pieces_.reset();
    lister_.rest();
}

std::unique_ptr<SplatFrame> GlCellSplatter::prepare(const Scene& scene, DrawList, const GlStep&) {
    while (make(scene, std::numeric_limits<std::uint32_t>::max()) < 1) {
    }
    return std::make_unique<GlCellFrame>(*this, scene, pieces_);
}

void GlCellSplatter::draw(const Draw& what, const GlTargets& targets) {
    if (what.count == 0) return;
    const CellViewBlock block =
        blockOf(what.scene, what.view, what.channels, what.part, what.raysAcross);
    view_.write(0, sizeof block, &block);
    const gl::BufferTexture* const sides = what.pieces.sides();
    const gl::Program& with = program({what.channels, what.order != nullptr, sides == nullptr});
    gl::begin(
        {.framebuffer = what.framebuffer,
         .size = what.raysAcross * what.part.size,
         .blend = what.channels == Channels::Over ? gl::Blend::Premultiplied : gl::Blend::Add});
    glUseProgram(with.id());
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, view_.id());
    glBindBufferBase(GL_UNIFORM_BUFFER, 1, layers_.layerBlock().id());
    what.pieces.pieces().bindStorage(0);
    if (what.order) what.order->bindStorage(1);
    if (const gl::Buffer* slopes = what.pieces.slopes()) slopes->bindStorage(2);
    if (sides) glBindTextureUnit(0, sides->id());
    glBindTextureUnit(1, layers_.colorMaps().id());
    // Read where it is also attached, which is defined after a barrier as long as nothing writes
    // it.
    glBindTextureUnit(2, targets.depth().id());
    glProgramUniform1ui(with.id(), 0, what.first);
    glBindVertexArray(nothing_.id());
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(6 * what.count));
}

}  // namespace render
