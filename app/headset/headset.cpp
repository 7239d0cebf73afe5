#include "app/headset/headset.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "app/desktop/check_driver.h"
#include "app/headset/help_text.h"
#include "app/headset/placards.h"
#include "app/headset/readout.h"
#include "render/gl/debug_output.h"

namespace app::headset {
namespace {

using namespace std::chrono_literals;

constexpr auto kLongestFrame = 100ms;  // after a pause of the runtime, play goes on, not ahead

}  // namespace

std::variant<std::unique_ptr<Headset>, xr::NoHeadset> Headset::open(
    Exploration& exploration, std::optional<ExportJob>& exporting) {
    // Cheap, and no window comes up for it.
    const auto offer = xr::Session::ask();
    if (const auto* none = std::get_if<xr::NoHeadset>(&offer)) return *none;
    auto graphics = std::make_unique<Graphics>(std::get<xr::Session::Offer>(offer));
    auto session = xr::Session::open(graphics->binding());
    if (auto* none = std::get_if<xr::NoHeadset>(&session)) return std::move(*none);
    render::gl::forgetErrors();  // the runtime's
    return std::unique_ptr<Headset>(
        new Headset(exploration, exporting, std::move(graphics),
                    std::get<std::unique_ptr<xr::Session>>(std::move(session))));
}

Headset::Headset(Exploration& exploration, std::optional<ExportJob>& exporting,
                 std::unique_ptr<Graphics> graphics, std::unique_ptr<xr::Session> session)
    : exploration_(exploration),
      graphics_(std::move(graphics)),
      session_(std::move(session)),
      eyes_(session_->refreshRates()),
      panel_([] {}),
      fileActions_(exploration_, eyes_.canvas(), exporting,
                   [this](const std::string& text) {
                       if (desktop::Window* window = graphics_->window())
                           window->setClipboard(text);
                   }),
      signals_([this] { stopped_ = true; }) {
    eyes_.beginFrom(fileActions_.preferences().costs);
}

void Headset::run() {
    try {
        while (frame()) {
        }
    } catch (...) {
        fileActions_.rescue();
        throw;
    }
    fileActions_.finish();
}

// The runtime draws with the same context: its errors are no complaint about our picture.
bool Headset::frame() {
    if (stopped_.exchange(false)) session_->requestExit();
    attendWindow();
    const std::unique_ptr<xr::Session::Frame> frame = session_->beginFrame();
    render::gl::forgetErrors();  // the runtime's
    if (session_->ended()) return false;
    const Clock::time_point began = Clock::now();
    const std::chrono::nanoseconds dt = frame ? since(frame->displayTime()) : 0ns;
    // What plays, plays for who can stop it.
    exploration_.advance(session_->state().focused() ? dt : 0ns);
    if (!frame) return true;
    timing_ = {frame->displayTime(), frame->period(), frame->shouldRender()};
    exploration_.reading([&] { act(*frame, dt); });
    if (frame->shouldRender()) {
        drawBoards(*frame, dt);
        exploration_.reading([&] { drawEyes(*frame, began); });
    }
    fileActions_.goOn();
    return true;
}

void Headset::attendWindow() {
    desktop::Window* window = graphics_->window();
    if (window == nullptr) return;
    window->poll();
    window->events().clear();
    if (window->shouldClose() && !std::exchange(leaving_, true)) session_->requestExit();
}

// How long after the frame before this one will be seen.
std::chrono::nanoseconds Headset::since(std::chrono::nanoseconds displayTime) {
    const auto last = std::exchange(lastDisplay_, displayTime);
    if (!last) return 0ns;
    return std::clamp<std::chrono::nanoseconds>(displayTime - *last, 0ns, kLongestFrame);
}

void Headset::act(const xr::Session::Frame& frame, std::chrono::nanoseconds dt) {
    HandInput input{.hands = frame.hands(),
                    .head = frame.head(),
                    .dt = dt,
                    .drawn = {},
                    .asked = std::exchange(asked_, std::nullopt)};
    // What is still before the eyes of other data is not there for hands.
    if (eyes_.canvas().shows(exploration_.explorer())) input.drawn = eyes_.canvas().drawn();
    // What comes first is placed before it is drawn.
    std::optional<render::PlacedPoints> first;
    if (const auto shown = exploration_.shown(); shown && !input.drawn) {
        first.emplace(shown->sorted->grid(), shown->explorer.scale, shown->explorer.map);
        input.drawn = Drawn{&*first, shown->sorted, shown->step};
    }
    const HandOutcome outcome = interaction_.update(exploration_, input);
    for (const Pulse& pulse : outcome.pulses)
        session_->vibrate(pulse.hand, pulse.amplitude, pulse.duration);
    if (outcome.reading) {
        panel_.interface().takeReading(outcome.reading, false);
        panel_.interface().choices().page = panels::Page::Probe;
    }
}

void Headset::drawBoards(const xr::Session::Frame& frame, std::chrono::nanoseconds dt) {
    std::string text = readoutText(exploration_,
                                   {eyes_.canvas().screen(), eyes_.report().counts,
                                    error_.text(drawn()), eyes_.report().mixesColors},
                                   interaction_.tip(), eyes_.scale());
    if (const std::string rate = eyes_.refreshRate().loweredText(); !rate.empty())
        text += "\n" + rate;
    readout_.write(text);
    parts_ = Parts::None;
    if (!interaction_.panel()) return;
    Panel::Around around{.offers = fileActions_.offers(),
                         .help = helpText(session_->runtimeName(), session_->controls()),
                         .exporting = fileActions_.exporting(),
                         .performance = performance(frame),
                         .buttons = {.canUndo = interaction_.canUndoMove(),
                                     .clipsByHand = interaction_.clipsByHand()}};
    const Panel::Asked asked = panel_.draw(exploration_, interaction_.pointer(), around, dt);
    asked_ = asked.interaction;
    if (asked.requests.errorParts) parts_ = Parts::All;
    // What is saved is drawn whole.
    fileActions_.serve(asked.requests, panel_.interface(), error_.of(exploration_.explorer()));
}

// Of now and then: numbers that change with every frame cannot be read, and the panel would be
// drawn for each, which takes as long as half a frame's splats (tests/bench/NOTES.md).
const panels::Performance& Headset::performance(const xr::Session::Frame& frame) {
    const CanvasReport& report = eyes_.report();
    const bool waits = frame.displayTime() - performanceOf_ < 2s;
    const CanvasReport& told = performance_.report;
    if (waits && told.whole == report.whole && told.step == report.step &&
        told.selected == report.selected &&
        performance_.errors.has_value() == error_.errors().has_value())
        return performance_;
    performanceOf_ = frame.displayTime();
    performance_ = {eyes_.work(), frame.period(), report, 0, error_.errors()};
    return performance_;
}

// As the picture before the eyes has it.
Rung Headset::drawn() const { return panels::Performance{.report = eyes_.report()}.drawn(); }

std::vector<render::Placard> Headset::placards(const xr::Session::Frame& frame) const {
    Boards boards{
        .panel = nullptr, .readout = &readout_.board(), .readoutHalf = readout_.half(), .kept = {}};
    if (interaction_.panel()) boards.panel = &panel_.board();
    if (const auto& kept = panel_.interface().reading()) boards.kept = kept->world;
    return placardsOf(interaction_, frame.hands(), *frame.head(), boards);
}

void Headset::drawEyes(xr::Session::Frame& frame, Clock::time_point began) {
    checkDriver(exploration_);
    const std::span<const xr::Eye> eyes = frame.eyes(eyes_.scale());
    render::gl::forgetErrors();  // the runtime's
    if (eyes.empty() || !frame.head()) return;
    const auto shown = exploration_.shown();
    const DepthErrors* const errors = error_.errors() ? &*error_.errors() : nullptr;
    eyes_.draw(
        shown ? &*shown : nullptr, eyes, interaction_.placement(), placards(frame),
        Eyes::Splats::Governed,
        [&](render::Targets& light) { graphics_->mirror(eyes_.present(), light); }, errors,
        panels::askedOfMoving(panel_.interface().choices(), errors));
    checkDriver(exploration_);
    if (const Screen* const screen = eyes_.canvas().screen())
        error_.update(*screen, viewOf(eyes.front(), interaction_.placement()), Clock::now(),
                      parts_);
    eyes_.took(began, frame.period());
    if (const auto rate = eyes_.refreshRate().wanted()) session_->requestRefreshRate(*rate);
    frame.submit(kNear, kFar);
}

}  // namespace app::headset
