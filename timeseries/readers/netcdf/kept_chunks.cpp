#include "timeseries/readers/netcdf/kept_chunks.h"

#include <netcdf.h>

#include <vector>

#include "timeseries/readers/limits.h"

namespace timeseries {

void keepChunks(const NcVariable& variable, std::span<const std::size_t> start,
                std::span<const std::size_t> count) {
    constexpr double kSlotsAChunk = 10;  // few of which meet in a slot
    std::vector<std::size_t> chunk(count.size());
    int storage = NC_CONTIGUOUS;
    if (variable.chunkBytes == 0 ||
        nc_inq_var_chunking(variable.groupId, variable.id, &storage, chunk.data()) != NC_NOERR)
        return;
    double chunks = 1;
    bool haveMore = false;
    for (std::size_t d = 0; d < count.size(); ++d) {
        if (count[d] == 0 || chunk[d] == 0) return;
        haveMore = haveMore || count[d] < chunk[d];
        const std::size_t first = start[d] / chunk[d], last = (start[d] + count[d] - 1) / chunk[d];
        chunks *= static_cast<double>(last - first + 1);
    }
    const double bytes = chunks * static_cast<double>(variable.chunkBytes);
    std::size_t kept = 0, slots = 0;
    float preemption = 0;
    if (!haveMore || bytes > kMaxKeptChunks ||
        nc_get_var_chunk_cache(variable.groupId, variable.id, &kept, &slots, &preemption) !=
            NC_NOERR ||
        static_cast<double>(kept) >= bytes)
        return;
    // Without it all is read as well, but slowly.
    nc_set_var_chunk_cache(variable.groupId, variable.id, static_cast<std::size_t>(bytes),
                           static_cast<std::size_t>(kSlotsAChunk * chunks) + 1, preemption);
}

}  // namespace timeseries
