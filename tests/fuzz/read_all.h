// What every fuzz target does: write the input to a file, open it, read its first, last and middle
// step.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "timeseries/readers/reader.h"

namespace fuzz {

// This process's own, removed when it ends as it should.
inline const std::filesystem::path& folder() {
    struct Own {
        std::filesystem::path path =
            std::filesystem::temp_directory_path() / ("fuzz." + std::to_string(getpid()));
        Own() { std::filesystem::create_directories(path); }
        ~Own() {
            std::error_code ignored;
            std::filesystem::remove_all(path, ignored);
        }
    };
    static const Own own;
    return own.path;
}

inline std::filesystem::path write(const std::string& name, std::string_view bytes) {
    const std::filesystem::path path = folder() / name;
    // Some file systems wait for the disk when a file is written over.
    std::filesystem::remove(path);
    std::ofstream(path, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path;
}

// Of an input of several texts, what comes before the next that tells them apart, which is passed.
inline std::string_view next(std::string_view& rest,
                             std::string_view apart = std::string_view("\0", 1)) {
    const std::size_t end = std::min(rest.find(apart), rest.size());
    const std::string_view part = rest.substr(0, end);
    rest.remove_prefix(std::min(end + apart.size(), rest.size()));
    return part;
}

inline void readAll(const std::filesystem::path& path) {
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

inline void readAll(std::string_view bytes, const std::string& name) {
    readAll(write(name, bytes));
}

inline std::string_view text(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

}  // namespace fuzz
