// Keeps what nobody sees of a picture from being drawn.
#pragma once

#include <memory>
#include <vector>

#include "render/annotate/hidden_area.h"
#include "render/gl/object.h"

namespace render {

class HiddenAreaPass {
 public:
    HiddenAreaPass();
    // Gives the view's hidden pixels a depth of 0, the nearest: nothing that tests it is drawn
    // there from then on. Nothing where the view has none.
    void drawDepth(const View& view, GLuint framebuffer);

 private:
    // An area's pixels on the GPU, for as long as the eye and its size stay as they are.
    struct Pixels {
        std::shared_ptr<const HiddenArea> area;
        glm::dmat4 clipFromView;
        glm::ivec2 size;
        GLsizei corners;
        gl::Buffer triangles;
    };
    const Pixels& pixelsOf(const View& view);

    gl::Program program_;
    std::vector<Pixels> kept_;  // of the views drawn last
};

}  // namespace render
