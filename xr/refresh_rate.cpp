#include "xr/refresh_rate.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

namespace xr {

RefreshRate::RefreshRate(std::vector<double> offered) : rates_(std::move(offered)) {
    std::erase_if(rates_, [](double rate) { return !(rate > 0); });
    std::ranges::sort(rates_, std::greater());
}

double RefreshRate::share(std::chrono::nanoseconds time, std::size_t rate) const {
    return std::chrono::duration<double>(time).count() * rates_[rate];
}

void RefreshRate::took(std::chrono::nanoseconds frame, const RenderScale& scale) {
    if (rates_.empty()) return;
    const bool late = scale.lowest() && share(frame, rate_) > RenderScale::kLate;
    const bool quick =
        rate_ > 0 && scale.scale() == 1 && share(frame, rate_ - 1) < RenderScale::kQuick;
    lateFrames_ = late ? lateFrames_ + 1 : 0;
    quickFrames_ = quick ? quickFrames_ + 1 : 0;
    if (lateFrames_ == kLateFrames) {
        lateFrames_ = 0;
        rate_ = std::min(rate_ + 1, rates_.size() - 1);
    }
    if (quickFrames_ == kQuickFrames) {
        quickFrames_ = 0;
        --rate_;
    }
}

std::optional<double> RefreshRate::wanted() const {
    if (rates_.empty()) return std::nullopt;
    return rates_[rate_];
}

std::string RefreshRate::loweredText() const {
    if (rate_ == 0) return {};
    return fmt::format("{:.0f} of {:.0f} Hz", rates_[rate_], rates_[0]);
}

}  // namespace xr
