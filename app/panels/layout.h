// Where things are in the window, as pure functions of its size: panels draw there, and tests press
// there. Pixels of the framebuffer, y down, (0, 0) the upper left corner. `scale` is pixels per
// unit of the design: the monitor's content scale, or the user's own.
#pragma once

#include <algorithm>
#include <cstddef>
#include <glm/vec2.hpp>
#include <utility>

namespace app::panels {

struct Rect {
    glm::vec2 min{0}, max{0};

    glm::vec2 size() const { return max - min; }
    glm::vec2 centre() const { return 0.5f * (min + max); }
    bool holds(glm::vec2 at) const {
        return at.x >= min.x && at.y >= min.y && at.x < max.x && at.y < max.y;
    }
    friend bool operator==(const Rect&, const Rect&) = default;
};

// The picture, the figures of its frame below it, the column beside both and the bar below all.
struct Layout {
    float scale = 1;
    Rect window, picture, status, side, timeBar;
};

constexpr float kSideWidth = 400;  // as the program starts; in units of the design, as all below
constexpr float kTimeBarHeight = 60;
constexpr float kMargin = 16;
// Of the column, at its left edge, which is dragged to another width: nothing else lies there.
constexpr float kGrip = 5;

// The scale of the interface, of which so much is wanted: as much of it as leaves every part its
// room in the window, in eighths; at least 1, below which little can be read.
float scaleWithRoom(glm::vec2 window, float wanted);

// `sideWidth` as the user dragged it; kept between 320 and half of the window.
Layout layoutOf(glm::vec2 window, float scale, float sideWidth = kSideWidth);

// Below the picture, not over it: nothing of it is hidden, and no text of it met. In a narrow
// window the figures take more lines.
std::size_t statusLines(const Layout& layout);

// The side column from top to bottom. It shows all layers while there is room, and scrolls them
// where there is not.
struct SideLayout {
    Rect header, layers, histogramPanel, tabs, page;
};
constexpr float kLayersTitle = 32, kLayerRow = 58, kTabsHeight = 40;
SideLayout sideLayout(const Layout& layout, std::size_t layerRows);

// One layer's row: what can be pressed in it.
struct LayerRowLayout {
    Rect row, swatch, text, eye, remove, amount, opacity;
};
// `top`: of the row, which scrolling moves.
LayerRowLayout layerRow(const Rect& layers, float top, float scale);

// The histogram panel: bars grow left from the axis, the map lies right of it. A series of one step
// has no map.
struct HistogramLayout {
    Rect title, histogram, axis, map, times;
};
HistogramLayout histogramLayout(const Rect& histogramPanel, float scale, bool hasMap);
// The handle of an end of a range whose line is at y, left of the histogram. An upper end's stands
// above its line, a lower one's below: handles of a thin range are apart, and those of two ranges
// that meet. Within the histogram's height, also where the end is not.
Rect endHandle(const HistogramLayout& histogramPanel, float scale, float y, bool isUpper);

// The time bar: the rail lies right of the buttons and left of the settings.
struct TimeBarLayout {
    Rect back, play, forward, now, rail, ending, speed;
};
TimeBarLayout timeBarLayout(const Rect& timeBar, float scale);

// Where nothing is open yet: offers one below the other, of which the last are recent files.
struct StartLayout {
    Rect first;
    float pitch = 0;  // from an offer to the next
    Rect offer(std::size_t i) const {
        const glm::vec2 by(0, pitch * static_cast<float>(i));
        return {first.min + by, first.max + by};
    }
};
StartLayout startLayout(const Rect& picture, float scale, std::size_t recentFiles);

// Over the picture, above the notes at its lower edge, messages stack upwards. While something is
// exported, how far that is has the lowest place.
float messagesBottom(const Rect& picture, float scale);
Rect exportPlace(const Rect& picture, float scale);

// The card of all keys over the picture, so many lines in groups. `scale` is its own: all of it,
// type too, is drawn a little smaller where the picture is low; where that is not enough, what it
// holds is higher than it is, and scrolls.
struct HelpLayout {
    Rect whole;
    float scale = 1;
    float height = 0;  // of what it holds
};
constexpr float kHelpLine = 23, kHelpGroup = 14, kHelpMore = 17;
// `more`: lines that go on with the one before, where the picture is narrow.
HelpLayout helpLayout(const Rect& picture, float scale, std::size_t lines, std::size_t groups,
                      std::size_t more = 0);

// Over the picture: a session that broke off, while other data are shown. Where it has no room
// beside the picture's legend, which takes so much of its upper left corner, it lies below that.
struct RecoveryOfferLayout {
    Rect whole, goOn, discard;
};
RecoveryOfferLayout recoveryOfferLayout(const Rect& picture, float scale,
                                        glm::vec2 legend = glm::vec2(0));

// The ends of an axis that shows all from lo to hi, with a little room; both finite, lo <= hi.
std::pair<double, double> withRoom(double lo, double hi);

// A vertical axis of values: the least at the bottom.
struct ValueAxis {
    double lo = 0, hi = 1;
    float top = 0, bottom = 1;

    double valueAt(float y) const {
        const double t = static_cast<double>((bottom - y) / (bottom - top));
        return lo + t * (hi - lo);
    }
    // Cut to what is a little outside: infinite ends have a place too.
    float y(double value) const {
        const double t = std::clamp((value - lo) / (hi - lo), -1.0, 2.0);
        return bottom - static_cast<float>(t) * (bottom - top);
    }
    double perPixel() const { return (hi - lo) / static_cast<double>(bottom - top); }
};

// A horizontal axis of steps: step i has the i-th of equally wide cells.
struct StepAxis {
    std::size_t steps = 1;
    float left = 0, right = 1;

    float cell(std::size_t step) const {
        return left + (right - left) * static_cast<float>(step) / static_cast<float>(steps);
    }
    float centre(std::size_t step) const { return 0.5f * (cell(step) + cell(step + 1)); }
    std::size_t stepAt(float x) const {
        const float t = std::clamp((x - left) / std::max(1.0f, right - left), 0.0f, 1.0f);
        return std::min(steps - 1, static_cast<std::size_t>(t * static_cast<float>(steps)));
    }
};

}  // namespace app::panels
