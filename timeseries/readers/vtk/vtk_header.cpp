#include "timeseries/readers/vtk/vtk_header.h"

#include <fmt/format.h>

#include <algorithm>

#include "timeseries/grid/with_type.h"
#include "timeseries/readers/limits.h"
#include "timeseries/readers/vtk/vtk_number.h"

namespace timeseries {
namespace {

// So that no sum of an index and a length overflows VTK's int.
constexpr std::int64_t kMaxIndex = std::int64_t{1} << 30;

// char is signed where we build; VTK writes its ids (vtkIdType) to legacy files as 32 bits.
constexpr std::array kTypes{
    VtkType{"Int8", "char", ValueType::I8, 1},
    VtkType{"Int8", "signed_char", ValueType::I8, 1},
    VtkType{"UInt8", "unsigned_char", ValueType::U8, 1},
    VtkType{"Int16", "short", ValueType::I16, 2},
    VtkType{"UInt16", "unsigned_short", ValueType::U16, 2},
    VtkType{"Int32", "int", ValueType::I32, 4},
    VtkType{"UInt32", "unsigned_int", ValueType::U32, 4},
    VtkType{"Int64", "long", ValueType::I64, 8},
    VtkType{"UInt64", "unsigned_long", ValueType::U64, 8},
    VtkType{"Int64", "vtktypeint64", ValueType::I64, 8},
    VtkType{"UInt64", "vtktypeuint64", ValueType::U64, 8},
    VtkType{"", "vtkidtype", ValueType::I64, 4},
    VtkType{"Float32", "float", ValueType::F32, 4},
    VtkType{"Float64", "double", ValueType::F64, 8},
};
static_assert(static_cast<char>(-1) < 0 && sizeof(long) == 8);

}  // namespace

std::string vtkSentence(const std::filesystem::path& path, std::string_view place,
                        std::string_view what) {
    std::string sentence =
        fmt::format("{}: {}{}{}", path.string(), place, place.empty() ? "" : ": ", what);
    for (char& c : sentence)
        if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
    return sentence;
}

void failVtk(const std::filesystem::path& path, std::string_view place, std::string_view what) {
    throw FileError(vtkSentence(path, place, what));
}

const VtkType* vtkXmlType(std::string_view name) {
    const auto found = std::ranges::find(kTypes, name, &VtkType::xml);
    return name.empty() || found == kTypes.end() ? nullptr : &*found;
}

const VtkType* vtkLegacyType(std::string_view lowerCase) {
    const auto found = std::ranges::find(kTypes, lowerCase, &VtkType::legacy);
    return found == kTypes.end() ? nullptr : &*found;
}

bool isVtkNumber(ValueType type, std::string_view text) {
    return withType(type, [&]<typename T>(T) { return vtkNumber<T>(text).has_value(); });
}

bool isVtkGhostName(std::string_view name) {
    return name == "vtkGhostType" || name == "vtkGhostLevels";
}

std::optional<std::string> vtkTimeName(std::string_view arrayName) {
    if (arrayName == "TimeValue" || arrayName == "TIME" || arrayName == "Time") return "time";
    if (arrayName == "TimeStep" || arrayName == "CYCLE") return std::string(arrayName);
    return std::nullopt;
}

TimeAxis vtkTimeAxisOf(const std::optional<VtkTime>& time) {
    if (!time) return {"step", "", "", {{0, ""}}, true};
    return {time->name, "", "", {{time->value, ""}}};
}

std::array<std::uint64_t, 3> VtkHeader::size(VtkPlace place) const {
    std::array<std::uint64_t, 3> size{};
    if (isUnstructured(kind)) {
        size[1] = size[2] = 1;
        for (const VtkPiece& piece : pieces)
            size[0] += place == VtkPlace::Points ? piece.points : piece.cells;
        return size;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        size[i] = static_cast<std::uint64_t>(extent[i][1] - extent[i][0] + 1);
        // An axis of one point is one cell thick.
        if (place == VtkPlace::Cells && size[i] > 1) --size[i];
    }
    return size;
}

std::uint64_t VtkHeader::count(VtkPlace place) const {
    const auto n = size(place);
    return n[0] * n[1] * n[2];
}

void checkVtkExtent(const VtkHeader& header, std::string_view place) {
    std::uint64_t points = 1;
    for (const auto& [first, last] : header.extent) {
        if (first < -kMaxIndex || last > kMaxIndex || last < first)
            failVtk(header.path, place,
                    fmt::format("expected {} along each axis, found the indices {} to {}",
                                last < first ? "at least one point"
                                             : fmt::format("indices from {} to {} at most",
                                                           -kMaxIndex, kMaxIndex),
                                first, last));
        const auto length = static_cast<std::uint64_t>(last - first + 1);
        if (length > kMaxAxis)
            failVtk(header.path, place,
                    fmt::format("expected at most 2^24 points along an axis, found {}", length));
        points *= length;  // at most 2^32 * 2^24
        if (points > kMaxPoints)
            failVtk(header.path, place, "expected at most 2^32 points, found more");
    }
}

void checkVtkCount(const VtkHeader& header, std::string_view place) {
    for (const VtkPlace of : {VtkPlace::Points, VtkPlace::Cells})
        if (header.count(of) >= kMaxPoints)
            failVtk(header.path, place, "expected fewer than 2^32 points and cells, found more");
}

}  // namespace timeseries
