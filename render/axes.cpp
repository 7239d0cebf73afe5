#include "render/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>
#include <set>

#include "render/color.h"

namespace render {
namespace {

constexpr const char* kMinus = "\u2212";

// The double nearest to digits * 10^exponent, which may be 0 or infinite.
double decimal(std::int64_t digits, int exponent) {
    const std::string text = fmt::format("{}e{}", digits, exponent);
    double value = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec == std::errc::result_out_of_range && exponent > 0)
        return std::copysign(std::numeric_limits<double>::infinity(), static_cast<double>(digits));
    return value;
}

struct Step {
    int mantissa, exponent;
    double length() const { return decimal(mantissa, exponent); }
    double multiple(std::int64_t n) const { return decimal(n * mantissa, exponent); }
};

// The first and last multiple of the step in [lo, hi]; none when first > last.
struct Multiples {
    std::int64_t first, last;
    double count() const { return static_cast<double>(last - first + 1); }
};
std::optional<Multiples> multiples(Step step, double lo, double hi) {
    // Beyond this, neighbouring multiples are no longer different doubles.
    constexpr double kMost = 4e15;
    const double from = lo / step.length(), to = hi / step.length();
    if (!(std::abs(from) < kMost && std::abs(to) < kMost)) return std::nullopt;
    // The quotients may be off by a rounding: the multiples themselves decide.
    Multiples m{std::llround(from) - 1, std::llround(to) + 1};
    while (m.first <= m.last && step.multiple(m.first) < lo) ++m.first;
    while (m.last >= m.first && step.multiple(m.last) > hi) --m.last;
    if (m.first > m.last) return std::nullopt;
    return m;
}

}  // namespace

std::vector<double> niceTicks(double lo, double hi, int wanted) {
    assert(lo <= hi && wanted >= 1);
    // Divided before the difference, which may overflow.
    const double rough = hi / wanted - lo / wanted;
    if (!(rough > 0)) return {lo};
    const int decade = static_cast<int>(std::floor(std::log10(rough)));
    Step best{0, 0};
    Multiples ticks{0, -1};
    double least = std::numeric_limits<double>::infinity();
    for (int exponent = std::max(decade - 1, -323); exponent <= std::min(decade + 1, 308);
         ++exponent) {
        for (const int mantissa : {1, 2, 5}) {
            const Step step{mantissa, exponent};
            if (!std::isfinite(step.length()) || step.length() == 0) continue;
            const auto found = multiples(step, lo, hi);
            if (!found) continue;
            const double off = std::abs(std::log(found->count() / wanted));
            if (off < least) {
                least = off;
                best = step;
                ticks = *found;
            }
        }
    }
    std::vector<double> values;
    for (std::int64_t n = ticks.first; n <= ticks.last; ++n) values.push_back(best.multiple(n));
    if (values.empty()) values.push_back(lo);  // neighbouring doubles: nothing rounder between
    return values;
}

namespace {

// Shortest decimal form: 0.25 is digits "25", exponent -1 (of the first digit).
struct Decimal {
    int digitCount, exponent;
};
Decimal shortest(double value) {
    std::array<char, 40> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), std::abs(value),
                                   std::chars_format::scientific);
    const std::string_view written(text.data(), static_cast<std::size_t>(end.ptr - text.data()));
    const std::size_t e = written.find('e');
    const auto digits = static_cast<int>(e > 1 ? e - 1 : 1);  // without the point
    const std::string_view power = written.substr(written[e + 1] == '+' ? e + 2 : e + 1);
    int exponent = 0;
    std::from_chars(power.data(), power.data() + power.size(), exponent);
    return {digits, exponent};
}

std::string superscript(std::string_view number) {
    constexpr std::array<const char*, 10> kDigits = {"\u2070", "\u00b9", "\u00b2", "\u00b3",
                                                     "\u2074", "\u2075", "\u2076", "\u2077",
                                                     "\u2078", "\u2079"};
    std::string text;
    for (const char c : number)
        text += c == '-' ? "\u207b" : kDigits[static_cast<std::size_t>(c - '0')];
    return text;
}

}  // namespace

