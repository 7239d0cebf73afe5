// Which pixels of some rows something was drawn on, to a segment of a row. Pure.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace render {

class TouchedPixels {
 public:
    // None, of so many rows of so many pixels.
    void begin(int width, int rows) {
        width_ = width;
        across_ = (width + kSegment - 1) / kSegment;
        segments_.assign(static_cast<std::size_t>(across_) * static_cast<std::size_t>(rows), 0);
    }
    // Pixels [first, last) of a row.
    void touch(int row, int first, int last) {
        if (first >= last) return;
        const auto at = segments_.begin() + std::ptrdiff_t{row} * across_;
        std::fill(at + first / kSegment, at + (last - 1) / kSegment + 1, std::uint8_t{1});
    }
    // use(first, last, touched) for pixels of a row, from its beginning to its end.
    template <typename Use>
    void forEachRun(int row, const Use& use) const {
        const std::uint8_t* const at = segments_.data() + std::ptrdiff_t{row} * across_;
        for (int first = 0, last = 0; first < across_; first = last) {
            while (last < across_ && at[last] == at[first]) ++last;
            use(first * kSegment, std::min(last * kSegment, width_), at[first] != 0);
        }
    }

 private:
    static constexpr int kSegment = 64;
    int width_ = 0, across_ = 0;
    std::vector<std::uint8_t> segments_;
};

}  // namespace render
