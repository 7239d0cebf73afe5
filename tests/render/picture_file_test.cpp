#include "render/image/picture_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <string>

#include "render/image/image.h"
#include "tests/support/files.h"

namespace render {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& to, const std::string& text) {
    PartialFile file(to);
    std::fwrite(text.data(), 1, text.size(), file.stream());
    file.commit();
}

TEST(PartialFile, ReplacesWhatALinkLeadsTo) {
    const fs::path folder = tests::freshFolder(), link = folder / "link";
    tests::writeBytes(folder / "old", "before");
    fs::create_symlink("old", link);
    write(link, "after");
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(tests::readBytes(folder / "old"), "after");
    // One that leads nowhere is replaced itself.
    fs::create_symlink("nowhere", folder / "loose");
    write(folder / "loose", "there");
    EXPECT_EQ(tests::readBytes(folder / "loose"), "there");
}

TEST(PartialFile, WritesIntoWhatIsNoFile) {
    const fs::path pipe = tests::freshFolder() / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const int reader =
        ::open(pipe.c_str(), O_RDWR | O_NONBLOCK);  // who also writes need not wait for a writer
    ASSERT_GE(reader, 0);
    write(pipe, "through");
    EXPECT_TRUE(fs::is_fifo(pipe));
    char text[16];
    const auto count = ::read(reader, text, sizeof text);
    ::close(reader);
    ASSERT_GT(count, 0);
    EXPECT_EQ(std::string(text, static_cast<std::size_t>(count)), "through");
}

TEST(PartialFile, NoneIsLeftByAProgramThatASignalEnds) {
    const fs::path folder = tests::freshFolder();
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const pid_t child = ::fork();
        if (child == 0) {
            PartialFile::leaveNoneWhenEnded();
            write(folder / "done", "done");
            const PartialFile one(folder / "one.png"), other(folder / "other.png");
            ::raise(signal);
            ::_exit(0);
        }
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal);
        EXPECT_EQ(tests::readBytes(folder / "done"), "done");
        EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
    }
}

// A program that was ended leaves one; one that writes has it still.
TEST(PartialFile, LeftoversAreNotInTheWay) {
    const fs::path folder = tests::freshFolder(), to = folder / "picture.png";
    for (int n = 0; n < 100; ++n)
        tests::writeBytes(folder / ("picture.png.isochron-part" + std::to_string(n)), "left");
    {
        PartialFile one(to), other(to);
        std::fputs("one", one.stream());
        std::fputs("other", other.stream());
        one.commit();
        EXPECT_EQ(tests::readBytes(to), "one");
        other.commit();
        EXPECT_EQ(tests::readBytes(to), "other");
    }
    write(to, "after");
    EXPECT_EQ(tests::readBytes(to), "after");
    EXPECT_FALSE(fs::exists(folder / "picture.png.isochron-part0"));
    EXPECT_FALSE(fs::exists(folder / "picture.png.isochron-part1"));
}

TEST(PartialFile, WhatIsLeftIsRemovedAndWhatIsWrittenNot) {
    const fs::path folder = tests::freshFolder(), to = folder / "picture.png";
    const auto part = [&](int n) {
        return folder / ("picture.png.isochron-part" + std::to_string(n));
    };
    PartialFile written(to);
    ASSERT_TRUE(fs::exists(part(0)));
    tests::writeBytes(part(1), "left");
    for (int n = 0; n < 3; ++n) PartialFile::removeLeft(part(n));
    EXPECT_TRUE(fs::exists(part(0)));
    EXPECT_FALSE(fs::exists(part(1)));
    written.commit();
    EXPECT_TRUE(fs::exists(to));
}

TEST(PartialFile, NamesWhatItIsToBecome) {
    EXPECT_EQ(PartialFile::destinationOf("a/b.png.isochron-part12"), "a/b.png");
    for (const char* other : {"b.png", "b.png.isochron-part", "b.png.isochron-part1x",
                              "b.png.isochron-part1.png", "", "isochron-part1"})
        EXPECT_EQ(PartialFile::destinationOf(other), "") << other;
}

TEST(PictureFile, ItsFormatIsToldByTheEndingInCapitalsOrNot) {
    for (const char* name : {"a.png", "a.PNG", "a.exr.Png"}) EXPECT_TRUE(isPng(name)) << name;
    for (const char* name : {"a.exr", "a.EXR"}) EXPECT_TRUE(isExr(name)) << name;
    for (const char* name : {"a.pngs", "png", "a.png.json", ""}) {
        EXPECT_FALSE(isPng(name)) << name;
        EXPECT_FALSE(isExr(name)) << name;
    }
}

TEST(PartialFile, WhoMayReadAFileStaysAsItIs) {
    const fs::path to = tests::freshFolder() / "own";
    tests::writeBytes(to, "before");
    fs::permissions(to, fs::perms::owner_read | fs::perms::owner_write);
    write(to, "after");
    EXPECT_EQ(fs::status(to).permissions(), fs::perms::owner_read | fs::perms::owner_write);
    EXPECT_EQ(tests::readBytes(to), "after");
    if (::geteuid() == 0) return;  // who may write everything
    fs::permissions(to, fs::perms::owner_read);
    EXPECT_THROW(write(to, "never"), ImageError);
    EXPECT_EQ(tests::readBytes(to), "after");
}

}  // namespace
}  // namespace render
