// What takes its time to make is made by several threads, and taken in order. Pure.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <optional>
#include <utility>
#include <vector>

#include "timeseries/together.h"

namespace timeseries {

// take(i, make(i)) for every i from `first` to `end`, in this order and by the caller's thread;
// make() runs on as many threads as there is work for, some ahead. What it throws comes when it is
// its turn, and nothing behind it is taken. On one thread each is taken before the next is made.
// `worthAThread`: how many are.
template <typename Make, typename Take>
void inTurn(std::size_t first, std::size_t end, std::size_t worthAThread, const Make& make,
            const Take& take) {
    constexpr std::size_t kAhead = 16;  // of each thread
    const unsigned threads = threadsFor(end - first, worthAThread);
    if (threads == 1) {
        for (; first < end; ++first) take(first, make(first));
        return;
    }
    struct Made {
        std::optional<decltype(make(first))> it;
        std::exception_ptr failed;
    };
    std::vector<Made> made;
    for (; first < end; first += made.size()) {
        made.clear();
        made.resize(std::min<std::size_t>(end - first, kAhead * threads));
        std::atomic<std::size_t> next = 0;
        const auto makeOne = [&](std::size_t i) {
            try {
                made[i].it.emplace(make(first + i));
            } catch (...) {
                made[i].failed = std::current_exception();
            }
        };
        together(threads, [&](unsigned) {
            for (std::size_t i; (i = next++) < made.size();) makeOne(i);
        });
        for (std::size_t i = 0; i < made.size(); ++i) {
            if (made[i].failed) std::rethrow_exception(made[i].failed);
            take(first + i, *std::move(made[i].it));
        }
    }
}

}  // namespace timeseries
