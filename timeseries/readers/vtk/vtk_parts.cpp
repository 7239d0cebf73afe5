#include "timeseries/readers/vtk/vtk_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "timeseries/readers/ordinary_file.h"
#include "timeseries/readers/vtk/vtk_file.h"
#include "timeseries/readers/vtk/vtk_joined_cells.h"
#include "timeseries/readers/vtk/vtk_multiblock.h"
#include "timeseries/readers/vtk/vtk_time.h"
#include "timeseries/readers/vtk/vtk_xml_numbers.h"

namespace timeseries {
namespace {

using Path = std::filesystem::path;

// By how much what parts share may differ, of a length beside it: writers work it out each for
// itself.
constexpr double kRounding = 1e-6;

const XmlElement& gridOfParts(const XmlFile& file) {
    const std::string_view type = rootOf(file).attribute("type");
    const auto grids = named(file.root, type);
    if (grids.size() != 1)
        failVtk(file.path, "VTKFile", fmt::format("expected one {}, found {}", type, grids.size()));
    return *grids[0];
}

// Processes that had nothing of a grid leave an empty part.
std::vector<VtkHeader> partsOf(const XmlFile& file, const XmlElement& grid) {
    std::vector<VtkHeader> parts;
    forEachVtkPart(file, [&](const XmlFile& part) {
        if (!isEmptyVtkFile(part)) parts.push_back(openVtkXml(part));
        return true;
    });
    if (parts.empty()) failVtk(file.path, placeOf(grid), "expected a Piece that holds points");
    return parts;
}

const VtkArray* arrayIn(const VtkHeader& part, const VtkArray& array) {
    const auto found = std::ranges::find_if(part.arrays, [&](const VtkArray& other) {
        return other.name == array.name && other.place == array.place && other.type == array.type &&
               other.components == array.components;
    });
    return found == part.arrays.end() ? nullptr : &*found;
}

// The arrays that the first part has; all have them. `file` declares them, if there is one.
void joinArrays(VtkHeader& whole, std::span<const VtkHeader> parts, const XmlFile* file) {
    whole.arrays = parts[0].arrays;
    if (file != nullptr) keepDeclared(*file, whole.arrays);
    whole.passedOver = parts[0].passedOver;
    for (const VtkHeader& part : parts) {
        for (const VtkPlace place : {VtkPlace::Points, VtkPlace::Cells}) {
            auto& ghosts = whole.ghosts[static_cast<std::size_t>(place)];
            ghosts = ghosts || part.ghosts[static_cast<std::size_t>(place)];
        }
        for (VtkArray& array : whole.arrays) {
            const VtkArray* const its = arrayIn(part, array);
            if (!its)
                failVtk(part.path, fmt::format("'{}'", array.name),
                        fmt::format("expected {} of {} components, as in {}", typeName(array.type),
                                    array.components, parts[0].path.filename().string()));
            if (array.notNumber.empty()) array.notNumber = its->notNumber;
        }
        if (!whole.time) whole.time = part.time;
    }
}

// Where rows of a part of a structured grid begin in the whole: use(first of the part, first of
// the whole, how many).
template <typename Use>
void forEachRow(const VtkHeader& whole, const VtkHeader& part, VtkPlace place, const Use& use) {
    const auto all = whole.size(place), size = part.size(place);
    std::array<std::uint64_t, 3> first{};
    for (std::size_t i = 0; i < 3; ++i) {
        first[i] = static_cast<std::uint64_t>(part.extent[i][0] - whole.extent[i][0]);
        // One layer of points within a thick grid has no cells of it.
        const bool isFlat = part.extent[i][0] == part.extent[i][1];
        if (place == VtkPlace::Cells && isFlat && whole.extent[i][0] != whole.extent[i][1]) return;
    }
    for (std::uint64_t z = 0; z < size[2]; ++z)
        for (std::uint64_t y = 0; y < size[1]; ++y)
            use((z * size[1] + y) * size[0],
                ((first[2] + z) * all[1] + first[1] + y) * all[0] + first[0], size[0]);
}

void joinStructured(VtkHeader& whole, std::span<const VtkHeader> parts) {
    for (const VtkHeader& part : parts)
        for (std::size_t i = 0; i < 3; ++i)
            if (part.extent[i][0] < whole.extent[i][0] || part.extent[i][1] > whole.extent[i][1])
                failVtk(part.path, "WholeExtent",
                        "expected it inside that of " + whole.path.filename().string());
    for (const VtkPlace place : {VtkPlace::Points, VtkPlace::Cells}) {
        const auto isThere = [&](const VtkArray& array) { return array.place == place; };
        if (place == VtkPlace::Points || std::ranges::any_of(whole.arrays, isThere))
            checkVtkCover(whole, parts, place);
    }
    if (isStructured(whole.kind)) whole.places.resize(whole.count(VtkPlace::Points));
    for (const VtkHeader& part : parts) {
        if (isStructured(whole.kind))
            forEachRow(whole, part, VtkPlace::Points,
                       [&](std::uint64_t from, std::uint64_t to, std::uint64_t count) {
                           std::copy_n(part.places.begin() + static_cast<std::ptrdiff_t>(from),
                                       count,
                                       whole.places.begin() + static_cast<std::ptrdiff_t>(to));
                       });
        for (std::size_t i = 0; whole.kind == VtkKind::XmlRectilinear && i < 3; ++i) {
            auto& to = whole.coordinates[i];
            to.resize(whole.size(VtkPlace::Points)[i], std::numeric_limits<double>::quiet_NaN());
            auto next = to.begin() + (part.extent[i][0] - whole.extent[i][0]);
            const auto& own = part.coordinates[i];
            const double length = std::abs(own.back() - own.front());
            for (const double at : own) {
                if (!std::isnan(*next) && std::abs(*next - at) > kRounding * length)
                    failVtk(
                        part.path, "Coordinates",
                        fmt::format("expected {} where another part has it, found {}", *next, at));
                *next++ = at;
            }
        }
    }
}

// What parts say of themselves, in a whole of which the path and, of images, what it says itself
// are known; `file` is one that declares their arrays, or null.
VtkContents joined(VtkHeader whole, std::vector<VtkHeader> parts, const XmlFile* file) {
    joinArrays(whole, parts, file);
    if (isUnstructured(whole.kind))
        joinVtkCells(whole, parts);
    else
        joinStructured(whole, parts);
    for (VtkHeader& part : parts) {
        part.places = {};
        part.coordinates = {};
        part.unstructured = {};
    }
    return {std::move(whole), std::move(parts), {}};
}

VtkContents joined(const XmlFile& file) {
    const XmlElement& grid = gridOfParts(file);
    VtkHeader whole;
    whole.path = file.path;
    std::vector<VtkHeader> parts = partsOf(file, grid);
    const VtkHeader& first = parts[0];
    whole.kind = first.kind;
    if (!isUnstructured(whole.kind)) {
        whole.extent = vtkExtentOf(file, grid, "WholeExtent");
        checkVtkExtent(whole, placeOf(grid) + " WholeExtent");
    }
    whole.format =
        fmt::format("{}, {} part{}", first.format, parts.size(), parts.size() == 1 ? "" : "s");
    whole.origin = first.origin;
    whole.spacing = first.spacing;
    whole.direction = first.direction;
    const auto same = [](const auto& a, const auto& b, double unit) {
        return std::ranges::equal(
            a, b, [&](double x, double y) { return std::abs(x - y) <= kRounding * unit; });
    };
    const double unit =
        std::abs(first.spacing[0]) + std::abs(first.spacing[1]) + std::abs(first.spacing[2]);
    for (const VtkHeader& part : parts)
        if (!same(part.origin, first.origin, unit) || !same(part.spacing, first.spacing, unit) ||
            !same(part.direction, first.direction, 1))
            failVtk(
                part.path, "ImageData",
                "expected the Origin, Spacing and Direction of " + first.path.filename().string());
    const auto take = [&](std::string_view name, auto& numbers) {
        if (whole.kind == VtkKind::XmlImage && grid.has(name))
            std::ranges::copy(numbersOf<double>(file, grid, name, numbers.size()), numbers.begin());
    };
    take("Origin", whole.origin);
    take("Spacing", whole.spacing);
    take("Direction", whole.direction);
    return joined(std::move(whole), std::move(parts), &file);
}

// All arrays that some block has, but those that others have of another kind.
void gatherArrays(VtkHeader& whole, std::span<const VtkHeader> blocks) {
    const auto differs = [&](const VtkArray& array) {
        return std::ranges::count(whole.differing, array.name, &DamagedVariable::name) > 0;
    };
    for (const VtkHeader& block : blocks) {
        for (const VtkArray& array : block.arrays) {
            const auto same = std::ranges::find_if(whole.arrays, [&](const VtkArray& other) {
                return other.name == array.name && other.place == array.place;
            });
            if (same == whole.arrays.end())
                whole.arrays.push_back(array);
            else if (differs(array))
                continue;
            else if (same->type != array.type || same->components != array.components)
                whole.differing.push_back(
                    {array.name,
                     vtkSentence(block.path, fmt::format("'{}'", array.name),
                                 fmt::format("expected {} of {} components, as in another block",
                                             typeName(same->type), same->components))});
            else if (same->notNumber.empty())
                same->notNumber = array.notNumber;
        }
        std::ranges::copy(block.passedOver, std::back_inserter(whole.passedOver));
        for (std::size_t place = 0; place < 2; ++place)
            whole.ghosts[place] = whole.ghosts[place] || block.ghosts[place];
        if (!whole.time) whole.time = block.time;
    }
    std::erase_if(whole.arrays, differs);
    for (VtkArray& array : whole.arrays)
        array.isEverywhere = std::ranges::all_of(
            blocks, [&](const VtkHeader& block) { return arrayIn(block, array) != nullptr; });
}

VtkContents ofBlocks(const Path& path, VtkBlocks found) {
    const std::size_t count = found.blocks.size();
    VtkHeader whole;
    whole.path = path;
    if (count == 1) {  // a grid like any other
        const VtkHeader& only = found.blocks[0];
        whole.kind = only.kind;
        whole.extent = only.extent;
        whole.origin = only.origin;
        whole.spacing = only.spacing;
        whole.direction = only.direction;
        whole.format = only.format;
        return joined(std::move(whole), std::move(found.blocks), nullptr);
    }
    whole.kind = VtkKind::XmlBlocks;
    whole.format = fmt::format("{}, {} blocks", found.format, count);
    gatherArrays(whole, found.blocks);
    for (std::size_t i = 0; i < count; ++i)
        listVtkCells(found.blocks[i], found.covered[i][static_cast<std::size_t>(VtkPlace::Cells)]);
    joinVtkCells(whole, found.blocks);
    whole.unstructured.levels = found.levels;
    for (VtkHeader& block : found.blocks) {
        block.coordinates = {};
        block.unstructured = {};
    }
    return {std::move(whole), std::move(found.blocks), std::move(found.covered)};
}

// Values of parts, put where the whole has them.
struct Gathered {
    Field field;  // all missing, until something is there
    template <typename T>
    void put(const std::vector<T>& from, const std::vector<bool>& missing, std::uint64_t first,
             std::uint64_t to, std::uint64_t count) {
        auto& values = std::get<std::vector<T>>(field.values);
        for (std::uint64_t i = 0; i < count; ++i) {
            const bool isMissing = !missing.empty() && missing[first + i];
            if (isMissing && !field.missing[to + i]) continue;
            values[to + i] = from[first + i];
            field.missing[to + i] = isMissing;
        }
    }
};

// Cells that are covered are none of the whole, points are missing there.
template <typename Put>
void putUncovered(const std::vector<bool>& covered, VtkPlace place, std::uint64_t to,
                  const Put& put) {
    for (std::uint64_t i = 0; i < covered.size(); ++i) {
        if (!covered[i]) put(i, to, 1);
        if (!covered[i] || place == VtkPlace::Points) ++to;
    }
}

}  // namespace

std::string_view vtkTypeOfParts(std::string_view type) {
    for (const std::string_view each :
         {"ImageData", "RectilinearGrid", "StructuredGrid", "UnstructuredGrid", "PolyData"})
        if (type.starts_with('P') && type.substr(1) == each) return each;
    return "";
}

void keepDeclared(const XmlFile& file, std::vector<VtkArray>& arrays) {
    const XmlElement& grid = gridOfParts(file);
    std::set<std::pair<VtkPlace, std::string>> declared;
    for (const auto& [name, place] :
         {std::pair("PPointData", VtkPlace::Points), {"PCellData", VtkPlace::Cells}})
        for (const XmlElement* data : named(grid, name))
            for (const XmlElement& array : data->children)
                declared.emplace(place, array.attribute("Name"));
    if (declared.empty()) return;
    std::erase_if(arrays, [&](const VtkArray& array) {
        return !declared.contains({array.place, array.name});
    });
}

void forEachVtkPart(const XmlFile& file, const std::function<bool(const XmlFile& part)>& use) {
    const std::string_view type = vtkTypeOfParts(rootOf(file).attribute("type"));
    std::set<Path> seen;
    for (const XmlElement* piece : named(gridOfParts(file), "Piece")) {
        const std::string_view source = piece->attribute("Source");
        if (source.empty())
            failVtk(file.path, placeOf(*piece), "expected the name of a file, its Source");
        const Path path = file.path.parent_path() / source;
        std::error_code ignored;
        if (!seen.insert(std::filesystem::weakly_canonical(path, ignored)).second)
            failVtk(file.path, placeOf(*piece),
                    fmt::format("expected files that differ, found {} again", source));
        expectOtherVtk(file.path, placeOf(*piece), path);
        if (const std::string flaw = flawOfFile(path); !flaw.empty()) failVtk(path, "", flaw);
        const XmlFile part = readXml(path);
        if (const auto found = rootOf(part).attribute("type"); found != type)
            failVtk(path, "VTKFile",
                    fmt::format("expected the type {}, as a part of {}, found \"{}\"", type,
                                file.path.filename().string(), found));
        if (!use(part)) return;
    }
}

// It may lead back to the list that names it.
constexpr std::string_view kListInList =
    "expected a grid, as what a list of files names, found a list of files";

VtkContents vtkContentsOf(const Path& path) {
    if (const std::string flaw = flawOfFile(path); !flaw.empty()) failVtk(path, "", flaw);
    if (isVtkLegacy(path)) return {openVtkLegacy(path), {}, {}};
    if (isVtkSeries(path)) failVtk(path, "", kListInList);
    return vtkContentsOf(readXml(path));
}

VtkContents vtkContentsOf(const XmlFile& file) {
    const std::string_view type = rootOf(file).attribute("type");
    if (isVtkCollection(file)) failVtk(file.path, "", kListInList);
    const bool areParts = !vtkTypeOfParts(type).empty();
    if (!areParts && !isVtkMultiBlock(type)) return {openVtkXml(file), {}, {}};
    VtkContents contents = areParts ? joined(file) : ofBlocks(file.path, readVtkBlocks(file));
    // Before those of its parts.
    if (const VtkTold told = vtkTimeOf(file); told.time) contents.whole.time = told.time;
    return contents;
}

VtkContents vtkContentsOf(const VtkMember& member) {
    if (member.beside.empty()) return vtkContentsOf(member.path);
    return ofBlocks(member.path, readVtkParts(member));
}

void readVtkArray(const VtkContents& contents, const VtkArray& array, VtkPart part,
                  const StridedLayout& layout, Field& field) {
    const VtkHeader& whole = contents.whole;
    const VtkArray& its = *arrayIn(whole, array);
    if (contents.parts.empty()) return readVtkArray(whole, its, part, layout, field);
    const std::uint64_t count = whole.count(array.place);
    Gathered all{{.grid = nullptr, .values = {}, .missing = std::vector<bool>(count, true)}};
    std::uint64_t begin = 0;
    bool isFirst = true;
    for (std::size_t i = 0; i < contents.parts.size(); ++i) {
        const VtkHeader& each = contents.parts[i];
        const std::vector<bool> none,
            &covered = contents.covered.empty()
                           ? none
                           : contents.covered[i][static_cast<std::size_t>(array.place)];
        const VtkArray* const held = arrayIn(each, array);
        Field some;
        const auto size = each.size(array.place);
        if (held)
            readVtkArray(each, *held, part,
                         {{size[0], size[1], size[2]}, {1, size[0], size[0] * size[1]}}, some);
        std::visit(
            [&](const auto& from) {
                if (!held) return;
                using Vector = std::decay_t<decltype(from)>;
                if (std::exchange(isFirst, false)) all.field.values = Vector(count);
                const auto put = [&](std::uint64_t first, std::uint64_t to, std::uint64_t n) {
                    all.put(from, some.missing, first, to, n);
                };
                if (!isUnstructured(whole.kind))
                    forEachRow(whole, each, array.place, put);
                else if (covered.empty())
                    put(0, begin, from.size());
                else
                    putUncovered(covered, array.place, begin, put);
            },
            some.values);
        const auto left = std::ranges::count(covered, true);
        begin += each.count(array.place);
        if (array.place == VtkPlace::Cells) begin -= static_cast<std::uint64_t>(left);
    }
    std::visit([&](const auto& values) { field.values = arranged(values, layout); },
               all.field.values);
    if (std::ranges::find(all.field.missing, true) != all.field.missing.end())
        field.missing = arranged(all.field.missing, layout);
}

}  // namespace timeseries
