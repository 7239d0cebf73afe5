// What the folders of an OpenFOAM case hold: times, their fields, and which mesh counts when.
// OpenFOAM, "User Guide", 2.1 "File structure of OpenFOAM cases". Names alone: no file is read.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace timeseries {

// Whether it is the folder of a case, its system/controlDict, or a file in it whose name ends in
// .foam or .OpenFOAM.
bool isFoamCase(const std::filesystem::path& path);

// The files of a mesh. Points and faces each are those of the latest time that has some.
struct FoamMeshFiles {
    std::filesystem::path points, faces, owner, neighbour;
    friend bool operator==(const FoamMeshFiles&, const FoamMeshFiles&) = default;
};

struct FoamTime {
    double value;      // to the nearest of what its folder is called
    std::string name;  // "1e-05"
};

struct FoamCase {
    std::filesystem::path folder;
    // Which together are the case: its own folder alone, or those of its processors.
    std::vector<std::filesystem::path> parts;
    std::vector<FoamTime> times;  // ascending; those in which there are fields
    std::map<std::string, std::vector<std::size_t>> fields;  // by name, at which of the times
    std::vector<std::string> notes;

    // What may be a field's file, of each part.
    std::vector<std::filesystem::path> filesOf(const std::string& field, std::size_t time) const;
    std::vector<FoamMeshFiles> meshAt(std::size_t time) const;

    // Of each part, ascending: the folders in which there are points, or faces.
    struct MeshFolder {
        double since;
        std::filesystem::path folder;
    };
    struct Meshes {
        std::vector<MeshFolder> points, faces;
    };
    std::vector<Meshes> meshes;
};

// REQUIRES: isFoamCase(). Throws FileError.
FoamCase foamCaseOf(const std::filesystem::path& path);

}  // namespace timeseries
