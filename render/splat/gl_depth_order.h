// A draw list in order of depth, made on the GPU from the step's points there.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>

#include "render/gl/object.h"
#include "render/splat/gl_radix_sort.h"
#include "render/splat/gl_step.h"
#include "render/splat/pieces.h"

namespace render {

// One entry of a sorted list as splat.vert reads it.
struct SortedPoint {
    std::uint32_t gridIndex;
    float value;
    std::uint32_t layer;
};

// Keys as DepthKeys has them, worked out in float from the distance of the origin, so that an eye
// far away costs no digits. Ties keep the order of value. Points that the clip box leaves out, or
// that have no place, come last and are not drawn.
class GlDepthOrder {
 public:
    // `most`: bytes of a buffer that shaders bind.
    explicit GlDepthOrder(std::uint64_t most = mostBytes());
    static std::uint64_t mostBytes();  // that they can bind here

    // Whether so many points can be put in order.
    bool fits(const Scene& scene, const GlStep& step) const;
    struct List {
        std::shared_ptr<const gl::Buffer> points;  // SortedPoint, farthest first
        std::uint64_t count = 0;
    };
    // REQUIRES: fits(), and a step that is ready for the scene. Once nobody holds a list, the next
    // one may be put where it was. Throws std::runtime_error, and holds nothing any more, where
    // they do not fit or there is no room.
    List operator()(const Scene& scene, const glm::dvec3& midEye, const GlStep& step);
    std::uint64_t bytes() const { return sort_.bytes() + (list_ ? list_->bytes() : 0); }

 private:
    bool fits(std::uint64_t points, const Scene& scene, const GlStep& step) const;
    List ordered(const Scene& scene, const glm::dvec3& midEye, const GlStep& step);
    const gl::Program& keys(bool mesh);
    void findKeys(const Scene& scene, const glm::dvec3& midEye, const GlStep& step,
                  std::span<const Piece> pieces);
    void sort(std::uint64_t drawn, const GlStep& step);

    std::map<bool, gl::Program> keys_;  // of points of meshes, and of others
    std::map<bool, gl::Program> last_;  // of points that have values, and of others
    gl::Buffer view_, of_;
    std::optional<gl::Buffer> before_;  // of each subset's places
    std::optional<gl::Buffer> pieces_;
    GlRadixSort sort_;
    std::shared_ptr<gl::Buffer> list_;
    std::uint64_t most_;
};

}  // namespace render
