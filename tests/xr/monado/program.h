// The program as a user starts it, for tests with a headset's runtime or without one.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/built_paths.h"
#include "tests/support/files.h"
#include "tests/ui/process.h"
#include "tests/ui/waiting.h"

namespace tests {

// Its user's files are in a folder of the test's, named after its --display: one of each at a time.
class Program {
 public:
    struct Start {
        std::string display;                     // auto, headset, desktop
        std::optional<std::string> screen = {};  // $DISPLAY; without one there is none
        std::vector<std::string> more = {};      // arguments
        std::map<std::string, std::optional<std::string>> environment = {};
        std::filesystem::path file = tests::demo();
        std::string preferences = {};  // of the user, as JSON
    };
    explicit Program(const Start& start) : folder_(madeFor(start)), process_(processOf(start)) {}

    // What it saves for a crash once data are shown; empty before, and after a good end.
    std::string session() const {
        const auto state = folder_ / "isochron";
        if (!std::filesystem::exists(state)) return {};
        for (const auto& file : std::filesystem::directory_iterator(state)) {
            const std::string name = file.path().filename();
            if (name.starts_with("autosave-") && name.ends_with(".json"))
                return readBytes(file.path());
        }
        return {};
    }
    std::string preferences() const { return readBytes(folder_ / "isochron" / "preferences.json"); }
    std::string said() const { return process_.errors(); }
    pid_t id() const { return process_.id(); }

    // Throws std::runtime_error when that does not come, or the program ends instead.
    template <typename Condition>
    void until(const std::string& what, const Condition& holds) {
        ui::waitUntil(what, [&] {
            if (holds()) return true;
            if (!process_.isRunning()) throw std::runtime_error("the program has ended: " + said());
            return false;
        });
    }
    void untilItSavesItsSession() {
        until("the session is saved", [this] { return !session().empty(); });
    }
    void untilItSays(const std::string& what) {
        until(what, [&] { return said().find(what) != std::string::npos; });
    }

    void signal(int number) const { process_.signal(number); }
    int exitCode() { return process_.exitCode(); }

 private:
    static std::filesystem::path madeFor(const Start& start) {
        const std::filesystem::path folder = testFolder() / start.display;
        std::filesystem::remove_all(folder);
        std::filesystem::create_directories(folder / "isochron");
        if (!start.preferences.empty())
            writeBytes(folder / "isochron" / "preferences.json", start.preferences);
        return folder;
    }
    ui::Process::Start processOf(const Start& start) const {
        ui::Process::Start process{.program = tests::program(),
                                   .arguments = {start.file, "--display", start.display},
                                   .folder = folder_,
                                   .environment = start.environment};
        process.arguments.insert(process.arguments.end(), start.more.begin(), start.more.end());
        process.environment["DISPLAY"] = start.screen;
        for (const char* users : {"XDG_STATE_HOME", "XDG_CONFIG_HOME"})
            process.environment[users] = folder_;
        return process;
    }

    std::filesystem::path folder_;
    ui::Process process_;
};

}  // namespace tests
