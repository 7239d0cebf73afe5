// The arrays of an XDMF file: what its DataItems stand for, in HDF5, in binary files or as text.
#pragma once

#include <cstdint>
#include <filesystem>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "timeseries/grid/field.h"
#include "timeseries/readers/netcdf/netcdf_file.h"
#include "timeseries/readers/xdmf/xdmf_document.h"

namespace timeseries {

// Where a part of an array lies, along each dimension, the slowest first.
struct XdmfPart {
    std::vector<std::size_t> start, stride, count;
};

// Everything here throws FileError.
class XdmfItems {
 public:
    // `document` must outlive it.
    explicit XdmfItems(const XdmfDocument& document) : document_(document) {}

    // Along each dimension, the slowest first; at least one, and fewer than 2^40 in all.
    std::vector<std::uint64_t> dimensionsOf(const XdmfElement& item);
    ValueType typeOf(const XdmfElement& item);
    // The same for items of the same values: where they come from.
    std::string sourceOf(const XdmfElement& item);
    // All values, the fastest dimension fastest.
    Values read(const XdmfElement& item);
    std::vector<double> numbers(const XdmfElement& item);

    // Whole numbers of 0 or more, "57 33 25".
    std::vector<std::uint64_t> lengths(const XdmfElement& at, const std::string& text) const;

 private:
    struct InHdf5 {
        const NetcdfFile* file;
        const NcVariable* variable;
    };
    enum class Kind { Uniform, HyperSlab };
    Kind kindOf(const XdmfElement& item) const;
    ValueType declaredType(const XdmfElement& item) const;
    const NetcdfFile& fileAt(const XdmfElement& item, const std::filesystem::path& path);
    InHdf5 inHdf5(const XdmfElement& item);
    XdmfElement wholeOf(const XdmfElement& slab) const;
    XdmfPart partOf(const XdmfElement& slab);
    std::filesystem::path besideDocument(const std::string& name) const;
    Values fromHdf5(const XdmfElement& item, const XdmfPart* part);
    Values fromText(const XdmfElement& item);
    Values fromBinary(const XdmfElement& item);
    Values uniform(const XdmfElement& item);

    const XdmfDocument& document_;
    std::list<std::unique_ptr<NetcdfFile>> open_;  // what was asked for last is first
};

}  // namespace timeseries
