#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/choices/decimals.h"
#include "app/command/commands.h"
#include "app/files/dataset.h"
#include "app/files/grid_text.h"
#include "app/files/step_cache.h"
#include "app/json_text.h"
#include "app/say.h"

namespace app {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using timeseries::Axis;
using timeseries::Variable;

ordered_json frameJson(const timeseries::CoordinateFrame& frame) {
    ordered_json out{{"names", frame.names},
                     {"origin", {frame.origin.x, frame.origin.y, frame.origin.z}}};
    for (int a = 0; a < 3; ++a) {
        const glm::dvec3& d = frame.directions[a];
        out["directions"].push_back({d.x, d.y, d.z});
    }
    return out;
}

// Of a mesh: a coordinate of space, along which its points lie one by one.
ordered_json coordinateJson(const Axis& axis) {
    return {{"name", axis.name},
            {"units", axis.units},
            {"least", axis.coordinates.front()},
            {"most", axis.coordinates.back()},
            {"down", axis.down}};
}

ordered_json axisJson(const Axis& axis) {
    ordered_json out{{"name", axis.name},
                     {"units", axis.units},
                     {"points", axis.coordinates.size()},
                     {"first", axis.coordinates.front()},
                     {"last", axis.coordinates.back()},
                     {"uniform", axis.uniform()},
                     {"down", axis.down}};
    if (axis.uniform() && axis.coordinates.size() > 1)
        out["spacing"] = (axis.coordinates.back() - axis.coordinates.front()) /
                         static_cast<double>(axis.coordinates.size() - 1);
    return out;
}

ordered_json variableJson(const Variable& v, const timeseries::StepGrids& grids) {
    ordered_json out{{"name", v.name},
                     {"longName", v.longName},
                     {"units", v.units},
                     {"type", timeseries::typeName(v.type)},
                     {"storedAs", v.storedAs},
                     {"missing", v.missing},
                     {"categories", v.categories},
                     {"notes", v.notes}};
    for (const timeseries::ClassName& each : v.classes)
        out["classes"].push_back({{"value", each.value}, {"name", each.name}});
    out["grid"] = gridJson(*v.grid);
    out["grid"].update(stepGridsJson(grids));
    for (const Axis& axis : v.grid->axes())
        if (v.grid->mesh())
            out["grid"]["coordinates"].push_back(coordinateJson(axis));
        else
            out["grid"]["axes"].push_back(axisJson(axis));
    if (v.grid->mesh()) out["grid"]["size"] = v.grid->size();
    if (!v.grid->frame().aligned()) out["grid"]["space"] = frameJson(v.grid->frame());
    out["time"] = {
        {"name", v.time->name}, {"units", v.time->units}, {"calendar", v.time->calendar}};
    for (const auto& point : v.time->points)
        out["time"]["steps"].push_back({{"value", point.value}, {"date", point.date}});
    return out;
}

std::string axisText(const Axis& axis, bool ofMesh) {
    const auto& c = axis.coordinates;
    const std::string unit = axis.units.empty() ? "" : " " + axis.units;
    if (!ofMesh && c.size() == 1)
        return fmt::format("{}: 1 point at {:g}{}", axis.name, c[0], unit);
    const double spacing =
        (c.back() - c.front()) / std::max(1.0, static_cast<double>(c.size()) - 1);
    // Digits that tell an end from what is beside it, of a mesh a hundredth of it.
    const int digits = digitsApart(std::max(std::abs(c.front()), std::abs(c.back())),
                                   ofMesh ? spacing / 100 : spacing, 6);
    if (ofMesh)
        return fmt::format("{}: {:.{}g} to {:.{}g}{}{}", axis.name, c.front(), digits, c.back(),
                           digits, unit, axis.down ? ", downward" : "");
    return fmt::format("{}: {} points, {:.{}g} to {:.{}g}{}, {}{}", axis.name, c.size(), c.front(),
                       digits, c.back(), digits, unit,
                       axis.uniform() ? fmt::format("every {:g}", std::abs(spacing)) : "uneven",
                       axis.down ? ", downward" : "");
}

std::string frameText(const timeseries::CoordinateFrame& frame) {
    const auto place = [&](const glm::dvec3& p) {
        return fmt::format("({:g}, {:g}, {:g})", p.x, p.y, p.z);
    };
    const glm::dmat3& d = frame.directions;
    return fmt::format("in ({}): from {} along {}, {}, {}", fmt::join(frame.names, ", "),
                       place(frame.origin), place(d[0]), place(d[1]), place(d[2]));
}

// What lies between a number and the next that a double tells from it.
double spacingAt(double value) {
    return std::nextafter(std::abs(value), std::numeric_limits<double>::infinity()) -
           std::abs(value);
}

// What the first and the last time do not tell; "" when times are even, or counted.
std::string unevenText(const timeseries::TimeAxis& time) {
    if (time.counted) return "";
    const auto& points = time.points;
    if (!std::ranges::all_of(points, [](const auto& p) { return std::isfinite(p.value); }))
        return ", some missing";
    constexpr double kRounding = 1e-3;  // times written in few digits
    const double mean =
        (points.back().value - points.front().value) / static_cast<double>(points.size() - 1);
    const double off = kRounding * std::abs(mean) + 2 * std::max(spacingAt(points.front().value),
                                                                 spacingAt(points.back().value));
    bool ascending = true, twice = false, even = true;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double gap = points[i].value - points[i - 1].value;
        ascending = ascending && gap >= 0;
        // Nanoseconds since 1970 that no double tells apart have dates that differ.
        twice = twice || (gap == 0 && points[i].date == points[i - 1].date);
        even = even && std::abs(gap - mean) <= off;
    }
    if (!ascending) return ", not ascending";
    if (twice) return ", some times twice";
    return even ? "" : ", uneven";
}

