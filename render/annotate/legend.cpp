#include "render/annotate/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>

#include "render/annotate/axes.h"
#include "render/annotate/fitted_text.h"
#include "render/annotate/ticks.h"
#include "render/image/color.h"

namespace render {
namespace {

const glm::vec3 kText(linearFromSrgb8(230, 233, 239)), kQuiet(linearFromSrgb8(148, 157, 172)),
    kFaint(linearFromSrgb8(128, 137, 152)), kFrame(linearFromSrgb8(58, 66, 79));

// What is said, from everything to the least; a picture takes the first that fits it.
struct Detail {
    std::size_t notes;  // lines of each, at most
    bool scales, amounts, layers, time;
};
constexpr std::size_t kNote = 3;
constexpr std::array kDetails = {
    Detail{kNote, true, true, true, true},   Detail{1, true, true, true, true},
    Detail{0, true, true, true, true},       Detail{kNote, false, true, true, true},
    Detail{1, false, true, true, true},      Detail{0, false, true, true, true},
    Detail{kNote, false, false, true, true}, Detail{1, false, false, true, true},
    Detail{0, false, false, true, true},     Detail{kNote, false, false, false, true},
    Detail{1, false, false, false, true},    Detail{0, false, false, false, true},
    Detail{0, false, false, false, false}};

class Writer {
 public:
    Writer(const Legend& legend, const Font& font, glm::ivec2 size)
        : legend_(legend),
          font_(font),
          size_(size),
          label_(labelStyle(size)),
          title_(titleStyle(size)),
          line_(static_cast<float>(label_.linePixels)),
          margin_(std::round(std::min(0.9f * line_, 0.06f * std::min(size_.x, size_.y)))),
          column_(std::clamp(0.4f * size_.x, std::min(19 * line_, size_.x - 2 * margin_),
                             size_.x - 2 * margin_)) {}

    FlatMesh write() {
        for (const Detail& detail : kDetails)
            if (fits(detail)) {
                draw(detail);
                break;
            }
        return std::move(mesh_);
    }

 private:
    float titleHeight() const {
        return legend_.title.empty() ? 0 : static_cast<float>(title_.linePixels);
    }
    // Time, and that there is nothing at it.
    float timeHeight() const {
        return ((legend_.time.empty() ? 0 : 1.2f) + (legend_.emptiness.empty() ? 0 : 1.2f)) * line_;
    }
    std::vector<std::string> noteLines(const Detail& detail) const {
        std::vector<std::string> lines;
        for (const std::string& note : legend_.notes)
            for (std::string& line : wrapped(font_, label_, note, wide(), detail.notes))
                lines.push_back(std::move(line));
        return lines;
    }
    float wide() const { return size_.x - 2 * margin_; }
    bool byValue(const LegendLayer& layer) const {
        return std::holds_alternative<ByValue>(layer.style.color);
    }
    float swatchWidth(const LegendLayer& layer, const Detail& detail) const {
        if (!byValue(layer)) return std::round(1.1f * line_);
        return detail.scales ? 0 : std::round(3.0f * line_);
    }
    float textWidth(const LegendLayer& layer, const Detail& detail) const {
        const float swatch = swatchWidth(layer, detail);
        return column_ - (swatch > 0 ? swatch + 0.55f * line_ : 0);
    }
    // The quiet text of a layer: what its colours span where no scale says it, and its amount.
    std::string aside(const LegendLayer& layer, const Detail& detail) const {
        std::string words;
        if (byValue(layer) && !detail.scales) {
            const Bar shown = barOf(layer);
            words = shown.below + endText(shown, shown.lo);
            if (shown.hi > shown.lo) words += " \u2013 " + shown.above + endText(shown, shown.hi);
        }
        if (detail.amounts && !layer.amount.empty())
            words += (words.empty() ? "" : ", ") + layer.amount;
        return words;
    }
    // It stands beside the range where it fits there, else below, or nowhere in small pictures.
    bool isBelow(const LegendLayer& layer, const Detail& detail) const {
        return detail.amounts && !aside(layer, detail).empty() && !isBeside(layer, detail);
    }
    bool isBeside(const LegendLayer& layer, const Detail& detail) const {
        return font_.measure(layer.range, label_).x + 0.7f * line_ +
                   font_.measure(aside(layer, detail), label_).x <=
               textWidth(layer, detail);
    }
    float height(const LegendLayer& layer, const Detail& detail) const {
        float lines = 1.25f;
        if (isBelow(layer, detail)) lines += 1;
        if (detail.scales && byValue(layer)) lines += 2.0f;
        return lines * line_;
    }
    float columnHeight(const Detail& detail) const {
        float sum = titleHeight() + (detail.time ? timeHeight() : 0);
        if (detail.layers && !legend_.layers.empty()) {
            sum += 0.45f * line_;
            for (const LegendLayer& layer : legend_.layers) sum += height(layer, detail);
        }
        return sum;
    }
    bool fits(const Detail& detail) const {
        const Detail& least = kDetails.back();
        const float room = static_cast<float>(size_.y) - 2 * margin_;
        if (detail.layers == least.layers && detail.time == least.time)
            return titleHeight() <= room;
        const float used = columnHeight(detail);
        const auto notes = static_cast<float>(noteLines(detail).size());
        // Wrapped notes, too, leave the middle to the field.
        if (detail.notes > 1 && notes * line_ > 0.25f * room) return false;
        if (used + (notes > 0 ? (notes + 1) * line_ : 0) > room) return false;
        // The middle of the picture is the field's.
        return !detail.layers || used <= (detail.amounts ? 0.4f : 0.6f) * room;
    }

