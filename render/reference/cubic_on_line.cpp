#include "render/reference/cubic_on_line.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace render {
namespace {

double mix(double a, double b, double t) { return a + t * (b - a); }

double trilinear(const std::array<double, 8>& f, double x, double y, double z) {
    const double low = mix(mix(f[0], f[1], x), mix(f[2], f[3], x), y);
    const double high = mix(mix(f[4], f[5], x), mix(f[6], f[7], x), y);
    return mix(low, high, z);
}

// At most eight places, ascending.
class PlacesOnLine {
 public:
    void add(double t) {
        std::size_t i = count_++;
        for (; i > 0 && at_[i - 1] > t; --i) at_[i] = at_[i - 1];
        at_[i] = t;
    }
    const double* begin() const { return at_.data(); }
    const double* end() const { return at_.data() + count_; }

 private:
    std::array<double, 8> at_{};
    std::size_t count_ = 0;
};

// Where d0 (1 - t)^2 + 2 d1 t (1 - t) + d2 t^2 changes its sign. Of the two forms of a root each is
// taken where nothing cancels.
void addRoots(double d0, double d1, double d2, PlacesOnLine& into) {
    const double square = d1 * d1 - d0 * d2;
    if (!(square > 0)) return;
    const double half = d1 - d0;
    const double q = -(half + std::copysign(std::sqrt(square), half));
    for (const double t : {q / (d0 - 2 * d1 + d2), d0 / q})
        if (t > 0 && t < 1) into.add(t);
}

// Where the derivative is this: a third of it has the coefficients f[1] - f[0], f[2] - f[1] and
// f[3] - f[2], and a constant has three that are the same.
void addPlacesOfSlope(const Cubic& f, double slope, PlacesOnLine& into) {
    addRoots(f[1] - f[0] - slope / 3, f[2] - f[1] - slope / 3, f[3] - f[2] - slope / 3, into);
}

// Between two places at which a monotonic stretch of f - level has different signs: Newton's steps,
// and halves where these leave the bracket.
double crossing(const Cubic& f, double level, double from, double to, bool rises) {
    double t = 0.5 * (from + to);
    for (int i = 0; i < 100; ++i) {
        const double above = valueAt(f, t) - level;
        (above > 0) == rises ? to = t : from = t;
        const double s = 1 - t;
        const double slope =
            3 * (s * s * (f[1] - f[0]) + 2 * s * t * (f[2] - f[1]) + t * t * (f[3] - f[2]));
        double next = t - above / slope;
        if (!(next > from && next < to)) next = 0.5 * (from + to);
        if (std::abs(next - t) < 1e-16) return next;
        t = next;
    }
    return t;
}

void addCrossings(const Cubic& f, double level, const PlacesOnLine& turns, PlacesOnLine& into) {
    const auto [least, most] = std::ranges::minmax(f);
    if (!(least < level && level < most)) return;
    double from = 0, first = f[0];
    const auto until = [&](double to, double last) {
        if ((first > level) != (last > level)) into.add(crossing(f, level, from, to, last > first));
        from = to;
        first = last;
    };
    for (const double turn : turns) until(turn, valueAt(f, turn));
    until(1, f[3]);
}

// use(from, to) of stretches on which f lies between these and has no end of them within,
// ascending.
template <typename Use>
void forEachPartWithin(const Cubic& f, double lo, double hi, const Use& use) {
    PlacesOnLine turns, ends;
    addPlacesOfSlope(f, 0, turns);
    addCrossings(f, lo, turns, ends);
    addCrossings(f, hi, turns, ends);
    double from = 0;
    const auto until = [&](double to) {
        const double middle = valueAt(f, 0.5 * (from + to));
        if (to > from && middle >= lo && middle <= hi) use(from, to);
        from = to;
    };
    for (const double end : ends) until(end);
    until(1);
}

}  // namespace

Cubic cubicOnLine(const std::array<double, 8>& corners, const glm::dvec3& a, const glm::dvec3& b) {
    const auto mean = [&](const glm::dvec3& most, const glm::dvec3& one) {
        return (trilinear(corners, one.x, most.y, most.z) +
                trilinear(corners, most.x, one.y, most.z) +
                trilinear(corners, most.x, most.y, one.z)) /
               3;
    };
    return {trilinear(corners, a.x, a.y, a.z), mean(a, b), mean(b, a),
            trilinear(corners, b.x, b.y, b.z)};
}

double valueAt(const Cubic& f, double t) {
    const double a = mix(f[0], f[1], t), b = mix(f[1], f[2], t), c = mix(f[2], f[3], t);
    return mix(mix(a, b, t), mix(b, c, t), t);
}

void addPartsWithin(const Cubic& f, double lo, double hi, std::vector<LinePart>& into) {
    forEachPartWithin(f, lo, hi, [&](double from, double to) {
        if (!into.empty() && into.back().to == from)
            into.back().to = to;
        else
            into.push_back({from, to});
    });
}

double passageWithin(const Cubic& f, double lo, double hi, double width, double whole) {
    PlacesOnLine bends;
    for (const double slope : {width * whole, -width * whole}) addPlacesOfSlope(f, slope, bends);
    double sum = 0;
    const auto add = [&](double from, double to) {
        sum += std::max(whole * (to - from), std::abs(valueAt(f, to) - valueAt(f, from)) / width);
    };
    forEachPartWithin(f, lo, hi, [&](double from, double to) {
        for (const double bend : bends)
            if (bend > from && bend < to) add(std::exchange(from, bend), bend);
        add(from, to);
    });
    return sum;
}

}  // namespace render
