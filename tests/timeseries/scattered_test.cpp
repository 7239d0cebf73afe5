#include "timeseries/grid/scattered.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "tests/support/unstructured.h"

namespace timeseries::scattered {
namespace {

using Places = std::vector<glm::dvec3>;

Places randomPlaces(std::size_t count, const glm::dvec3& lo, const glm::dvec3& hi) {
    std::minstd_rand random(11);
    std::uniform_real_distribution<double> share(0, 1);
    Places places;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = share(random), y = share(random), z = share(random);
        places.push_back(lo + (hi - lo) * glm::dvec3(x, y, z));
    }
    return places;
}

// What the splats of all points sum up to at a place, each spread over a ball of 1.5 x 1.396 widths
// of its cell by the density C (1 - r^2)^3.5, whose integral over the ball is 1:
// C = 1 / (4 pi B(3/2, 9/2) / 2).
double densityAt(const glm::dvec3& place, const Places& places, const Mesh& mesh) {
    const double beta = std::tgamma(1.5) * std::tgamma(4.5) / std::tgamma(6.0);
    const double middle = 1 / (2 * M_PI * beta);
    double sum = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double of = tests::volume(mesh, i), radius = 1.5 * 1.396 * std::cbrt(of);
        const double square = glm::dot(places[i] - place, places[i] - place) / (radius * radius);
        if (square < 1) sum += of * middle * std::pow(1 - square, 3.5) / std::pow(radius, 3);
    }
    return sum;
}

// A lattice whose points lie up to 0.3 steps beside their places each way, x from lo on.
void addShaken(Places& places, double lo, int side) {
    std::minstd_rand random(5);
    std::uniform_real_distribution<double> aside(-0.3, 0.3);
    for (int n = 0; n < side * side * side; ++n) {
        glm::dvec3 at(n % side + 0.5, n / side % side + 0.5, n / side / side + 0.5);
        for (int c = 0; c < 3; ++c) at[c] += aside(random);
        places.push_back(at / double(side) + glm::dvec3(lo, 0, 0));
    }
}

// Away from the faces; four times as dense in one half as in the other.
TEST(Scattered, SplatsSumUpToAnEvenDensity) {
    Places places;
    addShaken(places, -1, 16);
    addShaken(places, 0, 10);
    const Mesh mesh = meshOfScattered(places);
    for (const double half : {-1.0, 0.0}) {
        double sum = 0, squares = 0;
        constexpr int kCount = 300;
        for (const glm::dvec3& place :
             randomPlaces(kCount, {half + 0.3, 0.3, 0.3}, {half + 0.7, 0.7, 0.7})) {
            const double density = densityAt(place, places, mesh);
            sum += density;
            squares += density * density;
        }
        const double mean = sum / kCount;
        EXPECT_NEAR(mean, 1, 0.03) << half;
        EXPECT_LT(std::sqrt(squares / kCount - mean * mean), 0.1) << half;
    }
}

TEST(Scattered, PointsOfALatticeStandForItsCells) {
    Places places;
    for (int i = 0; i < 14 * 14 * 14; ++i)
        places.push_back(0.5 * glm::dvec3(i % 14, i / 14 % 14, i / 196));
    const Mesh mesh = meshOfScattered(places);
    // The 16th nearest is a diagonal of a face away.
    EXPECT_NEAR(tests::volume(mesh, 7 + 14 * (7 + 14 * 7)),
                4 * M_PI / 3 * std::pow(0.5 * std::sqrt(2.0), 3) / 16, 1e-6);
    EXPECT_NEAR(mesh.position(1).x, 0.5, 1e-6);
}

// Balls about them would fill the space between the turns of a helix.
TEST(Scattered, PointsAlongALineAreAsWideAsTheyAreApart) {
    for (const double radius : {0.0, 10.0}) {
        Places places;
        for (int i = 0; i < 400; ++i)
            places.push_back({radius * std::cos(0.05 * i), radius * std::sin(0.05 * i),
                              radius > 0 ? 0.08 * i : 0.5 * i});
        const Mesh mesh = meshOfScattered(places);
        const double apart = glm::distance(places[200], places[201]);
        for (const std::uint64_t i : {100u, 200u, 300u})
            EXPECT_NEAR(std::cbrt(tests::volume(mesh, i)), apart, 0.05 * apart) << radius;
        EXPECT_LE(std::cbrt(tests::volume(mesh, 0)), 2.01 * apart) << "an end";
    }
    // A sheet is no line.
    Places sheet;
    for (int i = 0; i < 900; ++i) sheet.push_back(glm::dvec3(i % 30, i / 30, 0));
    const double reach2 = 5;  // of the 16th: 4 at 1, 4 at sqrt 2, 4 at 2, 8 at sqrt 5
    EXPECT_NEAR(tests::volume(meshOfScattered(sheet), 15 + 30 * 15),
                4 * M_PI / 3 * std::pow(reach2, 1.5) / 16, 1e-5);
}

