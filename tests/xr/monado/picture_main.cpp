// headset_picture OUT.png: what Monado's compositor shows of the demo, both eyes in its window.
// tests/xr/monado_root.sh picture
#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <glm/common.hpp>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "app/headset/headset.h"
#include "render/image/color.h"
#include "render/image/image.h"
#include "render/image/png.h"
#include "tests/support/built_paths.h"
#include "tests/support/monado_service.h"
#include "tests/support/screen_grab.h"
#include "tests/support/variable.h"

namespace {

using app::headset::Headset;

// Frames in which all comes to where it stays (what is read, the panel's texts, the resolution that
// the frame rate allows), and those in which the swaying head is waited for, some seconds.
constexpr int kFrames = 200, kSway = 400;

void drawFrames(Headset& headset, app::Exploration& exploration, int count) {
    for (int frames = 0; frames < count;) {
        if (!headset.frame()) throw std::runtime_error("the runtime has ended the session");
        if (exploration.shown() && headset.interaction().panel()) ++frames;
    }
}

std::ptrdiff_t brightPixels(const tests::ScreenGrab& grab) {
    constexpr int kBright = 60;
    return std::ranges::count_if(grab.pixels, [](const glm::u8vec3& p) {
        return std::max({p.r, p.g, p.b}) > kBright;
    });
}

// Where the head looks when most is to be seen.
tests::ScreenGrab bestGrab(Headset& headset, app::Exploration& exploration,
                           const std::string& screen) {
    exploration.open({tests::demo()});
    drawFrames(headset, exploration, kFrames);
    tests::ScreenGrab best;
    for (int frames = 0; frames < kSway; frames += 10) {
        drawFrames(headset, exploration, 10);
        const tests::Variable display("DISPLAY", screen);
        tests::ScreenGrab grab = tests::grabScreen();
        if (brightPixels(grab) > brightPixels(best)) best = std::move(grab);
    }
    return best;
}

// Without the black that lies around the compositor's window.
render::Image window(const tests::ScreenGrab& grab) {
    glm::ivec2 min = grab.size, max(0);
    for (int y = 0; y < grab.size.y; ++y)
        for (int x = 0; x < grab.size.x; ++x)
            if (grab.pixels[std::size_t(y) * grab.size.x + x] != glm::u8vec3(0)) {
                min = glm::min(min, glm::ivec2(x, y));
                max = glm::max(max, glm::ivec2(x, y) + 1);
            }
    if (min.x >= max.x) throw std::runtime_error("the compositor's window is black");
    render::Image image(max - min);
    for (int y = min.y; y < max.y; ++y)
        for (int x = min.x; x < max.x; ++x) {
            const glm::dvec3 pixel(grab.pixels[std::size_t(y) * grab.size.x + x]);
            image.at(x - min.x, y - min.y) = glm::vec4(render::linearFromSrgb(pixel / 255.0), 1);
        }
    return image;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return std::fputs("headset_picture OUT.png\n", stderr), 2;
    try {
        const tests::MonadoService service(tests::Monado::Window);
        // Without a mirror, which would lie over the compositor's window.
        const std::string screen = getenv("DISPLAY");
        const tests::Variable noDisplay("DISPLAY", std::nullopt);
        app::Exploration exploration{{.wake = [] {}}};
        std::optional<app::ExportJob> exporting;
        auto opened = Headset::open(exploration, exporting);
        if (const auto* none = std::get_if<xr::NoHeadset>(&opened))
            throw std::runtime_error(none->why);
        const auto headset = std::get<std::unique_ptr<Headset>>(std::move(opened));
        render::writePng(argv[1], window(bestGrab(*headset, exploration, screen)));
    } catch (const std::exception& error) {
        fmt::print(stderr, "headset_picture: {}\n", error.what());
        return 1;
    }
}
