// What a VTKHDF file of an unstructured grid or of polygons tells of each step but its values:
// Kitware, "VTK File Formats", "VTKHDF". HDF5 is read through netCDF.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "timeseries/grid/unstructured.h"
#include "timeseries/readers/netcdf/netcdf_file.h"

namespace timeseries {

bool isVtkHdf(const NcHeader& header);

// Of polyhedra, or where their tables begin: faces, their corners, the faces of cells.
using VtkHdfFaces = std::array<std::uint64_t, 3>;

// Where a step's parts stand in the file's arrays, in which those of all steps follow each other.
struct VtkHdfStep {
    std::uint64_t firstPart = 0, parts = 0;
    std::uint64_t points = 0;                     // the first
    std::array<std::uint64_t, 4> cells{}, ids{};  // of each topology: of Offsets and Connectivity
    VtkHdfFaces faces = {};
    friend bool operator==(const VtkHdfStep&, const VtkHdfStep&) = default;
};

class VtkHdfLayout {
 public:
    // Throws FileError, also for VTKHDF of other kinds. `file` must outlive it.
    explicit VtkHdfLayout(const NetcdfFile& file);

    bool isPolygons() const { return topologies_.size() > 1; }
    const std::vector<VtkHdfStep>& steps() const { return steps_; }
    const std::vector<double>& times() const { return times_; }  // [steps]; none: no time
    std::uint64_t pointsOf(const VtkHdfStep& step) const;
    std::uint64_t cellsOf(const VtkHdfStep& step) const;
    // Where the values of an array at points or cells begin.
    std::uint64_t firstValue(std::size_t step, bool atPoints, const std::string& array) const;
    // Throws FileError when its cells name points that are not there.
    UnstructuredGrid gridOf(const VtkHdfStep& step) const;

 private:
    // How many the parts before each have, and at the end all of them.
    using Sums = std::vector<std::uint64_t>;
    struct Topology {
        std::string group;   // "VTKHDF/", "VTKHDF/Lines/"
        std::uint8_t shape;  // of all its cells, as VTK numbers them; 0: they have Types
        Sums cells, ids;
    };
    // A part's cells; where their ends begin, and how many parts before have one end more than
    // cells there; the first of its points in the grid.
    struct Part {
        std::uint64_t number, cells, endsAt, before, points, firstPoint;
    };
    std::size_t parts() const { return points_.size() - 1; }
    bool hasPolyhedra() const { return !faces_[0].empty(); }
    Sums sumsOf(const std::string& name) const;
    std::vector<std::uint64_t> numbersOfParts(const std::vector<std::uint64_t>& first) const;
    void readSteps();
    void readFaceOffsets();
    void addCells(const Topology& topology, const VtkHdfStep& step, std::size_t which,
                  std::uint64_t part, std::uint64_t points, std::uint64_t firstPoint,
                  UnstructuredGrid& grid) const;
    void addFaces(const VtkHdfStep& step, const Part& part, UnstructuredGrid& grid) const;

    const NetcdfFile& file_;
    Sums points_;
    std::vector<Topology> topologies_;
    std::array<Sums, 3> faces_;  // as VtkHdfFaces; none where there are no polyhedra
    std::vector<VtkHdfStep> steps_;
    std::vector<double> times_;
};

}  // namespace timeseries
