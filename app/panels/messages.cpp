#include "app/panels/messages.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "app/panels/widgets.h"

namespace app::panels {
namespace {

// Lines that a card shows before it is opened, and when it is; the rest scrolls.
constexpr float kLines = 4, kMostLines = 14;

// A message with its place on the screen.
struct Card {
    Rect at, inner;
    std::string text;  // begin and end of what is too long: what it is about, and what is wrong
    bool isLong = false;
};

// Upwards from `bottom`.
Card cardOf(const Desk& desk, const std::string& message, float bottom, bool opened) {
    const float s = desk.theme.scale;
    const Rect& picture = desk.layout.picture;
    const float width = std::min(420 * s, picture.size().x - 2 * kMargin * s);
    const float right = picture.max.x - kMargin * s, left = right - width, wrap = width - 60 * s;
    const ImFont& font = *desk.theme.text;
    const float line = font.FontSize;
    const auto heightOf = [&](std::string_view text) {
        const char* begin = text.data();
        return font.CalcTextSizeA(line, FLT_MAX, wrap, begin, begin + text.size()).y;
    };
    const auto isFew = [&](std::string_view text) {
        return heightOf(text) < (kLines + 0.5f) * line;
    };
    Card card{.at = {}, .inner = {}, .text = message, .isLong = !isFew(message)};
    if (!opened) card.text = shortened(message, isFew);
    const float most = std::min(kMostLines * line, 0.4f * picture.size().y);
    const float height = std::min(heightOf(card.text), most);
    const float top = std::floor(bottom - height - (card.isLong ? 56 : 22) * s);
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
    ImGui::PushTextWrapPos(card.inner.size().x);
    ImGui::TextUnformatted(card.text.data(), card.text.data() + card.text.size());
    ImGui::PopTextWrapPos();
    ImGui::EndChild();
}

}  // namespace

// Draws upwards from `bottom`; returns its top.
float Messages::card(Desk& desk, const Exploration::Message& message, float bottom, bool& closed) {
    const Theme& theme = desk.theme;
    const float s = theme.scale;
    const bool opened = opened_.contains(message.number);
    const Card place = cardOf(desk, message.text, bottom, opened);
    const Rect& at = place.at;
    ImGui::PushID(static_cast<int>(message.number));
    drawGround(theme, at, message.isError);
    drawText(theme, place);
    if (place.isLong) {
        const float top = at.max.y - 34 * s, left = place.inner.min.x;
        const Rect more{{left, top}, {left + 64 * s, top + 24 * s}};
        const Rect copy{{left + 72 * s, top}, {left + 136 * s, top + 24 * s}};
        if (textButton(theme, "more", more, opened ? "Less" : "More")) {
            if (opened)
                opened_.erase(message.number);
            else
                opened_.insert(message.number);
        }
        if (textButton(theme, "copy", copy, "Copy")) ImGui::SetClipboardText(message.text.c_str());
    }
    const Rect close{{at.max.x - 34 * s, at.min.y + 6 * s}, {at.max.x - 8 * s, at.min.y + 32 * s}};
    closed = iconButton(theme, "##close", close, Icon::Remove, "Close");
    ImGui::PopID();
    return at.min.y;
}

void Messages::draw(Desk& desk, float bottom, std::chrono::nanoseconds dt) {
    const std::vector<Exploration::Message> messages = desk.exploration.messages();
    const auto isGone = [&](std::uint64_t number) {
        return std::none_of(messages.begin(), messages.end(),
                            [&](const auto& m) { return m.number == number; });
    };
    std::erase_if(shownFor_, [&](const auto& entry) { return isGone(entry.first); });
    std::erase_if(opened_, isGone);
    const float s = desk.theme.scale;
    for (std::size_t i = messages.size(); i-- > 0;) {
        bool closed = false;
        bottom = card(desk, messages[i], bottom, closed) - 8 * s;
        if (!messages[i].isError) {
            auto& shown = shownFor_[messages[i].number];
            shown += dt;
            closed = closed || shown >= kStay;
        }
        if (closed) desk.exploration.forgetMessage(messages[i].number);
        if (bottom < desk.layout.picture.centre().y) break;  // the picture stays in sight
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
