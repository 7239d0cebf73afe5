#include "timeseries/readers/vtk/vtk_legacy_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "timeseries/grid/cell_types.h"

namespace timeseries {
namespace {

// One that is no index is told as a point that there is not.
std::vector<std::uint32_t> indices(VtkText& text, std::string_view type, std::uint64_t count,
                                   std::optional<std::int64_t>* none = nullptr) {
    std::vector<std::uint32_t> found(count);
    const std::vector<double> numbers = text.numbers(*vtkLegacyType(type), count);
    std::ranges::transform(numbers, found.begin(), [&](double number) {
        if (number >= 0 && number < kNoPoint) return static_cast<std::uint32_t>(number);
        if (none && !*none && std::abs(number) < 0x1p62) *none = static_cast<std::int64_t>(number);
        return kNoPoint;
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

// Of polygons, and which cell each has (cell_types.h).
struct Section {
    std::string_view word;
    std::uint8_t type;
};
constexpr std::array kSections{Section{"vertices", 2}, Section{"lines", 4}, Section{"polygons", 7}};

}  // namespace

bool VtkLegacyCells::read(VtkText& text, const std::string& word) {
    const auto once = [&](bool& has) {
        if (has) text.fail(fmt::format("expected {} once, found another", word));
        has = true;
    };
    const auto section = std::ranges::find(kSections, word, &Section::word);
    if (word == "points") {
        once(hasPoints_);
        readPoints(text);
    } else if (kind_ == Kind::Unstructured && word == "cells") {
        once(lists_[0].isThere);
        readCells(text, lists_[0]);
    } else if (kind_ == Kind::Unstructured && word == "cell_types") {
        once(hasTypes_);
        readTypes(text);
    } else if (kind_ == Kind::Polygons && section != kSections.end()) {
        Lists& lists = lists_[static_cast<std::size_t>(section - kSections.begin())];
        once(lists.isThere);
        readCells(text, lists);
    } else if (kind_ == Kind::Polygons && word == "triangle_strips") {
        text.fail(
            "expected VERTICES, LINES and POLYGONS, found triangle strips, which are not "
            "read");
    } else {
        return false;
    }
    return true;
}

std::string VtkLegacyCells::missing() const {
    if (!hasPoints_) return "POINTS";
    if (kind_ == Kind::Polygons) return "";
    return !lists_[0].isThere ? "CELLS" : !hasTypes_ ? "CELL_TYPES" : "";
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

void VtkLegacyCells::readCells(VtkText& text, Lists& lists) {
    const std::uint64_t count = text.count("a number of cells"),
                        entries = text.count("a number of entries");
    if (endsApart_) {
        // The first stands for where the first list begins.
        const std::string endType = typeOf(text, "offsets");
        const auto offsets = indices(text, endType, count);
        if (!offsets.empty()) lists.ends.assign(offsets.begin() + 1, offsets.end());
        const std::string type = typeOf(text, "connectivity");
        lists.numbers = indices(text, type, entries, &lists.none);
        return;
    }
    const auto all = indices(text, "int", entries, &lists.none);
    std::size_t next = 0;
    for (std::uint64_t cell = 0; cell < count; ++cell) {
        const std::size_t length = next < all.size() ? all[next] : all.size();
        if (next >= all.size() || length > all.size() - next - 1)
            text.fail(fmt::format("expected the points of cell {}, but its list ends early", cell));
        lists.numbers.insert(lists.numbers.end(),
                             all.begin() + static_cast<std::ptrdiff_t>(next + 1),
                             all.begin() + static_cast<std::ptrdiff_t>(next + 1 + length));
        lists.ends.push_back(lists.numbers.size());
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

void VtkLegacyCells::addPolyhedron(const VtkText& text, std::span<const std::uint32_t> list) {
    const std::size_t cell = grid_.ends.size(), corners = grid_.corners.size();
    std::size_t next = 1;
    for (std::uint32_t left = list.empty() ? 0 : list[0]; left > 0; --left) {
        const std::size_t count = next < list.size() ? list[next] : list.size();
        if (next >= list.size() || count > list.size() - next - 1)
            text.fail(fmt::format("expected the faces of cell {}, but its list ends early", cell));
        const auto points = list.subspan(next + 1, count);
        grid_.corners.insert(grid_.corners.end(), points.begin(), points.end());
        next += 1 + count;
    }
    if (next != std::max<std::size_t>(list.size(), 1))
        text.fail(fmt::format("expected the faces of cell {}, found more than these", cell));
    grid_.faces.insert(grid_.faces.end(), list.begin(), list.end());
    // Each of its points once.
    const auto begin = grid_.corners.begin() + static_cast<std::ptrdiff_t>(corners);
    std::sort(begin, grid_.corners.end());
    grid_.corners.erase(std::unique(begin, grid_.corners.end()), grid_.corners.end());
}

void VtkLegacyCells::addCorners(std::span<const std::uint32_t> list,
                                const std::optional<std::int64_t>& none) {
    const auto found = std::ranges::find(list, kNoPoint);
    if (none && found != list.end())
        grid_.keepFirst({grid_.corners.size() + static_cast<std::size_t>(found - list.begin()),
                         *none, grid_.points.size()});
    grid_.corners.insert(grid_.corners.end(), list.begin(), list.end());
}

void VtkLegacyCells::add(const VtkText& text, const Lists& lists, std::size_t firstType) {
    const bool hasFaces = std::ranges::find(grid_.types, kPolyhedron) != grid_.types.end();
    std::uint64_t first = 0;
    for (std::size_t cell = 0; cell < lists.ends.size(); ++cell) {
        const std::uint64_t last = lists.ends[cell];
        if (last < first || last > lists.numbers.size())
            text.fail(fmt::format("expected the points of cell {}, but its list ends at {} of {}",
                                  cell, last, lists.numbers.size()));
        const auto list = std::span(lists.numbers).subspan(first, last - first);
        if (grid_.types[firstType + cell] == kPolyhedron)
            addPolyhedron(text, list);
        else
            addCorners(list, lists.none);
        grid_.ends.push_back(grid_.corners.size());
        if (hasFaces) grid_.faceEnds.push_back(grid_.faces.size());
        first = last;
    }
}

UnstructuredGrid VtkLegacyCells::take(const VtkText& text) {
    if (kind_ == Kind::Polygons) {
        for (std::size_t k = 0; k < kSections.size(); ++k) {
            const std::size_t before = grid_.types.size();
            grid_.types.resize(before + lists_[k].ends.size(), kSections[k].type);
            add(text, lists_[k], before);
        }
    } else {
        if (grid_.types.size() != lists_[0].ends.size())
            text.fail(fmt::format("expected as many CELL_TYPES as CELLS, found {} and {}",
                                  grid_.types.size(), lists_[0].ends.size()));
        add(text, lists_[0], 0);
    }
    if (const std::string flaw = flawOf(grid_); !flaw.empty())
        text.fail("expected cells of points that there are, found that " + flaw);
    return std::move(grid_);
}

}  // namespace timeseries