    void text(FontStyle style, std::string words, glm::vec2 topLeft, float width,
              const glm::vec3& color) {
        std::replace(words.begin(), words.end(), '\n', ' ');  // a name from a file may hold one
        mesh_.text(font_, style, shortened(font_, style, words, width), glm::round(topLeft), color);
    }

    void draw(const Detail& detail) {
        float y = margin_;
        text(title_, legend_.title, {margin_, y}, wide(), kText);
        y += titleHeight();
        if (detail.time) {
            text(label_, legend_.time, {margin_, y + 0.1f * line_}, wide(), kQuiet);
            y += timeHeight();
            text(label_, legend_.emptiness, {margin_, y - 1.1f * line_}, wide(), kText);
        }
        y += 0.45f * line_;
        if (detail.layers) {
            for (const LegendLayer& layer : legend_.layers) {
                drawLayer(layer, detail, y);
                y += height(layer, detail);
            }
        }
        const auto notes = noteLines(detail);
        const float bottom = size_.y - margin_ - line_ * static_cast<float>(notes.size());
        if (!detail.layers && !legend_.layers.empty() && y + line_ < bottom)
            text(label_, fmt::format("{} layers: no room for their legend", legend_.layers.size()),
                 {margin_, y}, wide(), kQuiet);
        y = bottom;
        for (const std::string& line : notes) {
            text(label_, line, {margin_, y}, wide(), kFaint);
            y += line_;
        }
    }

    void drawLayer(const LegendLayer& layer, const Detail& detail, float top) {
        const float width = textWidth(layer, detail);
        const float left = margin_ + column_ - width;
        if (!byValue(layer) || !detail.scales) drawSwatch(layer, swatchWidth(layer, detail), top);
        // All of what is selected is told, though it be wider than the column.
        text(label_, layer.range, {left, top}, size_.x - margin_ - left, kText);
        float y = top + line_;
        const std::string words = aside(layer, detail);
        if (isBelow(layer, detail)) {
            text(label_, words, {left, y}, width, kQuiet);
            y += line_;
        } else if (isBeside(layer, detail)) {
            const float past = font_.measure(layer.range, label_).x + 0.7f * line_;
            text(label_, words, {left + past, top}, width - past, kQuiet);
        }
        if (byValue(layer) && detail.scales) drawScale(barOf(layer), y + 0.2f * line_);
    }

    // Full of the colour that much of the layer has: one unit length of it adds less. Of none at
    // all only the outline.
    void drawSwatch(const LegendLayer& layer, float width, float top) {
        const glm::vec2 from = glm::round(glm::vec2(margin_, top + 0.2f * line_));
        const glm::vec2 to = from + glm::vec2(width, std::round(0.6f * line_));
        if (const auto* constant = std::get_if<Constant>(&layer.style.color)) {
            const glm::vec3 color(constant->linearRgb);
            const float rim = std::max(1.0f, std::round(line_ / 16));
            if (layer.style.opacity > 0) mesh_.rect(from + rim, to - rim, glm::vec4(color, 1));
            frame(from, to, rim, glm::vec4(color, 1));
        } else {
            bar(barOf(layer), from, to);
        }
    }

    void frame(glm::vec2 from, glm::vec2 to, float rim, const glm::vec4& color) {
        mesh_.rect(from, {to.x, from.y + rim}, color);
        mesh_.rect({from.x, to.y - rim}, to, color);
        mesh_.rect({from.x, from.y + rim}, {from.x + rim, to.y - rim}, color);
        mesh_.rect({to.x - rim, from.y + rim}, {to.x, to.y - rim}, color);
    }

    // What a colour bar covers: the layer's values, which need not be the whole map's.
    struct Bar {
        ByValue style;
        double lo, hi;
        std::string below, above;  // before the numbers of its ends
    };
    static Bar barOf(const LegendLayer& layer) {
        const auto& style = std::get<ByValue>(layer.style.color);
        const auto [lo, hi] = layer.shown.value_or(std::pair(style.lo, style.hi));
        return {style, lo, hi, layer.openBelow ? "\u2264 " : "", layer.openAbove ? "\u2265 " : ""};
    }

    // Framed: the dark end of many maps is the background's colour.
    void bar(const Bar& shown, glm::vec2 from, glm::vec2 to) {
        frame(from - 1.0f, to + 1.0f, 1, glm::vec4(kFrame, 1));
        constexpr int kStops = 64;
        std::vector<glm::vec3> stops;
        for (int i = 0; i <= kStops; ++i) {
            const double value = std::lerp(shown.lo, shown.hi, static_cast<double>(i) / kStops);
            stops.push_back(shown.style.map.at(mapPosition(shown.style, value)));
        }
        mesh_.gradient(from, to, stops);
    }

