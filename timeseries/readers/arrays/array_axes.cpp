#include "timeseries/readers/arrays/array_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "timeseries/readers/limits.h"
#include "timeseries/readers/placed_by_index.h"
#include "timeseries/readers/text/units.h"
#include "timeseries/readers/text/words.h"

namespace timeseries {
namespace {

// Fewer than these along the first of four axes that tell nothing are more often the components of
// a value than points.
constexpr std::uint64_t kMaxComponents = 4;
// Directions that lie along an axis but for rounding; of their length.
constexpr double kAlignment = 1e-6;

std::string place(std::size_t i) { return fmt::format("axis {}", i + 1); }

// By what the axis says of itself; not by its kind.
bool looksLikeTime(const ArrayAxis& axis) {
    const std::string label = lower(axis.label);
    return label == "t" || label == "time" || sameDimension(axis.units, "s");
}

// How far a direction reaches into space without time, and into time.
std::size_t spatialDimension(const ArrayHeader& header) {
    return header.spaceDimension - (header.timeInSpace ? 1 : 0);
}

bool alongTime(const ArrayHeader& header, const ArrayAxis& axis) {
    if (!header.timeInSpace || !axis.direction) return false;
    const std::size_t n = spatialDimension(header);
    return std::all_of(axis.direction->begin(), axis.direction->begin() + n,
                       [](double v) { return v == 0; }) &&
           (*axis.direction)[n] != 0;
}

// The time axis among four that do not say which it is: the one without direction when the others
// have one, the one that looks like it, else the slowest.
std::size_t timeOfFour(const ArrayHeader& header, const std::vector<std::size_t>& axes,
                       std::vector<std::string>& notes) {
    const auto undirected = [&](std::size_t i) { return !header.axes[i].direction; };
    const auto only = [&](auto test) -> std::optional<std::size_t> {
        if (std::ranges::count_if(axes, test) != 1) return std::nullopt;
        return *std::ranges::find_if(axes, test);
    };
    std::optional<std::size_t> time;
    if (header.spaceDimension > 0) time = only(undirected);
    if (!time) time = only([&](std::size_t i) { return looksLikeTime(header.axes[i]); });
    const ArrayAxis& first = header.axes[axes[0]];
    const bool components =
        first.kind == ArrayKind::Unknown && first.size <= kMaxComponents && !looksLikeTime(first) &&
        std::all_of(axes.begin() + 1, axes.end(),
                    [&](std::size_t i) { return header.axes[i].size > kMaxComponents; });
    if (components && (!time || *time == axes[0]))
        header.fail(place(axes[0]),
                    fmt::format("expected a kind that tells whether its {} samples are the "
                                "components of a value or points, found none",
                                first.size));
    if (time) return *time;
    notes.push_back(
        fmt::format("{} is taken for time: no axis says that it is", place(axes.back())));
    return axes.back();
}

std::optional<std::size_t> onlyOfKind(const ArrayHeader& header,
                                      const std::vector<std::size_t>& axes, ArrayKind kind) {
    std::optional<std::size_t> found;
    for (const std::size_t i : axes) {
        if (header.axes[i].kind != kind) continue;
        if (found)
            header.fail(place(i),
                        fmt::format("expected one axis of time, found also {}", place(*found)));
        found = i;
    }
    return found;
}

std::vector<double> spaced(double first, double spacing, std::uint64_t count) {
    std::vector<double> c(count);
    for (std::uint64_t i = 0; i < count; ++i) c[i] = first + spacing * static_cast<double>(i);
    return c;
}

Axis indexAxis(const ArrayAxis& axis, const std::string& name) {
    return {axis.label.empty() ? name : axis.label, "index", indexCoordinates(axis.size), false};
}

// By spacing and minimum; cell-centred unless the file says otherwise, as teem takes it
// (nrrdDefaultCenter): then a minimum is the border of the first cell.
Axis spacedAxis(const ArrayAxis& axis, const std::string& name, std::vector<std::string>& notes) {
    Axis index = indexAxis(axis, name);
    const bool cell = axis.cell.value_or(true);
    double spacing = axis.spacing;
    if (std::isnan(spacing) && !std::isnan(axis.min) && !std::isnan(axis.max)) {
        const std::uint64_t gaps = cell ? axis.size : axis.size - 1;
        spacing = gaps == 0 ? 1 : (axis.max - axis.min) / static_cast<double>(gaps);
    }
    if (std::isnan(spacing)) {
        if (axis.size > 1) notePlacedByIndex(notes, index.name, "spacing");
        return index;
    }
    const double first = std::isnan(axis.min) ? 0 : axis.min + (cell ? spacing / 2 : 0);
    std::vector<double> coordinates = spaced(first, spacing, axis.size);
    if (spacing == 0 || !flawOf(coordinates).empty()) {
        notes.push_back(
            fmt::format("{} is placed by index: a spacing of {} does not tell its samples apart",
                        index.name, spacing));
        return index;
    }
    return {index.name, axis.units, std::move(coordinates), false};
}

// How the axes of space lie in it. Axes that the file lacks stand upright on those that it has.
struct Directions {
    glm::dmat3 unit{0.0};             // columns; flawed where one reaches out of space
    std::array<double, 3> spacing{};  // from sample to sample
};

Directions directionsOf(const ArrayHeader& header, const ArrayRoles& roles) {
    const int n = static_cast<int>(std::min<std::size_t>(spatialDimension(header), 3));
    Directions found;
    for (int i = 0; i < static_cast<int>(roles.space.size()); ++i) {
        const auto& v = *header.axes[roles.space[i]].direction;
        glm::dvec3 step(0);
        for (int c = 0; c < n; ++c) step[c] = v[c];
        found.spacing[i] = std::hypot(step.x, step.y, step.z);
        const bool inSpace =
            std::all_of(v.begin() + n, v.begin() + header.spaceDimension,
                        [&](double out) { return std::abs(out) <= kAlignment * found.spacing[i]; });
        if (inSpace) found.unit[i] = step / found.spacing[i];
    }
    glm::dmat3& d = found.unit;
    if (roles.space.size() == 1) {
        const glm::dvec3 along = glm::abs(d[0]);
        const int least = along.x <= along.y && along.x <= along.z ? 0 : along.y <= along.z ? 1 : 2;
        d[1] = glm::normalize(glm::cross(d[0], glm::dmat3(1.0)[least]));
    }
    if (roles.space.size() < 3) d[2] = glm::normalize(glm::cross(d[0], d[1]));
    return found;
}

// Names of the coordinates of space: what grows along them, where the space says.
std::string coordinateName(const ArrayHeader& header, std::size_t component) {
    static constexpr std::array kLetters{"x", "y", "z"};
    std::vector<std::string> parts;
    std::string text = header.space;
    std::ranges::replace(text, '-', ' ');
    parts = words(text);
    const bool anatomical =
        parts.size() >= 3 && (parts[0] == "left" || parts[0] == "right") && parts[2] == "superior";
    return anatomical ? parts[component] : kLetters[component];
}

Axis alignedAxis(const ArrayHeader& header, std::size_t i, std::size_t component,
                 std::vector<std::string>& notes) {
    const ArrayAxis& axis = header.axes[i];
    const std::string name = axis.label.empty() ? coordinateName(header, component) : axis.label;
    const double first = header.origin ? (*header.origin)[component] : 0;
    std::vector<double> coordinates = spaced(first, (*axis.direction)[component], axis.size);
    if (!flawOf(coordinates).empty()) {
        notes.push_back(name + " is placed by index: its samples lie too close to tell apart");
        return indexAxis(axis, name);
    }
    return {name, header.spaceUnits[component], std::move(coordinates), false};
}

// Rotated or sheared: the axes are lengths from the first sample. Returns what is in the way.
std::string placeInFrame(const ArrayHeader& header, const ArrayRoles& roles,
                         const Directions& directions, ArrayPlacing& placing) {
    static constexpr std::array kIndices{"i", "j", "k"};
    if (const std::string flaw = flawOf(directions.unit); !flaw.empty()) return flaw;
    const auto& units = header.spaceUnits;
    if (!std::all_of(units.begin(), units.begin() + spatialDimension(header),
                     [&](const std::string& unit) { return unit == units[0]; }))
        return "its coordinates of space have other units";
    std::array<Axis, 3> axes;
    for (std::size_t i = 0; i < 3; ++i) {
        axes[i] = {kIndices[i], units[0], {0.0}, false};
        if (i >= roles.space.size()) continue;
        const ArrayAxis& source = header.axes[roles.space[i]];
        if (!source.label.empty()) axes[i].name = source.label;
        axes[i].coordinates = spaced(0, directions.spacing[i], source.size);
        if (const std::string flaw = flawOf(axes[i].coordinates); !flaw.empty())
            return axes[i].name + ": " + flaw;
    }
    placing.axes = std::move(axes);
    placing.frame.directions = directions.unit;
    for (int c = 0; c < 3; ++c) {
        if (header.origin) placing.frame.origin[c] = (*header.origin)[c];
        placing.frame.names[c] = coordinateName(header, c);
    }
    return "";
}

void checkSizes(const ArrayHeader& header, const ArrayRoles& roles, const ArrayLayout& layout) {
    for (const std::size_t i : roles.space)
        if (header.axes[i].size > kMaxAxis)
            header.fail(place(i), fmt::format("expected at most 2^24 points along an axis, found "
                                              "{}",
                                              header.axes[i].size));
    if (layout.steps > kMaxSteps)
        header.fail(place(*roles.time),
                    fmt::format("expected at most 2^20 steps, found {}", layout.steps));
    if (const std::uint64_t points = header.pointCount() / layout.steps; points > kMaxPoints)
        header.fail("field 'sizes'",
                    fmt::format("expected at most 2^32 points a step, found {}", points));
}

// The strides of the file's axes, `to` which axes of the grid they become.
void setStrides(const std::array<int, 3>& to, std::size_t axes, ArrayPlacing& placing) {
    ArrayLayout& layout = placing.layout;
    std::uint64_t stride = 1;
    for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < axes; ++i)
            if (to[i] == axis) layout.stride[i] = stride;
        stride *= placing.axes[axis].coordinates.size();
    }
    // Axes of one point move nothing.
    std::uint64_t inFile = 1;
    for (std::size_t i = 0; i < axes; inFile *= layout.size[i++])
        if (layout.size[i] > 1 && layout.stride[i] != inFile) layout.turned = true;
}

}  // namespace

