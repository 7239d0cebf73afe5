#include "app/panels/widgets.h"

#include <fmt/format.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "app/panels/field_text.h"

namespace app::panels {
namespace {

ImDrawList& list() { return *ImGui::GetWindowDrawList(); }

// Where keys take a fraction; true when that is elsewhere.
bool moved(const Focus::Turn& turn, double& fraction, double step) {
    const double to = turn.toEnd != 0 ? (turn.toEnd > 0 ? 1.0 : 0.0)
                                      : std::clamp(fraction + turn.by * step, 0.0, 1.0);
    if ((turn.toEnd == 0 && turn.by == 0) || to == fraction) return false;
    fraction = to;
    return true;
}

// Keeps the popup that begins next in the window: where it was asked to be, or as much higher as
// its height of the last frame wants, and no taller than there is room. ImGui does so only for
// popups that nobody has placed.
void keepInside(const char* id) {
    ImGuiNextWindowData& next = ImGui::GetCurrentContext()->NextWindowData;
    if ((next.Flags & ImGuiNextWindowDataFlags_HasPos) == 0) return;
    const ImVec2 room = ImGui::GetIO().DisplaySize;
    const float edge = 0.5f * ImGui::GetFontSize();
    const std::string name = fmt::format("##Popup_{:08x}", ImGui::GetID(id));
    if (const ImGuiWindow* window = ImGui::FindWindowByName(name.c_str())) {
        const float height = window->SizeFull.y;
        const float top = next.PosVal.y - next.PosPivotVal.y * height;
        const float inside = std::max(edge, std::min(top, room.y - edge - height));
        ImGui::SetNextWindowPos({next.PosVal.x, inside + next.PosPivotVal.y * height},
                                ImGuiCond_Always, next.PosPivotVal);
    }
    if ((next.Flags & ImGuiNextWindowDataFlags_HasSizeConstraint) == 0)
        ImGui::SetNextWindowSizeConstraints({0, 0}, {FLT_MAX, room.y - 2 * edge});
}

}  // namespace

void text(const Theme& theme, glm::vec2 at, std::string_view what, ImU32 color, float align,
          ImFont* font) {
    text(list(), at, what, color, align, *(font != nullptr ? font : theme.text));
}

void text(ImDrawList& target, glm::vec2 at, std::string_view what, ImU32 color, float align,
          ImFont& font) {
    const glm::vec2 size = sizeOf(font, what);
    const glm::vec2 corner = glm::round(at - glm::vec2(align * size.x, 0.5f * size.y));
    const Characters c(what);
    target.AddText(&font, font.FontSize, im(corner), color, c.begin, c.end);
}

Pressing area(const char* id, const Rect& at) {
    ImGui::SetCursorScreenPos(im(at.min));
    const glm::vec2 size = glm::max(at.size(), glm::vec2(1));
    Pressing out;
    out.clicked = ImGui::InvisibleButton(id, im(size));
    out.hovered = ImGui::IsItemHovered();
    out.pressed = ImGui::IsItemActivated();
    out.held = ImGui::IsItemActive();
    out.released = ImGui::IsItemDeactivated();
    out.doubled = out.hovered && ImGui::IsMouseDoubleClicked(0);
    return out;
}

Pressing button(const char* id, const Rect& at, bool isStop) {
    Pressing p = area(id, at);
    const ImGuiID own = ImGui::GetID(id);
    const Focus::Turn turn = focus().control(own, at, Focus::Takes::Nothing, isStop);
    if (p.pressed) focus().touch(own);
    p.clicked = p.clicked || turn.entered;
    p.focused = turn.has;
    return p;
}

bool iconButton(const Theme& theme, const char* id, const Rect& at, Icon icon, const char* what,
                bool lit) {
    const Pressing p = button(id, at);
    if (p.hovered || p.held)
        list().AddRectFilled(im(at.min), im(at.max), p.held ? kLine : kRaised, 5 * theme.scale);
    drawIcon(list(), icon, at.centre(), theme.scale, lit ? kAccent : p.hovered ? kText : kDim);
    if (what != nullptr && p.hovered)
        tip(theme, what);
    else if (what != nullptr && p.focused)
        tipBeside(theme, at, what);
    return p.clicked;
}

bool textButton(const Theme& theme, const char* id, const Rect& at, std::string_view label,
                bool lit) {
    const Pressing p = button(id, at);
    list().AddRectFilled(im(at.min), im(at.max), p.hovered ? kRaised : kField, 5 * theme.scale);
    text(theme, at.centre(), label, lit ? kAccent : kText, 0.5f);
    return p.clicked;
}

float segmentsWidth(const Theme& theme, std::span<const char* const> labels) {
    float most = 0;
    for (const char* label : labels) most = std::max(most, widthOf(*theme.small, label));
    return (most + 8 * theme.scale) * static_cast<float>(labels.size());
}

std::vector<Rect> segments(const Theme& theme, const Rect& at,
                           std::span<const char* const> labels) {
    const auto count = static_cast<float>(labels.size());
    std::vector<float> widths(labels.size(), at.size().x / count);
    if (segmentsWidth(theme, labels) > at.size().x) {
        float sum = 0;
        for (std::size_t i = 0; i < labels.size(); ++i)
            sum += widths[i] = widthOf(*theme.small, labels[i]);
        const float rest = (at.size().x - sum) / count;
        for (float& width : widths) width = rest > 0 ? width + rest : width * at.size().x / sum;
    }
    std::vector<Rect> cells;
    float left = at.min.x;
    for (const float width : widths) {
        cells.push_back({{std::round(left), at.min.y}, {std::round(left + width), at.max.y}});
        left += width;
    }
    return cells;
}

std::optional<std::size_t> segmented(const Theme& theme, const char* id, const Rect& at,
                                     std::span<const char* const> labels, std::size_t chosen) {
    std::optional<std::size_t> picked;
    const float s = theme.scale;
    const std::vector<Rect> cells = segments(theme, at, labels);
    list().AddRectFilled(im(at.min), im(at.max), kField, 5 * s);
    ImGui::PushID(id);
    const ImGuiID own = ImGui::GetID("##focus");
    if (const int by = focus().control(own, at, Focus::Takes::LeftRight).by; by != 0) {
        const std::size_t next = by > 0 ? std::min(chosen + 1, labels.size() - 1)
                                        : chosen - std::min<std::size_t>(chosen, 1);
        if (next != chosen) picked = next;
    }
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const Rect& cell = cells[i];
        const Pressing p = area(labels[i], cell);
        if (p.pressed) focus().touch(own);
        if (i == chosen)
            list().AddRectFilled(im(cell.min + glm::vec2(2 * s)), im(cell.max - glm::vec2(2 * s)),
                                 kRaised, 4 * s);
        text(theme, cell.centre(), fitting(*theme.small, labels[i], cell.size().x - 4 * s),
             i == chosen ? kAccent
             : p.hovered ? kText
                         : kDim,
             0.5f, theme.small);
        if (p.clicked && i != chosen) picked = i;
    }
    ImGui::PopID();
    return picked;
}

