#include "app/panels/header.h"

#include <fmt/format.h>

#include "app/panels/widgets.h"
#include "render/ticks.h"

namespace app::panels {
namespace {

std::string titleOf(const timeseries::Variable& v) {
    std::string out = v.name;
    if (!v.longName.empty() && v.longName != v.name) out += ", " + v.longName;
    if (const std::string unit = render::shownUnit(v.units); !unit.empty())
        out += " (" + unit + ")";
    return out;
}

void menu(Desk& desk, std::span<const Named> recent) {
    const auto item = [&](const char* label, const char* keys, Command command,
                          bool enabled = true) {
        if (ImGui::MenuItem(label, keys, false, enabled)) desk.requests.commands.push_back(command);
    };
    const bool open = desk.exploration.shown().has_value();
    item("Open…", "Ctrl+O", Command::Open);
    if (ImGui::BeginMenu("Recent", !recent.empty())) {
        for (const Named& named : recent)
            if (ImGui::MenuItem(shortName(named).c_str())) desk.requests.open = named;
        ImGui::EndMenu();
    }
    item("Save session…", "Ctrl+S", Command::Save, open);
    ImGui::Separator();
    item("Screenshot", "F12", Command::Screenshot, open);
    item("Export the animation…", "Ctrl+E", Command::Export, open);
    item("Copy as command line", "Ctrl+C", Command::CopyCommandLine, open);
    ImGui::Separator();
    item("Undo", "Ctrl+Z", Command::Undo, desk.exploration.canUndo());
    item("Redo", "Ctrl+Y", Command::Redo, desk.exploration.canRedo());
    ImGui::Separator();
    item("All keys", "H", Command::Help);
}

void variableChoice(Desk& desk, const Rect& at, const Shown& shown) {
    const float s = desk.theme.scale;
    const Pressing p = area("##variable", at);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(im(at.min), im(at.max), p.hovered ? kRaised : kField, 5 * s);
    text(desk.theme, {at.min.x + 10 * s, at.centre().y},
         fitting(*desk.theme.text, titleOf(shown.dataset.about), at.size().x - 36 * s));
    drawIcon(list, Icon::Down, {at.max.x - 14 * s, at.centre().y}, s, kDim);
    if (p.clicked) ImGui::OpenPopup("variables");
    ImGui::SetNextWindowPos({at.min.x, at.max.y + 4 * s});
    ImGui::SetNextWindowSizeConstraints({at.size().x, 0}, {at.size().x, 400 * s});
    if (!beginPopup("variables")) return;
    for (const timeseries::Variable& v : shown.dataset.variables) {
        const bool now = v.name == shown.dataset.about.name;
        if (ImGui::Selectable(titleOf(v).c_str(), now) && !now)
            edit(desk, {}, [&](Explorer& e) { e.variable = v.name; });
    }
    ImGui::EndPopup();
}

}  // namespace

void drawHeader(Desk& desk, const Rect& at, std::span<const Named> recent) {
    const float s = desk.theme.scale, left = at.min.x + kMargin * s, right = at.max.x - kMargin * s;
    const Rect button{{right - 28 * s, at.min.y + 12 * s}, {right, at.min.y + 40 * s}};
    const Shown shown = *desk.exploration.shown();
    const std::string name = std::filesystem::path(shown.dataset.name).filename().string();
    text(desk.theme, {left, button.centre().y},
         fitting(*desk.theme.strong, name, button.min.x - left - 8 * s), kText, 0,
         desk.theme.strong);
    if (iconButton(desk.theme, "##menu", button, Icon::Menu, "Menu")) ImGui::OpenPopup("menu");
    ImGui::SetNextWindowPos({right, button.max.y + 4 * s}, ImGuiCond_Always, {1, 0});
    if (beginPopup("menu")) {
        menu(desk, recent);
        ImGui::EndPopup();
    }
    variableChoice(desk, {{left, at.min.y + 48 * s}, {right, at.min.y + 78 * s}}, shown);
}

}  // namespace app::panels
