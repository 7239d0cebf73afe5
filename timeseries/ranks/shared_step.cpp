#include "timeseries/ranks/shared_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "timeseries/grid/pages.h"
#include "timeseries/grid/with_type.h"
#include "timeseries/index/joined_lists.h"
#include "timeseries/index/kept_blocks.h"
#include "timeseries/index/pair_sort.h"
#include "timeseries/index/step_blocks.h"
#include "timeseries/index/step_header.h"

namespace timeseries {
namespace {

// Consecutive points of the list of all ranks' points, on the rank that has them.
template <typename T>
struct ListPart {
    using Point = PackedPoint<T>;
    std::uint64_t first = 0, points = 0, missing = 0;  // of all ranks, but for `first`
    PageVector<Point> own, came;  // of this rank's part of the grid, and of the others'
    JoinedLists<Point> mine;      // of both
};

// The points of a part, by value, with their indices in the whole grid: within a box these ascend
// as its own do, so that ties stay in order.
template <typename T>
PageVector<PackedPoint<T>> sortedOf(const SortedStep& step, const GridBox& box,
                                    const std::array<std::uint32_t, 3>& size) {
    const Columns columns = step.columns();
    const auto values = std::get<std::span<const T>>(columns.values);
    PageVector<PackedPoint<T>> points(values.size());
    const auto put = [&](auto wholeIndex) {
        inParts(points.size(), threadsFor(points.size(), 1 << 16),
                [&](std::size_t first, std::size_t last) {
                    for (std::size_t i = first; i < last; ++i)
                        points[i] =
                            packPoint<T>(orderedKey(values[i]), wholeIndex(columns.gridIndex[i]));
                });
    };
    const glm::uvec3 from(box.first[0], box.first[1], box.first[2]),
        boxSize(box.size[0], box.size[1], box.size[2]);
    const std::uint32_t first = from.x + size[0] * (from.y + size[1] * from.z);
    if (boxSize.x == size[0] && (boxSize.y == size[1] || boxSize.z == 1))
        put([&](std::uint32_t index) { return first + index; });
    else
        put([&, along = IndicesAlong(boxSize)](std::uint32_t index) {
            const glm::uvec3 at = along(index);
            return first + at.x + size[0] * (at.y + size[1] * at.z);
        });
    return points;
}

// Where each rank's part of the list ends in this rank's points: all get as many blocks, but for
// one. Of each end the point that stands there is found bit by bit, its key first, for all ends at
// once, by how many points are less on all ranks.
template <typename T>
std::vector<std::uint64_t> endsOf(const Ranks& ranks, std::span<const PackedPoint<T>> mine,
                                  std::uint64_t points) {
    const std::uint64_t blocks = (points + kStepBlock - 1) / kStepBlock;
    const std::size_t n = ranks.size();
    std::vector<std::uint64_t> wanted(n), keys(n, 0), indices(n, 0), below(n);
    for (std::size_t r = 0; r < n; ++r)
        wanted[r] = std::min(points, blocks * (r + 1) / n * kStepBlock);
    const auto found = [&](std::size_t r) {
        const auto point = packPoint<T>(static_cast<OrderedKey<T>>(keys[r]),
                                        static_cast<std::uint32_t>(indices[r]));
        return static_cast<std::uint64_t>(std::ranges::lower_bound(mine, point, std::less{}) -
                                          mine.begin());
    };
    const auto search = [&](std::vector<std::uint64_t>& digits, int bits) {
        for (int bit = bits; bit-- > 0;) {
            for (std::size_t r = 0; r < n; ++r) {
                digits[r] |= std::uint64_t{1} << bit;
                below[r] = found(r);
            }
            ranks.sum(below);
            for (std::size_t r = 0; r < n; ++r)
                if (below[r] > wanted[r]) digits[r] &= ~(std::uint64_t{1} << bit);
        }
    };
    search(keys, 8 * static_cast<int>(sizeof(T)));
    search(indices, 32);
    std::vector<std::uint64_t> ends(n);
    for (std::size_t r = 0; r < n; ++r) ends[r] = wanted[r] == points ? mine.size() : found(r);
    return ends;
}

// Sorted pieces, one behind the other, into one; `ends` are theirs. Pairs of neighbours first.
template <typename Point>
void merge(PageVector<Point>& points, std::vector<std::uint64_t> ends) {
    PageVector<Point> merged(ends.size() > 1 ? points.size() : 0);
    while (ends.size() > 1) {
        std::vector<std::uint64_t> next;
        for (std::size_t i = 0; i < ends.size(); i += 2) {
            const auto at = [&](std::size_t end) {
                return points.begin() + static_cast<std::ptrdiff_t>(end == 0 ? 0 : ends[end - 1]);
            };
            const std::size_t last = std::min(i + 2, ends.size());
            std::merge(at(i), at(i + 1), at(i + 1), at(last),
                       merged.begin() + (at(i) - points.begin()));
            next.push_back(ends[last - 1]);
        }
        points.swap(merged);
        ends = std::move(next);
    }
}

template <typename T>
ListPart<T> listOf(const Ranks& ranks, Field values, const GridBox& box,
                   const std::array<std::uint32_t, 3>& size) {
    ListPart<T> part;
    ranks.agreed([&] {
        if (box.count() == 0) return;
        const SortedStep step = SortedStep::build(std::move(values));
        part.missing = step.statistics().missing;
        part.own = sortedOf<T>(step, box, size);
    });
    part.missing = ranks.sum(part.missing);
    part.points = ranks.sum(part.own.size());
    const auto ends = endsOf<T>(ranks, part.own, part.points);
    std::vector<std::uint64_t> came;
    part.came = ranks.exchange<PackedPoint<T>>(part.own, ends, came);
    const auto all = std::span(part.own);
    const std::uint64_t first = ranks.isFirst() ? 0 : ends[ranks.rank() - 1];
    const auto behind = all.subspan(ends[ranks.rank()]);
    giveBack(all.data(), first * sizeof all[0]);
    giveBack(behind.data(), behind.size_bytes());
    came.erase(came.begin() + ranks.rank());
    ranks.agreed([&] { merge(part.came, std::move(came)); });
    part.mine = {all.subspan(first, ends[ranks.rank()] - first), part.came};
    part.first = ranks.sumBefore(part.mine.size());
    return part;
}

// The keys of these points of the list, wherever they are.
template <typename T>
std::vector<std::uint64_t> keysAt(const Ranks& ranks, const ListPart<T>& part,
                                  const std::vector<std::uint64_t>& places) {
    std::vector<std::uint64_t> keys(places.size());
    for (std::size_t i = 0; i < places.size(); ++i)
        if (places[i] >= part.first && places[i] - part.first < part.mine.size())
            keys[i] = keyOf<T>(part.mine[places[i] - part.first]);
    ranks.sum(keys);
    return keys;
}

// Of the whole list: what SortedStep::finite() gives.
template <typename T>
Run finiteOf(const Ranks& ranks, const ListPart<T>& part) {
    if constexpr (std::is_floating_point_v<T>) {
        constexpr T kMost = std::numeric_limits<T>::max();
        const auto below = [&](OrderedKey<T> key) {
            return ranks.sum(part.mine.countBelow(packPoint<T>(key, 0)));
        };
        const std::uint64_t first = below(orderedKey(-kMost));
        return {first, below(static_cast<OrderedKey<T>>(orderedKey(kMost) + 1)) - first};
    } else {
        return {0, part.points};
    }
}

template <typename T>
StepFacts factsOf(const Ranks& ranks, const ListPart<T>& part, const SharedStep& step) {
    StepFacts facts{
        static_cast<ValueType>(Values(std::vector<T>()).index()), step.size, {}, {}, step.about};
    const Run finite = finiteOf(ranks, part);
    std::vector<std::uint64_t> places = quantileRanks(finite, kStepQuantiles);
    const std::size_t quantiles = places.size();
    places.insert(places.end(), {0, part.points - 1});
    const std::vector<std::uint64_t> keys = keysAt(ranks, part, places);
    const auto number = [&](std::size_t i) {
        return numberOf(valueOfKey<T>(static_cast<OrderedKey<T>>(keys[i])));
    };
    for (std::size_t i = 0; i < quantiles; ++i) facts.quantiles.push_back(toDouble(number(i)));
    StepStatistics& s = facts.statistics;
    s = {part.points,           part.missing, number(quantiles),
         number(quantiles + 1), std::nan(""), std::nan("")};
    if (quantiles > 0) {
        s.finiteMin = number(0);
        s.finiteMax = number(quantiles - 1);
    }
    return facts;
}

// What a block's points are put into before they are encoded.
template <typename T>
struct BlockPoints {
    std::vector<PackedPoint<T>> packed = std::vector<PackedPoint<T>>(kStepBlock);
    std::vector<T> values = std::vector<T>(kStepBlock);
    std::vector<std::uint32_t> gridIndex = std::vector<std::uint32_t>(kStepBlock);
};

template <typename T>
KeptBlocks encode(const ListPart<T>& part, const BrickOrder& order) {
    const std::uint64_t all = part.mine.size();
    KeptBlocks kept;
    kept.add((all + kStepBlock - 1) / kStepBlock,
             [&](std::uint64_t b, EncodedBlock& out) {
                 static thread_local BlockPoints<T> points;
                 const std::size_t count = std::min(kStepBlock, all - b * kStepBlock);
                 const auto packed = std::span(points.packed).first(count);
                 const auto values = std::span(points.values).first(count);
                 const auto gridIndex = std::span(points.gridIndex).first(count);
                 part.mine.copy(b * kStepBlock, packed);
                 unpackPoints<T>(packed, values, gridIndex);
                 encodeBlock<T>(values, gridIndex, order, out);
             },
             sharingThreads());
    return kept;
}

template <typename T>
void writeList(const Ranks& ranks, ListPart<T> part, const SharedStep& step, WholeFile* file) {
    const StepFacts facts = factsOf(ranks, part, step);
    KeptBlocks kept;
    ranks.agreed([&] { kept = encode(part, BrickOrder(step.size)); });
    part = ListPart<T>();
    std::vector<StepBlock> entries;
    for (const KeptBlock& block : kept.blocks()) entries.push_back(block.entry);
    std::vector<StepBlock> directory = ranks.gather<StepBlock>(entries);
    const std::uint64_t before = ranks.sumBefore(entries.size());
    const std::uint64_t end = placeBlocks(directory, kHeaderBytes);
    const auto write = [&](ByteSink& sink) {
        timeseries::write(kept.blocks(), std::span(directory).subspan(before, entries.size()),
                          sink);
    };

    const std::string name = ranks.fromFirst(file ? file->nameOfNow().string() : "");
    ranks.agreed([&] {
        if (file) return write(*file);
        FilePart beside(name);
        write(beside);
        beside.flush();
    });
    ranks.agreed([&] {
        if (file) finishStep(facts, directory, end, *file);
    });
}

}  // namespace

std::string flawOf(const Ranks& ranks, const GridBox& mine,
                   const std::array<std::uint32_t, 3>& size) {
    std::uint64_t whole = 1, sum = 0;
    for (const std::uint32_t n : size) {
        if (n == 0 || n > (std::uint64_t{1} << 32) / whole)
            return fmt::format("a grid of {} x {} x {} points: expected 1 to 2^32 points", size[0],
                               size[1], size[2]);
        whole *= n;
    }
    const std::vector<GridBox> boxes = ranks.gather<GridBox>({&mine, 1});
    const auto textOf = [](const GridBox& box) {
        return fmt::format("{} x {} x {} from ({}, {}, {})", box.size[0], box.size[1], box.size[2],
                           box.first[0], box.first[1], box.first[2]);
    };
    for (std::size_t r = 0; r < boxes.size(); ++r) {
        for (std::size_t a = 0; a < 3; ++a)
            if (boxes[r].size[a] > size[a] || boxes[r].first[a] > size[a] - boxes[r].size[a])
                return fmt::format("the box of rank {}, {}, reaches out of the grid's {} x {} x {}",
                                   r, textOf(boxes[r]), size[0], size[1], size[2]);
        sum += boxes[r].count();
    }
    const auto meet = [](const GridBox& a, const GridBox& b) {
        bool all = a.count() > 0 && b.count() > 0;
        for (std::size_t i = 0; i < 3; ++i)
            all = all && a.first[i] < b.first[i] + b.size[i] && b.first[i] < a.first[i] + a.size[i];
        return all;
    };
    for (std::size_t r = 0; r < boxes.size(); ++r)
        for (std::size_t q = 0; q < r; ++q)
            if (meet(boxes[q], boxes[r]))
                return fmt::format("the boxes of ranks {} and {} share points: {} and {}", q, r,
                                   textOf(boxes[q]), textOf(boxes[r]));
    if (sum != whole) return fmt::format("the boxes have {} of the grid's {} points", sum, whole);
    return "";
}

void writeShared(const Ranks& ranks, Field values, const GridBox& box, const SharedStep& step,
                 WholeFile* file) {
    withType(values.type(), [&]<typename T>(T) {
        ListPart<T> part = listOf<T>(ranks, std::move(values), box, step.size);
        ranks.agreed([&] {
            if (part.points == 0)
                throw StepFileError("a step without a value: all its points are missing");
        });
        writeList(ranks, std::move(part), step, file);
    });
}

}  // namespace timeseries