TEST(Scattered, FewPointsStandForSomething) {
    EXPECT_NEAR(tests::volume(meshOfScattered(Places{{3, 4, 5}})), 1, 1e-6);
    for (std::size_t count : {2u, 3u, 33u}) {
        const Mesh mesh = meshOfScattered(randomPlaces(count, {0, 0, 0}, {1e-3, 1, 1e3}));
        for (std::uint64_t i = 0; i < count; ++i) EXPECT_GT(tests::volume(mesh, i), 0) << count;
    }
}

TEST(Scattered, WhatIsNowhereIsNotDrawn) {
    Places places = randomPlaces(100, {0, 0, 0}, {1, 1, 1});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    places[7].y = nan;
    const Mesh mesh = meshOfScattered(places);
    EXPECT_EQ(mesh.absent(), 1u);
    EXPECT_EQ(mesh.flat(), 0u);
    EXPECT_GT(tests::volume(mesh, 8), 0);
    EXPECT_THROW(meshOfScattered(Places{{nan, 0, 0}}), std::invalid_argument);
    EXPECT_THROW(meshOfScattered(Places{}), std::invalid_argument);
}

// Readings of one station, particles set free at one place: as many as there are, in any order.
TEST(Scattered, PointsAtOnePlaceShareWhatReachesAnother) {
    for (const std::size_t count : {17u, 40u, 100000u}) {
        Places places = randomPlaces(100, {0, 0, 0}, {1, 1, 1});
        const glm::dvec3 station(0.5);
        double nearest = 2;
        for (const glm::dvec3& each : places)
            nearest = std::min(nearest, glm::distance(each, station));
        for (std::size_t i = 0; i < count; ++i)
            places.insert(places.begin() + static_cast<std::ptrdiff_t>(i % 50), station);
        const Mesh mesh = meshOfScattered(places);
        EXPECT_EQ(mesh.flat(), 0u);
        for (std::size_t i = 0; i < places.size(); ++i)
            if (places[i] == station) {
                ASSERT_NEAR(tests::volume(mesh, i) * static_cast<double>(count),
                            4 * M_PI / 3 * std::pow(nearest, 3), 1e-5)
                    << i;
            } else {
                ASSERT_GT(tests::volume(mesh, i), 0) << i;
            }
    }
}

// A pair that nothing else is nearer to is two of the 16.
TEST(Scattered, APairCountsTwice) {
    Places places = randomPlaces(60, {0, 0, 0}, {1, 1, 1});
    places.push_back(places[0]);
    const Mesh mesh = meshOfScattered(places);
    std::vector<double> distances;
    for (const glm::dvec3& each : places) distances.push_back(glm::distance(each, places[5]));
    std::ranges::sort(distances);
    EXPECT_NEAR(tests::volume(mesh, 5), 4 * M_PI / 3 * std::pow(distances[16], 3) / 16, 1e-6);
    EXPECT_EQ(tests::volume(mesh, 0), tests::volume(mesh, 60));
}

// Which stands for more than all others reach.
TEST(Scattered, OneThatIsFarAwayLeavesTheOthersTheirExtent) {
    Places places = randomPlaces(200, {0, 0, 0}, {1, 1, 1});
    places.emplace_back(1e9, 0.5, 0.5);
    double lo = 1, hi = 0;
    for (const glm::dvec3& each : places) {
        lo = std::min(lo, each.y);
        hi = std::max(hi, each.y);
    }
    const Grid grid(spaceAxes(), std::make_shared<const Mesh>(meshOfScattered(places)));
    EXPECT_EQ(grid.axes()[1].coordinates, (std::vector<double>{lo, hi}));
}

TEST(Scattered, AllAtOnePlaceStandForOneTogether) {
    for (const std::size_t count : {2u, 50u}) {
        const Places places(count, glm::dvec3(3, 4, 5));
        EXPECT_NEAR(tests::volume(meshOfScattered(places)), 1, 1e-6) << count;
    }
}

}  // namespace
}  // namespace timeseries::scattered
