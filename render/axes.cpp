#include "render/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>

#include "render/box_edges.h"
#include "render/color.h"
#include "render/ticks.h"

namespace render {

FontStyle labelStyle(glm::ivec2 pictureSize) {
    const double pixels = std::min(pictureSize.x, pictureSize.y) / 46.0;
    return {FontWeight::Regular, static_cast<int>(std::lround(std::clamp(pixels, 13.0, 40.0)))};
}

FontStyle titleStyle(glm::ivec2 pictureSize) {
    const double pixels = 1.3 * labelStyle(pictureSize).linePixels;
    return {FontWeight::SemiBold, static_cast<int>(std::lround(pixels))};
}

namespace {

glm::vec3 light(int red, int green, int blue) {
    return glm::vec3(linearFromSrgb(glm::dvec3(red, green, blue) / 255.0));
}
const glm::vec3 kAxisEdge = light(134, 145, 162), kNearEdge = light(84, 94, 110),
                kFarEdge = light(52, 59, 71), kNumber = light(170, 179, 193),
                kTitle = light(230, 233, 239);

constexpr double kLeastMargin = 2;  // pixels between a label and the picture's edge

struct Rect {
    glm::dvec2 lo, hi;
    Rect grown(double by) const { return {lo - by, hi + by}; }
};
bool overlap(const Rect& a, const Rect& b) {
    return a.lo.x < b.hi.x && b.lo.x < a.hi.x && a.lo.y < b.hi.y && b.lo.y < a.hi.y;
}
bool inside(const Rect& a, glm::dvec2 size) {
    return a.lo.x >= 0 && a.lo.y >= 0 && a.hi.x <= size.x && a.hi.y <= size.y;
}

// What a text's glyphs cover when it is laid out at (0, 0).
Rect ink(const Font& font, FontStyle style, const std::string& text) {
    Rect box{glm::dvec2(1e9), glm::dvec2(-1e9)};
    for (const GlyphQuad& glyph : font.layout(text, style, {0, 0})) {
        box.lo = glm::min(box.lo, glm::dvec2(glyph.topLeft));
        box.hi = glm::max(box.hi, glm::dvec2(glyph.topLeft + glyph.size));
    }
    if (box.lo.x > box.hi.x) return {glm::dvec2(0), glm::dvec2(0)};
    return box;
}

struct Label {
    std::string text;
    Rect inkAtOrigin;
    glm::dvec2 topLeft{0};
    Rect covers() const { return {inkAtOrigin.lo + topLeft, inkAtOrigin.hi + topLeft}; }
};

// A label whose ink lies beyond the line through `from` across `outward`, touching it.
Label beyond(const Font& font, FontStyle style, const std::string& text, glm::dvec2 from,
             glm::dvec2 outward) {
    Label label{text, ink(font, style, text)};
    const glm::dvec2 half = 0.5 * (label.inkAtOrigin.hi - label.inkAtOrigin.lo);
    const double reach = glm::dot(half, glm::abs(outward));
    const glm::dvec2 centre = from + outward * (reach + 0.5);  // half a pixel: rounding
    label.topLeft = glm::round(centre - half - label.inkAtOrigin.lo);
    return label;
}

// One labelled axis as an eye sees it.
struct ShownAxis {
    Edge edge;
    std::string title;
    std::vector<double> ticks;  // in the file's coordinates
    std::vector<std::string> texts;
};

// Everything that labels are placed by.
struct Page {
    const timeseries::Grid& grid;
    const Lattice& lattice;
    const Font& font;
    FontStyle style;
    glm::dvec2 size;

