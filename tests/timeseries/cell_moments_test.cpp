// Volumes, centroids and second moments of cells against closed forms and each other.
#include "timeseries/grid/cell_moments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <memory>
#include <random>

#include "tests/support/trilinear.h"
#include "tests/support/vector_targets.h"
#include "timeseries/grid/cell_types.h"
#include "timeseries/grid/solid_moments.h"

namespace timeseries {
namespace {

void expectNear(const CellMoments& found, const CellMoments& expected, double error) {
    EXPECT_NEAR(found.volume, expected.volume, error * expected.volume);
    for (int a = 0; a < 3; ++a) {
        EXPECT_NEAR(found.centroid[a], expected.centroid[a], error);
        for (int b = 0; b < 3; ++b)
            EXPECT_NEAR(found.second[a][b], expected.second[a][b], error) << a << b;
    }
}

CellMoments momentsOf(std::uint8_t type, const std::vector<glm::dvec3>& corners) {
    const auto solids = std::make_unique<SolidColumns>();
    for (std::size_t i = 0; i < corners.size(); ++i) solids->setCorner(0, i, corners[i]);
    measureSolids(*cellTypeOf(type), 1, *solids);
    return solids->moments(0);
}

// The corners of each solid kind, as "VTK File Formats" draws them; of 15 and 16 prisms over
// regular polygons.
struct Kind {
    std::uint8_t type;
    std::vector<glm::dvec3> corners;
    double volume;
};
std::vector<Kind> kinds() {
    const auto prism = [](int sides) {
        std::vector<glm::dvec3> corners;
        for (const double z : {0.0, 1.0})
            for (int i = 0; i < sides; ++i) {
                const double angle = 2 * M_PI * i / sides;
                corners.emplace_back(std::cos(angle), std::sin(angle), z);
            }
        return corners;
    };
    const auto area = [](int sides) { return 0.5 * sides * std::sin(2 * M_PI / sides); };
    return {
        {10, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 1.0 / 6},
        {11,
         {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}},
         1},
        {12,
         {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
         1},
        {13, {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}}, 0.5},
        {14, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}}, 1.0 / 3},
        {15, prism(5), area(5)},
        {16, prism(6), area(6)}};
}

TEST(CellMoments, OfABoxAreItsSides) {
    const glm::dvec3 at(3, -2, 5), side(2, 3, 0.5);
    for (const Kind& kind : kinds()) {
        if (kind.type != 11 && kind.type != 12) continue;
        std::vector<glm::dvec3> corners;
        for (const glm::dvec3& corner : kind.corners) corners.push_back(at + side * corner);
        glm::dmat3 second(0.0);
        for (int a = 0; a < 3; ++a) second[a][a] = side[a] * side[a] / 12;
        expectNear(momentsOf(kind.type, corners), {3, at + 0.5 * side, second}, 1e-12);
    }
}

// Of a tetrahedron: the sum of (v - c)(v - c)^T over its corners, by 20.
TEST(CellMoments, OfATetrahedronAreThoseOfItsCorners) {
    const std::vector<glm::dvec3> corners{{1, 2, 3}, {4, 1, 2}, {2, 5, 1}, {1.5, 2.5, 6}};
    glm::dvec3 mean(0);
    for (const auto& corner : corners) mean += corner / 4.0;
    glm::dmat3 second(0.0);
    for (const auto& corner : corners)
        second += glm::outerProduct(corner - mean, corner - mean) / 20.0;
    const double volume = glm::dot(corners[1] - corners[0],
                                   glm::cross(corners[2] - corners[0], corners[3] - corners[0])) /
                          6;
    expectNear(momentsOf(10, corners), {volume, mean, second}, 1e-12);
}

// What maps a cell maps its moments; turned inside out it is the same cell.
TEST(CellMoments, FollowEveryAffineMap) {
    const glm::dmat3 map({2, 0.5, 0.1}, {-0.3, 1.5, 0.4}, {0.2, -0.6, 0.8});
    const glm::dvec3 shift(100, -20, 3);
    for (const Kind& kind : kinds())
        for (const double sense : {1.0, -1.0}) {
            const glm::dmat3 turned(map[0], map[1], sense * map[2]);
            const CellMoments before = momentsOf(kind.type, kind.corners);
            EXPECT_NEAR(before.volume, kind.volume, 1e-12) << int(kind.type);
            std::vector<glm::dvec3> corners;
            for (const auto& corner : kind.corners) corners.push_back(turned * corner + shift);
            expectNear(
                momentsOf(kind.type, corners),
                {before.volume * std::abs(glm::determinant(map)), turned * before.centroid + shift,
                 turned * before.second * glm::transpose(turned)},
                1e-11);
        }
}

// Each with its corners a little elsewhere.
Kind shaken(Kind kind, std::mt19937& random) {
    std::uniform_real_distribution<double> some(-0.1, 0.1);
    for (auto& corner : kind.corners)
        corner += glm::dvec3(some(random), some(random), some(random));
    return kind;
}

