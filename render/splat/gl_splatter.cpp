#include "render/splat/gl_splatter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <stdexcept>
#include <string>

#include "render/gl/debug_output.h"
#include "render/gl/pass.h"
#include "render/model/covered.h"
#include "render/model/footprint.h"
#include "render/shader_sources.h"
#include "render/splat/gl_list.h"
#include "render/splat/gl_splat_view.h"
#include "render/splat/gl_targets.h"

namespace render {
namespace {

// GLSL mirror: Layers in shaders/splat.vert and shaders/resolve.frag.
struct LayerBlock {
    std::array<glm::vec4, kMaxLayers> style, map;
};

// Position in the map = x s + y of a value s on the scale: affine, in double.
glm::dvec2 positionOnScale(const ByValue& map, const ValueScale& scale) {
    const double halfWidth = map.halfWidth();
    if (!(halfWidth > 0)) return {0, 0.5};
    constexpr double kMost = std::numeric_limits<float>::max();
    return {scale.halfWidth / halfWidth,
            std::clamp(placeOnScale(scale.lo, map.lo, halfWidth), -kMost, kMost)};
}

constexpr int kMapEntries = 257;  // the most that a ColorMap has

// Of kPiecePoints quads, two triangles each.
gl::Buffer cornersOfQuads() {
    static_assert(4 * kPiecePoints <= 1 << 16);
    std::vector<std::uint16_t> corners;
    for (std::uint64_t quad = 0; quad < kPiecePoints; ++quad)
        for (const unsigned corner : {0u, 1u, 2u, 1u, 2u, 3u})
            corners.push_back(static_cast<std::uint16_t>(4 * quad + corner));
    return gl::Buffer(std::span<const std::uint16_t>(corners));
}

GlDepthOrder::List sent(const Scene& scene, const Sorted& list, const ValueScale& scale) {
    std::vector<SortedPoint> points;
    points.reserve(list.point.size());
    const timeseries::Columns columns = columnsOf(scene);
    for (std::size_t i = 0; i < list.point.size(); ++i) {
        const std::uint32_t p = list.point[i];
        points.push_back({columns.gridIndex[p], scale(valueOf(columns, p)), list.layer[i]});
    }
    return {std::make_shared<const gl::Buffer>(std::span<const SortedPoint>(points)),
            points.size()};
}

class GlPlane final : public PlaneSum {
 public:
    GlPlane(GlSplatter& splatter, const GlList& list, const View& view, Channels channels,
            std::size_t layer, GLuint framebuffer)
        : splatter_(splatter),
          list_(list),
          view_(view),
          channels_(channels),
          framebuffer_(framebuffer),
          left_(list.pieces(channels, layer)) {}

    std::uint64_t add(std::uint64_t splats) override {
        std::size_t pieces = 0;
        std::uint64_t added = 0;
        while (pieces < left_.size() && added < std::max(splats, std::uint64_t{1}))
            added += left_[pieces++].cost;
        splatter_.draw(list_, view_, channels_, left_.first(pieces), framebuffer_);
        left_ = left_.subspan(pieces);
        return added;
    }
    bool done() const override { return left_.empty(); }

 private:
    GlSplatter& splatter_;
    const GlList& list_;
    const View& view_;
    Channels channels_;
    GLuint framebuffer_;
    std::span<const Piece> left_;
};

class GlFrame final : public SplatFrame {
 public:
    GlFrame(GlSplatter& splatter, std::unique_ptr<GlList> list)
        : splatter_(splatter), list_(std::move(list)) {}

    std::uint64_t splats(Channels channels, std::size_t layer) const override {
        std::uint64_t sum = 0;
        for (const Piece& piece : list_->pieces(channels, layer)) sum += piece.cost;
        return sum;
    }
    std::unique_ptr<PlaneSum> begin(const View& view, Channels channels, std::size_t layer,
                                    Targets& targets) override {
        return std::make_unique<GlPlane>(splatter_, *list_, view, channels, layer,
                                         targets.onGl().clearedPlane(layer, channels));
    }

