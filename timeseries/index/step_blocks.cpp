#include "timeseries/index/step_blocks.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "timeseries/grid/with_type.h"
#include "timeseries/index/id_codec.h"
#include "timeseries/index/ordered_key.h"
#include "timeseries/index/step_header.h"
#include "timeseries/index/value_sort.h"

namespace timeseries {
namespace {

// The keys of a block's points by value, and by their codes, which is how both are stored.
template <typename Key>
struct BlockKeys {
    std::vector<std::uint64_t> places;  // code << 32 | place in order of value
    std::vector<std::uint32_t> codes;
    std::vector<Key> ascending, byCode;

    template <typename T>
    void take(std::span<const T> values, std::span<const std::uint32_t> gridIndex,
              const BrickOrder& order) {
        const std::size_t n = values.size();
        places.resize(n);
        codes.resize(n);
        ascending.resize(n);
        byCode.resize(n);
        for (std::size_t i = 0; i < n; ++i)
            places[i] = std::uint64_t{order.code(gridIndex[i])} << 32 | i;
        sortPacked(std::span(places));
        std::ranges::transform(values, ascending.begin(),
                               [](T value) { return orderedKey(value); });
        for (std::size_t i = 0; i < n; ++i) {
            codes[i] = static_cast<std::uint32_t>(places[i] >> 32);
            byCode[i] = ascending[static_cast<std::uint32_t>(places[i])];
        }
    }
};

// The bits of a number that was one of the type.
std::uint64_t bitsOf(ValueType type, const Number& number) {
    return withType(type, [&]<typename T>(T) {
        const T value = std::visit([](auto held) { return static_cast<T>(held); }, number);
        std::uint64_t bits = 0;
        std::memcpy(&bits, &value, sizeof value);
        return bits;
    });
}

StepHeader headerOf(const StepFacts& facts, std::uint64_t blocks) {
    StepHeader header;
    const StepStatistics& s = facts.statistics;
    header.type = static_cast<std::uint32_t>(facts.type);
    header.blockPoints = kStepBlock;
    header.size = facts.size;
    header.points = s.points;
    header.missing = s.missing;
    header.blocks = blocks;
    header.extent[0] = bitsOf(facts.type, s.min);
    header.extent[1] = bitsOf(facts.type, s.max);
    header.anyFinite = !std::isnan(toDouble(s.finiteMin));
    if (header.anyFinite != 0) {
        header.extent[2] = bitsOf(facts.type, s.finiteMin);
        header.extent[3] = bitsOf(facts.type, s.finiteMax);
    }
    return header;
}

Bytes summaryOf(const StepFacts& facts) {
    Bytes out;
    append(out, std::uint64_t{facts.quantiles.size()});
    for (const double value : facts.quantiles) append(out, value);
    const auto text = std::as_bytes(std::span(facts.about));
    out.insert(out.end(), text.begin(), text.end());
    return out;
}

StepSection put(std::span<const std::byte> bytes, std::uint64_t& at, ByteSink& sink) {
    sink.write(at, bytes);
    const StepSection section{at, bytes.size(), sumOfBytes(bytes)};
    at += bytes.size();
    return section;
}

}  // namespace

template <typename T>
void encodeBlock(std::span<const T> values, std::span<const std::uint32_t> gridIndex,
                 const BrickOrder& order, EncodedBlock& out) {
    using Key = OrderedKey<T>;
    static thread_local BlockKeys<Key> keys;
    keys.take(values, gridIndex, order);
    out.ids.clear();
    out.keys.clear();
    encodeIds(keys.codes, out.ids);
    out.entry = {};
    out.entry.layout = encodeKeys<Key>(keys.byCode, keys.ascending, out.keys);
    out.entry.least = keys.ascending.front();
    out.entry.greatest = keys.ascending.back();
    out.entry.count = static_cast<std::uint32_t>(values.size());
    out.entry.idsBytes = static_cast<std::uint32_t>(out.ids.size());
    out.entry.keysBytes = static_cast<std::uint32_t>(out.keys.size());
    out.entry.idsSum = static_cast<std::uint32_t>(sumOfBytes(out.ids));
    out.entry.keysSum = static_cast<std::uint32_t>(sumOfBytes(out.keys));
}

std::uint64_t placeBlocks(std::span<StepBlock> blocks, std::uint64_t at) {
    for (std::size_t first = 0; first < blocks.size(); first += kBlocksTogether) {
        const auto group =
            blocks.subspan(first, std::min<std::size_t>(kBlocksTogether, blocks.size() - first));
        for (StepBlock& block : group) {
            block.idsAt = at;
            at += block.idsBytes;
        }
        for (StepBlock& block : group) {
            block.keysAt = at;
            at += block.keysBytes;
        }
    }
    return at;
}

std::vector<std::uint64_t> quantileRanks(const Run& among, std::size_t n) {
    std::vector<std::uint64_t> ranks;
    if (among.count == 0) return ranks;
    ranks.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double fraction = n == 1 ? 0.5 : static_cast<double>(i) / static_cast<double>(n - 1);
        const double rank = fraction * static_cast<double>(among.count - 1);
        ranks.push_back(among.first + static_cast<std::uint64_t>(std::llround(rank)));
    }
    return ranks;
}

void finishStep(const StepFacts& facts, std::span<const StepBlock> directory, std::uint64_t at,
                ByteSink& sink) {
    StepHeader header = headerOf(facts, directory.size());
    header.directory = put(std::as_bytes(directory), at, sink);
    header.summary = put(summaryOf(facts), at, sink);
    header.fileBytes = at;
    const auto bytes = std::as_bytes(std::span(&header, 1));
    header.sum = sumOfBytes(bytes.first(offsetof(StepHeader, sum)));
    Bytes page(kHeaderBytes);
    std::ranges::copy(bytes, page.begin());
    sink.write(0, page);
}

#define ISOCHRON_TYPE(T)                                                          \
    template void encodeBlock(std::span<const T>, std::span<const std::uint32_t>, \
                              const BrickOrder&, EncodedBlock&);
ISOCHRON_EACH_TYPE(ISOCHRON_TYPE)
#undef ISOCHRON_TYPE

}  // namespace timeseries