    // The colour bar with the values of its ends, and of a round one between where there is room.
    void drawScale(const Bar& shown, float top) {
        const glm::vec2 from = glm::round(glm::vec2(margin_, top));
        const float width = std::round(std::min(column_, 13 * line_));
        const glm::vec2 to = from + glm::vec2(width, std::round(0.5f * line_));
        bar(shown, from, to);
        const float below = to.y + 0.12f * line_, gap = 0.8f * line_;
        const auto widthOf = [&](const std::string& words) {
            return font_.measure(words, label_).x;
        };
        const std::string least = endText(shown, shown.lo), lo = shown.below + least;
        // Where the bar is too short for both, the upper's last digits still tell them apart.
        const std::string hi =
            shown.above +
            withoutCommonStart({least, endText(shown, shown.hi)}, [&](const auto& end) {
                return end == least ||
                       widthOf(shown.above + end) + 0.5f * gap + widthOf(lo) <= width;
            })[1];
        if (!(shown.hi > shown.lo)) {
            text(label_, lo, {from.x, below}, width, kQuiet);
            return;
        }
        text(label_, lo, {from.x, below}, width, kQuiet);
        const float right = std::round(to.x - widthOf(hi));
        if (right < from.x + widthOf(lo) + 0.5f * gap) return;
        text(label_, hi, {right, below}, to.x - right + 1, kQuiet);
        const double middle = roundMiddle(shown);
        const std::string words = tickTexts(std::array{middle})[0];
        const float at =
            from.x + width * static_cast<float>((middle - shown.lo) / (shown.hi - shown.lo));
        const float left = std::round(at - 0.5f * widthOf(words));
        if (left < from.x + widthOf(lo) + gap || left + widthOf(words) > right - gap) return;
        text(label_, words, {left, below}, to.x - left, kQuiet);
        const float half = std::max(0.5f, std::round(line_ / 16) / 2);
        mesh_.rect({std::round(at - half), to.y + 1}, {std::round(at + half), to.y + 0.22f * line_},
                   glm::vec4(kQuiet, 1));
    }

    static double roundMiddle(const Bar& shown) {
        const double middle = 0.5 * shown.lo + 0.5 * shown.hi;
        const auto ticks = niceTicks(shown.lo, shown.hi, 3);
        return *std::min_element(ticks.begin(), ticks.end(), [&](double a, double b) {
            return std::abs(a - middle) < std::abs(b - middle);
        });
    }

    // Four digits of the span tell any two places on a bar apart.
    static std::string endText(const Bar& shownBar, double value) {
        double shown = value;
        const double span = 0.5 * shownBar.hi - 0.5 * shownBar.lo;
        if (span > 0 && value != 0) {
            const auto exponent = [](double x) { return std::floor(std::log10(std::abs(x))); };
            const int digits = static_cast<int>(exponent(value) - exponent(span)) + 3;
            const std::string text = fmt::format("{:.{}e}", value, std::clamp(digits, 0, 16));
            shown = digits < 0 ? 0 : std::strtod(text.c_str(), nullptr);
        }
        return tickTexts(std::array{shown})[0];
    }

    const Legend& legend_;
    const Font& font_;
    glm::vec2 size_;
    FontStyle label_, title_;
    float line_, margin_, column_;
    FlatMesh mesh_;
};

}  // namespace

FlatMesh legendMesh(const Legend& legend, const Font& font, glm::ivec2 pictureSize) {
    return Writer(legend, font, pictureSize).write();
}

namespace {

float softEdge(glm::ivec2 pictureSize) {
    return 0.4f * static_cast<float>(labelStyle(pictureSize).linePixels);
}

std::vector<PixelRect> platesUnder(const FlatMesh& legend, glm::ivec2 pictureSize) {
    std::vector<PixelRect> plates;
    for (PixelRect plate : legend.covers()) {
        plate = plate.grown(0.35 * labelStyle(pictureSize).linePixels);
        // It may join plates that were apart.
        for (std::size_t i = plates.size(); i-- > 0;) {
            if (!overlap(plate, plates[i])) continue;
            plate = around(plate, plates[i]);
            plates.erase(plates.begin() + static_cast<std::ptrdiff_t>(i));
            i = plates.size();
        }
        plates.push_back(plate);
    }
    return plates;
}

}  // namespace

FlatMesh legendGround(const FlatMesh& legend, glm::ivec2 pictureSize,
                      const glm::dvec3& background) {
    FlatMesh ground;
    for (const PixelRect& plate : platesUnder(legend, pictureSize))
        ground.plate(plate, softEdge(pictureSize), groundColor(background));
    return ground;
}

std::vector<PixelRect> coveredByLegend(const FlatMesh& legend, glm::ivec2 pictureSize) {
    std::vector<PixelRect> plates = platesUnder(legend, pictureSize);
    for (PixelRect& plate : plates) plate = plate.grown(static_cast<double>(softEdge(pictureSize)));
    return plates;
}

}  // namespace render
