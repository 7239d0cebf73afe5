// What every fuzz target does: write the input to a file, open it, read its first, last and middle
// step.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <span>
#include <string>

#include "timeseries/reader.h"

namespace fuzz {

inline void readAll(const std::uint8_t* data, std::size_t size, const std::string& name) {
    static const std::filesystem::path folder = [] {
        auto own = std::filesystem::temp_directory_path() / ("fuzz." + std::to_string(getpid()));
        std::filesystem::create_directories(own);
        return own;
    }();
    const std::filesystem::path path = folder / name;
    std::filesystem::remove(path);
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    try {
        const auto reader = timeseries::openReader(std::span(&path, 1));
        for (std::size_t v = 0; v < reader->variables().size(); ++v) {
            const std::size_t steps = reader->variables()[v].time->points.size();
            if (steps == 0) continue;
            for (const std::size_t step : std::set<std::size_t>{0, steps / 2, steps - 1}) {
                const timeseries::Field field = reader->read(v, step);
                const std::size_t count =
                    std::visit([](const auto& values) { return values.size(); }, field.values);
                if (count != field.grid->count()) std::abort();
            }
        }
    } catch (const timeseries::FileError& error) {
        // One sentence on one line, or it is a finding.
        if (std::string(error.what()).find('\n') != std::string::npos) std::abort();
    }
}

}  // namespace fuzz
