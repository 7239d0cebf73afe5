// What the panels share: the exploration that they show and change, how the interface looks, and
// what only the front end can do.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/choices/preferences.h"
#include "app/drawing/canvas_report.h"
#include "app/exploration/exploration.h"
#include "app/exploration/reading.h"
#include "app/panels/keys.h"
#include "app/panels/layout.h"
#include "app/panels/theme.h"
#include "app/picture/depth_error.h"

namespace app::panels {

enum class Page { Animation, View, Quality, Probe };

// The picture on the screen, and how long it took: all of one frame.
struct Performance {
    std::chrono::nanoseconds frame{0}, budget{0};
    CanvasReport report = {};
    std::uint64_t picture = 0;  // another number, another picture
    // Of ways to draw its selection, once they are known, also of another view or step.
    std::optional<DepthErrors> errors = {};
    bool isErrorOfAnother = false;

    Rung drawn() const {
        return {report.cells ? Model::Cells : Model::Points, report.stride, report.across};
    }
    // Of what is drawn, null where it is not known.
    const RungError* told() const { return errors ? errors->find(drawn()) : nullptr; }
    std::optional<double> error() const { return errors ? errors->of(drawn()) : std::nullopt; }
};

// What the user chose of the interface itself: no part of a picture, not undone.
struct Choices {
    std::size_t layer = 0;  // the selected one; as many as there are where none stands
    Page page = Page::Animation;
    std::chrono::nanoseconds frameBudget{33'333'333};
    Moving moving = Moving::Pace;
    double movingError = 0.03;
    Rung movingRung = {};
    std::optional<double> scale;  // of the interface; absent: the monitor's
    float sideWidth = kSideWidth;
};

// How a picture that moves is to be drawn, by what is known of its errors; none where the pace is
// to say, or the error is not known.
std::optional<Rung> askedOfMoving(const Choices& choices, const DepthErrors* errors);

// What panels ask of the front end, which serves and clears it.
struct Requests {
    std::vector<Command> commands;
    std::vector<std::filesystem::path> open;
    std::optional<std::filesystem::path> save;
    struct Export {
        std::filesystem::path output;
        glm::ivec2 size{0};  // of its pictures
    };
    std::optional<Export> exportTo;
    bool cancelExport = false;
    bool discardLeft = false;        // the session that broke off and is offered
    std::optional<glm::vec2> probe;  // where to read, in pixels of the picture, y down
    bool ruler = false;              // the reading asked for is another end of the ruler
    std::optional<glm::vec2> hover;  // likewise, for a look that must be quick
    bool errorParts = false;         // what the picture's error comes from is looked at
};

struct PanelContext {
    Exploration& exploration;
    const Theme& theme;
    Layout layout;
    Choices& choices;
    Requests& requests;
    const Performance& performance;
    bool inHeadset = false;  // where there is none to go into
};

// Applies `change` to a copy of the explorer, as one edit; see History::edit for `gesture`.
template <typename Change>
void edit(PanelContext& context, std::string_view gesture, const Change& change) {
    Explorer next = context.exploration.explorer();
    change(next);
    context.exploration.edit(std::move(next), gesture);
}

// Begins a window of ImGui that is nothing but a rectangle to draw in.
// One that is not fixed among the others comes to the front when it is focused.
enum class Depth { Fixed, Front };
void beginRegion(const char* id, const Rect& at, ImU32 background, Depth depth = Depth::Fixed);
void endRegion();

}  // namespace app::panels
