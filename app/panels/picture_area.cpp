#include "app/panels/picture_area.h"

#include <fmt/format.h>

#include <cmath>

#include "app/choices/view_edits.h"
#include "app/panels/counts_text.h"
#include "app/panels/widgets.h"

namespace app::panels {
namespace {

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
    if (r.lacksCells) return "points stand for cells";
    if (!r.whole) return "a subset while it moves";
    if (p.frame > p.budget) return "all of it drawn";
    return "";
}

// A step may be in memory and not yet on the GPU.
std::string waitingText(const PanelContext& context) {
    std::string waiting = context.exploration.waiting();
    const auto shown = context.exploration.shown();
    if (waiting.empty() && shown && context.performance.report.uploaded < 1 &&
        context.performance.report.step != shown->step)
        waiting = fmt::format("requested step {}, showing {}", shown->step,
                              context.performance.report.step);
    return waiting;
}

// A rounded label, from `top` on; `align` as of text(). Returns where it is.
Rect pill(const PanelContext& context, glm::vec2 top, float align, std::string_view what,
          float room = 0) {
    const float s = context.theme.scale, width = widthOf(*context.theme.text, what) + 28 * s + room;
    const float left = top.x - align * width;
    const Rect at{{left, top.y}, {left + width, top.y + 32 * s}};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(im(at.min), im(at.max), faded(kField, 0.95f), 16 * s);
    list.AddRect(im(at.min), im(at.max), kLine, 16 * s);
    text(context.theme, {at.min.x + 14 * s, at.centre().y}, what);
    return at;
}

// The same with a button; returns whether that was pressed.
bool cancelPill(const PanelContext& context, glm::vec2 top, float align, std::string_view what,
                const char* id) {
    const float s = context.theme.scale;
    const Rect at = pill(context, top, align, what, 84 * s);
    return textButton(context.theme, id,
                      {{at.max.x - 78 * s, at.min.y + 4 * s}, {at.max.x - 6 * s, at.max.y - 4 * s}},
                      "Cancel");
}

}  // namespace

void PictureArea::handle(PanelContext& context, const render::Outline& outline) {
    Exploration& exploration = context.exploration;
    const Rect& at = context.layout.picture;
    const ImGuiIO& io = ImGui::GetIO();
    ImGui::SetCursorScreenPos(im(at.min));
    ImGui::InvisibleButton("##picture", im(glm::max(at.size(), glm::vec2(1))),
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle);
    pointer_.reset();
    const Looking looking{outline, exploration.explorer().size};
    // With two eyes, of the one that it is over.
    const glm::dvec2 place = vec(io.MousePos) - at.min;
    const glm::dvec2 cursor = glm::mod(place, glm::dvec2(looking.size));
    if (ImGui::IsItemActivated())
        grip_ =
            io.KeyShift || ImGui::IsMouseDown(ImGuiMouseButton_Middle) ? Grip::Move : Grip::Turn;
    if (ImGui::IsItemActive() && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0)) {
        const glm::dvec2 by(static_cast<double>(io.MouseDelta.x),
                            static_cast<double>(io.MouseDelta.y));
        edit(context, "camera", [&](Explorer& e) {
            e.view =
                grip_ == Grip::Turn ? orbited(e.view, by, looking) : panned(e.view, by, looking);
        });
    }
    if (!ImGui::IsItemHovered()) return;
    if (!ImGui::IsItemActive()) pointer_ = place;
    if (io.MouseWheel != 0)
        edit(context, "zoom", [&](Explorer& e) {
            e.view =
                zoomed(e.view, std::pow(0.88, static_cast<double>(io.MouseWheel)), cursor, looking);
        });
    if (ImGui::IsMouseDoubleClicked(0)) {
        context.requests.probe = glm::vec2(place);
        context.requests.ruler = io.KeyShift;
        context.choices.page = Page::Probe;
    }
}

