#include "render/frame/frame_pace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace render {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr nanoseconds kTarget = 16ms;

// A machine whose frames take fixed + splats * perSplat, to within `noise` of that.
struct Machine {
    double fixedNs, perSplatNs, noise = 0;
    std::mt19937 random{5};

    double exactly(std::uint64_t splats) const {
        return fixedNs + perSplatNs * static_cast<double>(splats);
    }
    nanoseconds frame(std::uint64_t splats) {
        std::uniform_real_distribution<double> off(-noise, noise);
        return nanoseconds(std::llround(exactly(splats) * (1 + off(random))));
    }
    // What the budget would be, were the machine known.
    double ideal() const {
        return std::max((1e6 * 16 - fixedNs) / perSplatNs, double{FramePace::kFewest});
    }
};

TEST(FramePace, FramesTakeTheirTargetWithinTenFramesOnAnyMachine) {
    for (const double fixed : {0.0, 1e6, 4e6, 8e6, 12e6})
        for (const double perSplat : {1.0, 5.0, 50.0, 200.0})
            for (const double noise : {0.0, 0.05}) {
                Machine machine{fixed, perSplat, noise};
                if (machine.ideal() <= FramePace::kFewest) continue;
                FramePace pace(kTarget);
                for (int i = 0; i < 10; ++i) pace.took(pace.budget(), machine.frame(pace.budget()));
                for (int i = 0; i < 20; ++i) {
                    EXPECT_NEAR(machine.exactly(pace.budget()), 16e6, 0.2 * 16e6)
                        << fixed << ' ' << perSplat << ' ' << noise << " frame " << 10 + i;
                    pace.took(pace.budget(), machine.frame(pace.budget()));
                }
            }
}

TEST(FramePace, WhatFitsIntoATimeIsOfSplatsAlone) {
    FramePace pace(kTarget);
    EXPECT_EQ(pace.fitting(100ms), FramePace::kFirst);
    for (const double perSplat : {5.0, 50.0, 500.0}) {
        Machine machine{4e6, perSplat};
        for (int i = 0; i < 10; ++i) pace.took(pace.budget(), machine.frame(pace.budget()));
        EXPECT_NEAR(static_cast<double>(pace.fitting(100ms)), 100e6 / perSplat, 1e6 / perSplat);
        EXPECT_EQ(pace.fitting(0ms), FramePace::kFewest);
    }
}

TEST(FramePace, AMachineThatCannotKeepTheTargetDrawsTheFewest) {
    for (Machine machine : {Machine{0, 5000}, Machine{30e6, 1}, Machine{1e10, 1e6}}) {
        FramePace pace(kTarget);
        for (int i = 0; i < 10; ++i) pace.took(pace.budget(), machine.frame(pace.budget()));
        EXPECT_EQ(pace.budget(), FramePace::kFewest);
    }
}

TEST(FramePace, ASingleLateFrameChangesNothing) {
    Machine machine{2e6, 100};
    FramePace pace(kTarget);
    for (int i = 0; i < 20; ++i) pace.took(pace.budget(), machine.frame(pace.budget()));
    const std::uint64_t settled = pace.budget();
    pace.took(settled, 900ms);
    EXPECT_EQ(pace.budget(), settled);
    for (int i = 0; i < 5; ++i) {
        pace.took(settled, machine.frame(settled));
        EXPECT_EQ(pace.budget(), settled);
    }
}

TEST(FramePace, ALastingChangeIsFollowedInTenFrames) {
    FramePace pace(kTarget);
    for (const double perSplat : {20.0, 200.0, 10.0}) {
        Machine machine{1e6, perSplat};
        for (int i = 0; i < 10; ++i) pace.took(pace.budget(), machine.frame(pace.budget()));
        EXPECT_NEAR(machine.exactly(pace.budget()), 16e6, 0.2 * 16e6) << perSplat;
    }
}

TEST(FramePace, SmallChangesDoNotMoveTheBudget) {
    Machine machine{1e6, 100, 0.03};
    FramePace pace(kTarget);
    for (int i = 0; i < 20; ++i) pace.took(pace.budget(), machine.frame(pace.budget()));
    const std::uint64_t settled = pace.budget();
    for (int i = 0; i < 200; ++i) {
        pace.took(settled, machine.frame(settled));
        ASSERT_EQ(pace.budget(), settled) << "frame " << i;
    }
}

TEST(FramePace, AnotherTargetCountsAtOnce) {
    Machine machine{0, 100};
    FramePace pace(kTarget);
    for (int i = 0; i < 20; ++i) pace.took(pace.budget(), machine.frame(pace.budget()));
    pace.setTarget(2 * kTarget);
    EXPECT_NEAR(machine.exactly(pace.budget()), 32e6, 0.2 * 32e6);
    pace.setTarget(kTarget / 2);
    EXPECT_NEAR(machine.exactly(pace.budget()), 8e6, 0.2 * 8e6);
}

TEST(FramePace, FramesWithoutSplatsOrWithoutTimeLeaveABudget) {
    FramePace empty(kTarget);
    for (int i = 0; i < 100; ++i) empty.took(0, 1ms);
    EXPECT_GE(empty.budget(), FramePace::kFewest);
    EXPECT_LE(empty.budget(), FramePace::kMost);
    FramePace instant(kTarget);
    for (int i = 0; i < 100; ++i) instant.took(instant.budget(), 0ns);
    EXPECT_GT(instant.budget(), 10 * FramePace::kFirst);
    EXPECT_LE(instant.budget(), FramePace::kMost);
    // And a machine that turns out to be slow is still followed.
    Machine machine{1e6, 100};
    for (int i = 0; i < 40; ++i) instant.took(instant.budget(), machine.frame(instant.budget()));
    EXPECT_NEAR(machine.exactly(instant.budget()), 16e6, 0.2 * 16e6);
    FramePace none(0ns);
    none.took(1000, 1ms);
    EXPECT_EQ(none.budget(), FramePace::kFewest);
}