 private:
    GlSplatter& splatter_;
    std::unique_ptr<GlList> list_;
};

}  // namespace

const char* defineOf(Channels channels) {
    switch (channels) {
        case Channels::Weight:
            return "#define WEIGHT\n";
        case Channels::WeightedColor:
            return "#define WEIGHTED_COLOR\n";
        case Channels::Over:
            return "#define OVER\n";
        case Channels::Count:
            return "#define COUNT\n";
    }
    return "";
}

GlSplatter::GlSplatter(std::uint64_t mostSorted)
    : view_(sizeof(SplatViewBlock)),
      layers_(sizeof(LayerBlock)),
      colorMaps_(GL_RGBA32F, {kMapEntries, 2 * static_cast<int>(kMaxLayers)}),
      elements_(cornersOfQuads()),
      orderOnGpu_(mostSorted) {
    std::array<GLfloat, 2> range{};
    glGetFloatv(GL_POINT_SIZE_RANGE, range.data());
    largestPoint_ = range[1];
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, &largestViewport_.x);
    corners_.setElements(elements_);
}

GlSplatter::~GlSplatter() = default;

bool GlSplatter::canDraw() {
    GLint blocks = 0;
    glGetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &blocks);
    return blocks >= 3;
}

const gl::Program& GlSplatter::program(const Variant& variant) {
    if (const auto found = programs_.find(variant); found != programs_.end()) return found->second;
    std::string defines = defineOf(variant.channels);
    if (variant.quads) defines += "#define QUADS\n";
    if (variant.quads && variant.sorted) defines += "#define SORTED\n";
    if (variant.cut) defines += "#define CUT\n";
    if (variant.mesh) defines += "#define MESH\n";
    if (variant.cubes) defines += "#define CUBES\n";
    if (variant.kernel == Kernel::Point) defines += "#define KERNEL_POINT\n";
    const std::string vertex =
        std::string(shaders::grid_indices_glsl) + shaders::splat_points_glsl + shaders::splat_vert;
    return programs_
        .emplace(variant,
                 gl::Program("splat", vertex.c_str(), shaders::splat_frag, defines.c_str()))
        .first->second;
}

void GlSplatter::setLayers(const Scene& scene, const ValueScale& scale) {
    LayerBlock block{};
    for (std::size_t k = 0; k < scene.layers.size(); ++k) {
        const RangeStyle& style = scene.layers[k].style;
        const double tau = opticalDepthPerWeight(style.opacity);
        if (const auto* constant = std::get_if<Constant>(&style.color)) {
            block.style[k] = glm::vec4(glm::dvec4(constant->linearRgb, tau));
            block.map[k].w = static_cast<float>(pointsPerSplat(scene.layers[k], scene.stride));
            continue;
        }
        const auto& map = std::get<ByValue>(style.color);
        const auto entries = map.map.entries();
        block.style[k] = glm::vec4(0, 0, 0, tau);
        block.map[k] = glm::vec4(positionOnScale(map, scale), entries.size(),
                                 pointsPerSplat(scene.layers[k], scene.stride));
        const auto write = [&](std::size_t row, std::span<const glm::vec3> colors) {
            std::vector<glm::vec4> texels;
            for (const glm::vec3& color : colors) texels.emplace_back(color, 1.0f);
            glTextureSubImage2D(colorMaps_.id(), 0, 0, static_cast<GLint>(row),
                                static_cast<GLsizei>(texels.size()), 1, GL_RGBA, GL_FLOAT,
                                texels.data());
        };
        write(k, entries);
        write(kMaxLayers + k, sumsOf(entries));
    }
    layers_.write(0, sizeof block, &block);
}

DrawList GlSplatter::order(const Scene& scene, const glm::dvec3& midEye) {
    if (scene.order == Order::None) return Runs{};
    return SortWhenDrawn{midEye};
}

