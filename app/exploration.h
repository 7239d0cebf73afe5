// An Explorer and the data that it is about, alive: what a window and a headset drive, frame by
// frame. It never waits, draws nothing and knows no GL. One thread.
//
// The Explorer is the wish; the data follow. A wish for another file or variable opens it beside
// what is shown; a wish for another step loads it beside the one shown. What cannot be had becomes a
// message, and the wish goes back to what is shown. Once there is data, the Explorer is a resolved
// one (picture.h): nothing in it is left open.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/dataset.h"
#include "app/explorer.h"
#include "app/history.h"
#include "app/live_steps.h"
#include "app/opening.h"
#include "timeseries/playback.h"

namespace app {

// What can be drawn now. `explorer` is resolved and fits `dataset`.
struct Shown {
    const Explorer& explorer;
    const Dataset& dataset;
    std::size_t step;  // the one that `sorted` is, which need not be the one asked for
    std::shared_ptr<const timeseries::SortedStep> sorted;
};

// Points of the step shown. Hidden layers count in `layers` only.
struct PointCounts {
    std::vector<std::uint64_t> layers;  // in the order of Explorer::layers
    std::uint64_t swept = 0;            // of the swept window
    std::uint64_t selected = 0;         // in any visible layer, each once
    std::uint64_t kept = 0;
    std::uint64_t total = 0;  // valid, before anything was dropped
};

class Exploration {
 public:
    struct Settings {
        std::uint64_t budgetBytes = std::uint64_t{4} << 30;  // of steps in memory
        std::function<void()> wake = [] {};                  // from other threads: something came
    };
    explicit Exploration(Settings settings);

    // Starts to open: a member of a series, a folder, a pattern, several files. View and quality
    // stay; layers become the first choice.
    void open(std::vector<std::filesystem::path> named);
    // Starts to open all that a session says.
    void open(Explorer session);
    // What is being opened, for "opening NAME"; none when nothing is.
    std::optional<std::string> opening() const;
    void cancelOpening();

    const Explorer& explorer() const { return history_.now(); }
    void edit(Explorer next, std::string_view gesture = {});  // see History::edit
    void endGesture() { history_.endGesture(); }
    void resize(glm::ivec2 picture);  // not the user's choice: no step of undo
    bool canUndo() const { return history_.canUndo(); }
    bool canRedo() const { return history_.canRedo(); }
    void undo();
    void redo();

    // Play. The step asked for is explorer().steps->first; the window's tick explorer().play.tick.
    const timeseries::Playback& playback() const { return playback_; }
    void togglePlay();
    void seek(std::size_t step);  // pauses nothing: play goes on from there
    void stepBy(int steps);
    void seekTick(std::int64_t tick);

    // Once a frame: moves what plays by dt, takes in what was loaded, asks for what is wanted next.
    void advance(std::chrono::nanoseconds dt);
    // When advance() next changes what is seen without any event; none: the front end may sleep.
    std::optional<std::chrono::nanoseconds> untilNextChange() const;

    std::optional<Shown> shown() const;
    // In words, when what is shown is not what is asked for: "requested step 7, showing 5".
    std::string waiting() const;
    // None while there is no step.
    const PointCounts* counts() const;
    const timeseries::Series* series() const;  // of the dataset shown; null before the first

    // Sentences to show, oldest first, each with a number that ascends; the front end forgets them.
    struct Message {
        std::uint64_t number;
        std::string text;
        bool isError;
    };
    const std::vector<Message>& messages() const { return messages_; }
    void tell(std::string text, bool isError = false);
    void forgetMessage(std::uint64_t number);

 private:
    struct Open;  // a dataset, its steps and its lattice-independent state
    void follow();
    History history_;
    timeseries::Playback playback_;
    Settings settings_;
    std::unique_ptr<Open> open_;
    std::optional<Opening> opening_;
    std::vector<Message> messages_;
};

}  // namespace app
