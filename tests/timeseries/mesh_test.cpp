#include "timeseries/grid/mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <random>
#include <stdexcept>

#include "tests/support/meshes.h"
#include "tests/support/trilinear.h"
#include "tests/support/unstructured.h"
#include "timeseries/grid/middles.h"
#include "timeseries/together.h"

namespace timeseries {
namespace {

using tests::placesOf;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A place is kept to a 2^24th of the mesh's extent.
void expectNear(const glm::dvec3& found, const glm::dvec3& expected, double rounding) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], rounding);
}
// The shape of a cell of these steps: L L^T = J J^T, its numbers kept to a 2^9th and one to a
// 2^8th.
void expectShape(const LowerTriangle<double>& found, const glm::dmat3& steps, double rounding) {
    const auto rows = found.rows();
    const glm::dmat3 expected = steps * glm::transpose(steps);
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
            EXPECT_NEAR(glm::dot(rows[a], rows[b]), expected[a][b],
                        rounding + 0x1p-7 * std::sqrt(expected[a][a] * expected[b][b]));
}
double volume(const Mesh& mesh, std::uint64_t index) {
    return std::abs(mesh.cell(index).determinant());
}

TEST(Mesh, AStraightOneHasThePlacesAndCellsOfTheUprightGrid) {
    const Grid upright({Axis{"x", "", {10, 11, 13, 17}}, Axis{"y", "", {5, 4, 2}},
                        Axis{"z", "", {-1, 0, 3, 4, 9}}});
    const auto at = [&](std::size_t axis, double i) {
        return upright.axes()[axis].coordinates[static_cast<std::size_t>(i)];
    };
    const Mesh mesh(placesOf({4, 3, 5}, [&](double i, double j, double k) {
        return glm::dvec3(at(0, i), at(1, j), at(2, k));
    }));
    MeshPlaces byLevels = placesOf(
        {4, 3, 1}, [&](double i, double j, double) { return glm::dvec3(at(0, i), at(1, j), 0); });
    byLevels.size[2] = 5;
    byLevels.levels = upright.axes()[2].coordinates;
    const Mesh ofLevels(byLevels);
    ASSERT_EQ(mesh.count(), upright.count());
    double volumes = 0;
    for (std::uint64_t i = 0; i < upright.count(); ++i) {
        for (const Mesh* each : {&mesh, &ofLevels}) {
            expectNear(each->position(i), upright.position(i), 1e-6);
            expectShape(each->cell(i), upright.cell(i), 1e-5);
            EXPECT_NEAR(volume(*each, i), std::abs(glm::determinant(upright.cell(i))), 1e-5);
        }
        volumes += std::abs(glm::determinant(upright.cell(i)));
    }
    for (const Mesh* each : {&mesh, &ofLevels}) {
        EXPECT_NEAR(double(each->meanVolume()), volumes / 60, 1e-14 * volumes);
        expectNear(each->widest(), {4, 2, 5}, 1e-12);  // the longest steps, at ends or between
    }
    expectNear(mesh.lo(), {10, 2, -1}, 1e-6);
    expectNear(mesh.hi(), {17, 5, 9}, 1e-6);
    EXPECT_TRUE(notesOf(mesh).empty());
    EXPECT_LT(ofLevels.bytes(), mesh.bytes() / 2);
}

TEST(Mesh, CellsAreTheStepsBetweenNeighbours) {
    const glm::dmat3 steps({3, 0.5, 0}, {-1, 2, 0.25}, {0, 0.75, 1.5});  // columns
    const Mesh mesh(placesOf({5, 4, 3}, [&](double i, double j, double k) {
        return steps * glm::dvec3(i, j, k) + glm::dvec3(100, -50, 7);
    }));
    for (std::uint64_t i = 0; i < mesh.count(); ++i) {
        expectShape(mesh.cell(i), steps, 1e-5);
        EXPECT_NEAR(volume(mesh, i), glm::determinant(steps), 1e-5);
    }
}

