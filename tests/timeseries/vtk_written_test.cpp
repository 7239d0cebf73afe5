// Files as VTK's own writers make them, in every form that they have: encodings, compressors, byte
// orders, widths of the block headers.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkRectilinearGrid.h>
#include <vtkRectilinearGridWriter.h>
#include <vtkShortArray.h>
#include <vtkStructuredGrid.h>
#include <vtkStructuredGridWriter.h>
#include <vtkStructuredPointsWriter.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLRectilinearGridWriter.h>
#include <vtkXMLStructuredGridWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <array>

#include "tests/support/files.h"
#include "tests/support/rounds.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

constexpr std::array<int, 3> kPoints{11, 7, 5};
constexpr std::size_t kPointCount = 11 * 7 * 5, kCellCount = 10 * 6 * 4;

// What the arrays hold at point or cell i; short in decimals, so that text is exact too.
float f(std::size_t i) { return 0.25f * static_cast<float>(i) - 3; }
double v(std::size_t i, std::size_t c) { return 1e6 * static_cast<double>(c + 1) + 0.5 * f(i); }
std::int16_t s(std::size_t i) { return static_cast<std::int16_t>(7 * i - 1000); }
std::int64_t c(std::size_t i) { return (std::int64_t{1} << 60) + static_cast<std::int64_t>(i); }

template <typename Array, typename Value>
void add(vtkDataSetAttributes& attributes, const char* name, int components, std::size_t tuples,
         Value value) {
    const vtkNew<Array> array;
    array->SetName(name);
    array->SetNumberOfComponents(components);
    for (std::size_t i = 0; i < tuples; ++i)
        for (int k = 0; k < components; ++k)
            array->InsertNextValue(value(i, static_cast<std::size_t>(k)));
    attributes.AddArray(array);
}

void addArrays(vtkDataSet& data) {
    add<vtkFloatArray>(*data.GetPointData(), "f", 1, kPointCount,
                       [](std::size_t i, std::size_t) { return f(i); });
    add<vtkDoubleArray>(*data.GetPointData(), "v", 3, kPointCount, v);
    add<vtkShortArray>(*data.GetPointData(), "s", 1, kPointCount,
                       [](std::size_t i, std::size_t) { return s(i); });
    add<vtkTypeInt64Array>(*data.GetCellData(), "c", 1, kCellCount,
                           [](std::size_t i, std::size_t) { return c(i); });
}

vtkNew<vtkImageData> image() {
    vtkNew<vtkImageData> data;
    data->SetDimensions(kPoints.data());
    data->SetOrigin(1, 2, 3);
    data->SetSpacing(0.5, 2, 4);
    addArrays(*data);
    return data;
}

std::vector<double> coordinatesOf(std::size_t axis) {
    std::vector<double> coordinates;
    for (int i = 0; i < kPoints[axis]; ++i)
        coordinates.push_back(i * i + 10 * static_cast<double>(axis));
    return coordinates;
}

vtkNew<vtkRectilinearGrid> rectilinear() {
    vtkNew<vtkRectilinearGrid> data;
    data->SetDimensions(kPoints.data());
    std::array<vtkNew<vtkDoubleArray>, 3> axes;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const double x : coordinatesOf(axis)) axes[axis]->InsertNextValue(x);
    data->SetXCoordinates(axes[0]);
    data->SetYCoordinates(axes[1]);
    data->SetZCoordinates(axes[2]);
    addArrays(*data);
    return data;
}

// In halves and quarters, which text and floats hold exactly.
glm::dvec3 placeOf(std::size_t i, std::size_t j, std::size_t k) {
    const auto at = glm::dvec3(i, j, k);
    return {at.x + 0.5 * at.y, 2 * at.y - 0.25 * at.z * at.x, 3 * at.z + 0.25 * at.y * at.y};
}

vtkNew<vtkStructuredGrid> structured() {
    const vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (std::size_t k = 0; k < 5; ++k)
        for (std::size_t j = 0; j < 7; ++j)
            for (std::size_t i = 0; i < 11; ++i) {
                const glm::dvec3 at = placeOf(i, j, k);
                points->InsertNextPoint(at.x, at.y, at.z);
            }
    vtkNew<vtkStructuredGrid> data;
    data->SetDimensions(kPoints.data());
    data->SetPoints(points);
    addArrays(*data);
    return data;
}

