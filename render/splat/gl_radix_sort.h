// A stable sort on the GPU, by digits of eight bits, the least first (Knuth, The Art of Computer
// Programming, volume 3, 5.2.5): entries of a key and a number, which shaders make and take.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "render/gl/object.h"

namespace render {

class GlRadixSort {
 public:
    static constexpr std::uint64_t kEntryBytes = 2 * sizeof(std::uint32_t);
    static constexpr std::uint64_t kMost = std::uint64_t{65535} << 12;  // groups that GL promises

    // Makes room for so many entries, uvec2 of key and number, in entries(). REQUIRES: some.
    void begin(std::uint64_t count);
    const gl::Buffer& entries() const { return *entries_[now_]; }
    // Ascending by so many digits of the keys, the first of them at this bit.
    void sort(unsigned shift, unsigned digits);
    // By one more, by a program of scatter() below: what it takes from place 2 on is bound, and it
    // is in use with what else it asks set.
    void last(unsigned shift, const gl::Program& scatter);
    // shaders/radix_scatter.comp, which these defines tell where to put what is sorted.
    static gl::Program scatter(const char* defines);
    // Gives back room for more entries than moving pictures have.
    static constexpr std::uint64_t kKept = 1 << 23;
    void shrink();
    void release();               // all of it
    std::uint64_t bytes() const;  // on the GPU

 private:
    void countDigits(unsigned shift);
    void scatterBy(unsigned shift, const gl::Program& program);

    std::optional<gl::Program> count_, scan_, scatter_;
    std::array<std::optional<gl::Buffer>, 2> entries_;  // from one into the other
    std::optional<gl::Buffer> counts_;
    std::size_t now_ = 0;
    std::uint64_t held_ = 0;  // entries
};

}  // namespace render
