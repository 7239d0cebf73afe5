#include "render/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "render/axes.h"
#include "render/color.h"

namespace render {
namespace {

glm::vec3 light(int red, int green, int blue) {
    return glm::vec3(linearFromSrgb(glm::dvec3(red, green, blue) / 255.0));
}
const glm::vec3 kText = light(230, 233, 239), kQuiet = light(148, 157, 172),
                kFaint = light(112, 121, 136);

// The longest beginning that fits, ended by an ellipsis; empty where not even that fits.
std::string shortened(const Font& font, FontStyle style, std::string text, float width) {
    if (font.measure(text, style).x <= width) return text;
    const std::string ellipsis = "\u2026";
    while (!text.empty()) {
        // A character's last byte, and those that continue it.
        while ((static_cast<unsigned char>(text.back()) & 0xC0) == 0x80 && text.size() > 1)
            text.pop_back();
        text.pop_back();
        while (!text.empty() && text.back() == ' ') text.pop_back();
        if (!text.empty() && font.measure(text + ellipsis, style).x <= width)
            return text + ellipsis;
    }
    return {};
}

// What is said, from everything to the least; a picture takes the first that fits it.
struct Detail {
    bool notes, scales, amounts, layers, time;
};
constexpr std::array kDetails = {
    Detail{true, true, true, true, true},     Detail{false, true, true, true, true},
    Detail{true, false, true, true, true},    Detail{false, false, true, true, true},
    Detail{true, false, false, true, true},   Detail{false, false, false, true, true},
    Detail{true, false, false, false, true},  Detail{false, false, false, false, true},
    Detail{false, false, false, false, false}};

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
    float timeHeight() const { return legend_.time.empty() ? 0 : 1.15f * line_; }
    float notesHeight() const { return line_ * static_cast<float>(legend_.notes.size()); }
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
    // The amount stands beside the range where it fits there, else below.
    bool amountBeside(const LegendLayer& layer, const Detail& detail) const {
        return font_.measure(layer.range, label_).x + 0.7f * line_ +
                   font_.measure(layer.amount, label_).x <=
               textWidth(layer, detail);
    }
    float height(const LegendLayer& layer, const Detail& detail) const {
        float lines = 1.25f;
        if (detail.amounts && !layer.amount.empty() && !amountBeside(layer, detail)) lines += 1;
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
        if (used + (detail.notes ? notesHeight() + line_ : 0) > room) return false;
        // The middle of the picture is the field's.
        return !detail.layers || used <= (detail.scales ? 0.5f : 0.6f) * room;
    }

    void text(FontStyle style, const std::string& words, glm::vec2 topLeft, float width,
              const glm::vec3& color) {
        mesh_.text(font_, style, shortened(font_, style, words, width), glm::round(topLeft), color);
    }

    void draw(const Detail& detail) {
        const float wide = static_cast<float>(size_.x) - 2 * margin_;
        float y = margin_;
        text(title_, legend_.title, {margin_, y}, wide, kText);
        y += titleHeight();
        if (detail.time) {
            text(label_, legend_.time, {margin_, y}, wide, kQuiet);
            y += timeHeight();
        }
        y += 0.45f * line_;
        if (detail.layers) {
            for (const LegendLayer& layer : legend_.layers) {
                drawLayer(layer, detail, y);
                y += height(layer, detail);
            }
        }
        if (!detail.notes) return;
        y = static_cast<float>(size_.y) - margin_ - notesHeight();
        for (const std::string& note : legend_.notes) {
            text(label_, note, {margin_, y}, wide, kFaint);
            y += line_;
        }
    }

    void drawLayer(const LegendLayer& layer, const Detail& detail, float top) {
        const float width = textWidth(layer, detail);
        const float left = margin_ + column_ - width;
        if (!byValue(layer) || !detail.scales) drawSwatch(layer, swatchWidth(layer, detail), top);
        text(label_, layer.range, {left, top}, width, kText);
        float y = top + line_;
        if (detail.amounts && !layer.amount.empty()) {
            if (amountBeside(layer, detail)) {
                const float past = font_.measure(layer.range, label_).x + 0.7f * line_;
                text(label_, layer.amount, {left + past, top}, width - past, kQuiet);
            } else {
                text(label_, layer.amount, {left, y}, width, kQuiet);
                y += line_;
            }
        }
        if (byValue(layer) && detail.scales)
            drawScale(std::get<ByValue>(layer.style.color), y + 0.2f * line_);
    }

