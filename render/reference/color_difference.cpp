#include "render/reference/color_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace render {
namespace {

constexpr double kTurn = 360;

double radians(double degrees) { return degrees * std::numbers::pi / 180; }
double cosine(double degrees) { return std::cos(radians(degrees)); }

// [0, 360); 0 where there is no hue.
double hue(double a, double b) {
    if (a == 0 && b == 0) return 0;
    const double h = std::atan2(b, a) * 180 / std::numbers::pi;
    return h < 0 ? h + kTurn : h;
}

double pow7(double x) { return x * x * x * x * x * x * x; }
// sqrt(C^7 / (C^7 + 25^7)).
double saturation(double chroma) { return std::sqrt(pow7(chroma) / (pow7(chroma) + pow7(25))); }

double labCurve(double t) {
    constexpr double kEdge = 6.0 / 29;
    return t > kEdge * kEdge * kEdge ? std::cbrt(t) : t / (3 * kEdge * kEdge) + 4.0 / 29;
}

}  // namespace

Lab labFromLinear(const glm::dvec3& rgb) {
    // IEC 61966-2-1; columns are the primaries.
    static const glm::dmat3 xyzFromRgb(0.4124, 0.2126, 0.0193, 0.3576, 0.7152, 0.1192, 0.1805,
                                       0.0722, 0.9505);
    static const glm::dvec3 white = xyzFromRgb * glm::dvec3(1);
    const glm::dvec3 xyz = xyzFromRgb * glm::clamp(rgb, 0.0, 1.0) / white;
    const double x = labCurve(xyz.x), y = labCurve(xyz.y), z = labCurve(xyz.z);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double ciede2000(const Lab& one, const Lab& other) {
    const double meanC = (std::hypot(one.a, one.b) + std::hypot(other.a, other.b)) / 2;
    const double redder = 1 + 0.5 * (1 - saturation(meanC));
    const double a1 = redder * one.a, a2 = redder * other.a;
    const double c1 = std::hypot(a1, one.b), c2 = std::hypot(a2, other.b);
    const double h1 = hue(a1, one.b), h2 = hue(a2, other.b);
    const bool isGrey = c1 * c2 == 0;

    double dh = isGrey ? 0 : h2 - h1;
    if (dh > kTurn / 2) dh -= kTurn;
    if (dh < -kTurn / 2) dh += kTurn;
    double h = h1 + h2;
    if (!isGrey) {
        if (std::abs(h1 - h2) > kTurn / 2) h += h < kTurn ? kTurn : -kTurn;
        h /= 2;
    }
    const double l = (one.l + other.l) / 2, c = (c1 + c2) / 2;
    const double t = 1 - 0.17 * cosine(h - 30) + 0.24 * cosine(2 * h) + 0.32 * cosine(3 * h + 6) -
                     0.20 * cosine(4 * h - 63);
    const double fromGrey = (l - 50) * (l - 50);
    const double blue = (h - 275) / 25;
    const double turn = -std::sin(radians(60 * std::exp(-blue * blue))) * 2 * saturation(c);
    const double dl = (other.l - one.l) / (1 + 0.015 * fromGrey / std::sqrt(20 + fromGrey));
    const double dc = (c2 - c1) / (1 + 0.045 * c);
    const double dH = 2 * std::sqrt(c1 * c2) * std::sin(radians(dh / 2)) / (1 + 0.015 * c * t);
    return std::sqrt(dl * dl + dc * dc + dH * dH + turn * dc * dH);
}

double colorDifferenceQuantile(const Image& tested, const Image& reference,
                               const glm::vec3& background, double share) {
    if (tested.size != reference.size)
        throw std::invalid_argument(
            fmt::format("pictures of {} x {} and {} x {} pixels cannot be compared", tested.size.x,
                        tested.size.y, reference.size.x, reference.size.y));
    std::vector<double> differences;
    for (std::size_t i = 0; i < tested.pixels.size(); ++i) {
        const glm::vec3 a(tested.pixels[i]), b(reference.pixels[i]);
        if (a == background && b == background) continue;
        for (int c = 0; c < 3; ++c)
            if (std::isnan(a[c]) || std::isnan(b[c]))
                return std::numeric_limits<double>::quiet_NaN();
        differences.push_back(
            a == b ? 0 : ciede2000(labFromLinear(glm::dvec3(a)), labFromLinear(glm::dvec3(b))));
    }
    if (differences.empty()) return 0;
    const auto rank =
        static_cast<std::size_t>(std::ceil(share * static_cast<double>(differences.size())));
    const auto at =
        differences.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1)) - 1;
    std::ranges::nth_element(differences, at);
    return *at;
}

}  // namespace render
