// A sorted step in a file of its own.
#pragma once

#include <cstddef>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "tests/support/files.h"
#include "tests/support/random_field.h"
#include "tests/support/step_bytes.h"
#include "timeseries/readers/step_about.h"

namespace tests {

inline std::vector<std::byte> bytesOfAStep() {
    std::mt19937_64 random(1);
    return written(timeseries::SortedStep::build(randomField<float>(random, {200, 200, 10}, 0)),
                   textOf(timeseries::StepAbout{}));
}

inline std::filesystem::path fileOf(const std::vector<std::byte>& bytes) {
    const std::filesystem::path path = testFolder() / "u.isostep";
    writeBytes(path, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    return path;
}

}  // namespace tests
