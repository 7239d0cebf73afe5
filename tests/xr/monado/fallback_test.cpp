// `isochron FILE` where there is no headset: it says why in one sentence, and is in a window what
// it is in a window that was asked for.
#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/monado_service.h"
#include "tests/ui/screen.h"
#include "tests/xr/monado/api_layer.h"
#include "tests/xr/monado/program.h"

namespace {

using tests::Program;

const std::vector<std::string> kAsked{
    "--step",  "12",      "--range", "600:max", "--range", "320:400", "--color",
    "#3366cc", "--order", "depth",   "--view",  "40,25",   "--clip",  "min:max,0:max,min:max"};

class Fallback : public testing::Test {
 protected:
    // `why` is a regular expression; `environment` lets the program look for a headset.
    void expectAWindow(const std::string& why,
                       const std::map<std::string, std::optional<std::string>>& environment = {}) {
        Program found({.display = "auto",
                       .screen = screen_.name(),
                       .more = kAsked,
                       .environment = environment});
        Program asked({.display = "desktop", .screen = screen_.name(), .more = kAsked});
        found.untilItSays("isochron: in a window, because ");
        const auto same = [&] {
            return !found.session().empty() && found.session() == asked.session();
        };
        found.until("both are the same", same);
        for (const char* part : {"600:max", "320:400", "#3366cc", "\"steps\": \"12\"", "depth"})
            EXPECT_THAT(found.session(), testing::HasSubstr(part));
        for (Program* each : {&found, &asked}) {
            each->signal(SIGTERM);
            EXPECT_EQ(each->exitCode(), 0) << each->said();
        }
        EXPECT_EQ(ownOf(asked.said()), "");
        EXPECT_THAT(ownOf(found.said()),
                    testing::MatchesRegex("isochron: in a window, because " + why + "\n"));

        Program headset({.display = "headset", .more = kAsked, .environment = environment});
        EXPECT_EQ(headset.exitCode(), 1);
        EXPECT_THAT(ownOf(headset.said()), testing::MatchesRegex("isochron: " + why + "\n"));
    }

    // Libraries may write to stderr, too.
    static std::string ownOf(const std::string& said) {
        std::istringstream lines(said);
        std::string own;
        for (std::string line; std::getline(lines, line);)
            if (line.starts_with("isochron")) own += line + "\n";
        return own;
    }

    std::filesystem::path folder_ = tests::freshFolder();
    ui::Screen screen_{folder_};
};

TEST_F(Fallback, WithoutARuntime) {
    if (std::filesystem::exists("/etc/openxr/1/active_runtime.json"))
        GTEST_SKIP() << "this machine has a runtime for all its users";
    expectAWindow("no OpenXR runtime is active on this machine [^\n]*",
                  {{"XR_RUNTIME_JSON", std::nullopt}, {"XDG_CONFIG_DIRS", folder_}});
}

TEST_F(Fallback, WithAManifestThatIsNotThere) {
    const std::string manifest = folder_ / "runtime.json";
    expectAWindow(
        "XR_RUNTIME_JSON names " + manifest + " as the OpenXR runtime's, and there is no such file",
        {{"XR_RUNTIME_JSON", manifest}});
}

TEST_F(Fallback, WithAManifestThatIsNoJson) {
    const std::string manifest = folder_ / "runtime.json";
    tests::writeBytes(manifest, "{");
    expectAWindow("the OpenXR runtime that " + manifest + " tells of cannot be loaded",
                  {{"XR_RUNTIME_JSON", manifest}});
}

TEST_F(Fallback, WithAManifestOfALibraryThatIsNotThere) {
    const std::string manifest = folder_ / "runtime.json";
    tests::writeBytes(
        manifest,
        R"({"file_format_version": "1.0.0", "runtime": {"library_path": "/nowhere/lib.so"}})");
    expectAWindow("the OpenXR runtime that " + manifest + " tells of cannot be loaded",
                  {{"XR_RUNTIME_JSON", manifest}});
}

TEST_F(Fallback, WithARuntimeThatCrashes) {
    const std::string manifest = folder_ / "runtime.json";
    tests::writeBytes(
        manifest,
        fmt::format(R"({{"file_format_version": "1.0.0", "runtime": {{"library_path": "{}"}}}})",
                    tests::brokenRuntime().string()));
    expectAWindow("the OpenXR runtime of " + manifest + " crashes when it is asked for a headset",
                  {{"XR_RUNTIME_JSON", manifest}, {"ISOCHRON_TEST_RUNTIME", "crashes"}});
}

TEST_F(Fallback, WithoutAService) {
    tests::MonadoService service(tests::Monado::Null);
    service.kill();
    expectAWindow("the OpenXR runtime of " MONADO_MANIFEST
                  " does not answer: its service is to be started first");
}

TEST_F(Fallback, WithoutAHeadset) {
    if (!tests::ApiLayer::isBuilt()) GTEST_SKIP() << tests::ApiLayer::kNotBuilt;
    const tests::MonadoService service(tests::Monado::Null);
    const tests::ApiLayer layer(tests::kNoHeadset);
    expectAWindow("the OpenXR runtime Monado[^\n]* finds no headset");
}

}  // namespace
