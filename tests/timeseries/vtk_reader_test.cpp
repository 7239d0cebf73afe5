// VTK files, written by hand: what they hold and where it lies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numeric>

#include "tests/support/read_variables.h"
#include "tests/support/vtk_files.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using tests::bigEndianBytes;
using tests::dataArray;
using tests::Image;
using tests::imageText;
using tests::indexOf;
using tests::namesOf;
using tests::valuesOf;
using Path = std::filesystem::path;

std::unique_ptr<Reader> openText(const std::string& text) {
    const Path path = tests::write("file", text);
    return openReader(std::span(&path, 1));
}

const Variable& variableOf(const Reader& reader, std::string_view name) {
    return reader.variables()[indexOf(reader, name)];
}

template <typename T>
std::vector<T> upTo(std::size_t count) {
    std::vector<T> values(count);
    std::iota(values.begin(), values.end(), T{0});
    return values;
}

TEST(VtkImage, PointsAndCellsAreVariablesOnTheirOwnGrids) {
    const auto reader =
        openText(imageText({.points = dataArray("Float32", "p", upTo<float>(12)) +
                                      dataArray("Int16", "both", upTo<std::int16_t>(12)),
                            .cells = dataArray("UInt8", "both", std::vector<std::uint8_t>{7, 9})}));
    EXPECT_EQ(reader->format(), "VTK image data (XML)");
    EXPECT_THAT(namesOf(*reader), ElementsAre("p", "both (points)", "both (cells)"));
    const auto& axes = variableOf(*reader, "p").grid->axes();
    EXPECT_THAT(axes[0].coordinates, ElementsAre(10, 11, 12));
    EXPECT_THAT(axes[1].coordinates, ElementsAre(20, 22));
    EXPECT_THAT(axes[2].coordinates, ElementsAre(30, 33));
    EXPECT_EQ(valuesOf<float>(*reader, "p"), upTo<float>(12));
    EXPECT_EQ(valuesOf<std::int16_t>(*reader, "both (points)"), upTo<std::int16_t>(12));

    const auto& centres = variableOf(*reader, "both (cells)").grid->axes();
    EXPECT_THAT(centres[0].coordinates, ElementsAre(10.5, 11.5));
    EXPECT_THAT(centres[1].coordinates, ElementsAre(21));
    EXPECT_THAT(centres[2].coordinates, ElementsAre(31.5));
    EXPECT_THAT(valuesOf<std::uint8_t>(*reader, "both (cells)"), ElementsAre(7, 9));
    EXPECT_EQ(variableOf(*reader, "both (cells)").storedAs, "uint8, at cells");
}

template <typename T>
class VtkTypes : public testing::Test {};
using AllTypes =
    testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::uint32_t,
                   std::int32_t, std::uint64_t, std::int64_t, float, double>;
TYPED_TEST_SUITE(VtkTypes, AllTypes);

constexpr std::array kXmlNames{"UInt8", "Int8",   "UInt16", "Int16",   "UInt32",
                               "Int32", "UInt64", "Int64",  "Float32", "Float64"};
constexpr std::array kLegacyNames{"unsigned_char", "char",  "unsigned_short", "short",
                                  "unsigned_int",  "int",   "vtktypeuint64",  "vtktypeint64",
                                  "float",         "double"};

// Each type's extremes, and neighbours that a double would not tell apart.
template <typename T>
std::vector<T> extremes() {
    const T lo = std::numeric_limits<T>::lowest(), hi = std::numeric_limits<T>::max();
    if constexpr (std::is_integral_v<T>)
        return {lo, static_cast<T>(lo + 1), 0, 1, 2, 3, 4, 5, 6, 7, static_cast<T>(hi - 1), hi};
    return {lo, 1, T(1) / 3, 2, 3, 4, 5, 6, 7, std::numeric_limits<T>::denorm_min(), hi, 0};
}

