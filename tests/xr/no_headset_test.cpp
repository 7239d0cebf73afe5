// Why there is no headset, where no runtime is needed to find out.
#include <gmock/gmock.h>

#include <filesystem>
#include <optional>
#include <string>

#include "tests/support/built_paths.h"
#include "tests/support/files.h"
#include "tests/support/variable.h"
#include "xr/session.h"

namespace xr {
namespace {

using tests::Variable;

std::string whyNone() {
    const auto answer = Session::ask();
    const auto* none = std::get_if<NoHeadset>(&answer);
    return none != nullptr ? none->why : "a headset";
}

TEST(NoHeadset, AManifestThatIsNamedAndMissingIsNamed) {
    const std::string missing = tests::testFolder() / "no_such_runtime.json";
    const Variable variable("XR_RUNTIME_JSON", missing);
    EXPECT_EQ(whyNone(), "XR_RUNTIME_JSON names " + missing +
                             " as the OpenXR runtime's, and there is no such file");
}

TEST(NoHeadset, ABrokenManifestIsNamed) {
    for (const char* contents :
         {"", "{", R"({"file_format_version": "1.0.0"})",
          R"({"file_format_version": "1.0.0", "runtime": {"library_path": "/nowhere/lib.so"}})"}) {
        const std::string path = tests::testFolder() / "broken_runtime.json";
        tests::writeBytes(path, contents);
        const Variable variable("XR_RUNTIME_JSON", path);
        EXPECT_EQ(whyNone(), "the OpenXR runtime that " + path + " tells of cannot be loaded");
    }
}

TEST(NoHeadset, AMachineWithoutARuntimeIsSaidToHaveNone) {
    const Variable manifest("XR_RUNTIME_JSON", std::nullopt);
    const Variable own("XDG_CONFIG_HOME", tests::freshFolder());
    const Variable shared("XDG_CONFIG_DIRS", tests::freshFolder());
    if (std::filesystem::exists("/etc/openxr/1/active_runtime.json"))
        GTEST_SKIP() << "this machine has a runtime for all its users";
    EXPECT_THAT(whyNone(), testing::StartsWith("no OpenXR runtime is active on this machine"));
}

std::string manifestOfABrokenRuntime() {
    const std::string path = tests::testFolder() / "runtime.json";
    tests::writeBytes(
        path,
        fmt::format(R"({{"file_format_version": "1.0.0", "runtime": {{"library_path": "{}"}}}})",
                    tests::brokenRuntime().string()));
    return path;
}

TEST(NoHeadset, ARuntimeThatCrashesIsToldAndCrashesNothingElse) {
    const std::string path = manifestOfABrokenRuntime();
    const Variable manifest("XR_RUNTIME_JSON", path), fault("ISOCHRON_TEST_RUNTIME", "crashes");
    // A sanitizer may take seconds to tell where it crashes.
    const auto answer = Session::ask(std::chrono::seconds(60));
    ASSERT_TRUE(std::holds_alternative<NoHeadset>(answer));
    EXPECT_EQ(std::get<NoHeadset>(answer).why,
              "the OpenXR runtime of " + path + " crashes when it is asked for a headset");
}

TEST(NoHeadset, ARuntimeThatHangsIsNotWaitedForLong) {
    const std::string path = manifestOfABrokenRuntime();
    const Variable manifest("XR_RUNTIME_JSON", path), fault("ISOCHRON_TEST_RUNTIME", "hangs");
    const auto answer = Session::ask(std::chrono::seconds(1));
    ASSERT_TRUE(std::holds_alternative<NoHeadset>(answer));
    EXPECT_EQ(std::get<NoHeadset>(answer).why,
              "the OpenXR runtime of " + path +
                  " does not answer for 1 s when it is asked for a headset");
}

}  // namespace
}  // namespace xr