bool slider(const Theme& theme, const char* id, const Rect& at, double& fraction, double step) {
    const float s = theme.scale, radius = 5.5f * s, y = at.centre().y;
    const float left = at.min.x + radius, right = at.max.x - radius;
    const Pressing p = area(id, at);
    const ImGuiID own = ImGui::GetID(id);
    bool changed = moved(focus().control(own, at, Focus::Takes::LeftRight), fraction, step);
    if (p.pressed) focus().touch(own);
    if (p.held) {
        const double t = std::clamp(
            static_cast<double>((ImGui::GetIO().MousePos.x - left) / (right - left)), 0.0, 1.0);
        changed = t != fraction;
        fraction = t;
    }
    const float x = left + static_cast<float>(std::clamp(fraction, 0.0, 1.0)) * (right - left);
    list().AddRectFilled({left, y - 1.5f * s}, {right, y + 1.5f * s}, kRaised, 1.5f * s);
    list().AddRectFilled({left, y - 1.5f * s}, {x, y + 1.5f * s}, faded(kAccent, 0.75f), 1.5f * s);
    list().AddCircleFilled({x, y}, radius, p.hovered || p.held ? kText : rgb(0xb6c0cc), 20);
    return changed;
}

bool rangeSlider(const Theme& theme, const char* id, const Rect& at, double& lo, double& hi) {
    const float s = theme.scale, radius = 5.5f * s, y = at.centre().y;
    const float left = at.min.x + radius, right = at.max.x - radius;
    const Pressing p = area(id, at);
    const auto place = [&](double t) {
        return left + static_cast<float>(std::clamp(t, 0.0, 1.0)) * (right - left);
    };
    const double mouse = std::clamp(
        static_cast<double>((ImGui::GetIO().MousePos.x - left) / (right - left)), 0.0, 1.0);
    ImGuiStorage& storage = *ImGui::GetStateStorage();
    const ImGuiID key = ImGui::GetID(id);
    if (p.pressed) {
        const bool isHi = std::abs(mouse - hi) < std::abs(mouse - lo) || mouse > hi;
        storage.SetBool(key, isHi);
        ImGui::PushID(id);
        focus().touch(ImGui::GetID(isHi ? "##hi" : "##lo"));
        ImGui::PopID();
    }
    bool changed = false;
    if (p.held) {
        if (lo == hi && mouse != lo) storage.SetBool(key, mouse > hi);  // whichever can go there
        double& end = storage.GetBool(key) ? hi : lo;
        const double t = storage.GetBool(key) ? std::max(mouse, lo) : std::min(mouse, hi);
        changed = t != end;
        end = t;
    }
    ImGui::PushID(id);
    for (double* end : {&lo, &hi}) {
        const float x = place(*end);
        const ImGuiID own = ImGui::GetID(end == &lo ? "##lo" : "##hi");
        const Focus::Turn turn = focus().control(
            own, {{x - radius, y - radius}, {x + radius, y + radius}}, Focus::Takes::LeftRight);
        double to = *end;
        if (!moved(turn, to, 0.02)) continue;
        *end = end == &lo ? std::min(to, hi) : std::max(to, lo);
        changed = true;
    }
    ImGui::PopID();
    list().AddRectFilled({left, y - 1.5f * s}, {right, y + 1.5f * s}, kRaised, 1.5f * s);
    list().AddRectFilled({place(lo), y - 1.5f * s}, {place(hi), y + 1.5f * s},
                         faded(kAccent, 0.75f));
    for (const double t : {lo, hi})
        list().AddCircleFilled({place(t), y}, radius, p.hovered ? kText : rgb(0xb6c0cc), 20);
    return changed;
}