std::vector<std::string> tickTexts(std::span<const double> ticks) {
    int decimals = 0, exponent = std::numeric_limits<int>::min();
    bool first = true;
    for (const double tick : ticks) {
        if (tick == 0) continue;
        const Decimal d = shortest(tick);
        const int needed = d.digitCount - 1 - d.exponent;
        decimals = first ? needed : std::max(decimals, needed);
        exponent = std::max(exponent, d.exponent);
        first = false;
    }
    if (first) return std::vector<std::string>(ticks.size(), "0");
    const int plain = std::max(exponent, 0) + 1 + (decimals > 0 ? decimals + 1 : 0);
    const int mantissaDecimals = exponent + decimals;
    const int powers = 1 + (mantissaDecimals > 0 ? mantissaDecimals + 1 : 0) + 4;
    const bool usePlain = (exponent <= 5 && plain <= 6) || plain <= powers;
    std::vector<std::string> texts;
    for (const double tick : ticks) {
        std::string text;
        if (tick == 0 && !usePlain) {
            text = "0";
        } else if (usePlain) {
            text = fmt::format("{:.{}f}", std::abs(tick), std::max(decimals, 0));
        } else {
            // A mantissa against the common exponent, through the decimal text: dividing by a power
            // of ten would round.
            const std::string digits =
                fmt::format("{:.{}e}", std::abs(tick), std::max(shortest(tick).digitCount - 1, 0));
            const std::size_t e = digits.find('e');
            double mantissa = 0;
            const std::string shifted =
                digits.substr(0, e) + fmt::format("e{}", shortest(tick).exponent - exponent);
            std::from_chars(shifted.data(), shifted.data() + shifted.size(), mantissa);
            text = fmt::format("{:.{}f}\u00d710{}", mantissa, std::max(mantissaDecimals, 0),
                               superscript(std::to_string(exponent)));
        }
        texts.push_back(tick < 0 ? kMinus + text : text);
    }
    return texts;
}

namespace {

// "s-1" is s⁻¹, and "m2" m² for the few units that are commonly squared; CO2 stays.
std::string shownFactor(const std::string& factor) {
    const std::size_t letters =
        static_cast<std::size_t>(std::find_if_not(factor.begin(), factor.end(),
                                                  [](unsigned char c) { return std::isalpha(c); }) -
                                 factor.begin());
    const std::string base = factor.substr(0, letters), power = factor.substr(letters);
    if (base.empty() || power.empty()) return factor;
    const bool negative = power[0] == '-';
    const std::string digits = power.substr(negative ? 1 : 0);
    if (digits.size() != 1 || digits[0] < '1' || digits[0] > '9') return factor;
    static const std::set<std::string> kSquared = {"m", "mm", "cm", "km", "s"};
    if (!negative && !kSquared.contains(base)) return factor;
    return base + superscript(power);
}

}  // namespace

std::string shownUnit(const std::string& unit) {
    for (const char* degree : {"degrees_", "degree_", "degrees", "degree"}) {
        if (!unit.starts_with(degree)) continue;
        const std::string rest = unit.substr(std::string_view(degree).size());
        if (rest.empty()) return "\u00b0";
        if (rest == "east" || rest == "E") return "\u00b0E";
        if (rest == "north" || rest == "N") return "\u00b0N";
        if (rest == "west" || rest == "W") return "\u00b0W";
        if (rest == "south" || rest == "S") return "\u00b0S";
        if (rest == "Celsius" || rest == "celsius" || rest == "C") return "\u00b0C";
    }
    if (unit == "degC" || unit == "deg_C" || unit == "Celsius" || unit == "celsius")
        return "\u00b0C";
    std::string shown, factor;
    for (const char c : unit) {
        if (c == ' ' || c == '/' || c == '.') {
            shown += shownFactor(factor) + c;
            factor.clear();
        } else {
            factor += c;
        }
    }
    return shown + shownFactor(factor);
}

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