// Cells that are alike are rounded alike: what they add up to is what they are.
TEST(Mesh, VolumesAddUpToTheWhole) {
    using Place = std::function<glm::dvec3(double, double, double)>;
    const auto grown = [](double i) { return (std::pow(1.2, i) - 1) / 0.2; };
    const Place places[] = {
        [](double i, double j, double k) { return glm::dvec3(i, j, k) / 27.0; },
        [](double i, double j, double k) {
            return glm::dvec3(i + 0.37 * j, j, 0.7 * k + 0.61 * i);
        },
        [&](double i, double j, double k) { return glm::dvec3(i, 3 * j, grown(k) + 0.3 * i); },
        [](double i, double j, double k) {
            return glm::dvec3((3 + j) * std::cos(0.1 * i), (3 + j) * std::sin(0.1 * i), k);
        }};
    for (const Place& place : places) {
        const Mesh one(placesOf({30, 20, 10}, place));
        MeshPlaces levels = placesOf({30, 20, 1}, place);
        levels.size[2] = 10;
        for (int k = 0; k < 10; ++k) levels.levels.push_back(grown(k));
        const Mesh ofLevels(levels);
        for (const Mesh* each : {&one, &ofLevels}) {
            double sum = 0;
            for (std::uint64_t i = 0; i < each->count(); ++i) sum += volume(*each, i);
            const double whole = double(each->meanVolume()) * double(each->count());
            EXPECT_NEAR(sum / whole, 1, 5e-7);
        }
    }
}

TEST(Mesh, TurnedOverItStandsForAsMuch) {
    const auto place = [](double i, double j, double k) {
        return glm::dvec3(i + 0.1 * j * k, j * (1 + 0.05 * i), 2 * k);
    };
    const Mesh mesh(placesOf({4, 5, 6}, place));
    const Mesh mirrored(placesOf({4, 5, 6}, [&](double i, double j, double k) {
        return place(i, j, k) * glm::dvec3(-1, 1, 1);
    }));
    const Mesh reversed(
        placesOf({4, 5, 6}, [&](double i, double j, double k) { return place(3 - i, j, k); }));
    EXPECT_NEAR(double(mirrored.meanVolume()), double(mesh.meanVolume()), 1e-12);
    EXPECT_NEAR(double(reversed.meanVolume()), double(mesh.meanVolume()), 1e-12);
    EXPECT_EQ(mirrored.folded(), 0u);
    for (std::uint64_t i = 0; i < mesh.count(); ++i)
        EXPECT_NEAR(volume(mirrored, i), volume(mesh, i), 1e-12);
}

// Each of the middles of bricks: sides in the mean of four, and what is between bent faces.
TEST(Mesh, CellsBetweenCornersThatAreKnownAreTheirOwn) {
    const auto lattice = placesOf({5, 4, 6}, [](double i, double j, double k) {
        const glm::dvec3 at = tests::bent(i, j, k);
        return glm::dvec3(at.x * at.x, at.y, at.z);
    });
    const auto cornerAt = [&](std::uint64_t i, std::uint64_t j, std::uint64_t k) {
        return lattice.at[i + 5 * (j + 4 * k)];
    };
    const Mesh mesh(MeshPlaces{.size = {4, 3, 5},
                               .at = middlesOf(lattice.at, lattice.size),
                               .corners = {lattice.size, lattice.at}});
    double all = 0;
    for (std::uint64_t n = 0; n < mesh.count(); ++n) {
        const std::uint64_t i = n % 4, j = n / 4 % 3, k = n / 12;
        std::vector<glm::dvec3> corners;
        for (const std::uint64_t far : {0u, 1u})
            for (const auto& [di, dj] : {std::pair(0u, 0u), {1u, 0u}, {1u, 1u}, {0u, 1u}})
                corners.push_back(cornerAt(i + di, j + dj, k + far));
        const double expected = tests::trilinearVolume(corners);
        EXPECT_NEAR(volume(mesh, n), expected, 1e-6 * expected);
        all += volume(mesh, n);
        const auto sideOf = [&](std::size_t a, std::size_t b) { return corners[b] - corners[a]; };
        glm::dmat3 sides((sideOf(0, 1) + sideOf(3, 2) + sideOf(4, 5) + sideOf(7, 6)) / 4.0,
                         (sideOf(0, 3) + sideOf(1, 2) + sideOf(4, 7) + sideOf(5, 6)) / 4.0,
                         (sideOf(0, 4) + sideOf(1, 5) + sideOf(2, 6) + sideOf(3, 7)) / 4.0);
        sides *= std::cbrt(expected / glm::determinant(sides));
        expectShape(mesh.cell(n), sides, 1e-5);
    }
    EXPECT_NEAR(all, 16 * 3 * 5, 1e-4) << "of a box";
}

