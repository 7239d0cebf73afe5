#include "timeseries/readers/arrays/nifti_header.h"

#include <fmt/format.h>
#include <nifti2_io.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <mutex>

namespace timeseries {
namespace {

using namespace std::string_view_literals;
using Image = std::unique_ptr<nifti_image, decltype(&nifti_image_free)>;

constexpr std::size_t kMagicAt = 344, kMagic2At = 4;

// What the library tells is global.
std::mutex& niftiMutex() {
    static std::mutex one;
    return one;
}

bool isNifti1(std::string_view start) {
    const auto magic = start.substr(std::min(kMagicAt, start.size()), 4);
    return magic == "n+1\0"sv || magic == "ni1\0"sv;
}

bool isNifti2(std::string_view start) {
    const auto magic = start.substr(std::min(kMagic2At, start.size()), 8);
    return magic == "n+2\0\r\n\x1a\n"sv || magic == "ni2\0\r\n\x1a\n"sv;
}

// The beginning of a file that may be packed by gzip; zlib passes others as they are.
std::string beginningOf(const ArrayHeader& header, bool& packed) {
    const std::unique_ptr<gzFile_s, decltype(&gzclose_r)> file(gzopen(header.path.c_str(), "rb"),
                                                               gzclose_r);
    if (!file) header.fail("", "expected a file that can be read");
    std::string start(sizeof(nifti_2_header), '\0');
    const int got = gzread(file.get(), start.data(), static_cast<unsigned>(start.size()));
    packed = gzdirect(file.get()) == 0;
    start.resize(static_cast<std::size_t>(std::max(got, 0)));
    return start;
}

template <typename Integer>
Integer inReverse(Integer value) {
    auto bytes = std::bit_cast<std::array<char, sizeof value>>(value);
    std::ranges::reverse(bytes);
    return std::bit_cast<Integer>(bytes);
}

// What the library takes for something else where it cannot be.
struct Raw {
    std::array<double, 8> pixdim;
    double valuesAt;  // vox_offset
};

// As they are in the file. The library prints its objections, and follows sizes of the other byte
// order beyond its arrays.
template <typename Header>
Raw expectHeader(const ArrayHeader& header, const Header& raw, int bytes) {
    const bool swapped = raw.dim[0] < 1 || raw.dim[0] > 7;
    const auto told = [&](auto value) { return swapped ? inReverse(value) : value; };
    const auto dimensions = told(raw.dim[0]);
    if (dimensions < 1 || dimensions > 7)
        header.fail("dim[0]", fmt::format("expected 1 to 7 dimensions, found {}", raw.dim[0]));
    if (told(raw.sizeof_hdr) != bytes)
        header.fail("sizeof_hdr",
                    fmt::format("expected {}, found {}", bytes, told(raw.sizeof_hdr)));
    for (int i = 1; i <= dimensions; ++i)
        if (told(raw.dim[i]) < 1)
            header.fail(fmt::format("dim[{}]", i),
                        fmt::format("expected one or more, found {}", told(raw.dim[i])));
    int each = 0, unused = 0;
    nifti_datatype_sizes(told(raw.datatype), &each, &unused);
    if (each == 0)
        header.fail("datatype",
                    fmt::format("expected one of NIfTI's, found {}", told(raw.datatype)));
    Raw found{{}, static_cast<double>(told(raw.vox_offset))};
    for (std::size_t i = 0; i < 8; ++i) found.pixdim[i] = static_cast<double>(told(raw.pixdim[i]));
    return found;
}

struct Read {
    Image image{nullptr, nifti_image_free};
    Raw raw{};
};

template <typename Header>
Read readWith(const ArrayHeader& header, std::string_view start, int bytes,
              nifti_image* (*convert)(Header, const char*)) {
    Header raw;
    if (start.size() < sizeof raw)
        header.fail("header", fmt::format("expected {} bytes, found {}", bytes, start.size()));
    std::memcpy(&raw, start.data(), sizeof raw);
    Read read{{nullptr, nifti_image_free}, expectHeader(header, raw, bytes)};
    const std::lock_guard lock(niftiMutex());
    nifti_set_debug_level(0);  // it prints otherwise
    read.image.reset(convert(raw, nullptr));
    return read;
}

ValueType typeOf(const ArrayHeader& header, int type) {
    switch (type) {
        case DT_INT8:
            return ValueType::I8;
        case DT_UINT8:
            return ValueType::U8;
        case DT_INT16:
            return ValueType::I16;
        case DT_UINT16:
            return ValueType::U16;
        case DT_INT32:
            return ValueType::I32;
        case DT_UINT32:
            return ValueType::U32;
        case DT_INT64:
            return ValueType::I64;
        case DT_UINT64:
            return ValueType::U64;
        case DT_FLOAT32:
            return ValueType::F32;
        case DT_FLOAT64:
            return ValueType::F64;
        default:
            header.fail("datatype", fmt::format("expected integers of 8 to 64 bits, FLOAT32 or "
                                                "FLOAT64, found {}",
                                                nifti_datatype_string(type)));
    }
}

std::string unitOf(int code) {
    switch (code) {
        case NIFTI_UNITS_METER:
            return "m";
        case NIFTI_UNITS_MM:
            return "mm";
        case NIFTI_UNITS_MICRON:
            return "um";
        case NIFTI_UNITS_SEC:
            return "s";
        case NIFTI_UNITS_MSEC:
            return "ms";
        case NIFTI_UNITS_USEC:
            return "us";
        case NIFTI_UNITS_HZ:
            return "Hz";
        case NIFTI_UNITS_PPM:
            return "ppm";
        case NIFTI_UNITS_RADS:
            return "rad/s";
        default:
            return "";
    }
}

void takeAxes(const nifti_image& image, const Raw& raw, ArrayHeader& header) {
    for (int i = 5; i <= 7; ++i)
        if (image.dim[0] >= i && image.dim[i] > 1)
            header.fail(fmt::format("dim[{}]", i),
                        fmt::format("expected one number a point, found {} ({})", image.dim[i],
                                    nifti_intent_string(image.intent_code)));
    for (int i = 1; i <= (image.dim[0] >= 4 && image.dim[4] > 1 ? 4 : 3); ++i) {
        ArrayAxis axis;
        axis.size = static_cast<std::uint64_t>(image.dim[0] >= i ? image.dim[i] : 1);
        // The library takes what is none for 1.
        const double step = std::abs(raw.pixdim[static_cast<std::size_t>(i)]);
        if (step > 0 && std::isfinite(step)) axis.spacing = step;
        axis.cell = false;
        axis.kind = i == 4 ? ArrayKind::Time : ArrayKind::Space;
        axis.units = unitOf(i == 4 ? image.time_units : image.xyz_units);
        if (i == 4 && std::isfinite(image.toffset)) axis.min = image.toffset;
        header.axes.push_back(std::move(axis));
    }
}

bool isTransformation(const nifti_dmat44& m) {
    for (int column = 0; column < 4; ++column) {
        const double length = std::hypot(m.m[0][column], m.m[1][column], m.m[2][column]);
        if (!std::isfinite(length) || (column < 3 && !(length > 0))) return false;
    }
    return true;
}

// The sform, where there is one, else the qform: as most programs choose. Neither: by pixdim.
void takeSpace(const nifti_image& image, const Raw& raw, ArrayHeader& header) {
    const nifti_dmat44* transformation = nullptr;
    // Of a qform they are the lengths; the library takes what is none for 1.
    const bool hasSteps = std::all_of(raw.pixdim.begin() + 1, raw.pixdim.begin() + 4,
                                      [](double d) { return std::isfinite(d) && d != 0; });
    if (image.sform_code > 0 && isTransformation(image.sto_xyz))
        transformation = &image.sto_xyz;
    else if (image.qform_code > 0 && hasSteps && isTransformation(image.qto_xyz))
        transformation = &image.qto_xyz;
    if (!transformation) {
        if (image.sform_code > 0 || image.qform_code > 0)
            header.notes.push_back(
                "placed by pixdim: its sform and qform tell no place in space for each index");
        return;
    }
    header.spaceDimension = 3;
    header.space = "right-anterior-superior";
    header.origin.emplace();
    for (std::size_t c = 0; c < 3; ++c) {
        header.spaceUnits[c] = unitOf(image.xyz_units);
        (*header.origin)[c] = transformation->m[c][3];
        for (std::size_t i = 0; i < 3; ++i) {
            auto& direction = header.axes[i].direction;
            if (!direction) direction.emplace();
            (*direction)[c] = transformation->m[c][i];
        }
    }
}

// Of a pair, the file beside the header.
void takeValues(const nifti_image& image, const Raw& raw, double least, bool isPair, bool packed,
                ArrayHeader& header) {
    header.encoding = packed ? ArrayEncoding::Gzip : ArrayEncoding::Raw;
    header.swapped = header.valueBytes() > 1 && image.byteorder != nifti_short_order();
    // Where nothing is told, right behind the header.
    const double at = !isPair && raw.valuesAt == 0 ? least : raw.valuesAt;
    if (!(at >= (isPair ? 0 : least) && at < 0x1p53) || at != std::floor(at))
        header.fail("vox_offset",
                    fmt::format("expected {} bytes or more, found {}", isPair ? 0 : least, at));
    header.byteSkip = static_cast<std::int64_t>(at);
    if (!isPair) return;
    std::filesystem::path name = header.path.filename();
    if (packed) name.replace_extension();
    name.replace_extension(".img");
    std::error_code ignored;
    const std::string gzipped = name.string() + ".gz";
    const bool exists = std::filesystem::exists(header.path.parent_path() / name, ignored);
    const bool hasPacked = std::filesystem::exists(header.path.parent_path() / gzipped, ignored);
    const bool takesPacked = hasPacked && (packed || !exists);
    header.encoding = takesPacked ? ArrayEncoding::Gzip : ArrayEncoding::Raw;
    header.dataFiles = {takesPacked ? gzipped : name.string()};
}

}  // namespace

bool isNifti(std::string_view start) { return isNifti1(start) || isNifti2(start); }

ArrayHeader readNiftiHeader(const std::filesystem::path& path) {
    ArrayHeader header;
    header.path = path;
    bool packed = false;
    const std::string start = beginningOf(header, packed);
    const bool second = isNifti2(start);
    const auto [image, raw] = second ? readWith(header, start, 540, nifti_convert_n2hdr2nim)
                                     : readWith(header, start, 348, nifti_convert_n1hdr2nim);
    if (!image) header.fail("header", "expected a whole NIfTI header, which the library can read");
    const bool isPair = start[(second ? kMagic2At : kMagicAt) + 1] == 'i';
    header.format = fmt::format("NIfTI-{}{}", second ? 2 : 1, isPair ? ", detached values" : "");
    header.type = typeOf(header, image->datatype);
    takeAxes(*image, raw, header);
    takeSpace(*image, raw, header);
    // Four bytes tell of extensions.
    takeValues(*image, raw, second ? 544 : 352, isPair, packed, header);
    const double slope = image->scl_slope, offset = image->scl_inter;
    if (slope != 0 && std::isfinite(slope) && std::isfinite(offset) && (slope != 1 || offset != 0))
        header.scaling = {slope, offset};
    header.categories =
        image->intent_code == NIFTI_INTENT_LABEL || image->intent_code == NIFTI_INTENT_NEURONAME;
    header.name = {image->intent_name, strnlen(image->intent_name, sizeof image->intent_name)};
    return header;
}

}  // namespace timeseries
