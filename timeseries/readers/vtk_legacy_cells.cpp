#include "timeseries/readers/vtk_legacy_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "timeseries/grid/cell_types.h"

namespace timeseries {
namespace {

// One that is no index is told as a point that there is not.
std::vector<std::uint32_t> indices(VtkText& text, std::string_view type, std::uint64_t count) {
    std::vector<std::uint32_t> found(count);
    const std::vector<double> numbers = text.numbers(*vtkLegacyType(type), count);
    std::ranges::transform(numbers, found.begin(), [](double number) {
        return number >= 0 && number < kNoPoint ? static_cast<std::uint32_t>(number) : kNoPoint;
    });
    return found;
}

std::string typeOf(VtkText& text, std::string_view section) {
    const std::string word = text.lowerWord();
    if (word != section)
        text.fail(fmt::format("expected {}, found \"{}\"", section, word.substr(0, 100)));
    const std::string type = text.lowerWord();
    const VtkType* known = vtkLegacyType(type);
    if (!known || known->type == ValueType::F32 || known->type == ValueType::F64)
        text.fail(fmt::format("expected a type of whole number, found \"{}\"", type));
    return type;
}

}  // namespace

bool VtkLegacyCells::read(VtkText& text, const std::string& word) {
    const auto once = [&](bool& has) {
        if (has) text.fail(fmt::format("expected {} once, found another", word));
        has = true;
    };
    if (word == "points") {
        once(hasPoints_);
        readPoints(text);
    } else if (word == "cells") {
        once(hasCells_);
        readCells(text);
    } else if (word == "cell_types") {
        once(hasTypes_);
        readTypes(text);
    } else {
        return false;
    }
    return true;
}

std::string VtkLegacyCells::missing() const {
    return !hasPoints_ ? "POINTS" : !hasCells_ ? "CELLS" : !hasTypes_ ? "CELL_TYPES" : "";
}

void VtkLegacyCells::readPoints(VtkText& text) {
    const std::uint64_t count = text.count("a number of points");
    const std::string name = text.lowerWord();
    const VtkType* type = vtkLegacyType(name);
    if (!type) text.fail(fmt::format("expected a type of number, found \"{}\"", name));
    const std::vector<double> numbers = text.numbers(*type, 3 * count);
    grid_.points.resize(count);
    for (std::size_t i = 0; i < count; ++i)
        grid_.points[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
}

void VtkLegacyCells::readCells(VtkText& text) {
    const std::uint64_t count = text.count("a number of cells"),
                        entries = text.count("a number of entries");
    if (endsApart_) {
        // The first stands for where the first list begins.
        const std::string endType = typeOf(text, "offsets");
        const auto offsets = indices(text, endType, count);
        if (!offsets.empty()) ends_.assign(offsets.begin() + 1, offsets.end());
        const std::string type = typeOf(text, "connectivity");
        lists_ = indices(text, type, entries);
        return;
    }
    const auto all = indices(text, "int", entries);
    std::size_t next = 0;
    for (std::uint64_t cell = 0; cell < count; ++cell) {
        const std::size_t length = next < all.size() ? all[next] : all.size();
        if (next >= all.size() || length > all.size() - next - 1)
            text.fail(fmt::format("expected the points of cell {}, but its list ends early", cell));
        lists_.insert(lists_.end(), all.begin() + static_cast<std::ptrdiff_t>(next + 1),
                      all.begin() + static_cast<std::ptrdiff_t>(next + 1 + length));
        ends_.push_back(lists_.size());
        next += 1 + length;
    }
    if (next != all.size())
        text.fail(fmt::format("expected {} entries of all cells, found {}", entries, next));
}

void VtkLegacyCells::readTypes(VtkText& text) {
    const std::uint64_t count = text.count("a number of cells");
    for (const std::uint32_t type : indices(text, "int", count))
        grid_.types.push_back(static_cast<std::uint8_t>(std::min(type, 255u)));
}

void VtkLegacyCells::addPolyhedron(const VtkText& text, std::size_t first, std::size_t last) {
    const std::size_t cell = grid_.ends.size(), corners = grid_.corners.size();
    std::size_t next = first + 1;
    for (std::uint32_t left = first < last ? lists_[first] : 0; left > 0; --left) {
        const std::size_t count = next < last ? lists_[next] : last;
        if (next >= last || count > last - next - 1)
            text.fail(fmt::format("expected the faces of cell {}, but its list ends early", cell));
        const auto points = std::span(lists_).subspan(next + 1, count);
        grid_.corners.insert(grid_.corners.end(), points.begin(), points.end());
        next += 1 + count;
    }
    if (next != last)
        text.fail(fmt::format("expected the faces of cell {}, found more than these", cell));
    grid_.faces.insert(grid_.faces.end(), lists_.begin() + static_cast<std::ptrdiff_t>(first),
                       lists_.begin() + static_cast<std::ptrdiff_t>(last));
    // Each of its points once.
    const auto begin = grid_.corners.begin() + static_cast<std::ptrdiff_t>(corners);
    std::sort(begin, grid_.corners.end());
    grid_.corners.erase(std::unique(begin, grid_.corners.end()), grid_.corners.end());
}

UnstructuredGrid VtkLegacyCells::take(const VtkText& text) {
    if (grid_.types.size() != ends_.size())
        text.fail(fmt::format("expected as many CELL_TYPES as CELLS, found {} and {}",
                              grid_.types.size(), ends_.size()));
    const bool hasFaces = std::ranges::find(grid_.types, kPolyhedron) != grid_.types.end();
    std::uint64_t first = 0;
    for (std::size_t cell = 0; cell < ends_.size(); ++cell) {
        const std::uint64_t last = ends_[cell];
        if (last < first || last > lists_.size())
            text.fail(fmt::format("expected the points of cell {}, but its list ends at {} of {}",
                                  cell, last, lists_.size()));
        if (grid_.types[cell] == kPolyhedron)
            addPolyhedron(text, first, last);
        else
            grid_.corners.insert(grid_.corners.end(),
                                 lists_.begin() + static_cast<std::ptrdiff_t>(first),
                                 lists_.begin() + static_cast<std::ptrdiff_t>(last));
        grid_.ends.push_back(grid_.corners.size());
        if (hasFaces) grid_.faceEnds.push_back(grid_.faces.size());
        first = last;
    }
    if (const std::string flaw = flawOf(grid_); !flaw.empty())
        text.fail("expected cells of points that there are, found that " + flaw);
    return std::move(grid_);
}

}  // namespace timeseries