// The same points along straight lines, and bricks of them: hexahedra, voxels and polyhedra.
glm::dvec3 straightPlace(std::size_t i, std::size_t j, std::size_t k) {
    const auto at = glm::dvec3(i, j, k);
    return {at.x + 0.5 * at.y, 2 * at.y - 0.25 * at.z, 3 * at.z};
}

vtkNew<vtkUnstructuredGrid> unstructured() {
    const vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    const auto index = [](std::size_t i, std::size_t j, std::size_t k) {
        return static_cast<vtkIdType>(i + 11 * (j + 7 * k));
    };
    for (std::size_t k = 0; k < 5; ++k)
        for (std::size_t j = 0; j < 7; ++j)
            for (std::size_t i = 0; i < 11; ++i) {
                const glm::dvec3 at = straightPlace(i, j, k);
                points->InsertPoint(index(i, j, k), at.x, at.y, at.z);
            }
    vtkNew<vtkUnstructuredGrid> data;
    data->SetPoints(points);
    for (std::size_t n = 0; n < kCellCount; ++n) {
        const std::size_t i = n % 10, j = n / 10 % 6, k = n / 60;
        std::array<vtkIdType, 8> c;
        for (std::size_t corner = 0; corner < 8; ++corner)
            c[corner] = index(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2));
        if (n % 3 == 1) {
            data->InsertNextCell(VTK_VOXEL, 8, c.data());
        } else if (n % 3 == 0) {
            std::swap(c[2], c[3]);
            std::swap(c[6], c[7]);
            data->InsertNextCell(VTK_HEXAHEDRON, 8, c.data());
        } else {
            const std::array<vtkIdType, 30> faces{
                4, c[0], c[2], c[3], c[1], 4, c[4], c[5], c[7], c[6], 4, c[0], c[1], c[5], c[4],
                4, c[2], c[6], c[7], c[3], 4, c[0], c[4], c[6], c[2], 4, c[1], c[3], c[7], c[5]};
            data->InsertNextCell(VTK_POLYHEDRON, 8, c.data(), 6, faces.data());
        }
    }
    addArrays(*data);
    return data;
}

enum class Kind { Image, Rectilinear, Structured, Unstructured };

// Floats hold a place to a 2^24th of the mesh's extent.
void expectNear(const glm::dvec3& found, const glm::dvec3& expected) {
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(found[c], expected[c], 2e-6);
}

void expectPlaces(const Grid& points, const Grid& cells) {
    ASSERT_TRUE(points.mesh() && cells.mesh());
    EXPECT_EQ(points.size(), (std::array<std::size_t, 3>{11, 7, 5}));
    EXPECT_EQ(cells.size(), (std::array<std::size_t, 3>{10, 6, 4}));
    for (std::uint64_t n = 0; n < points.count(); ++n) {
        const auto at = points.indices(n);
        expectNear(points.position(n), placeOf(at.x, at.y, at.z));
    }
    for (std::uint64_t n = 0; n < cells.count(); ++n) {
        const auto at = cells.indices(n);
        glm::dvec3 middle(0);
        for (unsigned c = 0; c < 8; ++c)
            middle += placeOf(at.x + (c & 1), at.y + (c >> 1 & 1), at.z + (c >> 2)) / 8.0;
        expectNear(cells.position(n), middle);
    }
}

void expectCells(const Grid& points, const Grid& cells) {
    ASSERT_TRUE(points.mesh() && cells.mesh());
    EXPECT_EQ(points.size(), (std::array<std::size_t, 3>{kPointCount, 1, 1}));
    EXPECT_EQ(cells.size(), (std::array<std::size_t, 3>{kCellCount, 1, 1}));
    for (std::size_t n = 0; n < kPointCount; ++n)
        expectNear(points.position(n), straightPlace(n % 11, n / 11 % 7, n / 77));
    for (std::size_t n = 0; n < kCellCount; ++n) {
        const glm::dvec3 lo = straightPlace(n % 10, n / 10 % 6, n / 60),
                         hi = straightPlace(n % 10 + 1, n / 10 % 6 + 1, n / 60 + 1);
        expectNear(cells.position(n), 0.5 * (lo + hi));
        EXPECT_NEAR(std::abs(cells.mesh()->cell(n).determinant()), 6, 1e-5);
    }
}

