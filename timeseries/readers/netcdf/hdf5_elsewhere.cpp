#include "timeseries/readers/netcdf/hdf5_elsewhere.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <cstdlib>
#include <set>
#include <utility>

namespace timeseries {
namespace {

using Source = std::pair<std::string, std::string>;  // file, dataset

struct Visit {
    const LookAtHdf5& also;
    std::filesystem::path folder;
    std::set<Source> there;  // known to be
    std::set<std::filesystem::path> files;
    Hdf5Elsewhere found;
};

void addFile(const std::filesystem::path& path, Visit& visit) {
    std::error_code error;
    const auto bytes = std::filesystem::file_size(path, error);
    if (!error && visit.files.insert(path).second) visit.found.bytes += static_cast<double>(bytes);
}

bool opens(const std::filesystem::path& path, const std::string& dataset) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return false;  // a pipe would be waited for
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0) return false;
    const hid_t source = H5Dopen2(file, dataset.c_str(), H5P_DEFAULT);
    if (source >= 0) H5Dclose(source);
    H5Fclose(file);
    return source >= 0;
}

// Looked for where HDF5 does: below its prefix, in the folder of the file, as it is named, and of
// a file that was moved with it by its name alone.
bool isThere(const Source& source, Visit& visit) {
    if (visit.there.contains(source)) return true;
    const std::filesystem::path named = source.first;
    const char* const prefix = std::getenv("HDF5_VDS_PREFIX");
    for (const auto& path : {(prefix ? prefix : "") / named, visit.folder / named, named,
                             visit.folder / named.filename()})
        if (opens(path, source.second)) {
            addFile(path, visit);
            visit.there.insert(source);
            return true;
        }
    return false;
}

// `get` as H5Pget_virtual_filename: of a text that has no more than its length.
std::string textOf(hid_t created, std::size_t mapping, const auto& get) {
    std::string text(4096, '\0');
    const ssize_t length = get(created, mapping, text.data(), text.size());
    text.resize(length > 0 && length < static_cast<ssize_t>(text.size()) ? length : 0);
    return text;
}

void lookAtSources(hid_t created, const char* name, Visit& visit) {
    std::size_t mappings = 0;
    H5Pget_virtual_count(created, &mappings);
    for (std::size_t i = 0; i < mappings; ++i) {
        const Source source(textOf(created, i, H5Pget_virtual_filename),
                            textOf(created, i, H5Pget_virtual_dsetname));
        // Of the file itself; one of a number of files that goes on as long as there are any.
        if (source.first == "." || (source.first + source.second).find('%') != std::string::npos)
            continue;
        if (!isThere(source, visit)) {
            visit.found.missing.emplace(name,
                                        fmt::format("'{}' of {}", source.second, source.first));
            return;
        }
    }
}

void lookAtDataset(hid_t dataset, const char* name, Visit& visit) {
    const hid_t created = H5Dget_create_plist(dataset);
    if (created < 0) {
        visit.found.any = true;
        return;
    }
    const bool isVirtual = H5Pget_layout(created) == H5D_VIRTUAL;
    const int stores = H5Pget_external_count(created);
    if (isVirtual || stores != 0) visit.found.any = true;
    if (isVirtual) lookAtSources(created, name, visit);
    for (int i = 0; i < stores; ++i) {
        std::string file(4096, '\0');
        off_t offset = 0;
        hsize_t bytes = 0;
        if (H5Pget_external(created, static_cast<unsigned>(i), file.size() - 1, file.data(),
                            &offset, &bytes) >= 0)
            addFile(visit.folder / file.c_str(), visit);
    }
    H5Pclose(created);
}

herr_t look(hid_t group, const char* name, const H5L_info_t* link, void* data) {
    Visit& visit = *static_cast<Visit*>(data);
    if (link->type == H5L_TYPE_EXTERNAL) visit.found.any = true;
    // What a soft link leads to is looked at under its name, too.
    if (link->type != H5L_TYPE_HARD && link->type != H5L_TYPE_SOFT) return 0;
    const hid_t object = H5Oopen(group, name, H5P_DEFAULT);
    if (object < 0) {
        if (link->type == H5L_TYPE_HARD) visit.found.any = true;
        return 0;
    }
    if (H5Iget_type(object) == H5I_DATASET) {
        lookAtDataset(object, name, visit);
        visit.also(object, name);
    }
    H5Oclose(object);
    return 0;
}

// What a soft link leads to, or an external one: an object, of a file.
std::string targetOf(hid_t group, const char* name, const H5L_info_t& link) {
    std::string text(link.u.val_size + 1, '\0');
    if (H5Lget_val(group, name, text.data(), link.u.val_size, H5P_DEFAULT) < 0) return "";
    if (link.type == H5L_TYPE_SOFT) return fmt::format("'{}'", text.c_str());
    const char *file = nullptr, *object = nullptr;
    if (H5Lunpack_elink_val(text.data(), link.u.val_size, nullptr, &file, &object) < 0) return "";
    return fmt::format("'{}' of {}", object, file);
}

// Ends with the first.
herr_t findDead(hid_t group, const char* name, const H5L_info_t* link, void* data) {
    constexpr std::size_t kLongest = 4096;  // of a damaged file it may have any length
    if ((link->type != H5L_TYPE_SOFT && link->type != H5L_TYPE_EXTERNAL) ||
        link->u.val_size > kLongest)
        return 0;
    const hid_t object = H5Oopen(group, name, H5P_DEFAULT);
    if (object >= 0) {
        H5Oclose(object);
        return 0;
    }
    const std::string target = targetOf(group, name, *link);
    if (target.empty()) return 0;
    *static_cast<std::string*>(data) = fmt::format("'{}', which leads to {}", name, target);
    return 1;
}

}  // namespace

std::string deadHdf5Link(const std::filesystem::path& path) {
    if (H5Fis_hdf5(path.c_str()) <= 0) return "";
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0) return "";
    std::string dead;
    H5Lvisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, findDead, &dead);
    H5Fclose(file);
    return dead;
}

Hdf5Elsewhere hdf5Elsewhere(const std::filesystem::path& path, const LookAtHdf5& also) {
    if (H5Fis_hdf5(path.c_str()) <= 0) return {};
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0) return {.any = true, .bytes = 0, .missing = {}};
    Visit visit{also, std::filesystem::absolute(path).parent_path(), {}, {}, {}};
    if (H5Lvisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, look, &visit) < 0) visit.found.any = true;
    H5Fclose(file);
    return std::move(visit.found);
}

}  // namespace timeseries
