// Placards stand in the scene: in their place, upright, before and behind other things.
#include "render/annotate/placard.h"

#include <glm/gtc/matrix_transform.hpp>

#include "render/frame/frame.h"
#include "render/image/color.h"
#include "tests/support/gl_planes.h"

namespace render {
namespace {

constexpr glm::ivec2 kPictureSize{96, 64};

class Placards : public tests::GlTest {
 protected:
    // Behind the origin for y > 0, as seen by `eye_`; half as wide and high as told.
    static glm::dmat4 standing(double y, glm::dvec2 half) {
        // x stays, the placard's y is the world's z, its face looks at -y.
        const glm::dmat4 upright(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 0, 1, 0),
                                 glm::dvec4(0, -1, 0, 0), glm::dvec4(0, y, 0, 1));
        return glm::scale(upright, glm::dvec3(half, 1));
    }
    Image alone(const std::vector<Placard>& placards) {
        Image picture;
        renderer_.drawPlacards(
            placards, glm::dvec3(0.1), std::array{eye_},
            [&](std::size_t, const Targets& light) { picture = light.readLight(); });
        gl::throwOnError();
        return picture;
    }

    FrameRenderer renderer_;
    View eye_ = tests::lookFrom({0, -3, 0}, kPictureSize);
};

TEST_F(Placards, StandWhereTheirCornersProjectTo) {
    const glm::dvec2 half(0.7, 0.3);
    const Image picture = alone({{standing(0.2, half), glm::vec3(1, 0.5f, 0)}});
    const auto corner = [&](double x, double z) {
        return project(eye_, {x * half.x, 0.2, z * half.y}).window;
    };
    const glm::dvec2 lo = corner(-1, -1), hi = corner(1, 1);
    for (int y = 0; y < kPictureSize.y; ++y)
        for (int x = 0; x < kPictureSize.x; ++x) {
            const glm::dvec2 centre(x + 0.5, kPictureSize.y - y - 0.5);
            // On an edge, rounding decides.
            const glm::dvec2 off = glm::min(glm::abs(centre - lo), glm::abs(centre - hi));
            if (std::min(off.x, off.y) < 0.01) continue;
            const bool inside =
                centre.x > lo.x && centre.x < hi.x && centre.y > lo.y && centre.y < hi.y;
            ASSERT_EQ(picture.at(x, y),
                      inside ? glm::vec4(1, 0.5f, 0, 1) : glm::vec4(glm::vec3(0.1f), 1))
                << x << ' ' << y;
        }
}

TEST_F(Placards, TheNearerHidesTheFartherInAnyOrder) {
    const Placard near{standing(-0.5, {0.3, 0.3}), glm::vec3(1, 0, 0)};
    const Placard far{standing(0.5, {1, 1}), glm::vec3(0, 1, 0)};
    const Image picture = alone({near, far});
    EXPECT_EQ(picture.at(kPictureSize.x / 2, kPictureSize.y / 2), glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(alone({far, near}), picture);
}

TEST_F(Placards, BearTheirPictureUprightInLinearLight) {
    Image quarters({8, 8}, glm::vec4(0, 0, 0, 1));
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            quarters.at(x, y) = {x < 4 ? 1.0f : 0.0f, y < 4 ? 1.0f : 0.0f, 0.2f, 1};
    const Board board({8, 8});
    board.write(quarters);
    const Image picture = alone({{standing(0, {1, 1}), &board}});
    const double fifth = linearFromSrgb(srgb8FromLinear(0.2) / 255.0);
    for (const int x : {0, 1})
        for (const int y : {0, 1}) {
            const glm::vec4 seen = picture.at(kPictureSize.x / 2 + (2 * x - 1) * 12,
                                              kPictureSize.y / 2 + (2 * y - 1) * 12);
            EXPECT_EQ(seen.r, x == 0 ? 1 : 0);
            EXPECT_EQ(seen.g, y == 0 ? 1 : 0);
            // Textures of 8 bits are blended with no more than 8 bits on some drivers.
            EXPECT_NEAR(static_cast<double>(seen.b), fifth, 2e-3);
        }
}

TEST_F(Placards, ThePointsAreBeforeOrBehind) {
    const auto step = tests::noise(tests::cube(6));
    const PlacedPoints placed(step.grid());
    const Scene scene{
        step,
        placed,
        {{step.select(timeseries::RangeSet::everything()), {Constant{{1, 1, 1}}, 0.9}}},
        {},
        Order::None,
        {}};
    GlStep onGpu(step, placed);
    const auto pictureOf = [&](const Scene& drawn, double y) {
        const std::vector<Placard> placards{{standing(y, {2, 2}), glm::vec3(0, 0, 1)}};
        return renderer_
            .render({.scene = drawn, .grid = step.grid(), .legend = {}, .placards = placards},
                    onGpu, std::array{eye_})
            .front()
            .image;
    };
    const auto picture = [&](double y) { return pictureOf(scene, y); };
    const glm::vec4 hidden = picture(-1).at(kPictureSize.x / 2, kPictureSize.y / 2);
    EXPECT_EQ(hidden, glm::vec4(0, 0, 1, 1));
    EXPECT_GT(picture(1).at(kPictureSize.x / 2, kPictureSize.y / 2).r, 0.5f);
    // Nothing of box and axes is seen through it.
    const Image wall = picture(-1);
    for (const glm::vec4& pixel : wall.pixels) ASSERT_EQ(pixel, glm::vec4(0, 0, 1, 1));
    // Nor does it hide one that stands farther in the next picture, where there are no points.
    Scene empty = scene;
    empty.layers.clear();
    EXPECT_EQ(pictureOf(empty, 0.2).at(kPictureSize.x / 2, kPictureSize.y / 2),
              glm::vec4(0, 0, 1, 1));
}

}  // namespace
}  // namespace render
