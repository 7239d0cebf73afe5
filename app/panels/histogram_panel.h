// Value and time at once: a histogram of the step shown beside a map of how many points have which
// value at which time. Layers are bands across both, to be made, moved and resized by dragging; the
// swept window, the animation's range and what was kept are drawn apart from them.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/choices/edits.h"
#include "app/exploration/value_map.h"
#include "app/panels/panel_context.h"
#include "app/panels/widgets.h"

namespace app::panels {

class HistogramPanel {
 public:
    void draw(PanelContext& context, const Rect& at);
    // A drag goes on: until it ends the panel stays where it is, for values are read off its
    // place.
    bool isHeld() const { return grab_.grip != Grip::None; }

    // The values shown, from the bottom to the top.
    std::pair<double, double> values(const PanelContext& context) const;

 private:
    enum class Grip {
        None,
        Lo,
        Hi,
        Band,
        Undecided,  // a band pressed on the map: moved up or down, or time is scrubbed
        Background,
        NewRange,
        Scrub,
        AnimationLo,
        AnimationHi,
        Window,
        Pan
    };
    struct Grab {
        Grip grip = Grip::None;
        std::size_t layer = 0, range = 0;
        glm::vec2 pressedAt{0};
        double valueAt = 0;                // where it was pressed
        float off = 0;                     // pixels from the end that is dragged to there
        timeseries::RangeSet ranges = {};  // as they were then
        bool newLayer = false;
        std::pair<double, double> values = {};
    };
    struct Drawing;  // what one draw() works out before it draws

    Grab gripAt(const Drawing& f, glm::vec2 mouse) const;
    void drag(const Drawing& f, glm::vec2 mouse);
    void dragNew(const Drawing& f, glm::vec2 mouse);
    void zoom(const Drawing& f, glm::vec2 mouse);
    void drawTitle(const Drawing& f);
    using ColorOfValue = std::function<ImU32(double value)>;
    using Painter = std::function<void(const ColorOfValue&)>;
    void drawInColors(const Drawing& f, const Painter& paint) const;
    void drawCounts(const Drawing& f, double most) const;
    void drawHistogram(const Drawing& f) const;
    void drawMap(const Drawing& f) const;
    void drawColumn(const Drawing& f, const Rect& strip, const std::vector<double>& counts,
                    double most, const ColorOfValue& color) const;
    void drawBands(const Drawing& f, const Grab& hovered) const;
    // histogram_panel_ends.cpp
    static Rect reach(const Drawing& f);  // where the mouse is the panel's
    static Rect handleOf(const Drawing& f, double value, End end);
    void forEachEnd(const Drawing& f,
                    const std::function<void(std::size_t layer, std::size_t range, End end,
                                             double value)>& visit) const;
    void drawEnds(const Drawing& f, const Grab& hovered) const;
    void moveEndsByKeys(const Drawing& f);
    void drawSweep(const Drawing& f) const;
    void drawAxis(const Drawing& f) const;
    void drawTime(const Drawing& f) const;
    std::string hoverText(const Drawing& f, glm::vec2 mouse) const;
    void refresh(Exploration& exploration, const Drawing& f);

    std::optional<std::pair<double, double>> zoomed_;
    bool linear_ = false;
    Grab grab_;
    std::string readout_;

    // Kept from frame to frame while what they come from stays.
    struct Column {
        const timeseries::StepSummary* summary = nullptr;
        std::vector<double> counts;
    };
    std::weak_ptr<const timeseries::SortedStep> countedStep_;
    std::vector<std::uint64_t> counts_;
    AtInfinity infinite_;  // of the counted step; in its outer counts
    std::vector<Column> columns_;
    ValueAxis axis_;
    std::string of_;  // file, variable and what is kept of it
};

}  // namespace app::panels
