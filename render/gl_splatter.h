// The splatter on GL 4.5: a step is uploaded once, a draw list once a frame, and drawn once an eye.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>

#include "render/gl/object.h"
#include "render/scene.h"
#include "render/view.h"

namespace render {

// How a value becomes what a shader sees: a float that is 0 and 1 at the ends of the narrowest
// colour map, beyond which it may lie. A field's own extent may be so much wider than a map (a fill
// value that the file does not tell) that no float over it would tell the map's values apart.
struct ValueScale {
    double lo = 0, halfWidth = 0;  // halves: the difference of two huge values stays finite
    // Of layers that are coloured by value; halfWidth is 0 when no map has a width.
    static ValueScale of(const std::vector<Layer>& layers);
    float operator()(double value) const;
    friend bool operator==(const ValueScale&, const ValueScale&) = default;
};

// A step's points on the GPU: 4 bytes a point, 4 more once a layer is coloured by value.
class GpuStep {
 public:
    // Throws std::length_error for 2^31 points or more, the most that one draw call can count.
    GpuStep(const timeseries::SortedStep& step, const Lattice& lattice);
    // Uploads the values on this scale, unless they are there.
    void needValues(const timeseries::SortedStep& step, const ValueScale& scale);

    const gl::Buffer& gridIndex() const { return gridIndex_; }
    const gl::Buffer* values() const { return values_ ? &*values_ : nullptr; }
    const gl::BufferTexture& axisPoints() const { return axisTexture_; }
    std::size_t bytes() const;

 private:
    gl::Buffer gridIndex_, axisPoints_;
    gl::BufferTexture axisTexture_;
    std::optional<gl::Buffer> values_;
    ValueScale scale_;  // of values_
};

// One frame's list, ready to draw for any number of eyes.
class GpuList;

class GlSplatter {
 public:
    GlSplatter();
    ~GlSplatter();

    // Once a frame. `step` holds the scene's step. The list refers to the scene and the step.
    std::unique_ptr<GpuList> upload(const Scene& scene, const DrawList& list, GpuStep& step);

    // Once an eye: adds one plane into a framebuffer whose one colour attachment is of that kind
    // (R32F or RGBA32F) and whose depth attachment is the opaque scene's, tested, not written.
    // `layer` is the plane's layer for Weight and WeightedColor. Clears nothing.
    void draw(const GpuList& list, const View& view, Channels channels, std::size_t layer,
              GLuint framebuffer);

    // How often each was called: two eyes are one list drawn twice.
    struct Counts {
        std::uint64_t uploads = 0, draws = 0;
    };
    const Counts& counts() const { return counts_; }
    const gl::Buffer& layerBlock() const { return layers_; }

 private:
    struct Variant {
        Channels channels;
        Kernel kernel;
        bool quads, cubes;
        auto operator<=>(const Variant&) const = default;
    };
    const gl::Program& program(const Variant& variant);

    std::map<Variant, gl::Program> programs_;  // compiled when first drawn with
    gl::Buffer view_, layers_;
    gl::Texture colorMaps_;
    float largestPoint_ = 1;         // side in pixels
    glm::ivec2 largestViewport_{0};  // a larger one is cut without a word
    Counts counts_;
};

}  // namespace render
