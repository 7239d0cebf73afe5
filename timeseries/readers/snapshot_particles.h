// Snapshots of particles in HDF5 as Gadget and SWIFT write them: groups PartType0 to PartType6, of
// gas, dark matter, stars and others (Springel, "User guide for GADGET-2", 6.5; SWIFT's
// documentation, "Snapshots").
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "timeseries/grid/mesh.h"
#include "timeseries/readers/netcdf_file.h"

namespace timeseries {

bool isSnapshot(const NcHeader& header);

// The particles of a type, of which there is at least one.
struct SnapshotParticles {
    std::string name;  // "PartType0"
    std::uint64_t count = 0;
    double mass = 0;  // of each, from MassTable; 0: each has its own
    const NcVariable* coordinates = nullptr;
    std::vector<const NcVariable*> arrays;  // all others with a row a particle, in the file's order
};

// Throws FileError, also of one file of several that make a snapshot.
std::vector<SnapshotParticles> snapshotParticlesOf(const NetcdfFile& file);

struct SnapshotMesh {
    Mesh mesh;
    std::vector<std::string> notes;
};

// Each stands for mass / density where the file has both; else for what its neighbours leave it.
// Where it has smoothing lengths, too, splats are as wide as the kernel, by the standard deviation
// along a coordinate. A mesh has one spread, so
// that their width beside (mass / density)^(1/3), the same for all but for the tolerance of the
// simulation's own iteration, is the median's. Throws FileError.
SnapshotMesh snapshotMeshOf(const NetcdfFile& file, const SnapshotParticles& particles);

}  // namespace timeseries
