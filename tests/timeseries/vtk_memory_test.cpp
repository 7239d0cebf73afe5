// Memory while VTK files are read. A legacy file's arrays of one FIELD are read together, by VTK.
#include <fmt/format.h>

#include "tests/support/reading_memory.h"
#include "tests/support/vtk_files.h"

namespace timeseries {
namespace {

using namespace tests;

constexpr StepBytes kFloat{4 * kPoints, 4 * kPoints};

// An image with appended raw arrays of so many components at its points.
std::filesystem::path image(const std::string& type, std::uint64_t typeBytes,
                            const std::string& byteOrder,
                            const std::vector<std::size_t>& components) {
    const std::string extent = fmt::format("0 {0} 0 {0} 0 {0}", kSide - 1);
    std::string head = fmt::format(
        "<VTKFile type=\"ImageData\" header_type=\"UInt64\" byte_order=\"{}\">\n"
        "<ImageData WholeExtent=\"{}\"><Piece Extent=\"{}\"><PointData>\n",
        byteOrder, extent, extent);
    std::vector<std::uint64_t> offsets{0};
    for (const std::size_t count : components) {
        head += fmt::format(
            "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
            "offset=\"{}\"/>\n",
            type, offsets.size(), count, offsets.back());
        offsets.push_back(offsets.back() + 8 + count * typeBytes * kPoints);
    }
    head += "</PointData></Piece></ImageData><AppendedData encoding=\"raw\">_";
    const auto path = testFolder() / "file.vti";
    writeHollow(path, head, offsets.back());
    // Each array's length, before it.
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    for (std::size_t i = 0; i < components.size(); ++i) {
        const std::vector<std::uint64_t> length{offsets[i + 1] - offsets[i] - 8};
        file.seekp(static_cast<std::streamoff>(head.size() + offsets[i]));
        file << (byteOrder == "BigEndian" ? bigEndianBytes(length) : rawBytes(length));
    }
    return path;
}

TEST(ReadingMemory, OfVtkImagesIsTwiceAnArrayAtMost) {
    expectTwiceAtMost(image("Float32", 4, "LittleEndian", {1}), kFloat);
    expectTwiceAtMost(image("Float32", 4, "BigEndian", {1, 1, 1}), kFloat, 1);
    // Magnitudes, and a component.
    expectTwiceAtMost(image("UInt8", 1, "LittleEndian", {3}), {3 * kPoints, 8 * kPoints});
    expectTwiceAtMost(image("Float32", 4, "LittleEndian", {3}), {12 * kPoints, 4 * kPoints}, 2);
}

// An image whose only array stands in the XML in base64, as `unit` again and again behind `first`.
std::filesystem::path inlined(const std::string& first, const std::string& unit,
                              std::uint64_t units) {
    const std::string extent = fmt::format("0 {0} 0 {0} 0 {0}", kSide - 1);
    const auto path = testFolder() / "file.vti";
    std::ofstream file(path, std::ios::binary);
    file << fmt::format(
        "<VTKFile type=\"ImageData\" header_type=\"UInt64\" byte_order=\"LittleEndian\">\n"
        "<ImageData WholeExtent=\"{0}\"><Piece Extent=\"{0}\"><PointData>\n"
        "<DataArray type=\"Float32\" Name=\"a\" format=\"binary\">{1}",
        extent, first);
    for (std::uint64_t i = 0; i < units; ++i) file << unit;
    file << "</DataArray></PointData></Piece></ImageData></VTKFile>\n";
    return path;
}

TEST(ReadingMemory, OfVtkValuesInBase64IsTwiceTheirTextAtMost) {
    // The length and the values are encoded together: six bytes that begin with the length, zeros.
    static_assert(kFloat.stored == std::uint64_t{4} << 24 && (8 + kFloat.stored) % 3 == 0);
    const std::uint64_t quads = (8 + kFloat.stored) / 3;
    expectTwiceAtMost(inlined("AAAABAAA", "AAAA", quads - 2), {4 * quads, kFloat.values});
}

// A cube in slabs, which all name the first one's values: few bytes that stand for many.
TEST(ReadingMemory, OfVtkPiecesThatNameTheSameValuesIsThatOfTheFile) {
    constexpr std::size_t kThick = 8;
    constexpr std::uint64_t kSlab = 4 * kSide * kSide * kThick;
    std::string head = fmt::format(
        "<VTKFile type=\"ImageData\" header_type=\"UInt64\" byte_order=\"LittleEndian\">\n"
        "<ImageData WholeExtent=\"0 {0} 0 {0} 0 {0}\">",
        kSide - 1);
    for (std::size_t z = 0; z < kSide; z += kThick)
        head += fmt::format(
            "<Piece Extent=\"0 {0} 0 {0} {1} {2}\"><PointData><DataArray type=\"Float32\" "
            "Name=\"a\" format=\"appended\" offset=\"0\"/></PointData></Piece>\n",
            kSide - 1, z, z + kThick - 1);
    head += "</ImageData><AppendedData encoding=\"raw\">_" + rawBytes(std::vector{kSlab});
    const auto path = testFolder() / "file.vti";
    writeHollow(path, head, kSlab);
    const std::uint64_t nothing = residentPeak([] {});
    const std::uint64_t reading = residentPeak([&] {
        try {
            openReader(std::span(&path, 1))->read(0, 0);
            _exit(1);
        } catch (const FileError& error) {
            if (!std::string_view(error.what())
                     .ends_with(fmt::format("{} bytes in a file of {}", 2 * (8 + kSlab),
                                            head.size() + kSlab)))
                _exit(2);
        }
    });
    EXPECT_LE(reading - std::min(nothing, reading), 2 * kSlab + (std::uint64_t{14} << 20));
}

// Each array's heading, and behind it the values of a float a point.
std::filesystem::path legacy(const std::vector<std::string>& headings) {
    std::string head = fmt::format(
        "# vtk DataFile Version 3.0\nhollow\nBINARY\nDATASET STRUCTURED_POINTS\n"
        "DIMENSIONS {0} {0} {0}\nPOINT_DATA {1}\n",
        kSide, kPoints);
    const auto path = testFolder() / "file.vtk";
    writeHollow(path, head, 0);
    for (const std::string& heading : headings) {
        std::ofstream(path, std::ios::app) << heading;
        std::filesystem::resize_file(path, std::filesystem::file_size(path) + kFloat.stored);
        std::ofstream(path, std::ios::app) << '\n';
    }
    return path;
}

TEST(ReadingMemory, OfLegacyVtkIsTwiceAnArrayOrAFieldAtMost) {
    const std::string table = " float 1\nLOOKUP_TABLE default\n";
    expectTwiceAtMost(legacy({"SCALARS a" + table}), kFloat);
    expectTwiceAtMost(legacy({"SCALARS a" + table, "SCALARS b" + table, "SCALARS c" + table}),
                      kFloat, 1);
    const std::string array = fmt::format(" 1 {} float\n", kPoints);
    expectTwiceAtMost(legacy({"FIELD all 3\na" + array, "b" + array, "c" + array}),
                      {3 * kFloat.stored, kFloat.values}, 1);
}

}  // namespace
}  // namespace timeseries
