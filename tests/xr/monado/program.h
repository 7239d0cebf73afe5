// The program as a user starts it, for tests with a headset's runtime or without one.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

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
        std::filesystem::path file = SOURCE_DIR "/datasets/pool_fire_T.nc";
    };
    explicit Program(const Start& start)
        : folder_(emptied(testFolder() / start.display)), process_(processOf(start)) {}

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
    std::string said() const { return process_.errors(); }

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
    static std::filesystem::path emptied(const std::filesystem::path& folder) {
        std::filesystem::remove_all(folder);
        std::filesystem::create_directories(folder);
        return folder;
    }
    ui::Process::Start processOf(const Start& start) const {
        ui::Process::Start process{.program = PROGRAM,
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
