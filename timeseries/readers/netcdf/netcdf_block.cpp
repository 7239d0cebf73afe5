#include "timeseries/readers/netcdf/netcdf_block.h"

#include <array>

namespace timeseries {

NetcdfBlock blockOf(const FileVariable& variable, std::size_t step, const Slab* slab) {
    NetcdfBlock block;
    const std::size_t rank = variable.lengths.size();
    block.start.assign(rank, 0);
    block.count.assign(variable.lengths.begin(), variable.lengths.end());
    if (variable.roles.t) {
        block.start[*variable.roles.t] = step;
        block.count[*variable.roles.t] = 1;
    }
    for (const auto& [position, place] : variable.at) {
        block.start[position] = place;
        block.count[position] = 1;
    }
    const std::array positions{variable.roles.x, variable.roles.y, variable.roles.z};
    if (slab && positions[slab->axis]) {
        block.start[*positions[slab->axis]] = slab->first;
        block.count[*positions[slab->axis]] = slab->count;
    }
    std::size_t stride = 1;
    for (std::size_t i = rank; i-- > 0;) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (positions[axis] == i) {
                block.layout.size[axis] = block.count[i];
                block.layout.stride[axis] = stride;
            }
        stride *= block.count[i];
    }
    return block;
}

}  // namespace timeseries
