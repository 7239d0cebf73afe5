// OpenFOAM cases that say what is not there, what is not read, or what would take all memory.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/foam_case.h"
#include "tests/support/read_variables.h"

namespace timeseries::foam_damaged {
namespace {

using namespace tests;
using namespace tests::foam;
using testing::AllOf;
using testing::HasSubstr;

// Two cubes, T of which is this file.
std::filesystem::path caseWithT(const std::string& file) {
    const auto folder = caseOf(cubes(2));
    put(folder / "0/T", file);
    return folder;
}

TEST(DamagedFoam, ValuesThatAreNoneAreTold) {
    const std::string list = "nonuniform List<scalar> ";
    for (const auto& [values, told] : std::initializer_list<std::pair<std::string, const char*>>{
             {"uniform $pressure", "found $pressure: macros are not read"},
             {"$initial", "found $initial: macros are not read"},
             {"#calc \"1 + 1\"", "macros are not read"},
             {list + "2(1 #inputSyntax)", "macros are not read"},
             {"steady 1", "expected uniform or nonuniform values, found 'steady'"},
             {list + "3(1 2 3)", "expected a list of at most 2, found 3"},
             {list + "1(1)", "expected a list of 2, found 1"},
             {list + "0()", "expected a list of 2, found 0"},
             {list + "2(1 2 3)", "expected ')'"},
             {list + "2(1)", "expected a number, found ')'"},
             {list + "2(1 two)", "expected a number, found 'two'"},
             {list + "2(1 2x)", "expected a number, found '2x'"},
             {list + "-2(1 2)", "expected a number, found '-2'"},
             {list + "18446744073709551615(1)", "expected a list of at most 2"},
             {"nonuniform List<vector> 2((1 2 3) (1 2 3))", "found 'List<vector>'"},
             {"uniform \"a\nb\"", "expected a number, found '\"a?b\"'"},
             {"uniform", "expected a number, found ';'"}})
        EXPECT_THAT(refusalOfRead(caseWithT(field("volScalarField", values))),
                    AllOf(HasSubstr("case/0/T: line "), HasSubstr(told)))
            << values;
}

TEST(DamagedFoam, FilesThatEndEarlyAreRefused) {
    for (const bool isBinary : {false, true})
        for (const bool isPacked : {false, true}) {
            const Writing how{.isBinary = isBinary, .isPacked = isPacked};
            const std::string whole = scalars({1, 2}, how);
            // Up to the bracket behind the list: what comes after that is not asked for.
            const std::size_t end = whole.find(")\n;\n") + 1;
            ASSERT_LT(end, whole.size());
            for (std::size_t length = 0; length < whole.size();
                 length += length + 40 < end ? 13 : 1) {
                const auto folder = caseOf(cubes(2));
                put(folder / "0/T", whole.substr(0, length), how);
                EXPECT_EQ(refusalOfRead(folder).empty(), length >= end) << length;
            }
            const auto folder = caseOf(cubes(2), how);
            put(folder / "0/T", whole, how);
            const auto faces =
                folder / (isPacked ? "constant/polyMesh/faces.gz" : "constant/polyMesh/faces");
            const std::string bytes = readBytes(faces);
            for (std::size_t length = 0; length + 12 < bytes.size(); length += 19) {
                writeBytes(faces, bytes.substr(0, length));
                EXPECT_THAT(refusalOf(folder), HasSubstr("polyMesh/faces"));
            }
        }
}

TEST(DamagedFoam, HeadersThatAreNoneAreTold) {
    const std::string rest = "internalField uniform 1;\n";
    for (const auto& [file, told] : std::initializer_list<std::pair<std::string, const char*>>{
             {"", "expected a header that begins with FoamFile"},
             {"no header", "expected a header that begins with FoamFile"},
             {"/* no end", "expected the end of a comment"},
             {"FoamFile { format ascii; class volScalarField;", "expected the end of the header"},
             {"FoamFile { format ascii", "expected the end of an entry"},
             {"FoamFile { format xml; }" + rest,
              "expected the format ascii or binary, found 'xml'"},
             {"FoamFile { format binary; arch \"MSB;label=32;scalar=64\"; class volScalarField; }" +
                  rest,
              "byte order"},
             {"FoamFile { arch \"MSB;label=32;scalar=64\"; class volScalarField; format binary; }" +
                  rest,
              "byte order"},
             {"FoamFile { meta { names (a b); ", "expected the end of an entry"},
             {"FoamFile { format binary; arch \"LSB;label=16;scalar=64\"; class volScalarField; }" +
                  rest,
              "label=32 or label=64"},
             {"FoamFile { format ascii; class \"" + std::string(5000, 'x') + "\"; }",
              "string in quotes"},
             {"FoamFile { format ascii; class " + std::string(5000, 'x') + "; }", "less than 4096"},
             {header("volScalarField") + "dimensions [0 1 0",
              "expected dimensions between brackets"},
             {header("volScalarField") + "dimensions [];\n", "expected the entry internalField"},
             {header("volScalarField") + "} " + rest, "expected the entry internalField"}})
        EXPECT_THAT(refusalOfRead(caseWithT(file)), AllOf(HasSubstr("case/0/T: "), HasSubstr(told)))
            << file.substr(0, 100);
}

// Each change by itself.
TEST(DamagedFoam, MeshesThatAreNoneAreTold) {
    struct Change {
        const char *file, *was, *is, *told;
    };
    for (const Change& change : {
             Change{"faces", "\n4(", "\n4(99 ", "expected numbers from 0 to below 12, found 99"},
             Change{"faces", "\n4(", "\n4(-1 ", "expected numbers from 0 to below 12, found -1"},
             Change{"faces", "\n4(", "\n5(", "expected a number"},
             Change{"faces", "\n4(", "\n2(", "expected ')'"},
             Change{"faces", "\n11\n(\n", "\n12\n(\n2(1 2)\n",
                    "expected three points or more of face 0"},
             Change{"faces", "\n4(", "\n3{1}\n4(", "expected a list of labels that differ"},
             Change{"faces", "\n11\n", "\n4294967294\n", "expected a list that the file can hold"},
             Change{"faces", "\n11\n", "\n4294967295\n", "expected a list of at most"},
             Change{"faces", "\n11\n", "\n12\n", "expected a number, found ')'"},
             Change{"faces", "faceList", "volScalarField",
                    "expected a faceList, found a volScalarField"},
             Change{"faces", "faceList", "decomposedBlockData", "reconstructPar"},
             Change{"points", "\n12\n", "\n1000000\n", "expected a list that the file can hold"},
             Change{"points", "\n12\n", "\n11\n", "expected ')'"},
             Change{"points", "\n12\n", "\n12{(0 0 0)}\n",
                    "expected a list of rows that differ, found one for all"},
             Change{"points", "vectorField", "labelList", "expected a vectorField"},
             Change{"owner", "\n11\n", "\n10\n", "expected ')'"},
             Change{"owner", "\n0\n", "\n4000000000\n", "expected numbers from 0 to below 6"},
             Change{"owner", "\n0\n", "\n5\n", "expected cells between faces"},
             Change{"neighbour", "\n1\n(", "\n12\n(", "expected a list of at most 11"},
             Change{"neighbour", "(\n1\n)", "(\n-2\n)", "expected numbers from -1"},
         }) {
        const auto folder = caseWithT(scalars({1, 2}));
        const auto file = folder / "constant/polyMesh" / change.file;
        std::string text = readBytes(file);
        const std::size_t at = text.find(change.was);
        ASSERT_NE(at, text.npos) << change.was;
        writeBytes(file, text.replace(at, std::string(change.was).size(), change.is));
        EXPECT_THAT(refusalOf(folder), AllOf(HasSubstr(std::string("polyMesh/") + change.file),
                                             HasSubstr(change.told)))
            << change.is;
    }
}

TEST(DamagedFoam, FilesThatAreNotThereAreNamed) {
    for (const char* name : {"points", "faces", "owner", "neighbour"}) {
        const auto folder = caseWithT(scalars({1, 2}));
        std::filesystem::remove(folder / "constant/polyMesh" / name);
        EXPECT_THAT(refusalOf(folder),
                    HasSubstr(std::string("polyMesh/") + name + ": expected a file"));
    }
    const auto folder = caseOf(cubes(2));
    EXPECT_THAT(refusalOf(folder), HasSubstr("expected folders of times with fields"));
    put(folder / "0/phi", field("surfaceScalarField", "uniform 1"));
    EXPECT_THAT(refusalOf(folder), HasSubstr("expected a field of cells or points, found none"));
    put(freshFolder() / "alone.foam", "");
    EXPECT_THAT(refusalOf(testFolder() / "alone.foam"),
                HasSubstr("expected an OpenFOAM case around it"));
}

// Others are read beside them.
TEST(DamagedFoam, AFieldThatIsNoneCostsOnlyItself) {
    const auto folder = caseWithT(scalars({1, 2}));
    put(folder / "0/A", "nothing");
    const auto reader = open(folder);
    EXPECT_EQ(reader->variables().size(), 1u);
    ASSERT_EQ(reader->damaged().size(), 1u);
    EXPECT_EQ(reader->damaged()[0].name, "A");
    EXPECT_THAT(reader->damaged()[0].why, HasSubstr("0/A: line 1: expected a header"));
}

TEST(DamagedFoam, ProcessorsThatAreMissingAreTold) {
    const auto folder = caseOf(cubes(1));
    for (const char* name : {"processor0", "processor2"}) {
        put(folder / name / "0/T", scalars({1}));
        putMesh(folder / name / "constant/polyMesh", cubes(1));
    }
    EXPECT_THAT(refusalOf(folder), HasSubstr("expected a folder processor1, found processor2"));
    // Reconstructed, they are not asked for.
    put(folder / "0/T", scalars({7}));
    EXPECT_EQ(valuesOf<double>(*open(folder), "T"), std::vector<double>{7});
}

TEST(DamagedFoam, AFieldHasOneClassAtAllTimes) {
    const auto folder = caseWithT(scalars({1, 2}));
    put(folder / "1/T", field("volVectorField", "uniform (1 2 3)"));
    const auto reader = open(folder);
    try {
        reader->read(0, 0);
        FAIL();
    } catch (const FileError& error) {
        EXPECT_THAT(error.what(), HasSubstr("expected a volVectorField as at other times"));
    }
}

}  // namespace
}  // namespace timeseries::foam_damaged
