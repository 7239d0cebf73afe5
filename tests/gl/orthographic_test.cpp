// Orthographic views are perspectives from far away: in float, on GL, they must still be the
// truth's.
#include <glm/geometric.hpp>

#include "app/choices/camera.h"
#include "render/reference/cpu_splatter.h"
#include "render/reference/image_compare.h"
#include "tests/support/gl_planes.h"

namespace app {
namespace {

using render::Channels;
using render::Kernel;
using render::View;
using timeseries::RangeSet;

class Orthographic : public tests::GlTest {
 protected:
    Orthographic() { view_.projection = Projection::Orthographic; }

    std::vector<View> eyesOf(const StereoChoice& stereo = {}) const {
        return eyes(view_, stereo, placed_.boxHalfEdges(), {320, 240});
    }
    std::vector<double> truth(const View& view, float wall = 1) const {
        render::Accumulator<double> sums(view.size, {Channels::Weight});
        const std::vector<float> opaque(std::size_t(320) * 240, wall);
        splat(scene_, render::Runs{}, view, opaque, sums);
        return sums.planes[0];
    }
    double error(const View& view) {
        return render::compareScalars(plane(scene_, view, Channels::Weight), truth(view))
            .relativeL2;
    }

    timeseries::SortedStep step_ = tests::noise(tests::cube(24));
    render::PlacedPoints placed_{step_.grid()};
    render::Scene scene_{.step = step_,
                         .placed = placed_,
                         .layers = {{step_.select(RangeSet::parse("0.3:0.6")),
                                     {render::Constant{glm::dvec3(1)}, 0.5}}},
                         .footprint = {},
                         .order = render::Order::None,
                         .clip = {}};
    ViewChoice view_;
};

TEST_F(Orthographic, OpticalDepthIsTheTruths) {
    for (const std::optional<double> distance : {std::optional<double>(), {0.5}, {40.0}}) {
        view_.distance = distance;
        EXPECT_LE(error(eyesOf()[0]), 1e-5) << distance.value_or(0);
    }
    view_.distance = 1;
    view_.target = {0.4, -0.3, 0.2};
    EXPECT_LE(error(eyesOf()[0]), 1e-5) << "beside the centre";
}

TEST_F(Orthographic, EyesAsideAreTheTruthsToAHundredthOfAPixel) {
    // Their view axes pass tens of thousands of pixels beside the picture, where a float knows
    // positions to 1/128 of a pixel.
    for (const View& eye : eyesOf({Stereo::LeftRight, {}, {}})) EXPECT_LE(error(eye), 2e-3);
}

TEST_F(Orthographic, WhatTheOpaqueSceneHidesIsTheTruths) {
    // A wall between two planes of points, each half a cell away: 1/23 of the box's side.
    view_.azimuthDegrees = view_.elevationDegrees = 0;
    const View eye = eyesOf()[0];
    const std::vector<double> open = truth(eye);
    for (const double between : {0.0, 4.0, -8.0, 11.0}) {
        const glm::dvec3 at(0, between * placed_.cell(0).y, 0);
        const glm::dvec4 clip = eye.clipFromView * eye.viewFromWorld * glm::dvec4(at, 1);
        const auto wall = static_cast<float>(clip.z / clip.w);
        const std::vector<double> expected = truth(eye, wall);
        EXPECT_NE(expected, open) << "or nothing was hidden";
        EXPECT_LE(
            render::compareScalars(plane(scene_, eye, Channels::Weight, wall), expected).relativeL2,
            1e-5)
            << between;
    }
}

TEST_F(Orthographic, AUniformFieldIsSeenAsThickAsItIs) {
    // Seen along an axis, every ray crosses 24 cells of one unit length each.
    step_ = tests::stepOf(tests::cube(24), [](std::size_t) { return 0.5; });
    scene_.layers[0].runs = step_.select(RangeSet::parse("0:1"));
    view_.azimuthDegrees = view_.elevationDegrees = 0;
    const std::vector<float> weight = plane(scene_, eyesOf()[0], Channels::Weight);
    EXPECT_NEAR(weight[120 * 320 + 160], 24, 0.01 * 24);
}

}  // namespace
}  // namespace app
