#include "timeseries/readers/netcdf/vtkhdf_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "timeseries/grid/cell_types.h"
#include "timeseries/readers/face_tables.h"
#include "timeseries/readers/limits.h"
#include "timeseries/readers/netcdf/netcdf_rows.h"

namespace timeseries {
namespace {

constexpr std::uint8_t kVertices = 2, kPolyLine = 4, kPolygon = 7;

// As VtkHdfFaces.
constexpr std::array kFaceCounts{"VTKHDF/NumberOfFaces", "VTKHDF/NumberOfFaceConnectivityIds",
                                 "VTKHDF/NumberOfPolyhedronToFaceIds"};
constexpr std::array kFaceOffsets{"VTKHDF/Steps/FaceOffsetsOffsets",
                                  "VTKHDF/Steps/FaceConnectivityOffsets",
                                  "VTKHDF/Steps/PolyhedronToFaceIdOffsets"};

const NcVariable& expected(const NetcdfFile& file, const std::string& name) {
    const NcVariable* const found = file.header().find(name, "");
    if (!found || !found->type || found->dimensions.empty())
        file.fail("VTKHDF", fmt::format("expected the array {} of numbers", name));
    return *found;
}

std::uint64_t lengthOf(const NetcdfFile& file, const NcVariable& variable) {
    return file.header().dimension(variable, 0).length;
}

// Whole numbers, none below 0.
std::vector<std::uint64_t> countsOf(const NetcdfFile& file, const std::string& name) {
    std::vector<std::uint64_t> counts;
    for (const Number& number : file.numbers(expected(file, name))) {
        const double value = toDouble(number);
        if (!(value >= 0 && value < 0x1p62))
            file.fail("variable '" + name + "'",
                      fmt::format("expected 0 or more, found {}", value));
        counts.push_back(static_cast<std::uint64_t>(value));
    }
    return counts;
}

// Of the rows, as whole numbers; beyond all others what is none, modulo 2^64 where it is below 0.
std::vector<std::uint64_t> wholeNumbers(const NetcdfFile& file, const std::string& name,
                                        std::uint64_t first, std::uint64_t count) {
    const Values rows = rowsOf(file, expected(file, name), first, count, 1);
    std::vector<std::uint64_t> whole;
    whole.reserve(count);
    std::visit(
        [&](const auto& values) {
            for (const auto value : values)
                whole.push_back(std::abs(static_cast<double>(value)) < 0x1p62
                                    ? static_cast<std::uint64_t>(static_cast<std::int64_t>(value))
                                    : std::numeric_limits<std::uint64_t>::max());
        },
        rows);
    return whole;
}

// One more than so many from there on, the first 0 and the last `end`; none where they are not.
std::vector<std::uint64_t> offsetsFrom(const NetcdfFile& file, const std::string& name,
                                       std::uint64_t first, std::uint64_t count,
                                       std::uint64_t end) {
    const std::uint64_t length = lengthOf(file, expected(file, name));
    if (first > length || count >= length - first) return {};
    auto offsets = wholeNumbers(file, name, first, count + 1);
    if (offsets.front() != 0 || offsets.back() != end) return {};
    return offsets;
}

std::uint32_t pointOf(std::uint64_t point, std::uint64_t points, std::uint64_t first) {
    return point < points ? static_cast<std::uint32_t>(first + point) : kNoPoint;
}

}  // namespace

bool isVtkHdf(const NcHeader& header) {
    return std::ranges::any_of(header.variables, [](const NcVariable& variable) {
        return variable.name.starts_with("VTKHDF/");
    });
}

VtkHdfLayout::Sums VtkHdfLayout::sumsOf(const std::string& name) const {
    constexpr std::uint64_t kEnd = std::uint64_t{1} << 62;
    Sums sums{0};
    for (const std::uint64_t count : countsOf(file_, name))
        sums.push_back(std::min(sums.back() + count, kEnd));
    return sums;
}

VtkHdfLayout::VtkHdfLayout(const NetcdfFile& file) : file_(file) {
    const NcHeader& header = file.header();
    points_ = sumsOf("VTKHDF/NumberOfPoints");
    const auto add = [&](const std::string& group, std::uint8_t shape) {
        topologies_.push_back({group, shape, sumsOf(group + "NumberOfCells"),
                               sumsOf(group + "NumberOfConnectivityIds")});
    };
    if (header.find("VTKHDF/Types", "")) {
        add("VTKHDF/", 0);
    } else {
        // Told, not drawn.
        add("VTKHDF/Vertices/", kVertices);
        add("VTKHDF/Lines/", kPolyLine);
        add("VTKHDF/Polygons/", kPolygon);
        add("VTKHDF/Strips/", kTriangleStrip);
    }
    for (const Topology& each : topologies_)
        if (each.cells.size() != points_.size() || each.ids.size() != points_.size())
            file.fail(each.group, fmt::format("expected numbers of {} parts, found {} and {}",
                                              parts(), each.cells.size() - 1, each.ids.size() - 1));
    if (!isPolygons() && header.find("VTKHDF/FaceConnectivity", ""))
        for (std::size_t k = 0; k < faces_.size(); ++k) {
            faces_[k] = sumsOf(kFaceCounts[k]);
            if (faces_[k].size() != points_.size())
                file.fail(kFaceCounts[k], fmt::format("expected numbers of {} parts, found {}",
                                                      parts(), faces_[k].size() - 1));
        }
    readSteps();
    if (hasPolyhedra()) readFaceOffsets();
}

// Where a step does not say, its parts' tables stand behind those of the parts before.
void VtkHdfLayout::readFaceOffsets() {
    for (std::size_t k = 0; k < faces_.size(); ++k) {
        for (VtkHdfStep& step : steps_) step.faces[k] = faces_[k][step.firstPart];
        if (!file_.header().find(kFaceOffsets[k], "")) continue;
        const auto told = countsOf(file_, kFaceOffsets[k]);
        for (std::size_t s = 0; s < std::min(told.size(), steps_.size()); ++s)
            steps_[s].faces[k] = told[s];
    }
}

void VtkHdfLayout::readSteps() {
    if (!file_.header().find("VTKHDF/Steps/Values", "")) {
        steps_.push_back({.firstPart = 0, .parts = parts()});
        const NcVariable* const time = file_.header().find("VTKHDF/FieldData/TimeValue", "");
        if (time && time->type && time->dimensions.size() == 1 && lengthOf(file_, *time) == 1)
            times_ = {toDouble(file_.numbers(*time)[0])};
    } else {
        for (const Number& number : file_.numbers(expected(file_, "VTKHDF/Steps/Values")))
            times_.push_back(toDouble(number));
        const auto of = [&](const char* name, std::size_t columns) {
            auto all = countsOf(file_, fmt::format("VTKHDF/Steps/{}", name));
            if (all.size() != times_.size() * columns)
                file_.fail(fmt::format("VTKHDF/Steps/{}", name),
                           fmt::format("expected numbers of {} steps, found {}", times_.size(),
                                       all.size()));
            return all;
        };
        const std::size_t kinds = topologies_.size();
        const auto first = of("PartOffsets", 1),
                   parts = file_.header().find("VTKHDF/Steps/NumberOfParts", "")
                               ? of("NumberOfParts", 1)
                               : numbersOfParts(first),
                   points = of("PointOffsets", 1), cells = of("CellOffsets", kinds),
                   ids = of("ConnectivityIdOffsets", kinds);
        for (std::size_t s = 0; s < times_.size(); ++s) {
            VtkHdfStep step{first[s], parts[s], points[s], {}, {}};
            for (std::size_t k = 0; k < kinds; ++k) {
                step.cells[k] = cells[s * kinds + k];
                step.ids[k] = ids[s * kinds + k];
            }
            steps_.push_back(step);
        }
    }
    if (steps_.empty()) file_.fail("VTKHDF/Steps", "expected a step, found none");
    for (const double time : times_)
        if (!std::isfinite(time))
            file_.fail("VTKHDF/Steps/Values", "expected times that are finite");
    for (const VtkHdfStep& step : steps_)
        if (step.firstPart > parts() || step.parts > parts() - step.firstPart)
            file_.fail("VTKHDF/Steps",
                       fmt::format("expected {} parts from part {} on, found {} in all", step.parts,
                                   step.firstPart, points_.size()));
        else if (pointsOf(step) >= kMaxPoints || cellsOf(step) >= kMaxPoints)
            file_.fail("VTKHDF", "expected fewer than 2^32 points and cells, found more");
}

// What few writers leave out.
std::vector<std::uint64_t> VtkHdfLayout::numbersOfParts(
    const std::vector<std::uint64_t>& first) const {
    const bool same = std::ranges::all_of(first, [](std::uint64_t part) { return part == 0; });
    if (!same && parts() % first.size() != 0)
        file_.fail("VTKHDF/Steps", "expected NumberOfParts of each step");
    return std::vector<std::uint64_t>(first.size(), same ? parts() : parts() / first.size());
}

std::uint64_t VtkHdfLayout::pointsOf(const VtkHdfStep& step) const {
    return points_[step.firstPart + step.parts] - points_[step.firstPart];
}

std::uint64_t VtkHdfLayout::cellsOf(const VtkHdfStep& step) const {
    std::uint64_t sum = 0;
    for (const Topology& each : topologies_)
        sum = std::min(sum + each.cells[step.firstPart + step.parts] - each.cells[step.firstPart],
                       kMaxPoints);
    return sum;
}

std::uint64_t VtkHdfLayout::firstValue(std::size_t step, bool atPoints,
                                       const std::string& array) const {
    const std::string name =
        fmt::format("VTKHDF/Steps/{}DataOffsets/{}", atPoints ? "Point" : "Cell", array);
    if (file_.header().find(name, "")) {
        const auto offsets = countsOf(file_, name);
        if (step >= offsets.size())
            file_.fail("variable '" + name + "'",
                       fmt::format("expected numbers of {} steps", steps_.size()));
        return offsets[step];
    }
    if (atPoints) return steps_[step].points;
    std::uint64_t sum = 0;
    for (const std::uint64_t cells : steps_[step].cells) sum += cells;
    return sum;
}

// One more than cells stand in Offsets for each part, the first 0. How many parts are before, VTK
// takes from their number, for unstructured grids; for polygons, whose cells may be written once
// for many steps, it counts the parts whose cells are the step's offset. The other stands in where
// one does not end where the part's corners do.
void VtkHdfLayout::addCells(const Topology& topology, const VtkHdfStep& step, std::size_t which,
                            std::uint64_t part, std::uint64_t points, std::uint64_t firstPoint,
                            UnstructuredGrid& grid) const {
    const std::uint64_t number = step.firstPart + part;
    const auto countOf = [&](const Sums& sums) { return sums[number + 1] - sums[number]; };
    const std::uint64_t cells = countOf(topology.cells), ids = countOf(topology.ids);
    if (cells == 0) return;
    const auto within = [&](const Sums& sums) { return sums[number] - sums[step.firstPart]; };
    const std::uint64_t before = step.cells[which] + within(topology.cells),
                        corner = step.ids[which] + within(topology.ids);
    const std::string name = topology.group + "Offsets";
    const auto earlier = static_cast<std::uint64_t>(
        std::ranges::lower_bound(topology.cells, step.cells[which]) - topology.cells.begin());
    std::array<std::uint64_t, 2> extras{number, earlier + part};
    if (isPolygons()) std::swap(extras[0], extras[1]);
    std::vector<std::uint64_t> offsets;
    std::uint64_t at = 0;
    for (const std::uint64_t extra : extras) {
        at = before + extra;
        offsets = offsetsFrom(file_, name, at, cells, ids);
        if (!offsets.empty()) break;
    }
    if (offsets.empty())
        file_.fail(
            "variable '" + name + "'",
            fmt::format("expected {} cells of part {}, from 0 to {} corners", cells, number, ids));
    const std::uint64_t begin = grid.corners.size();
    if (begin + ids >= kMaxPoints) file_.fail(name, "expected fewer than 2^32 corners, found more");
    for (std::uint64_t i = 1; i <= cells; ++i) grid.ends.push_back(begin + offsets[i]);
    for (const std::uint64_t point :
         wholeNumbers(file_, topology.group + "Connectivity", corner, ids)) {
        if (point >= points)
            grid.keepFirst({grid.corners.size(), static_cast<std::int64_t>(point), points});
        grid.corners.push_back(pointOf(point, points, firstPoint));
    }
    if (topology.group != "VTKHDF/") {
        grid.types.resize(grid.types.size() + cells, topology.shape);
        return;
    }
    for (const std::uint64_t type : wholeNumbers(file_, "VTKHDF/Types", before, cells))
        grid.types.push_back(type > 255 ? 0 : static_cast<std::uint8_t>(type));
    if (hasPolyhedra()) addFaces(step, {number, cells, at, at - before, points, firstPoint}, grid);
}

// One more than faces, and than cells, stand in the tables of ends for each part, the first 0.
// Where the tables of the part begin, the numbers of the parts before it tell; VTK's own writer is
// known to leave parts out of what steps say, which stands in where the tables do not end there.
void VtkHdfLayout::addFaces(const VtkHdfStep& step, const Part& part,
                            UnstructuredGrid& grid) const {
    VtkHdfFaces counts, begin, told = step.faces;
    for (std::size_t k = 0; k < counts.size(); ++k) {
        begin[k] = faces_[k][part.number];
        counts[k] = faces_[k][part.number + 1] - begin[k];
        told[k] += begin[k] - faces_[k][step.firstPart];
    }
    const std::string name = "VTKHDF/FaceOffsets", cellName = "VTKHDF/PolyhedronOffsets";
    FaceTables tables;
    tables.ends = offsetsFrom(file_, name, begin[0] + part.number, counts[0], counts[1]);
    if (tables.ends.empty()) {
        begin = told;
        tables.ends = offsetsFrom(file_, name, begin[0] + part.before, counts[0], counts[1]);
    }
    tables.cellEnds = offsetsFrom(file_, cellName, part.endsAt, part.cells, counts[2]);
    if (tables.ends.empty() || tables.cellEnds.empty())
        file_.fail(
            "variable '" + (tables.ends.empty() ? name : cellName) + "'",
            fmt::format("expected {} faces of part {}, from 0 to {} corners, {} in its cells",
                        counts[0], part.number, counts[1], counts[2]));
    tables.ends.erase(tables.ends.begin());
    tables.cellEnds.erase(tables.cellEnds.begin());
    tables.faces = wholeNumbers(file_, "VTKHDF/PolyhedronToFaces", begin[2], counts[2]);
    for (const std::uint64_t point :
         wholeNumbers(file_, "VTKHDF/FaceConnectivity", begin[1], counts[1]))
        tables.corners.push_back(pointOf(point, part.points, part.firstPoint));
    timeseries::addFaces(tables, grid);
}

UnstructuredGrid VtkHdfLayout::gridOf(const VtkHdfStep& step) const {
    UnstructuredGrid grid;
    grid.inParts = step.parts > 1;
    const std::uint64_t points = pointsOf(step);
    const auto places = placesOf(file_, expected(file_, "VTKHDF/Points"), step.points, points);
    grid.points.assign(places.begin(), places.end());
    std::uint64_t firstPoint = 0;
    for (std::uint64_t part = 0; part < step.parts; ++part) {
        const std::uint64_t count =
            points_[step.firstPart + part + 1] - points_[step.firstPart + part];
        for (std::size_t k = 0; k < topologies_.size(); ++k)
            addCells(topologies_[k], step, k, part, count, firstPoint, grid);
        firstPoint += count;
    }
    if (const std::string flaw = flawOf(grid); !flaw.empty())
        file_.fail("VTKHDF", "expected cells of points that there are, found that " + flaw);
    return grid;
}

}  // namespace timeseries
