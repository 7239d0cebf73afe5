// Files that change while they are open.
#include "timeseries/series/opened_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/files.h"
#include "tests/support/netcdf_builder.h"
#include "timeseries/readers/reader.h"
#include "timeseries/series/step_maker.h"

namespace timeseries {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string saidOf(const auto& work) {
    try {
        work();
    } catch (const FileError& error) {
        return error.what();
    }
    return "";
}

TEST(OpenedFiles, OfAnotherSizeOrTimeOrAnotherFileAreTold) {
    const fs::path folder = tests::freshFolder();
    const auto time = fs::file_time_type::clock::now() - std::chrono::hours(1);
    const auto put = [&](const char* name, const char* text) {
        tests::writeBytes(folder / name, text);
        fs::last_write_time(folder / name, time);
    };
    const std::vector<fs::path> files{folder / "a", folder / "b"};
    const auto changed = [&](const auto& change) {
        put("a", "one");
        put("b", "two");
        OpenedFiles opened(files);
        change();
        return saidOf([&] { opened.expectSame(files); });
    };
    EXPECT_EQ(changed([] {}), "");
    EXPECT_EQ(changed([&] { put("b", "twice"); }),
              (folder / "b").string() + ": it has changed since it was opened: open it again");
    EXPECT_THAT(changed([&] { fs::last_write_time(files[0], time + std::chrono::seconds(1)); }),
                HasSubstr("a: it has changed"));
    EXPECT_THAT(changed([&] {
                    put("c", "one");
                    fs::rename(folder / "c", files[0]);
                }),
                HasSubstr("a: it has changed"));
    // What is gone, and folders.
    EXPECT_EQ(changed([&] { fs::remove(files[0]); }), "");
    OpenedFiles folders(std::span(&folder, 1));
    put("d", "new");
    EXPECT_EQ(saidOf([&] { folders.expectSame(std::span(&folder, 1)); }), "");
}

// What was there must be as it was; counts of what there is stand at the beginning.
TEST(OpenedFiles, FewMayGrow) {
    const fs::path file = tests::freshFolder() / "a";
    std::string bytes(100'000, 'x');
    tests::writeBytes(file, bytes);
    OpenedFiles opened(std::span(&file, 1));
    for (const char more : {'y', 'z'}) {
        bytes[5] = more;
        bytes.append(1000, more);
        std::ofstream(file, std::ios::binary | std::ios::in).write(bytes.data(), std::ssize(bytes));
        EXPECT_EQ(saidOf([&] { opened.expectSame(std::span(&file, 1)); }), "");
    }
    std::vector<fs::path> many(OpenedFiles::kFew + 1, file);
    OpenedFiles strict(many);
    bytes.append(1000, 'm');
    std::ofstream(file, std::ios::binary | std::ios::in).write(bytes.data(), std::ssize(bytes));
    EXPECT_EQ(saidOf([&] { opened.expectSame(std::span(&file, 1)); }), "");
    EXPECT_THAT(saidOf([&] { strict.expectSame(many); }), HasSubstr("it has changed"));
    // Longer, and other.
    std::ofstream(file, std::ios::binary | std::ios::in) << std::string(200'000, 'w');
    EXPECT_THAT(saidOf([&] { opened.expectSame(std::span(&file, 1)); }),
                HasSubstr("it has changed"));
}

// A classic netCDF file that is cut has memory of other steps for values.
TEST(OpenedFiles, StepsOfAFileThatIsCutAreNotRead) {
    tests::NetcdfBuilder file("t.nc", NC_CLASSIC_MODEL);
    const int t = file.dimension("time", 3), z = file.dimension("z", 2), y = file.dimension("y", 2),
              x = file.dimension("x", 2);
    const int v = file.variable("v", NC_FLOAT, {t, z, y, x});
    file.write(v, std::vector<float>(24, 1));
    const fs::path path = file.close();
    StepMaker maker(openReader(std::span(&path, 1)), 0, RangeSet::everything());
    EXPECT_EQ(maker.make(0)->size(), 8u);
    fs::resize_file(path, fs::file_size(path) - 4);
    EXPECT_THAT(saidOf([&] { maker.make(1); }), HasSubstr("it has changed since it was opened"));
}

}  // namespace
}  // namespace timeseries
