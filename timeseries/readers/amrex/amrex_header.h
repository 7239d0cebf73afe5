// AMReX's plotfiles: folders with a text `Header` and, for each level, the values of all cells in
// files of "FABs". AMReX, "Plotfile format", Src/Base: AMReX_PlotFileUtil, AMReX_VisMF.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "timeseries/grid/lattice_levels.h"

namespace timeseries {

// Where the values of a box of cells are: all variables' one behind the other, x fastest, behind a
// line that says how (amrex_fab.h).
struct AmrexFab {
    std::size_t file = 0;  // in AmrexPlotfile::files
    std::uint64_t offset = 0;
};

struct AmrexLevel {
    std::array<std::int64_t, 3> ghosts{};  // cells beyond each box that its FAB has as well
    std::vector<AmrexFab> fabs;            // of the boxes of LatticeLevel
};

// Axes that there are not are one cell long, from 0 to 0.
struct AmrexPlotfile {
    std::filesystem::path folder;
    std::vector<std::string> names;  // of the variables
    std::size_t dimensions = 3;      // 2 or 3
    double time = 0;
    glm::dvec3 lo{0}, hi{0};                   // of the domain
    std::vector<LatticeLevel> lattice;         // without flaw
    std::vector<AmrexLevel> levels;            // of lattice
    std::vector<std::filesystem::path> texts;  // Header, and Cell_H of each level
    std::vector<std::filesystem::path> files;  // of values, all within the folder
    std::vector<std::string> others;           // what else is beside them: "Level_0/Nu_nd"
};

// Whether it is such a folder, or the Header of one.
bool isAmrex(const std::filesystem::path& path);
// The folder, without a slash at its end. REQUIRES: isAmrex().
std::filesystem::path amrexFolderOf(const std::filesystem::path& path);
// How many levels its Header says it has. REQUIRES: isAmrex(). Throws FileError.
std::size_t amrexLevelsOf(const std::filesystem::path& path);
// What its texts say, held against the sizes of its files; of Cartesian ones. REQUIRES: isAmrex().
// Throws FileError.
AmrexPlotfile readAmrexHeader(const std::filesystem::path& path);

}  // namespace timeseries
