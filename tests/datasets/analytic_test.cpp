#include "datasets/analytic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "timeseries/series/step_loader.h"

namespace datasets {
namespace {

constexpr double kPi = std::numbers::pi;

struct RandomPoints {
    std::mt19937_64 random{37};
    std::uniform_real_distribution<double> unit{-1, 1};
    glm::dvec3 operator()(double scale = 1) {
        const double x = unit(random), y = unit(random), z = unit(random);
        return scale * glm::dvec3(x, y, z);
    }
};

// Central differences; the error is of the order h^2 times the third derivative.
glm::dvec3 gradient(const Function& f, const glm::dvec3& p, double t, double h = 1e-5) {
    glm::dvec3 g;
    for (int a = 0; a < 3; ++a) {
        glm::dvec3 step(0);
        step[a] = h;
        g[a] = (f(p + step, t) - f(p - step, t)) / (2 * h);
    }
    return g;
}

std::vector<std::pair<std::string, Function>> all() {
    return {{"sphere", SphereRamp{.middle = {0.1, 0.2, 0.3}, .orbitRadius = 0.5, .period = 4}},
            {"linear", LinearRamp{.slope = {1, -2, 0.5}, .speed = 0.25}},
            {"marschner-lobb", MarschnerLobb{}},
            {"abc", AbcFlowSpeed{.drift = 0.3}},
            {"turbulence", Turbulence()}};
}

TEST(SphereRamp, IsTheDistanceFromTheCentre) {
    const SphereRamp f{.middle = {1, 2, 3}};
    EXPECT_EQ(f({1, 2, 3}, 0), 0);
    EXPECT_EQ(f({4, 6, 3}, 9), 5);  // 3-4-5
    EXPECT_EQ(f({1, 2, -9}, 0), 12);
}

TEST(SphereRamp, TheCentreGoesRoundOnceAPeriod) {
    const SphereRamp f{.middle = {1, 1, 1}, .orbitRadius = 2, .period = 8};
    const glm::dvec3 quarters[] = {{3, 1, 1}, {1, 3, 1}, {-1, 1, 1}, {1, -1, 1}, {3, 1, 1}};
    for (int i = 0; i < 5; ++i) EXPECT_NEAR(f(quarters[i], 2.0 * i), 0, 1e-14) << "quarter " << i;
}

TEST(SphereRamp, TheGradientPointsAwayFromTheCentreAndHasLengthOne) {
    const SphereRamp f{.middle = {0.1, 0, 0}, .orbitRadius = 0.3, .period = 5};
    RandomPoints point;
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 p = point(2);
        const glm::dvec3 away = glm::normalize(p - f.centre(i));
        if (f(p, i) < 0.1) continue;  // the third derivative grows as 1 / r^2
        EXPECT_LT(glm::length(gradient(f, p, i) - away), 1e-7) << "point " << i;
    }
}

TEST(LinearRamp, HasItsSlopeAndMovesAlongIt) {
    const LinearRamp f{.slope = {3, 0, 4}, .speed = 10};
    EXPECT_EQ(f({1, 7, 2}, 0), 11);
    EXPECT_EQ(f({1, 7, 2}, 1), 1);
    // The plane of value 0 has gone 10 t / |slope| along the slope's direction.
    EXPECT_NEAR(f(glm::dvec3(0.6, 0, 0.8) * 2.0 * 1.5, 1.5), 0, 1e-12);
}

TEST(MarschnerLobb, HasTheValuesOfTheFormula) {
    const MarschnerLobb f;
    // On the axis cos(pi r / 2) = 1, cos(12 pi) = 1: (1 - sin(pi z / 2) + 0.5) / 2.5.
    EXPECT_NEAR(f({0, 0, 0}, 0), 0.6, 1e-15);
    EXPECT_NEAR(f({0, 0, -1}, 0), 1, 1e-15);
    EXPECT_NEAR(f({0, 0, 1}, 0), 0.2, 1e-15);
    // At r = 1 the inner cosine is 0 and the outer 1.
    EXPECT_NEAR(f({0.6, 0.8, 0}, 0), 0.6, 1e-14);
    // 2 pi 6 cos(pi r / 2) = 11 pi: the outer cosine is -1, and nothing is added.
    const double r = 2 / kPi * std::acos(11.0 / 12);
    EXPECT_NEAR(f({0, r, 0}, 0), 1 / 2.5, 1e-12);
}

TEST(MarschnerLobb, StaysBetweenZeroAndOneAndIsRoundAboutZ) {
    const MarschnerLobb f;
    RandomPoints point;
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 p = point();
        EXPECT_GE(f(p, 0), 0);
        EXPECT_LE(f(p, 0), 1);
        EXPECT_NEAR(f(p, 0), f({std::hypot(p.x, p.y), 0, p.z}, i), 1e-12);
    }
}

