// Files that keep all in groups of HDF5, damaged: VTKHDF, openPMD, snapshots of particles.
#include <gtest/gtest.h>

#include "tests/support/damage.h"
#include "tests/support/openpmd_file.h"

namespace timeseries {
namespace {

using Numbers = std::vector<std::int64_t>;

// What of them crashes the library is met in the copy of the process that tries a header first.
void expectReadOrRefused(const std::filesystem::path& path) {
    tests::damageInRounds(path, path, 30);
}

TEST(DamagedHdf, UnstructuredGridsOfSeveralStepsAreReadOrRefused) {
    tests::HdfFile file("file.vtkhdf");
    // A tetrahedron, and one beside it that the second step has, too.
    file.put("VTKHDF/Points", std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}, 3);
    file.put("VTKHDF/Connectivity", Numbers{0, 1, 2, 3, 0, 1, 2, 3, 1, 2, 3, 4});
    file.put("VTKHDF/Offsets", Numbers{0, 4, 0, 4, 8});
    file.put("VTKHDF/Types", std::vector<std::uint8_t>{10, 10, 10});
    file.put("VTKHDF/NumberOfPoints", Numbers{5, 5});
    file.put("VTKHDF/NumberOfCells", Numbers{1, 2});
    file.put("VTKHDF/NumberOfConnectivityIds", Numbers{4, 8});
    file.put("VTKHDF/PointData/p", std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
    file.put("VTKHDF/Steps/Values", std::vector<double>{0, 1});
    file.put("VTKHDF/Steps/PartOffsets", Numbers{0, 1});
    file.put("VTKHDF/Steps/NumberOfParts", Numbers{1, 1});
    file.put("VTKHDF/Steps/PointOffsets", Numbers{0, 0});
    file.put("VTKHDF/Steps/CellOffsets", Numbers{0, 1});
    file.put("VTKHDF/Steps/ConnectivityIdOffsets", Numbers{0, 4});
    file.put("VTKHDF/Steps/PointDataOffsets/p", Numbers{0, 5});
    file.say("VTKHDF", "Type", std::string("UnstructuredGrid"));
    file.say("VTKHDF", "Version", Numbers{1, 0});
    file.say("VTKHDF/Steps", "NSteps", Numbers{2});
    expectReadOrRefused(file.close());
}

TEST(DamagedHdf, OpenPmdIsReadOrRefused) {
    tests::OpenPmdFile file;
    file.iteration(0, 0);
    file.mesh("data/0/fields/rho");
    for (int c = 0; c < 3; ++c) {
        const std::string axis(1, "xyz"[c]);
        file.put("data/0/particles/e/position/" + axis, std::vector<double>{0, 1.0 * c, 2});
        file.constant("data/0/particles/e/positionOffset/" + axis, 0.0, {3});
    }
    file.put("data/0/particles/e/weighting", std::vector<float>{1, 2, 3});
    expectReadOrRefused(file.close());
}

TEST(DamagedHdf, SnapshotsOfParticlesAreReadOrRefused) {
    tests::HdfFile file("snap_000.hdf5");
    file.say("Header", "Time", 2.5);
    file.say("Header", "BoxSize", 2.5);
    file.say("Header", "NumFilesPerSnapshot", std::vector<std::int32_t>{1});
    file.say("Header", "MassTable", std::vector<double>(6));
    file.say("Header", "NumPart_ThisFile", std::vector<std::uint32_t>{8, 0, 0, 0, 0, 0});
    std::vector<float> at;
    for (int i = 0; i < 8; ++i)
        for (const int c : {i & 1, i >> 1 & 1, i >> 2}) at.push_back(float(c));
    file.put("PartType0/Coordinates", at, 3);
    file.put("PartType0/Masses", std::vector<float>(8, 1));
    file.put("PartType0/Density", std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8});
    file.put("PartType0/SmoothingLength", std::vector<float>(8, 0.5f));
    expectReadOrRefused(file.close());
}

}  // namespace
}  // namespace timeseries
