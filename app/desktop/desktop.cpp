#include "app/desktop/desktop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/gl/debug_output.h"

namespace app::desktop {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr glm::ivec2 kWindowSize{1440, 900};
// A subset is refined when the picture has been at rest for so long: a hand that hesitates is not
// made to wait.
constexpr auto kRest = 150ms;
const glm::vec3 kGroundColor = glm::vec3(13, 17, 23) / 255.0f;

// What a picture depends on.
Explorer drawnOf(Explorer e) {
    const std::int64_t tick = e.play.tick;
    e.steps.reset();
    e.play = {};
    e.play.tick = tick;
    return e;
}

bool isTwoEyed(const Explorer& e) { return e.stereo.mode != Stereo::Off; }

}  // namespace

Desktop::Desktop(const ViewOptions& options)
    : window_(kWindowSize, "isochron"),
      gui_(window_, window_.contentScale()),
      exploration_({.wake = [] { Window::wake(); }}),
      interface_([] { Window::wake(); }),
      errands_(exploration_, canvas_, window_),
      pace_(33'333'333ns),
      signals_([this] {
          stopped_ = true;
          Window::wake();
      }) {
    render::gl::recordErrors();
    interface_.choices().scale = errands_.preferences().uiScale;
    interface_.choices().frameBudget =
        std::chrono::nanoseconds(std::llround(1e6 * errands_.preferences().frameMilliseconds));
    if (!options.explorer.files.empty()) exploration_.open(options.explorer);
}

void Desktop::run() {
    while (!window_.shouldClose() && !stopped_) {
        sleep();
        const Clock::time_point now = Clock::now();
        const std::chrono::nanoseconds dt = now - std::exchange(last_, now);
        if (window_.framebufferSize().x == 0 || window_.framebufferSize().y == 0) {
            exploration_.advance(dt);  // minimised: nothing is drawn
            continue;
        }
        gui_.setScale(static_cast<float>(
            interface_.choices().scale.value_or(static_cast<double>(window_.contentScale()))));
        exploration_.advance(dt);
        interact(dt);
        fitPicture();
        drawPicture();
        gui_.draw();
        window_.swap();
        render::gl::throwOnError();
        title();
        errands_.goOn(interface_.choices());
    }
    errands_.finish();
}

// Every event is seen by a frame of its own where it must be; only the last is drawn.
void Desktop::interact(std::chrono::nanoseconds dt) {
    const glm::vec2 size(window_.framebufferSize());
    for (bool first = true;; first = false) {
        if (!first) gui_.endFrame();
        const FrameInput input = gui_.beginFrame(first ? dt : 1ms);
        panels::Requests requests;
        requests.commands = input.commands;
        requests.open = input.dropped;
        const panels::Surroundings around{.window = size,
                                          .theme = gui_.theme(),
                                          .offers = errands_.offers(),
                                          .boxHalf = boxHalf_,
                                          .eye = eye_,
                                          .exporting = errands_.exporting(),
                                          .dt = first ? dt : 0ns,
                                          .performance = performance_};
        interface_.draw(exploration_, around, requests);
        serve(requests);
        if (window_.events().empty()) return;
    }
}

void Desktop::serve(panels::Requests& requests) {
    if (!requests.open.empty()) errands_.open(requests.open);
    if (requests.save) errands_.save(*requests.save);
    if (requests.exportTo) errands_.exportTo(*requests.exportTo);
    if (requests.cancelExport) errands_.cancelExport();
    for (const panels::Command command : requests.commands) {
        if (interface_.obey(exploration_, command)) continue;
        if (command == panels::Command::Screenshot) errands_.screenshot();
        if (command == panels::Command::CopyCommandLine) errands_.copyCommandLine();
    }
    if (requests.probe && eye_) interface_.takeReading(read(*requests.probe), requests.ruler);
}

// What is seen at a place of the picture, y down.
std::optional<panels::Reading> Desktop::read(glm::vec2 at) const {
    const glm::dvec2 window(static_cast<double>(at.x) + 0.5,
                            static_cast<double>(eye_->size.y) - static_cast<double>(at.y) - 0.5);
    const auto found = canvas_.probe(*eye_, window);
    if (!found) return std::nullopt;
    return panels::Reading{.index = found->index,
                           .value = found->value,
                           .position = found->coordinates,
                           .world = found->picked.world,
                           .step = report_.step};
}

// A picture is as large as the place that it has; with two eyes, each has half of it.
void Desktop::fitPicture() {
    const panels::Rect place = panels::layoutOf(glm::vec2(window_.framebufferSize()),
                                                gui_.theme().scale, interface_.choices().sideWidth)
                                   .picture;
    glm::ivec2 size(place.size());
    const Stereo mode = exploration_.explorer().stereo.mode;
    if (mode == Stereo::TopBottom)
        size.y /= 2;
    else if (mode != Stereo::Off)
        size.x /= 2;
    size = glm::max(size, glm::ivec2(16));
    if (size != exploration_.explorer().size) exploration_.resize(size);
}

