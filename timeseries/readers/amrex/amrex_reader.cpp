#include "timeseries/readers/amrex/amrex_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "timeseries/readers/amrex/amrex_fab.h"
#include "timeseries/readers/amrex/amrex_grid.h"
#include "timeseries/readers/sequence_reader.h"

namespace timeseries {
namespace {

using Path = std::filesystem::path;

class AmrexReader final : public Reader {
 public:
    AmrexReader(const Path& path, bool mayBeUpright)
        : paths_{path}, file_(readAmrexHeader(path)), placed_(gridOf(mayBeUpright)) {
        addVariables();
    }

    std::string format() const override {
        std::size_t boxes = 0;
        for (const LatticeLevel& level : file_.lattice) boxes += level.boxes.size();
        return fmt::format("AMReX plotfile, {} level{}, {} box{}", file_.lattice.size(),
                           file_.lattice.size() == 1 ? "" : "s", boxes, boxes == 1 ? "" : "es");
    }
    std::span<const Path> files() const override { return paths_; }
    std::span<const Variable> variables() const override { return variables_; }
    Field read(std::size_t variable, std::size_t) override {
        Field field{.grid = placed_.grid, .values = {}, .missing = {}};
        if (type_ == ValueType::F64)
            fill(variable, field.values.emplace<std::vector<double>>());
        else
            fill(variable, field.values.emplace<std::vector<float>>());
        return field;
    }
    StepSources sources(std::size_t, std::size_t) override {
        StepSources sources{file_.texts, 0};
        sources.files.insert(sources.files.end(), file_.files.begin(), file_.files.end());
        return sources;
    }

 private:
    AmrexGrid gridOf(bool mayBeUpright) const;
    void addVariables();
    // That of a box, if it is as the others.
    AmrexFabHeader headerOf(AmrexFabFile& from, std::size_t level, std::size_t box) const;
    template <typename T>
    void fill(std::size_t variable, std::vector<T>& values) const;

    std::vector<Path> paths_;
    AmrexPlotfile file_;
    AmrexGrid placed_;
    ValueType type_ = ValueType::F64;  // of the first box
    std::vector<Variable> variables_;
};

AmrexGrid AmrexReader::gridOf(bool mayBeUpright) const try {
    return amrexGridOf(file_, mayBeUpright);
} catch (const std::invalid_argument& flaw) {
    throw FileError(fmt::format("{}: expected cells that take space, found that {}",
                                file_.folder.string(), flaw.what()));
}

void AmrexReader::addVariables() {
    AmrexFabFile first(file_.files[file_.levels[0].fabs[0].file]);
    type_ = first.headerAt(file_.levels[0].fabs[0].offset, file_.dimensions).type;
    const auto time = std::make_shared<const TimeAxis>(
        TimeAxis{.name = "time", .units = "", .calendar = "", .points = {{file_.time, ""}}});
    for (const std::string& name : file_.names) {
        Variable variable;
        variable.name = name;
        variable.type = type_;
        variable.storedAs = fmt::format("{}, at cells", typeName(type_));
        variable.grid = placed_.grid;
        variable.time = time;
        if (placed_.grid->mesh()) variable.notes = notesOf(*placed_.grid->mesh());
        constexpr std::size_t kMostTold = 8;
        if (const std::size_t others = file_.others.size(); others > 0)
            variable.notes.push_back(fmt::format(
                "particles, raw fields and values at nodes or faces are not read: {}{}",
                fmt::join(std::span(file_.others).first(std::min(others, kMostTold)), ", "),
                others > kMostTold ? fmt::format(" and {} more", others - kMostTold) : ""));
        variables_.push_back(std::move(variable));
    }
}

AmrexFabHeader AmrexReader::headerOf(AmrexFabFile& from, std::size_t level, std::size_t box) const {
    const std::uint64_t offset = file_.levels[level].fabs[box].offset;
    AmrexFabHeader header = from.headerAt(offset, file_.dimensions);
    IndexBox grown = file_.lattice[level].boxes[box];
    for (std::size_t a = 0; a < 3; ++a) {
        grown.first[a] -= file_.levels[level].ghosts[a];
        grown.last[a] += file_.levels[level].ghosts[a];
    }
    const bool isAlike = header.type == type_ && header.variables == file_.names.size();
    if (header.box != grown || !isAlike)
        throw FileError(fmt::format(
            "{}: FAB at byte {}: expected {} variables of {} in box {} of level {}, found {}",
            from.path().string(), offset, file_.names.size(), typeName(type_), box, level,
            isAlike ? "another box"
                    : fmt::format("{} of {}", header.variables, typeName(header.type))));
    return header;
}

template <typename T>
void AmrexReader::fill(std::size_t variable, std::vector<T>& values) const {
    std::unique_ptr<AmrexFabFile> from;
    placed_.whole ? values.resize(placed_.whole->count()) : values.reserve(placed_.grid->count());
    for (std::size_t l = 0; l < file_.levels.size(); ++l)
        for (std::size_t b = 0; b < file_.levels[l].fabs.size(); ++b) {
            const Path& path = file_.files[file_.levels[l].fabs[b].file];
            if (!from || from->path() != path) from = std::make_unique<AmrexFabFile>(path);
            const AmrexFabHeader header = headerOf(*from, l, b);
            const auto all = from->values<T>(header, variable);
            const std::vector<bool>& covered = placed_.covered[l][b];
            const IndexBox& box = file_.lattice[l].boxes[b];
            const auto row = static_cast<std::ptrdiff_t>(box.size()[0]);
            std::size_t cell = 0;
            for (std::int64_t k = box.first[2]; k <= box.last[2]; ++k)
                for (std::int64_t j = box.first[1]; j <= box.last[1]; ++j) {
                    const auto rowIn = [&](const IndexBox& of) {
                        return static_cast<std::ptrdiff_t>(of.placeOf({box.first[0], j, k}));
                    };
                    const auto begin = all.begin() + rowIn(header.box);
                    if (placed_.whole)
                        std::copy_n(begin, row, values.begin() + rowIn(*placed_.whole));
                    else
                        for (std::ptrdiff_t i = 0; i < row; ++i, ++cell)
                            if (covered.empty() || !covered[cell]) values.push_back(begin[i]);
                }
        }
}

}  // namespace

std::unique_ptr<Reader> openAmrex(std::span<const Path> paths) {
    if (paths.size() == 1) return std::make_unique<AmrexReader>(paths[0], true);
    // A series that is refined later on is a mesh from its beginning.
    const bool areUpright =
        std::ranges::all_of(paths, [](const Path& path) { return amrexLevelsOf(path) == 1; });
    return openSequence(paths, [areUpright](const Path& path) {
        return std::make_unique<AmrexReader>(path, areUpright);
    });
}

}  // namespace timeseries
