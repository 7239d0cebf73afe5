#include "app/panels/picture_area.h"

#include <fmt/format.h>

#include <cmath>

#include "app/choices/camera.h"
#include "app/choices/view_edits.h"
#include "app/panels/widgets.h"

namespace app::panels {
namespace {

// A step may be in memory and not yet on the GPU.
std::string waitingText(const PanelContext& context) {
    std::string waiting = context.exploration.waiting();
    const auto shown = context.exploration.shown();
    if (waiting.empty() && shown && context.performance.report.uploaded < 1 &&
        context.performance.report.step != shown->step)
        waiting = fmt::format("requested step {}, showing {}", shown->step,
                              context.performance.report.step);
    return waiting;
}

// A rounded label, from `top` on; `align` as of text(). Returns where it is.
Rect pill(const PanelContext& context, glm::vec2 top, float align, std::string_view what,
          float room = 0) {
    const float s = context.theme.scale, width = widthOf(*context.theme.text, what) + 28 * s + room;
    const float left = top.x - align * width;
    const Rect at{{left, top.y}, {left + width, top.y + 32 * s}};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(im(at.min), im(at.max), faded(kField, 0.95f), 16 * s);
    list.AddRect(im(at.min), im(at.max), kLine, 16 * s);
    text(context.theme, {at.min.x + 14 * s, at.centre().y}, what);
    return at;
}

// The same with a button; returns whether that was pressed.
bool cancelPill(const PanelContext& context, glm::vec2 top, float align, std::string_view what,
                const char* id) {
    const float s = context.theme.scale;
    const Rect at = pill(context, top, align, what, 84 * s);
    return textButton(context.theme, id,
                      {{at.max.x - 78 * s, at.min.y + 4 * s}, {at.max.x - 6 * s, at.max.y - 4 * s}},
                      "Cancel");
}

}  // namespace

void PictureArea::handle(PanelContext& context, const render::Outline& outline) {
    Exploration& exploration = context.exploration;
    const Rect& at = context.layout.picture;
    const ImGuiIO& io = ImGui::GetIO();
    ImGui::SetCursorScreenPos(im(at.min));
    ImGui::InvisibleButton("##picture", im(glm::max(at.size(), glm::vec2(1))),
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle);
    pointer_.reset();
    const Explorer& shown = exploration.explorer();
    const Looking looking{outline, shown.size, legendOf(shown)};
    // With two eyes, of the one that it is over.
    const glm::dvec2 place = vec(io.MousePos) - at.min;
    const glm::dvec2 cursor = glm::mod(place, glm::dvec2(looking.size));
    if (ImGui::IsItemActivated())
        grip_ =
            io.KeyShift || ImGui::IsMouseDown(ImGuiMouseButton_Middle) ? Grip::Move : Grip::Turn;
    if (ImGui::IsItemActive() && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0)) {
        const glm::dvec2 by(static_cast<double>(io.MouseDelta.x),
                            static_cast<double>(io.MouseDelta.y));
        edit(context, "camera", [&](Explorer& e) {
            e.view =
                grip_ == Grip::Turn ? orbited(e.view, by, looking) : panned(e.view, by, looking);
        });
    }
    if (!ImGui::IsItemHovered()) return;
    if (!ImGui::IsItemActive()) pointer_ = place;
    if (io.MouseWheel != 0)
        edit(context, "zoom", [&](Explorer& e) {
            e.view =
                zoomed(e.view, std::pow(0.88, static_cast<double>(io.MouseWheel)), cursor, looking);
        });
    if (ImGui::IsMouseDoubleClicked(0)) {
        context.requests.probe = glm::vec2(place);
        context.requests.ruler = io.KeyShift;
        context.choices.page = Page::Probe;
    }
}

void drawPictureOverlay(PanelContext& context, float top,
                        const std::optional<std::string>& exporting) {
    Exploration& exploration = context.exploration;
    const Rect& picture = context.layout.picture;
    const float s = context.theme.scale, middle = picture.centre().x;
    float y = top;
    if (const auto opening = exploration.opening()) {
        const std::string what =
            fitting(*context.theme.text, "Opening " + *opening, picture.size().x - 140 * s);
        if (cancelPill(context, {middle, y}, 0.5f, what, "##opening")) exploration.cancelOpening();
        y += 40 * s;
    }
    if (const std::string waiting = waitingText(context); !waiting.empty())
        pill(context, {middle, y}, 0.5f, waiting);
    if (exporting) {
        // For as long as it takes: not at the top, where the legend is.
        const Rect place = exportPlace(picture, s);
        const std::string what = fitting(*context.theme.text, *exporting, place.size().x - 112 * s);
        if (cancelPill(context, {place.max.x, place.min.y}, 1, what, "##exporting"))
            context.requests.cancelExport = true;
    }
}

}  // namespace app::panels
