#include "app/panels/interface.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/choices/view_edits.h"
#include "app/panels/error_parts.h"
#include "app/panels/header.h"
#include "app/panels/help.h"
#include "app/panels/quality_page.h"
#include "app/panels/recovery_offer.h"

namespace app::panels {
namespace {

Side sideOf(Command command) {
    switch (command) {
        case Command::Back:
            return Side::Back;
        case Command::Left:
            return Side::Left;
        case Command::Right:
            return Side::Right;
        case Command::Top:
            return Side::Top;
        case Command::Bottom:
            return Side::Bottom;
        default:
            return Side::Front;
    }
}

timeseries::Ending next(timeseries::Ending ending) {
    return static_cast<timeseries::Ending>((static_cast<int>(ending) + 1) % 3);
}

// "demo_session.json" for "demo.nc".
std::filesystem::path suggested(const Exploration& exploration, const char* ending) {
    const auto shown = exploration.shown();
    if (!shown) return ending;
    return std::filesystem::path(shown->dataset.name).stem().string() + ending;
}

// The first of the files that are open, where its folder is there.
std::filesystem::path besideShown(const Exploration& exploration) {
    const std::vector<std::filesystem::path>& files = exploration.explorer().files;
    std::error_code gone;
    if (!exploration.shown() || files.empty()) return {};
    const std::filesystem::path& first = files.front();
    return std::filesystem::is_directory(first.parent_path(), gone) ? first
                                                                    : std::filesystem::path();
}

// A cross in a ring.
void mark(ImDrawList& list, glm::vec2 at, float s) {
    list.AddCircle(im(at), 7 * s, faded(kGround, 0.8f), 24, 3.5f * s);
    list.AddCircle(im(at), 7 * s, kText, 24, 1.5f * s);
    list.AddCircleFilled(im(at), 1.8f * s, kText);
}

}  // namespace

void Interface::draw(Exploration& exploration, const Surroundings& around, Requests& requests) {
    PanelContext context{.exploration = exploration,
                         .theme = around.theme,
                         .layout = layoutOf(around.window, around.theme.scale, choices_.sideWidth),
                         .choices = choices_,
                         .requests = requests,
                         .performance = around.performance,
                         .inHeadset = !around.hasPicture};
    keepSelection(exploration.explorer());
    forgetOtherData(exploration.explorer());
    popup_ = files_.isOpen() || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
    takeKey(exploration, around.key, requests);
    ImGui::PushFont(around.theme.text);
    const bool started = exploration.shown().has_value();
    if (!started) context.layout.picture = context.layout.window;
    drawPicture(context, around);
    if (started) {
        drawSide(context, around);
        timeBar_.draw(context, context.layout.timeBar);
        // Last of those that Tab goes to: it comes and goes.
        drawErrorParts(context);
    }
    files_.draw(context);
    focus_.end(around.theme.scale);
    ImGui::PopFont();
    if (ImGui::IsMouseReleased(0) || ImGui::IsMouseReleased(2)) exploration.endGesture();
}

// A value of other data, at a step that these may not have.
// One of the layers that stand, and the same where the swept one comes or goes before them.
void Interface::keepSelection(const Explorer& now) {
    const std::size_t first = sweepOf(now) != nullptr ? 1 : 0, count = now.layers.size();
    if (first == 1 && !sweeps_) ++choices_.layer;
    if (first == 0 && sweeps_ && choices_.layer > 0) --choices_.layer;
    sweeps_ = first == 1;
    choices_.layer = std::max(first, std::min(choices_.layer, count == 0 ? 0 : count - 1));
}

// A layer that comes back is the selected one, as when it was added.
void Interface::redo(Exploration& exploration) {
    const std::vector<LayerChoice> before = exploration.explorer().layers;
    exploration.redo();
    const std::vector<LayerChoice>& now = exploration.explorer().layers;
    if (now.size() == before.size() + 1 && !now.back().motion) choices_.layer = now.size() - 1;
}

void Interface::forgetOtherData(const Explorer& now) {
    if (sameData(now, probed_)) return;
    probe_.clear();
    hover_.take({});
    probed_ = now;
}

// The control that has the focus first; else a key is a command, but for what is typed, and what
// may be meant for the fields of something that stands in front. What is about files ends typing.
void Interface::takeKey(Exploration& exploration, const std::optional<KeyPress>& key,
                        Requests& requests) {
    setFocus(focus_);
    const bool typing = ImGui::GetIO().WantTextInput;
    const bool typed = typing || focus_.expectsText() || files_.isOpen() ||
                       (popup_ && key && !key->ctrl && key->key != Key::F12);
    const bool ends = typing && key && endsTyping(*key) && !files_.isOpen();
    if (ends) Focus::endTyping();
    if (focus_.begin(ends ? std::nullopt : key, typing && !ends)) {
        if (!key->repeated) exploration.endGesture();  // a held key is one gesture, as a drag
    } else if (key && !typed && help_.take(*key)) {
        return;
    } else if (key && (ends || !typed)) {
        if (const auto command = commandOf(*key)) requests.commands.push_back(*command);
    }
}

void Interface::drawPicture(PanelContext& context, const Surroundings& around) {
    beginRegion("##picture", context.layout.picture, kClear);
    const bool shown = context.exploration.shown().has_value();
    if (shown && around.eye) drawMarks(context, *around.eye);
    if (!shown && !context.exploration.opening()) drawStartScreen(context, around.offers);
    const float s = around.theme.scale;
    float top = context.layout.picture.min.y + 14 * s;
    if (shown && !around.offers.autosave.empty())
        top = drawRecoveryOffer(context, around.offers.autosave) + 8 * s;
    drawPictureOverlay(context, top, around.exporting);
    const Rect& picture = context.layout.picture;
    if (!help_.isOpen())  // which lies over them; they wait
        messages_.draw(
            context,
            around.exporting ? exportPlace(picture, s).min.y - 8 * s : messagesBottom(picture, s),
            around.dt);
    help_.draw(context);
    // Last: ImGui gives the mouse to the first that lies under it.
    if (shown) {
        if (around.hasPicture) picture_.handle(context, around.outline);
        hover_.follow(context, help_.isOpen() || popup_ ? std::nullopt : picture_.pointer(),
                      around.dt);
        hover_.draw(context);
    }
    endRegion();
}

void Interface::drawSide(PanelContext& context, const Surroundings& around) {
    beginRegion("##side", context.layout.side, kPanel);
    const Rect& side = context.layout.side;
    ImGui::GetWindowDrawList()->AddLine({side.min.x + 0.5f, side.min.y},
                                        {side.min.x + 0.5f, side.max.y}, kLine);
    // Where there is no layer, a sentence has its row.
    if (!histogram_.isHeld())
        layerRows_ = std::max<std::size_t>(1, context.exploration.explorer().layers.size());
    const SideLayout parts = sideLayout(context.layout, layerRows_);
    drawHeader(context, parts.header, around.offers.recent);
    hairline(side.min.x, side.max.x, parts.layers.min.y);
    layers_.draw(context, parts.layers);
    hairline(side.min.x, side.max.x, parts.histogramPanel.min.y);
    histogram_.draw(context, parts.histogramPanel);
    drawTabs(context, parts.tabs);
    switch (choices_.page) {
        case Page::Animation:
            animation_.draw(context, parts.page);
            break;
        case Page::View:
            view_.draw(context, parts.page);
            break;
        case Page::Quality:
            drawQualityPage(context, parts.page);
            break;
        case Page::Probe:
            probe_.draw(context, parts.page);
            break;
    }
    drawEdge(context);
    endRegion();
}

void Interface::drawTabs(PanelContext& context, const Rect& at) {
    constexpr std::array kPages = {"Animation", "View", "Quality", "Probe"};
    const float s = context.theme.scale;
    hairline(at.min.x, at.max.x, at.min.y);
    hairline(at.min.x, at.max.x, at.max.y - 1);
    const Rect inner{{at.min.x + kMargin * s, at.min.y}, {at.max.x - kMargin * s, at.max.y}};
    const auto now = static_cast<std::size_t>(choices_.page);
    if (const int by = focus_.control(ImGui::GetID("##pages"), inner, Focus::Takes::LeftRight).by)
        choices_.page = static_cast<Page>(std::clamp<std::ptrdiff_t>(
            static_cast<std::ptrdiff_t>(now) + (by > 0 ? 1 : -1), 0, std::ssize(kPages) - 1));
    for (std::size_t i = 0; i < kPages.size(); ++i) {
        const float width = inner.size().x / kPages.size();
        const float left = inner.min.x + width * static_cast<float>(i);
        const Rect cell{{left, at.min.y}, {left + width, at.max.y}};
        const bool lit = now == i;
        const Pressing p = area(kPages[i], cell);
        if (p.pressed) focus_.touch(ImGui::GetID("##pages"));
        text(context.theme, cell.centre(), kPages[i], lit || p.hovered ? kText : kDim, 0.5f,
             lit ? context.theme.strong : context.theme.text);
        if (lit)
            ImGui::GetWindowDrawList()->AddRectFilled({cell.min.x + 14 * s, cell.max.y - 2 * s},
                                                      {cell.max.x - 14 * s, cell.max.y}, kAccent);
        if (p.clicked) choices_.page = static_cast<Page>(i);
    }
}

// The column's left edge is dragged to another width.
void Interface::drawEdge(PanelContext& context) {
    const Rect& side = context.layout.side;
    const float s = context.theme.scale;
    const Rect at{side.min, {side.min.x + kGrip * s, side.max.y}};
    const Pressing p = area("##edge", at);
    const Focus::Turn turn = focus_.control(ImGui::GetID("##edge"), at, Focus::Takes::LeftRight);
    if (p.pressed) focus_.touch(ImGui::GetID("##edge"));
    if (turn.by != 0) choices_.sideWidth = side.size().x / s - 8 * static_cast<float>(turn.by);
    if (p.hovered || p.held) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
        ImGui::GetWindowDrawList()->AddRectFilled(im(side.min), {side.min.x + 2 * s, side.max.y},
                                                  faded(kAccent, p.held ? 1.0f : 0.6f));
    }
    if (p.held) choices_.sideWidth = (context.layout.window.max.x - ImGui::GetIO().MousePos.x) / s;
}

