// A file that several processes write, on a disk that fails one of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <cstdint>
#include <optional>
#include <random>
#include <string>

#include "tests/faults/system_calls.h"
#include "tests/ranks/ranks_world.h"
#include "tests/support/random_field.h"
#include "timeseries/together.h"

namespace timeseries {
namespace {

using namespace ranks_world;
using testing::HasSubstr;
using tests::calls;

class SharedFaults : public testing::Test {
 protected:
    SharedFaults() { threadLimit = 1; }  // calls are counted without a lock
    ~SharedFaults() override {
        calls = {};
        threadLimit = 0;
    }
    static constexpr std::array<std::size_t, 3> kSize{128, 64, 64};  // 16 blocks
    const fs::path path = sharedFolder() / "u.isostep";
    std::mt19937_64 random{5};  // the same on all ranks
    Field whole = tests::randomField<float>(random, kSize, 0);
    const GridBox box = cutAtRandom(random, kSize, world().size())[world().rank()];

    // As a simulation's step is; what went wrong, the same on all ranks.
    std::string write() const {
        try {
            std::optional<WholeFile> file;
            world().agreed([&] {
                if (world().isFirst()) file.emplace(path);
            });
            writeShared(world(), partOf<float>(whole, box), box,
                        {{kSize[0], kSize[1], kSize[2]}, "about"}, file ? &*file : nullptr);
            world().agreed([&] {
                if (file) file->finish();
            });
            return "";
        } catch (const RanksError& error) {
            return error.what();
        }
    }
    static void waitForAll() { (void)world().sum(1); }
    // What is there when all have come so far.
    std::vector<std::byte> there() const {
        waitForAll();
        return bytesOf(path);
    }
    // One that fails from its so-manieth call on, later and later, until nothing does any more;
    // how often it did.
    int failing(tests::Meddle tests::Calls::*call, int code, const std::string& sentence) {
        const std::vector<std::byte> before = there();
        whole = tests::randomField<float>(random, kSize, 0);
        for (std::size_t first = 0;; ++first) {
            calls = {};
            if (fails_)
                calls.*call = [=](std::size_t n, std::size_t) -> std::optional<long> {
                    return n >= first ? std::optional<long>(-code) : std::nullopt;
                };
            const std::string why = write();
            calls = {};
            if (why.empty()) {
                EXPECT_FALSE(there() == before);
                return static_cast<int>(first);
            }
            EXPECT_THAT(why, HasSubstr(sentence));
            EXPECT_TRUE(there() == before) << first;
            EXPECT_EQ(std::distance(fs::directory_iterator(path.parent_path()), {}), 1);
            waitForAll();
        }
    }
    bool fails_ = false;  // this rank
};

TEST_F(SharedFaults, OfAnyProcessLeaveTheOldFileAndAreToldByAll) {
    ASSERT_EQ(write(), "");
    for (unsigned r = 0; r < world().size(); ++r) {
        SCOPED_TRACE(testing::Message() << "rank " << r);
        fails_ = world().rank() == r;
        EXPECT_GE(failing(&tests::Calls::pwrite, ENOSPC, "No space left on device"), 1);
        EXPECT_GE(failing(&tests::Calls::fsync, EIO, "Input/output error"), 1);
    }
    fails_ = world().isFirst();
    EXPECT_EQ(failing(&tests::Calls::rename, EROFS, "Read-only file system"), 1);
}

}  // namespace
}  // namespace timeseries
