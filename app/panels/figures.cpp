#include "app/panels/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
    if (!r.whole && r.refined > 0)  // not all before it is
        return fmt::format("refining, {:.0f} %", std::floor(99.99 * r.refined));
    if (!r.whole && r.stride > 1) return "a subset while it moves";
    if (!r.whole && r.across > 1) return "coarse pixels while it moves";
    if (r.lacksCells) return "points stand for cells";
    if (r.lacksGradients) return "smoothing the light";
    if (!r.whole) return "a subset while it moves";
    if (p.frame > p.budget) return "all of it drawn";
    return "";
}

std::string errorFigure(const Performance& p) {
    const RungError* const error = p.told();
    if (error == nullptr) return unknownErrorText(p.errors, p.drawn());
    if (std::isnan(error->depth) && !p.isErrorOfAnother) return nothingSeenText(p.drawn().model);
    std::string depth = depthErrorText(error->depth, boundOf(*error, p.drawn()));
    if (p.isErrorOfAnother && !depth.empty())
        depth.insert(std::string_view("error").size(), " was");
    return depth.empty() ? "" : depth + lightErrorText(*error, p.errors->ordering);
}

// Where a line begins; its middle.
glm::vec2 beginOf(const Layout& layout, std::size_t line) {
    return layout.status.min +
           layout.scale * glm::vec2(kMargin, 13.0f + 18.0f * static_cast<float>(line));
}

// Without the last figures, which there is no room for: one that is cut would read as another.
std::string leftIn(ImFont& font, std::string figures, float width) {
    while (!figures.empty() && widthOf(font, figures) > width) {
        const std::size_t last = figures.rfind(kApart);
        figures.resize(last == std::string::npos ? 0 : last);
    }
    return figures;
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
    if (std::string error = errorFigure(p); !error.empty()) lines.push_back(std::move(error));
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

// One below the other, or the first ones joined where there is room for fewer lines. What there is
// no room for beside the error is left out.
ShownFigures shownFigures(const Theme& theme, const Layout& layout, const Performance& p,
                          const timeseries::Series* series) {
    ShownFigures shown;
    std::vector<std::string>& lines = shown.lines = figuresOf(p, series);
    if (lines.empty()) return shown;
    ImFont& font = *theme.small;
    const float width = layout.status.size().x - 2 * kMargin * theme.scale;
    std::string before, error = errorFigure(p);
    std::size_t at = 1;
    while (lines.size() > statusLines(layout)) {
        if (at == 1) before = lines[0] + kApart;
        at = 0;
        lines[0] += kApart + lines[1];
        lines.erase(lines.begin() + 1);
    }
    for (std::size_t i = 0; i < lines.size(); ++i)
        if (error.empty() || i != at) lines[i] = fitting(font, lines[i], width);
    if (error.empty()) return shown;
    std::string after = lines[at].substr(before.size() + error.size());
    // Then how many there are, and last why light has an error.
    if (widthOf(font, before + error) > width) before.clear();
    if (widthOf(font, error) > width) error.resize(std::min(error.size(), error.find(" (")));
    error = fitting(font, error, width);
    after = leftIn(font, after, width - widthOf(font, before + error));
    lines[at] = before + error + after;
    const float s = theme.scale, left = beginOf(layout, at).x + widthOf(font, before);
    const float y = beginOf(layout, at).y;
    shown.error = Rect{{left - 4 * s, y - 9 * s}, {left + widthOf(font, error) + 4 * s, y + 9 * s}};
    return shown;
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

void drawFigures(const Theme& theme, const Layout& layout, const Performance& performance,
                 const timeseries::Series* series) {
    const std::vector<std::string> lines = shownFigures(theme, layout, performance, series).lines;
    if (lines.empty()) return;
    const Rect& at = layout.status;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled(im(at.min), im(at.max), kGround);
    for (std::size_t i = 0; i < lines.size(); ++i)
        text(list, beginOf(layout, i), lines[i], kDim, 0, *theme.small);
    if (at.holds(vec(ImGui::GetIO().MousePos)) && !ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup))
        drawErrorTip(theme, at, errorLines(performance));
}

}  // namespace app::panels
