// NetCDF files of the classic formats. Not NetCDF-4: HDF5 itself crashes on damaged files
// (KNOWN.md).
#include "tests/fuzz/read_all.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes = fuzz::text(data, size);
    if (bytes.starts_with("CDF")) fuzz::readAll(bytes, "file.nc");
    return 0;
}
