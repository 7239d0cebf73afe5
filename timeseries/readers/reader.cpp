#include "timeseries/readers/reader.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <string_view>

#include "timeseries/in_turn.h"
#include "timeseries/readers/amrex/amrex_header.h"
#include "timeseries/readers/amrex/amrex_reader.h"
#include "timeseries/readers/arrays/array_reader.h"
#include "timeseries/readers/arrays/fits_reader.h"
#include "timeseries/readers/arrays/mrc_header.h"
#include "timeseries/readers/arrays/nifti_header.h"
#include "timeseries/readers/arrays/nrrd_header.h"
#include "timeseries/readers/csv_reader.h"
#include "timeseries/readers/csv_table.h"
#include "timeseries/readers/foam/foam_case.h"
#include "timeseries/readers/foam/foam_reader.h"
#include "timeseries/readers/netcdf/netcdf_reader.h"
#include "timeseries/readers/ordered_reader.h"
#include "timeseries/readers/ordinary_file.h"
#include "timeseries/readers/other_formats.h"
#include "timeseries/readers/plot3d_reader.h"
#include "timeseries/readers/sequence_reader.h"
#include "timeseries/readers/step_reader.h"
#include "timeseries/readers/text/words.h"
#include "timeseries/readers/xdmf/xdmf_reader.h"
#include "timeseries/readers/zarr/zarr_hierarchy.h"
#include "timeseries/readers/zarr/zarr_reader.h"
#ifdef ISOCHRON_VTK
#include "timeseries/readers/vtk/vtk_reader.h"
#endif
#ifdef ISOCHRON_OPENVDB
#include "timeseries/readers/arrays/vdb_reader.h"
#endif
#if !defined(ISOCHRON_VTK) || !defined(ISOCHRON_OPENVDB)
#include "timeseries/readers/text/shell_word.h"
#endif

namespace timeseries {
namespace {

using namespace std::string_view_literals;

// REQUIRES: an ordinary file.
std::string beginOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::string start(kBeginningBytes, '\0');
    file.read(start.data(), static_cast<std::streamsize>(kBeginningBytes));
    if (file.bad() || !file.is_open())
        throw FileError(fmt::format("{}: expected a file that can be read", path.string()));
    start.resize(static_cast<std::size_t>(file.gcount()));
    return start;
}

std::string beginning(const std::filesystem::path& path) {
    expectFile(path);
    return beginOf(path);
}

struct Format {
    bool (*begins)(std::string_view start);
    std::unique_ptr<Reader> (*open)(std::span<const std::filesystem::path> paths);
    bool joins = false;  // open() makes several files one series; else it is given one at a time
    bool opensLater = false;  // of a series all but the first when their steps are read
    OpenedOn opensOn = OpenedOn::OneThread;
};

const Format& recognise(const std::filesystem::path& path);

#if !defined(ISOCHRON_VTK) || !defined(ISOCHRON_OPENVDB)
[[noreturn]] void failUnbuilt(const std::filesystem::path& path, std::string_view format,
                              std::string_view option) {
    throw FileError(
        fmt::format("{}: expected a build that reads {} files, which `./run --with-{} {}` makes",
                    path.string(), format, option, shellWord(path.string())));
}
#endif

#ifndef ISOCHRON_VTK
std::unique_ptr<Reader> openVtk(std::span<const std::filesystem::path> paths) {
    // Nobody shall build anew for a collection that is not read then either.
    if (const std::string member = firstMember(beginning(paths[0])); !member.empty())
        recognise(paths[0].parent_path() / member);
    failUnbuilt(paths[0], "VTK", "vtk");
}
#endif

#ifndef ISOCHRON_OPENVDB
std::unique_ptr<Reader> openVdb(std::span<const std::filesystem::path> paths) {
    failUnbuilt(paths[0], "OpenVDB", "openvdb");
}
#endif

template <ArrayHeader (*read)(const std::filesystem::path& path)>
std::unique_ptr<Reader> openWith(std::span<const std::filesystem::path> paths) {
    return openArray(read(paths[0]));
}

const std::array kFormats = {
    Format{[](std::string_view start) {
               return start.starts_with("CDF\1"sv) || start.starts_with("CDF\2"sv) ||
                      start.starts_with("CDF\5"sv) || start.starts_with("\x89HDF\r\n\x1a\n"sv);
           },
           openNetcdf, true},
    Format{[](std::string_view start) { return start.starts_with("NRRD0"sv); },
           openWith<readNrrdHeader>},
    Format{[](std::string_view start) { return isNifti(unpackedBeginning(start)); },
           openWith<readNiftiHeader>},
    Format{isMrc, openWith<readMrcHeader>},
    Format{[](std::string_view start) { return start.starts_with("SIMPLE  ="sv); }, openFits},
    Format{[](std::string_view start) { return start.starts_with("isostep\n"sv); }, openStep, false,
           false, OpenedOn::AllThreads},
    Format{[](std::string_view start) { return start.starts_with(" BDV\0\0\0\0"sv); }, openVdb,
           true},
    Format{isXdmf, openXdmf},
    Format{isCsv, openCsv},
    Format{[](std::string_view start) {
               const auto first = start.find_first_not_of(" \t\r\n"sv);
               const bool vtk =
                   start.starts_with("# vtk DataFile"sv) ||
                   (first != start.npos && start[first] == '{' &&
                    start.find("\"file-series-version\""sv) != start.npos) ||
                   (start.find("<VTKFile"sv) != start.npos &&
                    start.find_first_not_of("\xEF\xBB\xBF \t\r\n"sv) == start.find('<'));
               return vtk && otherVtk(start).empty();
           },
           openVtk, true, true},
};
// Begins with nothing of its own: told by its size, when it is none of the others.
const Format kPlot3d{nullptr, openPlot3d};
constexpr const char* kPlot3dPlaces = "a PLOT3D file of places (XYZ), beside a flow's";
// Folders.
const Format kZarr{nullptr, openZarr, true};
const Format kFoam{nullptr, openFoam}, kAmrex{nullptr, openAmrex, true};

// Null of a file that begins as none. Throws FileError where it cannot be read.
const Format* formatOf(const std::filesystem::path& path) {
    std::string start;
    const bool hasBeginning = flawOfFile(path).empty();
    if (hasBeginning) {
        start = beginOf(path);
        for (const Format& format : kFormats)
            if (format.begins(start)) return &format;
    }
    // Folders, and files in them or beside them.
    if (isZarr(path)) return &kZarr;
    if (isFoamCase(path)) return &kFoam;
    if (isAmrex(path)) return &kAmrex;
    if (!hasBeginning) expectFile(path);
    if (!otherFormat(start).empty()) return nullptr;
    std::error_code ignored;
    return isPlot3d(start, std::filesystem::file_size(path, ignored)) ? &kPlot3d : nullptr;
}

[[noreturn]] void failUnknown(const std::filesystem::path& path) {
    const std::string start = beginning(path), other = otherFormat(start);
    if (!other.empty()) throw FileError(notReadSentence(path, other));
    const bool isCsv = lower(path.extension().string()) == ".csv";
    if (const auto flaw = isCsv ? csvFlawOf(start) : std::nullopt)
        throw FileError(fmt::format("{}: {}", path.string(), *flaw));
    if (isCsv && !start.empty())
        throw FileError(fmt::format(
            "{}: expected a table whose first line names columns x and y, perhaps z, and one more, "
            "above rows of numbers",
            path.string()));
    throw FileError(fmt::format(
        "{}: expected a NetCDF, NRRD, NIfTI, MRC, FITS, XDMF, CSV, VTK or OpenVDB file, {}",
        path.string(), start.empty() ? "but it is empty" : "found no format that is known"));
}

const Format& recognise(const std::filesystem::path& path) {
    if (const Format* const format = formatOf(path)) return *format;
    failUnknown(path);
}

// Those of the slab, of all in the order of a grid of this size.
template <typename T>
std::vector<T> partOf(const std::vector<T>& all, const std::array<std::size_t, 3>& size,
                      const Slab& slab) {
    std::uint64_t inner = 1, outer = 1;  // points of a place along the axis, and places beyond it
    for (std::size_t a = 0; a < 3; ++a) (a < slab.axis ? inner : outer) *= size[a];
    outer /= size[slab.axis];
    std::vector<T> part;
    part.reserve(inner * slab.count * outer);
    for (std::uint64_t o = 0; o < outer; ++o) {
        const auto from =
            all.begin() + static_cast<std::ptrdiff_t>((o * size[slab.axis] + slab.first) * inner);
        part.insert(part.end(), from, from + static_cast<std::ptrdiff_t>(slab.count * inner));
    }
    return part;
}

}  // namespace

