// A screen that does to the program what Xvfb never does; see stand_in.cpp.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>

namespace ui {

class StandIn {
 public:
    explicit StandIn(const std::filesystem::path& folder) : file_(folder / "stand_in") { say(); }

    // To start the program with.
    std::map<std::string, std::optional<std::string>> environment() const {
        return {{"LD_PRELOAD", STAND_IN}, {"ISOCHRON_STAND_IN", file_.string()}};
    }
    // From the program's next frame on.
    void scale(double scale) {
        scale_ = scale;
        say();
    }
    void glError(bool is) {
        glError_ = is;
        say();
    }

 private:
    // At once: the program may be reading.
    void say() const {
        auto whole = file_;
        whole += ".new";
        std::ofstream(whole) << fmt::format("{} {}\n", scale_, glError_ ? 1 : 0);
        std::filesystem::rename(whole, file_);
    }
    std::filesystem::path file_;
    double scale_ = 1;
    bool glError_ = false;
};

}  // namespace ui
