// Meshes of the Model for Prediction Across Scales ("MPAS Mesh Specification", version 1.0), which
// are told by the names of their variables alone: cells about which vertices stand, and, dual to
// them, a triangle of cells about each vertex.
#pragma once

#include <optional>

#include "timeseries/readers/cf/cf_lists.h"
#include "timeseries/readers/cf/netcdf_header.h"

namespace timeseries {

bool isMpas(const NcHeader& header);
// Lies on that mesh's cells, vertices or edges.
bool isOnMpas(const NcHeader& header, const NcVariable& variable);
// Tells of the mesh itself, and is no data.
bool isOfMpasMesh(const NcHeader& header, const NcVariable& variable);

// Where its places and those about them stand, and along which of the variable's dimensions they
// are listed, and levels above them. Nothing for variables at edges.
struct MpasPlaces {
    ColumnPlaces places;
    std::size_t list;
    std::optional<std::size_t> levels;
};
std::optional<MpasPlaces> mpasPlacesOf(const NcHeader& header, const NcVariable& variable);

// The ocean's levels, or those between them, as depths or heights of all columns alike: by how deep
// the layers reach, or where their middles lie. Nothing where the file does not tell. REQUIRES:
// kMaxAxis levels at most. Throws FileError.
std::optional<Axis> mpasDepthsOf(const CfFile& file, const NcVariable& variable,
                                 std::size_t position);

}  // namespace timeseries
