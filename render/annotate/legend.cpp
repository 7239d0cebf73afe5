#include "render/annotate/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "render/annotate/axes.h"
#include "render/annotate/color_bar.h"
#include "render/annotate/fitted_text.h"
#include "render/image/color.h"

namespace render {
namespace {

const glm::vec3 kText(linearFromSrgb8(230, 233, 239)), kFaint(linearFromSrgb8(128, 137, 152));

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

// In lines of a label.
constexpr float kTimeLine = 1.2f;                       // the time, and that there is nothing at it
constexpr float kAboveLayers = 0.45f;                   // free
constexpr float kLayer = 1.25f, kAmount = 1, kBar = 2;  // a layer's range, what stands below it
constexpr float kBarWidth = 13, kLeastColumn = 19;
constexpr float kPlate = 0.35f, kSoftEdge = 0.4f;  // around the text

float lineOf(glm::ivec2 size) { return static_cast<float>(labelStyle(size).linePixels); }
// Around all that is said.
float marginOf(glm::ivec2 size) {
    return std::round(
        std::min(0.9f * lineOf(size), 0.06f * static_cast<float>(std::min(size.x, size.y))));
}
// Of the picture's height, what layers may take: the middle of the picture is the field's.
float roomOfLayers(const Detail& detail) { return detail.amounts ? 0.4f : 0.6f; }

class Writer {
 public:
    Writer(const Legend& legend, const Font& font, glm::ivec2 size)
        : legend_(legend),
          font_(font),
          size_(size),
          label_(labelStyle(size)),
          title_(titleStyle(size)),
          line_(lineOf(size)),
          margin_(marginOf(size)),
          column_(std::clamp(0.4f * size_.x, std::min(kLeastColumn * line_, size_.x - 2 * margin_),
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
    float timeHeight() const {
        const float lines =
            (legend_.time.empty() ? 0 : kTimeLine) + (legend_.emptiness.empty() ? 0 : kTimeLine);
        return lines * line_;
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
        if (byValue(layer) && !detail.scales) words = spanText(barOf(layer));
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
        float lines = kLayer;
        if (isBelow(layer, detail)) lines += kAmount;
        if (detail.scales && byValue(layer)) lines += kBar;
        return lines * line_;
    }
    float columnHeight(const Detail& detail) const {
        float sum = titleHeight() + (detail.time ? timeHeight() : 0);
        if (detail.layers && !legend_.layers.empty()) {
            sum += kAboveLayers * line_;
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
        return !detail.layers || used <= roomOfLayers(detail) * room;
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
            text(label_, legend_.time, {margin_, y + 0.1f * line_}, wide(), kLegendQuiet);
            y += timeHeight();
            text(label_, legend_.emptiness, {margin_, y - 1.1f * line_}, wide(), kText);
        }
        y += kAboveLayers * line_;
        if (detail.layers) {
            for (const LegendLayer& layer : legend_.layers) {
                drawLayer(layer, detail, y);
                y += height(layer, detail);
            }
        }
        const auto notes = noteLines(detail);
        const float bottom = size_.y - margin_ - line_ * static_cast<float>(notes.size());
        if (!detail.layers && !legend_.layers.empty() && y + line_ < bottom)
            text(label_,
                 fmt::format("{} layer{}: no room for the legend", legend_.layers.size(),
                             legend_.layers.size() == 1 ? "" : "s"),
                 {margin_, y}, wide(), kLegendQuiet);
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
            text(label_, words, {left, y}, width, kLegendQuiet);
            y += line_;
        } else if (isBeside(layer, detail)) {
            const float past = font_.measure(layer.range, label_).x + 0.7f * line_;
            text(label_, words, {left + past, top}, width - past, kLegendQuiet);
        }
        if (byValue(layer) && detail.scales)
            drawScale(mesh_, font_, label_, barOf(layer), {margin_, y + 0.2f * line_},
                      std::round(std::min(column_, kBarWidth * line_)));
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
            drawBar(mesh_, barOf(layer), from, to);
        }
    }

    void frame(glm::vec2 from, glm::vec2 to, float rim, const glm::vec4& color) {
        mesh_.rect(from, {to.x, from.y + rim}, color);
        mesh_.rect({from.x, to.y - rim}, to, color);
        mesh_.rect({from.x, from.y + rim}, {from.x + rim, to.y - rim}, color);
        mesh_.rect({to.x - rim, from.y + rim}, {to.x, to.y - rim}, color);
    }

    static ColorBar barOf(const LegendLayer& layer) {
        const auto& style = std::get<ByValue>(layer.style.color);
        ColorBar bar{style, layer.shown, layer.openBelow ? "\u2264 " : "",
                     layer.openAbove ? "\u2265 " : "", layer.ofOneColor};
        if (bar.parts.empty()) bar.parts.emplace_back(style.lo, style.hi);
        return bar;
    }

    const Legend& legend_;
    const Font& font_;
    glm::vec2 size_;
    FontStyle label_, title_;
    float line_, margin_, column_;
    FlatMesh mesh_;
};

}  // namespace

glm::dvec2 legendCorner(std::size_t bars, std::size_t swatches, glm::ivec2 pictureSize) {
    const float line = lineOf(pictureSize), margin = marginOf(pictureSize);
    const float layers =
        kLayer * static_cast<float>(bars + swatches) + kBar * static_cast<float>(bars);
    const float texts = static_cast<float>(titleStyle(pictureSize).linePixels) +
                        line * (kTimeLine + (layers > 0 ? kAboveLayers + layers : 0));
    const float most =
        roomOfLayers(kDetails.front()) * (static_cast<float>(pictureSize.y) - 2 * margin);
    const float plate = (kPlate + kSoftEdge) * line;
    const float column = (swatches > 0 ? kLeastColumn : kBarWidth) * line;
    return {margin + column + plate, margin + std::min(texts, most) + plate};
}

FlatMesh legendMesh(const Legend& legend, const Font& font, glm::ivec2 pictureSize) {
    return Writer(legend, font, pictureSize).write();
}

namespace {

float softEdge(glm::ivec2 pictureSize) { return kSoftEdge * lineOf(pictureSize); }

std::vector<PixelRect> platesUnder(const FlatMesh& legend, glm::ivec2 pictureSize) {
    std::vector<PixelRect> plates;
    for (PixelRect plate : legend.covers()) {
        plate = plate.grown(static_cast<double>(kPlate * lineOf(pictureSize)));
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
