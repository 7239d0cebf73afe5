// Light from a lamp that stands in the world, by all who draw in the program, and from the eye.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "render/reference/interval_truth.h"
#include "tests/support/cell_rays.h"
#include "tests/support/meshes.h"
#include "tests/support/scenes.h"

namespace render {
namespace lamp {
namespace {

using tests::axis;
using tests::CellWorld;
using tests::drawn;
using timeseries::Grid;

constexpr glm::ivec2 kSize(40, 30);
const glm::dvec3 kEye(1.1, -2.5, 0.8);
const std::array<Lamp, 5> kLamps = {
    std::nullopt, glm::normalize(glm::dvec3(1, -2, 2)),         // before what is seen, aside,
    glm::dvec3(0, 0, 1), glm::normalize(glm::dvec3(-1, 3, 1)),  // behind,
    glm::normalize(-kEye)};                                     // and where the eye looks to

// What is told in render/model/light.h, of a surface across `normal` seen along `way`.
struct Lit {
    double diffuse, specular;
};
Lit litBy(const Lamp& lamp, Light light, glm::dvec3 normal, const glm::dvec3& way,
          double certainty) {
    const glm::dvec3 toEye = -glm::normalize(way);
    if (glm::dot(normal, toEye) < 0) normal = -normal;
    const glm::dvec3 toLamp = lamp.value_or(toEye);
    const double towards = std::max(0.0, glm::dot(normal, toLamp));
    const double half = std::max(0.0, glm::dot(normal, glm::normalize(toLamp + toEye)));
    const double low = lamp ? std::min(1.0, 4 * towards) : 1;
    return {certainty * (0.25 + 0.75 * towards) + (1 - certainty) * 0.625,
            light == Light::Full ? certainty * 0.35 * std::pow(half, 30) * low : 0};
}

// A field with one gradient: of one layer and colour, light multiplies what is drawn without.
// lit(light, lamp): the plane Over, or the truth's light.
template <typename Draw>
void expectRampsLight(CellWorld& world, const glm::dvec3& normal, double perLength,
                      double tolerance, const Draw& draw) {
    const View view = tests::lookFrom(kEye, kSize);
    world.scene.order = Order::BackToFront;
    world.scene.light = Light::Off;
    const auto dark = draw(view);
    const double steep = world.scene.cells->halfRange(world.scene.layers[0].cells.candidates, 0.9);
    const double certainty = perLength / (perLength + 0.2 * steep / world.placed.unitLength());
    for (const Lamp& lamp : kLamps)
        for (const Light light : {Light::Soft, Light::Full}) {
            world.scene.light = light;
            world.scene.lamp = lamp;
            const auto is = draw(view);
            int lit = 0;
            for (int y = 0; y < kSize.y; ++y)
                for (int x = 0; x < kSize.x; ++x) {
                    const std::size_t at = 4 * (std::size_t(y) * kSize.x + std::size_t(x));
                    if (!(dark[at + 3] > 0.01)) continue;
                    ++lit;
                    const tests::cells::Ray ray =
                        tests::cells::rayOf(world, view, {x + 0.5, y + 0.5});
                    const Lit by = litBy(lamp, light, normal,
                                         world.placed.worldFromAxes() * ray.along, certainty);
                    ASSERT_NEAR(is[at],
                                double(dark[at]) * by.diffuse + double(dark[at + 3]) * by.specular,
                                tolerance)
                        << x << ' ' << y << " lamp " << &lamp - kLamps.data();
                }
            EXPECT_GT(lit, 40);
        }
}

std::vector<double> flat(const std::vector<glm::dvec4>& light) {
    std::vector<double> all;
    for (const glm::dvec4& pixel : light)
        all.insert(all.end(), {pixel.r, pixel.g, pixel.b, pixel.a});
    return all;
}

TEST(Lamp, OfCellsOnALeaningGridIsThatOfTheirGradient) {
    const auto lean = tests::leaning({1, 0, 0.2}, {0.5, 1, 0}, {-0.3, 0.3, 1});
    const std::array axes{axis(6), axis(5, 0, 0.7), axis(4)};
    const auto grid = std::make_shared<const Grid>(axes, timeseries::CoordinateFrame{lean});
    for (const double up : {1.0, -1.0}) {
        CellWorld world(
            tests::stepOf(grid, [&](std::size_t i) { return up * double(grid->indices(i).x); }),
            {up > 0 ? "2.2:3.6" : "-3.6:-2.2"});
        const glm::dmat3& m = world.placed.worldFromAxes();
        const glm::dvec3 normal = glm::normalize(glm::cross(m[1], m[2]));
        const double perLength =
            1 / std::abs(world.placed.positions()[0][1] - world.placed.positions()[0][0]) /
            std::abs(glm::dot(m[0], normal));
        expectRampsLight(world, normal, perLength, 3e-4, [&](const View& view) {
            return drawn(world.scene, view, Channels::Over);
        });
        const timeseries::Field& field = world.scene.cells->field();
        expectRampsLight(world, normal, perLength, 1e-9, [&](const View& view) {
            return flat(IntervalTruth(world.scene, field, 1, 2).light(view));
        });
    }
}

// Which changes along the first index alone, as the half cells beyond the last points repeat it.
TEST(Lamp, OfTetrahedraIsThatOfTheirGradient) {
    const glm::dmat3 steps{2, 0.3, 0, -0.4, 1.5, 0.2, 0.3, 0, 1};
    const auto grid = tests::curvilinear(
        {7, 6, 5}, [&](double i, double j, double k) { return steps * glm::dvec3(i, j, k); });
    const glm::dvec3 across = glm::cross(steps[1], steps[2]) / glm::determinant(steps);
    CellWorld world(
        tests::stepOfPlaces(grid, [&](const glm::dvec3& p) { return glm::dot(across, p); }),
        {"2.2:3.6"});
    const glm::dvec3 gradient = across / world.placed.scale();  // in the world
    const auto expect = [&](double tolerance, const auto& draw) {
        expectRampsLight(world, glm::normalize(gradient), glm::length(gradient), tolerance, draw);
    };
    expect(3e-4, [&](const View& view) { return drawn(world.scene, view, Channels::Over); });
    const timeseries::Field& field = world.scene.cells->field();
    expect(1e-6, [&](const View& view) {
        return flat(IntervalTruth(world.scene, field, 1, 2).light(view));
    });
}

// From far away, a lamp where the eye is shines as the eye does.
TEST(Lamp, WhereTheEyeIsIsTheEyes) {
    CellWorld world(tests::noise(tests::cube(7)), {"0.2:0.4", "0.6:0.61"}, 0.7);
    world.scene.order = Order::BackToFront;
    world.scene.light = Light::Full;
    const View view = tests::lookFrom(2000.0 * glm::normalize(kEye), kSize, 5e-4);
    const std::vector<float> ofEye = drawn(world.scene, view, Channels::Over);
    world.scene.lamp = glm::normalize(kEye);
    const std::vector<float> ofLamp = drawn(world.scene, view, Channels::Over);
    double most = 0, off = 0;
    for (std::size_t i = 0; i < ofEye.size(); ++i) {
        most = std::max(most, double(ofEye[i]));
        off = std::max(off, std::abs(double(ofEye[i]) - double(ofLamp[i])));
    }
    EXPECT_GT(most, 0.1);
    EXPECT_LT(off, 0.02);  // highlights of a lamp that is low end, where the eye's are nothing
}

}  // namespace
}  // namespace lamp
}  // namespace render