TYPED_TEST(VtkTypes, AreExactInTextAndInBytes) {
    const std::vector<TypeParam> values = extremes<TypeParam>();
    const auto type = Values(values).index();
    const std::string name = kXmlNames[type];
    const auto text = openText(imageText({.points = dataArray(name, "v", values)}));
    EXPECT_EQ(valuesOf<TypeParam>(*text, "v"), values);
    EXPECT_EQ(static_cast<std::size_t>(text->variables()[0].type), type);

    const auto raw = openText(imageText(
        {.points = fmt::format(
             "<DataArray type=\"{}\" Name=\"v\" format=\"appended\" offset=\"0   \"/>", name),
         .appended = tests::appendedBlock(values)}));
    EXPECT_EQ(valuesOf<TypeParam>(*raw, "v"), values);

    const std::string start =
        "DATASET STRUCTURED_POINTS\nDIMENSIONS 3 2 2\nSPACING 1 2 3\nORIGIN 10 20 30\n"
        "POINT_DATA 12\nSCALARS v " +
        std::string(kLegacyNames[type]) + " 1\nLOOKUP_TABLE default\n";
    const auto binary = openText("# vtk DataFile Version 4.2\ntitle\nBINARY\n" + start +
                                 bigEndianBytes(values) + "\n");
    EXPECT_EQ(valuesOf<TypeParam>(*binary, "v"), values);
    EXPECT_EQ(*binary->variables()[0].grid, *raw->variables()[0].grid);
    std::string numbers;
    for (const TypeParam value : values) numbers += fmt::format("{}\n", +value);
    const auto ascii = openText("# vtk DataFile Version 4.2\ntitle\nASCII\n" + start + numbers);
    EXPECT_EQ(valuesOf<TypeParam>(*ascii, "v"), values);
}

TEST(VtkImage, VectorsAreMagnitudeAndComponents) {
    std::vector<float> vectors;
    for (int i = 0; i < 12; ++i) {
        const auto f = static_cast<float>(i);
        vectors.insert(vectors.end(), {3 * f, -4 * f, 12 * f});
    }
    const auto reader =
        openText(imageText({.points = dataArray("Float32", "V", vectors, 3) +
                                      dataArray("Int32", "I", std::vector<int>(24, 2), 2) +
                                      dataArray("Float64", "T", upTo<double>(108), 9)}));
    EXPECT_EQ(reader->variables().size(), 4u + 3 + 9);
    EXPECT_THAT(namesOf(*reader)[1], "V[0]");
    EXPECT_EQ(variableOf(*reader, "V magnitude").storedAs,
              "float32, 3 components; magnitude in float32");
    std::vector<float> lengths, second;
    for (int i = 0; i < 12; ++i) {
        lengths.push_back(13 * static_cast<float>(i));  // 3, 4, 12: a Pythagorean quadruple
        second.push_back(-4 * static_cast<float>(i));
    }
    const auto found = valuesOf<float>(*reader, "V magnitude");
    for (std::size_t i = 0; i < 12; ++i) EXPECT_FLOAT_EQ(found[i], lengths[i]);
    EXPECT_EQ(valuesOf<float>(*reader, "V[1]"), second);
    EXPECT_DOUBLE_EQ(valuesOf<double>(*reader, "I magnitude")[5], std::sqrt(8.0));
    EXPECT_EQ(valuesOf<double>(*reader, "T[8]")[11], 107);
}

TEST(VtkImage, MagnitudesNeitherOverflowNorVanish) {
    std::vector<double> vectors(24, 0.0);
    vectors[0] = vectors[1] = 1e300;
    vectors[2] = vectors[3] = 3e-320;
    const auto reader = openText(imageText({.points = dataArray("Float64", "V", vectors, 2)}));
    const auto lengths = valuesOf<double>(*reader, "V magnitude");
    EXPECT_DOUBLE_EQ(lengths[0], 1e300 * std::sqrt(2.0));
    EXPECT_NEAR(lengths[1] / 3e-320, std::sqrt(2.0), 1e-3);
    EXPECT_EQ(lengths[2], 0);
}

