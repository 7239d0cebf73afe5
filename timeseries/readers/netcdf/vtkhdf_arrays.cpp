#include "timeseries/readers/netcdf/vtkhdf_arrays.h"

#include <algorithm>

namespace timeseries {

std::string vtkHdfGroup(bool atPoints) {
    return atPoints ? "VTKHDF/PointData/" : "VTKHDF/CellData/";
}

const NcVariable* vtkHdfGhosts(const NcHeader& header, bool atPoints) {
    const NcVariable* const found = header.find(vtkHdfGroup(atPoints) + kVtkHdfGhosts, "");
    return found && found->type ? found : nullptr;
}

std::string vtkHdfName(const NcHeader& header, const std::string& own, bool atPoints) {
    if (!header.find(vtkHdfGroup(!atPoints) + own, "")) return own;
    return own + (atPoints ? " (points)" : " (cells)");
}

// Duplicate and hidden points; duplicate, refined and hidden cells (vtkDataSetAttributes).
std::vector<bool> vtkHdfMissing(const Values& flags, bool atPoints) {
    const unsigned bits = atPoints ? 1 | 2 : 1 | 8 | 32;
    std::vector<bool> missing;
    std::visit(
        [&](const auto& all) {
            for (const auto flag : all) {
                const double told = static_cast<double>(flag);
                const double known = told > 0 ? std::min(told, 255.0) : 0;
                missing.push_back((static_cast<unsigned>(known) & bits) != 0);
            }
        },
        flags);
    return missing;
}

}  // namespace timeseries
