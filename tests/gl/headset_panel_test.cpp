// The panels in a headset: drawn on their board, pressed by a ray.
#include "app/headset/panel.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <set>

#include "render/gl/debug_output.h"
#include "render/gl/headless_context.h"
#include "tests/support/scripted_exploration.h"

namespace app::headset {
namespace {

using namespace std::chrono_literals;

class HeadsetPanel : public testing::Test {
 protected:
    panels::Requests frame(const std::optional<Pointer>& pointer = {}) {
        Panel::Around around{};
        around.help = "Trigger: play";
        panels::Requests requests = panel_.draw(world_.exploration, pointer, around, 11ms);
        render::gl::throwOnError();
        return requests;
    }
    // A place of the panel as a ray meets it.
    static glm::dvec2 at(const panels::Rect& rect) {
        return glm::dvec2(rect.centre()) / glm::dvec2(kPanelPixels);
    }
    void click(glm::dvec2 where) {
        for (const bool pressed : {false, true, false}) frame(Pointer{where, pressed, 0});
    }
    static panels::Layout layout() {
        return panels::layoutOf(glm::vec2(kPanelPixels), kPanelScale);
    }

    render::gl::HeadlessContext context_;
    tests::ScriptedExploration world_;
    Panel panel_{[] {}};
};

TEST_F(HeadsetPanel, ARayPressesTheButtonThatItMeets) {
    frame();
    const glm::dvec2 play = at(panels::timeBarLayout(layout().timeBar, kPanelScale).play);
    EXPECT_FALSE(world_.exploration.playback().playing);
    click(play);
    EXPECT_TRUE(world_.exploration.playback().playing);
    click(play);
    EXPECT_FALSE(world_.exploration.playback().playing);
}

TEST_F(HeadsetPanel, ARayWhereAWindowHasItsPictureTurnsNothing) {
    frame();
    const Explorer before = world_.exploration.explorer();
    const glm::dvec2 from = at(layout().picture);
    frame(Pointer{from, false, 0});
    for (int i = 0; i < 10; ++i) frame(Pointer{from + glm::dvec2(0.01 * i, 0), true, 0});
    frame(Pointer{from, false, 0});
    EXPECT_TRUE(world_.exploration.explorer() == before);
}

TEST_F(HeadsetPanel, IsDrawnOpaqueAndUprightOnItsBoard) {
    frame();
    std::vector<glm::u8vec4> pixels(std::size_t(kPanelPixels.x) * kPanelPixels.y);
    glGetTextureImage(panel_.board().texture(), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                      static_cast<GLsizei>(pixels.size() * 4), pixels.data());
    const auto colorsIn = [&](const panels::Rect& rect) {
        std::set<std::tuple<int, int, int>> colors;
        for (int y = static_cast<int>(rect.min.y); y < static_cast<int>(rect.max.y); ++y)
            for (int x = static_cast<int>(rect.min.x); x < static_cast<int>(rect.max.x); ++x) {
                // Row 0 of a texture is the lowest.
                const glm::u8vec4 p =
                    pixels[std::size_t(kPanelPixels.y - 1 - y) * kPanelPixels.x + x];
                colors.emplace(p.r, p.g, p.b);
            }
        return colors.size();
    };
    EXPECT_GT(colorsIn(layout().side), 100u) << "panels and texts";
    EXPECT_GT(colorsIn(layout().timeBar), 20u);
    const panels::Rect emptyCorner{{0, 200}, {150, 260}};
    EXPECT_EQ(colorsIn(emptyCorner), 1u) << "nothing stands beside the help";
}

}  // namespace
}  // namespace app::headset