// An edge of the box: along `axis`, at the sides (-1 or 1) of the two others; side[axis] is 0.
struct Edge {
    int axis;
    glm::ivec3 side;
    glm::dvec3 at(const glm::dvec3& half, double along) const {
        glm::dvec3 p = half * glm::dvec3(side);
        p[axis] = along * half[axis];
        return p;
    }
};

// A flat box has fewer edges: its two sides along a flat axis are one.
std::vector<Edge> edges(const glm::dvec3& half) {
    std::vector<Edge> found;
    for (int axis = 0; axis < 3; ++axis) {
        if (half[axis] == 0) continue;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (const int su : {-1, 1}) {
            for (const int sv : {-1, 1}) {
                if ((half[u] == 0 && su > 0) || (half[v] == 0 && sv > 0)) continue;
                Edge edge{axis, glm::ivec3(0)};
                edge.side[u] = su;
                edge.side[v] = sv;
                found.push_back(edge);
            }
        }
    }
    return found;
}

// How an edge lies for an eye: between two faces that show, on the outline, or behind.
enum class Lies { Front, Outline, Behind };
Lies lies(const Edge& edge, const glm::dvec3& half, const glm::dvec3& eye) {
    int showing = 0;
    for (int a = 0; a < 3; ++a) {
        if (a == edge.axis) continue;
        if (half[a] == 0) return Lies::Outline;  // of a sheet or a line
        if (eye[a] * edge.side[a] > half[a]) ++showing;
    }
    return showing == 2 ? Lies::Front : showing == 1 ? Lies::Outline : Lies::Behind;
}

class Screen {
 public:
    explicit Screen(const View& view)
        : clipFromWorld_(view.clipFromView * view.viewFromWorld), size_(view.size) {}

    // Picture pixels from the top left, window depth. REQUIRES: before the near plane.
    glm::dvec3 pixel(const glm::dvec3& world) const {
        const glm::dvec4 clip = clipFromWorld_ * glm::dvec4(world, 1);
        const glm::dvec3 ndc = glm::dvec3(clip) / clip.w;
        return {(0.5 + 0.5 * ndc.x) * size_.x, (0.5 - 0.5 * ndc.y) * size_.y, ndc.z};
    }
    // The part of a to b, as fractions, before the near plane; or in the picture as well.
    enum class Cut { NearPlane, Picture };
    std::optional<glm::dvec2> visible(const glm::dvec3& a, const glm::dvec3& b, Cut cut) const {
        const glm::dvec4 from = clipFromWorld_ * glm::dvec4(a, 1);
        const glm::dvec4 to = clipFromWorld_ * glm::dvec4(b, 1);
        glm::dvec2 part(0, 1);
        // A point is visible where each of these is positive.
        const auto keep = [&](double atFrom, double atTo) {
            if (atFrom < 0 && atTo < 0) part = {1, 0};
            if (atFrom < 0 && atTo >= 0) part[0] = std::max(part[0], atFrom / (atFrom - atTo));
            if (atFrom >= 0 && atTo < 0) part[1] = std::min(part[1], atFrom / (atFrom - atTo));
        };
        keep(from.z, to.z);
        if (cut == Cut::Picture) {
            for (int a2 = 0; a2 < 2; ++a2) {
                keep(from.w - from[a2], to.w - to[a2]);
                keep(from.w + from[a2], to.w + to[a2]);
            }
        }
        if (part[0] >= part[1]) return std::nullopt;
        return part;
    }

 private:
    glm::dmat4 clipFromWorld_;
    glm::dvec2 size_;
};

// The view from the point midway between the eyes, through the middle of the picture.
View middle(const View& view, const glm::dvec3& midEye) {
    View mid = view;
    mid.clipFromView[2][0] = mid.clipFromView[2][1] = 0;
    const glm::dmat3 rotation(view.viewFromWorld);
    mid.viewFromWorld[3] = glm::dvec4(-(rotation * midEye), 1);
    return mid;
}

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
};

