// Files that change while they are open.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/netcdf_builder.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace netcdf_changed {
namespace {

namespace fs = std::filesystem;

// So many points, from a value on.
fs::path written(const std::string& name, int mode, std::size_t count, float first) {
    tests::NetcdfBuilder file(name, mode);
    const int y = file.dimension("y", 2), x = file.dimension("x", count / 2);
    const int values = file.variable("T", NC_FLOAT, {y, x});
    std::vector<float> all(count);
    for (std::size_t i = 0; i < count; ++i) all[i] = first + static_cast<float>(i);
    file.write(values, all);
    file.close();
    return tests::testFolder() / name;
}

// The same file, to the system, with what another holds.
void overwrite(const fs::path& file, const fs::path& by) {
    std::ofstream(file, std::ios::binary | std::ios::trunc)
        << std::ifstream(by, std::ios::binary).rdbuf();
    fs::last_write_time(file, fs::last_write_time(file) + std::chrono::seconds(2));
}

std::unique_ptr<Reader> opened(const fs::path& file) {
    return openReader(std::vector<fs::path>{file});
}

// HDF5 has one of all that have a file open: a reader that is still there must not lend its own.
TEST(NetcdfChanged, AFileThatWasOverwrittenIsReadAnewBesideWhoeverHasItOpen) {
    for (const int mode : {NC_NETCDF4, NC_CDF5}) {
        for (const std::size_t count : {50u, 80u}) {  // of one size, and larger
            const fs::path file = written("file.nc", mode, 50, 1);
            const auto before = opened(file);
            EXPECT_EQ(std::get<std::vector<float>>(before->read(0, 0).values)[3], 4);
            overwrite(file, written("other.nc", mode, count, 1000));
            const auto after = opened(file);
            const Field now = after->read(0, 0);
            ASSERT_EQ(now.grid->count(), count);
            EXPECT_EQ(std::get<std::vector<float>>(now.values)[3], 1003);
            if (mode != NC_NETCDF4) continue;
            EXPECT_THROW(
                {
                    try {
                        before->read(0, 0);
                    } catch (const FileError& error) {
                        EXPECT_EQ(
                            std::string(error.what()),
                            file.string() + ": it has changed since it was opened: open it again");
                        throw;
                    }
                },
                FileError);
            // Nor does whoever has it open now close anything else.
            const fs::path apart = written("apart.nc", mode, 50, 5);
            const auto other = opened(apart);
            EXPECT_EQ(std::get<std::vector<float>>(after->read(0, 0).values)[3], 1003);
        }
    }
}

TEST(NetcdfChanged, AFileThatIsAsItWasMayBeOpenTwice) {
    const fs::path file = written("file.nc", NC_NETCDF4, 50, 1);
    const auto one = opened(file), other = opened(file);
    for (const auto* reader : {&one, &other})
        EXPECT_EQ(std::get<std::vector<float>>((*reader)->read(0, 0).values)[3], 4);
}

}  // namespace
}  // namespace netcdf_changed
}  // namespace timeseries
