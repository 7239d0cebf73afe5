// Memory for a step's columns, a mesh's places and the lists of cells: not written when it is made,
// so that a page that nobody asks for takes no room, and in large pages where that costs nobody
// else's.
#pragma once

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace timeseries {

// How much of it will be written.
enum class Filled {
    Mostly,
    Sparsely  // or once, which large pages would not be worth; it may be larger than the memory
};

// Less is not worth large pages.
inline constexpr std::size_t kWorthLargePages = std::size_t{4} << 20;

// Aligned to two cache lines; what is mostly filled is what std::free() takes. Throws
// std::bad_alloc.
void* takePages(std::size_t bytes, Filled filled = Filled::Mostly);
// As they were taken.
void givePages(void* at, std::size_t bytes, Filled filled = Filled::Mostly) noexcept;

// Of so many bytes that were taken to be sparsely filled, those of [first, end) will now be
// written: they come in large pages, where these are fewer faults and take no more than as much
// again.
void willBeWritten(void* at, std::size_t bytes, std::size_t first, std::size_t end) noexcept;

// Asks the system for memory that will all be written, on all threads: one waits longer for its
// pages than for what it writes.
void populate(void* at, std::size_t bytes);

// Gives the memory of these bytes back to the system, by whole pages: they are anything then, until
// they are written. Whoever has them frees them as before.
void giveBack(void* at, std::size_t bytes) noexcept;

// Whether so much is free without taking it from what the system keeps of files.
bool muchIsFree(std::size_t bytes);

// REQUIRES: it is empty.
template <typename T>
void resizePopulated(std::vector<T>& values, std::size_t count) {
    values.reserve(count);
    populate(values.data(), count * sizeof(T));
    values.resize(count);
}

template <typename T>
class Pages {
 public:
    explicit Pages(std::size_t count = 0, Filled filled = Filled::Mostly)
        : bytes_(count * sizeof(T)),
          filled_(filled),
          at_(bytes_ > 0 ? takePages(bytes_, filled) : nullptr) {}
    Pages(Pages&& other) noexcept
        : bytes_(other.bytes_), filled_(other.filled_), at_(std::exchange(other.at_, nullptr)) {}
    Pages& operator=(Pages&& other) noexcept {
        std::swap(bytes_, other.bytes_);
        std::swap(filled_, other.filled_);
        std::swap(at_, other.at_);
        return *this;
    }
    ~Pages() {
        if (at_ != nullptr) givePages(at_, bytes_, filled_);
    }
    T* data() const { return static_cast<T*>(at_); }
    // Of what is sparsely filled.
    void willBeWritten(std::size_t first, std::size_t count) const noexcept {
        timeseries::willBeWritten(at_, bytes_, first * sizeof(T), (first + count) * sizeof(T));
    }

 private:
    std::size_t bytes_;
    Filled filled_;
    void* at_;
};

template <typename T>
struct LargePageAllocator {
    using value_type = T;
    LargePageAllocator() = default;
    template <typename Other>
    explicit LargePageAllocator(const LargePageAllocator<Other>&) {}
    T* allocate(std::size_t count) { return static_cast<T*>(takePages(count * sizeof(T))); }
    void deallocate(T* at, std::size_t count) noexcept { givePages(at, count * sizeof(T)); }
    friend bool operator==(const LargePageAllocator&, const LargePageAllocator&) { return true; }
};
template <typename T>
using LargeVector = std::vector<T, LargePageAllocator<T>>;

template <typename T>
struct PageAllocator : LargePageAllocator<T> {
    PageAllocator() = default;
    template <typename Other>
    explicit PageAllocator(const PageAllocator<Other>&) {}
    template <typename Other>
    void construct(Other* at) noexcept {
        ::new (static_cast<void*>(at)) Other;
    }
};
// What resize() adds to it without a value is anything until it is written.
template <typename T>
using PageVector = std::vector<T, PageAllocator<T>>;

}  // namespace timeseries
