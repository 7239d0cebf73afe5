#include "timeseries/readers/netcdf/snapshot_particles.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>

#include "timeseries/grid/scattered.h"
#include "timeseries/readers/limits.h"
#include "timeseries/readers/netcdf/netcdf_rows.h"

namespace timeseries {
namespace {

std::string_view baseNameOf(const SnapshotArray& array) {
    return std::string_view(array.name).substr(array.name.rfind('/') + 1);
}

// One number of each particle, under one of these names; null where there is none.
const SnapshotArray* scalarOf(const SnapshotParticles& particles,
                              std::initializer_list<std::string_view> names) {
    for (const SnapshotArray& array : particles.arrays)
        if (array.columns == 1 && std::ranges::find(names, baseNameOf(array)) != names.end())
            return &array;
    return nullptr;
}

std::vector<double> numbersOf(const SnapshotFiles& files, const SnapshotParticles& particles,
                              const SnapshotArray& array) {
    return asDoubles(snapshotRowsOf(files, particles, array.name, 1));
}

// Mass / density; none where the file does not say both.
std::vector<double> volumesOf(const SnapshotFiles& files, const SnapshotParticles& particles) {
    const SnapshotArray* const masses = scalarOf(particles, {"Masses", "Mass"});
    const SnapshotArray* const densities = scalarOf(particles, {"Densities", "Density"});
    if (!densities || (!masses && !(particles.mass > 0))) return {};
    std::vector<double> volumes = numbersOf(files, particles, *densities);
    if (!masses) {
        for (double& each : volumes) each = particles.mass / each;
        return volumes;
    }
    const std::vector<double> own = numbersOf(files, particles, *masses);
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
double deviationOf(const NcHeader& header, const SnapshotArray& lengths) {
    return baseNameOf(lengths) == "SmoothingLengths" || isSwift(header) ? 0.5 : std::sqrt(0.075);
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

// "a^-3 U_M U_L^-3" of SWIFT's "a^-3 U_M U_L^-3 [ g cm^-3 ]": what the numbers count, not what they
// would be in CGS.
std::string unitsOf(const NcVariable& array) {
    const std::string text = array.text("Expression for physical CGS units");
    const std::string units = text.substr(0, text.find('['));
    const std::size_t last = units.find_last_not_of(" -");
    return last == units.npos ? "" : units.substr(0, last + 1);
}

double numberOf(const std::vector<double>& numbers, std::size_t at) {
    return at < numbers.size() ? numbers[at] : 0;
}

// How many of a type are in a file; none of one whose places are not.
std::uint64_t countIn(const NetcdfFile& file, std::size_t type, const NcVariable* coordinates) {
    if (!coordinates || coordinates->dimensions.empty()) return 0;
    const auto said = file.header().findGroup("Header")->numbers("NumPart_ThisFile");
    const std::uint64_t count = file.header().dimension(*coordinates, 0).length;
    if (numberOf(said, type) != static_cast<double>(count))
        file.fail("Header", fmt::format("expected of NumPart_ThisFile the {} places of PartType{}, "
                                        "found {}",
                                        count, type, numberOf(said, type)));
    // What all files hold together is taken at once.
    const std::string why = count > kMaxPoints
                                ? fmt::format("expected at most 2^32 particles, found {}", count)
                                : file.tooLarge(*coordinates, 3 * count);
    if (!why.empty()) file.fail("variable '" + coordinates->name + "'", why);
    return count;
}

std::vector<SnapshotArray> arraysIn(const NetcdfFile& file, const std::string& group,
                                    std::uint64_t count, const NcVariable& coordinates) {
    std::vector<SnapshotArray> arrays;
    for (const NcVariable& array : file.header().variables) {
        const std::size_t rank = array.dimensions.size();
        if (array.group != group || !array.type || rank < 1 || rank > 2 || &array == &coordinates ||
            file.header().dimension(array, 0).length != count)
            continue;
        arrays.push_back({array.name, *array.type,
                          rank == 2 ? file.header().dimension(array, 1).length : 1,
                          array.text("Description"), unitsOf(array)});
    }
    return arrays;
}

// Adds the particles of a type in one of the files.
void addParticles(const SnapshotFiles& files, std::size_t index, std::size_t type,
                  SnapshotParticles& all) {
    const NetcdfFile& file = files.at(index);
    const NcVariable* const coordinates = file.header().find(all.name + "/Coordinates", "");
    const std::uint64_t count = countIn(file, type, coordinates);
    all.counts.push_back(count);
    if (count == 0) return;
    auto arrays = arraysIn(file, all.name, count, *coordinates);
    const double mass = numberOf(file.header().findGroup("Header")->numbers("MassTable"), type);
    if (all.count == 0) {
        all.arrays = std::move(arrays);
        all.mass = mass;
    } else {
        for (const SnapshotArray& each : all.arrays)
            if (std::ranges::find(arrays, each) == arrays.end())
                file.fail("variable '" + each.name + "'",
                          "expected it as in the snapshot's other files");
        if (mass != all.mass)
            file.fail("Header", fmt::format("expected a mass of {} for {} in MassTable, as in the "
                                            "snapshot's other files, found {}",
                                            all.mass, all.name, mass));
    }
    all.count += count;
    if (all.count > kMaxPoints)
        file.fail(all.name, "expected at most 2^32 particles in all files of the snapshot");
}

// Whether all files hold what the first says that there is, and say of what they are alike.
// `headers`: theirs.
void expectOneSnapshot(const SnapshotFiles& files, std::span<const NcGroup> headers,
                       const std::array<SnapshotParticles, kSnapshotTypes>& types) {
    const auto said = [&](const char* name) { return headers[0].numbers(name); };
    for (std::size_t type = 0; type < kSnapshotTypes; ++type) {
        // In 32 bits, and those above them (NumPart_Total_HighWord).
        const double total = numberOf(said("NumPart_Total"), type) +
                             4294967296.0 * numberOf(said("NumPart_Total_HighWord"), type);
        if (types[type].count > 0 && total != static_cast<double>(types[type].count))
            files.at(0).fail(
                "Header",
                fmt::format("expected of NumPart_Total the {} particles of {} in the "
                            "snapshot's {} files, found {}",
                            types[type].count, types[type].name, files.paths().size(), total));
    }
    for (std::size_t i = 1; i < headers.size(); ++i)
        for (const char* const name : {"NumFilesPerSnapshot", "Time"})
            if (headers[i].numbers(name) != said(name))
                files.at(i).fail("Header",
                                 fmt::format("expected the {} of {}, for they are of one snapshot",
                                             name, files.paths()[0].string()));
}

}  // namespace

std::vector<SnapshotParticles> snapshotParticlesOf(const SnapshotFiles& files) {
    std::array<SnapshotParticles, kSnapshotTypes> types;
    for (std::size_t type = 0; type < kSnapshotTypes; ++type)
        types[type].name = fmt::format("PartType{}", type);
    std::vector<NcGroup> headers;
    for (std::size_t i = 0; i < files.paths().size(); ++i) {
        const NetcdfFile& file = files.at(i);
        const NcGroup* const about = file.header().findGroup("Header");
        if (!about) file.fail("", "expected a snapshot of particles, with a group Header");
        headers.push_back(*about);  // one file stays open
        for (std::size_t type = 0; type < kSnapshotTypes; ++type)
            addParticles(files, i, type, types[type]);
    }
    if (files.paths().size() > 1) expectOneSnapshot(files, headers, types);
    std::vector<SnapshotParticles> present;
    for (SnapshotParticles& each : types)
        if (each.count > 0) present.push_back(std::move(each));
    return present;
}

Values snapshotRowsOf(const SnapshotFiles& files, const SnapshotParticles& particles,
                      const std::string& array, std::uint64_t columns) {
    std::optional<Values> all;
    for (std::size_t i = 0; i < files.paths().size(); ++i) {
        const std::uint64_t count = particles.counts[i];
        if (count == 0) continue;
        const NetcdfFile& file = files.at(i);
        const NcVariable* const found = file.header().find(array, "");
        if (!found) file.fail("variable '" + array + "'", "expected it, but the file has changed");
        Values part = rowsOf(file, *found, 0, count, columns);
        if (all && all->index() != part.index())
            file.fail("variable '" + array + "'", "expected its type as in the other files");
        if (!all) {
            all = std::move(part);
            if (count < particles.count)
                std::visit([&](auto& values) { values.reserve(particles.count * columns); }, *all);
            continue;
        }
        std::visit(
            [&]<typename T>(std::vector<T>& values) {
                const auto& more = std::get<std::vector<T>>(part);
                values.insert(values.end(), more.begin(), more.end());
            },
            *all);
    }
    return std::move(*all);
}

SnapshotMesh snapshotMeshOf(const SnapshotFiles& files, const SnapshotParticles& particles) {
    const auto at = placesOf(snapshotRowsOf(files, particles, particles.name + "/Coordinates", 3));
    const std::vector<double> volumes = volumesOf(files, particles);
    std::vector<std::string> notes;
    try {
        // Of a type that no simulation smoothes some write the arrays, full of zeros.
        if (std::ranges::none_of(volumes, isVolume)) return {meshOfScattered(at), notes};
        const SnapshotArray* const lengths =
            scalarOf(particles, {"SmoothingLengths", "SmoothingLength"});
        const double spread =
            lengths ? spreadOf(numbersOf(files, particles, *lengths),
                               deviationOf(files.at(0).header(), *lengths), volumes, notes)
                    : kScatteredSpread;
        return {meshOfVolumes(at, volumes, spread), notes};
    } catch (const std::invalid_argument& flaw) {
        files.at(0).fail(
            particles.name,
            fmt::format("expected particles that take space, found that {}", flaw.what()));
    }
}

}  // namespace timeseries