// With values of its own.
std::unique_ptr<GlList> GlSplatter::send(const Scene& scene, const Sorted& list,
                                         const GlStep& step) {
    const ValueScale scale = ValueScale::of(scene.layers);
    setLayers(scene, scale);
    return std::make_unique<GlList>(scene, step, sent(scene, list, scale));
}

// Null where it is too large, or there is no room for it.
std::unique_ptr<GlList> GlSplatter::listOnGpu(const Scene& scene, const glm::dvec3& midEye,
                                              const GlStep& step) {
    try {
        return std::make_unique<GlList>(scene, step, orderOnGpu_(scene, midEye, step));
    } catch (const std::runtime_error&) {
        gl::forgetErrors();
        return nullptr;
    }
}

std::unique_ptr<GlList> GlSplatter::upload(const Scene& scene, const DrawList& list,
                                           const GlStep& step) {
    ++counts_.uploads;
    if (const auto* const sorted = std::get_if<Sorted>(&list)) return send(scene, *sorted, step);
    setLayers(scene, step.values() == nullptr ? ValueScale::of(scene.layers) : step.valueScale());
    const auto* const asked = std::get_if<SortWhenDrawn>(&list);
    if (asked == nullptr) return std::make_unique<GlList>(scene, step);
    if (auto made = listOnGpu(scene, asked->midEye, step)) return made;
    return send(scene, std::get<Sorted>(order_(scene, asked->midEye)), step);
}

std::unique_ptr<SplatFrame> GlSplatter::prepare(const Scene& scene, DrawList list,
                                                const GlStep& step) {
    return std::make_unique<GlFrame>(*this, upload(scene, list, step));
}

void GlSplatter::draw(const GlList& list, const View& view, Channels channels, std::size_t layer,
                      GLuint framebuffer) {
    draw(list, view, channels, list.pieces(channels, layer), framebuffer);
}

void GlSplatter::draw(const GlList& list, const View& view, Channels channels,
                      std::span<const Piece> pieces, GLuint framebuffer) {
    ++counts_.draws;
    const PointsView seen(list.scene().placed, view);
    const double reach = farthestReach(list.scene(), seen);
    // A point sprite whose centre leaves the clip volume vanishes whole, so the viewport is wider
    // than the picture by the farthest reach; sprites also have a largest size, as has a viewport.
    const double sides = 2 * (reach + 2);
    const PlacedPoints& placed = list.scene().placed;
    const bool square = list.scene().footprint.kernel == Kernel::Point, mesh = placed.isMesh();
    const bool cut = placed.longCells() && !square;
    // Slim footprints fill little of a sprite.
    const bool slim = cut || (mesh && !square);
    const bool quads = slim || !(sides <= static_cast<double>(largestPoint_) &&
                                 view.size.x + sides <= largestViewport_.x &&
                                 view.size.y + sides <= largestViewport_.y);
    const int guard = quads ? 0 : static_cast<int>(std::ceil(reach)) + 1;
    const SplatViewBlock block = viewBlock(list.scene(), view, seen, guard);
    view_.write(0, sizeof block, &block);
    const gl::Program& with = program({channels, list.scene().footprint.kernel, quads,
                                       quads && list.isSorted(), list.cubes(), cut, mesh});
    gl::begin({.framebuffer = framebuffer,
               .size = view.size,
               .guard = guard,
               .blend = channels == Channels::Over ? gl::Blend::Premultiplied : gl::Blend::Add,
               .depth = gl::DepthTest::Test});
    glUseProgram(with.id());
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, view_.id());
    glBindBufferBase(GL_UNIFORM_BUFFER, 1, layers_.id());
    glBindTextureUnit(0, list.step().axisPoints().id());
    glBindTextureUnit(1, colorMaps_.id());
    if (mesh) glBindTextureUnit(2, list.step().mesh()->points().id());
    if (quads)
        list.drawQuads(pieces, corners_);
    else
        list.drawSprites(pieces);
}

}  // namespace render
