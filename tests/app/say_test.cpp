#include "app/say.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/built_paths.h"
#include "tests/support/files.h"

namespace app {
namespace {

namespace fs = std::filesystem;

TEST(Say, IsUtf8WhateverAFileSays) {
    const fs::path file = tests::freshFolder() / "said";
    std::FILE* const out = std::fopen(file.c_str(), "wb");
    sayTo(out, "{}: {} {}\n", "caf\xe9.nc", "\xb0\x43", "Å");
    std::fclose(out);
    EXPECT_EQ(tests::readBytes(file), "caf\uFFFD.nc: \uFFFD\x43 Å\n");
}

TEST(Say, TellsATerminalNothingToObey) {
    const fs::path file = tests::freshFolder() / "said";
    std::FILE* const out = std::fopen(file.c_str(), "wb");
    sayTo(out, "a\t{}b\n", std::string("\x1b[2J\0\r\x7f", 7));
    std::fclose(out);
    EXPECT_EQ(tests::readBytes(file), "a\t\uFFFD[2J\uFFFD\uFFFD\uFFFDb\n");
}

TEST(Say, IsTheOnlyDoor) {
    for (const auto& entry : fs::recursive_directory_iterator(tests::sourceFolder() / "app")) {
        const std::string name = entry.path().filename();
        const auto ending = entry.path().extension();
        if ((ending != ".cpp" && ending != ".h") || name == "say.h" || name == "progress.h")
            continue;
        const std::string text = tests::readBytes(entry.path());
        for (const char* other : {"fmt::print(", "std::cout", "std::cerr", "printf(", "puts("})
            EXPECT_EQ(text.find(other), std::string::npos) << name << " has " << other;
    }
}

}  // namespace
}  // namespace app
