#include "timeseries/readers/snapshot_reader.h"

#include <cmath>

#include "timeseries/readers/components.h"
#include "timeseries/readers/netcdf_rows.h"
#include "timeseries/readers/snapshot_particles.h"

namespace timeseries {
namespace {

// An array of particles, or a number of each of its rows.
struct SnapshotSource {
    const NcVariable* array;
    std::uint64_t particles;
    Component component;
};

class SnapshotReader final : public Reader {
 public:
    explicit SnapshotReader(std::unique_ptr<NetcdfFile> opened)
        : paths_{opened->path()}, opened_(std::move(opened)), time_(timeOf()) {
        for (const SnapshotParticles& particles : snapshotParticlesOf(file_)) add(particles);
        if (variables_.empty())
            file_.fail("",
                       "expected an array of numbers beside the coordinates of particles, "
                       "found none");
    }

    std::string format() const override { return "particle snapshot (Gadget, SWIFT)"; }
    std::span<const std::filesystem::path> files() const override { return paths_; }
    std::span<const Variable> variables() const override { return variables_; }
    Field read(std::size_t variable, std::size_t) override {
        const SnapshotSource& source = sources_[variable];
        return {.grid = variables_[variable].grid,
                .values = componentOf(
                    rowsOf(file_, *source.array, 0, source.particles, source.component.of),
                    source.component),
                .missing = {}};
    }
    StepSources sources(std::size_t, std::size_t step) override { return {paths_, step}; }

 private:
    std::shared_ptr<const TimeAxis> timeOf() const;
    void add(const SnapshotParticles& particles);

    std::vector<std::filesystem::path> paths_;
    std::unique_ptr<NetcdfFile> opened_;
    const NetcdfFile& file_ = *opened_;
    std::shared_ptr<const TimeAxis> time_;
    std::vector<Variable> variables_;
    std::vector<SnapshotSource> sources_;
};

// In the simulation's units, of which Gadget tells nothing; of the expanding universe the scale
// factor.
std::shared_ptr<const TimeAxis> SnapshotReader::timeOf() const {
    const auto time = file_.header().findGroup("Header")->numbers("Time");
    const bool told = !time.empty() && std::isfinite(time[0]);
    TimeAxis axis;
    axis.name = told ? "time" : "step";
    axis.points.push_back({told ? time[0] : 0, ""});
    axis.counted = !told;
    return std::make_shared<const TimeAxis>(std::move(axis));
}

// "a^-3 U_M U_L^-3" of SWIFT's "a^-3 U_M U_L^-3 [ g cm^-3 ]": what the numbers count, not what they
// would be in CGS.
std::string unitsOf(const NcVariable& array) {
    const std::string text = array.text("Expression for physical CGS units");
    const std::string units = text.substr(0, text.find('['));
    const std::size_t last = units.find_last_not_of(" -");
    return last == units.npos ? "" : units.substr(0, last + 1);
}

void SnapshotReader::add(const SnapshotParticles& particles) {
    SnapshotMesh placed = snapshotMeshOf(file_, particles);
    for (std::string& note : notesOf(placed.mesh)) placed.notes.push_back(std::move(note));
    const auto grid = std::make_shared<const Grid>(
        spaceAxes(), std::make_shared<const Mesh>(std::move(placed.mesh)));
    for (const NcVariable* array : particles.arrays) {
        const std::uint64_t columns =
            array->dimensions.size() == 2 ? file_.header().dimension(*array, 1).length : 1;
        for (const ComponentVariable& each : componentsOf(array->name, *array->type, columns)) {
            Variable variable;
            variable.name = each.name;
            variable.longName = array->text("Description");
            variable.units = unitsOf(*array);
            variable.type = each.type;
            variable.storedAs = each.storedAs;
            variable.grid = grid;
            variable.time = time_;
            variable.notes = placed.notes;
            variables_.push_back(std::move(variable));
            sources_.push_back({array, particles.count, each.component});
        }
    }
}

}  // namespace

std::unique_ptr<Reader> openSnapshot(std::unique_ptr<NetcdfFile> file) {
    return std::make_unique<SnapshotReader>(std::move(file));
}

}  // namespace timeseries
