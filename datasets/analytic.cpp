#include "datasets/analytic.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>

namespace datasets {

namespace {

constexpr double kPi = std::numbers::pi;

// In [0, 1). The distributions of the standard library differ between its implementations; the
// engine's numbers do not.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

// Even over the sphere (Archimedes: z is even in [-1, 1]).
glm::dvec3 direction(std::mt19937_64& random) {
    const double z = 2 * uniform(random) - 1;
    const double angle = 2 * kPi * uniform(random);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

template <typename T>
std::vector<T> samples(const Function& function, const timeseries::Grid& grid, double t) {
    std::vector<T> values;
    values.reserve(grid.count());
    for (std::uint64_t i = 0; i < grid.count(); ++i)
        values.push_back(static_cast<T>(function(grid.position(i), t)));
    return values;
}

}  // namespace

glm::dvec3 SphereRamp::centre(double t) const {
    const double angle = 2 * kPi * (t / period);
    return middle + orbitRadius * glm::dvec3(std::cos(angle), std::sin(angle), 0);
}

double SphereRamp::operator()(const glm::dvec3& p, double t) const {
    return glm::length(p - centre(t));
}

double LinearRamp::operator()(const glm::dvec3& p, double t) const {
    return glm::dot(slope, p) - speed * t;
}

double MarschnerLobb::operator()(const glm::dvec3& p, double) const {
    const double r = std::sqrt(p.x * p.x + p.y * p.y);
    const double radial = std::cos(2 * kPi * frequency * std::cos(kPi * r / 2));
    return (1 - std::sin(kPi * p.z / 2) + alpha * (1 + radial)) / (2 * (1 + alpha));
}

glm::dvec3 AbcFlowSpeed::velocity(const glm::dvec3& p, double t) const {
    const glm::dvec3 q = p - glm::dvec3(drift * t);
    return {A * std::sin(q.z) + C * std::cos(q.y), B * std::sin(q.x) + A * std::cos(q.z),
            C * std::sin(q.y) + B * std::cos(q.x)};
}

double AbcFlowSpeed::operator()(const glm::dvec3& p, double t) const {
    return glm::length(velocity(p, t));
}

Turbulence::Turbulence() : Turbulence(Settings{}) {}

Turbulence::Turbulence(const Settings& s) {
    std::mt19937_64 random(s.seed);
    const double ratio = s.greatestWaveNumber / s.leastWaveNumber;
    double energy = 0;  // the variance of a wave is half its amplitude squared
    for (std::size_t i = 0; i < s.waves; ++i) {
        const double along =
            s.waves > 1 ? static_cast<double>(i) / static_cast<double>(s.waves - 1) : 0;
        const double scale = std::pow(ratio, along);  // k over the least k
        const glm::dvec3 k = s.leastWaveNumber * scale * direction(random);
        const double amplitude = std::pow(scale, -1.0 / 3);
        waves_.push_back(
            {k, amplitude, 2 * kPi * uniform(random), s.turnover * std::pow(scale, 2.0 / 3)});
        energy += amplitude * amplitude / 2;
    }
    for (Wave& wave : waves_) wave.amplitude /= std::sqrt(energy);
}

double Turbulence::operator()(const glm::dvec3& p, double t) const {
    double sum = 0;
    for (const Wave& w : waves_)
        sum += w.amplitude * std::cos(glm::dot(w.k, p) + w.phase - w.omega * t);
    return sum;
}

std::shared_ptr<const timeseries::Grid> uniformGrid(const std::array<std::size_t, 3>& size,
                                                    const Box& box) {
    constexpr const char* kNames[] = {"x", "y", "z"};
    std::array<timeseries::Axis, 3> axes;
    for (int a = 0; a < 3; ++a) {
        const double lo = box.lo[a], hi = box.hi[a];
        const std::size_t n = size[static_cast<std::size_t>(a)];
        if (!(lo < hi) || !std::isfinite(hi - lo))
            throw std::invalid_argument("a box needs finite ends, lo < hi in each axis");
        timeseries::Axis& axis = axes[static_cast<std::size_t>(a)];
        axis.name = kNames[a];
        if (n == 1) axis.coordinates = {lo + (hi - lo) / 2};
        for (std::size_t i = 0; i < n && n > 1; ++i)
            axis.coordinates.push_back(i + 1 == n ? hi
                                                  : lo + (hi - lo) * (static_cast<double>(i) /
                                                                      static_cast<double>(n - 1)));
    }
    return std::make_shared<const timeseries::Grid>(std::move(axes));
}

timeseries::Field sample(const Function& function,
                         const std::shared_ptr<const timeseries::Grid>& grid, double t,
                         Precision precision) {
    timeseries::Field field{.grid = grid, .values = {}, .missing = {}};
    if (precision == Precision::F32)
        field.values = samples<float>(function, *grid, t);
    else
        field.values = samples<double>(function, *grid, t);
    return field;
}

AnalyticReader::AnalyticReader(std::vector<AnalyticVariable> variables,
                               std::shared_ptr<const timeseries::Grid> grid,
                               const std::vector<double>& times)
    : analytic_(std::move(variables)) {
    if (analytic_.empty() || times.empty())
        throw std::invalid_argument("an analytic series needs at least one variable and one time");
    auto time = std::make_shared<timeseries::TimeAxis>();
    time->name = "time";
    for (const double t : times) time->points.push_back({.value = t, .date = ""});
    for (const AnalyticVariable& v : analytic_) {
        timeseries::Variable variable;
        variable.name = v.name;
        variable.type =
            v.precision == Precision::F32 ? timeseries::ValueType::F32 : timeseries::ValueType::F64;
        variable.storedAs = "computed";
        variable.grid = grid;
        variable.time = time;
        variables_.push_back(std::move(variable));
    }
}

timeseries::Field AnalyticReader::read(std::size_t variable, std::size_t step) {
    const timeseries::Variable& v = variables_[variable];
    return sample(analytic_[variable].function, v.grid, v.time->points[step].value,
                  analytic_[variable].precision);
}

}  // namespace datasets