// Steps of a variable that are sorted on disk.
struct Indexed {
    std::size_t steps = 0;
    std::uint64_t bytes = 0;
};

Indexed indexedOf(timeseries::Reader& reader, std::size_t variable,
                  const timeseries::StepStores& stores) {
    Indexed indexed;
    const std::size_t steps = reader.variables()[variable].time->points.size();
    const auto look = [&](std::size_t step) -> std::shared_ptr<const timeseries::StepFile> {
        try {
            const auto origin = timeseries::originOf(reader, variable, step);
            if (!origin) return nullptr;
            for (const auto& store : stores.read)
                if (auto file = store->look(*origin)) return file;
        } catch (const timeseries::FileError&) {  // a member that is missing: told elsewhere
        }
        return nullptr;
    };
    if (stores.read.empty()) return indexed;
    for (std::size_t step = 0; step < steps; ++step)
        if (const auto file = look(step)) {
            ++indexed.steps;
            indexed.bytes += file->bytes();
        }
    return indexed;
}

// Where nothing is kept, no step is looked for.
timeseries::StepStores filled(timeseries::StepStores stores) {
    std::erase_if(stores.read, [](const auto& store) { return store->isEmpty(); });
    return stores;
}

void print(const Indexed& indexed, const Variable& v) {
    if (indexed.steps > 0)
        say("  index    {} of {} steps sorted on disk, {}\n", indexed.steps, v.time->points.size(),
            megabytesText(indexed.bytes));
}

