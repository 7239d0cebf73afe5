#include "timeseries/index/brick_order.h"

#include <algorithm>
#include <bit>

namespace timeseries {
namespace {

constexpr int kBits = 5;  // of a brick, along each axis
constexpr int kLeastBrickBits = 10;
constexpr int kLowerBits = 8;  // of a place: tables that stay in the first-level cache

}  // namespace

BrickOrder::BrickOrder(const std::array<std::uint32_t, 3>& size)
    : along_(glm::uvec3(size[0], size[1], size[2])) {
    points_ = std::uint64_t{size[0]} * size[1] * size[2];
    std::array<int, 3> bits{};
    std::array<std::uint64_t, 3> bricks{};
    for (int a = 0; a < 3; ++a) {
        bits[a] = std::min<int>(kBits, std::bit_width(size[a] - 1));
        bricks[a] = ((std::uint64_t{size[a]} - 1) >> bits[a]) + 1;
        brickBits_ += bits[a];
    }
    const std::uint64_t all = bricks[0] * bricks[1] * bricks[2];
    codes_ = all << brickBits_;
    plain_ = codes_ > std::uint64_t{1} << 32 || brickBits_ < kLeastBrickBits;
    if (plain_) {
        codes_ = points_;
        return;
    }

    // Bit b of axis a goes where all lower bits of all axes, and bit b of the axes before it, leave
    // off.
    std::array<std::array<int, kBits>, 3> to{};
    for (int b = 0, next = 0; b < kBits; ++b)
        for (int a = 0; a < 3; ++a)
            if (b < bits[a]) to[a][b] = next++;
    const std::array<std::uint64_t, 3> brickStride{1, bricks[0], bricks[0] * bricks[1]};
    for (int a = 0; a < 3; ++a) {
        part_[a].resize(size[a]);
        for (std::uint32_t i = 0; i < size[a]; ++i) {
            std::uint64_t code = (i >> bits[a]) * brickStride[a] << brickBits_;
            for (int b = 0; b < bits[a]; ++b) code |= std::uint64_t{i >> b & 1} << to[a][b];
            part_[a][i] = static_cast<std::uint32_t>(code);
        }
    }

    const std::array<std::uint64_t, 3> stride{1, size[0], std::uint64_t{size[0]} * size[1]};
    const auto stepOf = [&](std::uint32_t code) {
        Step step{};
        std::uint64_t index = 0;
        for (std::size_t a = 0; a < 3; ++a) {
            for (std::size_t b = 0; b < std::size_t(bits[a]); ++b)
                step.along[a] |= static_cast<std::uint8_t>((code >> to[a][b] & 1) << b);
            index += step.along[a] * stride[a];
        }
        step.index = static_cast<std::uint32_t>(index);
        return step;
    };
    for (std::uint32_t low = 0; low < 1u << kLowerBits; ++low) lower_.push_back(stepOf(low));
    for (std::uint32_t high = 0; high <= 1u << (brickBits_ - kLowerBits); ++high)
        upper_.push_back(stepOf(high << kLowerBits));
    firstOf_.resize(all);
    extent_.resize(all);
    cut_.resize(all);
    for (std::uint64_t brick = 0; brick < all; ++brick) {
        const auto at =
            indicesOf(brick, glm::vec<3, std::uint64_t>(bricks[0], bricks[1], bricks[2]));
        for (int a = 0; a < 3; ++a) {
            const std::uint64_t first = at[a] << bits[a];
            firstOf_[brick] += static_cast<std::uint32_t>(first * stride[a]);
            extent_[brick][a] = static_cast<std::uint8_t>(
                std::min<std::uint64_t>(std::uint64_t{1} << bits[a], size[a] - first));
            cut_[brick] |= extent_[brick][a] < 1 << bits[a];
        }
    }
}

std::uint32_t BrickOrder::code(std::uint32_t gridIndex) const {
    if (plain_) return gridIndex;
    const glm::uvec3 at = along_(gridIndex);
    return part_[0][at.x] + part_[1][at.y] + part_[2][at.z];
}

bool BrickOrder::toGridIndices(std::uint32_t* codes, std::size_t count) const {
    bool good = true;
    if (plain_) {
        for (std::size_t i = 0; i < count; ++i) good &= codes[i] < codes_;
        return good;
    }
    const std::uint32_t mask = (std::uint32_t{1} << brickBits_) - 1;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t code = codes[i];
        const std::uint32_t brick = code >> brickBits_, place = code & mask;
        if (brick >= firstOf_.size()) return false;
        const Step &lower = lower_[place & ((1u << kLowerBits) - 1)],
                   &upper = upper_[place >> kLowerBits];
        if (cut_[brick] != 0)
            for (std::size_t a = 0; a < 3; ++a)
                good &= (lower.along[a] | upper.along[a]) < extent_[brick][a];
        codes[i] = firstOf_[brick] + lower.index + upper.index;
    }
    return good;
}

}  // namespace timeseries
