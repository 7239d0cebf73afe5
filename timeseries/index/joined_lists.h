// Two sorted lists as the one that they make, of which any stretch is merged where it is wanted.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>

namespace timeseries {

// Ascending lists of which no two elements are equal; they must outlive this. Where the two are cut
// is found as by Odeh et al., "Merge Path" (2012).
template <typename Point>
class JoinedLists {
 public:
    JoinedLists() = default;
    JoinedLists(std::span<const Point> a, std::span<const Point> b) : a_(a), b_(b) {}

    std::uint64_t size() const { return a_.size() + b_.size(); }
    // REQUIRES: there is such a place.
    Point operator[](std::uint64_t place) const {
        Point point;
        copy(place, {&point, 1});
        return point;
    }
    std::uint64_t countBelow(const Point& point) const {
        const auto below = [&](std::span<const Point> list) {
            return std::ranges::lower_bound(list, point, std::less{}) - list.begin();
        };
        return static_cast<std::uint64_t>(below(a_) + below(b_));
    }
    // Those from this place on. REQUIRES: there are so many.
    void copy(std::uint64_t first, std::span<Point> to) const {
        std::uint64_t i = countOfFirst(first), j = first - i;
        std::size_t k = 0;
        while (k < to.size() && i < a_.size() && j < b_.size()) {
            const bool isB = b_[j] < a_[i];
            to[k++] = isB ? b_[j] : a_[i];
            j += isB;
            i += !isB;
        }
        const auto rest = i < a_.size() ? a_.subspan(i) : b_.subspan(j);
        std::ranges::copy(rest.first(to.size() - k), to.begin() + static_cast<std::ptrdiff_t>(k));
    }

 private:
    // Of the first so many points of the joined list, how many are a's.
    std::uint64_t countOfFirst(std::uint64_t points) const {
        std::uint64_t least = points - std::min<std::uint64_t>(points, b_.size()),
                      most = std::min<std::uint64_t>(points, a_.size());
        while (least < most) {
            const std::uint64_t i = least + (most - least) / 2;
            if (a_[i] < b_[points - i - 1])
                least = i + 1;
            else
                most = i;
        }
        return least;
    }

    std::span<const Point> a_, b_;
};

}  // namespace timeseries