    double line() const { return style.linePixels; }
    double tickLength() const { return 0.36 * line(); }
    double gap() const { return 0.38 * line(); }
    // What stays free around titles, as around the legend.
    double margin() const { return std::min(0.9 * line(), 0.06 * std::min(size.x, size.y)); }
};

glm::dvec3 tickAt(const Page& page, const Edge& edge, double coordinate) {
    const glm::dvec3 half = page.lattice.boxHalf();
    glm::dvec3 p = edge.at(half, 0);
    glm::dvec3 onAxis(0);
    onAxis[edge.axis] = coordinate;
    p[edge.axis] =
        std::clamp(page.lattice.axesFromGrid(onAxis)[edge.axis], -half[edge.axis], half[edge.axis]);
    return p;
}

// Across the edge in the picture, away from the box.
glm::dvec2 outward(const Page& page, const Screen& screen, const Edge& edge, glm::dvec2 part) {
    const glm::dvec3 half = page.lattice.boxHalf();
    const glm::dvec3 a = edge.at(half, -1), b = edge.at(half, 1);
    const glm::dvec2 from(screen.pixel(glm::mix(a, b, part[0])));
    const glm::dvec2 to(screen.pixel(glm::mix(a, b, part[1])));
    if (glm::distance(from, to) < 1e-9) return {0, 1};
    const glm::dvec2 along = glm::normalize(to - from);
    const glm::dvec2 across(-along.y, along.x);
    // The box lies on one side of its outline; which one, the opposite edge tells, where it can be
    // seen, or else a point just inside.
    const glm::dvec3 onEdge = glm::mix(a, b, 0.5 * (part[0] + part[1]));
    glm::dvec3 within = onEdge * 0.999;
    within[edge.axis] = onEdge[edge.axis];
    const double side = glm::dot(glm::dvec2(screen.pixel(within)) - from, across);
    if (side == 0) return across.y > 0 ? across : -across;  // a line: below it
    return side > 0 ? -across : across;
}

std::vector<Label> tickLabels(const Page& page, const Screen& screen, const ShownAxis& axis,
                              glm::dvec2 out) {
    std::vector<Label> labels;
    for (std::size_t i = 0; i < axis.ticks.size(); ++i) {
        const glm::dvec2 at(screen.pixel(tickAt(page, axis.edge, axis.ticks[i])));
        labels.push_back(beyond(page.font, page.style, axis.texts[i],
                                at + out * (page.tickLength() + page.gap()), out));
    }
    return labels;
}

bool crowded(const std::vector<Label>& labels, double apart) {
    for (std::size_t i = 1; i < labels.size(); ++i)
        if (overlap(labels[i - 1].covers().grown(apart), labels[i].covers())) return true;
    return false;
}

// Degrees divide a circle rather than a ten; none where they pass many circles.
std::vector<double> degreeTicks(double lo, double hi, int wanted) {
    double best = 0, least = std::numeric_limits<double>::infinity();
    for (const double step : {10.0, 20.0, 30.0, 60.0, 90.0, 180.0}) {
        const double count = std::floor(hi / step) - std::ceil(lo / step) + 1;
        const double off = std::abs(std::log(count / wanted));
        if (count >= 1 && count <= 3 * wanted && off < least) {
            least = off;
            best = step;
        }
    }
    std::vector<double> ticks;
    if (best > 0)
        for (double n = std::ceil(lo / best); n * best <= hi; ++n) ticks.push_back(n * best);
    return ticks;
}

std::vector<double> ticksOf(const timeseries::Axis& axis, double lo, double hi, int wanted) {
    if (axis.units.starts_with("degree") && (hi - lo) / wanted > 7.5) {
        auto ticks = degreeTicks(lo, hi, wanted);
        if (!ticks.empty()) return ticks;
    }
    auto ticks = niceTicks(lo, hi, wanted);
    if (axis.units == "index")
        std::erase_if(ticks, [](double tick) { return tick != std::round(tick); });
    return ticks;
}

// As many ticks as stand apart on the part of the edge that is in the picture.
void chooseTicks(const Page& page, const Screen& screen, ShownAxis& shown) {
    const timeseries::Axis& axis = page.grid.axes()[static_cast<std::size_t>(shown.edge.axis)];
    const glm::dvec3 half = page.lattice.boxHalf();
    const glm::dvec3 a = shown.edge.at(half, -1), b = shown.edge.at(half, 1);
    const auto part = screen.visible(a, b, Screen::Cut::Picture);
    if (!part) return;
    double first = std::min(axis.coordinates.front(), axis.coordinates.back());
    double last = std::max(axis.coordinates.front(), axis.coordinates.back());
    // Coordinates come from files as floats or as sums: an end a rounding short of 1 is 1.
    const double slack = 1e-6 * last - 1e-6 * first;
    const glm::dvec2 fractions = axis.down ? glm::dvec2(1 - part->y, 1 - part->x) : *part;
    constexpr double kMost = std::numeric_limits<double>::max();
    const double lo = std::max(glm::mix(first, last, fractions[0]) - slack, -kMost);
    const double hi = std::min(glm::mix(first, last, fractions[1]) + slack, kMost);
    const double pixels = glm::distance(glm::dvec2(screen.pixel(glm::mix(a, b, part->x))),
                                        glm::dvec2(screen.pixel(glm::mix(a, b, part->y))));
    const glm::dvec2 out = outward(page, screen, shown.edge, *part);
    // One number tells no scale; for 2, niceTicks would rather give 1 than 5.
    for (int wanted = std::clamp(static_cast<int>(pixels / (4.5 * page.line())), 3, 9); wanted >= 1;
         --wanted) {
        shown.ticks = ticksOf(axis, lo, hi, wanted);
        shown.texts = tickTexts(shown.ticks);
        if (!crowded(tickLabels(page, screen, shown, out), 0.5 * page.line())) return;
    }
    shown.ticks.resize(std::min<std::size_t>(shown.ticks.size(), 1));
    shown.texts.resize(shown.ticks.size());
}

// x and y along the lowest outline edge in the picture, z along the leftmost.
std::vector<ShownAxis> chooseAxes(const Page& page, const View& view, const glm::dvec3& midEye) {
    const glm::dvec3 half = page.lattice.boxHalf();
    const Screen screen(middle(view, midEye));
    std::vector<ShownAxis> axes;
    for (const int axis : {2, 0, 1}) {  // the order in which they take their places
        const Edge* best = nullptr;
        double least = std::numeric_limits<double>::infinity();
        const auto all = edges(half);
        for (const Edge& edge : all) {
            if (edge.axis != axis || lies(edge, half, midEye) != Lies::Outline) continue;
            const glm::dvec3 a = edge.at(half, -1), b = edge.at(half, 1);
            const auto part = screen.visible(a, b, Screen::Cut::Picture);
            if (!part) continue;
            const glm::dvec3 at = screen.pixel(glm::mix(a, b, 0.5 * (part->x + part->y)));
            const double badness = axis == 2 ? at.x : -at.y;
            if (badness < least) {
                least = badness;
                best = &edge;
            }
        }
        if (best == nullptr) continue;
        const timeseries::Axis& named = page.grid.axes()[static_cast<std::size_t>(axis)];
        const std::string unit = shownUnit(named.units);
        ShownAxis shown{
            *best, unit.empty() ? named.name : fmt::format("{} ({})", named.name, unit), {}, {}};
        chooseTicks(page, screen, shown);
        axes.push_back(std::move(shown));
    }
    return axes;
}

// The labels of a picture so far: each in the picture and apart from the others.
class Placed {
 public:
    Placed(const Page& page, const FlatMesh& legend) : page_(page) {
        const auto& corners = legend.triangles();
        for (std::size_t i = 0; i + 6 <= corners.size(); i += 6) {  // two triangles a shape
            Rect shape{glm::dvec2(1e9), glm::dvec2(-1e9)};
            for (std::size_t j = i; j < i + 6; ++j) {
                shape.lo = glm::min(shape.lo, glm::dvec2(corners[j].at));
                shape.hi = glm::max(shape.hi, glm::dvec2(corners[j].at));
            }
            taken_.push_back(shape);
        }
    }
    // In the picture, so far from its edges and so far apart from the others.
    bool fits(const Label& label, double margin, double apart) const {
        const Rect covers = label.covers();
        if (!inside(covers.grown(margin), page_.size)) return false;
        return std::none_of(taken_.begin(), taken_.end(),
                            [&](const Rect& other) { return overlap(covers.grown(apart), other); });
    }
    void take(const Label& label) { taken_.push_back(label.covers()); }

