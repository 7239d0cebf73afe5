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

// A step's points on the GPU: 4 bytes a point, 4 more once a layer is coloured by value.
class GpuStep {
 public:
    // Throws std::length_error for 2^31 points or more, the most that one draw call can count.
    GpuStep(const timeseries::SortedStep& step, const Lattice& lattice);
    // Uploads the values when the scene needs them and they are not there.
    void needValues(const timeseries::SortedStep& step);

    const gl::Buffer& gridIndex() const { return gridIndex_; }
    const gl::Buffer* values() const { return values_ ? &*values_ : nullptr; }
    const gl::BufferTexture& axisPoints() const { return axisTexture_; }
    std::size_t bytes() const;

 private:
    gl::Buffer gridIndex_, axisPoints_;
    gl::BufferTexture axisTexture_;
    std::optional<gl::Buffer> values_;
};

// How a value becomes what a shader sees: [0, 1] over the step's finite values, in double.
struct ValueScale {
    double lo = 0, perUnit = 0;  // normalised = (v - lo) perUnit; a constant step gives 0
    static ValueScale of(const timeseries::SortedStep& step);
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
    float largestPoint_ = 1;  // side in pixels
    Counts counts_;
};

}  // namespace render
