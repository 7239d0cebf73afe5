#include <xxhash.h>

#include <algorithm>
#include <atomic>
#include <limits>

#include "timeseries/grid/with_type.h"
#include "timeseries/index/id_codec.h"
#include "timeseries/index/ordered_key.h"
#include "timeseries/index/step_file.h"
#include "timeseries/index/step_header.h"
#include "timeseries/index/value_sort.h"

namespace timeseries {
namespace {

// So many blocks have their ids together, and their keys behind them: few are in memory at once.
constexpr std::uint64_t kBlocksTogether = 256;

struct EncodedBlock {
    Bytes ids, keys;
    StepBlock entry;
};

// In the order of their codes, which is how ids are stored: codes and the keys that go with them.
template <typename Key>
struct InBrickOrder {
    std::vector<std::uint32_t> codes;
    std::vector<Key> keys;
};

template <typename T>
InBrickOrder<OrderedKey<T>> inBrickOrder(std::span<const T> values,
                                         std::span<const std::uint32_t> gridIndex,
                                         const BrickOrder& order) {
    const std::size_t n = values.size();
    std::vector<std::uint64_t> places(n);  // code << 32 | place in order of value
    for (std::size_t i = 0; i < n; ++i)
        places[i] = std::uint64_t{order.code(gridIndex[i])} << 32 | i;
    sortPacked(std::span(places));
    InBrickOrder<OrderedKey<T>> out{std::vector<std::uint32_t>(n), std::vector<OrderedKey<T>>(n)};
    for (std::size_t i = 0; i < n; ++i) {
        out.codes[i] = static_cast<std::uint32_t>(places[i] >> 32);
        out.keys[i] = orderedKey(values[static_cast<std::uint32_t>(places[i])]);
    }
    return out;
}

std::uint32_t shortSum(const Bytes& bytes) {
    return static_cast<std::uint32_t>(XXH3_64bits(bytes.data(), bytes.size()));
}

template <typename T>
EncodedBlock encode(std::span<const T> values, std::span<const std::uint32_t> gridIndex,
                    const BrickOrder& order) {
    using Key = OrderedKey<T>;
    EncodedBlock out;
    const auto brick = inBrickOrder(values, gridIndex, order);
    std::vector<Key> ascending(values.size());
    std::ranges::transform(values, ascending.begin(), [](T value) { return orderedKey(value); });
    encodeIds(brick.codes, out.ids);
    out.entry.layout = encodeKeys<Key>(brick.keys, ascending, out.keys);
    out.entry.least = ascending.front();
    out.entry.greatest = ascending.back();
    out.entry.count = static_cast<std::uint32_t>(values.size());
    out.entry.idsBytes = static_cast<std::uint32_t>(out.ids.size());
    out.entry.keysBytes = static_cast<std::uint32_t>(out.keys.size());
    out.entry.idsSum = shortSum(out.ids);
    out.entry.keysSum = shortSum(out.keys);
    return out;
}

// The bits of a number that was one of the type.
std::uint64_t bitsOf(ValueType type, const Number& number) {
    return withType(type, [&]<typename T>(T) {
        const T value = std::visit([](auto held) { return static_cast<T>(held); }, number);
        std::uint64_t bits = 0;
        std::memcpy(&bits, &value, sizeof value);
        return bits;
    });
}

StepHeader headerOf(const SortedStep& step, std::span<const std::uint32_t, 3> size,
                    std::uint64_t blocks) {
    StepHeader header;
    const StepStatistics& s = step.statistics();
    header.type = static_cast<std::uint32_t>(step.type());
    header.blockPoints = kStepBlock;
    std::ranges::copy(size, header.size.begin());
    header.points = s.points;
    header.missing = s.missing;
    header.blocks = blocks;
    header.extent[0] = bitsOf(step.type(), s.min);
    header.extent[1] = bitsOf(step.type(), s.max);
    header.anyFinite = step.finite().count > 0;
    if (header.anyFinite != 0) {
        header.extent[2] = bitsOf(step.type(), s.finiteMin);
        header.extent[3] = bitsOf(step.type(), s.finiteMax);
    }
    return header;
}

Bytes summaryOf(const SortedStep& step, const std::string& about) {
    Bytes out;
    const std::vector<double> quantiles = step.quantiles(kStepQuantiles);
    append(out, std::uint64_t{quantiles.size()});
    for (const double value : quantiles) append(out, value);
    const auto text = std::as_bytes(std::span(about));
    out.insert(out.end(), text.begin(), text.end());
    return out;
}

// Writes what comes next, wherever that is.
class Appender {
 public:
    Appender(ByteSink& sink, std::uint64_t at) : sink_(sink), at_(at) {}
    StepSection write(std::span<const std::byte> bytes) {
        sink_.write(at_, bytes);
        const StepSection section{at_, bytes.size(), XXH3_64bits(bytes.data(), bytes.size())};
        at_ += bytes.size();
        return section;
    }
    std::uint64_t at() const { return at_; }

