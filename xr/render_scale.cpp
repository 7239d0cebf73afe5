#include "xr/render_scale.h"

namespace xr {

void RenderScale::took(std::chrono::nanoseconds frame, std::chrono::nanoseconds period) {
    const double share = static_cast<double>(frame.count()) / static_cast<double>(period.count());
    lateFrames_ = share > kLate ? lateFrames_ + 1 : 0;
    if (lateFrames_ == kLateFrames && lowered_ < kMostLowered) ++lowered_;
    if (lateFrames_ == kLateFrames) lateFrames_ = 0;
    // Time grows with the pixels at most: what is quick after a step up will not go down again.
    const double growth = lowered_ > 0 ? scaleAfter(lowered_ - 1) / scale() : 1;
    quickTime_ = share * growth * growth < kQuick ? quickTime_ + period : period * 0;
    if (quickTime_ < kQuickTime) return;
    quickTime_ = {};
    if (lowered_ > 0) --lowered_;
}

}  // namespace xr
