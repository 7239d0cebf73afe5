#include "render/splat/gl_depth_order.h"

#include <algorithm>
#include <bit>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "render/gl/compute.h"
#include "render/points/block_order.h"
#include "render/shader_sources.h"
#include "render/splat/depth_order.h"
#include "render/splat/gl_splat_view.h"

namespace render {
namespace {

// GLSL mirror: Keys in shaders/depth_keys.comp.
struct KeysBlock {
    glm::mat4 worldFromAxes;
    glm::vec4 eye, keys;
};

// GLSL mirror: Piece in shaders/depth_keys.comp.
struct OrderedPiece {
    std::uint32_t first, count, to, layer;
    std::uint32_t from, last, ranks, subset;
};
constexpr std::uint32_t kWhole = ~std::uint32_t{0};

// Where the subset of a prefix stride begins in the shader's table.
std::uint32_t subsetAt(std::uint32_t prefix) {
    if (prefix == 1) return kWhole;
    return static_cast<std::uint32_t>(kSubsetPeriod) *
           (static_cast<std::uint32_t>(std::countr_zero(prefix)) / 2 - 1);
}

std::vector<std::uint32_t> placesBefore() {
    std::vector<std::uint32_t> before;
    for (std::uint32_t prefix = 4; prefix <= prefixStride(kMaxStride); prefix *= 4) {
        std::uint32_t sum = 0;
        for (std::uint32_t place = 0; place < kSubsetPeriod; ++place) {
            before.push_back(sum);
            sum += inSubset(place, prefix) ? 1 : 0;
        }
    }
    return before;
}

// Below a key lie the three bits of its layer.
constexpr unsigned kLayerBits = 3;
static_assert(kMaxLayers <= 1u << kLayerBits);
constexpr unsigned kDigits = 3;
static_assert(DepthKeys::kBits <= 8 * kDigits);

std::uint64_t listed(std::span<const Piece> pieces) {
    std::uint64_t sum = 0;
    for (const Piece& piece : pieces) sum += piece.count;
    return sum;
}

KeysBlock keysBlock(const Scene& scene, const glm::dvec3& midEye) {
    const DepthKeys keys = depthKeysOf(scene, midEye);
    const double away = glm::length(midEye), s = std::max(away, keys.radius);
    KeysBlock b{glm::mat4(glm::dmat4(scene.placed.worldFromAxes())), glm::vec4(0), glm::vec4(0)};
    if (!(s > 0)) return b;
    b.eye = glm::vec4(glm::dvec4(midEye / s, away / s));
    b.keys = glm::vec4(glm::dvec4(1 / s, keys.radius, keys.perUnit, DepthKeys::kLast));
    return b;
}

}  // namespace

GlDepthOrder::GlDepthOrder(std::uint64_t most)
    : view_(sizeof(SplatViewBlock)), of_(sizeof(KeysBlock)), most_(most) {}

std::uint64_t GlDepthOrder::mostBytes() {
    GLint64 bound = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bound);
    return static_cast<std::uint64_t>(std::max<GLint64>(bound, 0));
}

bool GlDepthOrder::fits(const Scene& scene, const GlStep& step) const {
    return fits(listed(piecesOfRuns(scene)), scene, step);
}

bool GlDepthOrder::fits(std::uint64_t points, const Scene& scene, const GlStep& step) const {
    if (points == 0) return true;
    return points <= GlRadixSort::kMost &&
           std::max({points * GlRadixSort::kEntryBytes, splatCount(scene) * sizeof(SortedPoint),
                     step.gridIndex().bytes()}) <= most_;
}

const gl::Program& GlDepthOrder::keys(bool mesh) {
    const auto found = keys_.find(mesh);
    if (found != keys_.end()) return found->second;
    const std::string source = std::string(shaders::grid_indices_glsl) +
                               shaders::splat_points_glsl + shaders::depth_keys_comp;
    return keys_
        .emplace(mesh,
                 gl::Program::ofCompute("depth_keys", source.c_str(), mesh ? "#define MESH\n" : ""))
        .first->second;
}

