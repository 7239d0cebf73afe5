#include "timeseries/index/stored_column.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <utility>

#include "timeseries/grid/with_type.h"
#include "timeseries/index/ordered_key.h"

namespace timeseries {
namespace {

template <typename T>
class FileBuckets final : public BucketSource<T> {
 public:
    FileBuckets(std::shared_ptr<const StepFile> file, Again again)
        : file_(std::move(file)), again_(std::move(again)) {}

    void fill(std::size_t bucket, std::span<T> values,
              std::span<std::uint32_t> gridIndex) const override {
        try {
            if (!failed_) return file_->read(bucket, values, gridIndex);
        } catch (const StepFileError& error) {
            fail(error);
        }
        const auto [made, points] = bucketOfMade(bucket);
        std::ranges::copy(made, values.begin());
        std::ranges::copy(points, gridIndex.begin());
    }

    std::uint64_t below(std::size_t bucket, OrderedKey<T> key) const override {
        try {
            if (!failed_) return file_->below(bucket, key);
        } catch (const StepFileError& error) {
            fail(error);
        }
        const auto made = bucketOfMade(bucket).first;
        return static_cast<std::uint64_t>(std::ranges::lower_bound(made, key, {}, orderedKey<T>) -
                                          made.begin());
    }

    void willNeed(std::size_t first, std::size_t buckets) const override {
        file_->willNeed(first, buckets);
    }

 private:
    // Makes the step from its source. Whoever comes while another does waits; where it cannot be
    // made, whoever comes tries.
    void fail(const StepFileError& error) const {
        const std::lock_guard lock(mutex_);
        if (failed_) return;
        made_ = again_(error.what());
        if (made_->size() != file_->statistics().points)
            throw StepFileError(
                fmt::format("{}, and its source is another one by now", error.what()));
        failed_ = true;
    }

    std::pair<std::span<const T>, std::span<const std::uint32_t>> bucketOfMade(
        std::size_t bucket) const {
        const Run run{bucket * kStepBlock, file_->blocks()[bucket].count};
        const Columns columns = made_->columns({&run, 1});
        return {std::get<std::span<const T>>(columns.values).subspan(run.first, run.count),
                columns.gridIndex.subspan(run.first, run.count)};
    }

    std::shared_ptr<const StepFile> file_;
    Again again_;
    mutable std::mutex mutex_;
    mutable std::optional<SortedStep> made_;    // written once, before failed_
    mutable std::atomic<bool> failed_ = false;  // made_ is there
};

template <typename T>
T valueOf(const Number& number) {
    return std::visit([](auto held) { return static_cast<T>(held); }, number);
}

}  // namespace

template <typename T>
std::unique_ptr<LazyColumn<T>> storedColumn(std::shared_ptr<const StepFile> file, Again again,
                                            unsigned threads) {
    const StepStatistics& statistics = file->statistics();
    Partition<T> points;
    for (const StepBlock& block : file->blocks()) {
        points.begin.push_back(points.begin.back() + block.count);
        points.least.push_back(static_cast<OrderedKey<T>>(block.least));
        points.greatest.push_back(static_cast<OrderedKey<T>>(block.greatest));
    }
    points.gridIndex = Pages<std::uint32_t>(statistics.points, Filled::Sparsely);
    points.values = Pages<T>(statistics.points, Filled::Sparsely);
    points.valid = statistics.points;
    points.leastValid = valueOf<T>(statistics.min);
    points.greatestValid = valueOf<T>(statistics.max);
    auto source = std::make_unique<const FileBuckets<T>>(std::move(file), std::move(again));
    return std::make_unique<LazyColumn<T>>(std::move(points), threads, std::move(source));
}

#define ISOCHRON_TYPE(T)                                                                         \
    template std::unique_ptr<LazyColumn<T>> storedColumn(std::shared_ptr<const StepFile>, Again, \
                                                         unsigned);
ISOCHRON_EACH_TYPE(ISOCHRON_TYPE)
#undef ISOCHRON_TYPE

}  // namespace timeseries
