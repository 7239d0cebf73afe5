// Where the values of an openPMD mesh record lie (openPMD standard 1.1.0, "Mesh Based Records").
#pragma once

#include <array>
#include <string>
#include <vector>

#include "timeseries/grid/grid.h"
#include "timeseries/readers/netcdf/openpmd_records.h"
#include "timeseries/readers/strided_layout.h"

namespace timeseries {

// Along the coordinates x, y and z of the program. In metres; of a geometry that is not cartesian
// counted.
struct OpenPmdMesh {
    std::array<std::string, 3> names;
    std::array<double, 3> first{}, spacing{1, 1, 1};
    StridedLayout layout;  // of the numbers as they are stored
    std::string geometry;

    bool isCartesian() const { return geometry == "cartesian"; }
    // But for where it begins.
    bool sameCells(const OpenPmdMesh& other) const;
    std::array<Axis, 3> axes() const;
};

// Of two dimensions or three. Throws AttributeError.
OpenPmdMesh openPmdMeshOf(const NetcdfFile& file, const OpenPmdComponent& component,
                          const OpenPmdNumbers& numbers);

}  // namespace timeseries