TEST(AbcFlowSpeed, HasTheValuesOfTheFlow) {
    const AbcFlowSpeed f;
    // u = (A sin z + C cos y, B sin x + A cos z, C sin y + B cos x)
    EXPECT_NEAR(f({0, 0, 0}, 0), std::sqrt(1.0 + 3 + 2), 1e-15);  // (C, A, B)
    EXPECT_NEAR(f({kPi / 2, 0, kPi / 2}, 0), std::hypot(std::sqrt(3.0) + 1, std::sqrt(2.0)), 1e-14);
}

TEST(AbcFlowSpeed, IsABeltramiFlow) {
    // Its curl is itself (Dombre et al. 1986), which no wrong sign or swapped axis survives.
    const AbcFlowSpeed f{.drift = 0.7};
    RandomPoints point;
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 p = point(5);
        const auto d = [&](int component, int axis) {
            return gradient(
                [&](const glm::dvec3& q, double t) { return f.velocity(q, t)[component]; }, p,
                2)[axis];
        };
        const glm::dvec3 curl(d(2, 1) - d(1, 2), d(0, 2) - d(2, 0), d(1, 0) - d(0, 1));
        EXPECT_LT(glm::length(curl - f.velocity(p, 2)), 1e-8) << "point " << i;
        EXPECT_NEAR(d(0, 0) + d(1, 1) + d(2, 2), 0, 1e-9) << "point " << i;
    }
}

TEST(AbcFlowSpeed, IsPeriodicBoundedAndDrifts) {
    const AbcFlowSpeed f{.drift = 0.5};
    RandomPoints point;
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 p = point(3);
        EXPECT_NEAR(f(p, 1), f(p + 2 * kPi * glm::dvec3(1, -2, 3), 1), 1e-12);
        EXPECT_NEAR(f(p, 0), f(p + glm::dvec3(2.0), 4), 1e-12);
        EXPECT_LE(f(p, 1), f.A + f.B + f.C);
    }
}

TEST(Turbulence, IsTheSumOfItsWaves) {
    const Turbulence f({.waves = 5});
    ASSERT_EQ(f.waves().size(), 5u);
    const glm::dvec3 p(0.3, -0.2, 0.9);
    double sum = 0, most = 0;
    for (const Turbulence::Wave& w : f.waves()) {
        sum +=
            w.amplitude * std::cos(w.k.x * p.x + w.k.y * p.y + w.k.z * p.z + w.phase - w.omega * 2);
        most += w.amplitude;
    }
    EXPECT_NEAR(f(p, 2), sum, 1e-12);
    EXPECT_LE(std::abs(f(p, 2)), most);
}

TEST(Turbulence, FollowsKolmogorovsSpectrum) {
    // 8 waves an octave over 5 octaves. An octave's energy is the integral of k^(-5/3), which falls
    // by 2^(-2/3) from one to the next.
    const Turbulence f({.waves = 41, .leastWaveNumber = 1, .greatestWaveNumber = 32});
    double energy[5] = {}, variance = 0;
    for (std::size_t i = 0; i < 41; ++i) {
        const Turbulence::Wave& w = f.waves()[i];
        EXPECT_NEAR(glm::length(w.k), std::pow(2.0, static_cast<double>(i) / 8), 1e-12);
        EXPECT_NEAR(w.omega, std::pow(glm::length(w.k), 2.0 / 3), 1e-12);
        if (i < 40) energy[i / 8] += w.amplitude * w.amplitude / 2;
        variance += w.amplitude * w.amplitude / 2;
    }
    EXPECT_NEAR(variance, 1, 1e-12);
    for (int octave = 1; octave < 5; ++octave)
        EXPECT_NEAR(energy[octave] / energy[octave - 1], std::pow(2.0, -2.0 / 3), 1e-12) << octave;
}

