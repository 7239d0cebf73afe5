#include "timeseries/machine_memory.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/support/files.h"

namespace timeseries {
namespace {

namespace fs = std::filesystem;

class MachineMemory : public testing::Test {
 protected:
    const fs::path folder = tests::freshFolder(), groups = folder / "groups";
    const std::uint64_t installed = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                                    static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    void put(const fs::path& file, const std::string& text) const {
        fs::create_directories((groups / file).parent_path());
        tests::writeBytes(groups / file, text);
    }
    std::uint64_t of(const std::string& process) const {
        tests::writeBytes(folder / "process", process);
        return machineMemory(folder / "process", groups);
    }
};

TEST_F(MachineMemory, IsWhatIsInstalledWhereNothingElseIsSaid) {
    EXPECT_EQ(machineMemory(folder / "none", groups), installed);
    EXPECT_EQ(of(""), installed);
    EXPECT_EQ(of("nothing of the kind\n"), installed);
    EXPECT_EQ(of("0::/a/b\n"), installed);
    put("a/b/memory.max", "max\n");
    EXPECT_EQ(of("0::/a/b\n"), installed);
    put("a/b/memory.max", "99999999999999999\n");
    EXPECT_EQ(of("0::/a/b\n"), installed);
    EXPECT_LE(machineMemory(), installed);
    EXPECT_GT(machineMemory(), 0u);
}

TEST_F(MachineMemory, IsTheLeastThatAGroupOrOneAboutItIsHeldTo) {
    put("a/b/memory.max", "3000000\n");
    put("a/memory.max", "max\n");
    put("other/memory.max", "1000\n");
    EXPECT_EQ(of("0::/a/b\n"), 3000000u);
    put("a/memory.max", "2000000\n");
    EXPECT_EQ(of("0::/a/b\n"), 2000000u);
    EXPECT_EQ(of("0::/a\n"), 2000000u);
    // As a container sees it.
    put("memory.max", "1000000\n");
    EXPECT_EQ(of("0::/\n"), 1000000u);
    EXPECT_EQ(of("0::/../elsewhere\n"), 1000000u);
}

TEST_F(MachineMemory, KnowsTheGroupsOfTheFirstVersion) {
    put("memory/job_7/memory.limit_in_bytes", "5000000\n");
    put("memory/memory.limit_in_bytes", "9223372036854771712\n");
    put("cpu/job_7/memory.limit_in_bytes", "7\n");
    EXPECT_EQ(of("9:cpu,cpuacct:/job_7\n4:memory:/job_7\n0::/\n"), 5000000u);
    EXPECT_EQ(of("4:hugetlb,memory:/job_7\n"), 5000000u);
    EXPECT_EQ(of("9:cpu:/job_7\n"), installed);
}

}  // namespace
}  // namespace timeseries