void drawPictureOverlay(PanelContext& context, float top,
                        const std::optional<std::string>& exporting) {
    Exploration& exploration = context.exploration;
    const Rect& picture = context.layout.picture;
    const float s = context.theme.scale, middle = picture.centre().x;
    float y = top;
    if (const auto opening = exploration.opening()) {
        const std::string what =
            fitting(*context.theme.text, "Opening " + *opening, picture.size().x - 140 * s);
        if (cancelPill(context, {middle, y}, 0.5f, what, "##opening")) exploration.cancelOpening();
        y += 40 * s;
    }
    if (const std::string waiting = waitingText(context); !waiting.empty())
        pill(context, {middle, y}, 0.5f, waiting);
    if (exporting) {
        // For as long as it takes: not at the top, where the legend is.
        const Rect place = exportPlace(picture, s);
        const std::string what = fitting(*context.theme.text, *exporting, place.size().x - 112 * s);
        if (cancelPill(context, {place.max.x, place.min.y}, 1, what, "##exporting"))
            context.requests.cancelExport = true;
    }
}

std::vector<std::string> figuresOf(const Performance& p, const timeseries::Series* series) {
    if (series == nullptr || !p.report.counts) return {};
    const CanvasReport& r = p.report;
    const PointCounts& counts = *r.counts;
    std::vector<std::string> lines;
    const char* clipping = counts.inClipBox ? ", before clipping" : "";
    // Of splats and cells nobody knows which are in the box; where all are drawn, its points are.
    if (r.cells)
        lines.push_back(cellsText(*r.cells) + clipping);
    else if (counts.inClipBox && r.whole)
        lines.push_back(withCommas(counts.selected) + " points drawn");
    else
        lines.push_back(drawnText({.splats = r.drawn,
                                   .allSplats = r.selected,
                                   .points = counts.inClipBox ? r.selected : counts.selected}) +
                        clipping);
    if (const std::string error = depthErrorText(p.error()); !error.empty())
        lines.back() += "  ·  " + error;
    lines.push_back(fmt::format(
        "{} selected{}  ·  {}{}", withCommas(counts.selected),
        counts.inClipBox ? " in the clip box" : "",
        counts.kept == counts.total ? std::string() : withCommas(counts.kept) + " kept  ·  ",
        withCommas(counts.total) + " in all"));
    std::string last =
        fmt::format("{:.1f} of {:.0f} ms  ·  {} memory  ·  {} GPU", milliseconds(p.frame),
                    milliseconds(p.budget), bytesText(series->bytes()), bytesText(r.gpuBytes));
    if (r.step < series->stepCount() && series->isStored(r.step)) last += "  ·  from the index";
    if (const std::string limit = limitText(p); !limit.empty()) last += "  ·  " + limit;
    lines.push_back(last);
    return lines;
}

std::vector<std::string> errorLines(const Performance& p) {
    std::vector<std::string> lines;
    if (!p.errors || p.errors->rungs.empty()) return lines;
    lines.emplace_back("Error of optical depth, against the field between its points:");
    for (const auto& [rung, error] : p.errors->rungs)
        lines.push_back(fmt::format("{}  {}{}", shareText(error), rungText(rung),
                                    rung == p.drawn() ? ", as drawn" : ""));
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
        lines[0] += "  ·  " + lines[1];
        lines.erase(lines.begin() + 1);
    }
    const float s = theme.scale;
    const Rect& at = layout.status;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled(im(at.min), im(at.max), kGround);
    glm::vec2 place(at.min.x + kMargin * s, at.min.y + 13 * s);
    for (const std::string& line : lines) {
        const std::string shown = fitting(*theme.small, line, at.size().x - 2 * kMargin * s);
        text(list, place, shown, kDim, 0, *theme.small);
        place.y += 18 * s;
    }
    if (at.holds(vec(ImGui::GetIO().MousePos))) drawErrorTip(theme, at, errorLines(performance));
}

}  // namespace app::panels
