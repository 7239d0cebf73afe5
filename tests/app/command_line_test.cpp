#include "app/choices/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>
#include <random>

#include "app/choices/options.h"
#include "tests/support/files.h"
#include "tests/support/random_explorer.h"
#include "tests/support/rounds.h"
#include "tests/support/variable.h"

namespace app {
namespace {

namespace fs = std::filesystem;

Explorer parsedBack(const std::vector<std::string>& arguments) {
    std::vector<const char*> pointers;
    for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
    const Command command = parse(pointers);
    if (const auto* exit = std::get_if<Exit>(&command)) throw std::runtime_error(exit->text);
    return std::get<RenderOptions>(command).explorer;
}

// What resolved() leaves: nothing open.
Explorer closed(Explorer e) {
    const auto close = [](LayerChoice& layer) {
        if (!layer.color) layer.color = glm::dvec3(1, 0.2, 0);
        if (auto* map = std::get_if<MapChoice>(&*layer.color)) {
            map->lo = map->lo.value_or(-1.0 / 3);
            map->hi = map->hi.value_or(1e20);
        }
        if (!layer.opacity) layer.opacity = 0.1;
    };
    std::erase_if(e.layers,
                  [](const LayerChoice& layer) { return layer.ranges.empty() && !layer.motion; });
    if (e.layers.empty()) e.layers.push_back({timeseries::RangeSet::parse("0:1"), {}, {}});
    for (LayerChoice& layer : e.layers) close(layer);
    return e;
}

TEST(CommandLine, GivesBackTheSameExplorer) {
    tests::RandomExplorer next(86);
    for (int i = 0; i < tests::rounds(400); ++i) {
        Explorer e = closed(next());
        for (const char* folder : {"/data/run", "/elsewhere/deep"}) {
            const auto arguments = renderArguments(e, "/out/a.exr", folder);
            Explorer back = parsedBack(arguments);
            for (fs::path& file : back.files) file = (folder / file).lexically_normal();
            Explorer expected = e;
            expected.play = {};
            if (e.oneTick) expected.play.tick = e.play.tick;
            ASSERT_TRUE(back == expected) << "case " << i << ": " << shellText(arguments) << '\n'
                                          << shellText(renderArguments(back, "/out/a.exr", folder));
        }
    }
}

TEST(CommandLine, FilesAreNeverTakenForOptionsOrCommands) {
    for (const char* name : {"-a.nc", "--json", "info", "count", "render", "view", "a=b",
                             "[a,b].nc", "a b", "é 世界"}) {
        Explorer e = closed({});
        e.files = {fs::path("/data") / name};
        const auto back = parsedBack(renderArguments(e, "/data/-o.png", "/data"));
        ASSERT_EQ(back.files.size(), 1u) << name;
        EXPECT_EQ(("/data" / back.files[0]).lexically_normal(), e.files[0]);
    }
}

// A hidden layer: the same picture, of nothing.
TEST(CommandLine, OfNoLayersDrawsNone) {
    Explorer e;
    e.files = {"/data/fire.nc"};
    e.noLayers = true;
    const Explorer back = parsedBack(renderArguments(e, "/data/fire.png", "/data"));
    ASSERT_EQ(back.layers.size(), 1u);
    EXPECT_FALSE(back.layers[0].visible);
}

TEST(CommandLine, SaysNothingThatGoesWithoutSaying) {
    Explorer e;
    e.files = {"/data/fire.nc"};
    e.variable = "T";
    e.steps = StepChoice{12, 12};
    e.layers = {{timeseries::RangeSet::parse("600:max"), glm::dvec3(1, 0, 0), 0.25}};
    EXPECT_EQ(shellText(renderArguments(e, "/data/out/fire.png", "/data")),
              "render fire.nc --variable=T --step=12 --view=30,20 --shift=auto --range=600:max "
              "'--color=#ff0000' --opacity=0.25 --output=out/fire.png");
    // No way up: it would lead elsewhere from the next folder.
    EXPECT_EQ(
        shellText(renderArguments(e, "/data/out/fire.png", "/data/out")),
        "render /data/fire.nc --variable=T --step=12 --view=30,20 --shift=auto --range=600:max "
        "'--color=#ff0000' --opacity=0.25 --output=fire.png");
}

// What the shell hands to a program that is called so.
std::vector<std::string> throughTheShell(const std::string& line) {
    const std::string command = "printf '%s\\0' " + line;
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::string all;
    std::array<char, 4096> some{};
    while (const std::size_t count = std::fread(some.data(), 1, some.size(), pipe.get()))
        all.append(some.data(), count);
    std::vector<std::string> arguments;
    for (std::size_t at = 0; at < all.size();) {
        arguments.emplace_back(all.c_str() + at);
        at += arguments.back().size() + 1;
    }
    return arguments;
}

// What the shell calls by these words, in a folder where PATH is this.
class CallOfProgram : public testing::Test {
 protected:
    const fs::path program_ = fs::read_symlink("/proc/self/exe");

