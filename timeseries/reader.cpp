#include "timeseries/reader.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <string_view>

#include "timeseries/readers/netcdf_reader.h"

namespace timeseries {
namespace {

enum class FileFormat { Netcdf };

std::string beginning(const std::filesystem::path& path) {
    const auto fail = [&](std::string_view what) {
        throw FileError(fmt::format("{}: {}", path.string(), what));
    };
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) fail("expected a file, but there is none");
    if (std::filesystem::is_directory(status)) fail("expected a file, but it is a folder");
    if (!std::filesystem::is_regular_file(status)) fail("expected an ordinary file");
    std::ifstream file(path, std::ios::binary);
    std::string start(8, '\0');
    file.read(start.data(), 8);
    if (file.bad() || !file.is_open()) fail("expected a file that can be read");
    start.resize(static_cast<std::size_t>(file.gcount()));
    return start;
}

FileFormat recognise(const std::filesystem::path& path) {
    using namespace std::string_view_literals;
    const std::string start = beginning(path);
    for (const std::string_view magic : {"CDF\1"sv, "CDF\2"sv, "CDF\5"sv, "\x89HDF\r\n\x1a\n"sv})
        if (start.starts_with(magic)) return FileFormat::Netcdf;
    throw FileError(fmt::format(
        "{}: expected a NetCDF file, which begins with CDF (classic) or \\x89HDF (NetCDF-4){}",
        path.string(), start.empty() ? ", but it is empty" : ""));
}

}  // namespace

std::unique_ptr<Reader> openReader(std::span<const std::filesystem::path> paths) {
    if (paths.empty()) throw FileError("expected a file to open, but none is named");
    // All of them first: a wrong file among many is told before any is read.
    for (const std::filesystem::path& path : paths) recognise(path);
    return openNetcdf(paths);
}

}  // namespace timeseries