    // The outline shows the colour, the inside how much of it one unit length adds.
    void drawSwatch(const LegendLayer& layer, float width, float top) {
        const glm::vec2 from = glm::round(glm::vec2(margin_, top + 0.2f * line_));
        const glm::vec2 to = from + glm::vec2(width, std::round(0.6f * line_));
        if (const auto* constant = std::get_if<Constant>(&layer.style.color)) {
            const glm::vec3 color(constant->linearRgb);
            const auto opacity = static_cast<float>(std::clamp(layer.style.opacity, 0.0, 1.0));
            const float rim = std::max(1.0f, std::round(line_ / 16));
            mesh_.rect(from + rim, to - rim, glm::vec4(color * opacity, opacity));
            const glm::vec4 solid(color, 1);
            mesh_.rect(from, {to.x, from.y + rim}, solid);
            mesh_.rect({from.x, to.y - rim}, to, solid);
            mesh_.rect({from.x, from.y + rim}, {from.x + rim, to.y - rim}, solid);
            mesh_.rect({to.x - rim, from.y + rim}, {to.x, to.y - rim}, solid);
        } else {
            bar(std::get<ByValue>(layer.style.color), from, to);
        }
    }

    void bar(const ByValue& style, glm::vec2 from, glm::vec2 to) {
        if (style.hi > style.lo) {
            mesh_.gradient(from, to, style.map.entries());
        } else {
            mesh_.rect(from, to, glm::vec4(style.map.at(0.5), 1));
        }
    }

    // The colour bar with the values of its ends, and of its middle where there is room.
    void drawScale(const ByValue& style, float top) {
        const glm::vec2 from = glm::round(glm::vec2(margin_, top));
        const float width = std::round(std::min(column_, 13 * line_));
        const glm::vec2 to = from + glm::vec2(width, std::round(0.5f * line_));
        bar(style, from, to);
        struct Value {
            double value;
            float at;
        };
        std::vector<Value> shown;
        if (style.hi > style.lo) {
            shown = {{style.lo, 0}, {style.hi, 1}, {0.5 * style.lo + 0.5 * style.hi, 0.5f}};
        } else {
            shown = {{style.lo, 0.5f}};
        }
        const auto texts = scaleTexts(style);
        float freeFrom = from.x, freeTo = to.x;
        for (std::size_t i = 0; i < shown.size(); ++i) {
            const float wide = font_.measure(texts[i], label_).x;
            const float x = std::round(from.x + shown[i].at * (width - wide));
            const float gap = i == 0 ? 0 : 0.8f * line_;
            const bool room =
                i == 1 ? x >= freeFrom + gap : x >= freeFrom + gap && x + wide <= freeTo - gap;
            if (!room) continue;
            text(label_, texts[i], {x, to.y + 0.08f * line_}, wide + 1, kQuiet);
            if (i == 0) freeFrom = x + wide;
            if (i == 1) freeTo = x;
        }
    }

    // Four digits of the span tell any two places on a bar apart.
    static std::vector<std::string> scaleTexts(const ByValue& style) {
        if (!(style.hi > style.lo)) return tickTexts(std::array{style.lo});
        const double span = 0.5 * style.hi - 0.5 * style.lo;
        const int exponent = static_cast<int>(std::floor(std::log10(span))) - 3;
        const auto rounded = [&](double value) {
            const double magnitude = std::abs(value);
            const int digits =
                magnitude > 0 ? static_cast<int>(std::floor(std::log10(magnitude))) - exponent : 0;
            if (digits < 0) return 0.0;
            return std::stod(fmt::format("{:.{}e}", value, std::min(digits, 16)));
        };
        return tickTexts(std::array{rounded(style.lo), rounded(style.hi),
                                    rounded(0.5 * style.lo + 0.5 * style.hi)});
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

}  // namespace render
