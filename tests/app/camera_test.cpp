#include "app/choices/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

namespace app {
namespace {

using glm::dmat3;
using glm::dvec3;
using glm::ivec2;
using render::project;
using render::Projected;
using render::View;

const dmat3 kCube(1 / std::sqrt(3.0));

std::vector<dvec3> corners(const dmat3& halfEdges) {
    std::vector<dvec3> all;
    for (int c = 0; c < 8; ++c)
        all.push_back(halfEdges * dvec3(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1));
    return all;
}

void expectInside(const View& view, const dvec3& world, const std::string& which) {
    const Projected p = project(view, world);
    EXPECT_GT(p.depth, 0) << which;
    EXPECT_GE(p.window.x, 0) << which;
    EXPECT_GE(p.window.y, 0) << which;
    EXPECT_LE(p.window.x, view.size.x) << which;
    EXPECT_LE(p.window.y, view.size.y) << which;
    // Neither plane cuts it.
    const glm::dvec4 clip = view.clipFromView * view.viewFromWorld * glm::dvec4(world, 1);
    EXPECT_GE(clip.z, 0) << which << ": cut by the near plane";
    EXPECT_LE(clip.z, clip.w) << which << ": cut by the far plane";
}

// A box whose farthest corners are 1 away, as PlacedPoints makes them, upright or not; a side may
// be nothing.
dmat3 randomBox(std::mt19937& random) {
    std::uniform_real_distribution<double> side(0.001, 1), lean(-1, 1);
    dmat3 half(0);
    const bool oblique = random() % 2 == 0;
    for (int a = 0; a < 3; ++a) {
        dvec3 direction(0);
        direction[a] = 1;
        if (oblique) direction = glm::normalize(dvec3(lean(random), lean(random), lean(random)));
        half[a] = side(random) * direction;
        if (random() % 4 == 0) half[a] = dvec3(0);
    }
    double farthest = 0;
    for (const dvec3& corner : corners(half)) farthest = std::max(farthest, glm::length(corner));
    return farthest > 0 ? half / farthest : half;
}

TEST(Camera, WithoutADistanceEveryBoxIsInsideThePicture) {
    std::mt19937 random(17);
    std::uniform_real_distribution<double> turn(-360, 360), tilt(-90, 90), log(-1.5, 1.5);
    for (int i = 0; i < 2000; ++i) {
        const double aspect = std::exp(log(random));
        const ivec2 size(static_cast<int>(400 * std::max(1.0, aspect)),
                         static_cast<int>(400 * std::max(1.0, 1 / aspect)));
        ViewChoice view{turn(random), tilt(random), {}};
        if (random() % 8 == 0) view.elevationDegrees = random() % 2 == 0 ? 90 : -90;
        if (random() % 8 == 0) view.azimuthDegrees = 90.0 * static_cast<double>(random() % 4);
        const dmat3 half = randomBox(random);
        for (const Stereo mode : {Stereo::Off, Stereo::SideBySide})
            for (const View& eye : eyes(view, {mode, {}, {}}, half, size))
                for (const dvec3& corner : corners(half))
                    expectInside(eye, corner,
                                 "case " + std::to_string(i) + ", azimuth " +
                                     std::to_string(view.azimuthDegrees) + ", elevation " +
                                     std::to_string(view.elevationDegrees));
        if (HasFailure()) return;
    }
}

TEST(Camera, WithoutADistanceTheBoxSpansItsShareOfTheFreeArea) {
    std::mt19937 random(18);
    std::uniform_real_distribution<double> turn(-360, 360), tilt(-90, 90);
    for (int i = 0; i < 2000; ++i) {
        const ivec2 size(100 + static_cast<int>(random() % 2000),
                         100 + static_cast<int>(random() % 1500));
        ViewChoice view{turn(random), tilt(random), {}};
        view.projection = i % 3 == 0 ? Projection::Orthographic : Projection::Perspective;
        const dmat3 half = randomBox(random);
        const View eye = eyes(view, {}, half, size)[0];
        const glm::dvec2 free = freeAreaOf(size);
        glm::dvec2 lo(1e9), hi(-1e9);  // in half pictures
        for (const dvec3& corner : corners(half)) {
            const glm::dvec2 at = 2.0 * project(eye, corner).window / glm::dvec2(size) - 1.0;
            lo = glm::min(lo, at);
            hi = glm::max(hi, at);
        }
        const glm::dvec2 share = 0.5 * (hi - lo) / free;
        const int along = share.x > share.y ? 0 : 1;
        EXPECT_LE(share[along], kBoxShare + 2e-4) << "case " << i;
        // A needle seen end on, or a point, is only as large as it may be near.
        const Stand stand = standOf(view, half, size);
        double nearest = stand.distance;
        if (view.projection == Projection::Perspective)
            for (const dvec3& corner : corners(half))
                nearest = std::min(nearest, project(eye, corner).depth);
        if (nearest > 0.601 && half != dmat3(0)) {
            EXPECT_NEAR(share[along], kBoxShare, 2e-4) << "case " << i;
            EXPECT_NEAR(lo[along] + hi[along], 0, 4e-4) << "case " << i << ": in the middle";
        }
        for (int k = 0; k < 2; ++k) {
            EXPECT_GE(lo[k], -free[k]);
            EXPECT_LE(hi[k], free[k]);
        }
        if (HasFailure()) return;
    }
}

// Of few points, the outermost cells reach farther than their box leaves free.
TEST(Camera, WithoutADistanceTheOutermostCellsAreInTheFreeAreaToo) {
    for (const double filled : {1.0, 1.05, 1.1, 1.125, 1.5, 3.0})
        for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
            render::Outline outline(kCube);
            outline.filledHalfEdges = filled * kCube;
            ViewChoice view{30, 20, {}};
            view.projection = projection;
            const ivec2 size(800, 600);
            const View eye = eyes(view, {}, outline, size)[0];
            const glm::dvec2 free = freeAreaOf(size);
            double widest = 0;
            for (const dvec3& corner : corners(filled * kCube)) {
                const glm::dvec2 at = 2.0 * project(eye, corner).window / glm::dvec2(size) - 1.0;
                widest = std::max({widest, std::abs(at.x) / free.x, std::abs(at.y) / free.y});
            }
            EXPECT_LE(widest, 1 + 2e-4) << filled;
            if (filled > 1.15) {
                EXPECT_NEAR(widest, 1, 2e-4) << filled;
            }
            // Most grids have so many that their pictures are those of their boxes.
            if (filled < 1.06) {
                EXPECT_EQ(standOf(view, outline, size).distance,
                          standOf(view, kCube, size).distance);
            }
        }
}

TEST(Camera, TheFreeAreaIsMostOfAPicture) {
    for (const ivec2 size : {ivec2(1200, 900), ivec2(400, 580), ivec2(2160, 1380), ivec2(64, 48)}) {
        EXPECT_GE(freeAreaOf(size).x, 0.8 - 1e-9);
        EXPECT_GE(freeAreaOf(size).y, 0.8 - 1e-9);
    }
}

// A session or a command that says a distance is drawn as ever.
TEST(Camera, AViewWithADistanceLooksAtItsTarget) {
    const ViewChoice view{30, 20, 4.0};
    const Stand stand = standOf(view, kCube, {1200, 900});
    EXPECT_EQ(stand.distance, 4);
    EXPECT_EQ(stand.target, dvec3(0));
}

TEST(Camera, ANeedleSeenFromItsTipIsInsideThePicture) {
    const dmat3 needle(dvec3(0), dvec3(0), dvec3(0, 0, 1));
    for (const double elevation : {90.0, -90.0})
        for (const View& eye : eyes({0, elevation, {}}, {}, needle, {300, 200}))
            for (const dvec3& corner : corners(needle)) expectInside(eye, corner, "needle");
}

TEST(Camera, AzimuthAndElevationStandWhereTheyAreSaidTo) {
    const auto eyeOf = [](double azimuth, double elevation) {
        return render::pixelRays(eyes({azimuth, elevation, 5.0}, {}, kCube, {100, 100})[0]).eye;
    };
    const auto expectNear = [](const dvec3& a, const dvec3& b) {
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-12);
    };
    expectNear(eyeOf(0, 0), {0, -5, 0});
    expectNear(eyeOf(90, 0), {5, 0, 0});
    expectNear(eyeOf(180, 0), {0, 5, 0});
    expectNear(eyeOf(0, 90), {0, 0, 5});
    expectNear(eyeOf(123, -90), {0, 0, -5});
}

