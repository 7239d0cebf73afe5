// AMReX plotfiles for tests, as its WriteMultiLevelPlotfile writes them: values are a formula of
// the variable, the level and the cell.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <glm/vec3.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "tests/support/files.h"
#include "timeseries/grid/lattice_levels.h"

namespace tests {

using Cell = std::array<std::int64_t, 3>;

struct Plotfile {
    int dimensions = 3;
    std::vector<std::string> names{"density", "Temp of it"};
    double time = 0;
    glm::dvec3 lo{0}, hi{1};
    std::vector<timeseries::LatticeLevel> levels;
    bool isSingle = false;  // numbers of 32 bits
    std::vector<std::int64_t>
        order;  // of their bytes, from 1, that of the sign first; none: little
    std::int64_t ghosts = 0;
    int coordinates = 0;
    std::function<double(std::size_t variable, std::size_t level, const Cell& cell)> value;
};

template <typename Use>
void forEachCellIn(const timeseries::IndexBox& box, const Use& use) {
    for (std::int64_t k = box.first[2]; k <= box.last[2]; ++k)
        for (std::int64_t j = box.first[1]; j <= box.last[1]; ++j)
            for (std::int64_t i = box.first[0]; i <= box.last[0]; ++i) use(Cell{i, j, k});
}

inline std::string indexText(const Cell& cell, int dimensions) {
    return "(" + fmt::format("{}", fmt::join(cell.begin(), cell.begin() + dimensions, ",")) + ")";
}
inline std::string boxText(const timeseries::IndexBox& box, int dimensions) {
    return fmt::format("({} {} {})", indexText(box.first, dimensions),
                       indexText(box.last, dimensions), indexText({}, dimensions));
}

template <typename T>
std::string numberText(double value, const std::vector<std::int64_t>& order) {
    const T number = static_cast<T>(value);
    std::array<char, sizeof(T)> native;
    std::memcpy(native.data(), &number, sizeof(T));
    std::string bytes(sizeof(T), '\0');
    for (std::size_t i = 0; i < sizeof(T); ++i)  // native: the sign's byte is the last
        bytes[static_cast<std::size_t>(order[i] - 1)] = native[sizeof(T) - 1 - i];
    return bytes;
}

inline std::string fabText(const Plotfile& file, std::size_t level, timeseries::IndexBox box) {
    const timeseries::IndexBox valid = box;
    for (std::size_t a = 0; a < static_cast<std::size_t>(file.dimensions); ++a) {
        box.first[a] -= file.ghosts;
        box.last[a] += file.ghosts;
    }
    std::vector<std::int64_t> order = file.order;
    if (order.empty())
        for (std::int64_t byte = file.isSingle ? 4 : 8; byte > 0; --byte) order.push_back(byte);
    std::string text = fmt::format(
        "FAB (({}),({}, ({}))){} {}\n",
        file.isSingle ? "8, (32 8 23 0 1 9 0 127)" : "8, (64 11 52 0 1 12 0 1023)", order.size(),
        fmt::join(order, " "), boxText(box, file.dimensions), file.names.size());
    for (std::size_t v = 0; v < file.names.size(); ++v)
        forEachCellIn(box, [&](const Cell& cell) {
            const timeseries::IndexBox one{cell, cell};
            const double value = valid.holds(one) ? file.value(v, level, cell) : -1e30;  // a ghost
            text +=
                file.isSingle ? numberText<float>(value, order) : numberText<double>(value, order);
        });
    return text;
}

// Boxes go by turns into two files.
inline void writeLevel(const std::filesystem::path& folder, const Plotfile& file, std::size_t l) {
    const auto& boxes = file.levels[l].boxes;
    std::array<std::string, 2> data;
    std::string text = fmt::format("1\n1\n{}\n{}\n({} 0\n", file.names.size(), file.ghosts,
                                   boxes.size()),
                fabs;
    for (std::size_t b = 0; b < boxes.size(); ++b) {
        text += boxText(boxes[b], file.dimensions) + "\n";
        fabs += fmt::format("FabOnDisk: Cell_D_0000{} {}\n", b % 2, data[b % 2].size());
        data[b % 2] += fabText(file, l, boxes[b]);
    }
    // Of least and greatest values nothing is true here.
    text += fmt::format(")\n{}\n{}\n{},{}\n", boxes.size(), fabs, boxes.size(), file.names.size());
    std::filesystem::create_directories(folder);
    writeBytes(folder / "Cell_H", text);
    writeBytes(folder / "Cell_D_00000", data[0]);
    if (!data[1].empty()) writeBytes(folder / "Cell_D_00001", data[1]);
}

inline double sideOf(const Plotfile& file, std::size_t level, int axis) {
    return (file.hi[axis] - file.lo[axis]) /
           static_cast<double>(file.levels[level].domain.size()[static_cast<std::size_t>(axis)]);
}
inline glm::dvec3 middleOf(const Plotfile& file, std::size_t level, const Cell& cell) {
    glm::dvec3 at(0);
    for (int a = 0; a < file.dimensions; ++a) {
        const auto c = static_cast<std::size_t>(a);
        at[a] = file.lo[a] + (double(cell[c] - file.levels[level].domain.first[c]) + 0.5) *
                                 sideOf(file, level, a);
    }
    return at;
}

inline std::string headerText(const Plotfile& file) {
    const auto each = [&](const auto& number) {
        std::string text;
        for (int a = 0; a < file.dimensions; ++a) text += fmt::format("{} ", number(a));
        return text + "\n";
    };
    std::string text = fmt::format("HyperCLaw-V1.1\n{}\n{}\n{}\n{}\n{}\n", file.names.size(),
                                   fmt::join(file.names, "\n"), file.dimensions, file.time,
                                   file.levels.size() - 1);
    text += each([&](int a) { return file.lo[a]; }) + each([&](int a) { return file.hi[a]; });
    for (std::size_t l = 1; l < file.levels.size(); ++l)
        text += fmt::format("{} ",
                            file.levels[l].domain.size()[0] / file.levels[l - 1].domain.size()[0]);
    text += "\n";
    for (const auto& level : file.levels) text += boxText(level.domain, file.dimensions) + " ";
    text += "\n";
    for (std::size_t l = 0; l < file.levels.size(); ++l) text += "7 ";
    text += "\n";
    for (std::size_t l = 0; l < file.levels.size(); ++l)
        text += each([&](int a) { return sideOf(file, l, a); });
    text += fmt::format("{}\n0\n", file.coordinates);
    for (std::size_t l = 0; l < file.levels.size(); ++l) {
        text += fmt::format("{} {} {}\n7\n", l, file.levels[l].boxes.size(), file.time);
        for (const auto& box : file.levels[l].boxes)
            for (int a = 0; a < file.dimensions; ++a)
                text +=
                    fmt::format("{} {}\n", middleOf(file, l, box.first)[a] - sideOf(file, l, a) / 2,
                                middleOf(file, l, box.last)[a] + sideOf(file, l, a) / 2);
        text += fmt::format("Level_{}/Cell\n", l);
    }
    return text;
}

inline void writePlotfile(const std::filesystem::path& folder, const Plotfile& file) {
    std::filesystem::create_directories(folder);
    writeBytes(folder / "Header", headerText(file));
    for (std::size_t l = 0; l < file.levels.size(); ++l)
        writeLevel(folder / fmt::format("Level_{}", l), file, l);
}

// 8 x 6 x 4 cells in three boxes, of which 4 x 4 x 4 are halved, and of these 4 x 2 x 4 again.
inline Plotfile threeLevels() {
    using Box = timeseries::IndexBox;
    Plotfile file;
    file.time = 0.1;
    file.lo = {-1, 2, 10};
    file.hi = {7, 5, 14};
    file.levels = {
        {{{0, 0, 0}, {7, 5, 3}},
         {Box{{0, 0, 0}, {3, 5, 3}}, Box{{4, 0, 0}, {7, 2, 3}}, Box{{4, 3, 0}, {7, 5, 3}}}},
        {{{0, 0, 0}, {15, 11, 7}}, {Box{{4, 2, 0}, {7, 9, 7}}, Box{{8, 2, 0}, {11, 9, 7}}}},
        {{{0, 0, 0}, {31, 23, 15}}, {Box{{12, 8, 4}, {19, 11, 11}}}}};
    file.value = [](std::size_t variable, std::size_t level, const Cell& cell) {
        return 1e6 * double(variable + 1) + 1e5 * double(level) + double(cell[0]) +
               0.01 * double(cell[1]) + 0.0001 * double(cell[2]);
    };
    return file;
}

}  // namespace tests