bool takesText(const char* id, const Rect& at) {
    const Focus::Turn turn = focus().control(ImGui::GetID(id), at, Focus::Takes::Typing);
    return turn.came || turn.entered;
}

bool inputText(const char* id, const char* hint, std::string& text) {
    std::string held = fieldText(text);
    const bool entered = ImGui::InputTextWithHint(
        id, hint, &held, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    text = meantText(held);
    return entered;
}

std::optional<std::string> TextField::draw(const Theme& theme, const char* id, const Rect& at,
                                           std::string_view shown, const char* hint) {
    const bool isLeft = !active_ && focus().place() == ImGui::GetID(id) &&
                        ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    if (shown != shown_ || isLeft) why_.clear();
    shown_ = shown;
    if (!active_ && why_.empty()) typed_ = shown;
    ImGui::SetCursorScreenPos(im(at.min));
    ImGui::SetNextItemWidth(at.size().x);
    const float pad = 0.5f * (at.size().y - theme.text->FontSize);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {kPad * theme.scale, std::max(0.0f, pad)});
    if (std::exchange(retakes_, false)) ImGui::SetKeyboardFocusHere();
    if (takesText(id, at)) ImGui::SetKeyboardFocusHere();
    const bool entered = inputText(id, hint, typed_);
    ImGui::PopStyleVar();
    if (ImGui::IsItemActivated()) focus().touch(ImGui::GetID(id));
    active_ = ImGui::IsItemActive();
    entered_ = entered;
    if (typed_ != refused_) why_.clear();
    list().AddRect(im(at.min), im(at.max),
                   !why_.empty() ? kError
                   : active_     ? kAccent
                                 : kEdge,
                   4 * theme.scale, 0, theme.scale);
    if (!why_.empty() && ImGui::IsItemVisible()) drawRefusal(theme, at);
    if (!ImGui::IsItemDeactivated() && !entered) return std::nullopt;
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) {
        why_.clear();
        return std::nullopt;
    }
    if (typed_ == shown) return std::nullopt;
    return typed_;
}