// L L^T = J J^T of J = L Q with Q a rotation. Also where L is such that nothing needs to be turned.
TEST(Mesh, ACellIsTheSameFromSidesThatAreTurned) {
    std::mt19937 random(23);
    std::uniform_real_distribution<double> some(-2, 2);
    std::vector<MeshPoint> lower(1000), turned(1000);
    for (std::size_t i = 0; i < lower.size(); ++i) {
        const auto at = [&] { return some(random); };
        lower[i] = {{at(), at(), at()},
                    {glm::dvec3(at(), 0, 0), {at(), at(), 0}, {at(), at(), at()}}};
        turned[i] = lower[i];
        const double angle = at();
        const glm::dvec3 axis = glm::normalize(glm::dvec3(at(), at(), at()));
        const auto turn = [&](const glm::dvec3& v) {  // Rodrigues
            return std::cos(angle) * v + std::sin(angle) * glm::cross(axis, v) +
                   (1 - std::cos(angle)) * glm::dot(axis, v) * axis;
        };
        for (glm::dvec3& row : turned[i].rows) row = turn(row);
    }
    const std::vector between{glm::dvec3(-2), glm::dvec3(2)};
    const auto meshOf = [&](const std::vector<MeshPoint>& points) {
        return Mesh(points.size(), between, 1, [&](std::uint64_t i) { return points[i]; });
    };
    const Mesh a = meshOf(lower), b = meshOf(turned);
    EXPECT_GT(a.folded(), 300u);
    EXPECT_EQ(a.folded(), b.folded());
    for (std::uint64_t i = 0; i < a.count(); ++i) {
        EXPECT_NEAR(glm::distance(a.cell(i).diagonal, b.cell(i).diagonal), 0, 1e-6);
        EXPECT_NEAR(glm::distance(a.cell(i).below, b.cell(i).below), 0, 1e-6);
    }
}

TEST(Mesh, WhereANeighbourHasNoPlaceTheOtherSideIsTaken) {
    const Mesh mesh(placesOf({4, 4, 4}, [](double i, double j, double k) {
        if (i == 2 && j == 1 && k == 1) return glm::dvec3(kNan);
        return glm::dvec3(i * i, j, k);
    }));
    EXPECT_EQ(mesh.absent(), 1u);
    EXPECT_NEAR(mesh.cell(1 + 4 * (2 + 4)).diagonal.x, 2, 1e-6);  // (4 - 0) / 2, beside another row
    EXPECT_NEAR(mesh.cell(1 + 4 * (1 + 4)).diagonal.x, 1, 1e-6);  // 1 - 0 alone
    EXPECT_EQ(volume(mesh, 3 + 4 * (1 + 4)), 0) << "none on either side";
    EXPECT_EQ(mesh.flat(), 3u) << "those at i = 3, j = 0 and k = 0, whose only one it is";
    EXPECT_FALSE(std::isfinite(mesh.position(2 + 4 * (1 + 4)).x));
    const auto notes = notesOf(mesh);
    ASSERT_EQ(notes.size(), 3u);
    EXPECT_EQ(notes[0], "1 of 64 points are not drawn: the file gives them no place");
    EXPECT_EQ(notes[1], "3 of 64 points are not drawn: their cells have no volume");
    // i = 1, j = 2 and k = 2 lie beside it, and have another neighbour opposite.
    EXPECT_EQ(notes[2],
              "3 of 64 points have a neighbour without a place: their cells are as wide as to its "
              "other side");
}

