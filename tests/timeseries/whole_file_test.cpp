#include "timeseries/series/whole_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/files.h"

namespace timeseries {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& to, std::string_view text) {
    WholeFile file(to);
    file.write(0, std::as_bytes(std::span(text)));
    file.finish();
}

TEST(WholeFile, ReplacesWhatALinkLeadsTo) {
    const fs::path folder = tests::freshFolder(), link = folder / "link";
    fs::create_directory(folder / "elsewhere");
    tests::writeBytes(folder / "elsewhere" / "old", "before");
    fs::create_symlink("elsewhere/old", link);
    write(link, "after");
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(tests::readBytes(folder / "elsewhere" / "old"), "after");
    fs::create_symlink("nowhere", folder / "loose");
    write(folder / "loose", "there");
    EXPECT_EQ(tests::readBytes(folder / "loose"), "there");
}

TEST(WholeFile, LeavesWhatIsNoFile) {
    const fs::path pipe = tests::freshFolder() / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_THROW(write(pipe, "never"), StepFileError);
    EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST(WholeFile, WhoMayReadItStaysAsItIs) {
    const fs::path to = tests::freshFolder() / "own";
    tests::writeBytes(to, "before");
    fs::permissions(to, fs::perms::owner_read | fs::perms::owner_write);
    write(to, "after");
    EXPECT_EQ(fs::status(to).permissions(), fs::perms::owner_read | fs::perms::owner_write);
    EXPECT_EQ(tests::readBytes(to), "after");
}

// More than the system takes at once, and some of them empty.
TEST(WholeFile, HasPiecesOneBehindTheOther) {
    const fs::path to = tests::freshFolder() / "pieces";
    std::vector<std::string> texts;
    std::string all = "at";
    for (std::size_t i = 0; i < 5000; ++i) {
        texts.emplace_back(i % 7, static_cast<char>('a' + i % 26));
        all += texts.back();
    }
    std::vector<std::span<const std::byte>> pieces;
    for (const std::string& text : texts) pieces.push_back(std::as_bytes(std::span(text)));
    WholeFile file(to);
    file.writePieces(2, pieces);
    file.writePieces(1, {});
    file.write(0, std::as_bytes(std::span(std::string_view("at"))));
    file.finish();
    EXPECT_EQ(tests::readBytes(to), all);
}

}  // namespace
}  // namespace timeseries
