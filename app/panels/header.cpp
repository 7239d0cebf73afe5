#include "app/panels/header.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/panels/widgets.h"
#include "render/annotate/ticks.h"

namespace app::panels {
namespace {

std::string titleOf(const timeseries::Variable& v) {
    std::string out = v.name;
    if (!v.longName.empty() && v.longName != v.name) out += ", " + v.longName;
    if (const std::string unit = render::shownUnit(v.units); !unit.empty())
        out += " (" + unit + ")";
    return out;
}

// Of what does not fit the name alone, which tells variables apart.
std::string titleIn(const Theme& theme, const timeseries::Variable& v, float width) {
    const std::string all = titleOf(v);
    return widthOf(*theme.text, all) <= width ? all : fitting(*theme.text, v.name, width);
}

// A line of a popup; closes it when it is pressed.
bool popupRow(const Theme& theme, std::string_view label, float width, std::string_view keys = {},
              bool enabled = true, bool now = false) {
    const float s = theme.scale;
    const glm::vec2 from = vec(ImGui::GetCursorScreenPos());
    const Rect at{from, from + glm::vec2(width, 28 * s)};
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    const std::string id(label);
    if (now) focus().beginAt(ImGui::GetID(id.c_str()));
    const Pressing p = enabled ? button(id.c_str(), at) : Pressing{};
    ImGui::SetCursorScreenPos(im(from));
    ImGui::Dummy(im(at.size()));
    ImGui::PopStyleVar();
    if (p.hovered || p.focused || now)
        ImGui::GetWindowDrawList()->AddRectFilled(
            im(at.min), im(at.max), p.hovered || p.focused ? kRaised : faded(kAccent, 0.16f),
            4 * s);
    text(theme, {at.min.x + 8 * s, at.centre().y},
         fitting(*theme.text, label, width - 24 * s - widthOf(*theme.small, keys)),
         enabled ? kText : kFaint);
    text(theme, {at.max.x - 8 * s, at.centre().y}, keys, kFaint, 1, theme.small);
    if (p.clicked) ImGui::CloseCurrentPopup();
    return p.clicked;
}

void menu(PanelContext& context, std::span<const Named> recent) {
    constexpr std::size_t kRecent = 5;
    const float width = 240 * context.theme.scale;
    const auto item = [&](const char* label, const char* keys, Command command,
                          bool enabled = true) {
        if (popupRow(context.theme, label, width, keys, enabled))
            context.requests.commands.push_back(command);
    };
    const auto separator = [] {
        ImGui::Spacing();
        ImGui::Separator();
    };
    const bool open = context.exploration.shown().has_value();
    item("Open…", "Ctrl+O", Command::Open);
    item("Save session…", "Ctrl+S", Command::Save, open);
    separator();
    item("Screenshot", "F12", Command::Screenshot, open);
    item("Export the animation…", "Ctrl+E", Command::Export, open);
    item("Copy as command line", "Ctrl+C", Command::CopyCommandLine, open);
    separator();
    item("Undo", "Ctrl+Z", Command::Undo, context.exploration.canUndo());
    item("Redo", "Ctrl+Y", Command::Redo, context.exploration.canRedo());
    separator();
    if (!context.inHeadset) item("Into the headset", "Ctrl+H", Command::Headset);
    item("All keys", "H", Command::Help);
    if (recent.empty()) return;
    separator();
    const auto offered = recent.first(std::min(kRecent, recent.size()));
    const std::vector<std::string> notes = recentNotes(offered);
    for (std::size_t i = 0; i < offered.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        if (popupRow(context.theme, shortName(offered[i]), width,
                     fitting(*context.theme.small, notes[i], 0.6f * width)))
            context.requests.open = offered[i];
        ImGui::PopID();
    }
}

void variableChoice(PanelContext& context, const Rect& at, const Shown& shown) {
    const float s = context.theme.scale;
    const Pressing p = button("##variable", at);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(im(at.min), im(at.max), p.hovered ? kRaised : kField, 5 * s);
    text(context.theme, {at.min.x + 10 * s, at.centre().y},
         titleIn(context.theme, shown.dataset.variable, at.size().x - 36 * s));
    drawIcon(list, Icon::Down, {at.max.x - 14 * s, at.centre().y}, s, kDim);
    if (p.clicked) ImGui::OpenPopup("variables");
    ImGui::SetNextWindowPos({at.min.x, at.max.y + 4 * s});
    ImGui::SetNextWindowSizeConstraints({at.size().x, 0}, {at.size().x, 400 * s});
    if (!beginPopup("variables")) return;
    for (const timeseries::Variable& v : shown.dataset.variables) {
        const bool now = v.name == shown.dataset.variable.name;
        ImGui::PushID(v.name.c_str());
        const float width = at.size().x - 24 * s;
        if (popupRow(context.theme, titleIn(context.theme, v, width), width, {}, true, now) && !now)
            edit(context, {}, [&](Explorer& e) { e.variable = v.name; });
        ImGui::PopID();
    }
    endPopup();
}

}  // namespace

std::vector<std::string> recentNotes(std::span<const Named> recent) {
    std::vector<std::string> notes;
    for (const Named& named : recent) {
        const auto same = std::ranges::count_if(
            recent, [&](const Named& other) { return shortName(other) == shortName(named); });
        notes.push_back(same > 1 ? named.front().parent_path().string() : "recent");
    }
    return notes;
}

void drawHeader(PanelContext& context, const Rect& at, std::span<const Named> recent) {
    const float s = context.theme.scale, left = at.min.x + kMargin * s,
                right = at.max.x - kMargin * s;
    const Rect button{{right - 28 * s, at.min.y + 12 * s}, {right, at.min.y + 40 * s}};
    const Shown shown = *context.exploration.shown();
    const std::string name = std::filesystem::path(shown.dataset.name).filename().string();
    text(context.theme, {left, button.centre().y},
         fitting(*context.theme.strong, name, button.min.x - left - 8 * s), kText, 0,
         context.theme.strong);
    if (iconButton(context.theme, "##menu", button, Icon::Menu, "Menu")) ImGui::OpenPopup("menu");
    ImGui::SetNextWindowPos({right, button.max.y + 4 * s}, ImGuiCond_Always, {1, 0});
    if (beginPopup("menu")) {
        menu(context, recent);
        endPopup();
    }
    variableChoice(context, {{left, at.min.y + 48 * s}, {right, at.min.y + 78 * s}}, shown);
}

}  // namespace app::panels
