#include "timeseries/series/playback.h"

#include <algorithm>
#include <utility>

namespace timeseries {

void Playback::play() {
    Playback begun = *this;
    begun.playing = true;
    if (timeMoves && time) {
        if (time->finished() || time->atLast()) begun.time->restart();
        begun.time->enter();
    }
    if (begun.untilNextChange()) *this = std::move(begun);
}

Playback::Change Playback::advance(std::chrono::nanoseconds dt) {
    if (!playing) return {};
    Change change;
    if (timeMoves && time) {
        const std::size_t before = time->step();
        time->advance(dt);
        change.step = time->step() != before;
    }
    if (sweepMoves && sweep) {
        const std::int64_t before = sweep->tick();
        sweep->advance(dt);
        change.window = sweep->tick() != before;
    }
    if (!untilNextChange()) pause();
    return change;
}

std::optional<std::chrono::nanoseconds> Playback::untilNextChange() const {
    if (!playing) return std::nullopt;
    const auto step = timeMoves && time ? time->untilNextStep() : std::nullopt;
    const auto window = sweepMoves && sweep ? sweep->untilNextTick() : std::nullopt;
    if (step && window) return std::min(*step, *window);
    return step ? step : window;
}

}  // namespace timeseries
