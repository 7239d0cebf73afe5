// The footprint of slim splats, which end at the domain's faces, against integrals taken step by
// step.
#include "render/model/footprint.h"

#include <gtest/gtest.h>

#include <random>

#include "render/reference/cpu_splatter.h"
#include "render/reference/exact_order.h"
#include "render/reference/image_compare.h"
#include "render/splat/tile_splatter.h"
#include "tests/support/scenes.h"

namespace render {
namespace {

using timeseries::Grid;
using timeseries::RangeSet;

// (1 - r^2)^3.5 over its integral over all space, which is pi / 5 times that of (1 - s^2)^3.5.
double density(const glm::dvec3& kernel) {
    constexpr double kAlong = 35.0 / 128 * std::numbers::pi;
    const double r2 = glm::dot(kernel, kernel);
    return r2 >= 1 ? 0 : std::pow(1 - r2, 3.5) / (kAlong * std::numbers::pi / 5);
}

// A selection of everything on a grid whose cells are long along z, some leaning.
struct UniformWorld {
    UniformWorld(std::array<timeseries::Axis, 3> axes, const glm::dmat3& directions = glm::dmat3(1))
        : step(tests::stepOf(
              std::make_shared<Grid>(std::move(axes),
                                     timeseries::CoordinateFrame{.directions = directions}),
              [](std::size_t) { return 1.0; })) {}
    timeseries::SortedStep step;
    PlacedPoints placed{step.grid()};
    Scene scene{.step = step,
                .placed = placed,
                .layers = {{step.select(RangeSet::everything()), {}}},
                .footprint = {},
                .order = Order::None,
                .clip = {}};
};

UniformWorld thin(std::size_t levels) {
    return UniformWorld({tests::axis(24), tests::axis(20), tests::axis(levels, 0, 8)});
}

struct Direct {
    PlacedPoints::Box box;
    glm::dvec3 centre, radii;
};
// As the header tells it.
Direct direct(const PointsView& seen, std::uint64_t index, double depth, double size) {
    const PlacedPoints& placed = seen.placed;
    const glm::dvec3 least(depth * seen.smallestRadius);
    const PlacedPoints::Box domain = placed.domain();
    return {{glm::min(domain.lo, -placed.boxHalf() - least),
             glm::max(domain.hi, placed.boxHalf() + least)},
            placed.alongAxes(index),
            glm::max(kQuarticRadius * glm::min(size * placed.cell(index), domain.hi - domain.lo),
                     least)};
}

TEST(SlimFootprint, TheShareOfARayIsTheIntegralOfWhatItPassesInside) {
    const std::array worlds{thin(3), thin(1),
                            UniformWorld({tests::axis(9), tests::axis(8), tests::axis(4, 0, 6)},
                                         tests::leaning({1, 0.4, 0}, {0, 1, 0.5}, {0.3, 0, 1}))};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    int cut = 0, compared = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const UniformWorld& world = worlds[static_cast<std::size_t>(trial) % worlds.size()];
        const glm::dvec3 eye =
            4.0 * glm::normalize(glm::dvec3(uniform(random), uniform(random), uniform(random)));
        const View view = tests::lookFrom(eye, {200, 200});
        const PointsView seen(world.placed, view);
        const std::uint64_t index = random() % world.step.size();
        const Footprint footprint{Kernel::Quartic, std::array{1.0, 2.0, 4.0}[trial / 3 % 3]};
        const auto s = splatAt<double>(seen, index, footprint);
        if (!world.placed.longCells() || !s.cut) continue;
        ++cut;
        const Direct d = direct(seen, index, s.depth, footprint.size);
        for (int ray = 0; ray < 5; ++ray) {
            const glm::dvec2 at =
                glm::mix(s.lo, s.hi, 0.5 + 0.5 * glm::dvec2(uniform(random), uniform(random)));
            const double q = s.numerator(at) / s.denominator(at);
            if (!(q < 0.98)) continue;
            const glm::dvec3 along = seen.rays.along(s.centre + at);
            const glm::dvec3 toCentre = seen.rays.along(s.centre);
            // In kernel space the ray is at off + depth * d, depths counted from the centre's.
            const glm::dvec3 dir = along / d.radii, off = s.depth * (along - toCentre) / d.radii;
            const double middle = -glm::dot(off, dir) / glm::dot(dir, dir);
            const glm::dvec3 nearest = off + middle * dir;
            const double half = std::sqrt((1 - glm::dot(nearest, nearest)) / glm::dot(dir, dir));
            double inside = 0, all = 0;
            const int steps = 2000;
            for (int i = 0; i < steps; ++i) {
                const glm::dvec3 kernel =
                    off + (middle + half * (2.0 * (i + 0.5) / steps - 1)) * dir;
                const double mass = density(kernel);
                const glm::dvec3 place = d.centre + kernel * d.radii;
                all += mass;
                if (glm::all(glm::greaterThanEqual(place, d.box.lo)) &&
                    glm::all(glm::lessThanEqual(place, d.box.hi)))
                    inside += mass;
            }
            ++compared;
            EXPECT_NEAR(s.insideShare(at, q), inside / all, 1e-3) << trial;
        }
    }
    EXPECT_GE(cut, 100);
    EXPECT_GE(compared, 200);
}

// Of a splat of radius 1 that is seen along z, straight through its middle, but for this slope.
double shareBefore(double face, double slope) {
    Splat<double> s;
    s.cut = true;
    s.depth = 100;
    s.c = {slope, 0, 1}, s.x = {1, 0, 0}, s.y = {0, 1, 0};
    s.loFace = glm::dvec3(-100);
    s.hiFace = {face, 100, 100};
    return s.insideShare({0, 0}, 0);
}

TEST(SlimFootprint, ARayAlongAFaceIsOnOneSideOfIt) {
    // At 0.002 the face is crossed after 0.4 of 1 when the ray gains 0.005.
    EXPECT_NEAR(shareBefore(0.002, 0.005), shareBetween<double>(kAlongRay, -1, 0.4), 1e-4);
    EXPECT_NEAR(shareBefore(0.002, -0.005), shareBetween<double>(kAlongRay, -0.4, 1), 1e-4);
    EXPECT_NEAR(shareBefore(0.002, 0), 1, 1e-9);
    EXPECT_EQ(shareBefore(-0.002, 0), 0);
}

// The share of a kernel's mass before faces at t along the first n axes; in steps over space.
double massBefore(double t, int axes) {
    const int steps = 80;
    double inside = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j)
            for (int k = 0; k < steps; ++k) {
                const glm::dvec3 at = (2.0 * glm::dvec3(i, j, k) + 1.0) / double(steps) - 1.0;
                bool in = at.x < t;
                if (axes > 1) in = in && at.y < t;
                if (axes > 2) in = in && at.z < t;
                if (in) inside += density(at);
            }
    return inside * std::pow(2.0 / steps, 3);
}

