#include "timeseries/readers/vtk/vtk_multiblock.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "timeseries/grid/index_boxes.h"
#include "timeseries/readers/ordinary_file.h"
#include "timeseries/readers/vtk/vtk_file.h"
#include "timeseries/readers/vtk/vtk_xml_numbers.h"

namespace timeseries {
namespace {

using Path = std::filesystem::path;
using Size = std::array<std::uint64_t, 3>;

struct Composite {
    std::string_view type;
    const char* format;
    bool hasLevels;
};
constexpr std::array kComposites{
    Composite{"vtkMultiBlockDataSet", "VTK multi-block data", false},
    Composite{"vtkMultiPieceDataSet", "VTK multi-block data", false},
    Composite{"vtkPartitionedDataSet", "VTK partitioned data", false},
    Composite{"vtkPartitionedDataSetCollection", "VTK partitioned data", false},
    Composite{"vtkNonOverlappingAMR", "VTK adaptive mesh", true},
    Composite{"vtkOverlappingAMR", "VTK adaptive mesh", true},
    Composite{"vtkHierarchicalBoxDataSet", "VTK adaptive mesh", true}};

const Composite* compositeOf(std::string_view type) {
    const auto found = std::ranges::find(kComposites, type, &Composite::type);
    return found == kComposites.end() ? nullptr : &*found;
}

// The data sets within, at any depth, and their levels: 0 where none is told.
struct Named {
    const XmlElement* element;
    std::uint64_t level;
};
void addNamed(const XmlFile& file, const XmlElement& parent, std::uint64_t level,
              std::vector<Named>& found) {
    for (const XmlElement& child : parent.children) {
        const bool isSet = child.name == "DataSet";
        const std::uint64_t own = countOf(file, child, isSet ? "group" : "level", level);
        if (!isSet)
            addNamed(file, child, own, found);
        else if (child.has("file"))  // a block of nothing has none
            found.push_back({&child, own});
    }
}

bool isImage(const VtkHeader& block) { return block.kind == VtkKind::XmlImage; }

// Which of a block's cells have their middles within a finer block, counted from its first one.
// Images whose axes are those of space.
IndexBox coveredBy(const VtkHeader& block, const VtkHeader& finer) {
    constexpr double kRounding = 1e-6;  // of a cell: writers work out origins each for itself
    const Size cells = block.size(VtkPlace::Cells), points = block.size(VtkPlace::Points);
    IndexBox box{};
    for (std::size_t a = 0; a < 3; ++a) {
        const auto last = static_cast<std::int64_t>(cells[a]) - 1;
        box.last[a] = last;
        if (points[a] == 1) continue;  // a flat one is as thick as what covers it
        const auto end = [&](std::size_t k) {
            const double at =
                finer.origin[a] + finer.spacing[a] * static_cast<double>(finer.extent[a][k]);
            return (at - block.origin[a]) / block.spacing[a] -
                   static_cast<double>(block.extent[a][0]) - 0.5;
        };
        const auto [lo, hi] = std::minmax({end(0), end(1)});
        const double from = std::ceil(lo - kRounding), to = std::floor(hi + kRounding);
        // Also where spacings are 0, and so these no numbers.
        if (!(from <= static_cast<double>(last)) || !(to >= 0)) return {{1, 1, 1}, {0, 0, 0}};
        box.first[a] = static_cast<std::int64_t>(std::max(from, 0.0));
        box.last[a] = static_cast<std::int64_t>(std::min(to, static_cast<double>(last)));
    }
    return box;
}

std::vector<bool> coveredCells(const VtkHeader& block, std::span<const VtkHeader* const> finer) {
    IndexBox cells{};
    for (std::size_t a = 0; a < 3; ++a)
        cells.last[a] = static_cast<std::int64_t>(block.size(VtkPlace::Cells)[a]) - 1;
    std::vector<bool> covered;
    for (const VtkHeader* each : finer) cover(covered, cells, coveredBy(block, *each));
    return covered;
}

// Calls use(cell, its corners as VTK orders those of a voxel) for each cell of a block whose points
// lie along indices.
template <typename Use>
void forEachCell(const VtkHeader& block, const Use& use) {
    const Size points = block.size(VtkPlace::Points), cells = block.size(VtkPlace::Cells);
    const Size stride{1, points[0], points[0] * points[1]};
    std::vector<std::uint64_t> offsets{0};
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t i = 0, half = offsets.size(); points[a] > 1 && i < half; ++i)
            offsets.push_back(offsets[i] + stride[a]);
    std::vector<std::uint32_t> corners(offsets.size());
    std::uint64_t cell = 0;
    for (std::uint64_t k = 0; k < cells[2]; ++k)
        for (std::uint64_t j = 0; j < cells[1]; ++j)
            for (std::uint64_t i = 0; i < cells[0]; ++i) {
                const std::uint64_t first = i + j * stride[1] + k * stride[2];
                std::ranges::transform(offsets, corners.begin(), [&](std::uint64_t offset) {
                    return static_cast<std::uint32_t>(first + offset);
                });
                use(cell++, std::span<const std::uint32_t>(corners));
            }
}

// A point of none but covered cells is covered.
std::vector<bool> coveredPoints(const VtkHeader& block, const std::vector<bool>& cells) {
    if (cells.empty()) return {};
    std::vector<bool> covered(block.count(VtkPlace::Points), true);
    forEachCell(block, [&](std::uint64_t cell, std::span<const std::uint32_t> corners) {
        if (cells[cell]) return;
        for (const std::uint32_t corner : corners) covered[corner] = false;
    });
    return covered;
}

std::vector<glm::dvec3> placesOf(const VtkHeader& block) {
    const Size size = block.size(VtkPlace::Points);
    std::array<std::vector<double>, 3> along = block.coordinates;
    for (std::size_t a = 0; isImage(block) && a < 3; ++a)
        for (std::uint64_t i = 0; i < size[a]; ++i)
            along[a].push_back(block.spacing[a] *
                               static_cast<double>(block.extent[a][0] + std::int64_t(i)));
    const auto place = [&](const glm::dvec3& at) {
        if (!isImage(block)) return at;
        glm::dvec3 turned;
        for (int c = 0; c < 3; ++c)
            turned[c] = block.origin[static_cast<std::size_t>(c)] +
                        block.direction[static_cast<std::size_t>(3 * c)] * at.x +
                        block.direction[static_cast<std::size_t>(3 * c + 1)] * at.y +
                        block.direction[static_cast<std::size_t>(3 * c + 2)] * at.z;
        return turned;
    };
    std::vector<glm::dvec3> places;
    places.reserve(block.count(VtkPlace::Points));
    for (const double z : along[2])
        for (const double y : along[1])
            for (const double x : along[0]) places.push_back(place({x, y, z}));
    return places;
}

void checkLevels(const VtkHeader& block) {
    const std::array<double, 9> upright{1, 0, 0, 0, 1, 0, 0, 0, 1};
    if (!isImage(block) || block.direction != upright)
        failVtk(block.path, "VTKFile",
                "expected image data along the axes of space, as a block of an adaptive mesh");
}

// The blocks that a file names, so far.
class BlockList {
 public:
    // `by`: the file.
    explicit BlockList(Path by) : by_(std::move(by)) {}
    // None of a file that holds nothing. `place`: where it is named.
    void add(const Path& path, const std::string& place, std::uint64_t level) {
        std::error_code ignored;
        if (!seen_.insert(std::filesystem::weakly_canonical(path, ignored)).second)
            failVtk(by_, place,
                    fmt::format("expected files that differ, found {} again",
                                path.filename().string()));
        if (const std::string flaw = flawOfFile(path); !flaw.empty()) failVtk(path, "", flaw);
        const bool isList = isVtkSeries(path);
        const XmlFile file = isList ? XmlFile() : readXml(path);
        const std::string_view type = isList ? "" : rootOf(file).attribute("type");
        if (isList || type == "Collection" || isVtkMultiBlock(type))
            failVtk(path, "",
                    fmt::format("expected a grid, as a block of {}, found a file that names others",
                                by_.filename().string()));
        if (isEmptyVtkFile(file)) return;
        blocks.push_back(openVtkXml(file));
        levels.push_back(level);
        constexpr std::uint64_t kMostListed = 1 << 27;  // 5 GB
        const VtkHeader& last = blocks.back();
        if (!isUnstructured(last.kind)) listed_ += last.count(VtkPlace::Cells);
        if (listed_ > kMostListed && blocks.size() > 1)
            failVtk(by_, place,
                    fmt::format("expected at most {} cells in blocks whose cells are not listed, "
                                "found {}",
                                kMostListed, listed_));
    }

