#include "app/exploration/followed_playback.h"

#include <algorithm>
#include <vector>

namespace app {

timeseries::Playback playbackOf(Explorer& explorer, const timeseries::TimeAxis& axis) {
    std::vector<double> times;
    for (const timeseries::TimePoint& point : axis.points) times.push_back(point.value);
    timeseries::CursorSettings& settings = explorer.play.time;
    if (settings.first >= times.size()) {
        settings.first = 0;
        settings.last = timeseries::CursorSettings{}.last;
    }
    timeseries::Playback playback{.timeMoves = explorer.play.timeMoves,
                                  .sweepMoves = explorer.play.sweepMoves};
    playback.time.emplace(times, settings).seek(explorer.steps->first);
    if (const auto* const sweep = sweepOf(explorer))
        playback.sweep.emplace(*sweep, timeseries::SweepPosition{explorer.play.tick, {}});
    explorer.play.tick = playback.sweep ? playback.sweep->tick() : 0;
    return playback;
}

timeseries::Playback followed(timeseries::Playback playback, const Explorer& before,
                              Explorer& after) {
    if (after.play.time != before.play.time) playback.time->set(after.play.time);
    if (after.steps != before.steps) playback.time->seek(after.steps->first);
    const timeseries::SweepSettings* const sweep = sweepOf(after);
    if (sweep == nullptr) {
        playback.sweep.reset();
    } else if (!playback.sweep) {
        playback.sweep.emplace(*sweep, timeseries::SweepPosition{after.play.tick, {}});
    } else {
        if (*sweep != playback.sweep->settings()) playback.sweep->set(*sweep);
        if (after.play.tick != before.play.tick)
            playback.sweep->seek(
                std::clamp<std::int64_t>(after.play.tick, 0, playback.sweep->ticksPerCycle() - 1));
    }
    after.play.tick = playback.sweep ? playback.sweep->tick() : 0;
    playback.timeMoves = after.play.timeMoves;
    playback.sweepMoves = after.play.sweepMoves;
    return playback;
}

}  // namespace app
