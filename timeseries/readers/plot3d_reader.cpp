#include "timeseries/readers/plot3d_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>

#include "timeseries/readers/components.h"
#include "timeseries/readers/ordinary_file.h"
#include "timeseries/readers/other_formats.h"
#include "timeseries/readers/plot3d_layout.h"
#include "timeseries/readers/text/cut_name.h"

namespace timeseries {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, std::string_view what) {
    throw FileError(fmt::format("{}: {}", path.string(), what));
}

std::optional<Plot3dLayout> layoutOf(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::string start(kBeginningBytes, '\0');
    file.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(file.gcount()));
    std::error_code error;
    const std::uint64_t bytes = fs::file_size(path, error);
    return error ? std::nullopt : plot3dLayoutOf(start, bytes);
}

// So many numbers of a file, from a byte on.
template <typename T>
std::vector<T> numbersOf(const fs::path& path, const Plot3dLayout& layout, std::uint64_t from,
                         std::uint64_t count) {
    std::vector<T> numbers(count);
    std::ifstream file(path, std::ios::binary);
    file.seekg(static_cast<std::streamoff>(from));
    file.read(reinterpret_cast<char*>(numbers.data()),
              static_cast<std::streamsize>(count * sizeof(T)));
    if (!file) fail(path, fmt::format("expected {} numbers from byte {} on", count, from));
    if (layout.swapped)
        for (T& number : numbers) {
            auto* const first = reinterpret_cast<char*>(&number);
            std::reverse(first, first + sizeof(T));
        }
    return numbers;
}

// Of the files beside it that have places of so many points, that whose name is most like its own.
fs::path placesBeside(const fs::path& flow, const Plot3dLayout& layout) {
    const std::string name = flow.filename().string();
    const auto alike = [&](const fs::path& other) {
        const std::string its = other.filename().string();
        return std::ranges::mismatch(name, its).in1 - name.begin();
    };
    fs::path best;
    std::error_code error;
    const fs::path folder = flow.has_parent_path() ? flow.parent_path() : fs::path(".");
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        const fs::path path = at->path();
        std::error_code ignored;
        const std::uint64_t bytes = fs::file_size(path, ignored);
        // Nothing is opened that cannot be it.
        if (ignored || bytes < 12 * layout.points() || path == flow || !flawOfFile(path).empty())
            continue;
        const auto places = layoutOf(path);
        if (!places || places->kind != Plot3dLayout::Kind::Places || places->grids != layout.grids)
            continue;
        if (best.empty() || alike(path) > alike(best) ||
            (alike(path) == alike(best) && nameLess(path.filename(), best.filename())))
            best = path;
    }
    return best;
}

class Plot3dReader final : public Reader {
 public:
    explicit Plot3dReader(const fs::path& path) : paths_{path} {
        const auto layout = layoutOf(path);
        if (!layout) fail(path, "expected a PLOT3D file");
        layout_ = *layout;
        if (layout_.grids.size() > 1)
            fail(path, fmt::format("expected a PLOT3D file of one grid, found {}, which are not "
                                   "joined",
                                   layout_.grids.size()));
        const auto size = layout_.grids[0];
        if (layout_.kind == Plot3dLayout::Kind::Places)
            fail(path,
                 "expected values, found a PLOT3D file of places (XYZ): the flow's file (Q) "
                 "is what opens");
        const fs::path places = placesBeside(path, layout_);
        if (places.empty())
            fail(path,
                 fmt::format("expected the places of its {} x {} x {} points in a PLOT3D file "
                             "(XYZ) beside it, found none",
                             size[0], size[1], size[2]));
        place(places);
        addVariables(places);
        both_ = {path, places};
    }

    std::string format() const override { return "PLOT3D"; }
    std::span<const fs::path> files() const override { return paths_; }
    std::span<const Variable> variables() const override { return variables_; }
    StepSources sources(std::size_t, std::size_t step) override { return {both_, step}; }
    Field read(std::size_t variable, std::size_t) override;

 private:
    void place(const fs::path& path);
    TimeAxis time() const;
    void addVariables(const fs::path& places);
    Values numbers(const fs::path& path, const Plot3dLayout& layout, std::uint64_t first,
                   std::uint64_t count) const {
        const std::uint64_t from = layout.first + first * layout.real;
        if (layout.real == 8) return numbersOf<double>(path, layout, from, count);
        return numbersOf<float>(path, layout, from, count);
    }