TEST(SlimFootprint, MassIsKeptBesideAFaceAndNearlyAtEdgesAndCorners) {
    // Half a cell beyond a point of an even grid stands the face, here between two of the steps.
    const double t = 0.35;
    EXPECT_NEAR(t, 0.5 / kQuarticRadius, 0.01);
    const double share = shareBetween<double>(kAcrossPlanes, -1, t);
    EXPECT_NEAR(massBefore(t, 1) / share, 1, 1e-3);
    EXPECT_NEAR(massBefore(t, 2) / (share * share), 1, 0.004);
    EXPECT_NEAR(massBefore(t, 3) / (share * share * share), 1, 0.011);
}

// Where the ray of a pixel passes the domain, grown by this many pixels of the middle depth: how
// far.
double pathLength(const PointsView& seen, const glm::dvec2& pixel, double pixels) {
    const glm::dvec3 eye = glm::inverse(seen.placed.worldFromAxes()) *
                           glm::dvec3(glm::inverse(seen.viewFromWorld) * glm::dvec4(0, 0, 0, 1));
    const glm::dvec3 d = seen.rays.along(pixel - seen.rays.centre);
    const double middle = glm::length(glm::dvec3(seen.viewFromWorld[3]));
    const glm::dvec3 grown(pixels * middle * seen.smallestRadius / kQuarticRadius);
    const PlacedPoints::Box box = seen.placed.domain();
    double from = 0, to = 1e9;
    for (int a = 0; a < 3; ++a) {
        const double one = (box.lo[a] - grown[a] - eye[a]) / d[a];
        const double other = (box.hi[a] + grown[a] - eye[a]) / d[a];
        from = std::max(from, std::min(one, other));
        to = std::min(to, std::max(one, other));
    }
    return std::max(0.0, to - from) * glm::length(seen.placed.worldFromAxes() * d);
}

