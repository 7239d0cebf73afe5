#include "render/splat/processor_splatter.h"

#include <utility>
#include <variant>

#include "render/model/rays_across.h"
#include "render/splat/cell_pieces.h"
#include "render/splat/cell_splatter.h"
#include "render/splat/row_splatter.h"

namespace render {
namespace {

template <typename Sum, typename Memory>
class Plane final : public PlaneSum {
 public:
    Plane(Sum sum, Channels channels, std::size_t plane, Targets& targets, Memory& memory)
        : sum_(std::move(sum)),
          channels_(channels),
          plane_(plane),
          targets_(targets),
          memory_(memory) {
        if (sum_.done()) write();
    }
    ~Plane() override { memory_ = sum_.takeMemory(); }
    Plane(const Plane&) = delete;
    Plane& operator=(const Plane&) = delete;
    std::uint64_t add(std::uint64_t splats) override {
        const std::uint64_t added = sum_.add(splats);
        if (sum_.done() && added > 0) write();
        return added;
    }
    bool done() const override { return sum_.done(); }

 private:
    void write() { targets_.putPlane(plane_, channels_, sum_.box(), sum_.plane()); }

    Sum sum_;
    Channels channels_;
    std::size_t plane_;
    Targets& targets_;
    Memory& memory_;
};

class ProcessorFrame final : public SplatFrame {
 public:
    ProcessorFrame(const Scene& scene, DrawList list, ProcessorSplatter::Memory& memory)
        : scene_(scene), list_(std::move(list)), memory_(memory) {}

    std::uint64_t splats(Channels channels, std::size_t layer) const override {
        if (scene_.cells) return cellCount(scene_, channels, layer);
        if (const auto* sorted = std::get_if<Sorted>(&list_)) return sorted->point.size();
        return splatCount(scene_.layers[layer], scene_.stride);
    }
    std::unique_ptr<PlaneSum> begin(const View& view, Channels channels, std::size_t layer,
                                    Targets& targets) override {
        if (layer == 0) opaqueDepth_ = targets.opaqueDepth(memory_.opaqueDepth);
        const auto plane = [&](auto sum, auto& memory) {
            return std::make_unique<Plane<decltype(sum), std::decay_t<decltype(memory)>>>(
                std::move(sum), channels, layer, targets, memory);
        };
        if (scene_.cells)
            return plane(
                CellSum(scene_, view, channels, layer, opaqueDepth_, raysAcross(scene_, view),
                        sharingThreads(), std::move(memory_.cells)),
                memory_.cells);
        if (TileSum::canSum(scene_, channels))
            return plane(TileSum(scene_, list_, view, channels, layer, opaqueDepth_,
                                 sharingThreads(), std::move(memory_.tiles)),
                         memory_.tiles);
        return plane(RowSum(scene_, list_, view, channels, layer, opaqueDepth_, sharingThreads(),
                            std::move(memory_.rows)),
                     memory_.rows);
    }

 private:
    const Scene& scene_;
    const DrawList list_;
    ProcessorSplatter::Memory& memory_;
    std::span<const float> opaqueDepth_;
};

}  // namespace

std::unique_ptr<SplatFrame> ProcessorSplatter::prepare(const Scene& scene, DrawList list,
                                                       const GlStep&) {
    return std::make_unique<ProcessorFrame>(scene, std::move(list), memory_);
}

}  // namespace render
