// Cells of curvilinear grids whose index lines close: about an axis, or where they began.
#include "timeseries/grid/axis_rings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/meshes.h"
#include "timeseries/grid/mesh.h"

namespace timeseries {
namespace {

using tests::placesOf;

// Rings about an axis are widened where a splat's width away from it they are needles, and have the
// volume of their steps for all that.
TEST(AxisRings, CellsBesideAnAxisAreWiderThanTheirVolume) {
    for (const double first : {0.0, 0.5}) {
        const auto grid = tests::rings(6, first);
        const Mesh& mesh = *grid->mesh();
        const double angle = std::numbers::pi / 18;
        for (std::uint64_t i = 0; i < mesh.count(); ++i) {
            const double r = first + static_cast<double>(i / 36 % 6);
            const bool isEnd = i % 36 == 0 || i % 36 == 35;  // the way to the only neighbour
            const double side = r * (isEnd ? 2 * std::sin(angle / 2) : std::sin(angle));
            const bool isBeside = 0 < r && r < 1.2;
            EXPECT_EQ(mesh.widened(i) > 0, isBeside) << i;
            EXPECT_NEAR(mesh.volume(i), side * (isEnd ? std::cos(angle / 2) : 1), 1e-6) << i;
            EXPECT_NEAR(std::abs(mesh.cell(i).determinant()),
                        std::exp2(mesh.widened(i)) * mesh.volume(i), 1e-6);
            if (!isBeside) continue;
            const double wide = std::exp2(mesh.widened(i)) * side, wanted = 1.5 - r * r;
            EXPECT_LT(std::abs(std::log2(wide / wanted)), 0.6) << i;
        }
        EXPECT_EQ(mesh.flat(), first == 0 ? 36u * 3 : 0u);
    }
}

// Closed lines, which end where they began: both ends have the cell about that place, which is like
// those beside it, and half of its volume each.
TEST(AxisRings, CellsWhereALineClosesAreSharedByItsEnds) {
    const auto place = [](double i, double j, double k) {
        const double angle = i * std::numbers::pi / 8, r = 3 + j;
        return glm::dvec3(r * std::cos(angle), r * std::sin(angle), k);
    };
    const Mesh closed(placesOf({17, 4, 3}, place)), half(placesOf({9, 4, 3}, place));
    for (std::uint64_t i = 0; i < closed.count(); ++i) {
        const bool isEnd = i % 17 == 0 || i % 17 == 16;
        const double r = 3 + static_cast<double>(i / 17 % 4),
                     side = r * std::sin(std::numbers::pi / 8);
        EXPECT_NEAR(closed.volume(i), isEnd ? side / 2 : side, 1e-5) << i;
        EXPECT_NEAR(std::abs(closed.cell(i).determinant()), side, 1e-5) << i;
    }
    for (std::uint64_t i = 0; i < half.count(); ++i) EXPECT_EQ(half.widened(i), 0u) << i;
    // Out along one side of a wake, and back along the other, to the same place but for rounding.
    const Mesh wake(placesOf({17, 4, 3}, [](double i, double j, double k) {
        const double along = std::abs(i - 8);
        return glm::dvec3(along, i < 8 ? -j - 0.3 : j + (i > 15 ? -0.3 + 1e-7 : 0.3), k);
    }));
    for (std::uint64_t i = 0; i < wake.count(); ++i) EXPECT_EQ(wake.widened(i), 0u) << i;
    // On a flat map the ends of a circle of latitude lie apart.
    auto degrees = placesOf({13, 5, 3}, [](double i, double j, double k) {
        return glm::dvec3(30 * i, j + 0.1 * i, k);
    });
    degrees.period = {360, 0, 0};
    const Mesh flat(degrees);
    for (std::uint64_t i = 0; i < flat.count(); ++i) EXPECT_EQ(flat.widened(i), 0u) << i;
}

// However lines bend, close or come near to each other.
TEST(AxisRings, CellsOnNoRingAboutAnAxisAreAsWideAsTheirSteps) {
    const auto expectNone = [](const MeshPlaces& places) {
        const Mesh mesh(places);
        for (std::uint64_t i = 0; i < mesh.count(); ++i) ASSERT_EQ(mesh.widened(i), 0u) << i;
    };
    const auto ring = [](double angle, double r, double k) {
        return glm::dvec3(r * std::cos(angle), r * std::sin(angle), k);
    };
    expectNone(placesOf({9, 6, 3}, [&](double i, double j, double k) {  // half of one
        return ring(i * std::numbers::pi / 8, j + 0.5, k);
    }));
    expectNone(placesOf({36, 6, 3}, [&](double i, double j, double k) {  // with a hole
        return ring(i * std::numbers::pi / 18, j + 2, k);
    }));
    expectNone(placesOf({36, 6, 3}, [&](double i, double j, double k) {  // above each other
        return ring(i * std::numbers::pi / 18, j + 2, 3 * k);
    }));
    expectNone(placesOf({36, 6, 3}, [&](double i, double j, double k) {  // round a wall, as floats
        const double r = 1 + 1e-6 * std::expm1(0.2 * j);
        return glm::dvec3(glm::vec3(ring(i * std::numbers::pi / 18, r, k)));
    }));
    expectNone(placesOf({9, 5, 5}, [](double i, double j, double k) {  // a corner
        return i < 4 ? glm::dvec3(i, j - 10, k) : glm::dvec3(4, j - 14 + i, k);
    }));
    expectNone(placesOf({9, 9, 9}, [](double i, double j, double k) {  // layers over a mountain
        return glm::dvec3(1000 * i, 1000 * j, 300 * std::sin(i) * std::cos(j) + std::exp2(k));
    }));
    expectNone(placesOf({9, 9, 9}, [](double i, double j, double k) {  // growing, beside a wall
        return glm::dvec3(0.01 * i + 0.05 * std::exp2(k) * 1e-4, 0.01 * j, std::exp2(k) * 1e-4);
    }));
    auto degrees =
        placesOf({36, 9, 5}, [](double i, double j, double k) {  // and hundreds of metres
            return glm::dvec3(10 * i, j, 300 * k + 150 * std::abs(std::sin(i / 12)));
        });
    degrees.period = {360, 0, 0};
    expectNone(degrees);
}

}  // namespace
}  // namespace timeseries
