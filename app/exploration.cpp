#include "app/exploration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <utility>

#include "app/followed_playback.h"
#include "app/picture.h"

namespace app {
namespace {

using timeseries::RangeSet;
using timeseries::SlotState;
using timeseries::SortedStep;

constexpr std::size_t kAhead = 32;  // steps asked for before play comes to them
constexpr std::size_t kMostMessages = 100;

// Whether both are about the same sorted steps.
bool sameData(const Explorer& a, const Explorer& b) {
    return a.files == b.files && a.variable == b.variable && a.keep == b.keep;
}

// How it is looked at, whatever the data are.
void takeLook(Explorer& e, const Explorer& from) {
    e.view = from.view;
    e.stereo = from.stereo;
    e.footprint = from.footprint;
    e.order = from.order;
    e.size = from.size;
}

}  // namespace

struct Exploration::Open {
    Open(Dataset opened, const Explorer& wish, const Settings& settings, const Wake& wake)
        : dataset(std::move(opened)),
          steps(dataset, wish.keep.value_or(RangeSet::everything()), settings.budgetBytes,
                wake.callable()) {}

    Dataset dataset;
    LiveSteps steps;
    std::size_t step = 0;  // shown
    std::shared_ptr<const SortedStep> sorted;
    PointCounts counts;
};

struct Exploration::Pending {
    Explorer wish;
    bool keepsLook = false;  // the look is the user's of the moment, not the wish's
    int travel = 0;          // states of the history to go back (-) or forward; 0: a new one
    std::optional<Opening> opening = {};
    std::unique_ptr<Open> opened = {};  // nothing to show yet
    std::size_t failedSteps = 0;        // of `opened`
};

Exploration::Exploration(Settings settings)
    : settings_(std::move(settings)), wake_(settings_.wake) {}

Exploration::~Exploration() = default;

// Opening.

void Exploration::open(std::vector<std::filesystem::path> named) {
    assert(!named.empty());
    Explorer wish;
    wish.files = std::move(named);
    begin({.wish = std::move(wish), .keepsLook = true});
}

void Exploration::open(Explorer session) {
    assert(!session.files.empty());
    begin({.wish = std::move(session)});
}

void Exploration::begin(Pending wish) {
    pending_ = std::make_unique<Pending>(std::move(wish));
    pending_->opening.emplace(pending_->wish.files, pending_->wish.variable, settings_.openDataset,
                              wake_.callable());
}

std::optional<std::string> Exploration::opening() const {
    if (!pending_) return std::nullopt;
    const Explorer& wish = pending_->wish;
    if (open_ && wish.files == explorer().files && !wish.variable.empty()) return wish.variable;
    const auto& first = wish.files.front();
    return (first.has_filename() ? first.filename() : first).string();
}

void Exploration::cancelOpening() { pending_.reset(); }

void Exploration::fail(std::string why) {
    pending_.reset();
    tell(std::move(why), true);
}

void Exploration::takeOpened() {
    if (!pending_ || !pending_->opening) return;
    auto result = pending_->opening->poll();
    if (!result) return;
    pending_->opening.reset();
    if (auto* why = std::get_if<std::string>(&*result)) return fail(std::move(*why));
    auto& dataset = std::get<Dataset>(*result);
    Explorer& wish = pending_->wish;
    wish.variable = dataset.about.name;
    const std::size_t last = dataset.stepCount() - 1;
    const StepChoice asked =
        wish.steps.value_or(StepChoice{dataset.defaultStep, dataset.defaultStep});
    const std::size_t first = std::min(asked.first, last);
    // Several steps are what is to be played.
    timeseries::CursorSettings& play = wish.play.time;
    if (asked.last != asked.first && play.first == 0 && play.last >= last) {
        play.first = first;
        play.last = asked.last.value_or(play.last);
    }
    wish.steps = StepChoice{first, first};
    for (const std::string& note : dataset.series.notes) tell(note);
    pending_->opened = std::make_unique<Open>(std::move(dataset), wish, settings_, wake_);
    pending_->opened->steps.want({first});
}

// The wish comes true with any step that can be read: where the one asked for fails, LiveSteps goes
// on to read the others.
void Exploration::takeFirstStep() {
    if (!pending_ || !pending_->opened) return;
    for (LiveSteps::Arrival& arrival : pending_->opened->steps.poll()) {
        if (arrival.sorted) return adopt(std::move(arrival));
        const timeseries::Series& series = pending_->opened->steps.series();
        if (++pending_->failedSteps == series.stepCount()) return fail(series.why(arrival.step));
        if (pending_->failedSteps == 1) tell(series.why(arrival.step), true);
    }
}

void Exploration::adopt(LiveSteps::Arrival first) {
    Explorer next = pending_->wish;
    if (pending_->keepsLook) takeLook(next, explorer());
    Open& opened = *pending_->opened;
    timeseries::Playback playback;
    try {
        if (needsSamples(next)) next = resolved(next, {{first.step, first.sorted}});
        playback = playbackOf(next, *opened.dataset.about.time);
        opened.counts = pointCounts(next, *first.sorted);
    } catch (const std::invalid_argument& error) {
        return fail(error.what());
    }
    opened.step = first.step;
    opened.sorted = std::move(first.sorted);
    if (!open_) {
        history_ = History(next);
    } else if (pending_->travel != 0) {
        move(pending_->travel);
        history_.replace(next);
    } else {
        history_.edit(next);
        history_.endGesture();
    }
    playback_ = std::move(playback);
    playedFrom_.reset();
    open_ = std::move(pending_->opened);
    pending_.reset();
}

// Editing.

void Exploration::edit(Explorer next, std::string_view gesture) {
    if (sameData(next, explorer())) {
        if (pending_ && pending_->travel != 0) pending_.reset();
        return change(std::move(next), gesture);
    }
    const Explorer& now = explorer();
    if (next.files != now.files || next.variable != now.variable) {
        if (next.layers == now.layers) next.layers.clear();
        if (next.sweep == now.sweep) {
            next.sweep.reset();
            next.sweepLayer = {};
        }
        if (next.keep == now.keep) next.keep.reset();
    }
    if (next.files != now.files && next.clip == now.clip) next.clip.reset();
    begin({.wish = std::move(next), .keepsLook = true});
}

void Exploration::change(Explorer next, std::string_view gesture) {
    if (open_) {
        const std::size_t last = open_->dataset.stepCount() - 1;
        const std::size_t step = std::min(next.steps.value_or(*explorer().steps).first, last);
        next.steps = StepChoice{step, step};
        try {
            if (needsSamples(next)) next = resolved(next, {{open_->step, open_->sorted}});
            timeseries::Playback playback = followed(playback_, explorer(), next);
            open_->counts = pointCounts(next, *open_->sorted);
            playback_ = std::move(playback);
        } catch (const std::invalid_argument& error) {
            return tell(error.what(), true);
        }
    }
    history_.edit(std::move(next), gesture);
    if (playback_.playing) playedFrom_ = explorer().steps;
}

void Exploration::resize(glm::ivec2 picture) {
    if (picture == explorer().size) return;
    Explorer next = explorer();
    next.size = picture;
    history_.replace(std::move(next));
}

void Exploration::undo() {
    if (pending_ && pending_->travel == 0) return cancelOpening();
    if (playback_.playing) togglePlay();
    travel(-1);
}

void Exploration::redo() { travel(+1); }

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
}

