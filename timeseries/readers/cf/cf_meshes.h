// The mesh of a variable whose columns tell where its points lie, at a step of a file.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "timeseries/readers/cf/cf_lists.h"

namespace timeseries {

class CfMeshes {
 public:
    // `file` is the one of that number in its series; `z`: the levels. Throws FileError, and
    // std::invalid_argument when the places make no mesh.
    std::shared_ptr<const Mesh> of(const CfFile& file, std::size_t number,
                                   const NcVariable& variable, const Roles& roles,
                                   const ColumnPlaces& columns, const Axis& z, std::size_t step);

 private:
    // Of columns in a list whose heights are their own: these may change, what lies below them
    // stays.
    struct Prisms {
        std::size_t number;
        ColumnPlaces places;
        std::shared_ptr<const Mesh> mesh;
    };
    const Mesh& prismsOf(const CfFile& file, std::size_t number, ColumnPlaces places);
    std::optional<Prisms> prisms_;
};

}  // namespace timeseries
