#include "timeseries/readers/xdmf/xdmf_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "timeseries/readers/limits.h"
#include "timeseries/readers/text/words.h"

namespace timeseries {
namespace {

constexpr int kMostNested = 32;  // grids

bool isTemporal(const XdmfElement& grid) {
    return lower(grid.attribute("GridType")) == "collection" &&
           lower(grid.attribute("CollectionType")) == "temporal";
}

// The Uniform grids that one step has.
void addParts(const XdmfDocument& document, const XdmfElement& grid, int nested, XdmfStep& step) {
    const std::string kind = lower(grid.attribute("GridType"));
    if (kind.empty() || kind == "uniform") {
        step.parts.push_back(grid);
        return;
    }
    if ((kind != "collection" && kind != "tree") || isTemporal(grid))
        document.fail(grid,
                      fmt::format("expected grids that are Uniform, Trees, or collections in "
                                  "space, found {} {}",
                                  grid.attribute("GridType"), grid.attribute("CollectionType")));
    if (nested >= kMostNested)
        document.fail(grid, fmt::format("expected at most {} nested grids", kMostNested));
    for (const XdmfElement& inside : document.children(grid, "Grid"))
        addParts(document, inside, nested + 1, step);
}

double timeIn(const XdmfDocument& document, const XdmfElement& at, const std::string& text) {
    double time = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, time);
    if (error != std::errc() || stop != end || !std::isfinite(time))
        document.fail(at, fmt::format("expected a time that is finite, found '{}'", text));
    return time;
}

// Its own, or that of the first grid inside that has one.
std::optional<double> timeOf(const XdmfDocument& document, const XdmfElement& grid, int nested) {
    if (const XdmfElement time = document.child(grid, "Time"); time.exists())
        if (const std::string value = time.attribute("Value"); !value.empty())
            return timeIn(document, time, value);
    if (nested < kMostNested)
        if (const XdmfElement inside = document.child(grid, "Grid"); inside.exists())
            return timeOf(document, inside, nested + 1);
    return std::nullopt;
}

// What the collection itself says of its steps' times: as many as it names, or none, and why.
std::vector<double> timesOf(const XdmfDocument& document, XdmfItems& items,
                            const XdmfElement& collection, std::size_t steps, std::string& why) {
    const XdmfElement time = document.child(collection, "Time");
    const XdmfElement item = time.exists() ? document.child(time, "DataItem") : XdmfElement();
    if (!item.exists()) return {};
    const std::string kind = lower(time.attribute("TimeType").empty() ? time.attribute("Type")
                                                                      : time.attribute("TimeType"));
    if (kind != "list" && kind != "hyperslab") {
        why = fmt::format("a Time of TimeType {} is not read", kind.empty() ? "none" : kind);
        return {};
    }
    std::vector<double> times;
    if (kind == "list") times = items.numbers(item);
    if (kind == "hyperslab") {
        // Start, stride and count, of which some writers leave the last out.
        const auto slab = items.numbers(item);
        if (slab.size() < 2) document.fail(item, "expected start, stride and count of times");
        for (std::size_t i = 0; i < steps; ++i)
            times.push_back(slab[0] + slab[1] * static_cast<double>(i));
    }
    if (std::ranges::any_of(times, [](double t) { return !std::isfinite(t); }))
        document.fail(time, "expected times that are finite");
    if (times.size() == steps) return times;
    why = fmt::format("its Time has {} for {} grids", times.size(), steps);
    return {};
}

XdmfSeries inTime(const XdmfDocument& document, XdmfItems& items, const XdmfElement& collection) {
    XdmfSeries series;
    const auto grids = document.children(collection, "Grid");
    if (grids.size() > kMaxSteps)
        document.fail(collection, fmt::format("expected at most {} steps", kMaxSteps));
    std::size_t timed = 0;
    for (const XdmfElement& grid : grids) {
        XdmfStep step;
        addParts(document, grid, 0, step);
        const auto time = timeOf(document, grid, 0);
        if (time) ++timed;
        step.time = time.value_or(0);
        series.steps.push_back(std::move(step));
    }
    series.hasTimes = timed == grids.size();
    if (series.hasTimes) return series;
    std::string why;
    const auto times = timesOf(document, items, collection, grids.size(), why);
    series.hasTimes = !times.empty();
    if (times.empty() && why.empty() && timed > 0)
        why = fmt::format("{} of {} grids have no Time", grids.size() - timed, grids.size());
    if (!why.empty()) series.note = "steps are counted: " + why;
    for (std::size_t i = 0; i < times.size(); ++i) series.steps[i].time = times[i];
    return series;
}

bool hasAttributes(const XdmfDocument& document, const XdmfSeries& series) {
    return !series.steps.empty() && !series.steps.front().parts.empty() &&
           std::ranges::any_of(series.steps.front().parts, [&](const XdmfElement& grid) {
               return document.child(grid, "Attribute").exists();
           });
}

}  // namespace

std::vector<XdmfSeries> xdmfSeriesOf(const XdmfDocument& document, XdmfItems& items) {
    const XdmfElement domain = document.child(document.root(), "Domain");
    if (!domain.exists()) document.fail(document.root(), "expected a Domain");
    std::vector<XdmfSeries> all;
    XdmfSeries still;
    still.steps.resize(1);
    std::optional<double> time;
    for (const XdmfElement& grid : document.children(domain, "Grid")) {
        if (isTemporal(grid)) {
            all.push_back(inTime(document, items, grid));
            continue;
        }
        // The mesh that collections refer to stands beside them, without a value.
        XdmfSeries alone{false, {XdmfStep{}}};
        addParts(document, grid, 0, alone.steps[0]);
        if (!hasAttributes(document, alone)) continue;
        if (!time) time = timeOf(document, grid, 0);
        for (const XdmfElement& part : alone.steps[0].parts) still.steps[0].parts.push_back(part);
    }
    still.hasTimes = time.has_value();
    still.steps[0].time = time.value_or(0);
    all.push_back(std::move(still));
    std::erase_if(all, [&](const XdmfSeries& each) { return !hasAttributes(document, each); });
    if (all.empty()) document.fail(domain, "expected a Grid with an Attribute, found none");
    for (const XdmfSeries& each : all)
        for (const XdmfStep& step : each.steps)
            if (step.parts.empty()) document.fail(domain, "expected a Grid in each step");
    return all;
}

}  // namespace timeseries
