#include "app/panels/start_screen.h"

#include "app/panels/widgets.h"

namespace app::panels {
namespace {

// A line that opens something; returns whether it was pressed.
bool offer(const Theme& theme, const Rect& at, Icon icon, std::string_view what,
           std::string_view where) {
    const float s = theme.scale;
    const Pressing p = button(std::string(what).append(where).c_str(), at);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(im(at.min), im(at.max), p.hovered ? kRaised : kPanel, 6 * s);
    drawIcon(list, icon, {at.min.x + 22 * s, at.centre().y}, s, p.hovered ? kAccent : kDim);
    text(theme, {at.min.x + 44 * s, at.centre().y}, what);
    const float used = widthOf(*theme.text, what) + 60 * s;
    text(theme, {at.max.x - 16 * s, at.centre().y},
         fitting(*theme.small, where, at.size().x - used - 16 * s), kFaint, 1, theme.small);
    return p.clicked;
}

}  // namespace

void drawStartScreen(PanelContext& context, const StartOffers& offers) {
    constexpr std::size_t kRecent = 5;
    const Theme& theme = context.theme;
    const float s = theme.scale;
    const std::size_t recent = std::min(kRecent, offers.recent.size());
    const StartLayout at = startLayout(context.layout.picture, s, recent);
    const float left = at.first.min.x;
    text(theme, {left, at.first.min.y - 60 * s}, "isochron", kText, 0, theme.title);
    text(theme, {left, at.first.min.y - 26 * s},
         "Drop a file, a folder or a member of a series here, or open one:", kDim);
    auto next = [&, i = std::size_t{0}]() mutable { return at.offer(i++); };
    if (offer(theme, next(), Icon::Folder, "Open…", "Ctrl+O"))
        context.requests.commands.push_back(Command::Open);
    if (!offers.autosave.empty() &&
        offer(theme, next(), Icon::Loop, "Go on where the last session broke off", ""))
        context.requests.open = {offers.autosave};
    if (!offers.demo.empty() &&
        offer(theme, next(), Icon::Play, "The demo: a pool fire", offers.demo.filename().string()))
        context.requests.open = {offers.demo};
    for (std::size_t i = 0; i < recent; ++i) {
        const Named& named = offers.recent[i];
        if (offer(theme, next(), Icon::File, shortName(named),
                  named.front().parent_path().string()))
            context.requests.open = named;
    }
}

}  // namespace app::panels
