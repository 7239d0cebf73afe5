#include "render/annotate/placard.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "render/gl/pass.h"
#include "render/image/color.h"
#include "render/shader_sources.h"

namespace render {
namespace {

int levelsOf(glm::ivec2 size) {
    return 1 + static_cast<int>(std::log2(static_cast<double>(std::max(size.x, size.y))));
}

}  // namespace

Board::Board(glm::ivec2 size)
    : texture_(GL_SRGB8_ALPHA8, size, levelsOf(size)), framebuffer_(std::array{texture_.id()}) {}

void Board::beginDrawing() const {
    gl::begin({.framebuffer = framebuffer_.id(), .size = size(), .clearColor = glm::vec4(0)});
}

void Board::drawn() const { glGenerateTextureMipmap(texture_.id()); }

void Board::write(const Image& image) const {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(image.pixels.size() * 4);
    for (int y = image.size.y - 1; y >= 0; --y)
        for (int x = 0; x < image.size.x; ++x) {
            const glm::vec4& pixel = image.at(x, y);
            for (const float light : {pixel.r, pixel.g, pixel.b})
                bytes.push_back(srgb8FromLinear(static_cast<double>(light)));
            bytes.push_back(255);
        }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(texture_.id(), 0, 0, 0, size().x, size().y, GL_RGBA, GL_UNSIGNED_BYTE,
                        bytes.data());
    drawn();
}

PlacardPass::PlacardPass()
    : board_("placard", shaders::placard_vert, shaders::placard_frag, "#define BOARD\n"),
      plain_("placard", shaders::placard_vert, shaders::placard_frag) {}

void PlacardPass::draw(const Placard& placard, const View& view, GLuint framebuffer) const {
    gl::begin(
        {.framebuffer = framebuffer, .size = view.size, .depth = gl::DepthTest::TestAndWrite});
    drawSquare(placard, view);
}

void PlacardPass::drawDepth(const Placard& placard, const View& view, GLuint framebuffer) const {
    gl::begin({.framebuffer = framebuffer,
               .size = view.size,
               .depth = gl::DepthTest::TestAndWrite,
               .colorWrite = false});
    drawSquare(placard, view);
}

void PlacardPass::drawSquare(const Placard& placard, const View& view) const {
    const glm::mat4 clipFromPlacard(view.clipFromView * view.viewFromWorld *
                                    placard.worldFromPlacard);
    if (const auto* board = std::get_if<const Board*>(&placard.face)) {
        glUseProgram(board_.id());
        glBindTextureUnit(0, (*board)->texture());
    } else {
        glUseProgram(plain_.id());
        glUniform3fv(1, 1, glm::value_ptr(std::get<glm::vec3>(placard.face)));
    }
    glUniformMatrix4fv(0, 1, GL_FALSE, glm::value_ptr(clipFromPlacard));
    glBindVertexArray(noVertices_.id());
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

}  // namespace render
