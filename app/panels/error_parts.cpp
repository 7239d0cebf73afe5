#include "app/panels/error_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/panels/figures.h"
#include "app/panels/widgets.h"
#include "app/picture/error_text.h"

namespace app::panels {
namespace {

constexpr const char* kOpened = "errorParts";
constexpr float kRow = 21, kTitle = 26;  // heights
constexpr const char* kHead = "Where the error comes from";
constexpr const char* kFoot = "Parts may cancel: the whole is at most the sum of the first three.";

void drawTable(PanelContext& context, const std::vector<ErrorLine>& lines) {
    const Theme& theme = context.theme;
    const float s = theme.scale;
    float names = 0, sizes = 0, whats = widthOf(*theme.small, kFoot);
    for (const ErrorLine& line : lines) {
        names = std::max(names, widthOf(*theme.small, line.name));
        sizes = std::max(sizes, widthOf(*theme.text, line.size));
    }
    const float gap = 16 * s, column = names + gap + sizes + gap;
    for (const ErrorLine& line : lines)
        whats = std::max(whats, column + widthOf(*theme.small, line.what));
    const glm::vec2 corner = vec(ImGui::GetCursorScreenPos());
    const float height = (kTitle + kRow * static_cast<float>(lines.size() + 1)) * s;
    ImGui::Dummy({whats, height});
    glm::vec2 at = corner + glm::vec2(0, 0.5f * kTitle * s - 3 * s);
    text(theme, at, kHead, kText, 0, theme.strong);
    const glm::vec2 close(corner.x + whats - 22 * s, at.y - 11 * s);
    if (iconButton(theme, "##close", {close, close + glm::vec2(22 * s)}, Icon::Remove, "Close"))
        ImGui::CloseCurrentPopup();
    at.y = corner.y + (kTitle + 0.5f * kRow) * s;
    for (const ErrorLine& line : lines) {
        text(theme, at, line.name, kDim, 0, theme.small);
        text(theme, at + glm::vec2(names + gap + sizes, 0), line.size, kText, 1);
        text(theme, at + glm::vec2(column, 0), line.what, kDim, 0, theme.small);
        at.y += kRow * s;
    }
    text(theme, at, kFoot, kFaint, 0, theme.small);
}

}  // namespace

std::vector<ErrorLine> errorPartLines(const Performance& p) {
    const RungError* const error = p.told();
    if (error == nullptr && p.errors && !p.errors->whyNone.empty())
        return {{"", "", "This picture's error is not known: " + p.errors->whyNone + "."}};
    if (error == nullptr) return {{"", "", "This picture's error is not known yet."}};
    if (std::isnan(error->depth))
        return {{"", "", nothingSeenText(p.drawn().model) + ": there is no error"}};
    std::vector<ErrorLine> lines{
        {"whole", shareText(error->depth, boundOf(*error, p.drawn())),
         fmt::format("of optical depth, against the field between points{}",
                     p.isErrorOfAnother ? ", of the picture before" : "")}};
    if (error->parts) {
        for (PartLine& part : partLines(*error, p.errors->ordering, p.drawn()))
            lines.push_back({part.name, part.size, part.what});
    } else {
        for (const char* name : {"model", "subset", "pixels", "order"})
            lines.push_back(
                {name, "…",
                 p.isErrorOfAnother ? "known once the picture rests" : "being worked out"});
    }
    return lines;
}

void drawErrorParts(PanelContext& context) {
    const Theme& theme = context.theme;
    const Rect& status = context.layout.status;
    const float s = theme.scale;
    const auto place =
        shownFigures(theme, context.layout, context.performance, context.exploration.series())
            .error;
    beginRegion("##figures", status, kClear);
    if (place) {
        const Pressing p = button("##error", *place);
        if (p.hovered || p.focused) {
            ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
            ImGui::GetWindowDrawList()->AddLine({place->min.x + 4 * s, place->max.y - 2 * s},
                                                {place->max.x - 4 * s, place->max.y - 2 * s}, kDim);
        }
        if (p.clicked) ImGui::OpenPopup(kOpened);
    }
    const float left = place ? place->min.x : status.min.x + kMargin * s;
    ImGui::SetNextWindowPos({left, status.min.y - 4 * s}, ImGuiCond_Always, {0, 1});
    if (beginPopup(kOpened)) {
        context.requests.errorParts = true;
        drawTable(context, errorPartLines(context.performance));
        endPopup();
    }
    endRegion();
}

}  // namespace app::panels