 private:
    const tests::Variable byNoScript_{"ISOCHRON_RUN", std::nullopt};
};

TEST_F(CallOfProgram, IsTheScriptThatStartedItAsTheUsersShellSeesIt) {
    const tests::Variable here("ISOCHRON_RUN", "./run");
    EXPECT_EQ(callOfProgram(), "./run");
    const tests::Variable above("ISOCHRON_RUN", "../my isochron/run");
    EXPECT_EQ(callOfProgram(), "'../my isochron/run'");
}

TEST_F(CallOfProgram, IsItsNameWherePathHasItAndElseItsPath) {
    const fs::path folder = tests::freshFolder() / "bin";
    fs::create_directory(folder);
    const std::string name = program_.filename(), paths = "/none::" + folder.string() + ":/usr/bin";
    const tests::Variable searched("PATH", paths);
    EXPECT_EQ(callOfProgram(), program_.string());
    fs::create_symlink(program_, folder / name);
    EXPECT_EQ(callOfProgram(), name);
    // Another program of that name is not it.
    fs::remove(folder / name);
    tests::writeBytes(folder / name, "#!/bin/sh");
    EXPECT_EQ(callOfProgram(), program_.string());
    const tests::Variable nowhere("PATH", std::nullopt);
    EXPECT_EQ(callOfProgram(), program_.string());
}

// As Linux tells it: with a word behind the name that is no part of it.
TEST_F(CallOfProgram, IsItsPathAlsoWhereItsFileIsGoneOrAnotherHasItsPlace) {
    const fs::path folder = tests::freshFolder();
    const fs::path program = folder / "isochron", running = folder / "exe";
    const tests::Variable nowhere("PATH", std::nullopt);
    fs::create_symlink(program.string() + " (deleted)", running);
    EXPECT_EQ(callOfProgram(running), program.string());
    tests::writeBytes(program, "built anew");
    EXPECT_EQ(callOfProgram(running), program.string());
    // A file may be named so.
    const fs::path named = program.string() + " (deleted)";
    tests::writeBytes(named, "");
    EXPECT_EQ(callOfProgram(running), "'" + named.string() + "'");
    fs::remove(named);
    const tests::Variable found("PATH", folder.string());
    EXPECT_EQ(callOfProgram(running), "isochron");
}

TEST(ShellText, TheShellReadsEveryArgumentAsItIs) {
    std::mt19937 random(15);
    const std::string special = " '\"\\$`!*?[](){}<>|&;#~\n\t=%";
    for (int i = 0; i < 60; ++i) {
        std::vector<std::string> arguments(1 + random() % 8);
        for (std::string& argument : arguments)
            for (std::size_t n = random() % 12; n > 0; --n)
                argument += random() % 2 == 0 ? special[random() % special.size()]
                                              : static_cast<char>(1 + random() % 255);
        EXPECT_EQ(throughTheShell(shellText(arguments)), arguments) << shellText(arguments);
    }
}

TEST(ShellText, OfACallIsThatCall) {
    tests::RandomExplorer next(4);
    for (int i = 0; i < 20; ++i) {
        const auto arguments = renderArguments(closed(next()), "/out/a b.exr", "/data");
        EXPECT_EQ(throughTheShell(shellText(arguments)), arguments);
    }
}

}  // namespace
}  // namespace app
