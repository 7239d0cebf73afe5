#include "app/desktop/desktop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/desktop/check_driver.h"
#include "app/panels/figures.h"
#include "app/say.h"
#include "render/gl/debug_output.h"

namespace app::desktop {
namespace {

using namespace std::chrono_literals;

constexpr glm::ivec2 kWindowSize{1440, 900};

}  // namespace

Desktop::Desktop(Exploration& exploration, std::optional<ExportJob>& exporting)
    : window_(kWindowSize, "isochron"),
      gui_(window_, window_.contentScale()),
      exploration_(exploration),
      interface_([] { Window::wake(); }),
      fileActions_(exploration_, picture_.canvas(), exporting,
                   [this](const std::string& text) { window_.setClipboard(text); }),
      signals_([this] {
          stopped_ = true;
          Window::wake();
      }) {
    exploration_.advance(0ns);  // what is open by now is read meanwhile
    render::gl::recordErrors();
    interface_.choices().scale = fileActions_.preferences().uiScale;
    interface_.choices().frameBudget =
        std::chrono::nanoseconds(std::llround(1e6 * fileActions_.preferences().frameMilliseconds));
    interface_.choices().moving = fileActions_.preferences().moving;
    interface_.choices().movingError = fileActions_.preferences().movingError;
    interface_.choices().movingRung = fileActions_.preferences().movingRung;
    picture_.beginFrom(fileActions_.preferences().costs);
}

Desktop::End Desktop::run() {
    try {
        while (!window_.shouldClose() && !stopped_) {
            sleep();
            const Clock::time_point now = Clock::now();
            frame(now - std::exchange(last_, now));
            if (headsetAnswers()) {
                fileActions_.keep(picture_.costs());
                return End::ToHeadset;
            }
        }
    } catch (...) {
        fileActions_.rescue();
        throw;
    }
    fileActions_.keep(picture_.costs());
    fileActions_.finish();
    return End::Closed;
}

void Desktop::askForHeadset() {
    if (asked_.valid()) return;
    asked_ = std::async(std::launch::async, [] {
        auto answer = xr::Session::ask();
        Window::wake();
        return answer;
    });
}

bool Desktop::headsetAnswers() {
    if (!asked_.valid() || asked_.wait_for(0s) != std::future_status::ready) return false;
    const auto answer = asked_.get();
    const auto* none = std::get_if<xr::NoHeadset>(&answer);
    if (none != nullptr) exploration_.tell("No headset: " + none->why, true);
    return none == nullptr;
}

void Desktop::frame(std::chrono::nanoseconds dt) {
    exploration_.advance(dt);
    fileActions_.prefer(interface_.choices());
    fileActions_.goOn();  // before all is drawn: nothing else may wake it
    const glm::ivec2 size = window_.framebufferSize();
    if (size.x == 0 || size.y == 0) return;  // minimised
    const auto wanted = static_cast<float>(
        interface_.choices().scale.value_or(static_cast<double>(window_.contentScale())));
    gui_.setScale(panels::scaleWithRoom(glm::vec2(size), wanted));
    interact(dt);
    const Clock::time_point begin = Clock::now();
    bool changed = false;
    exploration_.reading([&] { changed = drawPicture(); });
    changed = gui_.finishFrame() || changed;
    drew_ = window_.takeExposed() || changed;
    if (drew_) {
        picture_.show(size, layout().picture);
        gui_.draw();
        window_.swap();
        picture_.took(Clock::now() - begin);
        checkDriver(exploration_);
    }
    title();
}

// Every event is seen by a frame of its own where it must be; only the last is drawn.
void Desktop::interact(std::chrono::nanoseconds dt) {
    for (bool first = true;; first = false) {
        if (!first) gui_.endFrame();
        const FrameInput input = gui_.beginFrame(first ? dt : 1ms);
        panels::Requests requests;
        requests.open = input.dropped;
        interface_.draw(exploration_,
                        {.window = glm::vec2(window_.framebufferSize()),
                         .theme = gui_.theme(),
                         .offers = fileActions_.offers(),
                         .outline = picture_.outline(),
                         .eye = picture_.eye(),
                         .exporting = fileActions_.exporting(),
                         .dt = first ? dt : 0ns,
                         .key = input.key,
                         .performance = picture_.performance()},
                        requests);
        exploration_.reading([&] { serve(requests); });
        if (window_.events().empty()) return;
    }
}

void Desktop::serve(const panels::Requests& requests) {
    const auto picture = exploration_.shown();
    fileActions_.serve(requests, interface_, picture ? picture_.errorOf(*picture) : std::nullopt);
    if (std::ranges::count(requests.commands, panels::Command::Headset) > 0) askForHeadset();
    const Explorer& shown = exploration_.explorer();
    picture_.wantParts(requests.errorParts);
    if (requests.hover) interface_.takeHover(picture_.readSoon(*requests.hover, shown));
    if (requests.probe)
        interface_.takeReading(picture_.read(*requests.probe, shown), requests.ruler);
}

panels::Layout Desktop::layout() {
    return panels::layoutOf(glm::vec2(window_.framebufferSize()), gui_.theme().scale,
                            interface_.choices().sideWidth);
}

bool Desktop::drawPicture() {
    const Explorer& e = exploration_.explorer();
    const glm::ivec2 size = PictureView::eyeSize(layout().picture, e.stereo.mode);
    if (size != e.size) exploration_.resize(size);
    const auto shown = exploration_.shown();
    const bool changed = picture_.draw(shown ? &*shown : nullptr, exploration_.playback().playing,
                                       ImGui::IsAnyMouseDown(), interface_.choices());
    panels::drawFigures(gui_.theme(), layout(), picture_.performance(), exploration_.series());
    return changed;
}

void Desktop::title() {
    const auto shown = exploration_.shown();
    std::string text = "isochron";
    if (shown) {
        const PointCounts* counts = exploration_.counts();
        const bool clipped = counts != nullptr && counts->inClipBox;
        text = fmt::format("{} · {} · {} · {} points{}",
                           std::filesystem::path(shown->dataset.name).filename().string(),
                           shown->dataset.variable.name,
                           timeText(*shown->dataset.variable.time, shown->step),
                           withCommas(counts != nullptr ? counts->selected : 0),
                           clipped ? " in the clip box" : "");
    }
    if (const auto opening = exploration_.opening()) text += " · opening " + *opening;
    window_.setTitle(harmless(text));
}

void Desktop::sleep() {
    std::optional<std::chrono::nanoseconds> atMost;
    const auto within = [&](std::optional<std::chrono::nanoseconds> ns) {
        if (ns) atMost = std::min(atMost.value_or(*ns), *ns);
    };
    if (restless_ > 0 || !window_.events().empty()) within(0ns);
    within(exploration_.untilNextChange());
    within(interface_.untilNextChange());
    // While it is minimised, nothing is drawn.
    if (const glm::ivec2 size = window_.framebufferSize(); size.x > 0 && size.y > 0)
        within(picture_.untilNextDraw());
    within(fileActions_.untilKept());
    if (fileActions_.exporting() || asked_.valid()) within(100ms);
    if (ImGui::GetIO().WantTextInput) within(300ms);  // its cursor blinks
    // A swap waits for the screen; where there was none nothing would.
    constexpr std::chrono::nanoseconds kWithoutSwap = 2ms;
    if (!drew_ && atMost && window_.events().empty()) atMost = std::max(*atMost, kWithoutSwap);
    const Clock::time_point before = Clock::now();
    window_.wait(atMost);
    // Woken before the time was over: by an event or by what was loaded.
    const bool woken = !atMost || (*atMost > 0ns && Clock::now() - before < *atMost);
    restless_ = woken || !window_.events().empty() ? 2 : std::max(0, restless_ - 1);
}

}  // namespace app::desktop
