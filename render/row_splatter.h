// Splats summed on the processor, a row of pixels after another: for drivers that draw there
// themselves, whose point sprites cost several times what their pixels do. The model of
// render/footprint.h in float.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <thread>
#include <vector>

#include "render/scene.h"
#include "render/view.h"

namespace render {

// As many as the machine has, up to where starting more costs more than it saves.
inline unsigned rowThreads() { return std::min(std::thread::hardware_concurrency(), 16u); }

// What one layer of a scene adds up to in a view, over as many calls as one likes: not a bit
// depends on their number, nor on that of the threads.
class RowSum {
 public:
    // `opaqueDepth` is the depth [0, 1] of the opaque scene, a pixel each, row 0 at the bottom: a
    // splat whose centre lies behind it is not drawn there. It, scene and view must outlive this.
    // REQUIRES: Weight or WeightedColor.
    RowSum(const Scene& scene, const View& view, Channels channels, std::size_t layer,
           std::span<const float> opaqueDepth, unsigned threads = rowThreads());
    RowSum(RowSum&&) noexcept;
    ~RowSum();

    // Adds that many splats, or kLeast if that is more, or what is left, give or take the
    // unevenness of a subset (render/subset.h). Returns how many.
    std::uint64_t add(std::uint64_t splats);
    static constexpr std::uint64_t kLeast = 1 << 12;
    bool done() const;
    // [y][x][1 or 4], row 0 at the bottom.
    const std::vector<float>& plane() const;

 private:
    struct Work;
    std::unique_ptr<Work> work_;
};

// All of it at once.
std::vector<float> sumRows(const Scene& scene, const View& view, Channels channels,
                           std::size_t layer, std::span<const float> opaqueDepth,
                           unsigned threads = rowThreads());

}  // namespace render
