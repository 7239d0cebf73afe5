#include "render/annotate/color_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>

#include "render/annotate/fitted_text.h"
#include "render/annotate/ticks.h"
#include "render/image/color.h"

namespace render {
const glm::vec3 kLegendQuiet(linearFromSrgb8(148, 157, 172));

namespace {

const glm::vec3 kFrame(linearFromSrgb8(58, 66, 79));

// Four digits of the span tell any two places on a bar apart.
std::string numberText(const ColorBar& bar, double value) {
    double shown = value;
    const double span = 0.5 * bar.hi() - 0.5 * bar.lo();
    if (span > 0 && value != 0) {
        const auto exponent = [](double x) { return std::floor(std::log10(std::abs(x))); };
        const int digits = static_cast<int>(exponent(value) - exponent(span)) + 3;
        const std::string text = fmt::format("{:.{}e}", value, std::clamp(digits, 0, 16));
        shown = digits < 0 ? 0 : std::strtod(text.c_str(), nullptr);
    }
    return tickTexts(std::array{shown})[0];
}

// Along the bar, [0, 1].
float placeOf(const ColorBar& bar, double value) {
    // Halves: the span of the greatest numbers is none.
    const double span = 0.5 * bar.hi() - 0.5 * bar.lo();
    return span > 0 ? static_cast<float>((0.5 * value - 0.5 * bar.lo()) / span) : 0.0f;
}

double roundMiddle(const ColorBar& bar) {
    const double middle = 0.5 * bar.lo() + 0.5 * bar.hi();
    const auto ticks = niceTicks(bar.lo(), bar.hi(), 3);
    return *std::min_element(ticks.begin(), ticks.end(), [&](double a, double b) {
        return std::abs(a - middle) < std::abs(b - middle);
    });
}

// What may stand between the ends: where the gaps end, or else a round value.
std::vector<double> valuesBetween(const ColorBar& bar) {
    if (bar.parts.size() == 1) return {roundMiddle(bar)};
    std::vector<double> values;
    for (std::size_t i = 1; i < bar.parts.size(); ++i) {
        values.push_back(bar.parts[i - 1].second);
        values.push_back(bar.parts[i].first);
    }
    // A part of one value has one number, which the bar's end may have already.
    values.erase(std::unique(values.begin(), values.end()), values.end());
    std::erase_if(values, [&](double value) { return value == bar.lo() || value == bar.hi(); });
    return values;
}

void framed(FlatMesh& mesh, glm::vec2 from, glm::vec2 to) {
    const glm::vec4 color(kFrame, 1);
    mesh.rect(from, {to.x, from.y + 1}, color);
    mesh.rect({from.x, to.y - 1}, to, color);
    mesh.rect({from.x, from.y + 1}, {from.x + 1, to.y - 1}, color);
    mesh.rect({to.x - 1, from.y + 1}, {to.x, to.y - 1}, color);
}

}  // namespace

namespace {

// The lower number; of one value alone, which is at both ends of the bar, with what either says.
std::string leastText(const ColorBar& bar, const std::string& number) {
    const bool isPoint = !(bar.hi() > bar.lo());
    return (isPoint && bar.below.empty() ? bar.above : bar.below) + number;
}

}  // namespace

std::string spanText(const ColorBar& bar) {
    if (!bar.words.empty()) return bar.words;
    std::string words = leastText(bar, numberText(bar, bar.lo()));
    if (bar.hi() > bar.lo()) words += " \u2013 " + bar.above + numberText(bar, bar.hi());
    return words;
}

void drawBar(FlatMesh& mesh, const ColorBar& bar, glm::vec2 from, glm::vec2 to) {
    const bool isPoint = !(bar.hi() > bar.lo());
    const auto across = [&](double value) {
        return std::round(from.x + (to.x - from.x) * placeOf(bar, value));
    };
    for (const auto& [lo, hi] : bar.parts) {
        // One value is a line one pixel wide; alone, all of the bar.
        float left = isPoint ? from.x : across(lo);
        const float right = isPoint ? to.x : std::max(across(hi), std::min(left + 1, to.x));
        left = std::min(left, right - 1);
        framed(mesh, glm::vec2(left, from.y) - 1.0f, glm::vec2(right, to.y) + 1.0f);
        constexpr int kStops = 64;
        std::vector<glm::vec3> stops;
        for (int i = 0; i <= kStops; ++i) {
            const double value = std::lerp(lo, hi, static_cast<double>(i) / kStops);
            stops.push_back(bar.style.map.at(mapPosition(bar.style, value)));
        }
        mesh.gradient({left, from.y}, {right, to.y}, stops);
    }
}

namespace {

// The numbers below a bar, as they find room.
class Numbers {
 public:
    Numbers(FlatMesh& mesh, const Font& font, FontStyle style, glm::vec2 from, float width)
        : mesh_(mesh), font_(font), style_(style), from_(from), width_(width) {}

