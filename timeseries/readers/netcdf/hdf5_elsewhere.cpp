#include "timeseries/readers/netcdf/hdf5_elsewhere.h"

#include <hdf5.h>

namespace timeseries {
namespace {

bool isElsewhere(hid_t dataset) {
    const hid_t created = H5Dget_create_plist(dataset);
    if (created < 0) return true;
    const bool is = H5Pget_layout(created) == H5D_VIRTUAL || H5Pget_external_count(created) != 0;
    H5Pclose(created);
    return is;
}

// 1 ends the visit: found.
herr_t look(hid_t group, const char* name, const H5L_info_t* link, void*) {
    if (link->type == H5L_TYPE_EXTERNAL) return 1;
    if (link->type != H5L_TYPE_HARD) return 0;  // soft ones lead to what is visited
    const hid_t object = H5Oopen(group, name, H5P_DEFAULT);
    if (object < 0) return 1;
    const bool is = H5Iget_type(object) == H5I_DATASET && isElsewhere(object);
    H5Oclose(object);
    return is ? 1 : 0;
}

}  // namespace

bool hdf5HasValuesElsewhere(const std::filesystem::path& path) {
    if (H5Fis_hdf5(path.c_str()) <= 0) return false;
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0) return true;
    const herr_t found = H5Lvisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, look, nullptr);
    H5Fclose(file);
    return found != 0;
}

}  // namespace timeseries
