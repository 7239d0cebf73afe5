#include "timeseries/readers/netcdf/hdf5_enums.h"

#include <hdf5.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace timeseries {
namespace {

// One of HDF5's, closed at the end.
class Handle {
 public:
    Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
    ~Handle() {
        if (id_ >= 0) close_(id_);
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    operator hid_t() const { return id_; }

 private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

std::optional<ValueType> typeOf(hid_t type) {
    if (H5Tget_class(type) != H5T_ENUM) return std::nullopt;
    const Handle base(H5Tget_super(type), H5Tclose);
    const bool isSigned = H5Tget_sign(base) != H5T_SGN_NONE;
    switch (H5Tget_size(base)) {
        case 1:
            return isSigned ? ValueType::I8 : ValueType::U8;
        case 2:
            return isSigned ? ValueType::I16 : ValueType::U16;
        case 4:
            return isSigned ? ValueType::I32 : ValueType::U32;
        case 8:
            return isSigned ? ValueType::I64 : ValueType::U64;
        default:
            return std::nullopt;
    }
}

hid_t inMemory(ValueType type) {
    switch (type) {
        case ValueType::I8:
            return H5T_NATIVE_INT8;
        case ValueType::U8:
            return H5T_NATIVE_UINT8;
        case ValueType::I16:
            return H5T_NATIVE_INT16;
        case ValueType::U16:
            return H5T_NATIVE_UINT16;
        case ValueType::I32:
            return H5T_NATIVE_INT32;
        case ValueType::U32:
            return H5T_NATIVE_UINT32;
        case ValueType::I64:
            return H5T_NATIVE_INT64;
        default:
            return H5T_NATIVE_UINT64;
    }
}

std::vector<hsize_t> lengthsOf(hid_t space) {
    const int rank = H5Sget_simple_extent_ndims(space);
    std::vector<hsize_t> lengths(static_cast<std::size_t>(std::max(rank, 0)));
    if (rank > 0) H5Sget_simple_extent_dims(space, lengths.data(), nullptr);
    return lengths;
}

// 0 where it is stored otherwise.
std::uint64_t chunkBytesOf(hid_t dataset, std::size_t rank, std::size_t bytes) {
    const Handle created(H5Dget_create_plist(dataset), H5Pclose);
    std::vector<hsize_t> chunk(rank);
    if (created < 0 || H5Pget_layout(created) != H5D_CHUNKED ||
        H5Pget_chunk(created, static_cast<int>(rank), chunk.data()) != static_cast<int>(rank))
        return 0;
    double all = static_cast<double>(bytes);
    for (const hsize_t length : chunk) all *= static_cast<double>(length);
    return static_cast<std::uint64_t>(std::min(all, 1e18));
}

}  // namespace

void takeHdf5Enum(std::int64_t dataset, const char* name, Hdf5Enums& enums) {
    const Handle type(H5Dget_type(dataset), H5Tclose);
    const auto found = typeOf(type);
    if (!found) return;
    const Handle space(H5Dget_space(dataset), H5Sclose);
    const auto lengths = lengthsOf(space);
    if (lengths.empty()) return;
    enums[name] = {*found,
                   {lengths.begin(), lengths.end()},
                   chunkBytesOf(dataset, lengths.size(), H5Tget_size(type))};
}

bool readHdf5Enum(const std::filesystem::path& path, const std::string& name, ValueType type,
                  std::span<const std::size_t> start, std::span<const std::size_t> count,
                  void* values) {
    const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    if (file < 0) return false;
    const Handle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
    if (dataset < 0) return false;
    const Handle stored(H5Dget_type(dataset), H5Tclose), space(H5Dget_space(dataset), H5Sclose);
    const auto lengths = lengthsOf(space);
    if (typeOf(stored) != type || lengths.size() != start.size()) return false;
    for (std::size_t i = 0; i < lengths.size(); ++i)
        if (start[i] > lengths[i] || count[i] > lengths[i] - start[i]) return false;
    const std::vector<hsize_t> first(start.begin(), start.end()), size(count.begin(), count.end());
    if (std::ranges::find(size, hsize_t{0}) != size.end()) return true;
    const Handle part(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr),
                      H5Sclose);
    return H5Sselect_hyperslab(space, H5S_SELECT_SET, first.data(), nullptr, size.data(),
                               nullptr) >= 0 &&
           H5Dread(dataset, inMemory(type), part, space, H5P_DEFAULT, values) >= 0;
}

}  // namespace timeseries
