#include "render/annotate/map_lines.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/common.hpp>
#include <string_view>

extern "C" {
extern const unsigned char isochron_coastlines_begin[], isochron_coastlines_end[];
}

namespace render {
namespace {

using timeseries::Axis;

constexpr double kTurn = 360;

std::string lowerCase(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

// CF 1.10, sections 4.1 and 4.2; degrees alone with a name that leaves no doubt.
bool isDegrees(const Axis& axis, std::string_view direction, std::string_view name) {
    const std::string units = lowerCase(axis.units), called = lowerCase(axis.name);
    if (!units.starts_with("degree")) return false;
    std::string_view rest = std::string_view(units).substr(6);
    if (rest.starts_with('s')) rest.remove_prefix(1);
    if (rest.starts_with('_')) rest.remove_prefix(1);
    if (rest == direction || rest == direction.substr(0, 1)) return true;
    return rest.empty() && (called == name || called == name.substr(0, 3));
}

// What lies in depths counts downwards, and so does the pressure of the air.
bool isOfTheAir(const Axis& axis) {
    constexpr std::array<std::string_view, 7> kPressures{"pa",   "hpa",      "kpa",      "mb",
                                                         "mbar", "millibar", "millibars"};
    return std::ranges::find(kPressures, lowerCase(axis.units)) != kPressures.end();
}

std::vector<MapLine> readLines(std::string_view text) {
    std::vector<MapLine> lines;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        if (line.starts_with('#')) continue;
        MapLine places;
        std::array<double, 2> place{};
        const char *next = line.data(), *const end = next + line.size();
        for (std::size_t n = 0; next != end; ++n) {
            next = std::from_chars(next, end, place[n % 2]).ptr;
            if (n % 2 == 1) places.emplace_back(place[0], place[1]);
            if (next != end) ++next;
        }
        lines.push_back(std::move(places));
    }
    return lines;
}

// The part of a to b within [lo, hi]; nothing where it only touches.
std::optional<std::array<glm::dvec2, 2>> within(const glm::dvec2& a, const glm::dvec2& b,
                                                const glm::dvec2& lo, const glm::dvec2& hi) {
    double first = 0, last = 1;
    for (int c = 0; c < 2; ++c) {
        const double way = b[c] - a[c];
        if (way == 0) {
            if (a[c] < lo[c] || a[c] > hi[c]) return std::nullopt;
            continue;
        }
        const double toLo = (lo[c] - a[c]) / way, toHi = (hi[c] - a[c]) / way;
        first = std::max(first, std::min(toLo, toHi));
        last = std::min(last, std::max(toLo, toHi));
    }
    if (!(first < last)) return std::nullopt;
    return std::array{glm::mix(a, b, first), glm::mix(a, b, last)};
}

}  // namespace

const std::vector<MapLine>& coastlines() {
    static const std::vector<MapLine> lines =
        readLines({reinterpret_cast<const char*>(isochron_coastlines_begin),
                   static_cast<std::size_t>(isochron_coastlines_end - isochron_coastlines_begin)});
    return lines;
}

std::optional<MapPlane> mapPlaneOf(const timeseries::Grid& grid) {
    const auto& axes = grid.axes();
    if (!grid.frame().aligned() || !isDegrees(axes[0], "east", "longitude") ||
        !isDegrees(axes[1], "north", "latitude"))
        return std::nullopt;
    const auto x = grid.ends(0), y = grid.ends(1), z = grid.ends(2);
    // More than once round is no longitude.
    if (!(x.most - x.least <= kTurn + 1) || !(std::max(std::abs(x.least), std::abs(x.most)) <= 720))
        return std::nullopt;
    const bool inDepths = axes[2].down && !isOfTheAir(axes[2]);
    return MapPlane{{x.least, y.least},
                    {x.most, y.most},
                    axes[2].down != inDepths ? z.most : z.least,
                    inDepths ? 1 : -1};
}

std::vector<MapLine> linesWithin(const MapPlane& plane, const std::vector<MapLine>& lines) {
    std::vector<MapLine> found;
    const double first = std::floor((plane.lo.x - 180) / kTurn),
                 last = std::ceil((plane.hi.x + 180) / kTurn);
    for (double turn = first; turn <= last; ++turn)
        for (const MapLine& line : lines) {
            bool goesOn = false;
            for (std::size_t i = 1; i < line.size(); ++i) {
                const glm::dvec2 shift(turn * kTurn, 0);
                const auto part = within(line[i - 1] + shift, line[i] + shift, plane.lo, plane.hi);
                if (!part) {
                    goesOn = false;
                    continue;
                }
                if (!goesOn || found.back().back() != (*part)[0]) found.push_back({(*part)[0]});
                found.back().push_back((*part)[1]);
                goesOn = true;
            }
        }
    return found;
}

std::vector<MapLine> graticuleOf(const MapPlane& plane) {
    constexpr std::array kSteps{0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 30.0};
    constexpr double kMost = 12;
    const glm::dvec2 extent = plane.hi - plane.lo;
    const auto fits = std::ranges::find_if(
        kSteps, [&](double step) { return std::max(extent.x, extent.y) <= kMost * step; });
    const double step = fits == kSteps.end() ? kSteps.back() : *fits;
    std::vector<MapLine> lines;
    for (int c = 0; c < 2; ++c)
        for (double n = std::ceil(plane.lo[c] / step); n * step <= plane.hi[c]; ++n) {
            glm::dvec2 from = plane.lo, to = plane.hi;
            from[c] = to[c] = n * step;
            lines.push_back({from, to});
        }
    return lines;
}

}  // namespace render
