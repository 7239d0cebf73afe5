// Steps written from their fields, of which no list of all points is made.
#include <algorithm>

#include "timeseries/grid/with_type.h"
#include "timeseries/index/counted_list.h"
#include "timeseries/index/parted_list.h"
#include "timeseries/index/step_blocks.h"

namespace timeseries {
namespace {

template <typename T>
constexpr bool kIsCounted = sizeof(T) <= 2;

template <typename T>
bool write(const Field& field, const std::string& about, ByteSink& sink,
           const std::function<bool(double)>& goOn, unsigned threads, std::uint64_t atOnce) {
    using List = std::conditional_t<kIsCounted<T>, CountedList<T>, PartedList<T>>;
    List list(field, atOnce, threads);
    StepFacts facts{field.type(), sizeOf(*field.grid), list.statistics(), {}, about};
    const std::vector<std::uint64_t> ranks = quantileRanks(list.finite(), kStepQuantiles);
    const BrickOrder order(facts.size);
    const auto find = [&](const Run& points) {
        list.find(points);
        for (std::size_t q = facts.quantiles.size();
             q < ranks.size() && ranks[q] < points.first + points.count; ++q)
            facts.quantiles.push_back(toDouble(numberOf(list.at(ranks[q]))));
    };
    const auto encode = [&](std::uint64_t block, EncodedBlock& out) {
        list.encode(block, order, out);
    };
    const auto blocks = writeBlocks(list.points(), find, encode, sink, goOn, threads);
    if (!blocks) return false;
    finishStep(facts, blocks->directory, blocks->end, sink);
    return true;
}

}  // namespace

bool writeField(const Field& field, const std::string& about, ByteSink& sink,
                const std::function<bool(double)>& goOn, unsigned threads, std::uint64_t atOnce) {
    expectOneList(field.grid->count());
    constexpr std::uint64_t kFound = kBlocksFound * kStepBlock;
    return withType(field.type(), [&]<typename T>(T) {
        // A place of a counted list is an index alone.
        constexpr std::uint64_t kParts = kIsCounted<T> ? 8 : 4;
        const std::uint64_t least = atOnce > 0 ? atOnce : field.grid->count() / kParts;
        const std::uint64_t stretches = std::max<std::uint64_t>(1, (least + kFound - 1) / kFound);
        return write<T>(field, about, sink, goOn, threads, stretches * kFound);
    });
}

}  // namespace timeseries