 private:
    const Page& page_;
    std::vector<Rect> taken_;
};

// Beyond the numbers, as near the middle as there is room; else between two of them; at last, near
// the picture's edge. `farthest`: where the numbers end.
std::optional<Label> placedTitle(const Page& page, const Screen& screen, const ShownAxis& axis,
                                 const Placed& placed, glm::dvec2 part, double farthest) {
    const glm::dvec3 half = page.lattice.boxHalf();
    const glm::dvec3 a = axis.edge.at(half, -1), b = axis.edge.at(half, 1);
    const glm::dvec2 out = outward(page, screen, axis.edge, part);
    for (const double margin : {page.margin(), kLeastMargin})
        for (const double away : {farthest + 1.2 * page.gap(), page.tickLength() + page.gap()})
            for (const double along : {0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9, 0.0, 1.0}) {
                const double t = glm::mix(part.x, part.y, along);
                const glm::dvec2 from(screen.pixel(glm::mix(a, b, t)));
                Label title = beyond(page.font, page.style, axis.title, from + out * away, out);
                if (placed.fits(title, margin, 0.4 * page.line())) return title;
            }
    return std::nullopt;
}

void drawAxis(const Page& page, const Screen& screen, const ShownAxis& axis, Placed& placed,
              AxesMeshes& meshes, float width) {
    const glm::dvec3 half = page.lattice.boxHalf();
    const glm::dvec3 a = axis.edge.at(half, -1), b = axis.edge.at(half, 1);
    const auto part = screen.visible(a, b, Screen::Cut::Picture);
    if (!part) return;
    const glm::dvec2 out = outward(page, screen, axis.edge, *part);
    const auto labels = tickLabels(page, screen, axis, out);
    double farthest = page.tickLength() + page.gap();
    for (std::size_t i = 0; i < axis.ticks.size(); ++i) {
        const glm::dvec3 at = tickAt(page, axis.edge, axis.ticks[i]);
        if (!screen.visible(at, at, Screen::Cut::NearPlane)) continue;
        const glm::dvec3 from = screen.pixel(at);
        const glm::dvec3 to = from + glm::dvec3(out * page.tickLength(), 0);
        meshes.before.line(from, to, width, glm::vec4(kAxisEdge, 1));
        if (!placed.fits(labels[i], kLeastMargin, 0.25 * page.line())) continue;
        placed.take(labels[i]);
        meshes.labels.text(page.font, page.style, labels[i].text, labels[i].topLeft, kNumber);
        const glm::dvec2 size = labels[i].covers().hi - labels[i].covers().lo;
        farthest =
            std::max(farthest, page.tickLength() + page.gap() + glm::dot(size, glm::abs(out)));
    }
    if (axis.title.empty()) return;
    if (const auto title = placedTitle(page, screen, axis, placed, *part, farthest)) {
        placed.take(*title);
        meshes.labels.text(page.font, page.style, title->text, title->topLeft, kTitle);
    }
}

}  // namespace

AxesMeshes axesMeshes(const timeseries::Grid& grid, const Lattice& lattice, const View& viewOfWorld,
                      const glm::dvec3& midEyeInWorld, const Font& font, const FlatMesh& legend) {
    // In axis coordinates the box stands upright, however oblique it is in the world.
    const View view = lattice.inAxes(viewOfWorld);
    const glm::dvec3 midEye = glm::inverse(lattice.worldFromAxes()) * midEyeInWorld;
    const Page page{grid, lattice, font, labelStyle(view.size), glm::dvec2(view.size)};
    const glm::dvec3 half = lattice.boxHalf();
    const Screen screen(view);
    const auto axes = chooseAxes(page, view, midEye);
    const float width = std::max(1.0f, 0.06f * static_cast<float>(page.style.linePixels));
    AxesMeshes meshes;
    for (const Edge& edge : edges(half)) {
        const glm::dvec3 a = edge.at(half, -1), b = edge.at(half, 1);
        const auto part = screen.visible(a, b, Screen::Cut::NearPlane);
        if (!part) continue;
        const bool labelled = std::any_of(axes.begin(), axes.end(), [&](const ShownAxis& axis) {
            return axis.edge.axis == edge.axis && axis.edge.side == edge.side;
        });
        const bool behind = lies(edge, half, midEye) == Lies::Behind;
        const glm::vec3 color = labelled ? kAxisEdge : behind ? kFarEdge : kNearEdge;
        (behind ? meshes.behind : meshes.before)
            .line(screen.pixel(glm::mix(a, b, part->x)), screen.pixel(glm::mix(a, b, part->y)),
                  width, glm::vec4(color, 1));
    }
    Placed placed(page, legend);
    for (const ShownAxis& axis : axes) drawAxis(page, screen, axis, placed, meshes, width);
    return meshes;
}

}  // namespace render