// At the rim of a footprint, too, where rounding decides whether a ray meets it.
TEST(SlimFootprint, EveryPixelHasANumber) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1, 1);
    for (const std::size_t levels : {2u, 7u, 12u}) {
        const UniformWorld world = thin(levels);
        for (int n = 0; n < 30; ++n) {
            const glm::dvec3 eye =
                2.5 * glm::normalize(glm::dvec3(any(random), any(random), any(random)));
            const View view = tests::lookFrom(eye, {200, 150}, 0.3);
            for (const float w : sumTiles(world.scene, Runs{}, view, Channels::Weight, 0, {}, 2))
                ASSERT_TRUE(std::isfinite(w)) << levels << " levels from " << eye.x << ' ' << eye.y;
        }
    }
}

// Hundreds of times as long as wide and near: the terms of such a splat's forms cancel.
TEST(SlimFootprint, TilesSumTheTruthOfTheSlimmestFromCloseBy) {
    for (const double height : {30.0, 300.0, 1000.0}) {
        UniformWorld world({tests::axis(30), tests::axis(24), tests::axis(3, 0, height)});
        ASSERT_TRUE(world.placed.longCells());
        world.scene.layers[0].style.opacity = 0.3;
        world.scene.order = Order::BackToFront;
        const double width = world.placed.widths()[0][0];
        for (const glm::dvec3& from : {glm::dvec3(20, 9, 4), {2, -25, 60}, {-17, 5, -2}}) {
            const View view = tests::lookFrom(width * from, {120, 90}, 0.6);
            const DrawList list = orderExactly(world.scene, pixelRays(view).eye);
            for (const Channels channels : {Channels::Weight, Channels::Over}) {
                Accumulator<double> truth(view.size, {channels});
                splat(world.scene, list, view, {}, truth);
                const auto is = sumTiles(world.scene, list, view, channels, 0, {}, 2);
                EXPECT_LE(compareScalars(is, truth.planes[0]).relativeL2, 1e-4)
                    << height << " from " << from.x;
            }
        }
    }
}

TEST(SlimFootprint, NothingIsDrawnBesideTheDomain) {
    for (const std::size_t levels : {2u, 3u, 7u}) {
        const UniformWorld world = thin(levels);
        ASSERT_TRUE(world.placed.longCells());
        for (const glm::dvec3 eye :
             {glm::dvec3(0, -4, 0.1), glm::dvec3(3, -2, 1), glm::dvec3(0.2, 0.1, 5)}) {
            const View view = tests::lookFrom(eye, {160, 120}, 0.4);
            const PointsView seen(world.placed, view);
            Accumulator<double> sums(view.size, {Channels::Weight});
            splat(world.scene, Runs{}, view, {}, sums);
            Accumulator<double> counts(view.size, {Channels::Count});
            splat(world.scene, Runs{}, view, {}, counts);
            for (int y = 0; y < view.size.y; ++y)
                for (int x = 0; x < view.size.x; ++x)
                    if (pathLength(seen, glm::dvec2(x, y) + 0.5, 2.1) == 0) {
                        const std::size_t pixel = std::size_t(y) * view.size.x + x;
                        ASSERT_EQ(sums.planes[0][pixel], 0)
                            << levels << " levels, pixel " << x << ' ' << y;
                        ASSERT_EQ(counts.planes[0][pixel], 0)
                            << levels << " levels, pixel " << x << ' ' << y;
                    }
        }
    }
}

