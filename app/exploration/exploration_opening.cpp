// How other data become what is shown: opened beside it, and taken over with their first step.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <utility>

#include "app/choices/clip_flaw.h"
#include "app/choices/first_look.h"
#include "app/choices/map_flaw.h"
#include "app/exploration/exploration_state.h"
#include "app/exploration/followed_playback.h"
#include "app/files/chosen_axes.h"
#include "app/picture/picture.h"
#include "app/picture/resolved.h"
#include "timeseries/readers/file_stamp.h"

namespace app {
namespace {

// How it is looked at, whatever the data are.
void takeLook(Explorer& e, const Explorer& from) {
    e.view = from.view;
    e.stereo = from.stereo;
    e.model = from.model;
    e.light = from.light;
    e.lamp = from.lamp;
    e.opacityPer = from.opacityPer;
    e.footprint = from.footprint;
    e.order = from.order;
    e.legend = from.legend;
    e.size = from.size;
}

bool samePaths(std::span<const std::filesystem::path> a, std::span<const std::filesystem::path> b) {
    std::error_code unknown;
    return std::ranges::equal(a, b, [&](const auto& one, const auto& other) {
        if (one == other) return true;
        const auto place = std::filesystem::weakly_canonical(one, unknown);
        return !place.empty() && place == std::filesystem::weakly_canonical(other, unknown);
    });
}

// "Read again: run_01.nc, 31 steps", and how many more or fewer these are.
std::string readAgainText(const Dataset& before, const Dataset& now) {
    const std::size_t had = before.stepCount(), has = now.stepCount();
    std::string text = fmt::format("Read again: {}, {} step{}",
                                   std::filesystem::path(now.name).filename().string(),
                                   withCommas(has), has == 1 ? "" : "s");
    if (has > had) text += fmt::format(", {} more", withCommas(has - had));
    if (has < had) text += fmt::format(", {} fewer", withCommas(had - has));
    return text;
}

}  // namespace

void Exploration::open(std::vector<std::filesystem::path> named) {
    assert(!named.empty());
    if (open_ && samePaths(named, explorer().files)) return openAgain();
    openFirst(std::move(named));
}

void Exploration::openFirst(std::vector<std::filesystem::path> named) {
    Explorer wish;
    wish.files = std::move(named);
    begin({.wish = std::move(wish), .rest = Pending::Rest::LookOfNow});
}

// What was chosen stays, and so does the step, by its time: files may have come and gone.
void Exploration::openAgain() { begin({.wish = explorer(), .rest = Pending::Rest::Again}); }

// What plays goes on while files are read.
void Exploration::takeStepsOfNow(Explorer& wish) const {
    wish.steps = explorer().steps;
    wish.play.time = explorer().play.time;
    const timeseries::TimeAxis& time = *open_->dataset.variable.time;
    if (wish.steps)
        wish.stepTime = timeKept(time, std::min(wish.steps->first, time.points.size() - 1));
}

void Exploration::open(Explorer session) {
    assert(!session.files.empty());
    begin({.wish = std::move(session)});
}

// An edit to other data.
void Exploration::openEdited(Explorer next, std::string_view gesture) {
    const Explorer& now = explorer();
    if (next.files == now.files && next.variable == now.variable) {
        Explorer wish = next;
        next.keep = now.keep;
        next.axes = now.axes;
        change(std::move(next), gesture);
        begin({.wish = std::move(wish), .rest = Pending::Rest::AllOfNow});
        return;
    }
    if (next.layers == now.layers) {
        next.layers.clear();
        next.noLayers = false;
    }
    if (next.keep == now.keep) next.keep.reset();
    if (next.files != now.files && next.clip == now.clip) next.clip.reset();
    if (next.files != now.files && next.axes == now.axes) next.axes = {};
    begin({.wish = std::move(next), .rest = Pending::Rest::LookOfNow});
}

void Exploration::begin(Pending wish) {
    pending_ = std::make_unique<Pending>(std::move(wish));
    pending_->opening.emplace(pending_->wish.files, pending_->wish.variable, settings_.openDataset,
                              wake_.callable());
}

std::optional<std::string> Exploration::opening() const {
    if (!pending_) return std::nullopt;
    const Explorer& wish = pending_->wish;
    const bool isOfOneFile = open_ && wish.files == explorer().files;
    if (isOfOneFile && !wish.variable.empty() && pending_->rest != Pending::Rest::Again)
        return wish.variable;
    const auto& first = wish.files.front();
    return (first.has_filename() ? first.filename() : first).string();
}

void Exploration::cancelOpening() { pending_.reset(); }

void Exploration::fail(std::string why) {
    const bool again = pending_->rest == Pending::Rest::Again;
    std::vector<std::filesystem::path> files = std::move(pending_->wish.files);
    pending_.reset();
    // Other data are there now, perhaps: what was chosen does not fit them.
    if (again) return openFirst(std::move(files));
    tell(std::move(why), true);
}

void Exploration::takeOpened() {
    if (!pending_ || !pending_->opening) return;
    auto result = pending_->opening->poll();
    if (!result) return;
    pending_->opening.reset();
    if (auto* why = std::get_if<std::string>(&*result)) return fail(std::move(*why));
    auto& dataset = std::get<OpenDataset>(*result);
    Explorer& wish = pending_->wish;
    wish.variable = dataset.variable.name;
    chooseAxes(dataset, wish.axes);
    const std::size_t last = dataset.stepCount() - 1;
    if (open_ && pending_->rest == Pending::Rest::Again) takeStepsOfNow(wish);
    findStepThen(dataset, wish);
    const StepChoice asked =
        wish.steps.value_or(StepChoice{dataset.defaultStep, dataset.defaultStep});
    const std::size_t first = std::min(asked.first, last);
    // Another variable may have fewer, and is shown at its last.
    const bool isSession = pending_->rest == Pending::Rest::AsWished && pending_->travel == 0;
    if (isSession && asked.first > last)
        tell(fmt::format("There is no step {}: the last one, {}, is shown", asked.first, last),
             true);
    // Several steps are what is to be played.
    timeseries::CursorSettings& play = wish.play.time;
    if (asked.last != asked.first && play.first == 0 && play.last >= last && play.stride == 1) {
        play.first = first;
        play.last = asked.last.value_or(play.last);
        play.stride = asked.stride;
    }
    wish.steps = StepChoice{first, first};
    wish.oneTick = false;
    if (!open_ || wish.files != explorer().files || pending_->rest == Pending::Rest::Again)
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
        if (pending_->failedSteps > 1) continue;
        tell(series.why(arrival.step), true);
        pending_->opened->toldFailed.insert(arrival.step);
    }
}