TEST(Camera, FromTheFrontXGoesRightAndZUp) {
    const View view = eyes({0, 0, {}}, {}, kCube, {200, 100})[0];
    const glm::dvec2 centre = project(view, dvec3(0)).window;
    EXPECT_NEAR(centre.x, 100, 1e-9);
    EXPECT_NEAR(centre.y, 50, 1e-9);
    EXPECT_GT(project(view, {0.1, 0, 0}).window.x, centre.x);
    EXPECT_GT(project(view, {0, 0, 0.1}).window.y, centre.y);
    EXPECT_GT(project(view, {0, 0.1, 0}).depth, project(view, dvec3(0)).depth);
}

TEST(Camera, StraightDownXGoesRightAndYUp) {
    const View view = eyes({0, 90, {}}, {}, kCube, {200, 100})[0];
    const glm::dvec2 centre = project(view, dvec3(0)).window;
    const glm::dvec2 x = project(view, {0.1, 0, 0}).window, y = project(view, {0, 0.1, 0}).window;
    EXPECT_GT(x.x, centre.x);
    EXPECT_NEAR(x.y, centre.y, 1e-9);
    EXPECT_GT(y.y, centre.y);
    EXPECT_NEAR(y.x, centre.x, 1e-9);
}

TEST(Camera, AnEyeInsideTheBoxSeesWhatIsBeforeItAndBehindItToTheFarSide) {
    const View view = eyes({0, 0, 0.1}, {}, kCube, {100, 100})[0];
    const glm::dvec4 farCorner = view.clipFromView * view.viewFromWorld * glm::dvec4(kCube[1], 1);
    EXPECT_LE(farCorner.z, farCorner.w);
    const glm::dvec4 centre = view.clipFromView * view.viewFromWorld * glm::dvec4(0, 0, 0, 1);
    EXPECT_GE(centre.z, 0);
}