void GlDepthOrder::findKeys(const Scene& scene, const glm::dvec3& midEye, const GlStep& step,
                            std::span<const Piece> pieces) {
    std::vector<OrderedPiece> sent;
    std::uint64_t sum = 0, to = 0;
    for (const Piece& piece : pieces) {
        if (piece.first % GlStep::kBlock == 0) to = sum;  // the first of a block
        sent.push_back({static_cast<std::uint32_t>(step.placeOf(piece.first)),
                        static_cast<std::uint32_t>(piece.count), static_cast<std::uint32_t>(to),
                        static_cast<std::uint32_t>(piece.layer), piece.from, piece.last,
                        static_cast<std::uint32_t>(kSubsetPeriod / piece.stride),
                        subsetAt(prefixStride(piece.stride))});
        sum += piece.count;
    }
    // Shaders tell by its length how many there are.
    pieces_.emplace(std::span<const OrderedPiece>(sent));
    const SplatViewBlock view = pointsBlock(scene);
    const KeysBlock of = keysBlock(scene, midEye);
    view_.write(0, sizeof view, &view);
    of_.write(0, sizeof of, &of);
    const bool mesh = scene.placed.isMesh();
    glUseProgram(keys(mesh).id());
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, view_.id());
    glBindBufferBase(GL_UNIFORM_BUFFER, 1, of_.id());
    glBindTextureUnit(0, step.axisPoints().id());
    if (mesh) glBindTextureUnit(2, step.mesh()->points().id());
    pieces_->bindStorage(0);
    step.gridIndex().bindStorage(1);
    step.placeInBlock().bindStorage(2);
    sort_.entries().bindStorage(3);
    if (!before_) {
        const std::vector<std::uint32_t> before = placesBefore();
        before_.emplace(std::span<const std::uint32_t>(before));
    }
    before_->bindStorage(4);
    gl::startGroups(sent.size());
}

void GlDepthOrder::sort(std::uint64_t drawn, const GlStep& step) {
    const bool values = step.values() != nullptr;
    if (!last_.contains(values))
        last_.emplace(values, GlRadixSort::scatter(values ? "#define POINTS\n#define VALUES\n"
                                                          : "#define POINTS\n"));
    const gl::Program& last = last_.at(values);
    sort_.sort(kLayerBits, kDigits - 1);
    glProgramUniform1ui(last.id(), 2, static_cast<GLuint>(drawn));
    step.gridIndex().bindStorage(2);
    if (values) step.values()->bindStorage(3);
    list_->bindStorage(4);
    sort_.last(kLayerBits + 8 * (kDigits - 1), last);
    sort_.shrink();
    glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
}

GlDepthOrder::List GlDepthOrder::ordered(const Scene& scene, const glm::dvec3& midEye,
                                         const GlStep& step) {
    const std::vector<Piece> pieces = piecesOfRuns(scene);
    const std::uint64_t count = listed(pieces), drawn = splatCount(scene);
    if (!fits(count, scene, step)) throw std::runtime_error("more points than shaders bind here");
    const std::uint64_t bytes = drawn * sizeof(SortedPoint);
    if (!list_ || list_.use_count() > 1 || list_->bytes() < bytes) {
        list_.reset();
        list_ = std::make_shared<gl::Buffer>(bytes);
    }
    if (count > 0) {
        sort_.begin(count);
        findKeys(scene, midEye, step, pieces);
        sort(drawn, step);
    }
    if (drawn > GlRadixSort::kKept) return {std::exchange(list_, nullptr), drawn};
    return {list_, drawn};
}

GlDepthOrder::List GlDepthOrder::operator()(const Scene& scene, const glm::dvec3& midEye,
                                            const GlStep& step) {
    try {
        return ordered(scene, midEye, step);
    } catch (const std::runtime_error&) {
        sort_.release();
        list_.reset();
        throw;
    }
}

}  // namespace render
