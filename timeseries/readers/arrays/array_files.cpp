#include "timeseries/readers/arrays/array_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "timeseries/readers/limits.h"
#include "timeseries/readers/ordinary_file.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

constexpr std::string_view kPlace = "data file";

// Upwards too, unless the name is absolute.
std::filesystem::path fromHeader(const ArrayHeader& header, const std::string& name) {
    if (name.empty()) header.fail(kPlace, "expected the name of a file");
    return header.path.parent_path() / name;
}

std::uint64_t sizeOf(const ArrayHeader& header, const std::filesystem::path& path) {
    std::string flaw = flawOfFile(path);
    std::error_code error;
    const std::uint64_t bytes = std::filesystem::file_size(path, error);
    if (error && flaw.empty()) flaw = "expected a file that can be read";
    if (!flaw.empty()) header.fail(kPlace, fmt::format("{}: {}", path.string(), flaw));
    return bytes;
}

// bzip2 packs megabytes of one value into 50 bytes: so much is believed of any file.
constexpr double kBzip2FreeBytes = 67108864;

// The fewest bytes that can stand for the values of one piece. Of bzip2 as much is believed as of
// deflate, and more; text needs a digit and a blank a value.
double leastBytes(const ArrayHeader& header, std::uint64_t count) {
    const double points = static_cast<double>(count);
    const double bytes = points * static_cast<double>(header.valueBytes());
    switch (header.encoding) {
        case ArrayEncoding::Raw:
            return bytes;
        case ArrayEncoding::Gzip:
            return bytes / kMaxInflated;
        case ArrayEncoding::Bzip2:
            return std::max(bytes - kBzip2FreeBytes, 0.0) / kMaxInflated;
        case ArrayEncoding::Ascii:
            return 2 * points - 1;
    }
    return bytes;
}

}  // namespace

ArrayPieces piecesOf(const ArrayHeader& header, std::vector<std::string>& notes) {
    ArrayPieces pieces;
    const std::uint64_t count = header.pointCount();
    for (const std::string& name : header.dataFiles)
        pieces.paths.push_back(fromHeader(header, name));
    if (header.dataFiles.empty()) {
        pieces.paths = {header.path};
        pieces.headerBytes = header.headerBytes;
    }
    pieces.pieceCount = count / pieces.paths.size();

    const double least = leastBytes(header, pieces.pieceCount);
    const bool raw = header.encoding == ArrayEncoding::Raw;
    const auto before =
        pieces.headerBytes +
        (raw ? static_cast<std::uint64_t>(std::max<std::int64_t>(header.byteSkip, 0)) : 0);
    std::uint64_t beyond = 0;
    for (const std::filesystem::path& path : pieces.paths) {
        const std::uint64_t bytes = sizeOf(header, path);
        const std::uint64_t left = bytes - std::min(bytes, before);
        if (static_cast<double>(left) < least)
            header.fail(
                pieces.paths.size() > 1 ? path.string() : "values",
                fmt::format("expected at least {:.0f} bytes for {} values{}, found {}", least,
                            pieces.pieceCount, raw ? "" : " in this encoding", left));
        if (raw && header.byteSkip >= 0 && header.lineSkip == 0)
            beyond += left - pieces.pieceCount * header.valueBytes();
    }
    if (beyond > 0)
        notes.push_back(
            fmt::format("{} bytes behind the values are not read: the file is larger than its "
                        "header declares",
                        beyond));
    return pieces;
}

}  // namespace timeseries
