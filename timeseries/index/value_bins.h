// Counting a field's values in bins that ascend by value, fine where many values are.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "timeseries/index/ordered_key.h"

namespace timeseries {

// A bin for each of the 2^16 prefixes of a key, and several for those that a sample of the field
// finds crowded: even ones between the sample's least and greatest key there.
template <typename T>
class ValueBins {
 public:
    using Key = OrderedKey<T>;

    // `sample`: keys of the field, which it is a fair share of, if the crowded prefixes are to be
    // found; `most`, in points of the sample, is when one is crowded. Sorts it.
    ValueBins(std::vector<Key> sample, std::size_t most) : prefixes_(kPrefixes) {
        std::sort(sample.begin(), sample.end());
        auto at = sample.begin();
        for (std::uint32_t prefix = 0; prefix < kPrefixes; ++prefix) {
            const auto first = at;
            while (at != sample.end() && prefixOf(*at) == prefix) ++at;
            const auto in = static_cast<std::size_t>(at - first);
            Prefix& p = prefixes_[prefix];
            p.first = count_;
            if (in > most) divide(p, *first, *(at - 1), kFiner * in / most);
            count_ += p.last + 1u;
        }
    }

    std::uint32_t count() const { return count_; }
    std::uint32_t operator()(Key key) const {
        const Prefix& p = prefixes_[prefixOf(key)];
        if (p.last == 0) return p.first;
        const Key beyond = key > p.least ? key - p.least : 0;
        return p.first + static_cast<std::uint32_t>(std::min<Key>(beyond >> p.shift, p.last));
    }
    static std::uint32_t prefixOf(Key key) { return static_cast<std::uint32_t>(key >> kRest); }
    // Something of each bin, by prefix, where its bins have the same; else kDivided.
    static constexpr std::uint32_t kDivided = ~std::uint32_t{0};
    std::vector<std::uint32_t> ofWholePrefixes(const std::vector<std::uint32_t>& ofBin) const {
        std::vector<std::uint32_t> of;
        of.reserve(kPrefixes);
        for (const Prefix& p : prefixes_)
            of.push_back(ofBin[p.first] == ofBin[p.first + p.last] ? ofBin[p.first] : kDivided);
        return of;
    }
    // The least key of each bin.
    std::vector<Key> leastKeys() const {
        std::vector<Key> keys;
        keys.reserve(count_);
        for (std::uint32_t prefix = 0; prefix < kPrefixes; ++prefix) {
            const Prefix& p = prefixes_[prefix];
            keys.push_back(static_cast<Key>(static_cast<Key>(prefix) << kRest));
            for (Key i = 1; i <= p.last; ++i) keys.push_back(p.least + (i << p.shift));
        }
        return keys;
    }

 private:
    static constexpr int kRest = 8 * sizeof(Key) - 16;
    static constexpr std::uint32_t kPrefixes = 1 << 16;
    static constexpr std::size_t kFiner = 8;  // bins for each of the buckets that they become
    struct Prefix {
        Key least = 0;  // from which on the bins are even: the first has also what is less
        std::uint32_t first = 0;  // bin
        std::uint16_t last = 0;   // of its bins, counted from the first
        std::uint8_t shift = 0;
    };

    // In at most so many bins.
    static void divide(Prefix& p, Key least, Key greatest, std::size_t bins) {
        const Key rest = (Key{1} << kRest) - 1;
        const auto most = static_cast<Key>(std::clamp<std::size_t>(bins, 2, 1 << 12));
        while (((greatest - least) >> p.shift) >= most) ++p.shift;
        // One more on either side of those of the sample: what is less or greater does not crowd
        // them, and of a value that is most of all alone a bin has nothing else.
        const Key width = Key{1} << p.shift;
        p.least = (least & rest) >= width ? least - width : least;
        p.last = static_cast<std::uint16_t>(((greatest - p.least) >> p.shift) + 1);
        // Bins beyond the prefix would begin where the next one's do.
        while (p.last > 0 && (((least | rest) - p.least) >> p.shift) < p.last) --p.last;
    }

    std::vector<Prefix> prefixes_;
    std::uint32_t count_ = 0;
};

}  // namespace timeseries
