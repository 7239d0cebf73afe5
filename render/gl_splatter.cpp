#include "render/gl_splatter.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <stdexcept>
#include <string>

#include "render/footprint.h"
#include "render/gl/pass.h"
#include "render/gl_list.h"
#include "render/shader_sources.h"

namespace render {
namespace {

// GLSL mirror: SplatView in shaders/splat.vert.
struct SplatViewBlock {
    glm::mat4 viewFromWorld;
    glm::vec4 rayAxis, perPixelX, perPixelY, window, depths, kernel, slope;
    glm::uvec4 lattice, clipLo, clipHi;
};

// GLSL mirror: Layers in shaders/splat.vert and shaders/resolve.frag.
struct LayerBlock {
    std::array<glm::vec4, kMaxLayers> style, map;
};

// How far, in pixels from its centre, any footprint of the scene reaches in this view; infinite
// when the eye is among the points.
double farthestReach(const Scene& scene, const View& view, const PixelRays& rays) {
    if (scene.footprint.kernel == Kernel::Point) return pointSide(scene.footprint) / 2.0;
    glm::dvec3 widest(0);
    for (int a = 0; a < 3; ++a)
        for (const double w : scene.lattice.widths()[a]) widest[a] = std::max(widest[a], w);
    const double inView = 1 / glm::length(rays.axis);
    double nearest = std::numeric_limits<double>::infinity(), steepest = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const glm::dvec4 p = view.viewFromWorld * glm::dvec4(sign * scene.lattice.boxHalf(), 1.0);
        nearest = std::min(nearest, -p.z);
        if (-p.z > 0) steepest = std::max(steepest, glm::length(glm::dvec2(p)) / -p.z);
    }
    if (!(nearest > rays.near)) return std::numeric_limits<double>::infinity();
    const double focal = std::max(rays.focal.x, rays.focal.y);
    const double cells =
        scene.footprint.size * kQuarticRadius * std::max({widest.x, widest.y, widest.z}) * inView;
    const double pixels = kSmallestRadiusPixels * nearest / std::min(rays.focal.x, rays.focal.y);
    const double reach = sphereExtent(nearest, std::max(cells, pixels), steepest);
    return reach < 0 ? std::numeric_limits<double>::infinity() : reach * focal;
}

SplatViewBlock viewBlock(const Scene& scene, const View& view, const PixelRays& rays, int guard) {
    SplatViewBlock b{};
    const glm::dmat4& clip = view.clipFromView;
    b.viewFromWorld = glm::mat4(view.viewFromWorld);
    b.rayAxis = glm::vec4(glm::dvec4(rays.axis, glm::length(rays.axis)));
    b.perPixelX = glm::vec4(glm::dvec4(rays.perPixelX, rays.focal.x));
    b.perPixelY = glm::vec4(glm::dvec4(rays.perPixelY, rays.focal.y));
    b.window = {glm::vec2(rays.centre), glm::vec2(view.size)};
    b.depths = {rays.near, -clip[2][2], clip[3][2], guard};
    b.kernel = {scene.footprint.size * kQuarticRadius, kSmallestRadiusPixels,
                1 / scene.lattice.unitLength(), static_cast<float>(pointSide(scene.footprint))};
    b.slope = glm::vec4(glm::dvec4(1.0 / (rays.focal * rays.focal), 0, 0));
    b.lattice = {scene.lattice.size(), 0};
    b.clipLo = {scene.clip.lo, 0};
    b.clipHi = {scene.clip.hi, 0};
    return b;
}

const char* define(Channels channels) {
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

// Position in the map = x s + y of a value s on the scale: affine, in double. REQUIRES: no map is
// narrower than the scale.
glm::dvec2 positionOnScale(const ByValue& map, const ValueScale& scale) {
    const double halfWidth = map.halfWidth();
    if (!(halfWidth > 0)) return {0, 0.5};
    constexpr double kMost = std::numeric_limits<float>::max();
    return {scale.halfWidth / halfWidth,
            std::clamp((0.5 * scale.lo - 0.5 * map.lo) / halfWidth, -kMost, kMost)};
}

constexpr int kMapEntries = 257;  // the most that a ColorMap has

}  // namespace

GlSplatter::GlSplatter()
    : view_(sizeof(SplatViewBlock)),
      layers_(sizeof(LayerBlock)),
      colorMaps_(GL_RGBA32F, {kMapEntries, static_cast<int>(kMaxLayers)}) {
    std::array<GLfloat, 2> range{};
    glGetFloatv(GL_POINT_SIZE_RANGE, range.data());
    largestPoint_ = range[1];
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, &largestViewport_.x);
}

