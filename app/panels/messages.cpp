#include "app/panels/messages.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/panels/widgets.h"

namespace app::panels {
namespace {

// Draws upwards from `bottom`; returns its top. `closed`: it was pressed away.
float card(const Desk& desk, const Exploration::Message& message, float bottom, bool& closed) {
    const float s = desk.theme.scale;
    const Rect& picture = desk.layout.picture;
    const float width = std::min(420 * s, picture.size().x - 2 * kMargin * s);
    const float right = picture.max.x - kMargin * s, left = right - width;
    ImFont& font = *desk.theme.text;
    const char *begin = message.text.data(), *end = begin + message.text.size();
    const float wrap = width - 60 * s;
    const float height = font.CalcTextSizeA(font.FontSize, FLT_MAX, wrap, begin, end).y + 22 * s;
    const Rect at{{left, bottom - height}, {right, bottom}};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(im(at.min), im(at.max), faded(kField, 0.97f), 6 * s);
    list.AddRect(im(at.min), im(at.max), kLine, 6 * s);
    list.AddRectFilled(im(at.min), {at.min.x + 4 * s, at.max.y}, message.isError ? kError : kAccent,
                       6 * s, ImDrawFlags_RoundCornersLeft);
    list.AddText(&font, font.FontSize, {left + 16 * s, at.min.y + 11 * s}, kText, begin, end, wrap);
    const Rect close{{right - 34 * s, at.min.y + 6 * s}, {right - 8 * s, at.min.y + 32 * s}};
    closed = iconButton(desk.theme, fmt::format("##close{}", message.number).c_str(), close,
                        Icon::Remove, "Close");
    return at.min.y;
}

}  // namespace

void Messages::draw(Desk& desk, std::chrono::nanoseconds dt) {
    const std::vector<Exploration::Message> messages = desk.exploration.messages();
    std::erase_if(shownFor_, [&](const auto& entry) {
        return std::none_of(messages.begin(), messages.end(),
                            [&](const auto& m) { return m.number == entry.first; });
    });
    const float s = desk.theme.scale;
    float bottom = desk.layout.picture.max.y - 76 * s;  // above the frame's figures
    for (std::size_t i = messages.size(); i-- > 0;) {
        bool closed = false;
        bottom = card(desk, messages[i], bottom, closed) - 8 * s;
        if (!messages[i].isError) {
            auto& shown = shownFor_[messages[i].number];
            shown += dt;
            closed = closed || shown >= kStay;
        }
        if (closed) desk.exploration.forgetMessage(messages[i].number);
        if (bottom < desk.layout.picture.min.y + 100 * s) break;
    }
}

std::optional<std::chrono::nanoseconds> Messages::untilNextGoes() const {
    std::optional<std::chrono::nanoseconds> least;
    for (const auto& [number, shown] : shownFor_)
        least =
            std::min(least.value_or(kStay), std::max(kStay - shown, std::chrono::nanoseconds(0)));
    return least;
}

}  // namespace app::panels
