// Rows of a picture shared among threads: each sums rows of its own, so that pixels need no lock.
#pragma once

#include <algorithm>

#include "render/model/footprint.h"

namespace render {

// Threads take rows in turns, so many at a time. Calls use(y) for those of `rows` that are the
// thread's.
template <typename Use>
void forEachRowOf(unsigned thread, unsigned threads, const PixelSpan& rows, const Use& use) {
    constexpr int kAtATime = 16;
    for (int y = rows.first; y < rows.last;) {
        const int strip = y / kAtATime, last = std::min((strip + 1) * kAtATime, rows.last);
        if (static_cast<unsigned>(strip) % threads == thread)
            for (; y < last; ++y) use(y);
        y = last;
    }
}

}  // namespace render
