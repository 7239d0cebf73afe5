#include "app/headset/point_search.h"

#include <algorithm>
#include <utility>

namespace app::headset {

void PointSearch::look(std::shared_ptr<const timeseries::SortedStep> step, std::uint64_t gridIndex,
                       std::uint64_t points) {
    if (step != step_ || gridIndex != gridIndex_) {
        step_ = std::move(step);
        gridIndex_ = gridIndex;
        looked_ = 0;
        found_.reset();
    }
    if (ended()) return;
    const timeseries::Run next{looked_, std::min(points, step_->size() - looked_)};
    const auto part = step_->columns({&next, 1}).gridIndex.subspan(next.first, next.count);
    const auto at = std::find(part.begin(), part.end(), gridIndex_);
    looked_ += static_cast<std::uint64_t>(at - part.begin());
    if (at != part.end()) found_ = looked_;
}

bool PointSearch::ended() const { return found_ || !step_ || looked_ == step_->size(); }

}  // namespace app::headset
