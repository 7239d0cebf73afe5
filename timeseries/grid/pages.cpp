#include "timeseries/grid/pages.h"

#include <sys/mman.h>
#include <sys/sysinfo.h>

#include <cstdint>

#include "timeseries/together.h"

namespace timeseries {
namespace {

constexpr std::size_t kLargePage = std::size_t{2} << 20;
constexpr std::size_t kLargePagesWorthAThread = 8;

// Whether so much is free without taking it from what the system keeps of files: else it would
// first move memory about to make large pages, for seconds at 512^3 (measured).
bool muchIsFree(std::size_t bytes) {
    struct sysinfo now {};
    return sysinfo(&now) == 0 && bytes <= now.freeram * std::size_t{now.mem_unit} / 2;
}

}  // namespace

RawPages::RawPages(std::size_t bytes, Filled filled) {
    if (bytes == 0) return;
    if (filled == Filled::Sparsely) {
        void* const at = mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                              MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
        if (at == MAP_FAILED) throw std::bad_alloc();
        at_ = at;
        mapped_ = bytes;
        // A wish: large pages would take memory for what lies beside what is written.
        (void)madvise(at_, bytes, MADV_NOHUGEPAGE);
        return;
    }
    const bool large = bytes >= 4 * kLargePage;
    if (large) align_ = std::align_val_t{kLargePage};
    at_ = ::operator new(bytes, align_);
    // A wish; where it is not granted, pages are small.
    if (large && muchIsFree(bytes))
        (void)madvise(at_, bytes / kLargePage * kLargePage, MADV_HUGEPAGE);
}

void populate(void* at, std::size_t bytes) {
    const auto from = reinterpret_cast<std::uintptr_t>(at);
    const std::uintptr_t first = (from + kLargePage - 1) / kLargePage,
                         end = (from + bytes) / kLargePage;
    if (first >= end) return;
    const auto each = [&](std::size_t i, std::size_t last) {
        (void)madvise(reinterpret_cast<void*>((first + i) * kLargePage), (last - i) * kLargePage,
                      MADV_POPULATE_WRITE);
    };
    inParts(end - first, threadsFor(end - first, kLargePagesWorthAThread), each);
}

RawPages::~RawPages() {
    if (at_ != nullptr && mapped_ > 0)
        munmap(at_, mapped_);
    else
        ::operator delete(at_, align_);
}

}  // namespace timeseries
