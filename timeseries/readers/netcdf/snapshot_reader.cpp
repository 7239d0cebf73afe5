#include "timeseries/readers/netcdf/snapshot_reader.h"

#include <fmt/format.h>

#include <cmath>

#include "timeseries/readers/components.h"
#include "timeseries/readers/netcdf/snapshot_particles.h"

namespace timeseries {
namespace {

// An array of particles, or a number of each of its rows.
struct SnapshotSource {
    std::size_t particles;  // which of their types
    std::string array;
    Component component;
};

class SnapshotReader final : public Reader {
 public:
    explicit SnapshotReader(std::unique_ptr<NetcdfFile> opened)
        : paths_{opened->path()}, files_(std::move(opened)), types_(snapshotParticlesOf(files_)) {
        time_ = timeOf();
        for (std::size_t type = 0; type < types_.size(); ++type) add(type);
        if (variables_.empty())
            files_.at(0).fail("",
                              "expected an array of numbers beside the coordinates of particles, "
                              "found none");
    }

    std::string format() const override {
        const std::size_t count = files_.paths().size();
        return "particle snapshot (Gadget, SWIFT)" +
               (count > 1 ? fmt::format(" in {} files", count) : "");
    }
    // The one that was named; sources() are all of them.
    std::span<const std::filesystem::path> files() const override { return paths_; }
    std::span<const Variable> variables() const override { return variables_; }
    Field read(std::size_t variable, std::size_t) override {
        const SnapshotSource& source = sources_[variable];
        return {.grid = variables_[variable].grid,
                .values = componentOf(snapshotRowsOf(files_, types_[source.particles], source.array,
                                                     source.component.of),
                                      source.component),
                .missing = {}};
    }
    StepSources sources(std::size_t, std::size_t step) override {
        for (std::size_t i = 0; i < files_.paths().size(); ++i)
            if (files_.at(i).sources().empty()) return {};
        return {{files_.paths().begin(), files_.paths().end()}, step};
    }

 private:
    std::shared_ptr<const TimeAxis> timeOf() const;
    void add(std::size_t type);

    std::vector<std::filesystem::path> paths_;
    SnapshotFiles files_;
    std::vector<SnapshotParticles> types_;
    std::shared_ptr<const TimeAxis> time_;
    std::vector<Variable> variables_;
    std::vector<SnapshotSource> sources_;
};

// In the simulation's units, of which Gadget tells nothing; of the expanding universe the scale
// factor.
std::shared_ptr<const TimeAxis> SnapshotReader::timeOf() const {
    const auto time = files_.at(0).header().findGroup("Header")->numbers("Time");
    const bool told = !time.empty() && std::isfinite(time[0]);
    TimeAxis axis;
    axis.name = told ? "time" : "step";
    axis.points.push_back({told ? time[0] : 0, ""});
    axis.counted = !told;
    return std::make_shared<const TimeAxis>(std::move(axis));
}

void SnapshotReader::add(std::size_t type) {
    const SnapshotParticles& particles = types_[type];
    SnapshotMesh placed = snapshotMeshOf(files_, particles);
    for (std::string& note : notesOf(placed.mesh)) placed.notes.push_back(std::move(note));
    const auto grid = std::make_shared<const Grid>(
        spaceAxes(), std::make_shared<const Mesh>(std::move(placed.mesh)));
    for (const SnapshotArray& array : particles.arrays)
        for (const ComponentVariable& each : componentsOf(array.name, array.type, array.columns)) {
            Variable variable;
            variable.name = each.name;
            variable.longName = array.description;
            variable.units = array.units;
            variable.type = each.type;
            variable.storedAs = each.storedAs;
            variable.grid = grid;
            variable.time = time_;
            variable.notes = placed.notes;
            variables_.push_back(std::move(variable));
            sources_.push_back({type, array.name, each.component});
        }
}

}  // namespace

std::unique_ptr<Reader> openSnapshot(std::unique_ptr<NetcdfFile> file) {
    return std::make_unique<SnapshotReader>(std::move(file));
}

}  // namespace timeseries