    void ends(const ColorBar& bar) {
        if (!bar.words.empty()) return write(bar.words, from_.x);
        const std::string least = numberText(bar, bar.lo()), lo = leastText(bar, least);
        write(lo, from_.x);
        left_ = from_.x + widthOf(lo);
        right_ = from_.x + width_;
        if (!(bar.hi() > bar.lo())) return;
        // Where the bar is too short for both, the upper's last digits still tell them apart.
        const auto hasRoom = [&](const std::string& end) {
            return end == least || widthOf(bar.above + end) + 0.5f * gap() + widthOf(lo) <= width_;
        };
        const std::string hi =
            bar.above + withoutCommonStart({least, numberText(bar, bar.hi())}, hasRoom)[1];
        const float at = std::round(right_ - widthOf(hi));
        if (at < left_ + 0.5f * gap()) return;
        write(hi, at);
        right_ = at;
        for (const double value : valuesBetween(bar)) between(bar, value);
    }

 private:
    float line() const { return static_cast<float>(style_.linePixels); }
    float gap() const { return 0.8f * line(); }
    float widthOf(const std::string& words) const { return font_.measure(words, style_).x; }
    void write(const std::string& words, float left) {
        mesh_.text(font_, style_, shortened(font_, style_, words, from_.x + width_ - left + 1),
                   {std::round(left), std::round(from_.y)}, kLegendQuiet);
    }
    // With a tick, if it stands free of those before and of the upper end's.
    void between(const ColorBar& bar, double value) {
        const std::string words =
            bar.parts.size() > 1 ? numberText(bar, value) : tickTexts(std::array{value})[0];
        const float at = from_.x + width_ * placeOf(bar, value);
        const float left = std::round(at - 0.5f * widthOf(words));
        if (left < left_ + gap() || left + widthOf(words) > right_ - gap()) return;
        write(words, left);
        left_ = left + widthOf(words);
        const float half = std::max(0.5f, std::round(line() / 16) / 2);
        const float barEnd = from_.y - 0.12f * line();
        mesh_.rect({std::round(at - half), std::round(barEnd) + 1},
                   {std::round(at + half), barEnd + 0.22f * line()}, glm::vec4(kLegendQuiet, 1));
    }

    FlatMesh& mesh_;
    const Font& font_;
    FontStyle style_;
    glm::vec2 from_;
    float width_, left_ = 0, right_ = 0;
};

}  // namespace

void drawScale(FlatMesh& mesh, const Font& font, FontStyle style, const ColorBar& bar,
               glm::vec2 topLeft, float width) {
    const auto line = static_cast<float>(style.linePixels);
    const glm::vec2 from = glm::round(topLeft);
    const glm::vec2 to = from + glm::vec2(width, std::round(0.5f * line));
    drawBar(mesh, bar, from, to);
    Numbers(mesh, font, style, {from.x, to.y + 0.12f * line}, width).ends(bar);
}

}  // namespace render
