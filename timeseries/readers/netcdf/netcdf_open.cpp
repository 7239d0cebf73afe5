// NetCDF files by what lies in them: CF's fields, or what others write into HDF5.
#include <memory>
#include <set>
#include <vector>

#include "timeseries/readers/netcdf/cf_fesom.h"
#include "timeseries/readers/netcdf/netcdf_file.h"
#include "timeseries/readers/netcdf/netcdf_others.h"
#include "timeseries/readers/netcdf/netcdf_reader.h"
#include "timeseries/readers/sequence_reader.h"

namespace timeseries {
namespace {

// Those whose headers need not be tried any more.
std::shared_ptr<const std::set<std::filesystem::path>> knownAmong(
    std::span<const std::filesystem::path> paths) {
    const auto known = std::make_shared<std::set<std::filesystem::path>>();
    const std::vector<bool> tried = NetcdfFile::triedTogether(paths);
    for (std::size_t i = 0; i < paths.size(); ++i)
        if (tried[i]) known->insert(paths[i]);
    return known;
}

}  // namespace

std::unique_ptr<Reader> openNetcdf(std::span<const std::filesystem::path> paths) {
    auto first = std::make_unique<NetcdfFile>(paths[0], NetcdfFile::Header::New);
    const OtherNetcdf* const other = otherNetcdf(first->header());
    if (!other)
        return openCf(
            paths, withFesomMesh(std::move(first), NetcdfFile::Header::New),
            [tried = knownAmong(paths.subspan(1))](const std::filesystem::path& path, bool known) {
                using enum NetcdfFile::Header;
                auto file = std::make_unique<NetcdfFile>(
                    path, known || tried->contains(path) ? Known : New);
                return withFesomMesh(std::move(file), known ? Known : New);
            });
    if (paths.size() == 1) return other->open(std::move(first));
    first.reset();
    return openSequence(
        paths, [](const std::filesystem::path& path) { return openNetcdf(std::span(&path, 1)); });
}

}  // namespace timeseries