glm::dvec3 tickAt(const Page& page, const Edge& edge, double coordinate) {
    const glm::dvec3 half = page.lattice.boxHalf();
    glm::dvec3 p = edge.at(half, 0);
    glm::dvec3 onAxis(0);
    onAxis[edge.axis] = coordinate;
    p[edge.axis] = std::clamp(page.lattice.worldFromGrid(onAxis)[edge.axis], -half[edge.axis],
                              half[edge.axis]);
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

// Degrees divide a circle rather than a ten.
std::vector<double> degreeTicks(double lo, double hi, int wanted) {
    double best = 0, least = std::numeric_limits<double>::infinity();
    for (const double step : {10.0, 20.0, 30.0, 60.0, 90.0, 180.0}) {
        const double count = std::floor(hi / step) - std::ceil(lo / step) + 1;
        const double off = std::abs(std::log(count / wanted));
        if (count >= 1 && off < least) {
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
    const double slack = 1e-6 * (last - first);
    const glm::dvec2 fractions = axis.down ? glm::dvec2(1 - part->y, 1 - part->x) : *part;
    const double lo = glm::mix(first, last, fractions[0]) - slack;
    const double hi = glm::mix(first, last, fractions[1]) + slack;
    const double pixels = glm::distance(glm::dvec2(screen.pixel(glm::mix(a, b, part->x))),
                                        glm::dvec2(screen.pixel(glm::mix(a, b, part->y))));
    const glm::dvec2 out = outward(page, screen, shown.edge, *part);
    for (int wanted = std::clamp(static_cast<int>(pixels / (4.5 * page.line())), 2, 9); wanted >= 1;
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
    bool fits(const Label& label, double apart) const {
        const Rect covers = label.covers();
        if (!inside(covers.grown(2), page_.size)) return false;
        return std::none_of(taken_.begin(), taken_.end(),
                            [&](const Rect& other) { return overlap(covers.grown(apart), other); });
    }
    void take(const Label& label) { taken_.push_back(label.covers()); }

 private:
    const Page& page_;
    std::vector<Rect> taken_;
};

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
        meshes.lines.line(from, to, width, glm::vec4(kAxisEdge, 1));
        if (!placed.fits(labels[i], 0.25 * page.line())) continue;
        placed.take(labels[i]);
        meshes.labels.text(page.font, page.style, labels[i].text, labels[i].topLeft, kNumber);
        const glm::dvec2 size = labels[i].covers().hi - labels[i].covers().lo;
        farthest =
            std::max(farthest, page.tickLength() + page.gap() + glm::dot(size, glm::abs(out)));
    }
    if (axis.title.empty()) return;
    // Beyond the numbers, as near the middle as there is room; else between two of them.
    for (const double away : {farthest + 1.2 * page.gap(), page.tickLength() + page.gap()}) {
        for (const double along : {0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9, 0.0, 1.0}) {
            const double t = glm::mix(part->x, part->y, along);
            const glm::dvec2 from(screen.pixel(glm::mix(a, b, t)));
            const Label title = beyond(page.font, page.style, axis.title, from + out * away, out);
            if (!placed.fits(title, 0.4 * page.line())) continue;
            placed.take(title);
            meshes.labels.text(page.font, page.style, title.text, title.topLeft, kTitle);
            return;
        }
    }
}

}  // namespace

AxesMeshes axesMeshes(const timeseries::Grid& grid, const Lattice& lattice, const View& view,
                      const glm::dvec3& midEye, const Font& font, const FlatMesh& legend) {
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
        meshes.lines.line(screen.pixel(glm::mix(a, b, part->x)),
                          screen.pixel(glm::mix(a, b, part->y)), width, glm::vec4(color, 1));
    }
    Placed placed(page, legend);
    for (const ShownAxis& axis : axes) drawAxis(page, screen, axis, placed, meshes, width);
    return meshes;
}

}  // namespace render
