// What a step is asked for beside its points: the cells between them, and how the field changes
// about them.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "timeseries/index/cell_index.h"
#include "timeseries/index/node_values.h"
#include "timeseries/index/point_gradients.h"
#include "timeseries/index/sorted_step.h"

namespace timeseries {

// Each made by one thread at a time, while others see what was there before.
class SortedStep::LazyCells {
 public:
    explicit LazyCells(std::optional<Field> field = {}) {
        if (field) field_ = std::make_shared<const Field>(std::move(*field));
    }
    std::shared_ptr<const CellIndex> ifMade(std::span<const Interval<double>> among) const {
        const std::lock_guard lock(held_);
        return index_ && index_->holds(among) ? index_ : nullptr;
    }
    // Of the field that is held, else of read().
    template <typename Read>
    std::shared_ptr<const CellIndex> get(std::vector<Interval<double>> among, unsigned threads,
                                         const Read& read) {
        const std::lock_guard lock(making_);
        if (auto made = ifMade(among)) return made;
        auto field = fieldIfThere();
        if (!field) field = std::make_shared<const Field>(read());
        if (index_) among = {kAllNumbers};  // nobody else changes it now
        auto index = std::make_shared<const CellIndex>(field, threads, std::move(among));
        const std::lock_guard alone(held_);
        field_.reset();
        return index_ = std::move(index);
    }
    void giveUp() { areGivenUp_ = true; }
    bool areGivenUp() const { return areGivenUp_; }
    std::shared_ptr<const Field> fieldIfThere() const {
        const std::lock_guard lock(held_);
        return index_ ? index_->sharedField() : field_;
    }
    // Likewise, with what it has between its points where that is not told by these alone.
    std::shared_ptr<const Field> fieldBetween(unsigned threads) {
        const auto there = fieldIfThere();
        if (!there) return nullptr;
        auto with = withNodeValues(there, threads);
        const std::lock_guard lock(held_);
        if (field_ == there) field_ = with;
        return with;
    }
    std::shared_ptr<const PointGradients> gradientsIfMade(
        const std::shared_ptr<const Mesh>& mesh) const {
        const std::lock_guard lock(held_);
        return gradients_ && gradients_->areOn(mesh) ? gradients_ : nullptr;
    }
    std::shared_ptr<const PointGradients> gradients(const std::shared_ptr<const Mesh>& mesh,
                                                    unsigned threads, const Field& field) {
        const std::lock_guard lock(makingGradients_);
        if (auto made = gradientsIfMade(mesh)) return made;
        auto gradients = std::make_shared<const PointGradients>(field, mesh, threads);
        const std::lock_guard alone(held_);
        return gradients_ = std::move(gradients);
    }
    // Of memory.
    std::uint64_t bytes() const {
        const std::lock_guard lock(held_);
        const std::uint64_t ofGradients = gradients_ ? gradients_->bytes() : 0;
        if (index_) return index_->bytes() + ofGradients;
        return (field_ ? field_->bytes() : 0) + ofGradients;
    }

 private:
    std::atomic<bool> areGivenUp_ = false;
    std::mutex making_, makingGradients_;
    mutable std::mutex held_;
    std::shared_ptr<const PointGradients> gradients_;
    std::shared_ptr<const CellIndex> index_;
    std::shared_ptr<const Field> field_;  // until there is an index of it
};

}  // namespace timeseries
