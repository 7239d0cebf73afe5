#include "render/frame/memory_light.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
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
        : size_(targets.size()) {
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
    // Onto the ground.
    void draw(const PixelRows<float>& light, TouchedPixels* touched = nullptr) const {
        for (const FlatRaster& mesh : under_) mesh.draw(light, touched);
        resolve(light, touched);
        for (const FlatRaster& mesh : over_) mesh.draw(light, touched);
    }

 private:
    // All planes of an eye cover the same part of the picture, most of which is often empty.
    void resolve(const PixelRows<float>& light, TouchedPixels* touched) const {
        if (planes_.empty()) return;
        const PixelBox& part = planes_.front()->part;
        std::vector<SummedRow> rows = rows_;
        const int last = std::min(light.first + light.count, part.at.y + part.size.y);
        for (int y = std::max(light.first, part.at.y); y < last; ++y)
            for (int x = 0, end = 0; x < part.size.x; x = end) {
                while (end < part.size.x && !isEmptyAt(y - part.at.y, end))
                    end = std::min(end + kAtOnce, part.size.x);
                if (end > x) resolveRun(light, y, x, end, rows);
                if (end > x && touched)
                    touched->touch(y - light.first, part.at.x + x, part.at.x + end);
                while (end < part.size.x && isEmptyAt(y - part.at.y, end))
                    end = std::min(end + kAtOnce, part.size.x);
            }
    }
    const float* sumsAt(std::size_t plane, int row, int x) const {
        const MemoryTargets::Plane& of = *planes_[plane];
        return of.pixels.data() +
               floatsPerPixel(of.channels) *
                   (static_cast<std::size_t>(row) * static_cast<std::size_t>(of.part.size.x) +
                    static_cast<std::size_t>(x));
    }
    // Whether nothing was summed in so many pixels of a row of that part.
    bool isEmptyAt(int row, int x) const {
        const int count = std::min(kAtOnce, planes_.front()->part.size.x - x);
        std::uint32_t any = 0;
        for (std::size_t i = 0; i < planes_.size(); ++i) {
            const float* const sums = sumsAt(i, row, x);
            const std::size_t floats =
                floatsPerPixel(planes_[i]->channels) * static_cast<std::size_t>(count);
            for (std::size_t k = 0; k < floats; ++k) any |= std::bit_cast<std::uint32_t>(sums[k]);
        }
        return any == 0;
    }
    void resolveRun(const PixelRows<float>& light, int y, int first, int end,
                    std::vector<SummedRow>& rows) const {
        const PixelBox& part = planes_.front()->part;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            assert(planes_[i]->part == part);
            rows[i].sums = sumsAt(i, y - part.at.y, first);
        }
        const auto at =
            static_cast<std::size_t>(y - light.first) * static_cast<std::size_t>(size_.x) +
            static_cast<std::size_t>(part.at.x + first);
        resolveRow(rows, static_cast<std::size_t>(end - first), light.pixels + 4 * at);
    }
    static constexpr int kAtOnce = 64;

    const glm::ivec2 size_;
    std::vector<FlatRaster> under_, over_;
    std::vector<const MemoryTargets::Plane*> planes_;
    std::vector<SummedRow> rows_;  // without their sums
};

void fillWith(std::span<float> light, const glm::vec3& ground) {
    const glm::vec4 pixel(ground, 1);
    for (std::size_t i = 0; i < light.size(); i += 4) std::copy_n(&pixel.x, 4, &light[i]);
}

// Some rows that lie on the ground, as bytes; their light is the ground's again then. Most of it
// is, and is not looked at.
void encodeRows(std::span<float> light, const glm::vec3& ground, int width,
                const TouchedPixels& touched, std::span<std::uint8_t> bytes) {
    std::array<float, 4> pixel;
    std::array<std::uint8_t, 4> ofGround;
    fillWith(pixel, ground);
    encodeSrgb8(pixel, ofGround);
    const std::size_t row = 4 * static_cast<std::size_t>(width);
    for (std::size_t at = 0; at < light.size(); at += row)
        touched.forEachRun(static_cast<int>(at / row), [&](int first, int last, bool isTouched) {
            const std::size_t from = at + 4 * static_cast<std::size_t>(first);
            const std::size_t count = 4 * static_cast<std::size_t>(last - first);
            const auto to = bytes.subspan(from, count);
            if (isTouched) {
                encodeSrgb8(light.subspan(from, count), to);
                fillWith(light.subspan(from, count), ground);
            } else {
                for (std::size_t i = 0; i < count; i += 4) std::copy_n(&ofGround[0], 4, &to[i]);
            }
        });
}

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
    const glm::vec3 ground(content.background);
    const auto floatsBefore = [&](int rows) {
        return 4 * static_cast<std::size_t>(rows) * static_cast<std::size_t>(size.x);
    };
    if (as == LightAs::Linear) {
        const std::span<float> light = memory.linearLight();
        byRows(size.y, [&](unsigned, int first, int count) {
            const auto rows = light.subspan(floatsBefore(first), floatsBefore(count));
            fillWith(rows, ground);
            composition.draw({size, first, count, rows.data()});
        });
        return;
    }
    const std::span<std::uint8_t> bytes = memory.srgb8Light();
    rooms_.resize(sharingThreads());
    byRows(size.y, [&](unsigned thread, int first, int count) {
        Room& room = rooms_[thread];
        if (room.ground != ground || room.light.size() != floatsBefore(kRows)) {
            room.ground = ground;
            room.light.resize(floatsBefore(kRows));
            fillWith(room.light, ground);
        }
        room.touched.begin(size.x, count);
        composition.draw({size, first, count, room.light.data()}, &room.touched);
        encodeRows(std::span(room.light).first(floatsBefore(count)), ground, size.x, room.touched,
                   bytes.subspan(floatsBefore(first), floatsBefore(count)));
    });
}

}  // namespace render
