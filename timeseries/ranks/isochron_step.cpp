#include "timeseries/ranks/isochron_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>

#include "timeseries/grid/with_type.h"
#include "timeseries/ranks/shared_step.h"
#include "timeseries/readers/step_about.h"

namespace timeseries {
namespace {

struct Refused : std::invalid_argument {
    using std::invalid_argument::invalid_argument;
};

std::string textOf(const char* text, const char* without = "") { return text ? text : without; }

StepAbout::Place placeOf(const isochron_axis& axis, int a) {
    static constexpr std::array kNames{"x", "y", "z"};
    const std::string name = textOf(axis.name, kNames[static_cast<std::size_t>(a)]);
    StepAbout::Place place{name, textOf(axis.units), axis.origin, axis.spacing, {}};
    if (axis.coordinates) {
        place.coordinates.assign(axis.coordinates, axis.coordinates + axis.points);
        if (const std::string flaw = flawOf(place.coordinates); !flaw.empty())
            throw Refused(fmt::format("axis {}: {}", name, flaw));
        // Each takes up to 24 bytes as text, of the 2^24 that a file has for all of it.
        if (place.coordinates.size() > 200'000)
            throw Refused(fmt::format("axis {}: expected at most 200000 coordinates", name));
    } else if (!std::isfinite(axis.origin) || !std::isfinite(axis.spacing) || axis.spacing == 0) {
        throw Refused(
            fmt::format("axis {}: expected a finite origin and a spacing that is not 0, "
                        "found {} and {}",
                        name, axis.origin, axis.spacing));
    } else if (const std::string flaw = flawOf(place.evenly(axis.points)); !flaw.empty()) {
        throw Refused(fmt::format("axis {}: {}, of {} points from {} in steps of {}", name, flaw,
                                  axis.points, axis.origin, axis.spacing));
    }
    return place;
}

StepAbout aboutOf(const isochron_step& step) {
    if (!step.variable) throw Refused("expected the variable's name");
    if (!std::isfinite(step.time))
        throw Refused(fmt::format("expected a finite time, found {}", step.time));
    StepAbout about{step.variable, textOf(step.units), step.time, textOf(step.time_units), {}};
    for (int a = 0; a < 3; ++a) about.axes[static_cast<std::size_t>(a)] = placeOf(step.axis[a], a);
    return about;
}

// What all ranks must say alike. Whatever else differs is the first rank's.
void expectAlike(const Ranks& ranks, const isochron_step& step) {
    const std::array<std::uint64_t, 5> mine{static_cast<std::uint64_t>(step.type),
                                            step.missing != nullptr, step.axis[0].points,
                                            step.axis[1].points, step.axis[2].points};
    const auto all = ranks.gather<std::array<std::uint64_t, 5>>({&mine, 1});
    for (std::size_t r = 1; r < all.size(); ++r)
        if (all[r] != all[0])
            throw Refused(fmt::format(
                "expected the same type, grid and missing value on all ranks, found others on {}",
                r));
    if (all[0][0] > ISOCHRON_DOUBLE)
        throw Refused(fmt::format("expected a type, found {}", all[0][0]));
    if (!step.missing) return;
    std::uint64_t missing = 0;
    withType(static_cast<ValueType>(step.type),
             [&]<typename T>(T) { std::memcpy(&missing, step.missing, sizeof(T)); });
    const auto of = ranks.gather<std::uint64_t>({&missing, 1});
    for (std::size_t r = 1; r < of.size(); ++r)
        if (of[r] != of[0])
            throw Refused(fmt::format(
                "expected the same missing value on all ranks, found another on {}", r));
}

// The values of the box, without what lies between its rows and slices.
template <typename T>
Field fieldOf(const isochron_step& step, const GridBox& box) {
    const std::uint64_t row = step.row ? step.row : box.size[0];
    const std::uint64_t slice = step.slice ? step.slice : row * box.size[1];
    const auto* const from = static_cast<const T*>(step.values);
    std::vector<T> values;
    values.reserve(box.count());
    for (std::uint64_t z = 0; z < box.size[2]; ++z)
        for (std::uint64_t y = 0; y < box.size[1]; ++y) {
            const T* const begin = from + z * slice + y * row;
            values.insert(values.end(), begin, begin + box.size[0]);
        }
    Field field;
    if (step.missing) {
        T missing;
        std::memcpy(&missing, step.missing, sizeof missing);
        field.missing.resize(values.size());
        for (std::size_t i = 0; i < values.size(); ++i) field.missing[i] = values[i] == missing;
    }
    field.values = std::move(values);
    return field;
}

constexpr std::uint64_t kMostApart = std::uint64_t{1} << 40;  // values; 8 TB of doubles

// REQUIRES: a box of some points.
void expectApart(const isochron_step& step, const GridBox& box) {
    if (step.row > kMostApart || step.slice > kMostApart)
        throw Refused(fmt::format("expected rows and slices in memory, found them {} and {} apart",
                                  step.row, step.slice));
    const std::uint64_t row = step.row ? step.row : box.size[0];
    const std::uint64_t held = row * (box.size[1] - 1) + box.size[0];  // by a slice
    if (row < box.size[0] || (box.size[2] > 1 && step.slice && step.slice < held))
        throw Refused(
            fmt::format("expected rows and slices that are apart by no less than they hold, {} and "
                        "{} values, found them {} and {} apart",
                        box.size[0], held, row, step.slice ? step.slice : held));
}

void writeStepOf(const Ranks& ranks, const char* path, const isochron_step* given) {
    ranks.agreed([&] {
        if (!given) throw Refused("expected a step");
    });
    const isochron_step& step = *given;
    expectAlike(ranks, step);
    GridBox box;
    SharedStep shared;
    for (std::size_t a = 0; a < 3; ++a) {
        if (step.axis[a].points > kMostAlong)
            throw Refused("a grid of more than the 2^24 points along an axis that are read");
        shared.size[a] = static_cast<std::uint32_t>(step.axis[a].points);
        box.first[a] = step.first[a];
        box.size[a] = step.size[a];
    }
    if (const std::string flaw = flawOf(ranks, box, shared.size); !flaw.empty())
        throw Refused(flaw);
    Field field;
    std::optional<WholeFile> file;
    ranks.agreed([&] {
        if (box.count() > 0 && !step.values) throw Refused("expected the values of its box");
        if (box.count() > 0) expectApart(step, box);
        withType(static_cast<ValueType>(step.type),
                 [&]<typename T>(T) { field = fieldOf<T>(step, box); });
        if (!ranks.isFirst()) return;
        if (!path) throw Refused("expected the name of a file");
        shared.about = timeseries::textOf(aboutOf(step));
        // What a run that was killed has left of this file.
        const std::filesystem::path whole(path);
        removeUnfinished(whole.parent_path().empty() ? "." : whole.parent_path(),
                         [&](const auto& name) { return name == whole.filename(); });
        file.emplace(path);
    });
    writeShared(ranks, std::move(field), box, shared, file ? &*file : nullptr);
    ranks.agreed([&] {
        if (file) file->finish();
    });
}

}  // namespace
}  // namespace timeseries

int isochron_write_step(MPI_Comm comm, const char* path, const isochron_step* step, char* message,
                        size_t message_bytes) {
    std::string why;
    try {
        timeseries::writeStepOf(timeseries::Ranks(comm), path, step);
    } catch (const std::exception& error) {
        why = error.what();
    }
    if (message && message_bytes > 0) {
        const std::size_t length = std::min(why.size(), message_bytes - 1);
        std::memcpy(message, why.data(), length);
        message[length] = '\0';
    }
    return why.empty() ? 0 : 1;
}
