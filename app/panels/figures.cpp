#include "app/panels/figures.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/panels/counts_text.h"
#include "app/panels/widgets.h"
#include "app/picture/error_text.h"

namespace app::panels {
namespace {

constexpr const char* kApart = "  ·  ";

std::string bytesText(std::uint64_t bytes) {
    const double mb = static_cast<double>(bytes) / (1 << 20);
    return mb < 1024 ? fmt::format("{:.0f} MB", mb) : fmt::format("{:.1f} GB", mb / 1024);
}

double milliseconds(std::chrono::nanoseconds ns) {
    return std::chrono::duration<double, std::milli>(ns).count();
}

// What keeps the picture from being whole, or why it takes long, in a word.
std::string limitText(const Performance& p) {
    const CanvasReport& r = p.report;
    if (r.uploaded < 1) return fmt::format("sending to the GPU, {:.0f} %", 100 * r.uploaded);
    if (!r.whole && r.refined > 0) return fmt::format("refining, {:.0f} %", 100 * r.refined);
    if (!r.whole && r.stride > 1) return "a subset while it moves";
    if (!r.whole && r.across > 1) return "coarse pixels while it moves";
    if (r.lacksCells) return "points stand for cells";
    if (!r.whole) return "a subset while it moves";
    if (p.frame > p.budget) return "all of it drawn";
    return "";
}

std::string errorFigure(const Performance& p) {
    const RungError* const error = p.told();
    if (error == nullptr) return "";
    std::string depth = depthErrorText(error->depth, boundOf(*error, p.drawn()));
    if (p.isErrorOfAnother && !depth.empty())
        depth.insert(std::string_view("error").size(), " was");
    return depth.empty() ? "" : depth + lightErrorText(*error, p.errors->ordering);
}

// Where it begins; its middle.
glm::vec2 firstLine(const Layout& layout) {
    return layout.status.min + layout.scale * glm::vec2(kMargin, 13);
}

}  // namespace

std::vector<std::string> figuresOf(const Performance& p, const timeseries::Series* series) {
    if (series == nullptr || !p.report.counts) return {};
    const CanvasReport& r = p.report;
    const PointCounts& counts = *r.counts;
    std::vector<std::string> lines;
    const char* clipping = counts.inClipBox ? ", before clipping" : "";
    // Of splats and cells nobody knows which are in the box; where all are drawn, its points are.
    if (r.cells)
        lines.push_back(cellsText(*r.cells, r.besideCells) + clipping);
    else if (counts.inClipBox && r.whole)
        lines.push_back(withCommas(counts.selected) + " points drawn");
    else
        lines.push_back(drawnText({.splats = r.drawn,
                                   .allSplats = r.selected,
                                   .points = counts.inClipBox ? r.selected : counts.selected}) +
                        clipping);
    if (const std::string error = errorFigure(p); !error.empty()) lines.back() += kApart + error;
    lines.push_back(fmt::format(
        "{} selected{}  ·  {}{}", withCommas(counts.selected),
        counts.inClipBox ? " in the clip box" : "",
        counts.kept == counts.total ? std::string() : withCommas(counts.kept) + " kept  ·  ",
        withCommas(counts.total) + " in all"));
    std::string last =
        fmt::format("{:.1f} of {:.0f} ms  ·  {} memory  ·  {} GPU", milliseconds(p.frame),
                    milliseconds(p.budget), bytesText(series->bytes()), bytesText(r.gpuBytes));
    if (r.step < series->stepCount() && series->isStored(r.step))
        last += std::string(kApart) + "from the index";
    if (const std::string limit = limitText(p); !limit.empty()) last += kApart + limit;
    lines.push_back(last);
    return lines;
}

std::optional<Rect> errorPlace(const Theme& theme, const Layout& layout,
                               const Performance& performance, const timeseries::Series* series) {
    const std::string error = errorFigure(performance);
    const std::vector<std::string> lines = figuresOf(performance, series);
    if (error.empty() || lines.empty()) return std::nullopt;
    const std::string before = lines[0].substr(0, lines[0].size() - error.size());
    const float s = theme.scale, left = firstLine(layout).x + widthOf(*theme.small, before);
    const float right =
        std::min(left + widthOf(*theme.small, error), layout.status.max.x - kMargin * s);
    const float y = firstLine(layout).y;
    if (!(right - left > 16 * s)) return std::nullopt;  // no room is left for it
    return Rect{{left - 4 * s, y - 9 * s}, {right + 4 * s, y + 9 * s}};
}

std::vector<std::string> errorLines(const Performance& p) {
    std::vector<std::string> lines;
    if (p.errors && !p.errors->whyNone.empty())
        return {"Error of optical depth not known: " + p.errors->whyNone};
    if (!p.errors || p.errors->rungs.empty()) return lines;
    lines.emplace_back("Error of optical depth, against the field between its points:");
    for (const RungError& error : p.errors->rungs)
        lines.push_back(fmt::format("{}  {}{}", shareText(error.depth), rungText(error.rung),
                                    error.rung == p.drawn() ? ", as drawn" : ""));
    if (const RungError* const least = p.told();
        least != nullptr && boundOf(*least, p.drawn()) == Bound::Least)
        lines.push_back(fmt::format("{}  {}, as drawn", shareText(least->depth, Bound::Least),
                                    rungText(p.drawn())));
    return lines;
}

// Above the figures.
void drawErrorTip(const Theme& theme, const Rect& figures, const std::vector<std::string>& lines) {
    if (lines.empty()) return;
    const float s = theme.scale, line = 19 * s;
    float width = 0;
    for (const std::string& each : lines) width = std::max(width, widthOf(*theme.small, each));
    const glm::vec2 size(width + 22 * s, static_cast<float>(lines.size()) * line + 12 * s);
    const glm::vec2 corner(figures.min.x + kMargin * s, figures.min.y - size.y - 4 * s);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled(im(corner), im(corner + size), faded(kPanel, 0.97f), 5 * s);
    list.AddRect(im(corner), im(corner + size), kLine, 5 * s);
    glm::vec2 place = corner + glm::vec2(11 * s, 6 * s + 0.5f * line);
    for (const std::string& each : lines) {
        text(list, place, each, kDim, 0, *theme.small);
        place.y += line;
    }
}

// One below the other, or joined where there is room for fewer lines.
void drawFigures(const Theme& theme, const Layout& layout, const Performance& performance,
                 const timeseries::Series* series) {
    std::vector<std::string> lines = figuresOf(performance, series);
    if (lines.empty()) return;
    while (lines.size() > statusLines(layout)) {
        lines[0] += kApart + lines[1];
        lines.erase(lines.begin() + 1);
    }
    const float s = theme.scale;
    const Rect& at = layout.status;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled(im(at.min), im(at.max), kGround);
    glm::vec2 place = firstLine(layout);
    for (const std::string& line : lines) {
        const std::string shown = fitting(*theme.small, line, at.size().x - 2 * kMargin * s);
        text(list, place, shown, kDim, 0, *theme.small);
        place.y += 18 * s;
    }
    if (at.holds(vec(ImGui::GetIO().MousePos)) && !ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup))
        drawErrorTip(theme, at, errorLines(performance));
}

}  // namespace app::panels
