#include "timeseries/readers/netcdf/openpmd_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "timeseries/readers/limits.h"
#include "timeseries/readers/text/words.h"

namespace timeseries {
namespace {

// What a mesh record says of each of its dimensions, in the order of axisLabels.
struct Dimensions {
    std::vector<std::string> labels;
    std::vector<double> spacing, offset, position;
    double unit = 1;
};

std::vector<double> numbersOf(const NetcdfFile& file, const OpenPmdComponent& component,
                              const NcAttributes& attributes, const char* name, std::size_t count) {
    auto numbers = attributes.numbers(name);
    if (numbers.size() != count ||
        !std::ranges::all_of(numbers, [](double n) { return std::isfinite(n); }))
        failComponent(file, component,
                      fmt::format("expected {}, {} numbers that are finite, found {} of them", name,
                                  count, numbers.size()));
    return numbers;
}

Dimensions dimensionsOf(const NetcdfFile& file, const OpenPmdComponent& component, std::size_t rank,
                        bool placed) {
    const NcAttributes& record = *component.record;
    Dimensions told;
    told.labels = words(record.text("axisLabels"));
    if (told.labels.size() != rank)
        failComponent(file, component,
                      fmt::format("expected axisLabels of {} dimensions, found {}", rank,
                                  told.labels.size()));
    told.spacing.assign(rank, 1);
    told.offset.assign(rank, 0);
    told.position.assign(rank, 0);
    if (!placed) return told;
    told.spacing = numbersOf(file, component, record, "gridSpacing", rank);
    told.offset = numbersOf(file, component, record, "gridGlobalOffset", rank);
    // Some writers leave it out; at the beginning of a cell is where openPMD-api puts it then.
    if (component.own->find("position"))
        told.position = numbersOf(file, component, *component.own, "position", rank);
    told.unit = openPmdNumber(file, component, record, "gridUnitSI", 1);
    return told;
}

// The program's axis of each dimension: the one of its name, else x is the fastest.
std::vector<std::size_t> axesOfLabels(const std::vector<std::string>& labels) {
    std::vector<std::size_t> axes;
    for (const std::string& label : labels) {
        const std::size_t axis = label.size() == 1 ? std::string_view("xyz").find(label[0]) : 3;
        if (axis < 3 && std::ranges::find(axes, axis) == axes.end()) axes.push_back(axis);
    }
    if (axes.size() == labels.size()) return axes;
    axes.clear();
    for (std::size_t d = 0; d < labels.size(); ++d) axes.push_back(labels.size() - 1 - d);
    return axes;
}

// Of the axis that a mesh of two dimensions does not have.
std::string nameBeside(const std::vector<std::string>& labels) {
    for (const char* name : {"x", "y", "z"})
        if (std::ranges::find(labels, name) == labels.end()) return name;
    return "";
}

}  // namespace

bool OpenPmdMesh::sameCells(const OpenPmdMesh& other) const {
    return names == other.names && spacing == other.spacing && geometry == other.geometry &&
           layout.size == other.layout.size && layout.stride == other.layout.stride;
}

std::array<Axis, 3> OpenPmdMesh::axes() const {
    std::array<Axis, 3> axes;
    for (std::size_t a = 0; a < 3; ++a) {
        axes[a] = {names[a], isCartesian() ? "m" : "index", {}};
        for (std::size_t i = 0; i < layout.size[a]; ++i)
            axes[a].coordinates.push_back(first[a] + static_cast<double>(i) * spacing[a]);
    }
    return axes;
}

OpenPmdMesh openPmdMeshOf(const NetcdfFile& file, const OpenPmdComponent& component,
                          const OpenPmdNumbers& numbers) {
    const std::size_t rank = numbers.lengths.size();
    const auto fail = [&](const std::string& what) { failComponent(file, component, what); };
    if (rank < 2 || rank > 3)
        fail(fmt::format("expected a mesh of two or three dimensions, found {}", rank));
    if (numbers.count == 0) fail("expected values, found a mesh without points");
    if (std::ranges::max(numbers.lengths) > kMaxAxis)
        fail(fmt::format("expected at most 2^24 points along an axis, found {}",
                         std::ranges::max(numbers.lengths)));
    OpenPmdMesh mesh;
    mesh.geometry = component.record->text("geometry");
    if (mesh.geometry.empty()) mesh.geometry = "cartesian";
    if (mesh.geometry == "thetaMode")
        fail(
            "expected values in space, found the geometry thetaMode, whose coefficients of angles "
            "are not read");
    Dimensions told = dimensionsOf(file, component, rank, mesh.isCartesian());
    std::vector<std::uint64_t> lengths = numbers.lengths;
    // Fortran's indices run the other way round in HDF5, whose slowest is the first.
    if (component.record->text("dataOrder") == "F") {
        std::ranges::reverse(told.labels);
        std::ranges::reverse(told.spacing);
        std::ranges::reverse(told.offset);
        std::ranges::reverse(told.position);
        // A constant component's shape is in the order of axisLabels.
        if (!component.array) std::ranges::reverse(lengths);
    }
    const std::vector<std::size_t> axes = axesOfLabels(told.labels);
    for (std::size_t a = 0; a < 3; ++a)
        if (std::ranges::find(axes, a) == axes.end()) mesh.names[a] = nameBeside(told.labels);
    mesh.layout = {{1, 1, 1}, {1, 1, 1}};
    std::size_t stride = 1;
    for (std::size_t d = rank; d-- > 0;) {
        const std::size_t a = axes[d];
        mesh.names[a] = told.labels[d];
        mesh.first[a] = told.unit * (told.offset[d] + told.position[d] * told.spacing[d]);
        mesh.spacing[a] = told.unit * told.spacing[d];
        mesh.layout.size[a] = lengths[d];
        mesh.layout.stride[a] = stride;
        stride *= lengths[d];
    }
    for (const Axis& axis : mesh.axes())
        if (const std::string flaw = flawOf(axis.coordinates); !flaw.empty())
            fail(fmt::format("expected an axis {} that places points, found that {}", axis.name,
                             flaw));
    return mesh;
}

}  // namespace timeseries
