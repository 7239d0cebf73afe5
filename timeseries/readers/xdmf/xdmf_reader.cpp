#include "timeseries/readers/xdmf/xdmf_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "timeseries/readers/components.h"
#include "timeseries/readers/text/words.h"
#include "timeseries/readers/xdmf/xdmf_grid.h"

namespace timeseries {
namespace {

// An Attribute of the grids of a series, or a number of each of its rows.
struct AttributeOf {
    std::size_t series;
    std::string name;
    bool atPoints;
    Component component;
    ValueType stored;
};

std::string centreOf(const XdmfElement& attribute) {
    const std::string centre = lower(attribute.attribute("Center"));
    return centre.empty() ? "node" : centre;
}

class XdmfReader final : public Reader {
 public:
    explicit XdmfReader(const std::filesystem::path& path)
        : paths_{path},
          document_(path),
          items_(document_),
          series_(xdmfSeriesOf(document_, items_)) {
        for (std::size_t i = 0; i < series_.size(); ++i) addSeries(i);
        tellApart(variables_);
        if (!variables_.empty()) return;
        if (!damaged_.empty()) throw FileError(damaged_.front().why);
        document_.fail(document_.root(), "expected an Attribute at nodes or cells, found none");
    }

    std::string format() const override { return "XDMF"; }
    std::span<const std::filesystem::path> files() const override { return paths_; }
    std::span<const Variable> variables() const override { return variables_; }
    std::span<const DamagedVariable> damaged() const override { return damaged_; }
    Field read(std::size_t variable, std::size_t step) override;
    StepGrids stepGrids(std::size_t variable) override;

 private:
    void addSeries(std::size_t series);
    void addAttribute(std::size_t series, const XdmfElement& attribute, const std::string& name,
                      const std::shared_ptr<const TimeAxis>& time);
    XdmfGrid& open(const XdmfStep& step);
    Values rowsOf(const AttributeOf& source, const XdmfStep& step, const XdmfGrid& grid);

