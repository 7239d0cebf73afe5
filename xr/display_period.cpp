#include "xr/display_period.h"

#include <algorithm>
#include <cmath>

namespace xr {
namespace {

constexpr std::chrono::nanoseconds kShortest = std::chrono::milliseconds(1),
                                   kLongest = std::chrono::seconds(1);

bool isPeriod(std::chrono::nanoseconds period) { return period >= kShortest && period <= kLongest; }

}  // namespace

void DisplayPeriod::predicted(std::chrono::nanoseconds period) {
    if (!isPeriod(period)) return;
    least_ = least_.count() == 0 ? period : std::min(least_, period);
}

void DisplayPeriod::told(double rate) {
    if (!(rate >= 1 && rate <= 1000)) return;
    told_ = std::chrono::nanoseconds(std::llround(1e9 / rate));
}

std::chrono::nanoseconds DisplayPeriod::now() const { return told_.count() > 0 ? told_ : least_; }

}  // namespace xr
