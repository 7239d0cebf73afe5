// Modelled machines and displays: what frames cost in, what the next ones may hold out.
#include "app/headset/display_pace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "xr/display_period.h"

namespace app::headset {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

// What the next frame may hold.
std::uint64_t splats(const DisplayPace& pace) { return pace.governor().limits(nullptr).splats; }

// A frame takes `fixed` ms and `perPixels` more at full resolution; each splat `perSplat` ns, and
// more where it stands for others, since it is larger. Noise of a twentieth.
struct Machine {
    double fixed, perPixels, perSplat;
    double load = 1;  // other programs make everything so much slower
    std::mt19937 random{7};

    double exactly(double splats, double stride, double scale) const {
        const double each = perSplat * (1 + 0.05 * (std::cbrt(stride * stride) - 1));
        return load * (fixed + perPixels * scale * scale + 1e-6 * each * splats * scale);
    }
    double frame(double splats, double stride, double scale) {
        return exactly(splats, stride, scale) * std::normal_distribution<double>(1, 0.05)(random);
    }
};

// A headset's loop around it: a volume of so many points, seen by two eyes, of which each stride
// draws one of so many; and a runtime that asks for frames at whole periods of its display, and
// predicts to a slow program what it takes.
struct Loop {
    Machine machine;
    double points;
    nanoseconds display = 50ms;

    DisplayPace pace = DisplayPace();
    xr::DisplayPeriod period = {};
    int frames = 0, missed = 0, changes = 0;
    double stride = 0, time = 0, predicted = 1;

    double drawn() const { return 2 * points / stride; }
    double work() const { return machine.exactly(drawn(), stride, pace.scale()); }
    static double ms(nanoseconds t) { return std::chrono::duration<double, std::milli>(t).count(); }

    void frame() {
        double next = 1;  // as Canvas chooses it
        while (next < 256 && 2 * points / next > static_cast<double>(splats(pace))) next *= 2;
        changes += stride != 0 && next != stride ? 1 : 0;
        stride = next;
        const double took = machine.frame(drawn(), stride, pace.scale());
        period.predicted(static_cast<int>(predicted) * display);
        const double periods = predicted = std::max(1.0, std::ceil(took / ms(display)));
        const nanoseconds work(std::llround(1e6 * took));
        pace.took({period.now(), work,
                   DisplayPace::FrameCost::Splats{static_cast<std::uint64_t>(drawn()),
                                                  static_cast<std::uint64_t>(points / 128), work}});
        ++frames;
        missed += static_cast<int>(periods) - 1;
        time += periods * ms(display) / 1000;
    }
    void run(double seconds) {
        frames = missed = changes = 0;
        for (const double end = time + seconds; time < end;) frame();
    }
    // Whether the next finer subset would fill its share, or there is none.
    bool isFull() const {
        return stride == 1 || machine.exactly(2 * drawn(), stride / 2, 1) > 0.6 * ms(display);
    }
    double missedShare() const { return static_cast<double>(missed) / (frames + missed); }
};

// From a machine that draws everything to one that can hardly draw anything.
Loop loopOf(int which) {
    constexpr double kMillion = 1e6;
    switch (which) {
        case 0:
            return {{2, 5, 1}, kMillion};
        case 1:
            return {{5, 12, 60}, kMillion};
        case 2:
            return {{15, 10, 200}, kMillion};
        case 3:
            return {{1, 3, 100}, 60'000};
        case 4:
            return {{0.5, 1.5, 20}, kMillion, 11111111ns};
        default:
            return {{2, 3, 40}, 4 * kMillion, 16666667ns};
    }
}

class GovernedLoop : public testing::TestWithParam<int> {
 protected:
    Loop loop_ = loopOf(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Machines, GovernedLoop, testing::Range(0, 6));

TEST_P(GovernedLoop, ComesToRestWhereFramesAreInTimeAndDoesNotSwing) {
    loop_.run(10);
    loop_.run(60);
    EXPECT_LE(loop_.missedShare(), 0.01);
    EXPECT_LE(loop_.changes, 4) << "of the stride, in a minute";
    EXPECT_EQ(loop_.pace.scale(), 1) << "fewer splats come before fewer pixels";
}

TEST_P(GovernedLoop, DrawsWhatThereIsTimeFor) {
    loop_.run(20);
    EXPECT_TRUE(loop_.isFull()) << "stride " << loop_.stride;
}

TEST_P(GovernedLoop, IsBackFiveSecondsAfterEightOfForeignLoad) {
    loop_.run(30);
    for (const double load : {2.0, 4.0, 8.0}) {
        loop_.machine.load = load;
        loop_.run(8);
        loop_.machine.load = 1;
        loop_.run(5);
        EXPECT_TRUE(loop_.isFull()) << load << ", stride " << loop_.stride;
        EXPECT_EQ(loop_.pace.scale(), 1) << load;
        loop_.run(10);
        EXPECT_LE(loop_.missedShare(), 0.01) << load;
    }
}

// What cost is left with the fewest splats is for the pixels to lower, and only that.
TEST(DisplayPace, LowersTheResolutionWhereNotEvenTheFewestSplatsFit) {
    Loop loop{{5, 60, 50}, 1e6};
    loop.run(20);
    EXPECT_LT(loop.pace.scale(), 1);
    EXPECT_LT(loop.work(), 50);
    loop.run(60);
    EXPECT_LE(loop.missedShare(), 0.01);
    loop.machine.perPixels = 5;
    loop.run(10);
    EXPECT_EQ(loop.pace.scale(), 1);
}

// Of a machine that is late at every rate, then of one that is not, and fills its splats' share of
// each period.
TEST(DisplayPace, ASlowerDisplayIsTheLastResortAndNoneForLong) {
    Loop loop{{14, 0, 5}, 1e6};
    loop.pace = DisplayPace({90, 72});
    const auto run = [&](int frames) {
        for (int i = 0; i < frames; ++i) {
            const double rate = *loop.pace.refreshRate().wanted();
            loop.display = nanoseconds(std::llround(1e9 / rate));
            loop.period.told(rate);
            loop.frame();
        }
    };
    run(2000);
    EXPECT_EQ(loop.pace.refreshRate().wanted(), 72);
    loop.machine.fixed = 2;
    run(4000);
    EXPECT_EQ(loop.pace.refreshRate().wanted(), 90);
}

TEST(DisplayPace, WithoutAPeriodNothingIsLearnt) {
    DisplayPace pace;
    const std::uint64_t first = splats(pace);
    for (int i = 0; i < 100; ++i) pace.took({0ns, 1s, DisplayPace::FrameCost::Splats{1000, 0, 1s}});
    EXPECT_EQ(splats(pace), first);
    EXPECT_EQ(pace.scale(), 1);
}

}  // namespace
}  // namespace app::headset