TEST(VtkImage, GhostAndBlankedPointsAndCellsAreMissing) {
    // Duplicate 1, hidden 2 (points); refined 8, hidden 32 (cells); 16 (exterior) is shown.
    const auto reader = openText(
        imageText({.points = dataArray("Float32", "p", upTo<float>(12)) +
                             dataArray("UInt8", "vtkGhostType",
                                       std::vector<int>{1, 2, 3, 0, 0, 0, 0, 0, 0, 0, 0, 4}),
                   .cells = dataArray("Float32", "c", upTo<float>(2)) +
                            dataArray("UInt8", "vtkGhostType", std::vector<int>{32, 16})}));
    EXPECT_THAT(namesOf(*reader), ElementsAre("p", "c"));
    EXPECT_EQ(reader->variables()[0].missing, "ghost and blanked, by vtkGhostType");
    std::vector<bool> points(12, false);
    points[0] = points[1] = points[2] = true;
    for (const std::size_t i : {3, 6, 9}) points[i] = true;  // at x = 0, of the hidden cell alone
    EXPECT_EQ(reader->read(0, 0).missing, points);
    EXPECT_EQ(reader->read(1, 0).missing, (std::vector<bool>{true, false}));
}

TEST(VtkImage, FieldDataOfOneNumberTellsTheTime) {
    const auto field = [](const std::string& name, const std::string& value) {
        return "<DataArray type=\"Float64\" Name=\"" + name +
               "\" NumberOfTuples=\"1\" format=\"ascii\">" + value + "</DataArray>\n";
    };
    const std::string points = dataArray("Float32", "p", upTo<float>(12));
    const auto time = [&](const std::string& fields) {
        return *openText(imageText({.points = points, .field = fields}))->variables()[0].time;
    };
    EXPECT_EQ(time(field("TimeStep", "30") + field("TimeValue", "0.1")).name, "time");
    EXPECT_EQ(time(field("TimeStep", "30") + field("TimeValue", "0.1")).points[0].value, 0.1);
    EXPECT_EQ(time(field("TimeStep", "30")).name, "TimeStep");
    EXPECT_EQ(time(field("TimeStep", "30")).points[0].value, 30);
    EXPECT_EQ(time(field("Other", "30")).name, "step");
}

TEST(VtkImage, RightAnglesTurnTheValuesAndOtherDirectionsTheGrid) {
    const std::string points = dataArray("Float32", "p", upTo<float>(12));
    const auto turned = [&](const std::string& direction) {
        return openText(imageText(
            {.attributes = "Origin=\"10 20 30\" Spacing=\"1 2 3\" Direction=\"" + direction + "\"",
             .points = points}));
    };
    // The index x runs along -y, y along x.
    const auto quarter = turned("0 1 0 -1 0 0 0 0 1");
    const Grid& grid = *quarter->variables()[0].grid;
    EXPECT_THAT(grid.axes()[0].coordinates, ElementsAre(10, 12));
    EXPECT_THAT(grid.axes()[1].coordinates, ElementsAre(20, 19, 18));
    EXPECT_THAT(grid.axes()[2].coordinates, ElementsAre(30, 33));
    const auto values = valuesOf<float>(*quarter, "p");
    for (std::size_t z = 0; z < 2; ++z)
        for (std::size_t y = 0; y < 3; ++y)
            for (std::size_t x = 0; x < 2; ++x)
                EXPECT_EQ(values[x + 2 * (y + 3 * z)], static_cast<float>(y + 3 * (x + 2 * z)));

    // As VTK multiplies: origin + direction (spacing * ijk), the matrix row by row; also sheared,
    // mirrored, and with columns of other lengths.
    for (const glm::dmat3& rows : {glm::dmat3{{0.6, -0.8, 0}, {0.8, 0.6, 0}, {0, 0, 1}},
                                   glm::dmat3{{1, 0.5, 0}, {0, 1, 0}, {0, -0.2, -1}},
                                   glm::dmat3{{2, 0, 0}, {0, 1, 3}, {0, 0, 1}}}) {
        const auto oblique =
            turned(fmt::format("{} {} {} {} {} {} {} {} {}", rows[0].x, rows[0].y, rows[0].z,
                               rows[1].x, rows[1].y, rows[1].z, rows[2].x, rows[2].y, rows[2].z));
        const Grid& placed = *oblique->variables()[0].grid;
        for (std::uint64_t p = 0; p < 12; ++p) {
            const glm::dvec3 ijk(p % 3, p / 3 % 2, p / 6);
            const glm::dvec3 expected =
                glm::dvec3(10, 20, 30) + glm::transpose(rows) * (glm::dvec3(1, 2, 3) * ijk);
            EXPECT_LT(glm::distance(placed.position(p), expected), 1e-12) << p;
        }
        EXPECT_EQ(placed.axes()[0].name, "i");
        EXPECT_TRUE(oblique->variables()[0].notes.empty());
        EXPECT_EQ(valuesOf<float>(*oblique, "p"), upTo<float>(12));
    }
    for (const char* flawed : {"1 1 0 0 0 0 0 0 1", "0 0 0 0 0 0 0 0 0"}) {
        const auto flat = turned(flawed);
        EXPECT_THAT(flat->variables()[0].notes, ElementsAre(HasSubstr("drawn in index space")));
        EXPECT_EQ(flat->variables()[0].grid->axes()[0].units, "index");
        EXPECT_EQ(valuesOf<float>(*flat, "p"), upTo<float>(12));
    }
}