TEST(Turbulence, HasMeanZeroAndVarianceOneOverSpace) {
    const Turbulence f;
    RandomPoints point;
    constexpr int kPoints = 20000;
    double sum = 0, squares = 0;
    for (int i = 0; i < kPoints; ++i) {
        const double v = f(point(1000), 0);
        sum += v;
        squares += v * v;
    }
    // Five standard errors: 1 / sqrt(n) of the mean, about sqrt(2 / n) of the variance.
    EXPECT_NEAR(sum / kPoints, 0, 5 / std::sqrt(kPoints));
    EXPECT_NEAR(squares / kPoints, 1, 5 * std::sqrt(2.0 / kPoints));
}

TEST(Turbulence, TheSeedDecides) {
    const glm::dvec3 p(0.1, 0.2, 0.3);
    EXPECT_EQ(Turbulence({.seed = 5})(p, 1), Turbulence({.seed = 5})(p, 1));
    EXPECT_NE(Turbulence({.seed = 5})(p, 1), Turbulence({.seed = 6})(p, 1));
}

TEST(Turbulence, GradientIsBoundedByItsWaves) {
    const Turbulence f;
    double most = 0;
    for (const Turbulence::Wave& w : f.waves()) most += w.amplitude * glm::length(w.k);
    RandomPoints point;
    for (int i = 0; i < 100; ++i) EXPECT_LE(glm::length(gradient(f, point(), 0)), most);
}

TEST(UniformGrid, SpansTheBox) {
    const auto grid = uniformGrid({5, 1, 2}, {{-1, 0, 10}, {3, 1, 20}});
    EXPECT_EQ(grid->axes()[0].coordinates, (std::vector{-1.0, 0.0, 1.0, 2.0, 3.0}));
    EXPECT_EQ(grid->axes()[1].coordinates, std::vector{0.5});
    EXPECT_EQ(grid->axes()[2].coordinates, (std::vector{10.0, 20.0}));
    EXPECT_TRUE(grid->uniform());
}

TEST(UniformGrid, RefusesWhatIsNoBox) {
    const double inf = std::numeric_limits<double>::infinity();
    EXPECT_THROW(uniformGrid({0, 1, 1}, {}), std::invalid_argument);
    EXPECT_THROW(uniformGrid({2, 2, 2}, {{0, 0, 0}, {1, 0, 1}}), std::invalid_argument);
    EXPECT_THROW(uniformGrid({2, 2, 2}, {{0, 0, 0}, {1, inf, 1}}), std::invalid_argument);
}

TEST(Sample, EqualsTheClosedFormAtEveryGridPosition) {
    const auto grid = uniformGrid({7, 5, 6}, {{-1, -0.5, 0}, {1, 0.25, 2}});
    for (const auto& [name, f] : all()) {
        const auto f64 = sample(f, grid, 1.25, Precision::F64);
        const auto f32 = sample(f, grid, 1.25, Precision::F32);
        const auto& doubles = std::get<std::vector<double>>(f64.values);
        const auto& floats = std::get<std::vector<float>>(f32.values);
        ASSERT_EQ(doubles.size(), grid->count());
        ASSERT_EQ(floats.size(), grid->count());
        EXPECT_TRUE(f64.missing.empty());
        for (std::size_t i = 0; i < doubles.size(); ++i) {
            EXPECT_EQ(doubles[i], f(grid->position(i), 1.25)) << name << " at " << i;
            EXPECT_EQ(floats[i], static_cast<float>(doubles[i])) << name << " at " << i;
        }
    }
}

