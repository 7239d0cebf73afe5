#include "timeseries/readers/snapshot_particles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <string_view>

#include "timeseries/grid/scattered.h"
#include "timeseries/readers/netcdf_rows.h"

namespace timeseries {
namespace {

constexpr std::size_t kTypes = 7;

std::string typeGroup(std::size_t type) { return fmt::format("PartType{}", type); }

// One number of each particle, under one of these names; null where there is none.
const NcVariable* scalarOf(const SnapshotParticles& particles,
                           std::initializer_list<std::string_view> names) {
    for (const NcVariable* array : particles.arrays)
        if (array->dimensions.size() == 1 &&
            std::ranges::find(names, array->baseName()) != names.end())
            return array;
    return nullptr;
}

std::vector<double> numbersOf(const NetcdfFile& file, const SnapshotParticles& particles,
                              const NcVariable& array) {
    return asDoubles(rowsOf(file, array, 0, particles.count, 1));
}

// Mass / density; none where the file does not say both.
std::vector<double> volumesOf(const NetcdfFile& file, const SnapshotParticles& particles) {
    const NcVariable *const masses = scalarOf(particles, {"Masses", "Mass"}), *const densities =
                                                                                  scalarOf(
                                                                                      particles,
                                                                                      {"Densities",
                                                                                       "Density"});
    if (!densities || (!masses && !(particles.mass > 0))) return {};
    std::vector<double> volumes = numbersOf(file, particles, *densities);
    if (!masses) {
        for (double& each : volumes) each = particles.mass / each;
        return volumes;
    }
    const std::vector<double> own = numbersOf(file, particles, *masses);
    for (std::size_t i = 0; i < volumes.size(); ++i) volumes[i] = own[i] / volumes[i];
    return volumes;
}

bool isSwift(const NcHeader& header) {
    for (const char* name : {"Header", "Code"})
        if (const NcGroup* const group = header.findGroup(name))
            if (group->text("Code").starts_with("SWIFT")) return true;
    return false;
}

// The standard deviations of the kernel along a coordinate over the smoothing lengths of the file.
// Gadget's reach to where its cubic spline ends (Springel 2005, eq. 4), whose variance is 3 / 40 of
// their square. SWIFT's are twice the standard deviation, whatever the kernel (theory/SPH/Kernels;
// Dehnen & Aly 2012), and in the plural, but for those of its first years.
double deviationOf(const NcHeader& header, const NcVariable& lengths) {
    return lengths.baseName() == "SmoothingLengths" || isSwift(header) ? 0.5 : std::sqrt(0.075);
}

// Of a splat, in sides of its cell (render/model/footprint.h); its variance along a coordinate is a
// twelfth of that radius' square.
constexpr double kSplatRadius = 1.396;

bool isVolume(double volume) { return volume > 0 && std::isfinite(volume); }

// By smoothing lengths: how many times as wide as cubes of these volumes the splats are.
double spreadOf(const std::vector<double>& lengths, double deviation,
                const std::vector<double>& volumes, std::vector<std::string>& notes) {
    // Beyond these a kernel holds no particle but its own, or thousands.
    constexpr double kLeast = 0.5, kMost = 8, kBeside = 0.1;
    std::vector<double> ratios;
    for (std::size_t i = 0; i < volumes.size(); ++i) {
        const double side = std::sqrt(12.0) / kSplatRadius * deviation * lengths[i];
        const double ratio = side / std::cbrt(volumes[i]);
        if (isVolume(volumes[i]) && std::isfinite(ratio)) ratios.push_back(ratio);
    }
    if (ratios.empty()) return kScatteredSpread;
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::ranges::nth_element(ratios, middle);
    const double median = *middle;
    if (!(median >= kLeast && median <= kMost)) {
        notes.push_back(
            fmt::format("its smoothing lengths are not used: their kernels are {:.3g} "
                        "times as wide as mass / density tells",
                        median));
        return kScatteredSpread;
    }
    const auto beside = std::ranges::count_if(
        ratios, [&](double ratio) { return std::abs(ratio - median) > kBeside * median; });
    if (beside > 0)
        notes.push_back(
            fmt::format("splats are {:.3g} (mass / density)^(1/3) wide, by the median "
                        "smoothing length: those of {} of {} particles are more than "
                        "10 % longer or shorter",
                        median, beside, ratios.size()));
    return median;
}

}  // namespace

bool isSnapshot(const NcHeader& header) {
    const NcGroup* const group = header.findGroup("Header");
    if (!group || !group->find("NumPart_ThisFile")) return false;
    for (std::size_t type = 0; type < kTypes; ++type)
        if (header.find(typeGroup(type) + "/Coordinates", "")) return true;
    return false;
}

std::vector<SnapshotParticles> snapshotParticlesOf(const NetcdfFile& file) {
    const NcHeader& header = file.header();
    const NcGroup& about = *header.findGroup("Header");
    const auto parts = about.numbers("NumFilesPerSnapshot"),
               counts = about.numbers("NumPart_ThisFile"), masses = about.numbers("MassTable");
    if (!parts.empty() && parts[0] > 1)
        file.fail("Header", fmt::format("expected a snapshot in one file, found one of {} files, "
                                        "which are not read together",
                                        parts[0]));
    std::vector<SnapshotParticles> types;
    for (std::size_t type = 0; type < kTypes; ++type) {
        SnapshotParticles particles;
        particles.name = typeGroup(type);
        particles.coordinates = header.find(particles.name + "/Coordinates", "");
        if (!particles.coordinates || particles.coordinates->dimensions.empty()) continue;
        particles.count = header.dimension(*particles.coordinates, 0).length;
        if (type >= counts.size() || counts[type] != static_cast<double>(particles.count))
            file.fail("Header",
                      fmt::format("expected of NumPart_ThisFile the {} places of {}, found {}",
                                  particles.count, particles.name,
                                  type < counts.size() ? counts[type] : 0));
        if (particles.count == 0) continue;
        if (type < masses.size()) particles.mass = masses[type];
        for (const NcVariable& array : header.variables) {
            const std::size_t rank = array.dimensions.size();
            if (array.group == particles.name && array.type && rank >= 1 && rank <= 2 &&
                &array != particles.coordinates &&
                header.dimension(array, 0).length == particles.count)
                particles.arrays.push_back(&array);
        }
        types.push_back(std::move(particles));
    }
    return types;
}

SnapshotMesh snapshotMeshOf(const NetcdfFile& file, const SnapshotParticles& particles) {
    const auto at = placesOf(file, *particles.coordinates, 0, particles.count);
    const std::vector<double> volumes = volumesOf(file, particles);
    std::vector<std::string> notes;
    try {
        // Of a type that no simulation smoothes some write the arrays, full of zeros.
        if (std::ranges::none_of(volumes, isVolume)) return {meshOfScattered(at), notes};
        const NcVariable* const lengths =
            scalarOf(particles, {"SmoothingLengths", "SmoothingLength"});
        const double spread = lengths
                                  ? spreadOf(numbersOf(file, particles, *lengths),
                                             deviationOf(file.header(), *lengths), volumes, notes)
                                  : kScatteredSpread;
        return {meshOfVolumes(at, volumes, spread), notes};
    } catch (const std::invalid_argument& flaw) {
        file.fail(particles.name,
                  fmt::format("expected particles that take space, found that {}", flaw.what()));
    }
}

}  // namespace timeseries
