#include "app/desktop/rest.h"

#include <gtest/gtest.h>

namespace app::desktop {
namespace {

using namespace std::chrono_literals;

struct Frames {
    Rest rest;
    Rest::Clock::time_point now = Rest::Clock::now();

    // Ten milliseconds after the last one.
    bool after(bool changed, bool held) {
        now += 10ms;
        rest.frame(changed, held, now);
        return rest.is(now);
    }
};

TEST(Rest, ADragRestsWhenItIsLetGo) {
    Frames frames;
    for (int i = 0; i < 100; ++i) EXPECT_FALSE(frames.after(true, true)) << i;
    EXPECT_TRUE(frames.after(false, false));
    EXPECT_TRUE(frames.after(false, false));
}

// The last move and the release may come in one frame, which has the moved picture to draw first.
TEST(Rest, ADragRestsAfterAFrameThatBothMovesAndLetsGo) {
    Frames frames;
    frames.after(true, true);
    EXPECT_FALSE(frames.after(true, false));
    EXPECT_TRUE(frames.after(false, false));
}

TEST(Rest, AHandThatHesitatesIsNotMadeToWait) {
    for (const bool held : {true, false}) {
        Frames frames;
        frames.after(true, held);
        for (auto waited = 10ms; waited < Rest::kHesitation; waited += 10ms)
            EXPECT_FALSE(frames.after(false, held)) << waited.count();
        EXPECT_TRUE(frames.after(false, held));
    }
}

// A wheel's next notch may come.
TEST(Rest, WhatChangesAfterADragWaitsAgain) {
    Frames frames;
    frames.after(true, true);
    EXPECT_TRUE(frames.after(false, false));
    EXPECT_FALSE(frames.after(true, false));
    EXPECT_FALSE(frames.after(false, false));
}

}  // namespace
}  // namespace app::desktop
