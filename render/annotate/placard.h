// Flat opaque things that stand in the scene beside the volume: a panel, a line of text near a
// hand. They hide what is behind them and are hidden by it.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <variant>

#include "render/gl/object.h"
#include "render/image/image.h"
#include "render/points/view.h"

namespace render {

// A picture on the GPU that is looked at from any distance, with all its smaller levels. Needs a
// current GL context, from construction to destruction.
class Board {
 public:
    explicit Board(glm::ivec2 size);
    glm::ivec2 size() const { return texture_.size(); }

    // To be drawn into, in sRGB bytes, row 0 at the bottom: cleared, bound, and nothing encoded on
    // the way. drawn() makes the smaller levels.
    void beginDrawing() const;
    void drawn() const;
    // REQUIRES: an image of the board's size.
    void write(const Image& image) const;

    GLuint texture() const { return texture_.id(); }

 private:
    gl::Texture texture_;
    gl::Framebuffer framebuffer_;
};

struct Placard {
    // The placard is the square from -1 to 1 in x and y, at z = 0.
    glm::dmat4 worldFromPlacard;
    std::variant<const Board*, glm::vec3> face;  // or one linear colour
};

class PlacardPass {
 public:
    PlacardPass();
    // Over what nearer things leave free; writes depth.
    void draw(const Placard& placard, const View& view, GLuint framebuffer) const;
    // Its depth alone; draw() then finds itself there.
    void drawDepth(const Placard& placard, const View& view, GLuint framebuffer) const;

 private:
    void drawSquare(const Placard& placard, const View& view) const;

    gl::Program board_, plain_;
    gl::VertexArray noVertices_;
};

}  // namespace render
