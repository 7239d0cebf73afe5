#include "render/annotate/map_lines.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/common.hpp>
#include <string_view>

#include "render/points/globe.h"

extern "C" {
extern const unsigned char isochron_coastlines_begin[], isochron_coastlines_end[];
}

namespace render {
namespace {

constexpr double kTurn = 360;

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
    if (!isGeographic(grid)) return std::nullopt;
    const timeseries::Axis& axis = grid.axes()[2];
    const auto x = grid.ends(0), y = grid.ends(1), z = grid.ends(2);
    const bool inDepths = isDepth(axis);
    return MapPlane{{x.least, y.least},
                    {x.most, y.most},
                    axis.down != inDepths ? z.most : z.least,
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