GlSplatter::~GlSplatter() = default;

const gl::Program& GlSplatter::program(const Variant& variant) {
    if (const auto found = programs_.find(variant); found != programs_.end()) return found->second;
    std::string defines = define(variant.channels);
    if (variant.quads) defines += "#define QUADS\n";
    if (variant.cubes) defines += "#define CUBES\n";
    if (variant.kernel == Kernel::Point) defines += "#define KERNEL_POINT\n";
    return programs_
        .emplace(variant,
                 gl::Program("splat", shaders::splat_vert, shaders::splat_frag, defines.c_str()))
        .first->second;
}

std::unique_ptr<GpuList> GlSplatter::upload(const Scene& scene, const DrawList& list,
                                            GpuStep& step) {
    ++counts_.uploads;
    LayerBlock block{};
    const ValueScale scale = ValueScale::of(scene.layers);
    bool byValue = false;
    for (std::size_t k = 0; k < scene.layers.size(); ++k) {
        const RangeStyle& style = scene.layers[k].style;
        const double tau = opticalDepthPerWeight(style.opacity);
        if (const auto* constant = std::get_if<Constant>(&style.color)) {
            block.style[k] = glm::vec4(glm::dvec4(constant->linearRgb, tau));
            continue;
        }
        byValue = true;
        const auto& map = std::get<ByValue>(style.color);
        const auto entries = map.map.entries();
        block.style[k] = glm::vec4(0, 0, 0, tau);
        block.map[k] = glm::vec4(positionOnScale(map, scale), entries.size(), 0);
        std::vector<glm::vec4> row;
        for (const glm::vec3& color : entries) row.emplace_back(color, 1.0f);
        glTextureSubImage2D(colorMaps_.id(), 0, 0, static_cast<GLint>(k),
                            static_cast<GLsizei>(row.size()), 1, GL_RGBA, GL_FLOAT, row.data());
    }
    layers_.write(0, sizeof block, &block);
    // A sorted list brings its own points.
    if (std::holds_alternative<Runs>(list))
        step.need(scene, byValue ? std::optional(scale) : std::nullopt);
    return std::make_unique<GpuList>(scene, list, step, scale);
}

void GlSplatter::draw(const GpuList& list, const View& view, Channels channels, std::size_t layer,
                      GLuint framebuffer) {
    ++counts_.draws;
    const PixelRays rays = pixelRays(view);
    const double reach = farthestReach(list.scene(), view, rays);
    // A point sprite whose centre leaves the clip volume vanishes whole, so the viewport is wider
    // than the picture by the farthest reach; sprites also have a largest size, as has a viewport.
    const double sides = 2 * (reach + 2);
    const bool quads =
        !(sides <= static_cast<double>(largestPoint_) &&
          view.size.x + sides <= largestViewport_.x && view.size.y + sides <= largestViewport_.y);
    const int guard = quads ? 0 : static_cast<int>(std::ceil(reach)) + 1;
    const SplatViewBlock block = viewBlock(list.scene(), view, rays, guard);
    view_.write(0, sizeof block, &block);
    const gl::Program& with =
        program({channels, list.scene().footprint.kernel, quads, list.cubes()});
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
    const bool alone = channels == Channels::Over || channels == Channels::Count;
    list.draw(quads, alone ? std::nullopt : std::optional(layer));
}

}  // namespace render
