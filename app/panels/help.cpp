#include "app/panels/help.h"

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/panels/widgets.h"

namespace app::panels {

namespace {

constexpr float kKeysLeft = 100, kRightEdge = 20, kBetween = 10;  // in units of the design
constexpr float kDoesLeft = 0.47f;                                // of the card's width

// In this font at another size; its vertical middle at y.
void write(ImFont& font, float size, glm::vec2 at, std::string_view what, ImU32 color) {
    const Characters c(what);
    ImGui::GetWindowDrawList()->AddText(&font, size, im(glm::round(at - glm::vec2(0, 0.5f * size))),
                                        color, c.begin, c.end);
}

std::vector<std::string> linesIn(ImFont& font, std::string_view what, float room) {
    const std::string broken = inLines(font, what, room);
    std::vector<std::string> lines{""};
    for (const char c : broken)
        if (c == '\n')
            lines.emplace_back();
        else
            lines.back() += c;
    return lines;
}

// Both columns of a line, each in as many lines as its room makes of it.
struct Row {
    std::string_view group;
    std::vector<std::string> keys, does;
    std::size_t more() const { return std::max(keys.size(), does.size()) - 1; }
};

// `width`: the card's, in pixels of a font that is `smaller` than its own size.
std::vector<Row> rowsIn(const Theme& theme, float width, float smaller) {
    const float s = theme.scale * smaller;
    const float keys = kDoesLeft * width - (kKeysLeft + kBetween) * s,
                does = (1 - kDoesLeft) * width - kRightEdge * s;
    std::vector<Row> rows;
    for (const HelpLine& help : helpLines())
        rows.push_back({help.group, linesIn(*theme.text, help.keys, keys / smaller),
                        linesIn(*theme.text, help.does, does / smaller)});
    return rows;
}

// From the card's upper left corner, as far as it is scrolled.
void drawRows(const Theme& theme, std::span<const Row> rows, glm::vec2 corner, float width,
              float s) {
    const float size = theme.text->FontSize * s / theme.scale;
    float y = corner.y + 18 * s;
    std::string_view last;
    for (const Row& row : rows) {
        if (row.group != last) {
            y += kHelpGroup * s;
            write(*theme.strong, size, {corner.x + 24 * s, y}, row.group, kAccent);
            last = row.group;
        }
        const auto column = [&](const std::vector<std::string>& lines, float x, ImU32 color) {
            for (std::size_t i = 0; i < lines.size(); ++i)
                write(*theme.text, size, {x, y + static_cast<float>(i) * kHelpMore * s}, lines[i],
                      color);
        };
        column(row.keys, corner.x + kKeysLeft * s, kText);
        column(row.does, corner.x + kDoesLeft * width, kDim);
        y += (kHelpLine + static_cast<float>(row.more()) * kHelpMore) * s;
    }
}

}  // namespace

bool Help::take(const KeyPress& key) {
    if (!isOpen_ || !scrolls_ || (key.key != Key::Up && key.key != Key::Down)) return false;
    moved_ += key.key == Key::Down ? 3.0f : -3.0f;
    return true;
}

void Help::draw(const PanelContext& context) {
    if (!isOpen_) return;
    const Theme& theme = context.theme;
    const Rect& picture = context.layout.picture;
    std::size_t groups = 0, more = 0;
    std::string_view last;
    for (const HelpLine& help : helpLines()) {
        groups += help.group != last ? 1 : 0;
        last = help.group;
    }
    // What is narrow takes more lines, for which it may be smaller.
    const HelpLayout wide = helpLayout(picture, theme.scale, helpLines().size(), groups);
    const auto rows = rowsIn(theme, wide.whole.size().x - ImGui::GetStyle().ScrollbarSize,
                             wide.scale / theme.scale);
    for (const Row& row : rows) more += row.more();
    const auto [at, s, height] = helpLayout(picture, theme.scale, helpLines().size(), groups, more);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(im(picture.min), im(picture.max), faded(kGround, 0.6f));
    list.AddRectFilled(im(at.min), im(at.max), faded(kPanel, 0.98f), 8 * s);
    list.AddRect(im(at.min), im(at.max), kLine, 8 * s);
    ImGui::SetCursorScreenPos(im(at.min));
    ImGui::BeginChild("##help", im(at.size()));
    scrolls_ = height > at.size().y + 1;
    if (moved_ != 0)
        ImGui::SetScrollY(ImGui::GetScrollY() + std::exchange(moved_, 0.0f) * kHelpLine * s);
    const glm::vec2 top = vec(ImGui::GetCursorScreenPos());
    drawRows(theme, rows, {at.min.x, top.y}, at.size().x, s);
    ImGui::SetCursorScreenPos(im(top));
    ImGui::Dummy({1, height});
    ImGui::EndChild();
}

}  // namespace app::panels
