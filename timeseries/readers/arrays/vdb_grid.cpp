#include "timeseries/readers/arrays/vdb_grid.h"

#include <algorithm>

#include "timeseries/readers/limits.h"

namespace timeseries {

std::array<std::uint64_t, 3> VdbBox::size() const {
    std::array<std::uint64_t, 3> size{};
    for (std::size_t a = 0; a < 3; ++a)
        size[a] = static_cast<std::uint64_t>(
            std::max(std::int64_t{last[a]} - std::int64_t{first[a]} + 1, std::int64_t{0}));
    return size;
}

std::optional<std::uint64_t> VdbBox::count() const {
    std::uint64_t count = 1;
    for (const std::uint64_t side : size()) {
        if (side == 0 || side > kMaxAxis || count > kMaxPoints / side) return std::nullopt;
        count *= side;
    }
    return count;
}

void VdbBox::add(const VdbBox& other) {
    for (std::size_t a = 0; a < 3; ++a) {
        first[a] = std::min(first[a], other.first[a]);
        last[a] = std::max(last[a], other.last[a]);
    }
}

}  // namespace timeseries
