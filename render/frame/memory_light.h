// An eye's light made by the program, a few rows after another while they lie in the cache: nothing
// of it passes through a driver. Pure.
#pragma once

#include <vector>

#include "render/annotate/touched_pixels.h"
#include "render/frame/light_pass.h"

namespace render {

class MemoryLight final : public LightPass {
 public:
    // Placards are textures, and hidden areas a headset's: they are left to GL.
    static bool canDraw(std::span<const Placard> placards, std::span<const View> eyes);

    void setFont(const Font& font) override { font_ = &font; }
    std::unique_ptr<Targets> targets(glm::ivec2 size) const override;
    // REQUIRES of both: targets() of this size. Linear may be read, Srgb8 shown.
    void drawDepth(const FlatMesh& behind, std::span<const Placard> placards, const View& view,
                   Targets& targets) override;
    void enlarge(const Scene& scene, const View& view, int across, Targets& from,
                 Targets& to) override;
    void drawLight(const EyeContent& content, LightAs as, Targets& targets) override;

 private:
    const Font* font_ = nullptr;
    PlanePixels enlarged_;
    // Light of some rows, the ground's but while they are drawn.
    struct Room {
        std::vector<float> light;
        glm::vec3 ground{-1};
        TouchedPixels touched;
    };
    std::vector<Room> rooms_;  // one a thread
};

}  // namespace render
