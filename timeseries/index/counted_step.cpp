// Steps of one or two bytes a value written from their fields: how often each value is there tells
// where its points stand in the list, so that any stretch of it can be made alone.
#include <algorithm>
#include <array>

#include "timeseries/grid/pages.h"
#include "timeseries/grid/with_type.h"
#include "timeseries/index/ordered_key.h"
#include "timeseries/index/step_blocks.h"

namespace timeseries {
namespace {

template <typename T>
class CountedList {
 public:
    // Of so many points at once, whole blocks. The field must outlive this.
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

    // What encode() takes next: from this place on.
    void find(std::uint64_t place) {
        if (found_ > 0 && place >= first_ && place < first_ + found_) return;
        first_ = place;
        found_ = std::min(atOnce_, points() - first_);
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

template <typename T>
bool write(const Field& field, const std::string& about, ByteSink& sink,
           const std::function<bool(double)>& goOn, unsigned threads, std::uint64_t atOnce) {
    CountedList<T> list(field, atOnce, threads);
    StepFacts facts{field.type(), sizeOf(*field.grid), {}, {}, about};
    const BrickOrder order(facts.size);
    const auto blocks = writeBlocks(
        list.points(), [&](const Run& points) { list.find(points.first); },
        [&](std::uint64_t block, EncodedBlock& out) { list.encode(block, order, out); }, sink, goOn,
        threads);
    if (!blocks) return false;
    const Number least = numberOf(list.at(0)), greatest = numberOf(list.at(list.points() - 1));
    facts.statistics = {list.points(), field.grid->count() - list.points(), least, greatest, least,
                        greatest};
    for (const std::uint64_t place : quantileRanks({0, list.points()}, kStepQuantiles))
        facts.quantiles.push_back(toDouble(numberOf(list.at(place))));
    finishStep(facts, blocks->directory, blocks->end, sink);
    return true;
}

}  // namespace

bool canBeCounted(ValueType type) {
    return withType(type, []<typename T>(T) { return sizeof(T) <= 2; });
}

bool writeCounted(const Field& field, const std::string& about, ByteSink& sink,
                  const std::function<bool(double)>& goOn, unsigned threads, std::uint64_t atOnce) {
    constexpr std::uint64_t kTogether = kBlocksTogether * kStepBlock, kParts = 8;
    if (atOnce == 0) atOnce = field.grid->count() / kParts;
    atOnce = (atOnce / kTogether + 1) * kTogether;
    return withType(field.type(), [&]<typename T>(T) {
        if constexpr (sizeof(T) <= 2)
            return write<T>(field, about, sink, goOn, threads, atOnce);
        else
            return false;
    });
}

}  // namespace timeseries
