#include "render/model/color_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "render/image/color.h"
#include "render/model/color_map_tables.h"

namespace render {

struct ColorMapTable {
    std::string_view name;
    std::vector<glm::vec3> entries;  // linear light
};

namespace {

// CIELAB in polar form (Moreland 2009, section 5.1): magnitude, saturation angle, hue angle.
struct Msh {
    double m, s, h;
};

// IEC 61966-2-1; rows of XYZ from linear RGB, Y of white is 1.
const glm::dmat3 kXyzFromLinear = glm::transpose(glm::dmat3(0.4124, 0.3576, 0.1805,  //
                                                            0.2126, 0.7152, 0.0722,  //
                                                            0.0193, 0.1192, 0.9505));

// CIE 15:2004, section 8.2.1.1.
constexpr double kLinearBelow = 6.0 / 29;
double labRoot(double ratio) {
    if (ratio > kLinearBelow * kLinearBelow * kLinearBelow) return std::cbrt(ratio);
    return ratio / (3 * kLinearBelow * kLinearBelow) + 4.0 / 29;
}
double labCube(double root) {
    if (root > kLinearBelow) return root * root * root;
    return 3 * kLinearBelow * kLinearBelow * (root - 4.0 / 29);
}

Msh mshFromLinear(glm::dvec3 linear) {
    const glm::dvec3 ratio = kXyzFromLinear * linear / (kXyzFromLinear * glm::dvec3(1));
    const glm::dvec3 root(labRoot(ratio.x), labRoot(ratio.y), labRoot(ratio.z));
    const glm::dvec3 lab(116 * root.y - 16, 500 * (root.x - root.y), 200 * (root.y - root.z));
    const double m = glm::length(lab);
    return {m, std::acos(lab.x / m), std::atan2(lab.z, lab.y)};
}

glm::dvec3 linearFromMsh(const Msh& color) {
    const double a = color.m * std::sin(color.s) * std::cos(color.h);
    const double b = color.m * std::sin(color.s) * std::sin(color.h);
    const double y = (color.m * std::cos(color.s) + 16) / 116;
    const glm::dvec3 ratio(labCube(y + a / 500), labCube(y), labCube(y - b / 200));
    const glm::dvec3 xyz = ratio * (kXyzFromLinear * glm::dvec3(1));
    return glm::clamp(glm::inverse(kXyzFromLinear) * xyz, 0.0, 1.0);
}

// The hue at the neutral end of a side, spun so that hue turns evenly as saturation fades
// (Moreland 2009, section 5.2, "AdjustHue").
double hueAtNeutral(const Msh& saturated, double neutralM) {
    if (saturated.m >= neutralM) return saturated.h;
    const double spin = saturated.s * std::sqrt(neutralM * neutralM - saturated.m * saturated.m) /
                        (saturated.m * std::sin(saturated.s));
    return saturated.h > -std::numbers::pi / 3 ? saturated.h + spin : saturated.h - spin;
}

// K. Moreland, "Diverging Color Maps for Scientific Visualization", ISVC 2009 (LNCS 5876),
// section 5: each side goes straight in Msh from its end colour to a neutral of magnitude 88.
std::vector<glm::vec3> coolWarm() {
    constexpr int kSide = 128;  // the neutral centre is an entry of its own
    const Msh cool = mshFromLinear(linearFromSrgb8(59, 76, 192));
    const Msh warm = mshFromLinear(linearFromSrgb8(180, 4, 38));
    const double neutralM = std::max({cool.m, warm.m, 88.0});
    std::vector<glm::vec3> entries;
    for (int i = -kSide; i <= kSide; ++i) {
        const Msh& end = i < 0 ? cool : warm;
        const double toEnd = std::abs(i) / static_cast<double>(kSide);
        const Msh color{std::lerp(neutralM, end.m, toEnd), end.s * toEnd,
                        std::lerp(hueAtNeutral(end, neutralM), end.h, toEnd)};
        entries.emplace_back(linearFromMsh(color));
    }
    return entries;
}

std::vector<glm::vec3> decode(const EncodedTable& encoded) {
    std::vector<glm::vec3> entries;
    for (const auto& [r, g, b] : encoded) {
        entries.emplace_back(linearFromSrgb(glm::dvec3(r, g, b) / 65535.0));
    }
    return entries;
}

constexpr std::array<std::string_view, 4> kNames = {"viridis", "cividis", "inferno", "cool-warm"};

// Behind all of them, all of them reversed.
const std::vector<ColorMapTable>& tables() {
    static const std::vector<ColorMapTable> all = [] {
        std::vector<ColorMapTable> both{{kNames[0], decode(kViridis)},
                                        {kNames[1], decode(kCividis)},
                                        {kNames[2], decode(kInferno)},
                                        {kNames[3], coolWarm()}};
        for (std::size_t i = 0; i < kNames.size(); ++i)
            both.push_back({kNames[i], {both[i].entries.rbegin(), both[i].entries.rend()}});
        return both;
    }();
    return all;
}

}  // namespace

ColorMap::ColorMap() : table_(&tables().front()) {}

std::string_view ColorMap::name() const { return table_->name; }

ColorMap ColorMap::reversed() const {
    const auto place = static_cast<std::size_t>(table_ - tables().data());
    return ColorMap(tables()[(place + kNames.size()) % tables().size()]);
}

std::vector<glm::vec3> sumsOf(std::span<const glm::vec3> entries) {
    std::vector<glm::vec3> sums;
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if (i > 0) sum += 0.5 * (glm::dvec3(entries[i - 1]) + glm::dvec3(entries[i]));
        sums.emplace_back(sum);
    }
    return sums;
}

std::span<const glm::vec3> ColorMap::entries() const { return table_->entries; }

glm::vec3 ColorMap::at(double t) const {
    const auto& entries = table_->entries;
    if (!(t > 0)) return entries.front();
    if (t >= 1) return entries.back();
    const double position = t * static_cast<double>(entries.size() - 1);
    const auto below = static_cast<std::size_t>(position);
    return glm::mix(entries[below], entries[below + 1],
                    static_cast<float>(position - static_cast<double>(below)));
}

std::span<const std::string_view> colorMapNames() { return kNames; }

std::optional<ColorMap> colorMapNamed(std::string_view name) {
    for (const auto& table : tables()) {
        if (table.name == name) return ColorMap(table);
    }
    return std::nullopt;
}

}  // namespace render
