// Memory for a step's columns and a mesh's places: not written when it is made, so that a page that
// nobody asks for takes no room, and in large pages where that costs nobody else's.
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

// Aligned to a cache line. Throws std::bad_alloc.
class RawPages {
 public:
    explicit RawPages(std::size_t bytes = 0, Filled filled = Filled::Mostly);
    RawPages(RawPages&& other) noexcept
        : at_(std::exchange(other.at_, nullptr)), align_(other.align_), mapped_(other.mapped_) {}
    RawPages& operator=(RawPages&& other) noexcept {
        std::swap(at_, other.at_);
        std::swap(align_, other.align_);
        std::swap(mapped_, other.mapped_);
        return *this;
    }
    ~RawPages();
    void* data() const { return at_; }

 private:
    void* at_ = nullptr;
    std::align_val_t align_{64};
    std::size_t mapped_ = 0;  // bytes, where they are the system's own pages
};

// Asks the system for memory that will all be written, on all threads: one waits longer for its
// pages than for what it writes. Small ones: large ones may have to be made first (measured).
void populate(void* at, std::size_t bytes);

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
        : pages_(count * sizeof(T), filled) {}
    T* data() const { return static_cast<T*>(pages_.data()); }

 private:
    RawPages pages_;
};

}  // namespace timeseries
