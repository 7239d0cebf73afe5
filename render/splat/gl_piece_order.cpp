#include "render/splat/gl_piece_order.h"

#include <algorithm>
#include <bit>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <string>

#include "render/gl/compute.h"
#include "render/shader_sources.h"

namespace render {
namespace {

constexpr unsigned kBitsOfADigit = 8, kDigitsOfAKey = 4;

// GLSL mirror: shaders/cell_keys.comp.
struct BrickKeys {
    std::uint32_t side, most;
    glm::uvec3 along{0};  // bricks along the axes

    // Bricks grow until their keys are numbers of 32 bits. Where no bricks have such, as of a line
    // of very many cells, all of one distance are alike.
    BrickKeys(const glm::uvec3& size, const glm::uvec3& eye) {
        constexpr std::uint32_t kMostSide = 1 << 10;
        for (side = 16; side <= kMostSide; side *= 2) {
            double away = 1;
            for (int a = 0; a < 3; ++a) {
                const std::uint32_t above = bricksOf(size[a] - eye[a] - 1),
                                    below = bricksOf(eye[a]);
                along[a] = 1 + above + below;
                away += std::max(above, below);
            }
            const double all = away * along.x * along.y * along.z * (3 * side - 2);
            if (all > std::numeric_limits<std::uint32_t>::max()) continue;
            most = static_cast<std::uint32_t>(all);
            return;
        }
        side = 1;
        along = glm::uvec3(0);
        most = size.x + size.y + size.z;
    }

 private:
    std::uint32_t bricksOf(std::uint32_t cells) const { return (cells + side - 1) / side; }
};

}  // namespace

std::shared_ptr<const gl::Buffer> GlPieceOrder::sorted(std::uint32_t count, unsigned digits) {
    if (!places_) places_ = GlRadixSort::scatter("#define PLACES\n");
    auto places = std::make_shared<const gl::Buffer>(count * sizeof(std::uint32_t));
    sort_.sort(0, digits - 1);
    places->bindStorage(2);
    sort_.last(kBitsOfADigit * (digits - 1), *places_);
    sort_.shrink();
    return places;
}

std::shared_ptr<const gl::Buffer> GlPieceOrder::operator()(const CellsToOrder& cells,
                                                           const glm::uvec3& eye) {
    if (cells.count == 0) return std::make_shared<const gl::Buffer>(0);
    if (!cellKeys_) {
        const std::string source = std::string(shaders::grid_indices_glsl) +
                                   shaders::cell_piece_glsl + shaders::cell_keys_comp;
        cellKeys_ = gl::Program::ofCompute("cell_keys", source.c_str());
    }
    const BrickKeys keys(cells.size, eye);
    sort_.begin(cells.count);
    glUseProgram(cellKeys_->id());
    glUniform1ui(0, cells.count);
    glUniform3uiv(1, 1, &cells.size.x);
    glUniform3uiv(2, 1, &eye.x);
    glUniform3uiv(3, 1, &keys.along.x);
    glUniform1ui(4, keys.side);
    glUniform1ui(5, keys.most);
    cells.pieces.bindStorage(0);
    sort_.entries().bindStorage(1);
    gl::startFor(cells.count);
    const auto bits = static_cast<unsigned>(std::bit_width(keys.most));
    return sorted(cells.count, std::max((bits + kBitsOfADigit - 1) / kBitsOfADigit, 1u));
}

void GlPieceOrder::findKeys(const TetsToOrder& tets, const glm::dvec3& eye, Keys keys) {
    if (!tetKeys_) tetKeys_ = gl::Program::ofCompute("tet_keys", shaders::tet_keys_comp);
    const double away = glm::length(eye), s = std::max(away, tets.radius);
    const glm::vec4 overS = s > 0 ? glm::vec4(glm::dvec4(eye / s, away / s)) : glm::vec4(0);
    glUseProgram(tetKeys_->id());
    glUniform1ui(0, tets.count);
    glUniform1i(1, static_cast<int>(keys));
    glUniform4fv(2, 1, &overS.x);
    glUniform1f(3, s > 0 ? static_cast<float>(1 / s) : 0);
    tets.pieces.bindStorage(0);
    tets.cells.bindStorage(1);
    tets.middles.bindStorage(2);
    sort_.entries().bindStorage(3);
    if (keys == Keys::CellsPlaces) tets.places->bindStorage(4);
    gl::startFor(tets.count);
}

std::shared_ptr<const gl::Buffer> GlPieceOrder::operator()(const TetsToOrder& tets,
                                                           const glm::dvec3& eye) {
    if (tets.count == 0) return std::make_shared<const gl::Buffer>(0);
    sort_.begin(tets.count);
    findKeys(tets, eye, Keys::OwnMiddles);
    sort_.sort(0, kDigitsOfAKey);
    findKeys(tets, eye, tets.places ? Keys::CellsPlaces : Keys::CellsMiddles);
    return sorted(tets.count, kDigitsOfAKey);
}

}  // namespace render
