#include "render/frame/memory_light.h"

#include <algorithm>
#include <atomic>
#include <cassert>

#include "render/annotate/flat_raster.h"
#include "render/frame/enlarge.h"
#include "render/frame/resolve.h"
#include "render/image/encode_srgb.h"
#include "render/splat/memory_targets.h"
#include "render/together.h"

namespace render {
namespace {

// Rows at once: of a picture 1024 pixels wide they fill half of a second-level cache.
constexpr int kRows = 32;

class Composition {
 public:
    Composition(const EyeContent& content, const Font& font, const MemoryTargets& targets)
        : background_(glm::vec3(content.background), 1), size_(targets.size()) {
        const auto raster = [&](const FlatMesh& mesh) { return FlatRaster(mesh, font, size_); };
        for (const FlatMesh* mesh : {&content.axes.mapBehind, &content.axes.behind})
            under_.push_back(raster(*mesh));
        const FlatMesh ground = legendGround(content.legend, size_, content.background);
        for (const FlatMesh* mesh :
             {&content.axes.mapBefore, &content.axes.before, &content.axes.grounds,
              &content.axes.labels, &ground, &content.legend})
            over_.push_back(raster(*mesh));
        const std::vector<Channels> channels = channelsFor(content.scene);
        for (std::size_t i = 0; i < channels.size(); ++i) {
            planes_.push_back(&targets.plane(i));
            assert(planes_[i]->channels == channels[i]);
            if (channels[i] == Channels::Over) {
                rows_.push_back({Channels::Over, nullptr, 1, {}});
                continue;
            }
            const RangeStyle& style = content.scene.layers[i].style;
            const auto* constant = std::get_if<Constant>(&style.color);
            const glm::vec3 rgb = constant ? glm::vec3(constant->linearRgb) : glm::vec3(0);
            rows_.push_back({channels[i],
                             nullptr,
                             static_cast<float>(opticalDepthPerWeight(style.opacity)),
                             {rgb.x, rgb.y, rgb.z}});
        }
    }
    void draw(const PixelRows<float>& light) const {
        const std::size_t pixels =
            static_cast<std::size_t>(light.count) * static_cast<std::size_t>(size_.x);
        for (std::size_t i = 0; i < pixels; ++i)
            std::copy_n(&background_.x, 4, light.pixels + 4 * i);
        for (const FlatRaster& mesh : under_) mesh.draw(light);
        resolve(light);
        for (const FlatRaster& mesh : over_) mesh.draw(light);
    }

 private:
    // All planes of an eye cover the same part of the picture.
    void resolve(const PixelRows<float>& light) const {
        if (planes_.empty()) return;
        const PixelBox& part = planes_.front()->part;
        std::vector<SummedRow> rows = rows_;
        const int last = std::min(light.first + light.count, part.at.y + part.size.y);
        for (int y = std::max(light.first, part.at.y); y < last; ++y) {
            for (std::size_t i = 0; i < rows.size(); ++i) {
                const std::size_t floats = floatsPerPixel(rows[i].channels);
                assert(planes_[i]->part == part);
                rows[i].sums =
                    planes_[i]->pixels.data() + floats * static_cast<std::size_t>(y - part.at.y) *
                                                    static_cast<std::size_t>(part.size.x);
            }
            const auto at =
                static_cast<std::size_t>(y - light.first) * static_cast<std::size_t>(size_.x) +
                static_cast<std::size_t>(part.at.x);
            resolveRow(rows, static_cast<std::size_t>(part.size.x), light.pixels + 4 * at);
        }
    }

    const glm::vec4 background_;
    const glm::ivec2 size_;
    std::vector<FlatRaster> under_, over_;
    std::vector<const MemoryTargets::Plane*> planes_;
    std::vector<SummedRow> rows_;  // without their sums
};

// work(thread, first row, rows) for all of a picture's rows, on as many threads as share a picture.
template <typename Work>
void byRows(int height, const Work& work) {
    std::atomic<int> next{0};
    together(sharingThreads(), [&](unsigned thread) {
        for (int first; (first = next.fetch_add(kRows)) < height;)
            work(thread, first, std::min(kRows, height - first));
    });
}

}  // namespace

bool MemoryLight::canDraw(std::span<const Placard> placards, std::span<const View> eyes) {
    return placards.empty() &&
           std::ranges::none_of(eyes, [](const View& eye) { return eye.hidden != nullptr; });
}

std::unique_ptr<Targets> MemoryLight::targets(glm::ivec2 size) const {
    return std::make_unique<MemoryTargets>(size);
}

void MemoryLight::drawDepth(const FlatMesh& behind, std::span<const Placard>, const View& view,
                            Targets& targets) {
    auto& depth = static_cast<MemoryTargets&>(targets).depth();
    const FlatRaster raster(behind, *font_, view.size);
    if (raster.empty()) return depth.clear();
    const auto width = static_cast<std::size_t>(view.size.x);
    depth.resize(width * static_cast<std::size_t>(view.size.y));
    byRows(view.size.y, [&](unsigned, int first, int count) {
        const std::span rows = std::span(depth).subspan(static_cast<std::size_t>(first) * width,
                                                        static_cast<std::size_t>(count) * width);
        std::ranges::fill(rows, 1.0f);
        raster.drawDepth({view.size, first, count, rows.data()});
    });
}

void MemoryLight::enlarge(const Scene& scene, const View& view, int across, Targets& from,
                          Targets& to) {
    const PixelBox covered = coveredPixels(scene, view);
    for (std::size_t i = 0; i < channelsFor(scene).size(); ++i) {
        const MemoryTargets::Plane& coarse = static_cast<MemoryTargets&>(from).plane(i);
        render::enlarge(coarse, across, covered, enlarged_);
        to.putPlane(i, coarse.channels, covered, enlarged_);
    }
}

void MemoryLight::drawLight(const EyeContent& content, LightAs as, Targets& targets) {
    auto& memory = static_cast<MemoryTargets&>(targets);
    const Composition composition(content, *font_, memory);
    const glm::ivec2 size = memory.size();
    const auto floatsBefore = [&](int rows) {
        return 4 * static_cast<std::size_t>(rows) * static_cast<std::size_t>(size.x);
    };
    if (as == LightAs::Linear) {
        const std::span<float> light = memory.linearLight();
        byRows(size.y, [&](unsigned, int first, int count) {
            composition.draw({size, first, count, &light[floatsBefore(first)]});
        });
        return;
    }
    const std::span<std::uint8_t> bytes = memory.srgb8Light();
    rooms_.resize(sharingThreads());
    byRows(size.y, [&](unsigned thread, int first, int count) {
        std::vector<float>& light = rooms_[thread];
        light.resize(floatsBefore(count));
        composition.draw({size, first, count, light.data()});
        encodeSrgb8(light, bytes.subspan(floatsBefore(first), floatsBefore(count)));
    });
}

}  // namespace render
