#include "app/panels/messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/panels/widgets.h"

namespace app::panels {
namespace {

// Lines that a card shows before it is opened, and when it is; the rest scrolls.
constexpr float kLines = 4, kMostLines = 14;

// A message with its place on the screen.
struct Card {
    Rect at, inner;
    std::string
        text;  // in lines; begin and end of what is too long: what it is about, and what is wrong
    bool isLong = false;
};

// Upwards from `bottom`; `hasButtons` below its text in any case.
Card cardOf(const PanelContext& context, const std::string& message, float bottom, bool opened,
            bool hasButtons) {
    const float s = context.theme.scale;
    const Rect& picture = context.layout.picture;
    const float width = std::min(420 * s, picture.size().x - 2 * kMargin * s);
    const float right = picture.max.x - kMargin * s, left = right - width, wrap = width - 60 * s;
    const ImFont& font = *context.theme.text;
    const float line = font.FontSize;
    const auto heightOf = [&](std::string_view text) {
        const std::string lines = inLines(*context.theme.text, text, wrap);
        return line * static_cast<float>(1 + std::ranges::count(lines, '\n'));
    };
    const auto isFew = [&](std::string_view text) {
        return heightOf(text) < (kLines + 0.5f) * line;
    };
    Card card{.at = {}, .inner = {}, .text = message, .isLong = !isFew(message)};
    if (!opened) card.text = shortened(message, isFew);
    card.text = inLines(*context.theme.text, card.text, wrap);
    const float most = std::min(kMostLines * line, 0.4f * picture.size().y);
    const float height =
        std::min(line * static_cast<float>(1 + std::ranges::count(card.text, '\n')), most);
    const float top = std::floor(bottom - height - (card.isLong || hasButtons ? 56 : 22) * s);
    card.at = {{left, top}, {right, bottom}};
    card.inner = {{left + 16 * s, top + 11 * s}, {left + 16 * s + wrap, top + 11 * s + height}};
    return card;
}

void drawGround(const Theme& theme, const Rect& at, bool isError) {
    const float s = theme.scale;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(im(at.min), im(at.max), faded(kField, 0.97f), 6 * s);
    list.AddRect(im(at.min), im(at.max), kLine, 6 * s);
    list.AddRectFilled(im(at.min), {at.min.x + 4 * s, at.max.y}, isError ? kError : kAccent, 6 * s,
                       ImDrawFlags_RoundCornersLeft);
}

void drawText(const Theme& theme, const Card& card) {
    ImGui::SetCursorScreenPos(im(card.inner.min));
    ImGui::BeginChild("##text", {card.inner.size().x + 14 * theme.scale, card.inner.size().y});
    const Characters c(card.text);
    ImGui::TextUnformatted(c.begin, c.end);
    ImGui::EndChild();
}

}  // namespace

// Draws upwards from `bottom`; returns its top.
float Messages::card(PanelContext& context, const Exploration::Message& message, float bottom,
                     const Others& others, Pressed& pressed) {
    const Theme& theme = context.theme;
    const float s = theme.scale;
    const bool opened = opened_.contains(message.number);
    const Card place = cardOf(context, message.text, bottom, opened, others.count > 0);
    const Rect& at = place.at;
    ImGui::PushID(static_cast<int>(message.number));
    drawGround(theme, at, message.isError);
    drawText(theme, place);
    const float row = at.max.y - 34 * s;
    float left = place.inner.min.x;
    const auto inRow = [&](const char* id, std::string_view label, float width) {
        const Rect button{{left, row}, {left + width * s, row + 24 * s}};
        left += (width + 8) * s;
        return textButton(theme, id, button, label);
    };
    if (place.isLong) {
        if (inRow("more", opened ? "Less" : "More", 64)) {
            if (opened)
                opened_.erase(message.number);
            else
                opened_.insert(message.number);
        }
        if (inRow("copy", "Copy", 64)) ImGui::SetClipboardText(message.text.c_str());
    }
    if (others.count > 0) {
        const std::string label =
            others.shown ? std::string("Only the last") : fmt::format("{} earlier", others.count);
        if (inRow("others", label, 104)) areAllShown_ = !others.shown;
        pressed.closeAll = inRow("all", "Close all", 88);
    }
    const Rect close{{at.max.x - 34 * s, at.min.y + 6 * s}, {at.max.x - 8 * s, at.min.y + 32 * s}};
    pressed.close = iconButton(theme, "##close", close, Icon::Remove, "Close");
    ImGui::PopID();
    return at.min.y;
}

void Messages::draw(PanelContext& context, float bottom, std::chrono::nanoseconds dt) {
    const std::vector<Exploration::Message> messages = context.exploration.messages();
    const auto isGone = [&](std::uint64_t number) {
        return std::none_of(messages.begin(), messages.end(),
                            [&](const auto& m) { return m.number == number; });
    };
    std::erase_if(shownFor_, [&](const auto& entry) { return isGone(entry.first); });
    std::erase_if(opened_, isGone);
    const auto errors = static_cast<std::size_t>(
        std::ranges::count(messages, true, &Exploration::Message::isError));
    if (errors < 2) areAllShown_ = false;
    const bool all = areAllShown_;
    const float s = context.theme.scale;
    bool isLast = true;  // of the errors
    for (std::size_t i = messages.size(); i-- > 0;) {
        const Exploration::Message& message = messages[i];
        if (message.isError && !isLast && !all) continue;
        Others others;
        if (message.isError && std::exchange(isLast, false))
            others = {.count = errors - 1, .shown = all};
        Pressed pressed;
        bottom = card(context, message, bottom, others, pressed) - 8 * s;
        if (!message.isError) {
            auto& shown = shownFor_[message.number];
            shown += dt;
            pressed.close = pressed.close || shown >= kStay;
        }
        for (const Exploration::Message& each : messages)
            if (pressed.closeAll && each.isError) context.exploration.forgetMessage(each.number);
        if (pressed.close) context.exploration.forgetMessage(message.number);
        if (bottom < context.layout.picture.centre().y) break;  // the picture stays in sight
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
