// A file that several processes write, on a disk that fails one of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "tests/faults/disk_without_power.h"
#include "tests/faults/system_calls.h"
#include "tests/ranks/ranks_world.h"
#include "tests/support/random_field.h"
#include "tests/support/rounds.h"
#include "timeseries/together.h"

namespace timeseries {
namespace {

using namespace ranks_world;
using testing::HasSubstr;
using tests::calls;
using tests::done;
using tests::watched;

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
    // What all of them did to files, in the order of the clock.
    static std::vector<tests::Done> doneByAll() {
        std::ostringstream mine;
        for (const tests::Done& each : done)
            mine << each.what << ' ' << each.when.time_since_epoch().count() << ' ' << each.at
                 << ' ' << world().rank() << ' ' << each.path.size() << ' ' << each.to.size() << ' '
                 << each.bytes.size() << ' ' << each.path << each.to << each.bytes;
        const std::vector<char> all = world().gather<char>(mine.str());
        std::istringstream from(std::string(all.begin(), all.end()));
        std::vector<tests::Done> every;
        std::chrono::steady_clock::rep when;
        std::size_t path, to, bytes;
        int what;
        for (tests::Done one; from >> what >> when >> one.at >> one.process >> path >> to >> bytes;
             every.push_back(one)) {
            const auto take = [&](std::string& text, std::size_t size) {
                text.resize(size);
                from.read(text.data(), static_cast<std::streamsize>(size));
            };
            from.get();
            take(one.path, path);
            take(one.to, to);
            take(one.bytes, bytes);
            one.what = static_cast<tests::Done::What>(what);
            one.when = std::chrono::steady_clock::time_point(std::chrono::nanoseconds(when));
        }
        std::ranges::stable_sort(every, {}, &tests::Done::when);
        return every;
    }
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
        EXPECT_GE(failing(&tests::Calls::pwritev, ENOSPC, "No space left on device"), 1);
        EXPECT_GE(failing(&tests::Calls::fsync, EIO, "Input/output error"), 1);
    }
    fails_ = world().isFirst();
    EXPECT_EQ(failing(&tests::Calls::rename, EROFS, "Read-only file system"), 1);
}

// Of what several processes write none may be lost once it has its name.
TEST_F(SharedFaults, WheneverThePowerGoesTheFileIsTheOldOrTheNewOne) {
    const auto text = [&] {
        const std::vector<std::byte> bytes = there();
        return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    };
    ASSERT_EQ(write(), "");
    const std::string before = text();
    whole = tests::randomField<float>(random, kSize, 0);
    watched = path.parent_path().string();
    ASSERT_EQ(write(), "");
    watched.reset();
    const std::string after = text();
    ASSERT_NE(before, after);
    const std::vector<tests::Done> all = doneByAll();
    done.clear();
    if (!world().isFirst()) return;              // it looks for all
    ASSERT_GE(all.size(), 5u + world().size());  // pieces, header, syncs, rename
    std::size_t old = 0, anew = 0;
    for (std::size_t crash = 0; crash <= all.size(); ++crash)
        for (int i = 0; i < tests::rounds(20); ++i) {
            tests::Disk disk(random);
            disk.put(path.string(), before);
            for (std::size_t d = 0; d < crash; ++d) disk.doIt(all[d]);
            const auto left = disk.afterTheCrash();
            ASSERT_TRUE(left.contains(path.string())) << crash;
            const std::string& found = left.at(path.string());
            ASSERT_TRUE(found == before || found == after) << "after " << crash << " calls";
            old += found == before;
            anew += found == after;
        }
    EXPECT_GT(old, 0u);
    EXPECT_GT(anew, 0u);
}

}  // namespace
}  // namespace timeseries