    std::vector<VtkHeader> blocks;
    std::vector<std::uint64_t> levels;

 private:
    Path by_;
    std::set<Path> seen_;
    std::uint64_t listed_ = 0;
};

// What finer blocks cover of coarser ones.
void coverCoarse(std::span<const std::uint64_t> levels, VtkBlocks& found) {
    for (const VtkHeader& block : found.blocks) checkLevels(block);
    for (std::size_t i = 0; i < found.blocks.size(); ++i) {
        std::vector<const VtkHeader*> finer;
        for (std::size_t j = 0; j < found.blocks.size(); ++j)
            if (levels[j] > levels[i]) finer.push_back(&found.blocks[j]);
        auto& [points, cells] = found.covered[i];
        cells = coveredCells(found.blocks[i], finer);
        points = coveredPoints(found.blocks[i], cells);
    }
    found.levels = std::set(levels.begin(), levels.end()).size();
    found.format += fmt::format(", {} levels", found.levels);
}

}  // namespace

bool isVtkMultiBlock(std::string_view type) { return compositeOf(type) != nullptr; }

VtkBlocks readVtkBlocks(const XmlFile& file) {
    const Composite& composite = *compositeOf(rootOf(file).attribute("type"));
    std::vector<Named> all;
    addNamed(file, file.root, 0, all);
    BlockList list(file.path);
    for (const auto& [element, level] : all) {
        const Path block = file.path.parent_path() / element->attribute("file");
        expectOtherVtk(file.path, placeOf(*element), block);
        list.add(block, placeOf(*element), level);
    }
    VtkBlocks found{composite.format, 0, std::move(list.blocks), {}};
    if (found.blocks.empty())
        failVtk(file.path, file.root.name, "expected a DataSet with a file that holds points");
    found.covered.resize(found.blocks.size());
    if (composite.hasLevels) coverCoarse(list.levels, found);
    return found;
}