template <typename T, typename Value>
void expectValues(Reader& reader, const std::string& name, Value value) {
    const auto variables = reader.variables();
    const auto found = std::ranges::find(variables, name, &Variable::name);
    ASSERT_NE(found, variables.end()) << name;
    const Field field = reader.read(static_cast<std::size_t>(found - variables.begin()), 0);
    const auto& values = std::get<std::vector<T>>(field.values);
    for (std::size_t i = 0; i < values.size(); ++i)
        ASSERT_EQ(values[i], value(i)) << name << " at " << i;
    EXPECT_EQ(values.size(), field.grid->count());
}

void expectWhole(const std::filesystem::path& path, Kind kind) {
    const auto reader = openReader(std::span(&path, 1));
    expectValues<float>(*reader, "f", f);
    for (std::size_t k = 0; k < 3; ++k)
        expectValues<double>(*reader, fmt::format("v[{}]", k),
                             [&](std::size_t i) { return v(i, k); });
    expectValues<std::int16_t>(*reader, "s", s);
    expectValues<std::int64_t>(*reader, "c", c);
    const auto variables = reader->variables();
    const Grid& grid = *std::ranges::find(variables, "f", &Variable::name)->grid;
    if (kind == Kind::Structured)
        return expectPlaces(grid, *std::ranges::find(variables, "c", &Variable::name)->grid);
    if (kind == Kind::Unstructured)
        return expectCells(grid, *std::ranges::find(variables, "c", &Variable::name)->grid);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto& found = grid.axes()[axis].coordinates;
        if (kind == Kind::Rectilinear) {
            EXPECT_EQ(found, coordinatesOf(axis));
            continue;
        }
        EXPECT_EQ(found[0], static_cast<double>(axis) + 1);
        EXPECT_EQ(found[2] - found[0], (std::array{1.0, 4.0, 8.0}[axis]));
    }
}

// Attributes of the file say each; block is the bytes that are compressed at a time.
struct Form {
    const char *mode, *encoding, *compressor, *order, *width;
    std::size_t block;
};

std::vector<Form> formsOf(Kind kind) {
    std::vector<Form> forms;
    for (const char* compressor :
         {"", "vtkZLibDataCompressor", "vtkLZ4DataCompressor", "vtkLZMADataCompressor"})
        for (const char* order : {"LittleEndian", "BigEndian"})
            for (const char* width : {"UInt32", "UInt64"})
                for (const std::size_t block : {256, 1 << 30}) {  // several, and one in part
                    for (const char* encoding : {"raw", "base64"})
                        forms.push_back({"appended", encoding, compressor, order, width, block});
                    for (const char* mode : {"ascii", "binary"})
                        forms.push_back({mode, "", compressor, order, width, block});
                }
    // Of each kind of file another third; sanitized, where each takes twenty times as long, every
    // thirty-first.
    const std::size_t stride = tests::kSanitized ? 31 : 3;
    std::vector<Form> some;
    for (auto i = static_cast<std::size_t>(kind) % stride; i < forms.size(); i += stride)
        some.push_back(forms[i]);
    return some;
}

void apply(const Form& form, vtkXMLWriter& writer) {
    const std::string mode = form.mode, compressor = form.compressor;
    writer.SetDataMode(mode == "ascii"    ? vtkXMLWriter::Ascii
                       : mode == "binary" ? vtkXMLWriter::Binary
                                          : vtkXMLWriter::Appended);
    writer.SetEncodeAppendedData(form.encoding == std::string("base64"));
    writer.SetCompressorType(compressor.empty()                      ? vtkXMLWriter::NONE
                             : compressor == "vtkZLibDataCompressor" ? vtkXMLWriter::ZLIB
                             : compressor == "vtkLZ4DataCompressor"  ? vtkXMLWriter::LZ4
                                                                     : vtkXMLWriter::LZMA);
    writer.SetByteOrder(form.order == std::string("BigEndian") ? vtkXMLWriter::BigEndian
                                                               : vtkXMLWriter::LittleEndian);
    writer.SetHeaderType(form.width == std::string("UInt64") ? vtkXMLWriter::UInt64
                                                             : vtkXMLWriter::UInt32);
    writer.SetBlockSize(form.block);
}

