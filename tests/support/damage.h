// Rounds of damage to a file: whatever is cut off or put there, it is read, or refused in a
// sentence.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <random>
#include <string>
#include <variant>

#include "tests/support/files.h"
#include "tests/support/read_variables.h"
#include "tests/support/rounds.h"

namespace tests {

// Opens it and reads the first and the last step of all variables; whether that was refused.
inline bool isRefusedInOneSentence(const std::filesystem::path& path) {
    try {
        const auto reader = open(path);
        for (std::size_t v = 0; v < reader->variables().size(); ++v)
            for (const std::size_t step :
                 {std::size_t{0}, reader->variables()[v].time->points.size() - 1}) {
                const timeseries::Field field = reader->read(v, step);
                const std::size_t count =
                    std::visit([](const auto& values) { return values.size(); }, field.values);
                EXPECT_EQ(count, field.grid->count());
            }
        return false;
    } catch (const timeseries::FileError& error) {
        const std::string told = error.what();
        // This file, or one beside it that it is read with.
        EXPECT_NE(told.find(path.parent_path().string()), told.npos) << told;
        EXPECT_EQ(told.find('\n'), told.npos) << told;
        return true;
    }
}

// `opened` is what is opened: the file itself, or one that names it. Cuts at each of some lengths,
// bytes that are swapped or by chance, and numbers of four bytes that are hostile sizes: so many of
// either.
inline void damageInRounds(const std::filesystem::path& file, const std::filesystem::path& opened,
                           int count = 400) {
    const std::string whole = readBytes(file);
    ASSERT_FALSE(isRefusedInOneSentence(opened));
    const auto tryOut = [&](const std::string& damaged) {
        writeBytes(file, damaged);
        isRefusedInOneSentence(opened);
    };
    const std::size_t every = std::max<std::size_t>(1, whole.size() / rounds(count));
    for (std::size_t bytes = 0; bytes < whole.size(); bytes += every)
        tryOut(whole.substr(0, bytes));
    std::mt19937 random(29);
    for (int round = 0; round < rounds(count); ++round) {
        std::string damaged = whole;
        // What says how much there is mostly stands at the beginning.
        const std::size_t among =
            round % 2 == 0 ? std::min<std::size_t>(64, whole.size()) : whole.size();
        const std::size_t at = random() % among;
        constexpr std::array<std::uint32_t, 5> kHostile{0, 1, 0x7fffffff, 0x80000000, 0xffffffff};
        switch (round / 2 % 3) {
            case 0:
                std::swap(damaged[at], damaged[random() % damaged.size()]);
                break;
            case 1:
                for (std::size_t i = at; i < std::min(at + 1 + random() % 3, damaged.size()); ++i)
                    damaged[i] = static_cast<char>(random());
                break;
            default:
                for (std::size_t b = 0; b < 4 && at / 4 * 4 + b < damaged.size(); ++b)
                    damaged[at / 4 * 4 + b] = static_cast<char>(kHostile[round / 6 % 5] >> (8 * b));
        }
        tryOut(damaged);
    }
    writeBytes(file, whole);
}

}  // namespace tests
