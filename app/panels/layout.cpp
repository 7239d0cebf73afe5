#include "app/panels/layout.h"

#include <cmath>
#include <glm/common.hpp>

namespace app::panels {
namespace {

Rect box(float x0, float y0, float x1, float y1) { return {{x0, y0}, {x1, y1}}; }
// Whole pixels keep lines and text crisp.
Rect crisp(const Rect& r) { return {glm::floor(r.min), glm::floor(r.max)}; }

constexpr float kStatusLine = 18, kStatusRoom = 8;
// What the figures say is about 1000 long in one line, 700 in two, 600 in three.
std::size_t statusLinesFor(float width) {
    return width >= 1000 ? 1 : width >= 700 ? 2 : width >= 600 ? 3 : 4;
}

}  // namespace

float scaleWithRoom(glm::vec2 window, float wanted) {
    // What the bar below needs across, and the column from top to bottom.
    constexpr glm::vec2 kLeast(720, 450);
    const glm::vec2 room = glm::floor(8.0f * window / kLeast) / 8.0f;
    return std::min(wanted, std::max(1.0f, std::min(room.x, room.y)));
}

Layout layoutOf(glm::vec2 window, float scale, float sideWidth) {
    const float side = std::clamp(sideWidth * scale, std::min(320 * scale, 0.5f * window.x),
                                  std::max(320 * scale, 0.5f * window.x));
    const float column = std::floor(std::max(0.0f, window.x - side));
    const float bar = std::floor(std::max(0.0f, window.y - kTimeBarHeight * scale));
    const auto lines = static_cast<float>(statusLinesFor(column / scale));
    const float status =
        std::floor(std::max(0.0f, bar - (kStatusLine * lines + kStatusRoom) * scale));
    return {.scale = scale,
            .window = {{0, 0}, window},
            .picture = box(0, 0, column, status),
            .status = box(0, status, column, bar),
            .side = box(column, 0, window.x, bar),
            .timeBar = box(0, bar, window.x, window.y)};
}

std::size_t statusLines(const Layout& layout) {
    return statusLinesFor(layout.status.size().x / layout.scale);
}

SideLayout sideLayout(const Layout& layout, std::size_t layerRows) {
    constexpr float kHeader = 90, kLeastHistogram = 212, kHistogram = 290, kLeastPage = 140,
                    kPage = 316, kLeastRows = 2.1f;
    // Where a large scale leaves no room for that: the tabs stay in the window, for behind one of
    // them the scale is chosen.
    constexpr float kTightHistogram = 100, kTightPage = 60;
    const float s = layout.scale;
    const Rect& side = layout.side;
    const float rest = side.size().y / s - kHeader - kTabsHeight;
    const float rows = kLayersTitle + kLayerRow * static_cast<float>(layerRows) + 8;
    const float fewRows = std::clamp(rest - kTightHistogram - kTightPage, kLayersTitle,
                                     kLayersTitle + kLeastRows * kLayerRow);
    const float layers = std::min(rows, std::max(fewRows, rest - kLeastHistogram - kLeastPage));
    const float leastPage = std::clamp(rest - layers - kLeastHistogram, kTightPage, kLeastPage);
    const float page = std::clamp(rest - layers - kHistogram, leastPage, kPage);
    float top = side.min.y;
    const auto next = [&](float height) {
        const Rect r = crisp(box(side.min.x, top, side.max.x, top + height * s));
        top += height * s;
        return r;
    };
    SideLayout out;
    out.header = next(kHeader);
    out.layers = next(layers);
    out.histogramPanel = next(std::max(kTightHistogram, rest - layers - page));
    out.tabs = next(kTabsHeight);
    out.page = next(page);
    return out;
}

LayerRowLayout layerRow(const Rect& layers, float top, float scale) {
    const float s = scale, left = layers.min.x + kMargin * s, right = layers.max.x - kMargin * s;
    const float line = top + 6 * s, height = 26 * s, second = line + height + 2 * s;
    LayerRowLayout out;
    out.row = crisp(box(layers.min.x, top, layers.max.x, top + kLayerRow * s));
    out.swatch = crisp(box(left, line, left + 26 * s, line + height));
    out.remove = crisp(box(right - 24 * s, line, right, line + height));
    out.eye = crisp(box(right - 50 * s, line, right - 26 * s, line + height));
    out.text = crisp(box(left + 34 * s, line, right - 56 * s, line + height));
    out.amount = crisp(box(left + 34 * s, second, right - 138 * s, second + 20 * s));
    out.opacity = crisp(box(right - 132 * s, second, right, second + 20 * s));
    return out;
}

HistogramLayout histogramLayout(const Rect& histogramPanel, float scale, bool hasMap) {
    const float s = scale, left = histogramPanel.min.x + kMargin * s,
                right = histogramPanel.max.x - kMargin * s;
    const float top = histogramPanel.min.y + 34 * s, bottom = histogramPanel.max.y - 26 * s;
    const float gutter = 52 * s;
    const float bars = hasMap ? 0.36f * (right - left - gutter) : right - left - gutter;
    const float axis = left + bars, map = axis + gutter;
    HistogramLayout out;
    out.title = crisp(box(left, histogramPanel.min.y + 6 * s, right, top - 4 * s));
    out.histogram = crisp(box(left, top, axis, bottom));
    out.axis = crisp(box(axis, top, map, bottom));
    out.map = crisp(box(map, top, hasMap ? right : map, bottom));
    out.times = crisp(box(map, bottom + 3 * s, right, histogramPanel.max.y - 4 * s));
    return out;
}

Rect endHandle(const HistogramLayout& histogramPanel, float scale, float y, bool isUpper) {
    const Rect& bars = histogramPanel.histogram;
    const float height = 11 * scale, right = bars.min.x - scale;
    const float top = std::clamp(y - (isUpper ? height : 0), bars.min.y,
                                 std::max(bars.min.y, bars.max.y - height));
    return crisp({{right - (kMargin - kGrip - 1) * scale, top}, {right, top + height}});
}

TimeBarLayout timeBarLayout(const Rect& timeBar, float scale) {
    const float s = scale, middle = timeBar.centre().y;
    const auto button = [&](float x, float half) {
        return crisp(box(timeBar.min.x + (x - half) * s, middle - half * s,
                         timeBar.min.x + (x + half) * s, middle + half * s));
    };
    TimeBarLayout out;
    out.back = button(30, 14);
    out.play = button(66, 18);
    out.forward = button(102, 14);
    const float now = timeBar.min.x + 128 * s, right = timeBar.max.x - kMargin * s;
    const float width = std::clamp(0.16f * timeBar.size().x, 165 * s, 190 * s);
    out.now = crisp(box(now, middle - 20 * s, now + width, middle + 20 * s));
    out.speed = crisp(box(right - 92 * s, middle - 14 * s, right, middle + 14 * s));
    out.ending = crisp(box(right - 128 * s, middle - 14 * s, right - 100 * s, middle + 14 * s));
    out.rail = crisp(box(now + width + 12 * s, middle - 16 * s, right - 144 * s, middle + 16 * s));
    return out;
}

StartLayout startLayout(const Rect& picture, float scale, std::size_t recentFiles) {
    const float s = scale, width = std::min(520 * s, picture.size().x - 2 * kMargin * s);
    const float height = (230 + 46 * static_cast<float>(recentFiles)) * s;
    const float left = picture.centre().x - 0.5f * width;
    const float top = std::max(picture.min.y + 40 * s, picture.centre().y - 0.5f * height) + 60 * s;
    return {.first = box(left, top, left + width, top + 40 * s), .pitch = 46 * s};
}

float messagesBottom(const Rect& picture, float scale) { return picture.max.y - 76 * scale; }

Rect exportPlace(const Rect& picture, float scale) {
    const float bottom = messagesBottom(picture, scale), margin = kMargin * scale;
    return crisp(box(picture.min.x + margin, bottom - 32 * scale, picture.max.x - margin, bottom));
}

HelpLayout helpLayout(const Rect& picture, float scale, std::size_t lines, std::size_t groups,
                      std::size_t more) {
    const float wanted = 56 + static_cast<float>(lines) * kHelpLine +
                         static_cast<float>(groups) * kHelpGroup +
                         static_cast<float>(more) * kHelpMore;
    constexpr float kLeast = 0.85f;  // that can still be read
    const glm::vec2 room = picture.size() - 24 * scale;
    const float s = std::clamp(room.y / wanted, kLeast * scale, scale), height = wanted * s;
    const glm::vec2 half = 0.5f * glm::min(glm::vec2(620 * scale, height), room);
    return {{glm::floor(picture.centre() - half), glm::floor(picture.centre() + half)}, s, height};
}

RecoveryOfferLayout recoveryOfferLayout(const Rect& picture, float scale, glm::vec2 legend) {
    const float s = scale, half = std::min(170 * s, 0.5f * picture.size().x - 8 * s);
    const float x = picture.centre().x, right = x + half;
    const bool isBeside = x - half >= picture.min.x + legend.x;
    const float y = picture.min.y + (isBeside ? 14 * s : std::max(14 * s, legend.y + 8 * s));
    return {.whole = crisp(box(x - half, y, right, y + 32 * s)),
            .goOn = crisp(box(right - 106 * s, y + 4 * s, right - 36 * s, y + 28 * s)),
            .discard = crisp(box(right - 32 * s, y + 4 * s, right - 8 * s, y + 28 * s))};
}

std::pair<double, double> withRoom(double lo, double hi) {
    const double room =
        hi > lo ? 0.5 * (0.04 * hi - 0.04 * lo) : std::max(0.5, 1e-3 * std::abs(lo));
    return {lo - room, hi + room};
}

}  // namespace app::panels
