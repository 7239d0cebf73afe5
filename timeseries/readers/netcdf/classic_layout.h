// The layout of a netCDF classic file (CDF-1, CDF-2, CDF-5), read from its header to find out
// whether every value it declares lies in the file. The netCDF library reads what a cut file lacks
// as zeros, and trusts the counts of a damaged header.
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>

namespace timeseries {

// Throws FileError when the header is damaged or the file is too short for what it declares. Reads
// the header only; what it holds is bounded by the header's size.
void checkClassicLayout(const std::filesystem::path& path, std::istream& file,
                        std::uint64_t fileBytes);

}  // namespace timeseries
