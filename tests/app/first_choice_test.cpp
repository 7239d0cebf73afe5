#include "app/choices/first_choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <random>

#include "tests/support/measured_axis.h"
#include "tests/support/scenes.h"
#include "tests/support/sorted.h"
#include "tests/support/unstructured.h"

namespace app {
namespace {

using timeseries::SortedStep;

SortedStep stepOf(std::vector<double> values) {
    auto grid = std::make_shared<const timeseries::Grid>(
        std::array{tests::axis(values.size()), tests::axis(1), tests::axis(1)});
    return tests::sorted({std::move(grid), std::move(values), {}});
}

LayerChoice choiceFor(const SortedStep& step) { return firstChoice({step.quantiles(1025)}); }

double shareSelected(const SortedStep& step, const LayerChoice& layer) {
    return static_cast<double>(step.count(layer.ranges)) / static_cast<double>(step.size());
}

// What holds for every field whatever its values.
void expectSensible(const SortedStep& step, const std::string& which) {
    const LayerChoice layer = choiceFor(step);
    EXPECT_FALSE(layer.ranges.empty()) << which;
    EXPECT_TRUE(step.size() == 0 || step.count(layer.ranges) > 0)
        << which << ": " << layer.ranges.text();
    if (const auto* map = layer.color ? std::get_if<MapChoice>(&*layer.color) : nullptr) {
        ASSERT_TRUE(map->lo && map->hi) << which;
        EXPECT_TRUE(std::isfinite(*map->lo) && std::isfinite(*map->hi))
            << which << ": " << *map->lo << " to " << *map->hi;
        EXPECT_LE(*map->lo, *map->hi) << which;
    }
}

std::vector<double> drawn(const std::function<double(std::mt19937_64&)>& next,
                          std::size_t n = 20000, unsigned seed = 1) {
    std::mt19937_64 random(seed);
    std::vector<double> values(n);
    for (double& v : values) v = next(random);
    return values;
}

TEST(FirstChoice, ContinuousTailsGiveAboutATenth) {
    const std::pair<const char*, std::function<double(std::mt19937_64&)>> tails[] = {
        {"normal", [](auto& r) { return std::normal_distribution<double>(3, 2)(r); }},
        {"uniform", [](auto& r) { return std::uniform_real_distribution<double>(-1, 5)(r); }},
        {"exponential", [](auto& r) { return std::exponential_distribution<double>(2)(r); }},
        {"mirrored exponential",
         [](auto& r) { return 300 - std::exponential_distribution<double>(2)(r); }},
        {"lognormal", [](auto& r) { return std::lognormal_distribution<double>(0, 1)(r); }},
        {"wide lognormal", [](auto& r) { return std::lognormal_distribution<double>(0, 4)(r); }},
        {"widest lognormal", [](auto& r) { return std::lognormal_distribution<double>(0, 9)(r); }},
        {"Cauchy", [](auto& r) { return std::cauchy_distribution<double>(0, 1)(r); }},
        {"far from 0", [](auto& r) { return 1e6 + std::exponential_distribution<double>(1)(r); }}};
    for (const auto& [name, tail] : tails)
        for (const double scale : {1e-300, 1e-20, 0.37, 1.0, 1e20, 1e290}) {
            auto values = drawn(tail);
            for (double& v : values) v *= scale;
            const SortedStep step = stepOf(std::move(values));
            const double share = shareSelected(step, choiceFor(step));
            EXPECT_GT(share, 0.07)
                << name << " x " << scale << ": " << choiceFor(step).ranges.text();
            EXPECT_LT(share, 0.14)
                << name << " x " << scale << ": " << choiceFor(step).ranges.text();
            expectSensible(step, name);
        }
}

TEST(FirstChoice, TheReachesOnBothSidesDecideTheSide) {
    const auto rising = choiceFor(
        stepOf(drawn([](auto& r) { return std::exponential_distribution<double>(1)(r); })));
    EXPECT_EQ(timeseries::toDouble(rising.ranges.ranges().back().hi.value), kInfinity);
    EXPECT_GT(timeseries::toDouble(rising.ranges.ranges().front().lo.value), 0);

    const auto falling = choiceFor(
        stepOf(drawn([](auto& r) { return -std::exponential_distribution<double>(1)(r); })));
    EXPECT_EQ(timeseries::toDouble(falling.ranges.ranges().front().lo.value), -kInfinity);
    EXPECT_LT(timeseries::toDouble(falling.ranges.ranges().back().hi.value), 0);

    const auto both =
        choiceFor(stepOf(drawn([](auto& r) { return std::normal_distribution<double>()(r); })));
    ASSERT_EQ(both.ranges.ranges().size(), 2u);
    EXPECT_EQ(std::get<MapChoice>(both.color.value()).map.name(), "cool-warm");
}

// A velocity: nearly all is at rest, and more flows one way than the other.
TEST(FirstChoice, OnBothSidesTheTenthIsThatFarthestFromTheBackground) {
    auto values = drawn([](auto& r) {
        const double u = std::uniform_real_distribution<double>(0, 1)(r);
        return u < 0.69 ? 0.0 : u < 0.93 ? 0.69 - u : (u - 0.93) * 2.5;
    });
    const SortedStep step = stepOf(values);
    const LayerChoice layer = choiceFor(step);
    EXPECT_NEAR(shareSelected(step, layer), 0.1, 0.02) << layer.ranges.text();
    std::ranges::sort(values, {}, [](double v) { return std::abs(v); });
    const double tenth = std::abs(values[values.size() * 9 / 10]);
    // To three digits of how far they reach.
    ASSERT_EQ(layer.ranges.ranges().size(), 2u);
    EXPECT_NEAR(timeseries::toDouble(layer.ranges.ranges()[0].hi.value), -tenth, 2e-3);
    EXPECT_NEAR(timeseries::toDouble(layer.ranges.ranges()[1].lo.value), tenth, 2e-3);
}

// Where all of that tenth lies on one side, the colours are those of a field with one.
TEST(FirstChoice, OneOfTwoSidesIsColouredAsOne) {
    for (const int sign : {1, -1}) {
        const SortedStep step = stepOf(drawn([&](auto& r) {
            const double u = std::uniform_real_distribution<double>(0, 1)(r);
            return sign * (u < 0.06 ? -1.4 : u < 0.88 ? u : 3 + u);
        }));
        const LayerChoice layer = choiceFor(step);
        ASSERT_EQ(layer.ranges.ranges().size(), 1u);
        const auto& map = std::get<MapChoice>(layer.color.value());
        EXPECT_EQ(map.map.name(), sign > 0 ? "inferno" : "viridis");
        // From the range's end to the data's, all but the dark end is seen.
        const double from = 3.9, to = 4;  // the uppermost tenth
        EXPECT_NEAR(map.lo.value(),
                    sign > 0 ? from - kDarkEnd * (to - from) : -to - kDarkEnd * (to - from), 0.02);
        EXPECT_NEAR(map.hi.value(), sign > 0 ? to : -from, 0.02);
    }
}

TEST(FirstChoice, ATiedBackgroundIsLeftOut) {
    for (const double background : {0.0, 1.0, -273.15, 1.0 / 3, 1e300})
        for (const double share : {0.001, 0.02, 0.3}) {
            const double lump = background == 0 ? 1 : std::abs(background);
            const auto values = [&](int sign) {
                return drawn([&](auto& r) {
                    std::uniform_real_distribution<double> unit(0.1, 1);
                    const double u = unit(r);
                    return std::bernoulli_distribution(share)(r) ? background + sign * lump * u
                                                                 : background;
                });
            };
            for (const int sign : {1, -1}) {
                const SortedStep step = stepOf(values(sign));
                const LayerChoice layer = choiceFor(step);
                const timeseries::RangeSet tied(
                    std::vector{timeseries::Range{{background}, {background}}});
                const timeseries::RangeSet both = unionOf(std::vector{layer.ranges, tied});
                const auto what = "background " + std::to_string(background) + ", share " +
                                  std::to_string(share) + ": " + layer.ranges.text();
                EXPECT_EQ(step.count(both), step.count(layer.ranges) + step.count(tied)) << what;
                expectSensible(step, what);
            }
        }
}

// Land of an ocean model whose file names no fill value, at either end: the rest is chosen from.
TEST(FirstChoice, AValueFarFromAllOthersThatManyHaveIsLeftOut) {
    for (const double land : {0.0, -999.0, 1e20})
        for (const double share : {0.25, 0.4}) {
            const SortedStep step = stepOf(drawn([&](auto& r) {
                return std::bernoulli_distribution(share)(r)
                           ? land
                           : std::normal_distribution<double>(35, 1)(r);
            }));
            const LayerChoice layer = choiceFor(step);
            const auto what = std::to_string(land) + ": " + layer.ranges.text();
            const timeseries::RangeSet tied(std::vector{timeseries::Range{{land}, {land}}});
            EXPECT_EQ(step.count(unionOf(std::vector{layer.ranges, tied})),
                      step.count(layer.ranges) + step.count(tied))
                << what;
            EXPECT_NEAR(shareSelected(step, layer), 0.1 * (1 - share), 0.03) << what;
            expectSensible(step, what);
        }
    // A class, a phase: the other values reach as far, or there is nothing between.
    for (const double other : {0.0, 1.0}) {
        const SortedStep step = stepOf(drawn([&](auto& r) {
            const double u = std::uniform_real_distribution<double>(0, 1)(r);
            return u < 0.6 ? 1 - other : u < 0.9 ? other : (u - 0.9) * 10;
        }));
        const timeseries::RangeSet tied(std::vector{timeseries::Range{{other}, {other}}});
        EXPECT_EQ(step.count(unionOf(std::vector{choiceFor(step).ranges, tied})),
                  step.count(choiceFor(step).ranges))
            << other;
    }
}

// Rare values are seen by the quantiles' ends alone.
TEST(FirstChoice, AFewOutlyingPointsAreChosen) {
    for (const double outlier : {-10.0, 4.999, 5.001, 1e9}) {
        std::vector<double> values(20000, 5.0);
        values[77] = outlier;
        const SortedStep step = stepOf(values);
        // Three steps alike: as many low ends as the outermost thousandth may hold.
        const LayerChoice layer = firstChoice(Quantiles(3, step.quantiles(1025)));
        EXPECT_EQ(step.count(layer.ranges), 1u) << outlier << ": " << layer.ranges.text();
    }
}

TEST(FirstChoice, FewValuesGiveAChoiceThatHoldsSome) {
    const double some[] = {0, 1, 2.0 / 3, 1.0 / 3, -2.0 / 3, 0.66666, 12345.678, -1e-7, 1e300};
    for (const double a : some)
        for (const double b : some)
            for (const double c : some) {
                const std::string which = "values " + std::to_string(a) + " " + std::to_string(b) +
                                          " " + std::to_string(c);
                expectSensible(stepOf({a, b, c}), which);
                expectSensible(stepOf({a, b}), which);
                // And in plenty, so that quantiles repeat.
                std::vector<double> many;
                for (int i = 0; i < 350; ++i)
                    for (const double v : {a, b, c}) many.push_back(v);
                expectSensible(stepOf(many), which + " many times");
            }
}

TEST(FirstChoice, AConstantFieldIsSelectedWhole) {
    for (const double v : {0.0, 5.0, -1e300, 5e-324}) {
        const SortedStep step = stepOf(std::vector<double>(100, v));
        const LayerChoice layer = choiceFor(step);
        EXPECT_EQ(layer.ranges, timeseries::RangeSet::everything());
        EXPECT_EQ(step.count(layer.ranges), 100u);
    }
}

// Their quantiles are doubles, 128 and 2048 apart: a bound may lie beyond all values.
TEST(FirstChoice, IntegersThatDoublesHardlyTellApartAreSelectedWhole) {
    const auto of = [](auto first) {
        std::vector<decltype(first)> values(8000);
        for (auto& value : values) value = first++;
        auto grid = std::make_shared<const timeseries::Grid>(
            std::array{tests::axis(values.size()), tests::axis(1), tests::axis(1)});
        return tests::sorted({std::move(grid), std::move(values), {}});
    };
    for (const SortedStep& step : {of((std::int64_t{1} << 60) - 1), of(~std::uint64_t{0} - 7999)})
        EXPECT_EQ(step.count(choiceFor(step).ranges), 8000u);
    const SortedStep few = of(std::int64_t{1} << 40);
    EXPECT_NEAR(shareSelected(few, choiceFor(few)), 0.1, 0.02);
}

TEST(FirstChoice, WithoutPointsItIsTheWholeRange) {
    EXPECT_EQ(firstChoice({}).ranges, timeseries::RangeSet::everything());
    EXPECT_EQ(firstChoice({{}, {}}).ranges, timeseries::RangeSet::everything());
    expectSensible(stepOf({std::nan(""), std::nan("")}), "NaN alone");
}

TEST(FirstChoice, InfinitiesAreNoScale) {
    expectSensible(stepOf({kInfinity, kInfinity}), "all infinite");
    expectSensible(stepOf({-kInfinity, kInfinity, kInfinity}), "both infinities");
    auto values = drawn([](auto& r) { return std::exponential_distribution<double>(1)(r); });
    for (std::size_t i = 0; i < 40; ++i) values[i * 100] = i % 2 == 0 ? kInfinity : -kInfinity;
    const SortedStep step = stepOf(values);
    expectSensible(step, "some infinite");
    EXPECT_NEAR(shareSelected(step, choiceFor(step)), 0.1, 0.03);
}

TEST(FirstChoice, TheWidestScalesNeitherThrowNorOverflow) {
    constexpr double kMost = std::numeric_limits<double>::max();
    for (const double scale : {5e-324, 1e-310, 2.3e-308, 1e-300, 1e300, 1e308, kMost})
        for (const auto& shape : {std::vector<double>{0, 0, 0, 1},
                                  {-1, 0, 1},
                                  {-1, -1, 1},
                                  {-1, 1},
                                  {0.25, 0.5, 1},
                                  {-1, -0.5, -0.25}}) {
            std::vector<double> values;
            for (int i = 0; i < 500; ++i)
                for (const double v : shape) values.push_back(v * scale);
            expectSensible(stepOf(values), "scale " + std::to_string(scale) + ", shape of " +
                                               std::to_string(shape.size()));
        }
}

TEST(FirstChoice, RandomFieldsOfAnyKindAreShown) {
    std::mt19937_64 random(8);
    for (int i = 0; i < 1500; ++i) {
        // A mixture of a few tied values and noise, in any unit and far from 0.
        const std::size_t n = 1 + random() % 300;
        std::uniform_real_distribution<double> unit(-1, 1);
        const double scale = std::pow(10, 20 * unit(random)), offset = 1e3 * scale * unit(random);
        const double ties[] = {unit(random), unit(random), unit(random)};
        const std::size_t noise = random() % 4;
        std::vector<double> values(n);
        for (double& v : values)
            v = offset * static_cast<double>(random() % 2) * (i % 2) +
                scale * (random() % 4 < noise ? unit(random) : ties[random() % 3]);
        expectSensible(stepOf(values), "case " + std::to_string(i));
    }
}

TEST(FirstChoice, BoundsAreShort) {
    for (unsigned seed = 1; seed < 40; ++seed) {
        const LayerChoice layer = choiceFor(stepOf(
            drawn([](auto& r) { return 300 + 400 * std::exponential_distribution<double>(1)(r); },
                  5000, seed)));
        const std::string bound = timeseries::toText(layer.ranges.ranges().front().lo.value);
        EXPECT_LE(bound.size(), 5u) << bound;
    }
}

TEST(FirstChoice, BoundsHaveAsFewDigitsWhateverTheScale) {
    for (const double scale : {1e-290, 1e-20, 1.0, 1e15, 1e17, 1e37, 1e100, 1e305}) {
        const LayerChoice layer = choiceFor(stepOf(drawn([&](auto& r) {
            return scale * (3 + 4 * std::exponential_distribution<double>(1)(r));
        })));
        const double bound = timeseries::toDouble(layer.ranges.ranges().front().lo.value);
        char threeDigits[32];
        std::snprintf(threeDigits, sizeof threeDigits, "%.2e", bound);
        EXPECT_EQ(bound, std::strtod(threeDigits, nullptr)) << threeDigits;
    }
}

TEST(OpacityFor, FallsAsTheLumpGrowsAndStaysSeen) {
    const auto cube = tests::cube(3);
    double last = 1;
    for (std::uint64_t points = 1; points < (std::uint64_t{1} << 40); points *= 2) {
        const double opacity = opacityFor(points);
        EXPECT_LE(opacity, last);
        EXPECT_GE(opacity, 0.01);
        EXPECT_LE(opacity, 0.9);
        last = opacity;
    }
    EXPECT_EQ(opacityFor(0), opacityFor(1));
    // An optical depth of 4 through cbrt(n) cells: 1 - (1 - a)^cbrt(n) = 1 - exp(-4).
    EXPECT_NEAR(std::pow(1 - opacityFor(27000, *cube), 30), std::exp(-4), 1e-12);
}

// However many points it has, one cell is all that is seen through.
TEST(OpacityFor, IsThatOfOneCellOnASheet) {
    const auto measured = [](int count) {
        return tests::measuredAxis("x", "m", 0, count - 1, count);
    };
    for (int flat = 0; flat < 3; ++flat) {
        std::array axes{measured(40), measured(40), measured(40)};
        axes[static_cast<std::size_t>(flat)] = measured(1);
        const timeseries::Grid sheet(axes);
        EXPECT_EQ(opacityFor(1000, sheet), opacityFor(1)) << flat;
        EXPECT_EQ(opacityFor(1000, sheet), 0.9) << "1 - exp(-4), but seen through";
    }
}

// As two-dimensional flows are stored: cells between two planes.
TEST(OpacityFor, IsThatOfOneCellInOneLayerOfCells) {
    const auto layersOf = [](std::uint32_t layers) {
        return tests::gridOf(tests::atCells(tests::bricks(
            {11, 11, layers + 1}, tests::Cut::Hexahedra,
            [](double i, double j, double k) { return glm::dvec3(0.1 * i, 0.1 * j, 0.01 * k); })));
    };
    EXPECT_EQ(opacityFor(100, *layersOf(1)), opacityFor(1));
    EXPECT_EQ(opacityFor(100, *layersOf(2)), opacityFor(100));
}

TEST(ExtentOf, IsTheFiniteOneOfAllSteps) {
    EXPECT_EQ(extentOf({}).lo, 0);
    EXPECT_EQ(extentOf({}).hi, 0);
    const Extent extent = extentOf({{-kInfinity, 2, 3}, {1, kInfinity}, {}, {std::nan(""), 2}});
    EXPECT_EQ(extent.lo, 1);
    EXPECT_EQ(extent.hi, 3);
}

}  // namespace
}  // namespace app