// Playing.

void Exploration::togglePlay() {
    if (!open_) return;
    playback_.toggle();
    if (!playback_.playing) return keepPlayed();
    playedFrom_ = explorer().steps;
    // The step asked for may have lain outside what plays.
    play(std::chrono::nanoseconds(0));
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

void Exploration::seek(std::size_t step) {
    if (!open_) return;
    Explorer next = explorer();
    step = std::min(step, open_->dataset.stepCount() - 1);
    next.steps = StepChoice{step, step};
    if (open_->steps.series().state(step) == SlotState::Failed) open_->steps.retry(step);
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
    open_->counts = pointCounts(next, *open_->sorted);
    history_.replace(std::move(next));
}

void Exploration::advance(std::chrono::nanoseconds dt) {
    takeOpened();
    takeFirstStep();
    if (!open_) return;
    play(dt);
    takeArrivals();
    open_->steps.want(wishes());
}

void Exploration::takeArrivals() {
    std::vector<LiveSteps::Arrival> arrivals = open_->steps.poll();
    for (const LiveSteps::Arrival& arrival : arrivals)
        if (!arrival.sorted) tell(open_->steps.series().why(arrival.step), true);
    const auto there = [&](std::size_t step) -> std::shared_ptr<const SortedStep> {
        for (const LiveSteps::Arrival& arrival : arrivals)
            if (arrival.step == step && arrival.sorted) return arrival.sorted;
        return open_->steps.use(step);
    };
    const std::size_t asked = explorer().steps->first;
    if (asked == open_->step) return;
    if (auto sorted = there(asked)) return show(asked, std::move(sorted));
    if (playback_.playing && playback_.timeMoves) {
        // Back along the way that was played, as far as what is shown.
        const timeseries::TimeCursor& cursor = *playback_.time;
        const std::size_t places = cursor.placesPerCycle(), at = cursor.position().place;
        for (std::size_t back = 1; back < places; ++back) {
            const std::size_t step = cursor.stepOfPlace((at + places - back) % places);
            if (step == open_->step) return;
            if (auto sorted = there(step)) return show(step, std::move(sorted));
        }
        return;
    }
    // By hand: nearer to the step asked for.
    const auto distance = [&](std::size_t step) {
        return step > asked ? step - asked : asked - step;
    };
    for (LiveSteps::Arrival& arrival : arrivals)
        if (arrival.sorted && distance(arrival.step) < distance(open_->step))
            show(arrival.step, std::move(arrival.sorted));
}

void Exploration::show(std::size_t step, std::shared_ptr<const SortedStep> sorted) {
    open_->step = step;
    open_->sorted = std::move(sorted);
    open_->counts = pointCounts(explorer(), *open_->sorted);
}

// The step shown stays in memory beside the one asked for.
std::vector<std::size_t> Exploration::wishes() const {
    std::vector<std::size_t> steps{explorer().steps->first, open_->step};
    const auto ahead = playback_.time->upcoming(kAhead);
    steps.insert(steps.end(), ahead.begin(), ahead.end());
    return steps;
}

// Looking.

std::optional<Shown> Exploration::shown() const {
    if (!open_) return std::nullopt;
    return Shown{explorer(), open_->dataset, open_->step, open_->sorted};
}

std::string Exploration::waiting() const {
    if (!open_ || explorer().steps->first == open_->step) return "";
    const std::size_t asked = explorer().steps->first;
    if (open_->steps.series().state(asked) == SlotState::Failed)
        return fmt::format("step {} is not available, showing {}", asked, open_->step);
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