    std::vector<std::filesystem::path> paths_;
    XdmfDocument document_;
    XdmfItems items_;
    std::vector<XdmfSeries> series_;
    // Of the step that is open.
    std::string source_;
    std::unique_ptr<XdmfGrid> grid_;
    std::vector<std::string> notes_;  // of the series that is added
    std::vector<Variable> variables_;
    std::vector<AttributeOf> sources_;  // [variable]
    std::vector<DamagedVariable> damaged_;
};

std::shared_ptr<const TimeAxis> timeOf(const XdmfSeries& series) {
    auto time = std::make_shared<TimeAxis>();
    time->counted = !series.hasTimes;
    time->name = series.hasTimes ? "time" : "step";
    for (std::size_t i = 0; i < series.steps.size(); ++i)
        time->points.push_back(
            {series.hasTimes ? series.steps[i].time : static_cast<double>(i), ""});
    return time;
}

XdmfGrid& XdmfReader::open(const XdmfStep& step) {
    const std::string source = XdmfGrid::sourceOf(document_, items_, step);
    if (grid_ && source == source_) return *grid_;
    grid_.reset();
    grid_ = std::make_unique<XdmfGrid>(document_, items_, step);
    source_ = source;
    return *grid_;
}

// What its variables do not show.
std::vector<std::string> notesOf(const XdmfDocument& document, const XdmfSeries& series) {
    std::vector<std::string> notes;
    if (!series.note.empty()) notes.push_back(series.note);
    std::map<std::string, std::size_t> grids;  // of an Attribute, how many have it
    std::size_t all = 0;
    for (const XdmfStep& step : series.steps)
        for (const XdmfElement& grid : step.parts) {
            ++all;
            std::set<std::string> names;
            for (const XdmfElement& attribute : document.children(grid, "Attribute"))
                if (centreOf(attribute) != "grid") names.insert(attribute.attribute("Name"));
            for (const std::string& name : names) ++grids[name];
        }
    for (const auto& [name, count] : grids)
        if (count < all)
            notes.push_back(
                fmt::format("{} of {} grids have no Attribute '{}'", all - count, all, name));
    return notes;
}

void XdmfReader::addSeries(std::size_t series) {
    const auto time = timeOf(series_[series]);
    notes_ = notesOf(document_, series_[series]);
    const auto attributes = document_.children(series_[series].steps[0].parts[0], "Attribute");
    std::set<std::pair<std::string, std::string>> found;
    for (const XdmfElement& attribute : attributes) {
        const std::string name = attribute.attribute("Name"), centre = centreOf(attribute);
        if (centre == "grid") continue;  // one number for all
        const bool both = std::ranges::any_of(attributes, [&](const XdmfElement& other) {
            return other.attribute("Name") == name && centreOf(other) != centre;
        });
        const std::string told = name + (!both ? "" : centre == "node" ? " (points)" : " (cells)");
        try {
            if (!found.insert({name, centre}).second)  // steps have theirs by their names
                document_.fail(attribute, fmt::format("expected names that differ, found the "
                                                      "Attribute '{}' again",
                                                      name));
            addAttribute(series, attribute, told, time);
        } catch (const FileError& error) {
            damaged_.push_back({told, error.what()});
        }
    }
}

void XdmfReader::addAttribute(std::size_t series, const XdmfElement& attribute,
                              const std::string& name,
                              const std::shared_ptr<const TimeAxis>& time) {
    const std::string centre = centreOf(attribute);
    const XdmfElement item = document_.child(attribute, "DataItem");
    const bool isFunction = !attribute.attribute("ItemType").empty() &&
                            lower(attribute.attribute("ItemType")) != "uniform";
    if ((centre != "node" && centre != "cell") || isFunction || !item.exists())
        document_.fail(
            attribute,
            fmt::format(
                "expected values at nodes or cells, found the Attribute '{}' {}, "
                "which is not read",
                name,
                isFunction ? "of ItemType " + attribute.attribute("ItemType") : "at " + centre));
    const bool atPoints = centre == "node";
    XdmfGrid& grid = open(series_[series].steps[0]);
    const std::uint64_t rows = grid.parts()[0].at(atPoints);
    std::uint64_t all = 1;
    for (const std::uint64_t length : items_.dimensionsOf(item)) all *= length;
    if (rows == 0 || all == 0 || all % rows != 0)
        document_.fail(item, fmt::format("expected as many numbers for each of {} {}, found {} in "
                                         "all",
                                         rows, atPoints ? "points" : "cells", all));
    const ValueType stored = items_.typeOf(item);
    const auto components = componentsOf(name, stored, all / rows);
    if (components.empty())
        document_.fail(item, fmt::format("expected some numbers for each of {} {}, found {} in all",
                                         rows, atPoints ? "points" : "cells", all));
    for (const ComponentVariable& each : components) {
        Variable variable;
        variable.name = each.name;
        variable.type = each.type;
        variable.storedAs = each.storedAs + (atPoints ? "" : ", at cells");
        variable.grid = grid.at(atPoints);
        variable.time = time;
        variable.notes = grid.notes();
        variable.notes.insert(variable.notes.end(), notes_.begin(), notes_.end());
        if (const auto& mesh = variable.grid->mesh())
            for (std::string& note : notesOf(*mesh)) variable.notes.push_back(std::move(note));
        variables_.push_back(std::move(variable));
        sources_.push_back({series, attribute.attribute("Name"), atPoints, each.component, stored});
    }
}

// Of all parts, one behind the other.
Values XdmfReader::rowsOf(const AttributeOf& source, const XdmfStep& step, const XdmfGrid& grid) {
    Values all;
    for (std::size_t part = 0; part < step.parts.size(); ++part) {
        const auto attributes = document_.children(step.parts[part], "Attribute");
        const auto found = std::ranges::find_if(attributes, [&](const XdmfElement& each) {
            return each.attribute("Name") == source.name &&
                   (centreOf(each) == "node") == source.atPoints;
        });
        const XdmfElement item =
            found == attributes.end() ? XdmfElement() : document_.child(*found, "DataItem");
        if (!item.exists())
            document_.fail(step.parts[part],
                           fmt::format("expected the Attribute '{}' in each grid", source.name));
        Values values = items_.read(item);
        const std::uint64_t expected = grid.parts()[part].at(source.atPoints) * source.component.of;
        const auto count = std::visit([](const auto& v) { return v.size(); }, values);
        if (count != expected || static_cast<ValueType>(values.index()) != source.stored)
            document_.fail(item, fmt::format("expected {} numbers of {}, found {} of {}", expected,
                                             typeName(source.stored), count,
                                             typeName(static_cast<ValueType>(values.index()))));
        if (part == 0) {
            all = std::move(values);
            continue;
        }
        std::visit(
            [&](auto& sum) {
                const auto& more = std::get<std::decay_t<decltype(sum)>>(values);
                sum.insert(sum.end(), more.begin(), more.end());
            },
            all);
    }
    return all;
}

StepGrids XdmfReader::stepGrids(std::size_t variable) {
    const AttributeOf& source = sources_[variable];
    const auto& steps = series_[source.series].steps;
    const std::string first = XdmfGrid::sourceOf(document_, items_, steps[0]);
    const auto other = std::find_if(steps.rbegin(), steps.rend(), [&](const XdmfStep& step) {
        return XdmfGrid::sourceOf(document_, items_, step) != first;
    });
    if (other == steps.rend()) return {};
    return {.are = heldAgainst(*variables_[variable].grid, *open(*other).at(source.atPoints))};
}

Field XdmfReader::read(std::size_t variable, std::size_t step) {
    const AttributeOf& source = sources_[variable];
    const XdmfStep& from = series_[source.series].steps[step];
    XdmfGrid& grid = open(from);
    Field field;
    field.grid = gridOfStep(variables_[variable].grid, grid.at(source.atPoints));
    if (!field.grid) document_.fail(from.parts[0], "expected the steps of one series");
    field.values = componentOf(rowsOf(source, from, grid), source.component);
    return field;
}

}  // namespace

bool isXdmf(std::string_view start) {
    const auto first = start.find_first_not_of("\xEF\xBB\xBF \t\r\n");
    return first != start.npos && start[first] == '<' && start.find("<Xdmf") != start.npos;
}

std::unique_ptr<Reader> openXdmf(std::span<const std::filesystem::path> paths) {
    return std::make_unique<XdmfReader>(paths[0]);
}

}  // namespace timeseries