// By brute force: of a lattice with holes at random, also of columns.
TEST(Mesh, PointsBesideHolesAreCounted) {
    std::mt19937 random(5);
    for (int round = 0; round < 200; ++round) {
        const bool isFlat = round % 2 == 1;
        MeshPlaces places = placesOf({4, 5, isFlat ? 1u : 3u}, [&](double i, double j, double k) {
            return random() % 5 == 0 ? glm::dvec3(kNan) : glm::dvec3(i, j, k);
        });
        std::uint64_t expected = 0;
        const auto isThere = [&](const glm::ivec3& at) {
            return isPlace(places.at[std::size_t(at.x + 4 * (at.y + 5 * at.z))]);
        };
        for (int n = 0; n < int(places.at.size()); ++n) {
            const glm::ivec3 size(4, 5, isFlat ? 1 : 3), at(n % 4, n / 4 % 5, n / 20);
            int missing = 0, without = 0;
            for (int a = 0; a < 3; ++a) {
                int found = 0;
                for (const int way : {-1, 1}) {
                    glm::ivec3 beside = at;
                    beside[a] += way;
                    if (beside[a] < 0 || beside[a] >= size[a]) continue;
                    isThere(beside) ? ++found : ++missing;
                }
                without += found == 0 && size[a] > 1;
            }
            expected += isThere(at) && missing > 0 && without == 0;
        }
        if (round % 4 == 3) {
            places.size[2] = 3;
            places.levels = {0, 1, 3};
            expected *= 3;
        }
        EXPECT_EQ(Mesh(places).about().oneSided, expected) << round;
    }
}

TEST(Mesh, LongitudesAreAsFarApartAsTheShorterWay) {
    // Steps of 30 degrees, as files write them: from 180 on as negative ones.
    MeshPlaces places = placesOf({12, 3, 2}, [](double i, double j, double k) {
        const double lon = 90 + 30 * i;
        return glm::dvec3(lon < 180 ? lon : lon - 360, 10 * j, k);
    });
    places.period = {360, 0, 0};
    const Mesh mesh(places);
    for (std::uint64_t i = 0; i < mesh.count(); ++i)
        expectShape(mesh.cell(i), glm::dmat3({30, 0, 0}, {0, 10, 0}, {0, 0, 1}), 1e-3);
    places.period = {};
    EXPECT_GT(Mesh(places).widest().x, 100) << "without a period";
}

TEST(Mesh, AFoldedCellStandsForNothing) {
    const Mesh mesh(placesOf({6, 3, 3}, [](double i, double j, double k) {
        return glm::dvec3(i == 3 ? 0.5 : i, j, k);  // beside the first, behind the second
    }));
    // At i = 2 the way from 1 to 0.5 leads back.
    EXPECT_EQ(mesh.folded(), 9u);
    EXPECT_EQ(volume(mesh, 2), 0);
    EXPECT_GT(volume(mesh, 1), 0);
    EXPECT_EQ(notesOf(mesh).size(), 1u);
}