void Interface::drawMarks(PanelContext& context, const render::View& eye) const {
    std::vector<glm::vec2> places;
    for (const std::optional<Reading>* reading : {&probe_.first(), &probe_.second()}) {
        if (!*reading) continue;
        const render::Projected at = render::project(eye, (*reading)->world);
        if (at.depth <= 0) continue;
        places.push_back(context.layout.picture.min +
                         glm::vec2(at.window.x, static_cast<double>(eye.size.y) - at.window.y));
    }
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (places.size() == 2)
        list.AddLine(im(places[0]), im(places[1]), faded(kText, 0.7f), 1.5f * context.theme.scale);
    for (const glm::vec2& place : places) mark(list, place, context.theme.scale);
}

bool Interface::obey(Exploration& exploration, Command command) {
    Explorer e = exploration.explorer();
    const auto& time = exploration.playback().time;
    const std::size_t step = time ? time->step() : 0;
    switch (command) {
        case Command::Help:
            return help_.turn(), true;
        case Command::Close:
            return close(exploration);
        case Command::Headset:
            return false;
        case Command::Open:
            return files_.ask(FilePanel::For::Open, besideShown(exploration)), true;
        case Command::Undo:
            if (exploration.canUndo()) exploration.undo();
            return true;
        case Command::Redo:
            if (exploration.canRedo()) redo(exploration);
            return true;
        default:
            break;
    }
    if (!exploration.shown()) return true;
    switch (command) {
        case Command::TogglePlay:
            return exploration.togglePlay(), true;
        case Command::StepForward:
            return exploration.stepBy(1), true;
        case Command::StepBackward:
            return exploration.stepBy(-1), true;
        case Command::FirstStep:
            return exploration.seek(0), true;
        case Command::LastStep:
            return exploration.seek(exploration.series()->stepCount() - 1), true;
        case Command::InPoint:
            setPoint(e.play.time, Point::In, step);
            break;
        case Command::OutPoint:
            setPoint(e.play.time, Point::Out, step);
            break;
        case Command::NextEnding:
            e.play.time.ending = next(e.play.time.ending);
            break;
        case Command::Fit:
            e.view = fitted(e.view);
            break;
        case Command::Front:
        case Command::Back:
        case Command::Left:
        case Command::Right:
        case Command::Top:
        case Command::Bottom:
            e.view = lookedFrom(e.view, sideOf(command));
            break;
        case Command::Projection:
            e.view.projection = e.view.projection == Projection::Perspective
                                    ? Projection::Orthographic
                                    : Projection::Perspective;
            break;
        case Command::StereoPreview:
            e.stereo.mode = e.stereo.mode == Stereo::Off ? Stereo::SideBySide : Stereo::Off;
            break;
        case Command::Save:
            files_.ask(FilePanel::For::Save, suggested(exploration, ".session.json"));
            return true;
        case Command::Export:
            files_.ask(FilePanel::For::Export, suggested(exploration, ".png"),
                       exploration.explorer().size);
            return true;
        default:
            return false;
    }
    exploration.edit(std::move(e));
    return true;
}

// What lies on top goes first. Popups and files close themselves.
bool Interface::close(Exploration& exploration) {
    if (popup_) return true;
    if (help_.isOpen())
        help_.turn();
    else if (!exploration.messages().empty())
        exploration.forgetMessage(exploration.messages().back().number);
    return true;
}

std::optional<std::chrono::nanoseconds> Interface::untilNextChange() const {
    const auto messages = help_.isOpen() ? std::nullopt : messages_.untilNextGoes();
    const auto hover = hover_.untilNextChange();
    if (!messages || !hover) return messages ? messages : hover;
    return std::min(*messages, *hover);
}

}  // namespace app::panels
