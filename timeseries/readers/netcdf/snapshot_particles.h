// Snapshots of particles in HDF5 as Gadget and SWIFT write them: groups PartType0 to PartType6, of
// gas, dark matter, stars and others (Springel, "User guide for GADGET-2", 6.5; SWIFT's
// documentation, "Snapshots").
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "timeseries/grid/mesh.h"
#include "timeseries/readers/netcdf/snapshot_files.h"

namespace timeseries {

// Rows of numbers, one a particle.
struct SnapshotArray {
    std::string name;  // "PartType0/Density"
    ValueType type;
    std::uint64_t columns;
    std::string description, units;
    bool operator==(const SnapshotArray&) const = default;
};

// The particles of a type, of which there is at least one.
struct SnapshotParticles {
    std::string name;                   // "PartType0"
    std::vector<std::uint64_t> counts;  // in each file
    std::uint64_t count = 0;            // in all of them
    double mass = 0;                    // of each, from MassTable; 0: each has its own
    std::vector<SnapshotArray> arrays;  // but the coordinates, in the order of the first file
};

// Throws FileError, also where the files are not of one snapshot.
std::vector<SnapshotParticles> snapshotParticlesOf(const SnapshotFiles& files);

// Those of all files, one behind the other. Throws FileError.
Values snapshotRowsOf(const SnapshotFiles& files, const SnapshotParticles& particles,
                      const std::string& array, std::uint64_t columns);

struct SnapshotMesh {
    Mesh mesh;
    std::vector<std::string> notes;
};

// Each stands for mass / density where the file has both; else for what its neighbours leave it.
// Where it has smoothing lengths, too, splats are as wide as the kernel, by the standard deviation
// along a coordinate. A mesh has one spread, so
// that their width beside (mass / density)^(1/3), the same for all but for the tolerance of the
// simulation's own iteration, is the median's. Throws FileError.
SnapshotMesh snapshotMeshOf(const SnapshotFiles& files, const SnapshotParticles& particles);

}  // namespace timeseries