// Of an index of one point: a sheet, a thread, a point.
TEST(Mesh, ThinOnesAreAsThickAsTheyAreWide) {
    for (int thin = 0; thin < 3; ++thin) {
        std::array<std::size_t, 3> size{5, 5, 5};
        size[static_cast<std::size_t>(thin)] = 1;
        const Mesh sheet(placesOf(size, [&](double i, double j, double k) {
            return glm::dvec3(2 * i + 0.5 * j, 3 * j, 6 * k + j);
        }));
        // Steps that are all alike, and one of the length of their area's root across them.
        glm::dmat3 steps({2, 0, 0}, {0.5, 3, 1}, {0, 0, 6});
        const glm::dvec3 across = glm::cross(steps[(thin + 1) % 3], steps[(thin + 2) % 3]);
        steps[thin] = across / std::sqrt(glm::length(across));
        for (std::uint64_t i = 0; i < sheet.count(); ++i) {
            expectShape(sheet.cell(i), steps, 1e-5);
            EXPECT_NEAR(volume(sheet, i), std::pow(glm::length(across), 1.5), 1e-4);
        }
    }
    for (int along = 0; along < 3; ++along) {
        std::array<std::size_t, 3> size{1, 1, 1};
        size[static_cast<std::size_t>(along)] = 4;
        const Mesh thread(placesOf(
            size, [](double i, double j, double k) { return (i + j + k) * glm::dvec3(2, 1, -2); }));
        for (std::uint64_t i = 0; i < 4; ++i)
            EXPECT_NEAR(volume(thread, i), 27, 1e-5) << along;  // steps of length 3
    }
    const Mesh point(placesOf({1, 1, 1}, [](double, double, double) { return glm::dvec3(7); }));
    EXPECT_EQ(volume(point, 0), 1);
}

TEST(Mesh, AddsUpTheSameOnAnyNumberOfThreads) {
    const auto made = [](unsigned threads) {
        threadLimit = threads;
        Mesh mesh(placesOf({60, 70, 40}, [](double i, double j, double k) {
            return glm::dvec3(i + std::sin(j), j * 1.1 + std::cos(k), k * (1 + 0.01 * i));
        }));
        threadLimit = 0;
        return mesh;
    };
    EXPECT_EQ(made(1).meanVolume(), made(5).meanVolume());
    EXPECT_EQ(made(1), made(3));
}

// Coordinates that leave the floats, and volumes that leave the doubles.
TEST(Mesh, IsTheSameInAnyUnit) {
    const auto in = [](double unit) {
        return Mesh(placesOf({4, 3, 5}, [&](double i, double j, double k) {
            return unit * glm::dvec3(i + 0.25 * j, j, 2 * k + 0.5 * i);
        }));
    };
    const Mesh one = in(1);
    for (const int power : {-1000, -140, 140, 1000}) {
        const double unit = std::ldexp(1.0, power);
        const Mesh mesh = in(unit);
        EXPECT_EQ(mesh.meanVolume(), std::ldexp(one.meanVolume(), 3 * power));
        for (std::uint64_t i = 0; i < one.count(); ++i) {
            EXPECT_EQ(mesh.position(i), unit * one.position(i));
            EXPECT_EQ(mesh.cell(i).diagonal, unit * one.cell(i).diagonal);
            EXPECT_EQ(mesh.cell(i).below, unit * one.cell(i).below);
        }
    }
}

TEST(Mesh, RefusesWhatPlacesNothing) {
    const auto refuses = [](const MeshPlaces& places) {
        EXPECT_THROW(Mesh{places}, std::invalid_argument);
    };
    refuses(placesOf({3, 3, 3}, [](double, double, double) { return glm::dvec3(kNan); }));
    refuses(placesOf({3, 3, 3}, [](double, double, double) { return glm::dvec3(1); }));
    refuses(placesOf({3, 3, 3}, [](double i, double j, double) { return glm::dvec3(i, j, 0); }));
    MeshPlaces few =
        placesOf({3, 3, 3}, [](double i, double j, double k) { return glm::dvec3(i, j, k); });
    few.at.pop_back();
    refuses(few);
    few.size = {0, 3, 3};
    few.at = {};
    refuses(few);
}

}  // namespace
}  // namespace timeseries
