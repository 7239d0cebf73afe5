#include "timeseries/grid/pages.h"

#include <sys/mman.h>
#include <sys/sysinfo.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>

#include "timeseries/together.h"

namespace timeseries {
namespace {

constexpr std::size_t kLargePage = std::size_t{2} << 20;
// One takes 0.4 to 5 ms, by what the machine under it has to do for it.
constexpr std::size_t kLargePagesWorthAThread = 2;
// What is sparsely filled, and less than this, is not worth a mapping of its own.
constexpr std::size_t kWorthAMapping = std::size_t{128} << 10;
// In small ones so much takes as long: 128 of 12 us, or one of 1.5 ms, on the slowest machine.
constexpr std::size_t kWorthALargePage = kLargePage / 4;

bool isMapped(std::size_t bytes, Filled filled) {
    return filled == Filled::Sparsely && bytes >= kWorthAMapping;
}

}  // namespace

bool muchIsFree(std::size_t bytes) {
    struct sysinfo now {};
    return sysinfo(&now) == 0 && bytes <= now.freeram * std::size_t{now.mem_unit} / 2;
}

void* takePages(std::size_t bytes, Filled filled) {
    if (isMapped(bytes, filled)) {
        void* const at = mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                              MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
        if (at == MAP_FAILED) throw std::bad_alloc();
        // A wish: large pages would take memory for what lies beside what is written.
        (void)madvise(at, bytes, MADV_NOHUGEPAGE);
        return at;
    }
    const bool isLarge = bytes >= kWorthLargePages;
    void* at = nullptr;
    if (posix_memalign(&at, isLarge ? kLargePage : 128, bytes) != 0) throw std::bad_alloc();
    // A wish; where it is not granted, pages are small. Where little is free, the system would
    // first move memory about to make large ones, for seconds at 512^3 (measured).
    if (isLarge && muchIsFree(bytes))
        (void)madvise(at, bytes / kLargePage * kLargePage, MADV_HUGEPAGE);
    return at;
}

void giveBack(void* at, std::size_t bytes) noexcept {
    const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    const auto from = reinterpret_cast<std::uintptr_t>(at);
    const std::uintptr_t first = (from + page - 1) / page, end = (from + bytes) / page;
    if (first < end)
        (void)madvise(reinterpret_cast<void*>(first * page), (end - first) * page, MADV_DONTNEED);
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

void willBeWritten(void* at, std::size_t bytes, std::size_t first, std::size_t end) noexcept {
    if (end - first < kLargePage || !isMapped(bytes, Filled::Sparsely) || !muchIsFree(end - first))
        return;
    const auto from = reinterpret_cast<std::uintptr_t>(at);
    std::uintptr_t page = (from + first + kWorthALargePage - 1) / kLargePage,
                   behind = (from + end + kLargePage - kWorthALargePage) / kLargePage;
    // Others' memory lies beside it.
    if (page * kLargePage < from) ++page;
    if (behind * kLargePage > from + bytes) --behind;
    if (page < behind)
        (void)madvise(reinterpret_cast<void*>(page * kLargePage), (behind - page) * kLargePage,
                      MADV_HUGEPAGE);
}

void givePages(void* at, std::size_t bytes, Filled filled) noexcept {
    if (isMapped(bytes, filled))
        munmap(at, bytes);
    else
        std::free(at);
}

}  // namespace timeseries