 private:
    ByteSink& sink_;
    std::uint64_t at_;
};

// Blocks [first, first + count) of the step.
std::vector<EncodedBlock> encodeSome(const SortedStep& step, std::uint64_t first,
                                     std::uint64_t count, const BrickOrder& order,
                                     unsigned threads) {
    const Run run{first * kStepBlock,
                  std::min(step.size(), (first + count) * kStepBlock) - first * kStepBlock};
    const Columns columns = step.columns({&run, 1});
    std::vector<EncodedBlock> encoded(count);
    std::atomic<std::uint64_t> next{0};
    sharing(threadsFor(count, 1, threads), [&](unsigned) {
        for (std::uint64_t b; (b = next++) < count;) {
            const std::uint64_t from = (first + b) * kStepBlock;
            const std::uint64_t points = std::min(kStepBlock, step.size() - from);
            encoded[b] = std::visit(
                [&](auto values) {
                    return encode(values.subspan(from, points),
                                  columns.gridIndex.subspan(from, points), order);
                },
                columns.values);
        }
    });
    return encoded;
}

}  // namespace

bool writeStep(const SortedStep& step, const std::string& about, ByteSink& sink,
               const std::function<bool(double)>& goOn, unsigned threads) {
    std::array<std::uint32_t, 3> size;
    std::ranges::transform(step.grid().size(), size.begin(),
                           [](std::size_t n) { return static_cast<std::uint32_t>(n); });
    const BrickOrder order(size);
    const std::uint64_t blocks = (step.size() + kStepBlock - 1) / kStepBlock;

    std::vector<StepBlock> directory;
    directory.reserve(blocks);
    Appender out(sink, kHeaderBytes);
    Bytes together;
    for (std::uint64_t first = 0; first < blocks; first += kBlocksTogether) {
        if (goOn && !goOn(static_cast<double>(first) / static_cast<double>(blocks))) return false;
        const std::uint64_t count = std::min(kBlocksTogether, blocks - first);
        std::vector<EncodedBlock> encoded = encodeSome(step, first, count, order, threads);
        together.clear();
        for (EncodedBlock& block : encoded) {
            block.entry.idsAt = out.at() + together.size();
            together.insert(together.end(), block.ids.begin(), block.ids.end());
        }
        for (EncodedBlock& block : encoded) {
            block.entry.keysAt = out.at() + together.size();
            together.insert(together.end(), block.keys.begin(), block.keys.end());
            directory.push_back(block.entry);
        }
        out.write(together);
    }

    StepHeader header = headerOf(step, size, blocks);
    header.directory = out.write(std::as_bytes(std::span(directory)));
    header.summary = out.write(summaryOf(step, about));
    header.fileBytes = out.at();
    const auto bytes = std::as_bytes(std::span(&header, 1));
    header.sum = XXH3_64bits(bytes.data(), offsetof(StepHeader, sum));
    Bytes page(kHeaderBytes);
    std::ranges::copy(bytes, page.begin());
    sink.write(0, page);
    return true;
}

}  // namespace timeseries