ArrayRoles rolesOf(const ArrayHeader& header, std::vector<std::string>& notes) {
    std::vector<std::size_t> axes;  // of more than one sample, or of time
    for (std::size_t i = 0; i < header.axes.size(); ++i) {
        const ArrayAxis& axis = header.axes[i];
        if (axis.kind == ArrayKind::Components && axis.size > 1)
            header.fail(place(i), fmt::format("expected one number a point, found {} ({})",
                                              axis.size, axis.kindName));
        if (axis.kind != ArrayKind::Components) axes.push_back(i);
    }
    ArrayRoles roles;
    roles.time = onlyOfKind(header, axes, ArrayKind::Time);
    if (!roles.time) roles.time = onlyOfKind(header, axes, ArrayKind::List);
    if (!roles.time)
        for (const std::size_t i : axes)
            if (alongTime(header, header.axes[i])) roles.time = i;
    std::size_t room = roles.time ? 4 : 3;
    // Axes of one sample give way, the slowest first.
    if (axes.size() > 4)
        for (std::size_t k = axes.size(); k-- > 0 && axes.size() > room;)
            if (header.axes[axes[k]].size == 1 && axes[k] != roles.time)
                axes.erase(axes.begin() + static_cast<std::ptrdiff_t>(k));
    if (axes.size() == 4 && !roles.time) roles.time = timeOfFour(header, axes, notes);
    room = roles.time ? 4 : 3;
    if (axes.size() > room)
        header.fail("field 'dimension'",
                    fmt::format("expected three axes of space and one of time at most, found {} "
                                "axes",
                                axes.size()));
    for (const std::size_t i : axes)
        if (i != roles.time) roles.space.push_back(i);
    return roles;
}

