#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "app/choices/decimals.h"
#include "app/command/commands.h"
#include "app/files/dataset.h"
#include "app/files/progress.h"
#include "app/files/step_cache.h"
#include "app/json_text.h"
#include "app/say.h"

namespace app {
namespace {

using nlohmann::ordered_json;
using timeseries::Number;
using timeseries::RangeSet;
using timeseries::SortedStep;

struct Row {
    std::size_t step;
    timeseries::StepStatistics statistics;
    std::uint64_t selected;               // in any layer
    std::vector<std::uint64_t> ofLayers;  // [layers]: in each
    // Of the valid points; 0 where there is none.
    double percent(std::uint64_t of) const {
        return statistics.points == 0
                   ? 0
                   : 100.0 * static_cast<double>(of) / static_cast<double>(statistics.points);
    }
};

// JSON has no infinities and no NaN: absent values are null, infinite ones, which are counted,
// text.
ordered_json number(const Number& n) {
    return std::visit(
        [](auto x) -> ordered_json {
            if constexpr (std::is_same_v<decltype(x), double>) {
                if (std::isinf(x)) return x > 0 ? "inf" : "-inf";
                if (std::isnan(x)) return nullptr;
            }
            return x;
        },
        n);
}

// Null where the range has none on that side.
ordered_json end(const timeseries::Bound& bound, double none) {
    const bool isNone = !bound.open && timeseries::toDouble(bound.value) == none;
    return isNone ? ordered_json(nullptr) : number(bound.value);
}

ordered_json json(const RangeSet& layer) {
    ordered_json out{{"text", layer.text()}, {"ranges", ordered_json::array()}};
    for (const timeseries::Range& range : layer.ranges())
        out["ranges"].push_back({{"low", end(range.lo, -kInfinity)},
                                 {"lowOpen", range.lo.open},
                                 {"high", end(range.hi, kInfinity)},
                                 {"highOpen", range.hi.open}});
    return out;
}

ordered_json json(const Dataset& dataset, const Row& row) {
    ordered_json out{{"step", row.step},
                     {"time", dataset.variable.time->points[row.step].value},
                     {"date", dataset.variable.time->points[row.step].date},
                     {"points", row.statistics.points},
                     {"missing", row.statistics.missing},
                     {"min", number(row.statistics.min)},
                     {"max", number(row.statistics.max)},
                     {"selected", row.selected},
                     {"percent", row.percent(row.selected)},
                     {"layers", ordered_json::array()}};
    for (const std::uint64_t selected : row.ofLayers)
        out["layers"].push_back({{"selected", selected}, {"percent", row.percent(selected)}});
    return out;
}

ordered_json json(const Dataset& dataset, const std::vector<RangeSet>& layers,
                  const std::vector<Row>& rows) {
    ordered_json out{{"file", dataset.name},
                     {"variable", dataset.variable.name},
                     {"units", dataset.variable.units},
                     {"timeName", dataset.variable.time->name},
                     {"timeUnits", dataset.variable.time->units},
                     {"layers", ordered_json::array()}};
    for (const RangeSet& layer : layers) out["layers"].push_back(json(layer));
    if (!dataset.series.recognised.empty()) out["series"] = dataset.series.recognised;
    std::vector<std::string> notes = dataset.series.notes;
    std::ranges::copy(dataset.variable.notes, std::back_inserter(notes));
    if (!notes.empty()) out["notes"] = notes;
    for (const Row& row : rows) out["steps"].push_back(json(dataset, row));
    return out;
}

void printHead(const Dataset& dataset, const RangeSet& ranges) {
    const auto& variable = dataset.variable;
    say("{}: {}{}, range {}\n", dataset.name, variable.name,
        variable.units.empty() ? "" : " (" + variable.units + ")", ranges.text());
    if (!dataset.series.recognised.empty()) say("{}\n", dataset.series.recognised);
    for (const std::string& note : dataset.series.notes) say("note: {}\n", note);
    say("{:>5}  {:<20} {:>12} {:>12} {:>12} {:>12} {:>12} {:>8}\n", "step", "time", "points",
        "missing", "min", "max", "selected", "%");
}

// And what each layer has of it, where there are several.
void print(const Dataset& dataset, const std::vector<RangeSet>& layers, const Row& row) {
    const timeseries::StepStatistics& s = row.statistics;
    const auto value = [&](const Number& n) {
        const auto* real = std::get_if<double>(&n);
        if (real == nullptr) return timeseries::toText(n);
        if (std::isnan(*real)) return std::string("-");
        // Enough to tell the least from the greatest.
        const double least = timeseries::toDouble(s.min), most = timeseries::toDouble(s.max);
        const double size = std::max(std::abs(least), std::abs(most));
        return fmt::format("{:.{}g}", *real, digitsApart(size, 0.1 * (most - least), 7));
    };
    say("{:>5}  {:<20} {:>12} {:>12} {:>12} {:>12} {:>12} {:>8.2f}\n", row.step,
        timeText(*dataset.variable.time, row.step), withCommas(s.points), withCommas(s.missing),
        value(s.min), value(s.max), withCommas(row.selected), row.percent(row.selected));
    if (layers.size() < 2) return;
    for (std::size_t i = 0; i < layers.size(); ++i)
        say("{:>5}  range {:<66} {:>12} {:>8.2f}\n", "", layers[i].text(),
            withCommas(row.ofLayers[i]), row.percent(row.ofLayers[i]));
}

}  // namespace

int count(const CountOptions& options) {
    OpenDataset dataset = openDataset(options.files, options.variable);
    const RangeSet ranges = timeseries::unionOf(options.ranges);
    const RangeSet kept = options.keep.value_or(RangeSet::everything());
    const auto steps = stepsOf(dataset, options.steps);
    std::vector<Row> rows;
    const auto stores = storesFor(dataset.reader->files());
    timeseries::StepMaker maker(std::move(dataset.reader), dataset.variableIndex, kept, stores,
                                timeseries::StepMaker::Holds::Points, ranges);
    {
        // The table shows by itself how far it is.
        Progress progress("step", options.json ? steps.size() : 0);
        for (const std::size_t step : steps) {
            progress.at(rows.size());
            const auto sorted = maker.make(step);
            rows.push_back({step, sorted->statistics(), sorted->count(ranges), {}});
            for (const RangeSet& layer : options.ranges)
                rows.back().ofLayers.push_back(sorted->count(layer));
            if (options.json) continue;
            if (rows.size() == 1) printHead(dataset, ranges);  // no table where there is no row
            print(dataset, options.ranges, rows.back());
        }
    }
    tellNotes(stores);
    if (options.json) say("{}\n", jsonText(json(dataset, options.ranges, rows), 2));
    return 0;
}

}  // namespace app