void TextField::refuse(std::string why) {
    why_ = std::move(why);
    refused_ = typed_;
    retakes_ = entered_;
    if (entered_) focus().expectText();
}

// Over what lies below, or above where the window ends.
void TextField::drawRefusal(const Theme& theme, const Rect& at) const {
    ImFont& font = *theme.small;
    const float s = theme.scale, pad = 7 * s, gap = 3 * s;
    const glm::vec2 window = vec(ImGui::GetIO().DisplaySize);
    const float width = std::min(std::max(at.size().x, 300 * s), window.x - 2 * pad);
    const char *begin = why_.data(), *end = begin + why_.size();
    const glm::vec2 size =
        vec(font.CalcTextSizeA(font.FontSize, FLT_MAX, width - 2 * pad, begin, end)) + 2 * pad;
    const bool isBelow = at.max.y + gap + size.y <= window.y;
    const glm::vec2 from(std::clamp(at.min.x, 0.0f, std::max(0.0f, window.x - size.x)),
                         isBelow ? at.max.y + gap : at.min.y - gap - size.y);
    ImDrawList& front = *ImGui::GetForegroundDrawList();
    front.AddRectFilled(im(from), im(from + size), kPopup, 4 * s);
    front.AddRect(im(from), im(from + size), kError, 4 * s, 0, s);
    front.AddText(&font, font.FontSize, im(from + pad), kText, begin, end, width - 2 * pad);
}

bool beginPopup(const char* id) {
    // The regions' own windows have no padding.
    const float unit = ImGui::GetFontSize();
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.75f * unit, 0.65f * unit});
    keepInside(id);
    const bool open = ImGui::BeginPopup(id);
    ImGui::PopStyleVar();
    if (!open) return false;
    focus().enterFront();
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) ImGui::CloseCurrentPopup();
    return true;
}

void endPopup() {
    focus().leaveFront();
    ImGui::EndPopup();
}

void tipBeside(const Theme& theme, const Rect& at, std::string_view what) {
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const bool right = at.centre().x > 0.5f * window.x, low = at.centre().y > 0.5f * window.y;
    const float gap = 6 * theme.scale;
    ImGui::SetNextWindowPos({right ? at.max.x : at.min.x, low ? at.min.y - gap : at.max.y + gap},
                            ImGuiCond_Always, {right ? 1.0f : 0.0f, low ? 1.0f : 0.0f});
    tip(theme, what);
}

void tip(const Theme& theme, std::string_view what) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {9 * theme.scale, 6 * theme.scale});
    ImGui::PushFont(theme.small);
    ImGui::BeginTooltip();
    const Characters c(what);
    ImGui::TextUnformatted(c.begin, c.end);
    ImGui::EndTooltip();
    ImGui::PopFont();
    ImGui::PopStyleVar();
}

void hairline(float x0, float x1, float y) {
    list().AddLine({x0, std::floor(y) + 0.5f}, {x1, std::floor(y) + 0.5f}, kLine);
}

void hatch(ImDrawList& target, const Rect& at, float scale, ImU32 color) {
    const glm::vec2 size = at.size();
    if (size.x <= 0 || size.y <= 0) return;
    target.PushClipRect(im(at.min), im(at.max), true);
    for (float x = std::fmod(at.min.x, 6 * scale) * -1 - size.y; x < size.x; x += 6 * scale)
        target.AddLine({at.min.x + x, at.max.y}, {at.min.x + x + size.y, at.min.y}, color);
    target.PopClipRect();
}

}  // namespace app::panels
