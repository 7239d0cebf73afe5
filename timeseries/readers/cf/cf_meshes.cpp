#include "timeseries/readers/cf/cf_meshes.h"

#include <utility>
#include <vector>

#include "timeseries/grid/raised.h"

namespace timeseries {

const Mesh& CfMeshes::prismsOf(const CfFile& file, std::size_t number, ColumnPlaces places) {
    places.heights.reset();
    places.inTime = false;
    if (!prisms_ || prisms_->number != number || prisms_->places != places) {
        auto mesh = meshOfList(file, places, {0, 1});
        prisms_ = {number, std::move(places), std::move(mesh)};
    }
    return *prisms_->mesh;
}

std::shared_ptr<const Mesh> CfMeshes::of(const CfFile& file, std::size_t number,
                                         const NcVariable& variable, const Roles& roles,
                                         const ColumnPlaces& columns, const Axis& z,
                                         std::size_t step) {
    if (columns.by == ColumnPlaces::By::Neighbours)
        return meshOf(file, variable, roles, columns, z, step);
    if (columns.heights)
        return std::make_shared<const Mesh>(
            raised(prismsOf(file, number, columns),
                   heightsOf(file, variable, roles, *columns.heights, step)));
    return meshOfList(file, columns, roles.z ? z.coordinates : std::vector<double>());
}

}  // namespace timeseries
