// Work that several threads share. Pure.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <thread>
#include <vector>

namespace timeseries {

// Of the whole program, where others need the machine's cores, too; 0: no limit. To be set before
// there is anything to share.
inline std::atomic<unsigned> threadLimit{0};

// How many share what there is to do; more of them only wait for memory.
inline unsigned sharingThreads() {
    const unsigned limit = threadLimit, most = 16;
    return std::clamp(std::thread::hardware_concurrency(), 1u,
                      limit > 0 ? std::min(limit, most) : most);
}

// work(k) for every k below `threads`, at once, each on a thread. Those beside the caller's are its
// own and are kept for its next call. REQUIRES: it does not throw.
void together(unsigned threads, const std::function<void(unsigned)>& work);

// together() for work that may throw: what one thread threw, if any, comes when all have ended.
void sharing(unsigned threads, const std::function<void(unsigned)>& work);

// Of those, as many as have so many things to do.
inline unsigned threadsFor(std::size_t count, std::size_t worthAThread,
                           unsigned most = sharingThreads()) {
    return static_cast<unsigned>(std::clamp<std::size_t>(count / worthAThread, 1, most));
}

// work(first, last) for a part of `count` things on each thread.
inline void inParts(std::size_t count, unsigned threads,
                    const std::function<void(std::size_t, std::size_t)>& work) {
    together(threads, [&](unsigned k) { work(count * k / threads, count * (k + 1) / threads); });
}

// What of(0), of(1), ... add up to, in pieces of one size added in their order: the same for any
// number of threads. REQUIRES: `of` does not throw.
template <typename Of>
auto sumOf(std::size_t count, const Of& of) {
    using Sum = decltype(of(count));
    constexpr std::size_t kPiece = 1 << 14;
    std::vector<Sum> sums((count + kPiece - 1) / kPiece, Sum(0));
    inParts(sums.size(), threadsFor(sums.size(), 1), [&](std::size_t first, std::size_t last) {
        for (std::size_t piece = first; piece < last; ++piece)
            for (std::size_t i = piece * kPiece; i < std::min(count, (piece + 1) * kPiece); ++i)
                sums[piece] += of(i);
    });
    Sum all(0);
    for (const Sum& sum : sums) all += sum;
    return all;
}

}  // namespace timeseries