TEST(VtkImage, ObliqueCellDataLieAtTheCellsCentres) {
    const auto reader = openText(imageText(
        {.extent = "2 4 0 1 0 1",
         .attributes =
             "Origin=\"10 20 30\" Spacing=\"1 2 3\" Direction=\"0.6 -0.8 0 0.8 0.6 0 0 0 1\"",
         .cells = dataArray("UInt8", "c", upTo<std::uint8_t>(2))}));
    // The second cell's centre is 3.5, 0.5, 0.5 indices from the origin, which is of index 0.
    const glm::dvec3 along(3.5, 1, 1.5);
    const glm::dvec3 expected(10 + 0.6 * along.x - 0.8 * along.y,
                              20 + 0.8 * along.x + 0.6 * along.y, 30 + along.z);
    EXPECT_LT(glm::distance(reader->variables()[0].grid->position(1), expected), 1e-12);
}

TEST(VtkImage, FlatImagesAreOneLayerAndExtentsNeedNotBeginAt0) {
    const auto reader =
        openText(imageText({.extent = "-1 1 5 6 3 3",
                            .points = dataArray("UInt8", "p", upTo<std::uint8_t>(6)),
                            .cells = dataArray("UInt8", "c", upTo<std::uint8_t>(2))}));
    const auto& axes = reader->variables()[0].grid->axes();
    EXPECT_THAT(axes[0].coordinates, ElementsAre(9, 10, 11));
    EXPECT_THAT(axes[1].coordinates, ElementsAre(30, 32));
    EXPECT_THAT(axes[2].coordinates, ElementsAre(39));
    EXPECT_EQ(valuesOf<std::uint8_t>(*reader, "p"), upTo<std::uint8_t>(6));
    EXPECT_EQ(valuesOf<std::uint8_t>(*reader, "c"), upTo<std::uint8_t>(2));
    EXPECT_EQ(reader->variables()[1].grid->count(), 2u);
}

TEST(VtkImage, SpacingsOf0AreToldOf) {
    const auto reader =
        openText(imageText({.attributes = "Spacing=\"0 1 1\"",
                            .points = dataArray("UInt8", "p", upTo<std::uint8_t>(12))}));
    EXPECT_THAT(reader->variables()[0].notes,
                ElementsAre("x is placed by index: its spacing is 0"));
}

TEST(VtkImage, PiecesAreJoined) {
    const std::string text =
        "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 2 0 1 0 0\">"
        "<Piece Extent=\"1 2 0 1 0 0\"><PointData>" +
        dataArray("Int32", "p", std::vector<int>{1, 2, 4, 5}) +
        "</PointData></Piece><Piece Extent=\"0 1 0 1 0 0\"><PointData>" +
        dataArray("Int32", "p", std::vector<int>{0, 1, 3, 4}) +
        "</PointData></Piece></ImageData></VTKFile>";
    EXPECT_EQ(valuesOf<std::int32_t>(*openText(text), "p"), upTo<std::int32_t>(6));
}