// The wish with what the user has chosen since.
Explorer Exploration::restOf(const Pending& pending) const {
    Explorer next = pending.wish;
    switch (pending.rest) {
        case Pending::Rest::AsWished:
            break;
        case Pending::Rest::LookOfNow:
            takeLook(next, explorer());
            break;
        case Pending::Rest::AllOfNow:
            next = explorer();
            next.keep = pending.wish.keep;
            next.axes = pending.wish.axes;
            break;
        case Pending::Rest::Again:
            next = explorer();
            next.steps = pending.wish.steps;
            next.play.time = pending.wish.play.time;
    }
    if (pending.travel != 0) keepAcrossUndo(next, explorer());
    return next;
}

void Exploration::adopt(LiveSteps::Arrival first) {
    Explorer next = restOf(*pending_);
    Open& opened = *pending_->opened;
    // Nothing would be seen, and nothing would say why.
    if (next.clip)
        if (std::string flaw = clipFlaw(*next.clip, first.sorted->grid()); !flaw.empty()) {
            tell(std::move(flaw), true);
            next.clip.reset();
        }
    if (next.map == render::Map::Globe)
        if (std::string flaw = globeFlaw(first.sorted->grid()); !flaw.empty()) {
            tell(std::move(flaw), true);
            next.map = render::Map::Flat;
        }
    lookFirst(next, first.sorted->grid());
    timeseries::Playback playback;
    try {
        if (needsSamples(next)) next = resolved(next, {{first.step, first.sorted}});
        playback = playbackOf(next, *opened.dataset.variable.time);
        opened.counts = pointCounts(next, *first.sorted);
    } catch (const std::invalid_argument& error) {
        return fail(error.what());
    } catch (const std::runtime_error& error) {  // of a sorted step, of which points were read
        return fail(error.what());
    }
    if (pending_->rest == Pending::Rest::Again) {
        std::erase_if(messages_, [](const Message& m) {  // as they asked
            return m.isError && m.text.find(timeseries::kHasChanged) != std::string::npos;
        });
        tell(readAgainText(open_->dataset, opened.dataset));
    }
    opened.step = first.step;
    opened.sorted = std::move(first.sorted);
    if (playback_.playing && next.files == explorer().files) playback.play();
    if (!open_) {
        history_ = History(next);
    } else if (pending_->rest == Pending::Rest::Again) {
        history_.replace(next);  // no choice is another
    } else if (pending_->travel != 0) {
        move(pending_->travel);
        history_.replace(next);
    } else {
        history_.edit(next);
        history_.endGesture();
    }
    playback_ = std::move(playback);
    playedFrom_.reset();
    if (playback_.playing) playedFrom_ = next.steps;
    open_ = std::move(pending_->opened);
    pending_.reset();
    lay();
}

}  // namespace app
