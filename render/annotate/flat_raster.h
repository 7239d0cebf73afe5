// FlatMeshes drawn on the processor, as FlatPass draws them with GL: the formulas are those of
// shaders/flat.frag. Pure.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "render/annotate/flat_mesh.h"
#include "render/annotate/touched_pixels.h"

namespace render {

// Some whole rows of a picture, the first being row `first` of it; row 0 is at the bottom.
template <typename T>
struct PixelRows {
    glm::ivec2 picture;  // size of all of it, in pixels
    int first, count;
    T* pixels;  // [count][picture.x], four floats each where it is light
};

// A mesh made ready to be drawn into any rows. Refers to the font, not to the mesh.
class FlatRaster {
 public:
    FlatRaster(const FlatMesh& mesh, const Font& font, glm::ivec2 picture);

    // Blends it over light: linear, premultiplied RGBA. Tells which of these rows' pixels it may
    // have changed, where somebody asks.
    void draw(const PixelRows<float>& light, TouchedPixels* touched = nullptr) const;
    // Makes the depth that of the nearest, where it covers more than half of a pixel.
    void drawDepth(const PixelRows<float>& depth) const;
    bool empty() const { return triangles_.empty(); }

 private:
    // A value that is linear in the picture: at a pixel's middle (x, y).
    struct Plane {
        double at0 = 0, perX = 0, perY = 0;
        float at(double x, double y) const { return static_cast<float>(at0 + perX * x + perY * y); }
    };
    using Coverage = std::array<float, 256>;  // of each byte of the atlas
    struct Triangle {
        std::array<glm::dvec2, 3> corner;  // y up
        int first, last;                   // rows
        Plane depth, distance, half;       // of a line: see FlatVertex::edge
        std::array<Plane, 4> color;
        std::array<Plane, 2> texel;
        const Coverage* glyph;  // none where there is no glyph
    };
    void take(const FlatVertex* corners, glm::ivec2 picture);
    const Coverage& coverageOf(const glm::vec4& color);
    float coverage(const Triangle& of, double x, double y) const;
    template <typename Visit>
    void forEachPixel(glm::ivec2 picture, int first, int count, TouchedPixels* touched,
                      const Visit& visit) const;

    const Font& font_;
    std::vector<Triangle> triangles_;
    std::vector<std::pair<float, std::unique_ptr<Coverage>>> coverages_;  // by luminance
};

}  // namespace render
