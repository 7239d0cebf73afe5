// Fields known in closed form: what tests, benchmarks and demos draw without a file, and can check
// against the formula. Everything is deterministic: the same on every run and every machine, up to
// the last bits of the machine's sin and cos.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "timeseries/grid/field.h"
#include "timeseries/grid/grid.h"
#include "timeseries/readers/reader.h"

namespace datasets {

// A scalar field: its value at a position and a time. The structs below are such functions.
using Function = std::function<double(const glm::dvec3& position, double t)>;

// The distance from a centre that goes round `middle` in the plane of x and y, once in `period`.
// Isosurfaces are spheres, and the gradient's length is 1.
struct SphereRamp {
    glm::dvec3 middle{0};
    double orbitRadius = 0;
    double period = 1;
    glm::dvec3 centre(double t) const;
    double operator()(const glm::dvec3& p, double t) const;
};

// slope . p - speed t: isosurfaces are planes, moving along the slope.
struct LinearRamp {
    glm::dvec3 slope{0, 0, 1};
    double speed = 0;
    double operator()(const glm::dvec3& p, double t) const;
};

// The test signal of Marschner & Lobb 1994, "An evaluation of reconstruction filters for volume
// rendering": made for the box -1 .. 1 in each axis; in [0, 1].
// The same at all times.
struct MarschnerLobb {
    double frequency = 6;  // f_M
    double alpha = 0.25;
    double operator()(const glm::dvec3& p, double t) const;
};

// The speed |u| of the Arnold-Beltrami-Childress flow (Dombre et al. 1986, "Chaotic streamlines in
// the ABC flows", J. Fluid Mech. 167), of period 2 pi in each axis. The pattern drifts by `drift` a
// unit of time in each axis. In [0, A + B + C].
struct AbcFlowSpeed {
    double A = 1.7320508075688772;  // sqrt 3
    double B = 1.4142135623730951;  // sqrt 2
    double C = 1;
    double drift = 0;
    glm::dvec3 velocity(const glm::dvec3& p, double t) const;
    double operator()(const glm::dvec3& p, double t) const;
};

// A frozen picture of turbulence: a sum of plane waves a cos(k . p + phase - omega t) in random
// directions (Kraichnan 1970, "Diffusion by a random velocity field"), whose energies follow
// Kolmogorov's spectrum E(k) ~ k^(-5/3) between two wave numbers. Wave numbers are evenly spaced in
// their logarithm, each wave standing for a shell as wide as k, so a ~ sqrt(k E) ~ k^(-1/3). Waves
// turn over as eddies of their size do, omega ~ k^(2/3). Mean 0, variance 1 over all space.
class Turbulence {
 public:
    struct Wave {
        glm::dvec3 k;  // radians per unit of length
        double amplitude, phase, omega;
    };
    struct Settings {
        std::uint64_t seed = 1996;
        std::size_t waves = 64;                      // >= 1
        double leastWaveNumber = 6.283185307179586;  // one wave a unit of length
        double greatestWaveNumber = 100;
        double turnover = 1;  // omega of the longest wave, radians per unit of time
    };
    Turbulence();
    explicit Turbulence(const Settings& settings);
    double operator()(const glm::dvec3& p, double t) const;
    std::span<const Wave> waves() const { return waves_; }

 private:
    std::vector<Wave> waves_;
};

struct Box {
    glm::dvec3 lo{-1}, hi{1};
};

// size[a] points along axis a, the first at lo and the last at hi; one point alone is in the
// middle. Point i of n and point m i of m (n - 1) + 1 are at the same place, bit for bit. Throws
// std::invalid_argument for a size of 0 and a box that is not lo < hi and finite.
std::shared_ptr<const timeseries::Grid> uniformGrid(const std::array<std::size_t, 3>& size,
                                                    const Box& box);

enum class Precision { F32, F64 };

// The function at every grid point; F32 values are the doubles rounded.
timeseries::Field sample(const Function& function,
                         const std::shared_ptr<const timeseries::Grid>& grid, double t,
                         Precision precision = Precision::F32);

struct AnalyticVariable {
    std::string name;
    Function function;
    Precision precision = Precision::F32;
};

// A series without a file: each step sampled when it is read.
class AnalyticReader : public timeseries::Reader {
 public:
    // Throws std::invalid_argument without variables or times.
    AnalyticReader(std::vector<AnalyticVariable> variables,
                   std::shared_ptr<const timeseries::Grid> grid, const std::vector<double>& times);

    std::string format() const override { return "analytic"; }
    std::span<const std::filesystem::path> files() const override { return {}; }
    std::span<const timeseries::Variable> variables() const override { return variables_; }
    timeseries::Field read(std::size_t variable, std::size_t step) override;

 private:
    std::vector<AnalyticVariable> analytic_;
    std::vector<timeseries::Variable> variables_;  // [analytic_.size()]
};

}  // namespace datasets
