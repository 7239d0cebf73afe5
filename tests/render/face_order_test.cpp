// The order of a mesh's cells by their common faces: along any ray from the eye, each is passed
// before those that lie behind it, where the distances of their middles fail.
#include "render/splat/face_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "render/reference/parts_on_rays.h"
#include "render/splat/cell_pieces.h"
#include "tests/support/cell_worlds.h"
#include "tests/support/lon_lat_belt.h"
#include "tests/support/meshes.h"
#include "tests/support/order_on_rays.h"
#include "tests/support/unstructured.h"

namespace render {
namespace face_order {
namespace {

using tests::CellWorld;
using tests::Cut;
using tests::listed;
using tests::Passed;
using tests::passed;
using tests::views;
using tests::wholeOf;
using timeseries::Grid;

// Thin steps beside thick ones, all leaning: every face is flat.
glm::dvec3 flatFaced(double i, double j, double k) {
    const glm::dmat3 leaning{1, 0.2, 0.6, -0.7, 1.3, 0.1, 0.9, 0.5, 0.8};
    return leaning * glm::dvec3(std::pow(1.6, i), j * j / 12, 0.3 * std::pow(k, 2.5));
}

std::shared_ptr<const Grid> solids(Cut cut, const auto& place) {
    return tests::gridOf(tests::atPoints(tests::bricks({6, 6, 5}, cut, place)));
}

void expectInOrder(CellWorld world) {
    Passed byFaces, byMiddles;
    for (const View& view : views()) {
        for (const bool isByMiddles : {false, true}) {
            world.scene.byMiddles = isByMiddles;
            (isByMiddles ? byMiddles : byFaces) += passed(world, view);
        }
    }
    EXPECT_GT(byFaces.inOrder, 1'000u);
    EXPECT_EQ(byFaces.wrong, 0u);
    EXPECT_GT(byMiddles.wrong, 5u) << "this asks for nothing";
}

TEST(FaceOrder, IsThatOfEveryRayWhereCellsLeanAndGrow) {
    expectInOrder(wholeOf(tests::curvilinear({6, 6, 5}, flatFaced)));
    for (const Cut cut : tests::kCuts) {
        SCOPED_TRACE(int(cut));
        expectInOrder(wholeOf(solids(cut, flatFaced)));
    }
}

// Prisms that a file has as hexahedra, each with two of its edges in one, not always the same.
TEST(FaceOrder, KnowsTheFacesOfCollapsedCells) {
    const auto prisms = tests::bricks({6, 6, 5}, Cut::Wedges, flatFaced);
    timeseries::UnstructuredGrid collapsed;
    collapsed.points = prisms.points;
    for (std::size_t cell = 0; cell < prisms.types.size(); ++cell) {
        const auto at = [&](std::size_t k) { return prisms.corners[6 * cell + k]; };
        const std::size_t a = cell % 3, b = (a + 1) % 3, c = (a + 2) % 3;
        tests::addCell(collapsed, 12,
                       {at(a), at(a), at(b), at(c), at(a + 3), at(a + 3), at(b + 3), at(c + 3)});
    }
    expectInOrder(wholeOf(tests::gridOf(tests::atPoints(collapsed))));
}

// Of cells that no file should have: on each other, or of one point. All are there, and soon.
TEST(FaceOrder, TakesNoLongerWhereVeryManyCellsShareAFace) {
    for (const bool isPoint : {false, true}) {
        auto grid = tests::bricks({3, 3, 3}, Cut::Tetrahedra, tests::bent);
        for (int n = 0; n < 100'000; ++n) {
            if (isPoint)
                tests::addCell(grid, 12, {0, 0, 0, 0, 0, 0, 0, 0});
            else
                tests::addCell(grid, 10, {0, 1, 3, 9});
        }
        const CellWorld world = wholeOf(tests::gridOf(tests::atPoints(grid)));
        const auto list = listed(world.scene, tests::lookFrom({1.2, -2.5, 1}, {20, 16}));
        std::vector<bool> seen(grid.types.size());
        for (const CellOfLayer& of : list) seen[of.cell] = true;
        EXPECT_EQ(std::ranges::count(seen, true), std::ssize(list));
        EXPECT_GT(list.size(), 100'000u);
    }
}

// Also over where its points come round, where the first cells are beside the last.
TEST(FaceOrder, GoesRoundARing) {
    constexpr int kSectors = 9;
    const auto ring = [](bool isClosed) {
        return tests::curvilinear(
            {kSectors + (isClosed ? 1u : 0u), 4, 3}, [](double i, double j, double k) {
                const double part = std::fmod(i, kSectors) / kSectors;
                const double a = 2 * std::numbers::pi * part * (0.4 + 0.6 * part);
                const double r = 1 + 0.2 * j * j;
                return glm::dvec3(r * std::cos(a), r * std::sin(a), std::pow(k, 1.5));
            });
    };
    const CellWorld world = wholeOf(ring(true));
    const glm::dvec3 seam = world.placed.position(1 + 4 * 4);
    Passed sum;
    for (const double up : {-1.5, -0.2, 0.4, 1.1, 2.5})
        for (const double aside : {-0.8, -0.1, 0.2, 0.9})
            sum += passed(world, tests::lookFrom(2.0 * seam + glm::dvec3(0, aside, up), {24, 18}));
    EXPECT_GT(sum.inOrder, 1'000u);
    EXPECT_EQ(sum.wrong, 0u);

    // How many cells name a face between two of them along the ring.
    for (const bool isClosed : {true, false}) {
        const CellWorld one = wholeOf(ring(isClosed));
        const MeshCells cells(one.placed, one.scene.cells->cornersOf(), one.scene.clip);
        std::map<FaceKey, int> named;
        for (std::uint32_t cell = 0; cell < cells.count(); ++cell)
            cells.forEachFace(cell, [&](const FaceKey& key, const auto&) {
                if (key[1] == 0) ++named[key];
            });
        const auto once = std::ranges::count(named, 1, [](const auto& of) { return of.second; });
        EXPECT_EQ(once, isClosed ? 0 : 5 * 4) << "and of half cells beyond the outermost points";
    }
}

// Cells at both ends of a map know each other's faces, and are drawn far from each other.
TEST(FaceOrder, IsOfCellsWhereTheyAreDrawn) {
    const auto around = [](double i, double j, double k) {
        return glm::dvec3(tests::wrapped(20 + 30 * i), 30 * j, 25 * k);
    };
    auto places = tests::placesOf({12, 4, 3}, around);
    places.period = {360, 0, 0};
    timeseries::Mesh solid = tests::atPoints(tests::bricks({12, 4, 3}, Cut::Hexahedra, around));
    solid.setSolids(solid.solids(), {360, 0, 0});
    for (const auto& grid : {tests::gridOf(std::move(places)), tests::gridOf(std::move(solid))}) {
        const CellWorld world = wholeOf(grid);
        Passed sum;
        for (const glm::dvec3& from : {glm::dvec3(3, 0.1, 0.2), glm::dvec3(-3, 0.2, -0.1),
                                       glm::dvec3(0.9, 0.2, 0.3), glm::dvec3(0.1, -0.2, 2)})
            sum += passed(world, tests::lookFrom(from, {24, 18}));
        EXPECT_GT(sum.inOrder, 500u);
        EXPECT_EQ(sum.wrong, 0u);
    }
}

TEST(FaceOrder, HasACellOnceForEachOfItsLayers) {
    const auto grid = tests::curvilinear({12, 11, 10}, [](double i, double j, double k) {
        return tests::bent(4 * i / 11, 3 * j / 10, 5 * k / 9);
    });
    const CellWorld world(
        tests::stepOfPlaces(grid, [](const auto& p) { return std::sin(p.x) + p.y * p.z; }),
        {"0:3", "1:2,4:9", "0.5:1.5"});
    const View view = tests::lookFrom({1.2, -2.5, 1}, {20, 16});
    const auto asPairs = [](const std::vector<CellOfLayer>& list) {
        std::vector<std::pair<std::uint32_t, int>> pairs;
        for (const CellOfLayer& of : list) pairs.emplace_back(of.cell, of.layer);
        return pairs;
    };
    auto ordered = asPairs(listed(world.scene, view));
    auto all = asPairs(cellsOf(world.scene, Channels::Over, 0));
    ASSERT_GT(all.size(), 1'000u);
    std::map<std::uint32_t, int> last;
    for (const auto& [cell, layer] : ordered) {
        EXPECT_LT(last.try_emplace(cell, -1).first->second, layer) << cell;
        last[cell] = layer;
    }
    std::ranges::sort(ordered);
    std::ranges::sort(all);
    EXPECT_EQ(ordered, all);
}

// More cells than one thread looks at alone, and more faces than are held at once.
TEST(FaceOrder, NotACellDependsOnThreadsAndSlices) {
    const auto isSame = [](const auto& a, const auto& b) {
        return std::ranges::equal(a, b, [](const CellOfLayer& one, const CellOfLayer& other) {
            return one.cell == other.cell && one.layer == other.layer;
        });
    };
    const CellWorld world = wholeOf(tests::gridOf(tests::atPoints(
        tests::bricks({96, 95, 84}, Cut::Hexahedra,
                      [](double i, double j, double k) { return flatFaced(i / 30, j, k / 9); }))));
    const View view = tests::lookFrom({0.3, -1.5, 1}, {20, 16});
    const auto once = listed(world.scene, view, 1);
    ASSERT_GT(6 * once.size(), std::size_t{1} << 22);
    EXPECT_TRUE(isSame(listed(world.scene, view, 3), once));
    EXPECT_TRUE(isSame(listed(world.scene, view, 2, 700'001), once));
}

// Where a ray enters a tetrahedron and where it leaves it.
std::pair<double, double> through(const std::array<glm::dvec3, 4>& at, const glm::dvec3& from,
                                  const glm::dvec3& along) {
    double first = 0, last = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 &a = at[(i + 1) % 4], &b = at[(i + 2) % 4], &c = at[(i + 3) % 4];
        glm::dvec3 inwards = glm::cross(b - a, c - a);
        if (glm::dot(inwards, at[i] - a) < 0) inwards = -inwards;
        const double speed = glm::dot(inwards, along), ahead = glm::dot(inwards, a - from) / speed;
        speed > 0 ? first = std::max(first, ahead) : last = std::min(last, ahead);
    }
    return {first, last};
}

// A prism over many sides, as one polyhedron of points in any order.
timeseries::UnstructuredGrid prismOver(std::uint32_t sides) {
    timeseries::UnstructuredGrid grid;
    const auto pointAt = [&](std::uint32_t k, std::uint32_t i) {
        return (k * sides + i % sides) * 7 % (2 * sides);
    };
    grid.points.resize(2 * std::size_t{sides});
    for (std::uint32_t k = 0; k < 2; ++k)
        for (std::uint32_t i = 0; i < sides; ++i) {
            const double a = 2 * std::numbers::pi * i / sides;
            grid.points[pointAt(k, i)] = {2 * std::cos(a), std::sin(a), 0.6 * k};
        }
    std::vector<std::vector<std::uint32_t>> faces(2);
    for (std::uint32_t i = 0; i < sides; ++i) {
        for (std::uint32_t k = 0; k < 2; ++k) faces[k].push_back(pointAt(k, i));
        faces.push_back({pointAt(0, i), pointAt(0, i + 1), pointAt(1, i + 1), pointAt(1, i)});
        grid.corners.insert(grid.corners.end(), {pointAt(0, i), pointAt(1, i)});
    }
    grid.types.push_back(timeseries::kPolyhedron);
    grid.ends.push_back(grid.corners.size());
    grid.faces.push_back(static_cast<std::uint32_t>(faces.size()));
    for (const auto& face : faces) {
        grid.faces.push_back(static_cast<std::uint32_t>(face.size()));
        grid.faces.insert(grid.faces.end(), face.begin(), face.end());
    }
    grid.faceEnds.push_back(grid.faces.size());
    return grid;
}

TEST(FaceOrder, IsThatOfACellsTetrahedraToo) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    const auto always = [](const auto&) { return true; };
    // Thin ones, whose middles say little.
    const auto thin = [](double i, double j, double k) {
        return glm::dvec3(0.1 * i + j, j * j, 0.7 * k + i);
    };
    std::size_t steps = 0, wrong = 0;
    std::vector<timeseries::UnstructuredGrid> grids;
    for (const Cut cut : {Cut::Hexahedra, Cut::Wedges, Cut::Polyhedra})
        grids.push_back(tests::bricks({3, 3, 3}, cut, thin));
    grids.push_back(prismOver(18));  // 48 tetrahedra
    for (const auto& grid : grids) {
        const CellWorld world = wholeOf(tests::gridOf(tests::atPoints(grid)));
        const SolidTets solids(world.placed, world.scene.cells->field(), world.scene.clip);
        for (int n = 0; n < 2000; ++n) {
            const glm::dvec3 eye = 1.5 * glm::dvec3(any(random), any(random), any(random));
            std::vector<std::array<glm::dvec3, 4>> tets;
            solids.forEachTet(
                static_cast<std::uint32_t>(n) % static_cast<std::uint32_t>(grid.types.size()), &eye,
                always, [&](const auto& tet) { tets.push_back(tet.at); });
            glm::dvec3 within(0);
            double all = 0;
            for (const auto& tet : tets)
                for (const glm::dvec3& corner : tet) {
                    const double share = 1.01 + any(random);
                    within += share * corner;
                    all += share;
                }
            const glm::dvec3 along = within / all - eye;
            double last = 0;
            for (const auto& at : tets) {
                const auto [from, to] = through(at, eye, along);
                if (to - from < 1e-9) continue;
                ++steps;
                if (from < last - 1e-9) ++wrong;
                last = to;
            }
        }
    }
    EXPECT_GT(steps, 5'000u);
    EXPECT_EQ(wrong, 0u);
}

}  // namespace
}  // namespace face_order
}  // namespace render