// That the writer did as it was told.
void expectForm(const Form& form, const std::string& bytes) {
    for (const auto& [attribute, value] :
         {std::pair{"format", form.mode}, std::pair{"encoding", form.encoding},
          std::pair{"compressor", form.compressor}, std::pair{"byte_order", form.order},
          std::pair{"header_type", form.width}}) {
        const bool there = bytes.find(fmt::format(" {}=\"{}\"", attribute, value)) != bytes.npos;
        EXPECT_EQ(there, *value != '\0') << attribute;
    }
}

template <typename Writer, typename Data>
void expectWhatVtkWrites(Data& data, const std::string& ending, Kind kind) {
    const auto path = tests::freshFolder() / ("file" + ending);
    for (const Form& form : formsOf(kind)) {
        SCOPED_TRACE(fmt::format("{} {} {} {} {} {}", form.mode, form.encoding, form.compressor,
                                 form.order, form.width, form.block));
        const vtkNew<Writer> writer;
        writer->SetFileName(path.c_str());
        writer->SetInputData(&data);
        apply(form, *writer);
        ASSERT_EQ(writer->Write(), 1);
        expectForm(form, tests::readBytes(path));
        expectWhole(path, kind);
    }
}

TEST(VtkWritten, ImagesInEveryFormOfXmlAreRead) {
    expectWhatVtkWrites<vtkXMLImageDataWriter>(*image(), ".vti", Kind::Image);
}

// The length stands before the values; the first digit is a quarter of it.
TEST(VtkWritten, LengthsOfEveryDigitOfBase64AreRead) {
    const auto path = tests::freshFolder() / "file.vti";
    for (int bytes = 4; bytes < 256; bytes += 4) {
        const vtkNew<vtkImageData> row;
        row->SetDimensions(bytes, 1, 1);
        row->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
        row->GetPointData()->GetScalars()->Fill(7);
        const vtkNew<vtkXMLImageDataWriter> writer;
        writer->SetFileName(path.c_str());
        writer->SetInputData(row);
        writer->SetDataModeToBinary();
        writer->SetCompressorTypeToNone();
        ASSERT_EQ(writer->Write(), 1);
        EXPECT_EQ(openReader(std::span(&path, 1))->read(0, 0).grid->count(),
                  static_cast<std::uint64_t>(bytes));
    }
}

TEST(VtkWritten, RectilinearGridsInEveryFormOfXmlAreRead) {
    expectWhatVtkWrites<vtkXMLRectilinearGridWriter>(*rectilinear(), ".vtr", Kind::Rectilinear);
}

TEST(VtkWritten, StructuredGridsInEveryFormOfXmlAreRead) {
    expectWhatVtkWrites<vtkXMLStructuredGridWriter>(*structured(), ".vts", Kind::Structured);
}

TEST(VtkWritten, UnstructuredGridsInEveryFormOfXmlAreRead) {
    expectWhatVtkWrites<vtkXMLUnstructuredGridWriter>(*unstructured(), ".vtu", Kind::Unstructured);
}

template <typename Writer, typename Data>
void expectWhatVtkWritesAsLegacy(Data& data, Kind kind) {
    const auto path = tests::freshFolder() / "file.vtk";
    for (const int type : {VTK_ASCII, VTK_BINARY})
        for (const int version : {vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2,
                                  vtkDataWriter::VTK_LEGACY_READER_VERSION_5_1}) {
            SCOPED_TRACE(fmt::format("type {}, version {}", type, version));
            const vtkNew<Writer> writer;
            writer->SetFileName(path.c_str());
            writer->SetInputData(&data);
            writer->SetFileType(type);
            writer->SetFileVersion(version);
            ASSERT_EQ(writer->Write(), 1);
            expectWhole(path, kind);
        }
}

TEST(VtkWritten, LegacyFilesAreRead) {
    expectWhatVtkWritesAsLegacy<vtkStructuredPointsWriter>(*image(), Kind::Image);
    expectWhatVtkWritesAsLegacy<vtkRectilinearGridWriter>(*rectilinear(), Kind::Rectilinear);
    expectWhatVtkWritesAsLegacy<vtkStructuredGridWriter>(*structured(), Kind::Structured);
    expectWhatVtkWritesAsLegacy<vtkUnstructuredGridWriter>(*unstructured(), Kind::Unstructured);
}

}  // namespace
}  // namespace timeseries