    std::vector<fs::path> paths_, both_;  // of values; and the places
    Plot3dLayout layout_;
    std::shared_ptr<const Grid> grid_;
    std::vector<bool> missing_;
    std::vector<Variable> variables_;
    std::vector<std::pair<std::uint64_t, Component>>
        sources_;  // the first of its arrays, and which
};

void Plot3dReader::place(const fs::path& path) {
    const Plot3dLayout layout = layoutOf(path).value();
    const std::uint64_t points = layout.points();
    MeshPlaces places{.size = layout.grids[0], .at = std::vector<glm::dvec3>(points)};
    for (int c = 0; c < 3; ++c)
        std::visit(
            [&](const auto& all) {
                for (std::uint64_t i = 0; i < points; ++i)
                    places.at[i][c] = static_cast<double>(all[i]);
            },
            numbers(path, layout, static_cast<std::uint64_t>(c) * points, points));
    if (layout.hasBlanks) {
        const auto blanks =
            numbersOf<std::int32_t>(path, layout, layout.first + 3 * points * layout.real, points);
        missing_.resize(points);
        for (std::uint64_t i = 0; i < points; ++i) missing_[i] = blanks[i] == 0;
    }
    try {
        grid_ = std::make_shared<const Grid>(spaceAxes(), std::make_shared<const Mesh>(places));
    } catch (const std::invalid_argument& flaw) {
        fail(path, fmt::format("expected cells that take space, found that {}", flaw.what()));
    }
}

TimeAxis Plot3dReader::time() const {
    const double told =
        layout_.real == 8
            ? numbersOf<double>(paths_[0], layout_, layout_.time, 1)[0]
            : static_cast<double>(numbersOf<float>(paths_[0], layout_, layout_.time, 1)[0]);
    if (!std::isfinite(told)) return {"step", "", "", {{0, ""}}, true};
    return {.name = "time", .units = "", .calendar = "", .points = {{told, ""}}};
}

void Plot3dReader::addVariables(const fs::path& places) {
    const auto time = std::make_shared<const TimeAxis>(this->time());
    const ValueType type = layout_.real == 8 ? ValueType::F64 : ValueType::F32;
    struct Quantity {
        const char* name;
        std::uint64_t first, count;  // of the five arrays
    };
    for (const Quantity& each :
         {Quantity{"Density", 0, 1}, {"Momentum", 1, 3}, {"StagnationEnergy", 4, 1}})
        for (const ComponentVariable& component : componentsOf(each.name, type, each.count)) {
            Variable variable;
            variable.name = component.name;
            variable.type = component.type;
            variable.storedAs = component.storedAs;
            if (!missing_.empty()) variable.missing = "blanked";
            variable.grid = grid_;
            variable.time = time;
            variable.notes = notesOf(*grid_->mesh());
            variable.notes.push_back(
                fmt::format("its places are those of {}", places.filename().string()));
            variables_.push_back(std::move(variable));
            sources_.emplace_back(each.first, component.component);
        }
}

// Arrays stand one behind the other, not the numbers of a point.
Field Plot3dReader::read(std::size_t variable, std::size_t) {
    const auto& [first, component] = sources_[variable];
    const std::uint64_t points = layout_.points();
    Field field{.grid = grid_, .values = {}, .missing = missing_};
    if (component.which) {
        field.values = numbers(paths_[0], layout_, (first + *component.which) * points, points);
        return field;
    }
    std::array<Values, 3> parts;
    for (std::uint64_t c = 0; c < 3; ++c)
        parts[c] = numbers(paths_[0], layout_, (first + c) * points, points);
    auto& lengths = field.values.emplace<std::vector<double>>(points);
    std::visit(
        [&]<typename V>(const V& x) {
            const V &y = std::get<V>(parts[1]), &z = std::get<V>(parts[2]);
            for (std::uint64_t i = 0; i < points; ++i)
                lengths[i] = lengthOf(static_cast<double>(x[i]), static_cast<double>(y[i]),
                                      static_cast<double>(z[i]));
        },
        parts[0]);
    return field;
}

}  // namespace

bool isPlot3d(std::string_view start, std::uint64_t bytes) {
    return plot3dLayoutOf(start, bytes).has_value();
}

bool isPlot3dPlaces(const fs::path& path) {
    const auto layout = layoutOf(path);
    return layout && layout->kind == Plot3dLayout::Kind::Places;
}

std::unique_ptr<Reader> openPlot3d(std::span<const std::filesystem::path> paths) {
    return std::make_unique<Plot3dReader>(paths[0]);
}

}  // namespace timeseries
