// Coastlines and lines of longitude and latitude, beside data on a map.
#include "render/annotate/map_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/annotate/axes.h"
#include "tests/support/flat_text.h"
#include "tests/support/measured_axis.h"
#include "tests/support/scenes.h"

namespace render {
namespace {

using tests::measuredAxis;
using timeseries::Axis;
using timeseries::Grid;

Grid mapOf(const Axis& x, const Axis& y, const Axis& z) { return Grid({x, y, z}); }
Axis east(double lo, double hi) { return measuredAxis("lon", "degrees_east", lo, hi, 90); }
Axis north(double lo, double hi) { return measuredAxis("lat", "degrees_north", lo, hi, 45); }
Axis depth() { return measuredAxis("depth", "m", 0, 1000, 9, true); }

// How far a place is from the nearest of the lines, in degrees.
double distanceTo(const std::vector<MapLine>& lines, const glm::dvec2& place) {
    double nearest = 1e9;
    for (const MapLine& line : lines)
        for (std::size_t i = 1; i < line.size(); ++i) {
            const glm::dvec2 way = line[i] - line[i - 1];
            const double along =
                std::clamp(glm::dot(place - line[i - 1], way) / glm::dot(way, way), 0.0, 1.0);
            nearest = std::min(nearest, glm::distance(place, line[i - 1] + along * way));
        }
    return nearest;
}

// Capes whose places any atlas tells, to a degree; and what is far from every coast.
TEST(Coastlines, LieWhereTheCoastsAre) {
    const auto& coasts = coastlines();
    EXPECT_GT(coasts.size(), 100u);
    for (const glm::dvec2& cape :
         {glm::dvec2(18.5, -34.4) /* of Good Hope */, glm::dvec2(-17.5, 14.7) /* Verde */,
          glm::dvec2(-68.3, -55.6) /* Horn, or nearly */, glm::dvec2(142.5, -10.7) /* York */,
          glm::dvec2(77.5, 8.1) /* Comorin */, glm::dvec2(-5.7, 50.1) /* Land's End */,
          glm::dvec2(25.8, 71.1) /* the North Cape */})
        EXPECT_LT(distanceTo(coasts, cape), 1) << cape.x << ", " << cape.y;
    for (const glm::dvec2& far : {glm::dvec2(-123.4, -48.9) /* Point Nemo */,
                                  glm::dvec2(86.7, 46.3) /* the pole of inaccessibility */,
                                  glm::dvec2(-30, 30), glm::dvec2(20, 20)})
        EXPECT_GT(distanceTo(coasts, far), 8) << far.x << ", " << far.y;
    for (const MapLine& line : coasts) {
        ASSERT_GE(line.size(), 2u);
        for (const glm::dvec2& at : line)
            ASSERT_TRUE(std::abs(at.x) <= 180 && std::abs(at.y) <= 90) << at.x << ", " << at.y;
    }
}

TEST(MapPlane, IsWhereTheAxesAreLongitudeAndLatitude) {
    const Axis x = east(0, 359), y = north(-89, 89), z = depth();
    EXPECT_TRUE(mapPlaneOf(mapOf(x, y, z)));
    const auto with = [&](const char* xUnits, const char* yUnits, const char* xName = "lon",
                          const char* yName = "lat") {
        Axis a = x, b = y;
        a.units = xUnits, b.units = yUnits, a.name = xName, b.name = yName;
        return mapPlaneOf(mapOf(a, b, z)).has_value();
    };
    for (const char* units : {"degree_east", "degrees_E", "degreeE", "degrees"})
        EXPECT_TRUE(with(units, "degrees_north")) << units;
    EXPECT_TRUE(with("degrees", "degrees", "longitude", "Latitude"));
    EXPECT_FALSE(with("degrees", "degrees", "grid_longitude", "grid_latitude")) << "rotated";
    EXPECT_FALSE(with("degrees_north", "degrees_east")) << "the other way round";
    EXPECT_FALSE(with("m", "m"));
    EXPECT_FALSE(with("index", "index"));
    EXPECT_FALSE(mapPlaneOf(mapOf(east(0, 4000), y, z))) << "no longitudes";
    EXPECT_FALSE(mapPlaneOf(Grid({x, y, z}, {tests::rotation(2)})));
}

// Depths below the surface, air above it.
TEST(MapPlane, IsTheSurfaceOfTheEarth) {
    const auto planeOf = [](const Axis& z) {
        return *mapPlaneOf(mapOf(east(0, 9), north(0, 9), z));
    };
    const auto expect = [&](const Axis& z, double height, int side) {
        EXPECT_EQ(planeOf(z).height, height) << z.units;
        EXPECT_EQ(planeOf(z).side, side) << z.units;
        // It is that side of the box in the world.
        const Grid grid = mapOf(east(0, 9), north(0, 9), z);
        const PlacedPoints placed(grid);
        EXPECT_NEAR(placed.axesFromGrid({0, 0, height}).z, side * placed.boxHalf().z, 1e-12);
    };
    expect(measuredAxis("depth", "m", 5, 4000, 9, true), 5, 1);
    expect(measuredAxis("pressure", "dbar", 0, 2000, 9, true), 0, 1);
    expect(measuredAxis("lev", "hPa", 10, 1000, 9, true), 1000, -1);
    expect(measuredAxis("lev", "Pa", 100000, 1000, 9, true), 100000, -1);
    expect(measuredAxis("lev", "hybrid_sigma_pressure", 4, 993, 9, true), 993, -1);
    expect(measuredAxis("lev", "level", 1, 60, 9, true), 60, -1);
    expect(measuredAxis("ocean_sigma", "1", 0, 1, 9, true), 0, 1);
    expect(measuredAxis("height", "m", 10, 20000, 9), 10, -1);
    expect(measuredAxis("level", "index", 0, 8, 9), 0, -1);
}

// Whatever turn the data's longitudes count: a place is on a line when it is on one of the world's.
TEST(MapLines, AreThoseOfTheWorldWithinTheBox) {
    for (const auto& [lo, hi] : std::vector<std::pair<double, double>>{
             {-180, 180}, {0, 360}, {20.5, 378.5}, {-10, 30}, {300, 420}, {-300, -200}}) {
        const MapPlane plane{{lo, -40}, {hi, 70}, 0, 1};
        const auto lines = linesWithin(plane, coastlines());
        ASSERT_FALSE(lines.empty());
        double length = 0, expected = 0;
        for (const MapLine& line : lines) {
            ASSERT_GE(line.size(), 2u);
            for (std::size_t i = 0; i < line.size(); ++i) {
                EXPECT_TRUE(line[i].x >= lo - 1e-9 && line[i].x <= hi + 1e-9 &&
                            line[i].y >= -40 - 1e-9 && line[i].y <= 70 + 1e-9);
                if (i > 0) length += glm::distance(line[i - 1], line[i]);
            }
        }
        // By taking small steps along all of them.
        constexpr int kSteps = 64;
        for (const MapLine& line : coastlines())
            for (std::size_t i = 1; i < line.size(); ++i)
                for (int step = 0; step < kSteps; ++step) {
                    const glm::dvec2 at = glm::mix(line[i - 1], line[i], (step + 0.5) / kSteps);
                    if (at.y < -40 || at.y > 70) continue;
                    for (int turn = -2; turn <= 2; ++turn)
                        if (const double x = at.x + 360 * turn; x >= lo && x <= hi)
                            expected += glm::distance(line[i - 1], line[i]) / kSteps;
                }
        EXPECT_NEAR(length, expected, 1e-3 * expected) << lo << " to " << hi;
    }
}

TEST(MapLines, AGraticuleHasRoundDegrees) {
    for (const auto& [lo, hi, step] : std::vector<std::tuple<glm::dvec2, glm::dvec2, double>>{
             {{0, -90}, {360, 90}, 30},
             {{-25, 45}, {31, 75}, 5},
             {{10.05, 50.05}, {10.9, 50.6}, 0.1}}) {
        const auto lines = graticuleOf({lo, hi, 0, 1});
        std::size_t count = 0;
        for (int c = 0; c < 2; ++c)
            for (double at = -720; at <= 720; at += step)
                count += at >= lo[c] - 1e-9 && at <= hi[c] + 1e-9;
        EXPECT_EQ(lines.size(), count) << step;
        for (const MapLine& line : lines) {
            ASSERT_EQ(line.size(), 2u);
            const int c = line[0].x == line[1].x ? 0 : 1;
            EXPECT_NEAR(std::remainder(line[0][c], step), 0, 1e-9);
            EXPECT_EQ(line[0][1 - c], lo[1 - c]);
            EXPECT_EQ(line[1][1 - c], hi[1 - c]);
        }
    }
}

// Behind the volume where the eye sees it before the surface, else over it; and where its places
// are seen.
TEST(MapLines, AreDrawnOnTheSurface) {
    const Grid grid = mapOf(east(-180, 178), north(-88, 88), depth());
    const PlacedPoints placed(grid);
    const glm::ivec2 size(900, 700);
    for (const double z : {2.0, 0.05, -2.0}) {
        const glm::dvec3 eye(0.3, -2.5, z);
        const View view = tests::lookFrom(eye, size, 0.4);
        const AxesMeshes meshes = axesMeshes(grid, placed, view, {eye}, tests::fontFor(size));
        const FlatMesh &drawn = z > 1 ? meshes.mapBefore : meshes.mapBehind,
                       &other = z > 1 ? meshes.mapBehind : meshes.mapBefore;
        EXPECT_TRUE(other.triangles().empty());
        ASSERT_FALSE(drawn.triangles().empty());
        std::vector<MapLine> all = coastlines();
        for (const MapLine& line : graticuleOf(*mapPlaneOf(grid))) all.push_back(line);
        const glm::dmat4 worldFromClip = glm::inverse(view.clipFromView * view.viewFromWorld);
        const auto& v = drawn.triangles();
        for (std::size_t i = 0; i < v.size(); i += 6 * 41) {
            // The line's middle, from the picture back to the map.
            const glm::dvec3 at = 0.5 * (glm::dvec3(v[i].at) + glm::dvec3(v[i + 5].at));
            const glm::dvec4 clip(2 * at.x / size.x - 1, 1 - 2 * at.y / size.y, at.z, 1);
            const glm::dvec4 world = worldFromClip * clip;
            const glm::dvec3 place = placed.gridFromAxes(glm::dvec3(world) / world.w);
            EXPECT_LT(std::abs(place.z), 2) << "of 1000 m";
            EXPECT_LT(distanceTo(all, glm::dvec2(place)), 0.5) << place.x << ", " << place.y;
        }
    }
    // Of a sheet over it.
    const Grid sheet = mapOf(east(-180, 178), north(-88, 88), measuredAxis("z", "m", 0, 0, 1));
    const glm::dvec3 eye(0.3, -2.5, 2);
    EXPECT_FALSE(axesMeshes(sheet, PlacedPoints(sheet), tests::lookFrom(eye, size, 0.4), {eye},
                            tests::fontFor(size))
                     .mapBefore.triangles()
                     .empty());
}

}  // namespace
}  // namespace render
