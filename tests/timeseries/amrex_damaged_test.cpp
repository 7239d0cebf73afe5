// Plotfiles of AMReX that cannot be used are refused in one sentence, which names the file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/plotfile.h"
#include "tests/support/read_variables.h"

namespace timeseries::amrex_damaged {
namespace {

using namespace tests;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Path = std::filesystem::path;

// A text of a file, and what stands there instead.
struct Change {
    const char *file, *from, *to;
};

void change(const Path& folder, const Change& change) {
    const std::string bytes = readBytes(folder / change.file), from = change.from;
    const auto at = bytes.find(from);
    ASSERT_NE(at, bytes.npos) << change.from;
    writeBytes(folder / change.file,
               bytes.substr(0, at) + change.to + bytes.substr(at + from.size()));
}

struct Told {
    Change change;
    const char* told;
};

TEST(DamagedAmrex, WhatATextSaysWrongIsTold) {
    const Path folder = freshFolder() / "plt00000";
    for (const auto& [damage, told] : std::vector<Told>{
             {{"Header", "1.1\n2\n", "1.1\n0\n"}, "line 2: expected a number of variables from 1 "},
             {{"Header", "1.1\n2\n", "1.1\n3\n"}, "expected a number of dimensions"},
             {{"Header", "density\n", "\n"}, "expected the name of a variable"},
             {{"Header", "density\n", "Temp of it\n"},
              "expected names of variables that differ, found 'Temp of it' again"},
             {{"Header", "it\n3\n", "it\n1\n"},
              "expected a plotfile of 2 or 3 dimensions, found one of 1"},
             {{"Header", "it\n3\n", "it\n4\n"}, "expected a number of dimensions from 1 to 3"},
             {{"Header", "\n0.1\n2\n", "\n0.1\n200\n"}, "expected a finest level from 0 to 99"},
             {{"Header", "\n0.1\n2\n", "\nnan\n2\n"}, "expected a time, a number, found 'nan'"},
             {{"Header", "-1 2 10 ", "-1 5 10 "}, "expected a domain that takes space"},
             {{"Header", "((0,0,0) (7,5,3)", "((0,0,0) (7,5,-3)"}, "expected a box that holds"},
             {{"Header", "((0,0,0) (7,5,3) (0,0,0))", "((0,0,0) (7,5,3) (1,0,0))"},
              "expected a box of cells, found one of nodes or faces"},
             {{"Header", "(7,5,3)", "(7,5,9999999999)"}, "expected an index from "},
             {{"Header", "(15,11,7)", "(15,10,7)"}, "expected cells of level 1 that fill"},
             {{"Header", "\n0\n0\n0 3", "\n1\n0\n0 3"},
              "expected Cartesian coordinates, found those of a cylinder (RZ), which are not read"},
             {{"Header", "\n0\n0\n0 3", "\n2\n0\n0 3"}, "those of a sphere, which are not read"},
             {{"Header", "\n0\n0\n0 3", "\n0\n0\n0 2"}, "_H: expected a file, but there is none"},
             {{"Header", "Level_0/Cell", "../Cell"}, "a path within the folder, found '../Cell'"},
             {{"Header", "Level_0/Cell", "/tmp/Cell"}, "a path within the folder, found"},
             {{"Header", "Level_0/Cell", "Level_7/Cell"}, "Level_7/Cell_H: expected a file, but"},
             {{"Level_1/Cell_H", "1\n1\n", "2\n1\n"}, "expected version 1, found 2, which is not"},
             {{"Level_1/Cell_H", "1\n1\n2\n", "1\n1\n3\n"},
              "expected 2 variables as in the Header, found 3"},
             {{"Level_1/Cell_H", "\n(2 0", "\n(4000000000 0"}, "expected the character '('"},
             {{"Level_1/Cell_H", "\n2\nFab", "\n1\nFab"}, "as many FABs as there are boxes, 2"},
             {{"Level_1/Cell_H", "Cell_D_00000 ", "../Level_0/Cell_D_00000 "},
              "the name of a file beside it, found '../Level_0/Cell_D_00000'"},
             {{"Level_1/Cell_H", "Cell_D_00000 ", "Cell_D_00007 "},
              "Cell_D_00007: expected a file, but there is none"},
             {{"Level_1/Cell_H", "Cell_D_00000 0", "Cell_D_00000 1"}, "FAB at byte 1: expected"},
             {{"Level_1/Cell_H", "Cell_D_00000 0", "Cell_D_00000 99999999"}, "FAB at byte 9999"},
             {{"Level_1/Cell_H", "(8,2,0) (11,9,7)", "(7,2,0) (11,9,7)"},
              "boxes 0 and 1 of level 1 have cells in common"},
             {{"Level_1/Cell_H", "(8,2,0) (11,9,7)", "(8,2,0) (16,9,7)"}, "leaves the domain"},
             {{"Level_1/Cell_H", "(8,2,0) (11,9,7)", "(8,2,0) (10,9,7)"},
              "covers parts of cells of level 0"},
             {{"Level_0/Cell_H", "(4,3,0) (7,5,3)", "(5,3,0) (7,5,3)"},
              "box 1 of level 1 lies where level 0 has no cells"},
             {{"Level_1/Cell_H", "(4,2,0) (7,9,7)", "(4,4,0) (7,9,7)"}, "found another box"},
             {{"Level_0/Cell_H", "0,0) (3,5,3)", "0,0) (1000000000,1000000000,1000000000)"},
              "bytes in the files of its levels"},
             {{"Level_0/Cell_D_00000", "FAB ", "FUB "}, "FAB at byte 0: expected the character"},
             {{"Level_0/Cell_D_00000", "(64 11", "(64 12"}, "IEEE numbers of 32 or 64 bits"},
             {{"Level_0/Cell_D_00000", "(8 7 6", "(8 8 6"}, "order of the bytes of a number"},
             {{"Level_0/Cell_D_00000", "(8, (8 7 6 5 4 3 2 1))", "(4, (4 3 2 1))"}, "order of the"},
             {{"Level_0/Cell_D_00000", "(3,5,3) (0,0,0)) 2", "(3,5,3) (0,0,0)) 900"},
              "but the file ends"},
             {{"Level_0/Cell_D_00000", "(3,5,3) (0,0,0)) 2", "(3,5,3) (0,0,0)) 1"},
              "expected 2 variables of float64 in box 0 of level 0, found 1 of float64"},
         }) {
        std::filesystem::remove_all(folder);
        writePlotfile(folder, threeLevels());
        change(folder, damage);
        const std::string sentence = refusalOfRead(folder);
        EXPECT_THAT(sentence, AllOf(HasSubstr("plt00000"), HasSubstr(told), Not(HasSubstr("\n"))))
            << damage.file << ": " << damage.to;
    }
    std::filesystem::remove_all(folder);
    writePlotfile(folder, threeLevels());
    EXPECT_EQ(refusalOfRead(folder), "");
}

TEST(DamagedAmrex, FilesThatEndEarlyAreTold) {
    const Path folder = freshFolder() / "plt00000";
    for (const char* name : {"Header", "Level_0/Cell_H", "Level_2/Cell_H", "Level_0/Cell_D_00000",
                             "Level_1/Cell_D_00001"}) {
        std::filesystem::remove_all(folder);
        writePlotfile(folder, threeLevels());
        const std::string bytes = readBytes(folder / name);
        // All values are read, and the texts but for what nobody needs at their ends.
        for (std::size_t size = 15; size + 20 < bytes.size();
             size += 1 + bytes.size() / (bytes.size() > 2000 ? 7 : 70)) {
            std::filesystem::resize_file(folder / name, size);
            EXPECT_THAT(refusalOfRead(folder), HasSubstr("expected")) << name << ": " << size;
            writeBytes(folder / name, bytes);
        }
    }
}

TEST(DamagedAmrex, BoxesAreAsManyInBothTexts) {
    const Path folder = freshFolder() / "plt00000";
    writePlotfile(folder, threeLevels());
    writeBytes(folder / "Level_0/Cell_H", readBytes(folder / "Level_1/Cell_H"));
    EXPECT_THAT(refusalOfRead(folder), HasSubstr("expected 2 boxes of level 0 as in"));
}

TEST(DamagedAmrex, OneTypeForAllBoxes) {
    const Path folder = freshFolder() / "plt00000";
    Plotfile file = threeLevels();
    writePlotfile(folder, file);
    file.isSingle = true;
    writeLevel(folder / "Level_1", file, 1);
    EXPECT_THAT(
        refusalOfRead(folder),
        HasSubstr("expected 2 variables of float64 in box 0 of level 1, found 2 of float32"));
}

TEST(DamagedAmrex, AnotherHeaderIsNoPlotfile) {
    const Path folder = freshFolder() / "plt00000";
    std::filesystem::create_directories(folder);
    for (const char* text : {"", "Version_Two_Dagger_double\n3\n", "-V1\n", "HyperCLaw-V\n",
                             "a sentence about HyperCLaw-V1.1\n"}) {
        writeBytes(folder / "Header", text);
        EXPECT_FALSE(isReadable(folder)) << text;
    }
}

}  // namespace
}  // namespace timeseries::amrex_damaged
