// All panels of the window, and what keys mean to them. Pure ImGui: whoever has an ImGui frame, a
// window's or a headset's, draws it.
#pragma once

#include <chrono>
#include <functional>
#include <optional>

#include "app/panels/animation_page.h"
#include "app/panels/file_panel.h"
#include "app/panels/focus.h"
#include "app/panels/help.h"
#include "app/panels/histogram_panel.h"
#include "app/panels/hover_tip.h"
#include "app/panels/layers_panel.h"
#include "app/panels/messages.h"
#include "app/panels/panel_context.h"
#include "app/panels/picture_area.h"
#include "app/panels/probe_page.h"
#include "app/panels/start_screen.h"
#include "app/panels/time_bar.h"
#include "app/panels/view_page.h"
#include "render/points/view.h"

namespace app::panels {

// What the interface is told each frame.
struct Surroundings {
    glm::vec2 window{0};  // pixels
    const Theme& theme;
    StartOffers offers;
    render::Outline outline{glm::dmat3(0.577)};  // of what is drawn
    std::optional<render::View> eye;             // of the picture, where probes are marked
    bool hasPicture = true;                      // a headset's stands in the room
    std::optional<std::string> exporting;        // how far an export is, while one runs
    std::chrono::nanoseconds dt{0};
    std::optional<KeyPress> key = {};  // pressed since the last frame
    Performance performance;
};

class Interface {
 public:
    explicit Interface(std::function<void()> wake) : files_(std::move(wake)) {}

    // Between ImGui's NewFrame and Render. Changes `exploration` and adds to `requests`.
    void draw(Exploration& exploration, const Surroundings& around, Requests& requests);
    // What a key or a menu asked for. True when it was done here; else the front end does it.
    bool obey(Exploration& exploration, Command command);
    void takeReading(const std::optional<Reading>& reading, bool ruler) {
        probe_.take(reading, ruler);
    }
    const std::optional<Reading>& reading() const { return probe_.first(); }
    void takeHover(const std::optional<Reading>& reading) { hover_.take(reading); }

    Choices& choices() { return choices_; }
    // A folder is being read, to be shown.
    bool isListing() const { return files_.isListing(); }
    // Until the interface changes by itself.
    std::optional<std::chrono::nanoseconds> untilNextChange() const;

 private:
    void takeKey(Exploration& exploration, const std::optional<KeyPress>& key, Requests& requests);
    void keepSelection(const Explorer& now);
    void redo(Exploration& exploration);
    void forgetOtherData(const Explorer& now);
    void drawPicture(PanelContext& context, const Surroundings& around);
    void drawSide(PanelContext& context, const Surroundings& around);
    void drawTabs(PanelContext& context, const Rect& at);
    void drawEdge(PanelContext& context);
    void drawMarks(PanelContext& context, const render::View& eye) const;
    bool close(Exploration& exploration);

    Choices choices_;
    bool sweeps_ = false;  // the first layer, when it was last looked at
    Focus focus_;
    LayersPanel layers_;
    HistogramPanel histogram_;
    TimeBar timeBar_;
    AnimationPage animation_;
    ViewPage view_;
    ProbePage probe_;
    Explorer probed_;  // whose data the probe's readings are of
    PictureArea picture_;
    HoverTip hover_;
    Messages messages_;
    FilePanel files_;
    std::size_t layerRows_ = 0;  // that have room; new ones get theirs once the histogram is free
    Help help_;
    bool popup_ = false;  // one, or the files, was open as the frame began
};

}  // namespace app::panels