// What all points draw against what their cells are: W of a ray is the path in the domain over l.
TEST(SlimFootprint, AFullDomainIsItsPathLengthToTheStatedError) {
    struct Case {
        std::size_t levels;
        double length, error;
    };
    for (const Case& c : {Case{3, 14, 0.125}, Case{17, 4, 0.055}}) {
        const UniformWorld world(
            {tests::axis(60), tests::axis(12), tests::axis(c.levels, 0, c.length)});
        const View view = tests::lookFrom({0, -40, 0}, {180, 150}, 0.03);
        const PointsView seen(world.placed, view);
        Accumulator<double> sums(view.size, {Channels::Weight});
        splat(world.scene, Runs{}, view, {}, sums);
        std::vector<double> paths;
        double drawn = 0, whole = 0;
        for (int y = 0; y < view.size.y; ++y)
            for (int x = 0; x < view.size.x; ++x) {
                double path = 0;  // in the mean of the pixel, whose sums the edges cross
                for (int part = 0; part < 16; ++part)
                    path += pathLength(
                        seen, glm::dvec2(x, y) + (glm::dvec2(part % 4, part / 4) + 0.5) / 4.0, 0);
                paths.push_back(path / 16 / world.placed.unitLength());
                whole += paths.back();
            }
        for (const double w : sums.planes[0]) drawn += w;
        EXPECT_LE(compareScalars(sums.planes[0], paths).relativeL2, c.error) << c.levels;
        EXPECT_NEAR(drawn / whole, 1, 5e-3) << c.levels;
    }
}

TEST(SlimFootprint, LiesWithinItsBounds) {
    const UniformWorld world({tests::axis(9), tests::axis(8), tests::axis(4, 0, 16)},
                             tests::leaning({1, 0.4, 0}, {0, 1, 0.5}, {0.3, 0, 1}));
    std::mt19937 random(4);
    std::uniform_real_distribution<double> uniform(-1, 1);
    double bounds = 0, squares = 0;
    for (int trial = 0; trial < 400; ++trial) {
        const View view = tests::lookFrom(
            glm::dvec3(uniform(random), uniform(random), uniform(random)) * 3.0, {100, 100});
        const PointsView seen(world.placed, view);
        const auto s = splatAt<double>(seen, random() % world.step.size(), {});
        if (!s.visible) continue;
        double reach = 0;
        for (int i = 0; i < 2000; ++i) {
            // The outline in one direction u: where n(u) t^2 = 1 + l.u t + d(u) t^2.
            const double angle = i * 2 * std::numbers::pi / 2000;
            const glm::dvec2 u(std::cos(angle), std::sin(angle));
            const double lu = glm::dot(s.l, u), m = s.numerator(u) - (s.denominator(u) - 1 - lu);
            const glm::dvec2 at = u * ((lu + std::sqrt(lu * lu + 4 * m)) / (2 * m));
            if (!(m > 0 && s.denominator(at) > 1e-3)) continue;
            EXPECT_TRUE(glm::all(glm::lessThanEqual(s.lo, at)) &&
                        glm::all(glm::lessThanEqual(at, s.hi)))
                << trial;
            reach = std::max({reach, std::abs(at.x), std::abs(at.y)});
        }
        if (!std::isfinite(s.hi.x)) continue;
        bounds += (s.hi.x - s.lo.x) * (s.hi.y - s.lo.y);
        squares += std::pow(std::max({s.hi.x, s.hi.y, -s.lo.x, -s.lo.y}), 2) * 4;
    }
    EXPECT_LT(bounds, squares / 2) << "or they are no narrower than squares";
}

}  // namespace
}  // namespace render