VtkBlocks readVtkParts(const VtkMember& step) {
    BlockList list(step.path);
    list.add(step.path, "", 0);
    for (const Path& part : step.beside) list.add(part, "", 0);
    if (list.blocks.empty()) failVtk(step.path, "", "expected points in it or in another part");
    VtkBlocks found{"VTK parts", 0, std::move(list.blocks), {}};
    found.covered.resize(found.blocks.size());
    return found;
}

void listVtkCells(VtkHeader& block, const std::vector<bool>& covered) {
    constexpr std::array<std::uint8_t, 9> kShapes{0, 1, 3, 0, 8, 0, 0, 0, 11};  // by corners
    if (isUnstructured(block.kind)) return;
    UnstructuredGrid& grid = block.unstructured;
    const auto places = isStructured(block.kind) ? std::move(block.places) : placesOf(block);
    grid.points.assign(places.begin(), places.end());
    std::vector<bool> ghosts;
    forEachCell(block, [&](std::uint64_t cell, std::span<const std::uint32_t> corners) {
        if (!covered.empty() && covered[cell]) return;
        if (!block.ghostCells.empty()) ghosts.push_back(block.ghostCells[cell]);
        grid.corners.insert(grid.corners.end(), corners.begin(), corners.end());
        grid.ends.push_back(grid.corners.size());
        grid.types.push_back(kShapes[corners.size()]);
    });
    block.ghostCells = std::move(ghosts);
    block.pieces = {VtkPiece{.points = grid.points.size(),
                             .cells = grid.types.size(),
                             .places = {},
                             .connectivity = {},
                             .offsets = {},
                             .types = {},
                             .faces = {},
                             .faceOffsets = {},
                             .lists = {}}};
}

}  // namespace timeseries