TEST(Camera, TheTargetIsInTheMiddleAtItsDistance) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> turn(-360, 360), tilt(-90, 90), at(-2, 2), far(0.1, 20);
    for (int i = 0; i < 300; ++i) {
        ViewChoice view{turn(random), tilt(random), far(random)};
        view.target = {at(random), at(random), at(random)};
        const Projected p = project(eyes(view, {}, kCube, {300, 200})[0], view.target);
        EXPECT_NEAR(p.window.x, 150, 1e-9);
        EXPECT_NEAR(p.window.y, 100, 1e-9);
        EXPECT_NEAR(p.depth, *view.distance, 1e-12 * 20);
        view.projection = Projection::Orthographic;
        const Projected q = project(eyes(view, {}, kCube, {300, 200})[0], view.target);
        EXPECT_NEAR(q.window.x, 150, 1e-6);
        EXPECT_NEAR(q.window.y, 100, 1e-6);
    }
}

TEST(Camera, WithoutADistanceAllIsSeenWhateverTheTargetAndTheProjection) {
    std::mt19937 random(29);
    std::uniform_real_distribution<double> turn(-360, 360), tilt(-90, 90), at(-3, 3);
    for (int i = 0; i < 1000; ++i) {
        ViewChoice view{turn(random), tilt(random), {}};
        if (i % 2 == 0) view.target = {at(random), at(random), at(random)};
        view.projection = i % 3 == 0 ? Projection::Perspective : Projection::Orthographic;
        const dmat3 half = randomBox(random);
        for (const View& eye : eyes(view, {}, half, {400, 300}))
            for (const dvec3& corner : corners(half))
                expectInside(eye, corner, "case " + std::to_string(i));
        if (HasFailure()) return;
    }
}

// Where an orthographic picture has a world point, by what such a picture is: along the camera's
// axes, at the scale that a perspective has at the target.
glm::dvec2 orthographicWindow(const ViewChoice& view, const dmat3& half, ivec2 size,
                              const dvec3& world) {
    const Stand stand = standOf(view, half, size);
    const dvec3 inView = glm::transpose(stand.axes) * (world - stand.target);
    return 0.5 * glm::dvec2(size) * (1.0 + glm::dvec2(inView) / (stand.distance * stand.slope));
}