// One after the other, and every second one turned.
std::vector<std::vector<glm::dvec3>> facesOf(const Kind& kind) {
    const CellType& type = *cellTypeOf(kind.type);
    std::vector<std::vector<glm::dvec3>> faces;
    std::size_t next = 0;
    for (const std::uint8_t size : type.faceSizes) {
        auto& face = faces.emplace_back();
        for (std::uint8_t i = 0; i < size; ++i) face.push_back(kind.corners[type.faces[next++]]);
        if (faces.size() % 2 == 0) std::ranges::reverse(face);
    }
    return faces;
}

TEST(CellMoments, OfAPolyhedronAreThoseOfTheSameSolidHoweverItsFacesAreTurned) {
    std::mt19937 random(3);
    for (const Kind& plain : kinds()) {
        const Kind kind = shaken(plain, random);
        expectNear(momentsOfPolyhedron(facesOf(kind)), momentsOf(kind.type, kind.corners), 1e-12);
    }
}

// Also beside solids without a volume, or without a place.
TEST(CellMoments, OfSolidsSideBySideAreThoseOfEach) {
    const auto solids = std::make_unique<SolidColumns>();
    tests::onEachVectorTarget([&] {
        std::mt19937 random(5);
        for (const Kind& kind : kinds())
            for (const std::size_t count : {1u, 3u, 37u, 64u}) {
                std::vector<Kind> all;
                for (std::size_t i = 0; i < count; ++i) {
                    all.push_back(shaken(kind, random));
                    auto& corners = all.back().corners;
                    if (i % 7 == 2) std::ranges::fill(corners, corners[1]);
                    if (i % 7 == 5) corners[0].y = std::nan("");
                    for (std::size_t k = 0; k < corners.size(); ++k)
                        solids->setCorner(i, k, corners[k]);
                }
                measureSolids(*cellTypeOf(kind.type), count, *solids);
                for (std::size_t i = 0; i < count; ++i) {
                    const CellMoments found = solids->moments(i);
                    if (i % 7 == 5) {
                        EXPECT_EQ(found.volume, 0);
                        EXPECT_TRUE(std::isnan(found.centroid.y));
                        continue;
                    }
                    if (i % 7 == 2)
                        expectNear(found, {0, all[i].corners[1], glm::dmat3(0.0)}, 1e-12);
                    else
                        expectNear(found, momentsOfPolyhedron(facesOf(all[i])), 1e-12);
                }
            }
    });
}

TEST(CellMoments, OfAHexahedronOfBentFacesAreThoseOfTheTrilinearOne) {
    const std::vector<glm::dvec3> corners{{0, 0, 0},   {1, 0.1, 0}, {1.2, 1, 0.3}, {0, 1, 0},
                                          {0, 0.2, 1}, {1, 0, 1.1}, {1, 1, 1.4},   {-0.2, 1, 1}};
    EXPECT_NEAR(momentsOf(12, corners).volume, tests::trilinearVolume(corners), 1e-12);
}

TEST(CellMoments, OfSurfacesAndLinesLieInThem) {
    // A rectangle of sides 2 and 3 that leans.
    const glm::dvec3 a(2, 0, 0), b(0, 1.8, 2.4), at(5, 6, 7);
    const std::vector<glm::dvec3> corners{at, at + a, at + a + b, at + b};
    expectNear(momentsOfPolygon(corners),
               {6, at + 0.5 * (a + b), (glm::outerProduct(a, a) + glm::outerProduct(b, b)) / 12.0},
               1e-12);
    // An L of four squares, whose first corner the others are seen from.
    const std::vector<glm::dvec3> bent{{0, 0, 0}, {3, 0, 0}, {3, 1, 0},
                                       {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
    EXPECT_NEAR(momentsOfPolygon(bent).volume, 4, 1e-12);
    EXPECT_NEAR(momentsOfPolygon(bent).centroid.x, (0.5 + 0.5 + 1.5 + 2.5) / 4, 1e-12);
    const CellMoments line = momentsOfLine(std::vector{at, at + a, at + a + b});
    EXPECT_NEAR(line.volume, 5, 1e-12);
    const glm::dvec3 middle = (2.0 * (at + 0.5 * a) + 3.0 * (at + a + 0.5 * b)) / 5.0;
    EXPECT_NEAR(glm::distance(line.centroid, middle), 0, 1e-12);
    expectNear(momentsOfLine(std::vector{at, at + b}),
               {3, at + 0.5 * b, glm::outerProduct(b, b) / 12.0}, 1e-12);
}

TEST(CellMoments, OfWhatHasNoSizeAreNone) {
    const std::vector<glm::dvec3> same(8, glm::dvec3(1, 2, 3));
    for (const CellMoments& none :
         {momentsOf(12, same), momentsOfPolygon(same), momentsOfLine(same), momentsOfPolyhedron({}),
          momentsOfPolyhedron(std::vector{same, same})})
        EXPECT_EQ(none.volume, 0);
}

}  // namespace
}  // namespace timeseries