void print(const Variable& v, const timeseries::StepGrids& grids, bool shownFirst) {
    say("\n{}{}{}{}\n", v.name, v.longName.empty() ? "" : ", " + v.longName,
        v.units.empty() ? "" : " (" + v.units + ")", shownFirst ? "  * shown first" : "");
    say("  type     {}{}{}\n", timeseries::typeName(v.type), v.categories ? ", categories" : "",
        v.storedAs.empty() ? "" : ", stored as " + v.storedAs);
    if (!v.missing.empty()) say("  missing  {}\n", v.missing);
    for (std::size_t i = 0; i < v.classes.size(); ++i)
        say("{}{} {}{}", i == 0 ? "  classes  " : ", ", v.classes[i].value, v.classes[i].name,
            i + 1 == v.classes.size() ? "\n" : "");
    say("  grid     {}\n", gridText(*v.grid));
    if (const std::string others = stepGridsText(grids); !others.empty())
        say("           {}\n", others);
    for (const Axis& axis : v.grid->axes())
        say("           {}\n", axisText(axis, v.grid->mesh() != nullptr));
    if (!v.grid->frame().aligned()) say("           {}\n", frameText(v.grid->frame()));
    if (const std::string earth = earthText(*v.grid); !earth.empty())
        say("           on the Earth: {}\n", earth);
    const std::size_t steps = v.time->points.size();
    if (steps == 1) {
        say("  time     1 step: {}\n", timeText(*v.time, 0));
    } else {
        say("  time     {} steps, {} to {}{}{}\n", steps, timeText(*v.time, 0),
            timeText(*v.time, steps - 1), unevenText(*v.time),
            v.time->calendar.empty() ? "" : ", calendar " + v.time->calendar);
    }
    for (const std::string& note : v.notes) say("  note     {}\n", note);
}

// Of each variable: those of one grid at the same steps share it. What cannot be read is told where
// its step is read.
std::vector<timeseries::StepGrids> stepGridsOf(timeseries::Reader& reader) {
    std::vector<timeseries::StepGrids> all;
    const auto variables = reader.variables();
    for (std::size_t i = 0; i < variables.size(); ++i) {
        const auto same = std::ranges::find_if(variables.first(i), [&](const Variable& other) {
            return other.grid == variables[i].grid && other.time == variables[i].time;
        });
        if (const auto at = static_cast<std::size_t>(same - variables.begin()); at < i) {
            all.push_back(all[at]);
            continue;
        }
        try {
            all.push_back(reader.stepGrids(i));
        } catch (const timeseries::FileError&) {
            all.emplace_back();
        }
    }
    return all;
}

// All of a few files, else the first and the last: what was recognised tells the rest.
void printFiles(const std::vector<std::string>& files) {
    constexpr std::size_t kFew = 6;
    if (files.size() <= kFew)
        say("{}\n", fmt::join(files, "\n"));
    else
        say("{}\n...\n{}\n", files.front(), files.back());
}

}  // namespace

int info(const InfoOptions& options) {
    const auto [reader, series] = openSeries(options.files);
    const auto variables = reader->variables();
    const std::size_t shownFirst = defaultVariable(variables);
    const timeseries::StepStores stores = filled(storesFor(reader->files()));
    const auto grids = stepGridsOf(*reader);
    std::vector<std::string> files;
    for (const auto& file : reader->files()) files.push_back(file.string());
    if (options.json) {
        ordered_json out{{"files", files}, {"format", reader->format()}};
        if (!series.recognised.empty()) out["series"] = series.recognised;
        if (series.here) out["named"] = files[*series.here];
        if (!series.notes.empty()) out["notes"] = series.notes;
        out["shownFirst"] = variables[shownFirst].name;
        for (std::size_t i = 0; i < variables.size(); ++i) {
            out["variables"].push_back(variableJson(variables[i], grids[i]));
            const Indexed indexed = indexedOf(*reader, i, stores);
            out["variables"].back()["index"] = {{"steps", indexed.steps}, {"bytes", indexed.bytes}};
        }
        say("{}\n", jsonText(out, 2));
        return 0;
    }
    printFiles(files);
    if (!series.recognised.empty()) say("{}\n", series.recognised);
    if (series.here) say("named: {}\n", fs::path(files[*series.here]).filename().string());
    for (const std::string& note : series.notes) say("note: {}\n", note);
    say("{}\n", reader->format());
    for (std::size_t i = 0; i < variables.size(); ++i) {
        print(variables[i], grids[i], variables.size() > 1 && i == shownFirst);
        print(indexedOf(*reader, i, stores), variables[i]);
    }
    return 0;
}

}  // namespace app
