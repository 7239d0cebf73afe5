#include "timeseries/readers/other_formats.h"

#include <fmt/format.h>
#include <zlib.h>

#include <array>

namespace timeseries {
namespace {

using namespace std::string_view_literals;

struct Magic {
    std::size_t at;
    std::string_view bytes, what;
};

constexpr std::array kMagics{
    Magic{0, "GRIB"sv, "a GRIB file"},
    Magic{128, "DICM"sv, "a DICOM file"},
    Magic{0, "II*\0"sv, "a TIFF file"},
    Magic{0, "MM\0*"sv, "a TIFF file"},
    Magic{0, "II+\0"sv, "a BigTIFF file"},
    Magic{0, "MM\0+"sv, "a BigTIFF file"},
    Magic{0, "\x93NUMPY"sv, "a NumPy array (.npy)"},
    Magic{0, "\x0e\x03\x13\x01"sv, "an HDF4 file"},
    Magic{512, "\x89HDF\r\n\x1a\n"sv, "an HDF5 file behind a user block"},
    Magic{0, "MATLAB 5.0 MAT-file"sv, "a MATLAB file"},
    Magic{0, "# AmiraMesh"sv, "an AmiraMesh file"},
    Magic{0, "# Avizo"sv, "an AmiraMesh file"},
    Magic{0, "ObjectType = Image"sv, "a MetaImage header"},
    Magic{0, "NDims = "sv, "a MetaImage header"},
    Magic{0, "#!TDV"sv, "a Tecplot file"},
    Magic{0, "C Binary"sv, "an EnSight file"},
    Magic{0, "ply\n"sv, "a PLY mesh"},
    Magic{0, "PK\3\4"sv, "a zip archive"},
    Magic{257, "ustar"sv, "a tar archive"},
    Magic{0, "BZh"sv, "compressed by bzip2, and must be unpacked first"},
    Magic{0, "\xFD\x37zXZ\0"sv, "compressed by xz, and must be unpacked first"},
    Magic{0, "\x28\xB5\x2F\xFD"sv, "compressed by zstd, and must be unpacked first"},
    Magic{0, "\x89PNG\r\n\x1a\n"sv, "a PNG picture"},
    Magic{0, "\xFF\xD8\xFF"sv, "a JPEG picture"},
    Magic{0, "%PDF"sv, "a PDF document"},
};

bool has(std::string_view start, std::string_view word) {
    return start.find(word) != std::string_view::npos;
}

bool beginsWithMarkup(std::string_view start) {
    const auto first = start.find_first_not_of("\xEF\xBB\xBF \t\r\n"sv);
    return first != std::string_view::npos && start[first] == '<';
}

// The value of the first such attribute behind `from`; "" when there is none.
std::string_view attributeOf(std::string_view text, std::string_view name, std::size_t from) {
    const std::string key = fmt::format("{}=", name);
    const std::size_t at = text.find(key, from);
    if (at == text.npos || at + key.size() >= text.size()) return {};
    const char quote = text[at + key.size()];
    if (quote != '"' && quote != '\'') return {};
    const std::string_view rest = text.substr(at + key.size() + 1);
    const std::size_t end = rest.find(quote);
    return end == rest.npos ? std::string_view() : rest.substr(0, end);
}

std::string otherText(std::string_view start) {
    if (start.starts_with("file") && has(start, "grid =")) return "an OpenDX header";
    if (start.starts_with("FORMAT") && has(start, "ensight")) return "an EnSight file";
    return "";
}

bool isGzip(std::string_view start) { return start.starts_with("\x1f\x8b"); }

std::string insideGzip(std::string_view start) {
    const std::string inner = unpackedBeginning(start), other = otherFormat(inner);
    if (!other.empty()) return other;
    return "compressed by gzip, and must be unpacked first";
}

// The word behind DATASET, which follows a title and the word ASCII or BINARY.
std::string legacyType(std::string_view start) {
    std::string text(start);
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    const std::size_t at = text.find("\ndataset ");
    if (at == text.npos) return "";
    const std::string rest = text.substr(at + 9);
    return rest.substr(0, rest.find_first_of(" \t\r\n"));
}

}  // namespace

std::string unpackedBeginning(std::string_view start) {
    if (!isGzip(start)) return std::string(start);
    z_stream stream{};
    constexpr int kGzip = 15 + 16;
    if (inflateInit2(&stream, kGzip) != Z_OK) return "";
    std::string in(start), out(kBeginningBytes, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(in.data());
    stream.avail_in = static_cast<uInt>(in.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    inflate(&stream, Z_SYNC_FLUSH);
    out.resize(out.size() - stream.avail_out);
    inflateEnd(&stream);
    return out;
}

std::string otherVtkType(std::string_view type) {
    constexpr std::string_view kBlank = " \t\r\n";
    const auto first = type.find_first_not_of(kBlank);
    if (first == type.npos) return "";
    type = type.substr(first, type.find_last_not_of(kBlank) + 1 - first);
    for (const auto other :
         {"HyperTreeGrid"sv, "PHyperTreeGrid"sv, "Table"sv, "PTable"sv, "field"sv})
        if (type == other) return fmt::format("a VTK file of type {}", type);
    return "";
}

std::string otherVtk(std::string_view start) {
    if (start.starts_with("# vtk DataFile")) return otherVtkType(legacyType(start));
    const auto root = start.find("<VTKFile");
    if (root == start.npos || !beginsWithMarkup(start)) return "";
    return otherVtkType(attributeOf(start.substr(0, start.find('>', root)), "type", root));
}

std::string otherFormat(std::string_view start) {
    if (isGzip(start)) return insideGzip(start);
    for (const Magic& magic : kMagics)
        if (start.size() >= magic.at + magic.bytes.size() &&
            start.substr(magic.at, magic.bytes.size()) == magic.bytes)
            return std::string(magic.what);
    if (std::string vtk = otherVtk(start); !vtk.empty()) return vtk;
    return otherText(start);
}

std::string otherFolder(const std::filesystem::path& folder) {
    const auto holds = [&](const char* name) {
        std::error_code ignored;
        return std::filesystem::exists(folder / name, ignored);
    };
    return holds("md.idx") && holds("md.0") ? "an ADIOS2 file (BP)" : "";
}

std::string notReadSentence(const std::filesystem::path& path, std::string_view what) {
    constexpr std::string_view kRead =
        "NetCDF, Exodus II, VTKHDF, XDMF, Zarr, OpenFOAM, AMReX, NRRD, NIfTI, MRC, FITS, PLOT3D, "
        "CSV and, "
        "of VTK, "
        "image "
        "data, rectilinear, structured and unstructured grids, polygons (.vti, .vtr, .vts, .vtu, "
        ".vtp, .pvti and so on, .vtm, .vthb, .vtk, .pvd, .series), OpenVDB";
    return fmt::format("{} is {}; isochron reads {}", path.string(), what, kRead);
}

std::string firstMember(std::string_view collectionStart) {
    const std::size_t set = collectionStart.find("<DataSet");
    return set == collectionStart.npos ? ""
                                       : std::string(attributeOf(collectionStart, "file", set));
}

}  // namespace timeseries