TEST(Camera, OrthographicIsWithinItsBoundOfParallelProjection) {
    std::mt19937 random(41);
    std::uniform_real_distribution<double> turn(-360, 360), tilt(-90, 90), at(-1, 1), log(-3, 6);
    double worst = 0;
    for (int i = 0; i < 3000; ++i) {
        const ivec2 size(640, 480);
        ViewChoice view{turn(random), tilt(random), std::pow(10, log(random))};
        view.target = {at(random), at(random), at(random)};
        view.projection = Projection::Orthographic;
        const dmat3 half = randomBox(random);
        const View eye = eyes(view, {}, half, size)[0];
        for (const dvec3& corner : corners(half)) {
            const Projected drawn = project(eye, corner);
            const glm::dvec2 expected = orthographicWindow(view, half, size, corner);
            const double off = glm::length(drawn.window - expected);
            const double fromMiddle = glm::length(expected - 0.5 * glm::dvec2(size));
            EXPECT_LE(off, fromMiddle / (kFarEye - 1) + 1e-9) << "case " << i;
            worst = std::max(worst, off / (fromMiddle + 1e-9));
            const glm::dvec4 clip = eye.clipFromView * eye.viewFromWorld * glm::dvec4(corner, 1);
            EXPECT_GE(clip.z, 0);
            EXPECT_LE(clip.z, clip.w);
            // Splats fade between the near plane and twice as far.
            EXPECT_GE(drawn.depth, 2 * render::pixelRays(eye).near);
        }
        if (HasFailure()) return;
    }
    EXPECT_GT(worst, 0.5 / kFarEye) << "the bound says something";
}

TEST(Camera, OrthographicHasThePerspectivesSizeAtTheTarget) {
    for (const double distance : {0.01, 1.0, 5.0, 1e5}) {
        ViewChoice view{25, 40, distance};
        const dvec3 beside = standOf(view, kCube, {640, 480}).axes[0] * (0.01 * distance);
        const auto shown = [&] { return project(eyes(view, {}, kCube, {640, 480})[0], beside); };
        const glm::dvec2 perspective = shown().window;
        view.projection = Projection::Orthographic;
        EXPECT_NEAR(shown().window.x, perspective.x, 1e-6);
        EXPECT_NEAR(shown().window.y, perspective.y, 1e-6);
    }
}

TEST(Camera, ThePixelsDepthTellsApartAThousandthInAFloat) {
    // The depth buffer is float: what lies 1/500 half diagonal behind is behind there too.
    ViewChoice view;
    view.projection = Projection::Orthographic;
    const View eye = eyes(view, {}, kCube, {640, 480})[0];
    const auto windowDepth = [&](double behind) {
        const dvec3 axis = render::pixelRays(eye).axis;
        const glm::dvec4 clip = eye.clipFromView * eye.viewFromWorld * glm::dvec4(behind * axis, 1);
        return static_cast<float>(clip.z / clip.w);
    };
    for (double at = -1; at < 1; at += 0.01) EXPECT_LT(windowDepth(at), windowDepth(at + 0.002));
}

TEST(Camera, ASinglePointIsInTheMiddle) {
    const View view = eyes({}, {}, dmat3(0), {64, 32})[0];
    const Projected p = project(view, dvec3(0));
    EXPECT_EQ(p.window, glm::dvec2(32, 16));
    EXPECT_GT(p.depth, 0);
}

// Four places of a ball's outline in the picture: on the free area's edge in one direction, within
// it in the other.
TEST(Camera, ABallFillsItsShareOfThePicture) {
    const double radius = 1 / std::sqrt(3.0);
    for (const Projection projection : {Projection::Perspective, Projection::Orthographic})
        for (const ivec2 size : {ivec2(800, 600), ivec2(300, 900)})
            for (const double elevation : {-60.0, 0.0, 20.0, 90.0}) {
                const ViewChoice view{.azimuthDegrees = 30,
                                      .elevationDegrees = elevation,
                                      .distance = {},
                                      .projection = projection};
                const render::Outline ball{kCube, true};
                const View eye = eyes(view, {}, ball, size)[0];
                const auto rays = render::pixelRays(eye);
                const double distance = glm::length(rays.eye);
                const double tangent = radius / std::sqrt(distance * distance - radius * radius);
                const glm::dvec2 half = tangent * rays.focal / (0.5 * glm::dvec2(size));
                const glm::dvec2 share = half / (kBoxShare * freeAreaOf(size));
                EXPECT_NEAR(std::max(share.x, share.y), 1, 1e-3) << size.x << " " << elevation;
                const Projected centre = project(eye, dvec3(0));
                EXPECT_LT(glm::distance(centre.window, 0.5 * glm::dvec2(size)), 1e-6);
            }
}

}  // namespace
}  // namespace app
