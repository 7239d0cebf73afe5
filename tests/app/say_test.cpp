#include "app/say.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "app/json_text.h"
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

TEST(Say, TellsATerminalNothingToObeyInUtf8Either) {
    // C1's ends, CSI among them; what turns the text round, and back; none of their neighbours.
    for (const char* obeyed :
         {"\u0080", "\u009b", "\u009f", "\u202a", "\u202e", "\u2066", "\u2069"})
        EXPECT_EQ(harmless(obeyed), "\uFFFD") << obeyed;
    for (const char* shown :
         {"\u00a0", "\u00e9", "\u2029", "\u202f", "\u2065", "\u206a", "\U0001F300"})
        EXPECT_EQ(harmless(shown), shown);
}

TEST(JsonText, HoldsItsDataInWhatATerminalDoesNotObey) {
    const std::string raw("a\x7f\u009b\u202e\x1b\n\t\"\\\0\u00e9\U0001F300", 26);
    const nlohmann::json data{{raw, {raw, 1}}};
    for (const int indent : {-1, 2}) {
        const std::string text = jsonText(data, indent);
        EXPECT_EQ(nlohmann::json::parse(text), data);
        EXPECT_EQ(harmless(text), text);
    }
    EXPECT_EQ(jsonText(nlohmann::json("\x7f\u0085\u2066"), -1), R"("\u007f\u0085\u2066")");
    // What is no UTF-8 no JSON can hold.
    EXPECT_EQ(jsonText(nlohmann::json("caf\xe9"), -1), "\"caf\uFFFD\"");
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
