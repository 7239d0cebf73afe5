// The program run as its user runs it, and files for it.
#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/bench/median.h"
#include "tests/support/built_paths.h"

namespace bench {

// An NRRD file of n^3 values.
template <typename T>
void writeField(const std::filesystem::path& file, const char* type, std::size_t n,
                const std::vector<T>& values) {
    const std::string size = std::to_string(n);
    std::ofstream out(file, std::ios::binary);
    out << "NRRD0004\ntype: " << type << "\ndimension: 3\nsizes: " << size << ' ' << size << ' '
        << size << "\nendian: little\nencoding: raw\n\n";
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(T)));
}

// The program, its output thrown away: its time, and the most memory it had.
struct ProgramRun {
    double ms = 0, megabytes = 0;
};
inline ProgramRun runProgram(std::vector<std::string> arguments,
                             const std::string& program = tests::program()) {
    arguments.insert(arguments.begin(), program);
    std::vector<char*> raw;
    for (std::string& argument : arguments) raw.push_back(argument.data());
    raw.push_back(nullptr);
    const auto start = std::chrono::steady_clock::now();
    const pid_t child = ::fork();
    if (child == 0) {
        const int nowhere = ::open("/dev/null", O_WRONLY);
        ::dup2(nowhere, STDOUT_FILENO);
        ::dup2(nowhere, STDERR_FILENO);
        ::execv(raw[0], raw.data());
        ::_exit(127);
    }
    int status = 0;
    rusage used{};
    if (::wait4(child, &status, 0, &used) != child || status != 0) std::abort();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    return {took.count(), static_cast<double>(used.ru_maxrss) * 1024 / 1e6};
}

inline ProgramRun medianRun(const std::vector<std::string>& arguments) {
    std::vector<double> ms, megabytes;
    for (int i = 0; i < 5; ++i) {
        const ProgramRun run = runProgram(arguments);
        ms.push_back(run.ms);
        megabytes.push_back(run.megabytes);
    }
    return {median(ms), median(megabytes)};
}

}  // namespace bench
