#include "app/desktop/picture_view.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

namespace app::desktop {
namespace {

using namespace std::chrono_literals;

// A slice of a picture at rest, of frames: the window around it is drawn once for twice as much.
constexpr int kSlice = 2;
// Of a frame, what a picture that moves is to fill: the rest is for the interface around it, and
// for frames that are slower than those before.
constexpr double kMovingShare = 0.8;
// What is expected to take no longer is drawn in one slice: one frame's wait seems none.
constexpr auto kAtOnce = 100ms;
const glm::vec3 kGroundColor = glm::vec3(13, 17, 23) / 255.0f;

// What a picture depends on.
Explorer drawnOf(Explorer e) {
    const std::int64_t tick = e.play.tick;
    e.steps.reset();
    e.play = {};
    e.play.tick = tick;
    return e;
}

// What an error is of, from wherever it is seen.
Explorer selectionOf(Explorer drawn) {
    drawn.view = {};
    drawn.play = {};
    return drawn;
}

std::chrono::nanoseconds movingTarget(std::chrono::nanoseconds frame) {
    return std::chrono::nanoseconds(
        std::llround(kMovingShare * static_cast<double>(frame.count())));
}

// How many eyes' pictures stand beside and above each other.
glm::ivec2 tiles(Stereo mode) {
    if (mode == Stereo::Off) return {1, 1};
    return mode == Stereo::TopBottom ? glm::ivec2(1, 2) : glm::ivec2(2, 1);
}

}  // namespace

glm::ivec2 PictureView::eyeSize(const panels::Rect& place, Stereo mode) {
    return glm::max(glm::ivec2(place.size()) / tiles(mode), glm::ivec2(16));
}

bool PictureView::isCurrent(const Shown& shown) const {
    return content_ && content_->sorted == shown.sorted &&
           content_->explorer == drawnOf(shown.explorer);
}

bool PictureView::draw(const Shown* shown, bool playing, bool held,
                       const panels::Choices& choices) {
    const bool was = std::exchange(isThere_, shown != nullptr);
    if (!isThere_) return was;
    playing_ = playing;
    partsCame_ = std::max(partsCame_ - 1, 0);
    const bool current = isCurrent(*shown);
    rest_.frame(!current, held, Clock::now());
    const bool resting = !playing && rest_.is(Clock::now());
    const bool arriving = current && report_.uploaded < 1;
    if (!current || arriving || (!isDone() && resting && !canvas_.waitsForGradients())) {
        redraw(*shown, resting && !arriving, choices);
        return true;
    }
    if (resting && waitsForError()) tellError();
    return !was;
}

void PictureView::show(glm::ivec2 window, const panels::Rect& place) const {
    if (!isThere_) return render::showGround(window, kGroundColor);
    kept_->show(window, {0, window.y - static_cast<int>(place.max.y)}, kGroundColor);
}

void PictureView::redraw(const Shown& shown, bool resting, const panels::Choices& choices) {
    error_.forget();
    const Explorer& e = shown.explorer;
    const std::chrono::nanoseconds frameBudget = choices.frameBudget;
    const glm::ivec2 grid = tiles(e.stereo.mode), whole = e.size * grid;
    if (!kept_ || kept_->size() != whole) kept_.emplace(whole);
    if (!resting)
        slices_.reset();
    else if (!slices_)
        slices_.emplace(kSlice * frameBudget, firstSlice(kSlice * frameBudget));
    if (slices_) {
        slices_->setTarget(kSlice * frameBudget);
        governor_.cells().setTarget(kSlice * frameBudget);
    } else {
        governor_.setTarget(movingTarget(frameBudget));
    }
    const CanvasLimits limits =
        slices_ ? CanvasLimits{.splats = slices_->budget(), .cells = governor_.cells().budget()}
                : moving(e, choices);
    eyes_ = canvas_.eyesOf(shown);
    grid_ = grid;
    const auto show = [&](std::size_t eye, render::Targets& light) {
        // The first eye's picture is the left, or the upper one.
        const auto i = static_cast<int>(eye);
        const glm::ivec2 tile(i * (grid.x - 1), (1 - i) * (grid.y - 1));
        present_.draw(light, *kept_, tile * e.size);
    };
    report_ = resting ? canvas_.refine(shown, eyes_, limits, show)
                      : canvas_.draw(shown, eyes_, limits, true, show);
    // What is told is of an earlier frame: one that drew nothing says nothing of this one.
    timed_ = report_.gpuTime && report_.gpuSplats > 0;
    if (report_.gpuTime && slices_ && !report_.gpuCells)
        slices_->took(report_.gpuSplats, *report_.gpuTime);
    else if (report_.gpuTime)
        governor_.took({report_.gpuSplats, report_.gpuCells}, *report_.gpuTime);
    if (timed_) performance_.frame = *report_.gpuTime;
    performance_ = {performance_.frame, frameBudget, report_, performance_.picture + 1};
    content_ = Content{drawnOf(e), shown.sorted};
    predictError();
    if (const auto drawn = canvas_.drawn()) outline_ = drawn->placed->outline();
}

std::uint64_t PictureView::firstSlice(std::chrono::nanoseconds slice) const {
    const std::uint64_t atOnce = governor_.points().fitting(kAtOnce);
    return report_.selected * eyes_.size() <= atOnce ? atOnce : governor_.points().fitting(slice);
}

CanvasLimits PictureView::moving(const Explorer& explorer, const panels::Choices& choices) const {
    const bool isKnown = errorsOf_ == selectionOf(drawnOf(explorer)) && errors_;
    const DepthErrors* const errors = isKnown ? &*errors_ : nullptr;
    CanvasLimits limits = governor_.limits(errors);
    limits.rung = panels::askedOfMoving(choices, errors);
    return limits;
}

bool PictureView::waitsForError() const {
    const bool isTold = measured_ && (parts_ == Parts::None || *measured_ == Parts::All);
    return content_ && isDone() && !isTold && !eyes_.empty() && hasDepthError(*content_->sorted);
}

void PictureView::tellError() {
    auto errors = error_.of({content_->sorted, content_->explorer, eyes_.front(), parts_});
    if (!errors) return;
    errors_ = std::move(errors);
    errorsOf_ = selectionOf(content_->explorer);
    predictError();
    performance_.isErrorOfAnother = false;
    measured_ = parts_;
    partsCame_ = parts_ == Parts::All ? 3 : 0;
}

// Steps of a series and views of a step are alike enough for the figure that is told.
void PictureView::predictError() {
    measured_.reset();
    performance_.errors =
        errorsOf_ == selectionOf(content_->explorer) ? errors_ : std::optional<DepthErrors>();
    if (const auto& step = *content_->sorted; !hasDepthError(step))
        performance_.errors.emplace().whyNone = step.whyNoCells();
    performance_.isErrorOfAnother = true;
}

void PictureView::took(std::chrono::nanoseconds frame) {
    if (!std::exchange(timed_, true)) performance_.frame = frame;
}

std::optional<std::chrono::nanoseconds> PictureView::untilNextDraw() const {
    if (partsCame_ > 0) return 0ns;
    if (!content_ || (isDone() && (playing_ || !waitsForError()))) return std::nullopt;
    const bool goesOn = !isDone() && (report_.uploaded < 1 || (report_.refined > 0 && !playing_));
    return goesOn ? 0ns : std::chrono::nanoseconds(Rest::kHesitation);
}

std::optional<Reading> PictureView::readSoon(glm::vec2 at, const Explorer& shown) {
    const auto splats = static_cast<double>(report_.drawn);
    if (splats * readNs_ > std::chrono::duration<double, std::nano>(kSoon).count()) {
        readNs_ *= 0.9;  // a machine that was slow once is tried again
        return std::nullopt;
    }
    const Clock::time_point begin = Clock::now();
    const auto reading = read(at, shown);
    // Few splats say little of what one costs.
    if (report_.drawn > 10'000)
        readNs_ = std::chrono::duration<double, std::nano>(Clock::now() - begin).count() / splats;
    return reading;
}

std::optional<Reading> PictureView::read(glm::vec2 at, const Explorer& shown) const {
    if (eyes_.empty() || !canvas_.shows(shown)) return std::nullopt;
    const glm::ivec2 size = eyes_.front().size;
    const glm::ivec2 tile = glm::clamp(glm::ivec2(at) / size, glm::ivec2(0), grid_ - 1);
    const render::View& eye = eyes_[static_cast<std::size_t>(tile.x + tile.y)];
    const glm::dvec2 in = glm::dvec2(at) - glm::dvec2(tile * size);
    const glm::dvec2 window(in.x + 0.5, static_cast<double>(size.y) - in.y - 0.5);
    const auto found = canvas_.probe(eye, window);
    if (!found) return std::nullopt;
    return Reading{.index = found->index,
                   .value = found->picked.value,
                   .between = found->picked.between,
                   .position = found->coordinates,
                   .world = found->picked.world,
                   .step = report_.step,
                   .cell = found->cell};
}

}  // namespace app::desktop
