#include "timeseries/readers/netcdf/netcdf_others.h"

#include <algorithm>
#include <array>

#include "timeseries/readers/netcdf/exodus_mesh.h"
#include "timeseries/readers/netcdf/exodus_reader.h"
#include "timeseries/readers/netcdf/openpmd_reader.h"
#include "timeseries/readers/netcdf/openpmd_records.h"
#include "timeseries/readers/netcdf/snapshot_files.h"
#include "timeseries/readers/netcdf/snapshot_reader.h"
#include "timeseries/readers/netcdf/vtkhdf_mesh.h"
#include "timeseries/readers/netcdf/vtkhdf_reader.h"

namespace timeseries {

const OtherNetcdf* otherNetcdf(const NcHeader& header) {
    static constexpr std::array kOthers{
        OtherNetcdf{"an Exodus II mesh", isExodus, openExodus},
        OtherNetcdf{"a VTKHDF file", isVtkHdf, openVtkHdf},
        OtherNetcdf{"an openPMD file", isOpenPmd, openOpenPmd},
        OtherNetcdf{"a snapshot of particles", isSnapshot, openSnapshot}};
    const auto found =
        std::ranges::find_if(kOthers, [&](const OtherNetcdf& each) { return each.holds(header); });
    return found == kOthers.end() ? nullptr : &*found;
}

}  // namespace timeseries
