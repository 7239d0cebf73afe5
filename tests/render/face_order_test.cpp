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
#include "tests/support/unstructured.h"

namespace render {
namespace face_order {
namespace {

using tests::CellWorld;
using tests::Cut;
using timeseries::Grid;

// Thin steps beside thick ones, all leaning: every face is flat.
glm::dvec3 flatFaced(double i, double j, double k) {
    const glm::dmat3 leaning{1, 0.2, 0.6, -0.7, 1.3, 0.1, 0.9, 0.5, 0.8};
    return leaning * glm::dvec3(std::pow(1.6, i), j * j / 12, 0.3 * std::pow(k, 2.5));
}

std::shared_ptr<const Grid> solids(Cut cut, const auto& place) {
    return tests::gridOf(tests::atPoints(tests::bricks({6, 6, 5}, cut, place)));
}

std::vector<CellOfLayer> listed(const Scene& scene, const View& view, unsigned threads = 2,
                                std::uint64_t slice = tests::kAllCells) {
    const CellRank rank(scene, view);
    CellList list(scene, Channels::Over, 0, &rank, threads);
    while (!list.done()) list.goOn(slice);
    return {list.cells().begin(), list.cells().end()};
}

constexpr double kTouched = 1e-4;  // of a ray along an edge; more than GapOrder takes for one place

struct Passed {
    std::size_t inOrder = 0, wrong = 0;

    Passed& operator+=(const Passed& more) {
        inOrder += more.inOrder;
        wrong += more.wrong;
        return *this;
    }
};
// Of neighbours along the rays through a picture's pixels.
Passed passed(const CellWorld& world, const View& view) {
    const auto list = listed(world.scene, view);
    std::vector<std::size_t> places(world.scene.placed.isMesh() ? 100'000 : 0);
    for (std::size_t at = 0; at < list.size(); ++at) places.at(list[at].cell) = at;
    std::vector<glm::ivec2> pixels;
    for (int y = 0; y < view.size.y; ++y)
        for (int x = 0; x < view.size.x; ++x) pixels.emplace_back(x, y);
    std::vector<std::vector<PartInLayer>> rays(pixels.size());
    addPartsOnRays(world.scene, world.scene.cells->field(), view, pixels, 2, rays);
    Passed sum;
    for (auto& parts : rays) {
        std::erase_if(parts, [](const auto& p) { return p.part.to - p.part.from < kTouched; });
        orderAlongRay(parts);
        for (std::size_t i = 1; i < parts.size(); ++i)
            ++(places[parts[i - 1].cell] <= places[parts[i].cell] ? sum.inOrder : sum.wrong);
    }
    return sum;
}

CellWorld wholeOf(const std::shared_ptr<const Grid>& grid) {
    return {tests::stepOfPlaces(grid, [](const auto& p) { return p.x + 0.3 * p.y; }), {"min:max"}};
}

// From far away, beside and inside.
std::vector<View> views() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> side(-1, 1);
    std::vector<View> all;
    for (int i = 0; i < 9; ++i) {
        const double away = std::array{0.3, 1.2, 4.0}[static_cast<std::size_t>(i) % 3];
        all.push_back(
            tests::lookFrom(away * glm::dvec3(side(random), side(random), side(random)), {16, 12}));
    }
    return all;
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

void addBox(timeseries::UnstructuredGrid& grid, const glm::dvec3& lo, const glm::dvec3& hi) {
    const auto first = static_cast<std::uint32_t>(grid.points.size());
    for (unsigned c = 0; c < 8; ++c)
        grid.points.push_back({c & 1 ? hi.x : lo.x, c & 2 ? hi.y : lo.y, c & 4 ? hi.z : lo.z});
    tests::addCell(
        grid, 11,
        {first, first + 1, first + 2, first + 3, first + 4, first + 5, first + 6, first + 7});
}

// Parts that no face joins: boxes on a plate, sheets of cells of several sizes, and slats.
std::vector<std::shared_ptr<const Grid>> parts() {
    timeseries::UnstructuredGrid boxes, sheets, slats;
    addBox(boxes, {0, 0, 0}, {10, 10, 1});
    for (int i = 0; i < 25; ++i) {
        const glm::dvec3 at(2 * (i % 5) + 0.7, 2 * (i / 5) + 0.7, 1);
        addBox(boxes, at, at + glm::dvec3(0.6, 0.6, 0.6));
    }
    for (int k = 0; k < 3; ++k) {
        const int cells = std::array{1, 7, 3}[static_cast<std::size_t>(k)];
        const double side = 6.0 / cells;
        for (int i = 0; i < cells * cells; ++i) {
            const glm::dvec3 at(side * (i % cells), side * (i / cells), 0.3 * k);
            addBox(sheets, at, at + glm::dvec3(side, side, 0.1));
        }
    }
    for (int i = 0; i < 8; ++i) addBox(slats, {i, -0.5 * i, 0}, {i + 0.2, 9 - 2 * (i % 3), 2});
    return {tests::gridOf(tests::atPoints(boxes)), tests::gridOf(tests::atPoints(sheets)),
            tests::gridOf(tests::atPoints(slats))};
}

// All but a few of thousands, where a ray passes where two parts touch.
TEST(FaceOrder, IsOfPartsThatNoFacesJoinAsRaysMeetThem) {
    Passed byRays, byMiddles;
    for (const auto& grid : parts()) {
        CellWorld world = wholeOf(grid);
        for (const View& view : views()) {
            const auto list = listed(world.scene, view);
            for (const auto& other :
                 {listed(world.scene, view, 1), listed(world.scene, view, 3, 5)})
                EXPECT_TRUE(
                    std::ranges::equal(list, other, {}, &CellOfLayer::cell, &CellOfLayer::cell));
            for (const bool isByMiddles : {false, true}) {
                world.scene.byMiddles = isByMiddles;
                (isByMiddles ? byMiddles : byRays) += passed(world, view);
            }
            world.scene.byMiddles = false;
        }
    }
    EXPECT_GT(byMiddles.wrong, 100u) << "this asks for nothing";
    EXPECT_LE(byRays.wrong, 2u);
    EXPECT_GT(byRays.inOrder, 2'000u);
}

// As an orthographic picture has it, which is a perspective from very far.
TEST(FaceOrder, OfPartsIsTheSameFromVeryFar) {
    Passed byRays;
    for (const auto& grid : parts()) {
        const CellWorld world = wholeOf(grid);
        for (View view : views()) {
            const glm::dvec3 eye = pixelRays(view).eye;
            constexpr double kFar = 1e4;
            view = tests::lookFrom(kFar * glm::normalize(eye), {16, 12});
            for (int c = 0; c < 2; ++c) view.clipFromView[c][c] *= kFar / 3;
            byRays += passed(world, view);
        }
    }
    EXPECT_LE(byRays.wrong, 4u);
    EXPECT_GT(byRays.inOrder, 1'000u);
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