ArrayLayout layoutOf(const ArrayHeader& header, const ArrayRoles& roles) {
    ArrayLayout layout;
    for (std::size_t i = 0; i < header.axes.size(); ++i) {
        if (i == roles.time)
            layout.steps = header.axes[i].size;
        else
            (roles.time && i > *roles.time ? layout.outer : layout.inner) *= header.axes[i].size;
    }
    for (std::size_t i = 0; i < roles.space.size(); ++i)
        layout.size[i] = header.axes[roles.space[i]].size;
    checkSizes(header, roles, layout);
    return layout;
}

ArrayPlacing placingOf(const ArrayHeader& header, const ArrayRoles& roles, ArrayLayout layout,
                       std::vector<std::string>& notes) {
    static constexpr std::array kLetters{"x", "y", "z"};
    ArrayPlacing placing;
    placing.layout = layout;

    std::array<int, 3> to{0, 1, 2};  // which axis of the grid each becomes
    for (std::size_t axis = 0; axis < 3; ++axis)
        placing.axes[axis] = {kLetters[axis], "index", {0.0}, false};
    const bool directed =
        !roles.space.empty() && std::ranges::all_of(roles.space, [&](std::size_t i) {
            return header.axes[i].direction.has_value();
        });
    if (directed) {
        const Directions directions = directionsOf(header, roles);
        const auto along = alignedWith(directions.unit);
        const std::string flaw = along ? "" : placeInFrame(header, roles, directions, placing);
        if (along) to = *along;
        if (along)
            for (std::size_t i = 0; i < roles.space.size(); ++i)
                placing.axes[to[i]] = alignedAxis(header, roles.space[i], to[i], notes);
        if (!flaw.empty()) {
            notes.push_back("drawn in index space: " + flaw);
            for (std::size_t i = 0; i < roles.space.size(); ++i)
                placing.axes[i] = indexAxis(header.axes[roles.space[i]], kLetters[i]);
        } else if (header.leftHanded) {
            notes.push_back("drawn mirrored: its space, " + header.space + ", is left-handed");
        }
    } else {
        for (std::size_t i = 0; i < roles.space.size(); ++i)
            placing.axes[i] = spacedAxis(header.axes[roles.space[i]], kLetters[i], notes);
    }
    setStrides(to, roles.space.size(), placing);
    return placing;
}

}  // namespace timeseries