// Of three points, in two pieces that share one, with an empty one at this place among them.
std::string withAnEmptyPiece(const std::string& kind, const std::string& empty, std::size_t at) {
    const auto piece = [&](const std::string& extent, const std::vector<double>& values) {
        const std::vector<double> flat{7};
        return "<Piece Extent=\"" + extent + "\"><PointData>" + dataArray("Float64", "p", values) +
               "</PointData><CellData>" +
               dataArray("UInt8", "c", std::vector<std::uint8_t>(values.size() - 1, 3)) +
               "</CellData><Coordinates>" + dataArray("Float64", "x", values) +
               dataArray("Float64", "y", flat) + dataArray("Float64", "z", flat) +
               "</Coordinates></Piece>";
    };
    std::vector<std::string> pieces{piece("0 1 0 0 0 0", {1, 2}), piece("1 2 0 0 0 0", {2, 4})};
    pieces.insert(pieces.begin() + static_cast<std::ptrdiff_t>(at), empty);
    return fmt::format("<VTKFile type=\"{0}\"><{0} WholeExtent=\"0 2 0 0 0 0\">{1}</{0}></VTKFile>",
                       kind, fmt::join(pieces, ""));
}

TEST(VtkXml, PiecesOfEmptyExtentArePassedOver) {
    const std::string arrays =
        "<PointData><DataArray type=\"Int8\" Name=\"other\" format=\"ascii\"/></PointData>";
    for (const std::string kind : {"ImageData", "RectilinearGrid"})
        for (const std::string extent : {"0 -1 0 -1 0 -1", "3 2 0 0 0 0", "0 2 0 0 1 0"})
            for (const std::string& inside : {std::string(), arrays})
                for (const std::size_t at : {0u, 1u, 2u}) {
                    SCOPED_TRACE(fmt::format("{} {} at {}", kind, extent, at));
                    const auto reader = openText(withAnEmptyPiece(
                        kind, "<Piece Extent=\"" + extent + "\">" + inside + "</Piece>", at));
                    EXPECT_THAT(namesOf(*reader), ElementsAre("p", "c"));
                    EXPECT_THAT(valuesOf<double>(*reader, "p"), ElementsAre(1, 2, 4));
                    EXPECT_THAT(valuesOf<std::uint8_t>(*reader, "c"), ElementsAre(3, 3));
                    if (kind == "RectilinearGrid") {
                        EXPECT_THAT(variableOf(*reader, "p").grid->axes()[0].coordinates,
                                    ElementsAre(1, 2, 4));
                    }
                }
}

std::string rectilinearText(const std::string& xs, const std::string& arrays) {
    return "<VTKFile type=\"RectilinearGrid\"><RectilinearGrid WholeExtent=\"0 2 0 1 0 0\"><Piece "
           "Extent=\"0 2 0 1 0 0\"><PointData>" +
           arrays + "</PointData><Coordinates><DataArray type=\"Float64\" format=\"ascii\">" + xs +
           "</DataArray>" + dataArray("Float32", "y", std::vector<float>{5, 4}) +
           dataArray("Int32", "z", std::vector<int>{7}) +
           "</Coordinates></Piece></RectilinearGrid></VTKFile>";
}

TEST(VtkRectilinear, CoordinatesPlaceThePoints) {
    const std::string arrays = dataArray("Int64", "a, b", upTo<std::int64_t>(6));
    const auto reader = openText(rectilinearText("1 2 4", arrays));
    EXPECT_EQ(reader->format(), "VTK rectilinear grid (XML)");
    const auto& axes = variableOf(*reader, "a, b").grid->axes();
    EXPECT_THAT(axes[0].coordinates, ElementsAre(1, 2, 4));
    EXPECT_THAT(axes[1].coordinates, ElementsAre(5, 4));
    EXPECT_THAT(axes[2].coordinates, ElementsAre(7));
    EXPECT_EQ(valuesOf<std::int64_t>(*reader, "a, b"), upTo<std::int64_t>(6));
    EXPECT_THAT(openText(rectilinearText("1 2 2", arrays))->variables()[0].notes,
                ElementsAre("x is placed by index: its coordinates are not strictly monotonic"));
}

