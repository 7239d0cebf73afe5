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
    // Whether values on this scale serve as well as on `wanted`: to 1e-4 of its map.
    bool serves(const ValueScale& wanted) const;
    float operator()(double value) const;
    friend bool operator==(const ValueScale&, const ValueScale&) = default;
};

// A step's points on the GPU: 4 bytes a point, 4 more once a layer is coloured by value. Room is
// taken at once; what it holds comes in slices, in order of value, so that frames keep their pace.
class GpuStep {
 public:
    // Holds no points yet. Throws std::length_error for 2^31 points or more, the most that one draw
    // call can count, and std::runtime_error when the driver has no room.
    GpuStep(const timeseries::SortedStep& step, const Lattice& lattice);

    // Uploads the next points, then their values on `scale` if there is one, at most `bytes` (to a
    // whole number). While values on another scale come, those that are there stay in use.
    static constexpr std::uint64_t kAll = ~std::uint64_t{0};
    void upload(const timeseries::SortedStep& step, const std::optional<ValueScale>& scale,
                std::uint64_t bytes = kAll);
    // What upload() has still to do.
    std::uint64_t missingBytes(const std::optional<ValueScale>& scale) const;
    // All points, and values on some scale if they are wanted: what a draw needs.
    bool ready(bool byValue) const { return points_ == count_ && (!byValue || values_); }
    // Draws the points where this lattice, of the same grid, has them.
    void place(const Lattice& lattice);

    const gl::Buffer& gridIndex() const { return gridIndex_; }
    const gl::Buffer* values() const { return values_ ? &values_->buffer : nullptr; }
    // Of values(). REQUIRES: they are there.
    const ValueScale& valueScale() const { return values_->scale; }
    const gl::BufferTexture& axisPoints() const { return axisTexture_; }
    std::uint64_t bytes() const;

 private:
    struct ScaledValues {
        gl::Buffer buffer;
        ValueScale scale;
        std::uint64_t count = 0;  // uploaded
    };
    std::uint64_t count_, points_ = 0;  // of the step, and of those that are there
    gl::Buffer gridIndex_, axisPoints_;
    gl::BufferTexture axisTexture_;
    std::optional<ScaledValues> values_, coming_;  // values_ is whole
};
// What a scene's colours need of the values: nothing, when no layer that is drawn from the step's
// own runs is coloured by value (a sorted list brings its own).
std::optional<ValueScale> neededScale(const Scene& scene);

// One frame's list, ready to draw for any number of eyes.
class GpuList;

class GlSplatter {
 public:
    GlSplatter();
    ~GlSplatter();

    // Once a frame. `step` holds the scene's step and is ready for it. The list refers to both.
    std::unique_ptr<GpuList> upload(const Scene& scene, const DrawList& list, const GpuStep& step);

    // Once an eye: adds one plane into a framebuffer whose one colour attachment is of that kind
    // (R32F or RGBA32F) and whose depth attachment is the opaque scene's, tested, not written.
    // `layer` is the plane's layer for Weight and WeightedColor. Clears nothing.
    void draw(GpuList& list, const View& view, Channels channels, std::size_t layer,
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
