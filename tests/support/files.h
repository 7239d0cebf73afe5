// Small files for tests, all inside the test's own folder.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>

namespace tests {

// This process's folder under TempDir, removed when it ends: tests run side by side, builds too.
class ProcessFolder {
 public:
    static const std::filesystem::path& path() {
        static const ProcessFolder folder;
        return folder.path_;
    }
    ~ProcessFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }

 private:
    ProcessFolder()
        : path_(std::filesystem::path(testing::TempDir()) / fmt::format("isochron-{}", getpid())) {}
    std::filesystem::path path_;
};

// A folder of the running test alone.
inline std::filesystem::path testFolder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = fmt::format("{}.{}", test->test_suite_name(), test->name());
    std::replace(name.begin(), name.end(), '/', '-');  // of parameterised tests
    const std::filesystem::path folder = ProcessFolder::path() / name;
    std::filesystem::create_directories(folder);
    return folder;
}

// The same, emptied.
inline std::filesystem::path freshFolder() {
    std::filesystem::remove_all(testFolder());
    return testFolder();
}

inline std::string readBytes(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline void writeBytes(const std::filesystem::path& file, const std::string& bytes) {
    std::filesystem::remove(file);  // some file systems wait for the disk when one is written over
    std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace tests