constexpr std::string_view kLegacyRectilinear =
    "DATASET RECTILINEAR_GRID\nFIELD FieldData 1\nTIME 1 1 double\n";

TEST(VtkLegacy, RectilinearGridsWithFieldsAndTimeInTextAndInBytes) {
    std::string ascii = "# vtk DataFile Version 3.0\ntitle\nASCII\n";
    std::string binary = "# vtk DataFile Version 3.0\ntitle\nBINARY\n";
    const auto add = [&](const std::string& both) { ascii += both, binary += both; };
    const auto values = [&]<typename T>(const std::vector<T>& numbers) {
        for (const T& n : numbers) ascii += fmt::format("{} ", +n);
        ascii += "\n";
        binary += bigEndianBytes(numbers) + "\n";
    };
    add(std::string(kLegacyRectilinear));
    values(std::vector<double>{2.5});
    add("DIMENSIONS 3 2 1\nX_COORDINATES 3 float\n");
    values(std::vector<float>{1, 2, 4});
    add("Y_COORDINATES 2 double\n");
    values(std::vector<double>{5, 4});
    add("Z_COORDINATES 1 int\n");
    values(std::vector<std::int32_t>{7});
    add("CELL_DATA 2\nSCALARS c short\nLOOKUP_TABLE mine\n");
    values(std::vector<std::int16_t>{-300, 300});
    add("LOOKUP_TABLE mine 1\n");
    ascii += "0 0 0 1\n", binary += std::string("\0\0\0\xff\n", 5);
    add("POINT_DATA 6\nVECTORS V float\n");
    values(upTo<float>(18));
    add("METADATA\nINFORMATION 0\n\nFIELD FieldData 2\na%20b 1 6 vtkIdType\n");
    values(upTo<std::int32_t>(6));
    add("METADATA\nINFORMATION 0\n\nother 2 6 unsigned_short\n");
    values(upTo<std::uint16_t>(12));

    for (const std::string& text : {ascii, binary}) {
        const auto reader = openText(text);
        EXPECT_EQ(reader->format(), "VTK rectilinear grid (legacy)");
        EXPECT_THAT(namesOf(*reader), ElementsAre("c", "V magnitude", "V[0]", "V[1]", "V[2]", "a b",
                                                  "other magnitude", "other[0]", "other[1]"));
        EXPECT_EQ(reader->variables()[0].time->name, "time");
        EXPECT_EQ(reader->variables()[0].time->points[0].value, 2.5);
        EXPECT_THAT(reader->variables()[1].grid->axes()[0].coordinates, ElementsAre(1, 2, 4));
        EXPECT_THAT(reader->variables()[0].grid->axes()[0].coordinates, ElementsAre(1.5, 3));
        EXPECT_THAT(valuesOf<std::int16_t>(*reader, "c"), ElementsAre(-300, 300));
        EXPECT_THAT(valuesOf<float>(*reader, "V[2]"), ElementsAre(2, 5, 8, 11, 14, 17));
        EXPECT_EQ(valuesOf<std::int64_t>(*reader, "a b"), upTo<std::int64_t>(6));
        EXPECT_THAT(valuesOf<std::uint16_t>(*reader, "other[1]"), ElementsAre(1, 3, 5, 7, 9, 11));
    }
}

TEST(VtkLegacy, OldHeadersNameTheSpacingAspectRatio) {
    const auto reader = openText(
        "# vtk DataFile Version 1.0\nold\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 1\n"
        "ASPECT_RATIO 2 3 1\nORIGIN 1 1 1\nPOINT_DATA 4\nSCALARS s unsigned_char\nLOOKUP_TABLE "
        "default\n1 2 3 4\n");
    EXPECT_THAT(reader->variables()[0].grid->axes()[0].coordinates, ElementsAre(1, 3));
    EXPECT_THAT(reader->variables()[0].grid->axes()[1].coordinates, ElementsAre(1, 4));
    EXPECT_THAT(valuesOf<std::uint8_t>(*reader, "s"), ElementsAre(1, 2, 3, 4));
}

}  // namespace
}  // namespace timeseries