bool Desktop::pictureIsCurrent(const Shown& shown) const {
    return drawn_ && drawn_->sorted == shown.sorted && drawn_->explorer == drawnOf(shown.explorer);
}

void Desktop::drawPicture() {
    const glm::ivec2 window = window_.framebufferSize();
    const auto shown = exploration_.shown();
    if (!shown) {
        render::showGround(window, kGroundColor);
        return;
    }
    const bool current = pictureIsCurrent(*shown);
    if (!current) changed_ = Clock::now();
    const bool resting = Clock::now() - changed_ >= kRest && !exploration_.playback().playing;
    const glm::ivec2 eyeSize = shown->explorer.size;
    const glm::ivec2 stacked = !isTwoEyed(shown->explorer) ? glm::ivec2(1, 1)
                               : shown->explorer.stereo.mode == Stereo::TopBottom
                                   ? glm::ivec2(1, 2)
                                   : glm::ivec2(2, 1);
    if (!current || (!report_.whole && (resting || report_.uploaded < 1))) {
        const glm::ivec2 whole = eyeSize * stacked;
        if (!kept_ || kept_->size() != whole) kept_.emplace(whole);
        pace_.setTarget(interface_.choices().frameBudget);
        const std::vector<render::View> eyes = canvas_.eyesOf(*shown);
        report_ =
            canvas_.draw(*shown, eyes, {.splats = pace_.budget()}, !resting,
                         [&](std::size_t eye, const render::Targets& light) {
                             // The first eye is the left, or the upper one.
                             const int i = static_cast<int>(eye);
                             const glm::ivec2 at(i * (stacked.x - 1) * eyeSize.x,
                                                 (stacked.y - 1 - i * (stacked.y - 1)) * eyeSize.y);
                             present_.draw(light, kept_->framebuffer(), at);
                         });
        if (report_.gpuTime) {
            pace_.took(report_.gpuSplats, *report_.gpuTime);
            performance_.frame = *report_.gpuTime;
        }
        performance_ = {.frame = performance_.frame,
                        .budget = interface_.choices().frameBudget,
                        .drawn = report_.drawn,
                        .selected = report_.selected,
                        .gpuBytes = report_.gpuBytes,
                        .whole = report_.whole,
                        .uploaded = report_.uploaded,
                        .step = report_.step};
        drawn_ = Drawn{drawnOf(shown->explorer), shown->sorted};
        if (canvas_.lattice() != nullptr) boxHalf_ = canvas_.lattice()->boxHalf();
        eye_ = isTwoEyed(shown->explorer) ? std::nullopt : std::optional(eyes.front());
        restless_ = std::max(restless_, 1);
    }
    const panels::Rect place =
        panels::layoutOf(glm::vec2(window), gui_.theme().scale, interface_.choices().sideWidth)
            .picture;
    const int bottom = window.y - static_cast<int>(place.max.y);
    kept_->show(window, {0, bottom}, kGroundColor);
}

void Desktop::title() {
    const auto shown = exploration_.shown();
    if (!shown) return window_.setTitle("isochron");
    const PointCounts* counts = exploration_.counts();
    window_.setTitle(
        fmt::format("{} · {} · {} · {} points", fs::path(shown->dataset.name).filename().string(),
                    shown->dataset.about.name, timeText(*shown->dataset.about.time, shown->step),
                    withCommas(counts != nullptr ? counts->selected : 0)));
}

void Desktop::sleep() {
    std::optional<std::chrono::nanoseconds> atMost;
    const auto within = [&](std::chrono::nanoseconds ns) {
        atMost = std::min(atMost.value_or(ns), ns);
    };
    if (restless_ > 0 || !window_.events().empty()) within(0ns);
    if (const auto until = exploration_.untilNextChange()) within(*until);
    if (const auto until = interface_.untilNextChange()) within(*until);
    if (errands_.exporting()) within(100ms);
    if (drawn_ && !report_.whole)
        within(report_.uploaded < 1 ? 0ns : std::chrono::nanoseconds(kRest));
    if (ImGui::GetIO().WantTextInput) within(300ms);  // its cursor blinks
    const Clock::time_point before = Clock::now();
    window_.wait(atMost);
    // Woken before the time was over: by an event or by what was loaded.
    const bool woken = !atMost || (*atMost > 0ns && Clock::now() - before < *atMost);
    restless_ = woken || !window_.events().empty() ? 2 : std::max(0, restless_ - 1);
}

}  // namespace app::desktop
