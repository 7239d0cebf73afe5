// The list of a field of one or two bytes a value: how often each value is there tells where its
// points stand, so that any stretch of it can be found alone.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "timeseries/grid/field.h"
#include "timeseries/grid/pages.h"
#include "timeseries/index/ordered_key.h"
#include "timeseries/index/step_blocks.h"
#include "timeseries/together.h"

namespace timeseries {

template <typename T>
class CountedList {
 public:
    // REQUIRES: a point; `atOnce`, of which so many are found, are whole blocks; the field outlives
    // this.
    CountedList(const Field& field, std::uint64_t atOnce, unsigned threads)
        : values_(std::get<std::vector<T>>(field.values)),
          missing_(field.missing),
          before_(threadsFor(values_.size(), 1 << 16, threads)),
          begins_(kKeys + 1),
          atOnce_(atOnce) {
        const auto parts = static_cast<unsigned>(before_.size());
        sharing(parts, [&](unsigned part) {
            std::vector<std::uint64_t> counts(kKeys);
            forEach(part, [&](std::uint32_t, Key key) { ++counts[key]; });
            before_[part] = std::move(counts);
        });
        std::uint64_t place = 0;
        for (std::size_t key = 0; key < kKeys; ++key) {
            begins_[key] = place;
            for (auto& before : before_) place += std::exchange(before[key], place - begins_[key]);
        }
        begins_[kKeys] = place;
        gridIndex_ = Pages<std::uint32_t>(std::min(atOnce_, points()));
    }

    std::uint64_t points() const { return begins_.back(); }
    T at(std::uint64_t place) const { return valueOfKey<T>(static_cast<Key>(keyAt(place))); }

    StepStatistics statistics() const {
        const Number least = numberOf(at(0)), greatest = numberOf(at(points() - 1));
        return {points(), values_.size() - points(), least, greatest, least, greatest};
    }
    Run finite() const { return {0, points()}; }
    // What encode() takes next: whole blocks that end with one of those at once, or the list.
    void find(const Run& points) {
        if (found_ > 0 && points.first >= first_ && points.first < first_ + found_) return;
        first_ = points.first;
        found_ = std::min(atOnce_, this->points() - first_);
        const std::size_t least = keyAt(first_), keys = keyAt(first_ + found_ - 1) - least + 1;
        sharing(static_cast<unsigned>(before_.size()), [&](unsigned part) {
            std::vector<std::uint64_t> next(keys);  // less than the first: far beyond the last
            for (std::size_t k = 0; k < keys; ++k)
                next[k] = begins_[least + k] + before_[part][least + k] - first_;
            forEach(part, [&](std::uint32_t index, Key key) {
                const std::size_t k = key - least;
                if (k >= keys) return;
                const std::uint64_t to = next[k]++;
                if (to < found_) gridIndex_.data()[to] = index;
            });
        });
    }
    // REQUIRES: found.
    void encode(std::uint64_t block, const BrickOrder& order, EncodedBlock& out) const {
        const std::uint64_t first = block * kStepBlock;
        const std::size_t count = std::min(kStepBlock, points() - first);
        std::vector<T> values(count);
        for (std::size_t i = 0; i < count;) {
            const std::size_t key = keyAt(first + i),
                              end = std::min(count, begins_[key + 1] - first);
            std::fill(values.begin() + static_cast<std::ptrdiff_t>(i),
                      values.begin() + static_cast<std::ptrdiff_t>(end),
                      valueOfKey<T>(static_cast<Key>(key)));
            i = end;
        }
        encodeBlock<T>(values, {gridIndex_.data() + (first - first_), count}, order, out);
    }

 private:
    using Key = OrderedKey<T>;
    static constexpr std::size_t kKeys = std::size_t{1} << 8 * sizeof(T);

    std::size_t keyAt(std::uint64_t place) const {
        return static_cast<std::size_t>(std::ranges::upper_bound(begins_, place) -
                                        begins_.begin()) -
               1;
    }
    template <typename Use>
    void forEach(unsigned part, const Use& use) const {
        const std::size_t parts = before_.size(), last = values_.size() * (part + 1) / parts;
        for (std::size_t i = values_.size() * part / parts; i < last; ++i)
            if (missing_.empty() || !missing_[i])
                use(static_cast<std::uint32_t>(i), orderedKey(values_[i]));
    }

    std::span<const T> values_;
    const std::vector<bool>& missing_;
    // Of each part of the field, how many points of each key are in the parts before.
    std::vector<std::vector<std::uint64_t>> before_;
    std::vector<std::uint64_t> begins_;  // where a key's points do in the list
    std::uint64_t atOnce_, first_ = 0, found_ = 0;
    Pages<std::uint32_t> gridIndex_;
};

}  // namespace timeseries
