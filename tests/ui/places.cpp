#include "tests/ui/places.h"

#include <algorithm>

namespace ui {

using app::panels::Rect;

Places placesOf(glm::ivec2 size, bool hasMap, float scale) {
    Places out;
    out.window = app::panels::layoutOf(glm::vec2(size), scale);
    out.histogramPanel = app::panels::histogramLayout(
        app::panels::sideLayout(out.window, 1).histogramPanel, scale, hasMap);
    out.timeBar = app::panels::timeBarLayout(out.window.timeBar, scale);
    out.clear = out.messages = out.window.picture;
    out.clear.min.y += 130 * scale;
    out.clear.max.y -= 160 * scale;
    out.besideMessages = out.window.picture;
    out.besideMessages.max.x -= 460 * scale;
    out.messages.min.y = out.clear.max.y;
    out.messages.max.y = app::panels::messagesBottom(out.window.picture, scale);
    return out;
}

glm::vec2 tabPlace(const app::panels::SideLayout& side, Tab which) {
    const float left = side.tabs.min.x + app::panels::kMargin,
                width = (side.tabs.size().x - 2 * app::panels::kMargin) / 4;
    return {left + (static_cast<float>(which) + 0.5f) * width, side.tabs.centre().y};
}

Rect pageRow(const app::panels::SideLayout& side, std::size_t i, std::size_t gaps) {
    const float top =
        side.page.min.y + 10 + 36 * static_cast<float>(i) + 6 * static_cast<float>(gaps);
    return {{side.page.min.x + app::panels::kMargin + 104, top},
            {side.page.max.x - app::panels::kMargin, top + 28}};
}

glm::vec2 startOffer(glm::ivec2 window, std::size_t which, std::size_t recent) {
    const app::panels::Layout all = app::panels::layoutOf(glm::vec2(window), 1);
    return app::panels::startLayout(all.window, 1, recent).offer(which).centre();
}

void waitUntilSeen(Driver& desk, std::size_t steps, float scale) {
    const Rect rail = placesOf(desk.size(), true, scale).timeBar.rail;
    const app::panels::StepAxis axis{steps, rail.min.x, rail.max.x};
    desk.waitFor("all steps are seen", [&] {
        const Shot shot = desk.shot();
        for (std::size_t i = 0; i < steps; ++i) {
            // Beside the bracket on the left and the cursor in the middle.
            const Rect cell{{axis.cell(i) + 7 * scale, rail.centre().y - 3 * scale},
                            {axis.centre(i) - 3 * scale, rail.centre().y + 3 * scale}};
            const Shot seen = part(shot, cell);
            if (std::ranges::count(seen.pixels, seen.pixels.at(0)) != std::ssize(seen.pixels))
                return false;
        }
        return true;
    });
}

}  // namespace ui
