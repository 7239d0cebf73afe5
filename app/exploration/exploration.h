// An Explorer and the data that it is about, alive: what a window and a headset drive, frame by
// frame. It never waits, draws nothing and knows no GL. One thread.
//
// The Explorer is the wish; the data follow. A wish for another step loads it beside the one shown.
// A wish for another file, variable or kept range is opened beside what is shown and becomes the
// Explorer when its first step is there; what cannot be had becomes a message, and nothing changes.
// So explorer(), once there is data, is always a resolved one (picture.h) that fits the dataset
// shown: nothing in it is left open.
//
// A read cannot be interrupted. Whatever is being read when it is no longer wanted, or when this is
// destroyed, ends on a thread of its own that nobody waits for. A program that ends while such a
// thread may run does so by std::_Exit: at exit() the readers' libraries would be taken down beside
// it.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/choices/explorer.h"
#include "app/choices/history.h"
#include "app/exploration/live_steps.h"
#include "app/exploration/opening.h"
#include "app/exploration/point_counts.h"
#include "app/files/dataset.h"
#include "app/files/memory_budget.h"
#include "app/wake.h"
#include "timeseries/series/playback.h"

namespace app {

// What can be drawn now. `explorer` is resolved and fits `dataset`; it is the one asked for, but
// that while a globe is being made the step lies as it did before, or flat.
struct Shown {
    const Explorer& explorer;
    const Dataset& dataset;
    std::size_t step;  // the one that `sorted` is, which need not be the one asked for
    std::shared_ptr<const timeseries::SortedStep> sorted;
};

class Exploration {
 public:
    struct Settings {
        std::uint64_t budgetBytes = memoryBudget();  // of steps in memory
        std::function<void()> wake = [] {};          // from other threads: something came
        DatasetOpener openDataset = app::openDataset;
    };
    explicit Exploration(Settings settings);
    ~Exploration();

    // Starts to open: a member of a series, a folder, a pattern, several files. View and quality
    // stay; layers become the first choice. What is named as what is shown was is read anew, and
    // all that was chosen stays, where it can. REQUIRES: at least one.
    void open(std::vector<std::filesystem::path> named);
    // Starts to open all that a session says. REQUIRES: it names a file.
    void open(Explorer session);
    // What is being opened, for "opening NAME"; none when nothing is.
    std::optional<std::string> opening() const;
    void cancelOpening();

    const Explorer& explorer() const { return history_.now(); }
    // See History::edit. Other files, another variable or another kept range start to open, as an
    // edit of its own: layers of other data, where `next` leaves them as they are, become
    // the first choice. What cannot be (a layer outside the kept range, a sweep that reaches no
    // value) is refused with a message. What `next` leaves open is resolved from the step shown.
    void edit(Explorer next, std::string_view gesture = {});
    void endGesture() { history_.endGesture(); }
    void resize(glm::ivec2 picture);  // not the user's choice: no step of undo
    bool canUndo() const;
    bool canRedo() const { return history_.canRedo(); }
    // While playing, undo() pauses and goes back to where play began. While an edit's data are
    // being opened, it cancels that. An edit while undone data are being opened cancels the undo.
    void undo();
    void redo();

    // Play. The step asked for is explorer().steps->first; the window's tick explorer().play.tick.
    // What play has passed is, once it pauses, one step of undo.
    const timeseries::Playback& playback() const { return playback_; }
    void togglePlay();
    // By hand: pauses nothing, play goes on from there. A step that failed is tried again.
    void seek(std::size_t step);  // beyond the last is the last
    void stepBy(int steps);       // over shown steps, as TimeCursor::stepForward()
    void seekTick(std::int64_t tick);

    // A step that cannot be read is told once, when it is asked for; series() knows all of them.
    // Once a frame: moves what plays by dt, takes in what was loaded, asks for what is wanted next.
    // Where loading is slower than play, the step passed last of those that are there is shown.
    void advance(std::chrono::nanoseconds dt);
    // When advance() next changes what is seen without any event; none: the front end may sleep
    // until Settings::wake.
    std::optional<std::chrono::nanoseconds> untilNextChange() const {
        return playback_.untilNextChange();
    }

    // Runs what reads the step shown, not ImGui. False: it turned out that the step can be read no
    // longer, for of a sorted one points are read when they are looked at. The next advance() tells
    // it, and from then on nothing is shown.
    bool reading(const std::function<void()>& work);

    std::optional<Shown> shown() const;
    // In words, when what is shown is not what is asked for: "requested step 7, showing 5", "making
    // the globe".
    std::string waiting() const;
    // Of the step shown; null while there is none.
    const PointCounts* counts() const;
    const timeseries::Series* series() const;  // of the dataset shown; null before the first

    // Throws FileError where one of few files is no longer what it was when it was opened: who
    // opens it anew would read something else than what is shown.
    void expectSameFiles();

    // Sentences to show, oldest first, each with a number that ascends; the front end forgets them.
    struct Message {
        std::uint64_t number;
        std::string text;
        bool isError;
    };
    const std::vector<Message>& messages() const { return messages_; }
    // A text that was told last is not told again.
    void tell(std::string text, bool isError = false);
    void forgetMessage(std::uint64_t number);

 private:
    struct Open;     // a dataset, its steps and which is shown
    struct Pending;  // a wish for other data, on its way

    // exploration_opening.cpp
    void openEdited(Explorer next, std::string_view gesture);
    void openFirst(std::vector<std::filesystem::path> named);
    void openAgain();
    void takeStepsOfNow(Explorer& wish) const;
    void begin(Pending wish);
    void fail(std::string why);
    void takeOpened();
    void takeFirstStep();
    Explorer restOf(const Pending& pending) const;
    void adopt(LiveSteps::Arrival first);
    // exploration.cpp
    void change(Explorer next, std::string_view gesture);
    void travel(int by);
    int move(int by);
    void arrive(const Explorer& from);
    void play(std::chrono::nanoseconds dt);
    std::string whyNothingPlays() const;
    void keepPlayed();
    void goOn(std::chrono::nanoseconds dt);
    void closeLost();
    void takeArrivals();
    void dropPointsPassed();
    void show(std::size_t step, std::shared_ptr<const timeseries::SortedStep> sorted);
    std::vector<std::size_t> wishes() const;
    // exploration_globe.cpp
    void lay();
    bool liesAsAsked() const;
    const Explorer& laid() const;
    bool canLie(const timeseries::SortedStep& step) const;
    bool wantGlobe(const timeseries::SortedStep& step);
    std::string waitingForGlobe() const;

    Settings settings_;
    Wake wake_;
    History history_;
    timeseries::Playback playback_;
    std::optional<StepChoice> playedFrom_;  // while playing: what undo goes back to
    std::unique_ptr<Open> open_;
    std::unique_ptr<Pending> pending_;
    std::optional<std::string> lost_;  // why what is shown can be read no longer
    std::vector<Message> messages_;
    std::uint64_t nextMessage_ = 0;
};

}  // namespace app
