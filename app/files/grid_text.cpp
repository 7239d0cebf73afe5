#include "app/files/grid_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "app/files/dataset.h"
#include "timeseries/grid/cell_types.h"

namespace app {
namespace {

using timeseries::Axis;
using timeseries::Grid;
using timeseries::Mesh;
using timeseries::MeshAbout;
using Points = MeshAbout::Points;

// "5,000 hexahedra, 200 wedges".
std::string cellsText(const MeshAbout& about) {
    constexpr std::size_t kMostTold = 8;
    std::string text;
    for (std::size_t i = 0; i < std::min(about.cells.size(), kMostTold); ++i) {
        const auto& [type, count] = about.cells[i];
        text += fmt::format("{}{} {}", i == 0 ? "" : ", ", withCommas(count),
                            timeseries::cellName(type, count));
    }
    const std::size_t others = about.cells.size() - std::min(about.cells.size(), kMostTold);
    return others == 0 ? text : fmt::format("{} and {} other kinds", text, others);
}

// Of points that lie one by one; "" where nothing is known of them.
std::string pointsText(const Mesh& mesh) {
    const MeshAbout& about = mesh.about();
    if (about.points == Points::Particles) return ", each as large as the file says";
    if (about.points == Points::Edges) return ", one an edge";
    if (about.points != Points::Cells && about.points != Points::Corners) return "";
    const bool atCells = about.points == Points::Cells;
    std::string what = atCells ? "one a cell" : "corners of cells";
    if (about.levels > 0)
        what = fmt::format("{}leaves of {} level{}", atCells ? "" : "corners of ", about.levels,
                           about.levels == 1 ? "" : "s");
    if (mesh.size()[2] > 1) what += fmt::format(" on each of {} levels", mesh.size()[2]);
    return about.cells.empty() ? ", " + what : fmt::format(", {}: {}", what, cellsText(about));
}

}  // namespace

std::string gridKind(const Grid& grid) {
    if (const Mesh* mesh = grid.mesh().get()) {
        if (mesh->hasNeighbours()) return "curvilinear";
        if (mesh->about().levels > 0) return "adaptive";
        const Points points = mesh->about().points;
        const bool apart = points == Points::Scattered || points == Points::Particles;
        return apart ? "scattered" : "unstructured";
    }
    for (const Axis& axis : grid.axes())
        if (axis.units == "index") return "index space";
    const std::string spacing = grid.uniform() ? "uniform" : "rectilinear";
    if (grid.frame().aligned()) return spacing;
    constexpr double kRounding = 1e-4;  // directions written in few digits
    const glm::dmat3& d = grid.frame().directions;
    bool upright = true;
    for (int a = 0; a < 3; ++a)
        upright = upright && std::abs(glm::dot(d[a], d[(a + 1) % 3])) < kRounding;
    return spacing + (upright ? ", rotated" : ", sheared");
}

std::string gridText(const Grid& grid) {
    const Mesh* mesh = grid.mesh().get();
    const std::string kind = gridKind(grid), points = withCommas(grid.count()) + " points";
    if (mesh && !mesh->hasNeighbours())
        return fmt::format("{}, {}{}", kind, points, pointsText(*mesh));
    const auto n = grid.size();
    return fmt::format("{}, {} x {} x {} = {}", kind, n[0], n[1], n[2], points);
}

std::string earthText(const Grid& grid) {
    const timeseries::EarthPlaces* const earth = grid.earth().get();
    if (!earth) return "";
    return fmt::format("longitudes {:.6g} to {:.6g}, latitudes {:.6g} to {:.6g} degrees",
                       earth->lo().x, earth->hi().x, earth->lo().y, earth->hi().y);
}

nlohmann::ordered_json gridJson(const Grid& grid) {
    nlohmann::ordered_json out{{"kind", gridKind(grid)}, {"points", grid.count()}};
    if (const timeseries::EarthPlaces* const earth = grid.earth().get())
        out["earth"] = {{"longitudes", {earth->lo().x, earth->hi().x}},
                        {"latitudes", {earth->lo().y, earth->hi().y}}};
    const Mesh* mesh = grid.mesh().get();
    if (!mesh || mesh->hasNeighbours()) return out;
    const MeshAbout& about = mesh->about();
    if (about.points == Points::Cells || about.points == Points::Corners)
        out["at"] = about.points == Points::Cells ? "cells" : "corners";
    if (about.points == Points::Edges) out["at"] = "edges";
    for (const auto& [type, count] : about.cells)
        out["cells"].push_back({{"kind", timeseries::cellName(type, 1)}, {"count", count}});
    if (about.levels > 0) out["levels"] = about.levels;
    return out;
}

std::string stepGridsText(const timeseries::StepGrids& grids) {
    using Are = timeseries::StepGrids::Are;
    if (grids.are == Are::One) return "";
    if (grids.are == Are::Moved) return "its places move, what joins them stays";
    const std::string others = "of the first step; others have their own";
    if (grids.most == 0) return others;
    if (grids.least == grids.most) return others + ", of as many points";
    return fmt::format("{}, of {} to {} points", others, withCommas(grids.least),
                       withCommas(grids.most));
}

nlohmann::ordered_json stepGridsJson(const timeseries::StepGrids& grids) {
    using Are = timeseries::StepGrids::Are;
    if (grids.are != Are::Own) return {{"steps", grids.are == Are::Moved ? "moved" : "one"}};
    nlohmann::ordered_json out{{"steps", "own"}};
    if (grids.most > 0) {
        out["leastPoints"] = grids.least;
        out["mostPoints"] = grids.most;
    }
    return out;
}

}  // namespace app