// Whose splats cost nothing that can be told from what every frame takes.
TEST(FramePace, FramesOfFewSplatsPromiseNothingOfMany) {
    Machine machine{3e6, 500};
    FramePace pace(kTarget);
    for (int i = 0; i < 100; ++i) pace.took(10, machine.frame(0));
    EXPECT_LE(pace.budget(), FramePace::kFirst);
    for (int i = 0; i < 10; ++i) pace.took(pace.budget(), machine.frame(pace.budget()));
    EXPECT_NEAR(machine.exactly(pace.budget()), 16e6, 0.2 * 16e6);
}

TEST(FramePace, BeforeTheFirstFrameThereIsABudget) {
    EXPECT_EQ(FramePace(kTarget).budget(), FramePace::kFirst);
}

TEST(FramePace, BeginsWhereItIsToldAndLearnsFromThere) {
    Machine machine{0, 100};
    FramePace pace(kTarget, 30'000);
    EXPECT_EQ(pace.budget(), 30'000u);
    for (int i = 0; i < 10; ++i) pace.took(pace.budget(), machine.frame(pace.budget()));
    EXPECT_NEAR(machine.exactly(pace.budget()), 16e6, 0.2 * 16e6);
}

// What a machine teaches within ten frames.
FramePace taughtBy(Machine machine) {
    FramePace pace(kTarget);
    for (int i = 0; i < 10; ++i) pace.took(pace.budget(), machine.frame(pace.budget()));
    return pace;
}

TEST(FramePace, BegunFromWhatAnotherLearntItForetellsTheSame) {
    EXPECT_FALSE(FramePace(kTarget).learnt());
    const FramePace taught = taughtBy({4e6, 50});
    ASSERT_TRUE(taught.learnt());
    EXPECT_NEAR(taught.learnt()->fixedNs, 4e6, 1e3);
    EXPECT_NEAR(taught.learnt()->perSplatNs, 50, 0.01);
    FramePace pace(kTarget, 30'000);
    pace.beginFrom(*taught.learnt());
    EXPECT_EQ(pace.learnt(), taught.learnt());
    EXPECT_NEAR(static_cast<double>(pace.budget()), 12e6 / 50, 10);
    for (const std::uint64_t splats : {0u, 20'000u, 1'000'000u})
        EXPECT_EQ(pace.predicted(splats), taught.predicted(splats)) << splats;
    EXPECT_EQ(pace.fitting(100ms), taught.fitting(100ms));
    pace.setTarget(kTarget / 2);
    EXPECT_NEAR(static_cast<double>(pace.budget()), 4e6 / 50, 10);
}

TEST(FramePace, BegunFromAnotherMachineItLearnsItsOwnWithinTenFrames) {
    const std::vector<Machine> machines = {{0, 1}, {8e6, 1}, {0, 50}, {4e6, 50}, {0, 200}};
    for (const Machine& other : machines)
        for (Machine machine : machines) {
            machine.noise = 0.02;
            FramePace pace(kTarget);
            pace.beginFrom({other.fixedNs, other.perSplatNs, other.ideal()});
            for (int i = 0; i < 10; ++i) pace.took(pace.budget(), machine.frame(pace.budget()));
            EXPECT_NEAR(machine.exactly(pace.budget()), 16e6, 0.2 * 16e6)
                << other.fixedNs << ' ' << other.perSplatNs << ", then " << machine.fixedNs << ' '
                << machine.perSplatNs;
        }
}

TEST(FramePace, WhatAnotherLearntTellsNothingOfManyMoreSplats) {
    FramePace pace(kTarget);
    pace.beginFrom({0, 0, 50'000});
    EXPECT_EQ(pace.budget(), 150'000u);
    pace.beginFrom({0, 0, 10});
    EXPECT_EQ(pace.budget(), FramePace::kFirst);
    pace.beginFrom({1e9, 1e6, 50'000});
    EXPECT_EQ(pace.budget(), FramePace::kFewest);
}

TEST(FramePace, LearnsNothingThatAnotherCouldUseFromFramesThatDoNotTellWhatASplatCosts) {
    const auto learnt = [](Machine machine, std::vector<std::uint64_t> frames) {
        FramePace pace(kTarget);
        for (const std::uint64_t splats : frames) pace.took(splats, machine.frame(splats));
        return pace.learnt().has_value();
    };
    EXPECT_TRUE(learnt({1e6, 50}, {50'000, 60'000}));
    EXPECT_FALSE(learnt({1e6, 50}, {60'000})) << "one";
    EXPECT_FALSE(learnt({1e6, 50}, {60'000, 60'000, 61'000})) << "alike";
    EXPECT_FALSE(learnt({1e6, 50}, {0, 2, 500})) << "of few splats";
    EXPECT_FALSE(learnt({7e6, 1}, {50'000, 60'000})) << "whose time is not that of splats";
}

TEST(FramePace, PredictsFramesOfOtherSizes) {
    Machine machine{3e6, 200};
    FramePace pace(kTarget);
    EXPECT_EQ(pace.predicted(1000), 0ns);
    for (const std::uint64_t splats : {20'000u, 40'000u, 30'000u, 60'000u})
        pace.took(splats, machine.frame(splats));
    for (const std::uint64_t splats : {10'000u, 50'000u, 1'000'000u})
        EXPECT_NEAR(static_cast<double>(pace.predicted(splats).count()), machine.exactly(splats),
                    0.25 * machine.exactly(splats))
            << splats;
}

}  // namespace
}  // namespace render
