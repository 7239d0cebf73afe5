// What Highway compiles for several kinds of vectors, run with each of them that this machine has.
#pragma once

#include <gtest/gtest.h>

#include <hwy/highway.h>
#include <functional>

namespace tests {

inline void onEachVectorTarget(const std::function<void()>& test) {
    const auto use = [](std::int64_t targets) {
        hwy::SetSupportedTargetsForTest(targets);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    };
    for (std::int64_t rest = hwy::SupportedTargets() & HWY_TARGETS; rest != 0; rest &= rest - 1) {
        const std::int64_t target = rest & -rest;
        use(target);
        SCOPED_TRACE(hwy::TargetName(target));
        test();
    }
    use(0);
}

}  // namespace tests
