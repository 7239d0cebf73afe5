#include "timeseries/grid/index_boxes.h"

#include <algorithm>
#include <numeric>

namespace timeseries {

bool IndexBox::isEmpty() const {
    return first[0] > last[0] || first[1] > last[1] || first[2] > last[2];
}

bool IndexBox::holds(const IndexBox& other) const { return common(*this, other) == other; }

std::array<std::uint64_t, 3> IndexBox::size() const {
    std::array<std::uint64_t, 3> size{};
    for (std::size_t a = 0; a < 3; ++a)
        size[a] = static_cast<std::uint64_t>(last[a] - first[a]) + 1;
    return size;
}

std::uint64_t IndexBox::count() const {
    constexpr std::uint64_t kMost = std::uint64_t{1} << 62;
    std::uint64_t count = 1;
    for (const std::uint64_t along : size()) count = along > kMost / count ? kMost : count * along;
    return count;
}

IndexBox common(const IndexBox& a, const IndexBox& b) {
    IndexBox box;
    for (std::size_t c = 0; c < 3; ++c) {
        box.first[c] = std::max(a.first[c], b.first[c]);
        box.last[c] = std::min(a.last[c], b.last[c]);
    }
    return box;
}

IndexBox around(const IndexBox& a, const IndexBox& b) {
    IndexBox box;
    for (std::size_t c = 0; c < 3; ++c) {
        box.first[c] = std::min(a.first[c], b.first[c]);
        box.last[c] = std::max(a.last[c], b.last[c]);
    }
    return box;
}

std::uint64_t IndexBox::placeOf(const std::array<std::int64_t, 3>& cell) const {
    const auto sides = size();
    const auto along = [&](std::size_t a) {
        return static_cast<std::uint64_t>(cell[a] - first[a]);
    };
    return (along(2) * sides[1] + along(1)) * sides[0] + along(0);
}

void cover(std::vector<bool>& covered, const IndexBox& box, const IndexBox& by) {
    const IndexBox part = common(box, by);
    if (part.isEmpty()) return;
    covered.resize(box.count());
    const auto at = [&](std::int64_t i, std::int64_t j, std::int64_t k) {
        return covered.begin() + static_cast<std::ptrdiff_t>(box.placeOf({i, j, k}));
    };
    for (std::int64_t k = part.first[2]; k <= part.last[2]; ++k)
        for (std::int64_t j = part.first[1]; j <= part.last[1]; ++j)
            std::fill(at(part.first[0], j, k), at(part.last[0], j, k) + 1, true);
}

IndexBoxes::IndexBoxes(std::span<const IndexBox> boxes) : boxes_(boxes), order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    if (!boxes.empty()) add(0, static_cast<std::uint32_t>(boxes.size()));
}

void IndexBoxes::add(std::uint32_t first, std::uint32_t count) {
    constexpr std::uint32_t kLeaf = 8;
    const auto begin = order_.begin() + first, end = begin + count;
    IndexBox bounds = boxes_[*begin];
    for (auto each = begin; each != end; ++each) bounds = around(bounds, boxes_[*each]);
    const std::size_t node = nodes_.size();
    nodes_.push_back({bounds, first, count});
    if (count <= kLeaf) return;
    const auto size = bounds.size();
    const auto axis = static_cast<std::size_t>(std::ranges::max_element(size) - size.begin());
    const std::uint32_t half = count / 2;
    std::nth_element(begin, begin + half, end, [&](std::uint32_t a, std::uint32_t b) {
        return boxes_[a].first[axis] + boxes_[a].last[axis] <
               boxes_[b].first[axis] + boxes_[b].last[axis];
    });
    add(first, half);
    nodes_[node].second = static_cast<std::uint32_t>(nodes_.size());
    add(first + half, count - half);
}

void IndexBoxes::forEachMeeting(const IndexBox& box,
                                const std::function<bool(std::size_t)>& use) const {
    std::vector<std::uint32_t> open;
    if (!nodes_.empty()) open.push_back(0);
    while (!open.empty()) {
        const std::uint32_t at = open.back();
        const Node& node = nodes_[at];
        open.pop_back();
        if (common(node.bounds, box).isEmpty()) continue;
        if (node.second != 0) {
            open.push_back(node.second);
            open.push_back(at + 1);
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
            if (!common(boxes_[order_[i]], box).isEmpty() && !use(order_[i])) return;
    }
}

}  // namespace timeseries
