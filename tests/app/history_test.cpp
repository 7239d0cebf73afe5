#include "app/choices/history.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/support/rounds.h"

namespace app {
namespace {

// States that differ by what is undone (the variable's name) and by what is not.
Explorer state(int n, std::int64_t tick = 0, int width = 100) {
    Explorer e;
    e.variable = std::to_string(n);
    e.play.tick = tick;
    e.size.x = width;
    return e;
}

// The same said with two stacks.
struct Mirror {
    std::vector<Explorer> past, future;
    Explorer now;
    std::string gesture;

    void edit(const Explorer& next, const std::string& by) {
        if (next == now) return;
        if (by.empty() || by != gesture) past.push_back(now);
        gesture = by;
        if (past.size() > History::kSteps) past.erase(past.begin());
        future.clear();
        now = next;
    }
    void go(std::vector<Explorer>& from, std::vector<Explorer>& to) {
        to.push_back(now);
        const Explorer before = now;
        now = from.back();
        now.size = before.size;
        from.pop_back();
        gesture.clear();
    }
};

TEST(History, IsTwoStacksForAnySequenceOfEdits) {
    const char* const gestures[] = {"", "", "drag", "slider", "pan"};
    std::mt19937 random(2);
    for (int run = 0; run < tests::rounds(40); ++run) {
        History history(state(0));
        Mirror model{{}, {}, state(0), {}};
        // Long runs of edits reach the limit, long runs of undo the beginning.
        for (int i = 0; i < 1500; ++i) {
            const auto kind = random() % 100;
            const unsigned long edits = run % 2 == 0 ? 85 : 45;
            if (kind < edits) {
                const Explorer next = random() % 10 == 0
                                          ? model.now
                                          : state(static_cast<int>(random() % 50),
                                                  model.now.play.tick, model.now.size.x);
                const char* gesture = gestures[random() % 5];
                history.edit(next, gesture);
                model.edit(next, gesture);
            } else if (kind < edits + 3) {
                history.endGesture();
                model.gesture.clear();
            } else if (kind < edits + 6) {
                model.now.play.tick = static_cast<std::int64_t>(random() % 256);
                model.now.size.x = 1 + static_cast<int>(random() % 1000);
                history.replace(model.now);
            } else if (random() % 2 == 0 && history.canUndo()) {
                history.undo();
                model.go(model.past, model.future);
            } else if (history.canRedo()) {
                history.redo();
                model.go(model.future, model.past);
            }
            ASSERT_TRUE(history.now() == model.now) << "run " << run << ", step " << i;
            ASSERT_EQ(history.canUndo(), !model.past.empty()) << "run " << run << ", step " << i;
            ASSERT_EQ(history.canRedo(), !model.future.empty()) << "run " << run << ", step " << i;
        }
        while (history.canUndo()) {
            history.undo();
            model.go(model.past, model.future);
            ASSERT_TRUE(history.now() == model.now) << "run " << run;
        }
        EXPECT_TRUE(model.past.empty());
    }
}

TEST(History, AGestureIsOneStep) {
    History history(state(0));
    for (int i = 1; i < 20; ++i) history.edit(state(i), "drag");
    history.endGesture();
    for (int i = 20; i < 40; ++i) history.edit(state(i), "drag");
    history.undo();
    EXPECT_TRUE(history.now() == state(19));
    history.undo();
    EXPECT_TRUE(history.now() == state(0));
    EXPECT_FALSE(history.canUndo());
    history.redo();
    history.redo();
    EXPECT_TRUE(history.now() == state(39));
}

TEST(History, AnEditAfterUndoForgetsWhatWasUndone) {
    History history(state(0));
    history.edit(state(1));
    history.edit(state(2));
    history.undo();
    history.edit(state(1));  // nothing: it is that already
    EXPECT_TRUE(history.canRedo());
    history.edit(state(3));
    EXPECT_FALSE(history.canRedo());
    history.undo();
    EXPECT_TRUE(history.now() == state(1));
}

TEST(History, KnowsWhatAGestureThatGoesOnBeganFrom) {
    History history(state(0));
    EXPECT_TRUE(history.before("drag") == state(0));
    history.edit(state(1), "drag");
    history.edit(state(2), "drag");
    EXPECT_TRUE(history.before("drag") == state(0));
    for (const char* other : {"", "slider"}) EXPECT_TRUE(history.before(other) == state(2));
    history.endGesture();
    EXPECT_TRUE(history.before("drag") == state(2));
}

TEST(History, TheSizeStaysThroughUndoAndRedo) {
    History history(state(0));
    history.edit(state(1));
    history.replace(state(1, 0, 640));
    history.undo();
    EXPECT_TRUE(history.now() == state(0, 0, 640));
    history.replace(state(0, 0, 800));
    EXPECT_TRUE(history.canRedo()) << "play forgets nothing";
    history.redo();
    EXPECT_TRUE(history.now() == state(1, 0, 800));
}

// Of one variable, a window of this half width.
Explorer swept(double delta, std::int64_t tick, double frequency = 0.1) {
    Explorer e = state(0, tick);
    e.layers.emplace_back();
    e.layers[0].motion = timeseries::SweepSettings{
        .animation = timeseries::RangeSet::parse("0:10"), .delta = delta, .frequency = frequency};
    return e;
}

TEST(History, ASweepStandsWhereItIsWhileItIsTheSame) {
    Explorer other = swept(1, 5);
    other.light = render::Light::Full;
    History history(swept(1, 5));
    history.edit(other);
    other.play.tick = 9;
    history.replace(other);
    history.undo();
    EXPECT_TRUE(history.now() == swept(1, 9));
    history.edit(swept(1, 9, 0.5));
    history.replace(swept(1, 12, 0.5));
    history.undo();
    EXPECT_TRUE(history.now() == swept(1, 12)) << "slower, where it has come to";
}

TEST(History, ASweepThatComesBackStandsWhereItWasLeft) {
    const Explorer still = state(0), another = [] {
        Explorer e = swept(1, 3);
        e.variable = "another";
        return e;
    }();
    for (const Explorer& next : {still, another, swept(2, 4)}) {
        History history(swept(1, 70));
        history.replace(swept(1, 90));
        history.edit(next);
        history.undo();
        EXPECT_TRUE(history.now() == swept(1, 90));
        history.redo();
        EXPECT_TRUE(history.now() == next);
    }
}

TEST(History, KeepsTheLastSteps) {
    History history(state(0));
    const int edits = static_cast<int>(History::kSteps) + 10;
    for (int i = 1; i <= edits; ++i) history.edit(state(i));
    int steps = 0;
    for (; history.canUndo(); ++steps) history.undo();
    EXPECT_EQ(steps, static_cast<int>(History::kSteps));
    EXPECT_TRUE(history.now() == state(10));
}

}  // namespace
}  // namespace app