TEST(Sample, AFinerGridHoldsTheCoarserOnesValues) {
    const Box box{{-0.9, 0.1, -2}, {0.7, 1.3, 5}};
    const auto coarse = uniformGrid({8, 4, 3}, box);
    for (const std::size_t m : {2, 3, 5}) {
        const auto fine = uniformGrid({7 * m + 1, 3 * m + 1, 2 * m + 1}, box);
        for (const auto& [name, f] : all()) {
            const auto cField = sample(f, coarse, 0.5, Precision::F64);
            const auto fField = sample(f, fine, 0.5, Precision::F64);
            const auto& c = std::get<std::vector<double>>(cField.values);
            const auto& d = std::get<std::vector<double>>(fField.values);
            const auto [nx, ny, nz] = fine->size();
            for (std::size_t z = 0; z < 3; ++z)
                for (std::size_t y = 0; y < 4; ++y)
                    for (std::size_t x = 0; x < 8; ++x)
                        EXPECT_EQ(c[x + 8 * (y + 4 * z)], d[m * x + nx * (m * y + ny * (m * z))])
                            << name << " " << x << "," << y << "," << z;
        }
    }
}

TEST(Sample, MovingFieldsMoveAndAgreeOnEveryRun) {
    const auto grid = uniformGrid({6, 6, 6}, {});
    for (const auto& [name, f] : all()) {
        EXPECT_EQ(sample(f, grid, 1).values, sample(f, grid, 1).values) << name;
        EXPECT_EQ(sample(f, grid, 1).values == sample(f, grid, 2).values, name == "marschner-lobb")
            << name;
    }
}

TEST(AnalyticReader, IsASeriesWithItsTimes) {
    const auto grid = uniformGrid({4, 4, 4}, {});
    AnalyticReader reader({{"r", SphereRamp{.orbitRadius = 0.5, .period = 9}, Precision::F32},
                           {"v", AbcFlowSpeed{.drift = 1}, Precision::F64}},
                          grid, {-1.5, 0.0, 0.1, 7.0});
    ASSERT_EQ(reader.variables().size(), 2u);
    EXPECT_EQ(reader.variables()[0].name, "r");
    EXPECT_EQ(reader.variables()[0].type, timeseries::ValueType::F32);
    EXPECT_EQ(reader.variables()[1].type, timeseries::ValueType::F64);
    EXPECT_EQ(reader.variables()[1].grid, grid);
    ASSERT_EQ(reader.variables()[1].time->points.size(), 4u);
    EXPECT_EQ(reader.variables()[1].time->points[3].value, 7.0);
    const timeseries::Field field = reader.read(1, 3);
    EXPECT_EQ(field.type(), timeseries::ValueType::F64);
    EXPECT_EQ(field.values, sample(AbcFlowSpeed{.drift = 1}, grid, 7.0, Precision::F64).values);
    EXPECT_EQ(reader.read(0, 0).type(), timeseries::ValueType::F32);
    EXPECT_THROW(AnalyticReader({}, grid, {0}), std::invalid_argument);
    EXPECT_THROW(AnalyticReader({{"r", SphereRamp{}}}, grid, {}), std::invalid_argument);
}

TEST(AnalyticReader, LoadsThroughAStepLoader) {
    const auto grid = uniformGrid({9, 9, 9}, {});
    timeseries::StepLoader loader(
        std::make_unique<AnalyticReader>(
            std::vector<AnalyticVariable>{{"r", SphereRamp{}, Precision::F64}}, grid,
            std::vector{0.0, 1.0}),
        0, timeseries::RangeSet::everything());
    loader.want({1});
    const auto result = loader.waitAndPoll();
    const auto& loaded = std::get<timeseries::Loaded>(*result);
    EXPECT_EQ(loaded.step, 1u);
    // The middle of the 9^3 points is the centre: the least value, 0.
    EXPECT_EQ(loaded.sorted->gridIndex()[0], 4u + 9 * (4 + 9 * 4));
    EXPECT_EQ(timeseries::toDouble(loaded.sorted->value(0)), 0);
}

}  // namespace
}  // namespace datasets
