#include "app/exploration/exploration.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "app/choices/choice_text.h"
#include "app/choices/first_look.h"
#include "app/choices/map_flaw.h"
#include "app/exploration/exploration_state.h"
#include "app/exploration/followed_playback.h"
#include "app/picture/fitted_map.h"
#include "app/picture/picture.h"
#include "app/picture/resolved.h"
#include "timeseries/index/byte_source.h"

namespace app {
namespace {

using timeseries::SlotState;
using timeseries::SortedStep;

constexpr std::size_t kAhead = 32;  // steps asked for before play comes to them
constexpr std::size_t kMostMessages = 100;

// Ends of the data that maps may have been fitted to: those of the step shown first.
std::vector<Extent> extentsSeen(const timeseries::Series& series, std::size_t shown) {
    std::vector<Extent> seen;
    const auto take = [&](std::size_t step) {
        const timeseries::StepSummary* summary = series.summary(step);
        if (summary == nullptr || summary->quantiles.empty()) return;
        seen.push_back({summary->quantiles.front(), summary->quantiles.back()});
        if (step == shown) seen.push_back(extentAsideFill({summary->quantiles}));
    };
    take(shown);
    for (std::size_t step = 0; step < series.stepCount(); ++step)
        if (step != shown) take(step);
    return seen;
}

}  // namespace

Exploration::Exploration(Settings settings)
    : settings_(std::move(settings)), wake_(settings_.wake) {}

Exploration::~Exploration() = default;

// Editing.

void Exploration::edit(Explorer next, std::string_view gesture) {
    if (!next.files.empty() && !sameData(next, explorer()))
        return openEdited(std::move(next), gesture);
    if (pending_ && pending_->travel != 0) pending_.reset();
    reading([&] { change(std::move(next), gesture); });
}

void Exploration::change(Explorer next, std::string_view gesture) {
    if (open_) {
        const std::size_t last = open_->dataset.stepCount() - 1;
        const std::size_t step = std::min(next.steps.value_or(*explorer().steps).first, last);
        next.steps = StepChoice{step, step};
        try {
            if (next.map == render::Map::Globe && explorer().map != next.map)
                if (const std::string flaw = globeFlaw(open_->sorted->grid()); !flaw.empty())
                    throw ChoiceError(flaw);
            followMap(next, explorer().map, open_->sorted->grid());
            if (needsSamples(next)) next = resolved(next, {{open_->step, open_->sorted}});
            if (next.layers != explorer().layers)
                refitMaps(next, explorer(), history_.before(gesture),
                          extentsSeen(open_->steps.series(), open_->step));
            timeseries::Playback playback = followed(playback_, explorer(), next);
            open_->counts = pointCounts(next, *open_->sorted);
            playback_ = std::move(playback);
        } catch (const std::invalid_argument& error) {
            return tell(error.what(), true);
        }
    }
    history_.edit(std::move(next), gesture);
    if (playback_.playing) playedFrom_ = explorer().steps;
    if (open_) lay();
}

void Exploration::resize(glm::ivec2 picture) {
    if (picture == explorer().size) return;
    Explorer next = explorer();
    next.size = picture;
    history_.replace(std::move(next));
}

bool Exploration::canUndo() const {
    const bool opens = pending_ && pending_->travel == 0;
    const bool played = playedFrom_ && explorer().steps != playedFrom_;
    return history_.canUndo() || opens || played;
}

void Exploration::undo() {
    if (pending_ && pending_->travel == 0) return cancelOpening();
    if (playback_.playing) togglePlay();
    reading([&] { travel(-1); });
}

void Exploration::redo() {
    reading([&] { travel(+1); });
}

// Returns how far it went.
int Exploration::move(int by) {
    int moved = 0;
    for (; moved > by && history_.canUndo(); --moved) history_.undo();
    for (; moved < by && history_.canRedo(); ++moved) history_.redo();
    return moved;
}

void Exploration::travel(int by) {
    if (pending_) by += pending_->travel;
    const Explorer from = explorer();
    const int moved = move(by);
    if (moved == 0 && pending_ && pending_->travel == 0) return;  // nothing to redo
    if (moved == 0 || !open_ || sameData(explorer(), from)) {
        pending_.reset();
        return arrive(from);
    }
    Explorer target = explorer();
    move(-moved);
    begin({.wish = std::move(target), .travel = moved});
}

void Exploration::arrive(const Explorer& from) {
    if (!open_) return;
    Explorer there = explorer();
    playback_ = followed(playback_, from, there);
    open_->counts = pointCounts(there, *open_->sorted);
    history_.replace(std::move(there));
    lay();
}

// Playing.

void Exploration::togglePlay() {
    if (!open_) return;
    const bool played = playback_.playing;
    playback_.toggle();
    if (played) return keepPlayed();
    if (!playback_.playing) return tell(whyNothingPlays());
    playedFrom_ = explorer().steps;
    // The step asked for may have lain outside what plays.
    reading([&] { play(std::chrono::nanoseconds(0)); });
}

std::string Exploration::whyNothingPlays() const {
    const std::string why = "Nothing to play: ";
    const bool one = open_->dataset.stepCount() == 1;
    if (!one && playback_.timeMoves && playback_.time->placesPerCycle() == 1) {
        const auto& time = playback_.time->settings();
        if (time.first == time.last) return why + "one step lies between the in and the out point";
        return why + fmt::format("every {} steps there is one between the in and the out point",
                                 time.stride);
    }
    if ((playback_.sweep && playback_.sweepMoves) || (!one && playback_.timeMoves))
        return why + "the speed is 0";
    if (playback_.sweep) return why + "neither time nor values move";
    return why + (one ? "there is one step only" : "time does not move") +
           "; Sweep values, on the Animation page, plays through its values";
}

void Exploration::play(std::chrono::nanoseconds dt) {
    if (!playback_.playing) return;
    playback_.advance(dt);
    Explorer now = explorer();
    if (playback_.timeMoves) now.steps = StepChoice{playback_.time->step(), playback_.time->step()};
    if (playback_.sweep) now.play.tick = playback_.sweep->tick();
    if (now != explorer()) {
        open_->counts = pointCounts(now, *open_->sorted);
        history_.replace(std::move(now));
    }
    if (!playback_.playing) keepPlayed();
}

// What play has moved becomes one step of undo.
void Exploration::keepPlayed() {
    const auto from = std::exchange(playedFrom_, std::nullopt);
    Explorer now = explorer();
    if (!from || now.steps == from) return;
    Explorer before = now;
    before.steps = from;
    history_.replace(std::move(before));
    history_.edit(std::move(now));
}

void Exploration::expectSameFiles() {
    if (open_) open_->files.expectSame();
}

void Exploration::seek(std::size_t step) {
    if (!open_) return;
    Explorer next = explorer();
    step = std::min(step, open_->dataset.stepCount() - 1);
    next.steps = StepChoice{step, step};
    if (open_->steps.series().state(step) == SlotState::Failed) {
        open_->steps.retry(step);
        open_->toldFailed.erase(step);
    }
    edit(std::move(next), "seek");
}

void Exploration::stepBy(int steps) {
    if (!open_) return;
    timeseries::TimeCursor cursor = *playback_.time;
    for (; steps > 0; --steps) cursor.stepForward();
    for (; steps < 0; ++steps) cursor.stepBackward();
    seek(cursor.step());
}

void Exploration::seekTick(std::int64_t tick) {
    if (!playback_.sweep) return;
    const Explorer from = explorer();
    Explorer next = from;
    next.play.tick = tick;
    playback_ = followed(playback_, from, next);
    reading([&] { open_->counts = pointCounts(next, *open_->sorted); });
    history_.replace(std::move(next));
}

void Exploration::advance(std::chrono::nanoseconds dt) {
    if (lost_) closeLost();
    reading([&] { goOn(dt); });
}

void Exploration::goOn(std::chrono::nanoseconds dt) {
    takeOpened();
    takeFirstStep();
    if (!open_) return;
    play(dt);
    takeArrivals();
    dropPointsPassed();
    lay();
    open_->steps.want(wishes(), rangesLookedAt(explorer()));
}

void Exploration::takeArrivals() {
    for (std::string& note : open_->steps.takeNotes()) tell(std::move(note), false);
    std::vector<LiveSteps::Arrival> arrivals = open_->steps.poll();
    if (open_->awaited.sorted && canLie(*open_->awaited.sorted))
        arrivals.push_back(std::exchange(open_->awaited, {}));
    const auto there = [&](std::size_t step) -> std::shared_ptr<const SortedStep> {
        for (const LiveSteps::Arrival& arrival : arrivals)
            if (arrival.step == step && arrival.sorted) return arrival.sorted;
        return open_->steps.use(step);
    };
    // The step shown, with fewer points in memory.
    for (LiveSteps::Arrival& arrival : arrivals)
        if (arrival.step == open_->step && arrival.sorted && open_->sorted->file() &&
            arrival.sorted->file() == open_->sorted->file())
            show(arrival.step, arrival.sorted);
    const std::size_t asked = explorer().steps->first;
    const timeseries::Series& series = open_->steps.series();
    if (series.state(asked) == SlotState::Failed && open_->toldFailed.insert(asked).second)
        tell(series.why(asked), true);
    if (asked == open_->step) return open_->passed.clear();
    open_->passed.insert(asked);
    if (auto sorted = there(asked)) {
        if (!canLie(*sorted) && wantGlobe(*sorted)) open_->awaited = {asked, sorted};
        if (canLie(*sorted)) return show(asked, std::move(sorted));
    }
    if (playback_.playing && playback_.timeMoves) {
        // Back along the way that was played, as far as what is shown.
        const timeseries::TimeCursor& cursor = *playback_.time;
        const std::size_t places = cursor.placesPerCycle(), at = cursor.position().place;
        for (std::size_t back = 1; back < places; ++back) {
            const std::size_t step = cursor.stepOfPlace((at + places - back) % places);
            if (step == open_->step) return;
            if (auto sorted = there(step); sorted && canLie(*sorted))
                return show(step, std::move(sorted));
        }
        return;
    }
    // By hand: what was passed on the way, where it is nearer to the step asked for.
    const auto distance = [&](std::size_t step) {
        return step > asked ? step - asked : asked - step;
    };
    for (LiveSteps::Arrival& arrival : arrivals)
        if (arrival.sorted && open_->passed.contains(arrival.step) &&
            distance(arrival.step) < distance(open_->step) && canLie(*arrival.sorted))
            show(arrival.step, std::move(arrival.sorted));
}

// Of a step on disk every point that was ever looked at stays in memory, until there are too many:
// then those go that were looked at longest ago, if points are what there is too much of and half
// of them go.
void Exploration::dropPointsPassed() {
    const timeseries::Series& series = open_->steps.series();
    const std::size_t step = open_->step;
    if (series.bytes() <= series.budgetBytes() || !series.isStored(step)) return;
    const std::uint64_t held = open_->sorted->pointBytes();
    if (held < series.budgetBytes() / 2) return;
    const auto looked = open_->sorted->keptPart(rangesLookedAt(explorer()));
    if (held < 2 * open_->sorted->pointBytes(open_->sorted->select(looked))) return;
    open_->steps.reopen(step, looked, series.budgetBytes() / 4);
}

void Exploration::show(std::size_t step, std::shared_ptr<const SortedStep> sorted) {
    open_->step = step;
    if (sorted->sharedGrid() != open_->sorted->sharedGrid()) open_->globe = {};
    open_->sorted = std::move(sorted);
    if (open_->awaited.step == step) open_->awaited = {};
    open_->counts = pointCounts(explorer(), *open_->sorted);
    lay();
}

// The step shown stays in memory beside the one asked for.
std::vector<std::size_t> Exploration::wishes() const {
    std::vector<std::size_t> steps{explorer().steps->first, open_->step};
    const auto ahead = playback_.time->upcoming(kAhead);
    steps.insert(steps.end(), ahead.begin(), ahead.end());
    return steps;
}

// Looking.

bool Exploration::reading(const std::function<void()>& work) {
    try {
        work();
        return true;
    } catch (const timeseries::FileError& error) {
        lost_ = error.what();
    } catch (const timeseries::StepFileError& error) {
        lost_ = error.what();
    }
    return false;
}

void Exploration::closeLost() {
    tell(*lost_ + ": nothing is shown any more", true);
    lost_.reset();
    open_.reset();
    pending_.reset();
    playback_ = {};
    playedFrom_.reset();
    history_ = History();
}

std::optional<Shown> Exploration::shown() const {
    if (!open_) return std::nullopt;
    return Shown{laid(), open_->dataset, open_->step, open_->sorted};
}

std::string Exploration::waiting() const {
    if (!open_) return "";
    if (explorer().steps->first == open_->step) return waitingForGlobe();
    const std::size_t asked = explorer().steps->first;
    const SlotState state = open_->steps.series().state(asked);
    if (state == SlotState::Failed)
        return fmt::format("step {} is not available, showing {}", asked, open_->step);
    if (state == SlotState::Loaded && explorer().map == render::Map::Globe)
        return fmt::format("making the globe of step {}, showing {}", asked, open_->step);
    return fmt::format("requested step {}, showing {}", asked, open_->step);
}

const PointCounts* Exploration::counts() const { return open_ ? &open_->counts : nullptr; }

const timeseries::Series* Exploration::series() const {
    return open_ ? &open_->steps.series() : nullptr;
}

void Exploration::tell(std::string text, bool isError) {
    if (!messages_.empty() && messages_.back().text == text) return;
    if (messages_.size() == kMostMessages) messages_.erase(messages_.begin());
    messages_.push_back({nextMessage_++, std::move(text), isError});
}

void Exploration::forgetMessage(std::uint64_t number) {
    std::erase_if(messages_, [number](const Message& m) { return m.number == number; });
}

}  // namespace app