void Reader::readSlab(std::size_t variable, std::size_t step, const Slab& slab, Field& into) {
    into = read(variable, step);
    const auto size = into.grid->size();
    std::visit([&](auto& values) { values = partOf(values, size, slab); }, into.values);
    if (!into.missing.empty()) into.missing = partOf(into.missing, size, slab);
    into.grid = nullptr;
}

std::unique_ptr<Reader> openReader(std::span<const std::filesystem::path> paths) {
    if (paths.empty()) throw FileError("expected a file to open, but none is named");
    // All of them first: a wrong file among many is told before any is read.
    const Format& format = recognise(paths.front());
    constexpr std::size_t kWorthAThread = 64;
    const auto formatAt = [&](std::size_t i) { return formatOf(paths[i]); };
    inTurn(0, paths.size(), kWorthAThread, formatAt, [&](std::size_t i, const Format* its) {
        const std::filesystem::path& path = paths[i];
        if (its && its != &format)
            throw FileError(
                fmt::format("{}: expected the format of {}, so that they make one series",
                            path.string(), paths.front().string()));
        // One that is empty, or overwritten, is refused when its step is read, where any other
        // damage is found then.
        const bool isToldLater = format.opensLater && path.extension() == paths.front().extension();
        if (!its && !isToldLater) failUnknown(path);
    });
    const auto now = std::chrono::system_clock::now();
    const auto openOne = [open = format.open](const std::filesystem::path& path) {
        return open(std::span(&path, 1));
    };
    auto reader = inOrderOfTime(format.joins || paths.size() == 1
                                    ? format.open(paths)
                                    : openSequence(paths, openOne, {}, {}, format.opensOn));
    reader->openedAt = now;
    return reader;
}

bool isReadable(const std::filesystem::path& path) {
    try {
        return &recognise(path) != &kPlot3d || !isPlot3dPlaces(path);
    } catch (const FileError&) {
        return false;
    }
}

std::string formatNotRead(const std::filesystem::path& path) {
    try {
        if (formatOf(path) == &kPlot3d) return isPlot3dPlaces(path) ? kPlot3dPlaces : "";
        return isReadable(path) ? "" : otherFormat(beginning(path));
    } catch (const FileError&) {
        return "";
    }
}

}  // namespace timeseries
