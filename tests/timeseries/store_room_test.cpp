#include "timeseries/series/store_room.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/files.h"

namespace timeseries {
namespace {

namespace fs = std::filesystem;

class StoreRooms : public testing::Test {
 protected:
    static constexpr std::uint64_t kBytes = 1000;
    fs::path folder = tests::freshFolder();

    fs::path nameOf(int i) const { return folder / fmt::format("{:032x}.isostep", i); }
    // Used i seconds after the first.
    void write(int i) const {
        // Damaged behind its first bytes, by which it is told.
        tests::writeBytes(nameOf(i), "isostep\n" + std::string(kBytes - 8, 'x'));
        fs::last_write_time(nameOf(i), fs::file_time_type::clock::now() - std::chrono::hours(1) +
                                           std::chrono::seconds(i));
    }
    std::uint64_t held() const {
        std::uint64_t bytes = 0;
        for (const StoredFile& file : storedFiles(folder)) bytes += file.bytes;
        return bytes;
    }
};

// To look at all of it for each that is written took longer than to write it.
TEST_F(StoreRooms, AFolderIsCountedOnceForManyThatAreWritten) {
    for (int i = 0; i < 10; ++i) write(i);
    StoreRoom room(folder, 20 * kBytes, std::chrono::hours(1));
    const auto add = [&](int i) {
        EXPECT_TRUE(room.make(nameOf(i), kBytes));
        write(i);
    };
    for (int i = 10; i < 20; ++i) add(i);
    EXPECT_EQ(held(), 20 * kBytes);
    for (int i = 20; i < 25; ++i) add(i);
    EXPECT_EQ(held(), 20 * kBytes);
    EXPECT_FALSE(fs::exists(nameOf(4)));
    EXPECT_TRUE(fs::exists(nameOf(5)));
    // Over one that is there it takes no more.
    add(24);
    EXPECT_TRUE(fs::exists(nameOf(5)));
    // By somebody else: not looked for now.
    write(100);
    add(24);
    EXPECT_EQ(held(), 21 * kBytes);
    EXPECT_FALSE(room.make(nameOf(101), 20 * kBytes + 1));
}

TEST_F(StoreRooms, WhatSomebodyElseWritesUsesOrRemovesIsFoundOut) {
    for (int i = 0; i < 4; ++i) write(i);
    StoreRoom room(folder, 4 * kBytes, std::chrono::hours(1));
    EXPECT_TRUE(room.make(nameOf(3), kBytes));
    fs::last_write_time(nameOf(0), fs::file_time_type::clock::now());
    fs::remove(nameOf(1));
    EXPECT_TRUE(room.make(nameOf(4), kBytes));
    EXPECT_TRUE(fs::exists(nameOf(0)));
    EXPECT_TRUE(fs::exists(nameOf(2)));  // the one that was gone has made the room
    write(4);
    EXPECT_TRUE(room.make(nameOf(5), kBytes));
    EXPECT_FALSE(fs::exists(nameOf(2)));
    EXPECT_TRUE(fs::exists(nameOf(0)));

    StoreRoom soon(folder, 4 * kBytes, std::chrono::milliseconds(0));
    for (int i = 10; i < 20; ++i) {  // each time by others
        write(i);
        const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(10);
        while (held() + kBytes > 4 * kBytes && std::chrono::steady_clock::now() < until)
            EXPECT_TRUE(soon.make(nameOf(5), kBytes));
        EXPECT_LE(held() + kBytes, 4 * kBytes);
    }
}

TEST_F(StoreRooms, WhatIsHeldMakesNoRoom) {
    for (int i = 0; i < 4; ++i) write(i);
    StoreRoom room(folder, 5 * kBytes, std::chrono::hours(1));
    int asked = 0;
    room.hold([&] {
        ++asked;
        return std::vector{nameOf(0), nameOf(1), nameOf(4), nameOf(5), nameOf(6), nameOf(7)};
    });
    const auto add = [&](int i) {
        const bool fits = room.make(nameOf(i), kBytes);
        if (fits) write(i);
        return fits;
    };
    EXPECT_TRUE(add(4));
    EXPECT_EQ(asked, 0);
    EXPECT_TRUE(add(5));
    EXPECT_TRUE(add(6));
    EXPECT_EQ(asked, 1);
    for (int i : {2, 3}) EXPECT_FALSE(fs::exists(nameOf(i)));
    EXPECT_FALSE(add(7));
    EXPECT_EQ(room.refused(), kBytes);
    EXPECT_TRUE(add(6));  // over the one that is there
    EXPECT_EQ(room.held().files, 5u);
    EXPECT_EQ(room.held().bytes, 5 * kBytes);
    EXPECT_EQ(room.settle(), 0u);
    EXPECT_EQ(asked, 1);
    // Another process of the same request has written meanwhile.
    write(7);
    EXPECT_EQ(room.settle(), 1u);
    EXPECT_EQ(held(), 5 * kBytes);
    EXPECT_FALSE(fs::exists(nameOf(7)));
    // What is larger than all that is not held drives nobody out.
    StoreRoom other(folder, 6 * kBytes, std::chrono::hours(1));
    other.hold([&] { return std::vector{nameOf(0), nameOf(1)}; });
    EXPECT_FALSE(other.make(nameOf(9), 5 * kBytes));
    EXPECT_EQ(held(), 5 * kBytes);
}

// As when it ran ahead for a day, in which the store was filled: what is used from then on would
// have left at once.
TEST_F(StoreRooms, WhatWasUsedBeforeTheClockWasSetBackLeavesFirst) {
    for (int i = 0; i < 4; ++i) {
        write(i);
        fs::last_write_time(nameOf(i), fs::file_time_type::clock::now() + std::chrono::hours(24) -
                                           std::chrono::minutes(i));
    }
    StoreRoom room(folder, 4 * kBytes, std::chrono::milliseconds(0));  // counts each time
    const auto add = [&](int i) {
        EXPECT_TRUE(room.make(nameOf(i), kBytes));
        write(i);
        fs::last_write_time(nameOf(i), fs::file_time_type::clock::now());
    };
    for (int i = 10; i < 14; ++i) {
        add(i);
        EXPECT_EQ(held(), 4 * kBytes);
        for (int j = 10; j <= i; ++j) EXPECT_TRUE(fs::exists(nameOf(j))) << j << " after " << i;
        EXPECT_FALSE(fs::exists(nameOf(13 - i))) << "that was used before the others";
    }
    add(14);
    EXPECT_FALSE(fs::exists(nameOf(10)));
    EXPECT_TRUE(fs::exists(nameOf(11)));
}

}  // namespace
}  // namespace timeseries
