// A step on disk read by timeseries/index/FORMAT.md alone: by nothing of the program that reads
// one.
#include <gtest/gtest.h>
#include <xxhash.h>
#include <zstd.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>
#include <random>
#include <string_view>

#include "tests/support/random_field.h"
#include "tests/support/step_bytes.h"

namespace timeseries::step_format {
namespace {

class Bytes {
 public:
    explicit Bytes(std::string_view bytes) : bytes_(bytes) {}
    template <typename T>
    T at(std::size_t place) const {
        T number;
        std::memcpy(&number, bytes_.substr(place, sizeof(T)).data(), sizeof(T));
        return number;
    }
    std::string_view part(std::size_t place, std::size_t count) const {
        return bytes_.substr(place, count);
    }
    std::size_t size() const { return bytes_.size(); }

 private:
    std::string_view bytes_;
};

std::uint64_t hashOf(std::string_view bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

// Fields of so many bits one after the other, the least significant first.
class Bits {
 public:
    explicit Bits(std::string_view bytes) : bytes_(bytes) {}
    std::uint64_t next(unsigned bits) {
        std::uint64_t field = 0;
        for (unsigned i = 0; i < bits; ++i, ++at_)
            field |= std::uint64_t(std::uint8_t(bytes_[at_ / 8]) >> at_ % 8 & 1) << i;
        return field;
    }

 private:
    std::string_view bytes_;
    std::size_t at_ = 0;
};

// From codes to grid indices.
class Bricks {
 public:
    explicit Bricks(std::array<std::uint64_t, 3> size) : size_(size) {
        std::uint64_t codes = 1;
        for (std::size_t a = 0; a < 3; ++a) {
            bits_[a] = std::min(5, int(std::bit_width(size[a] - 1)));
            count_[a] = (size[a] + (1u << bits_[a]) - 1) >> bits_[a];
            codes *= count_[a] << bits_[a];
        }
        inBrick_ = unsigned(bits_[0] + bits_[1] + bits_[2]);
        plain_ = (1u << inBrick_) < 1024 || codes > std::uint64_t{1} << 32;
    }
    std::uint64_t gridIndex(std::uint64_t code) const {
        if (plain_) return code;
        const std::uint64_t brick = code >> inBrick_;
        std::array<std::uint64_t, 3> place{brick % count_[0], brick / count_[0] % count_[1],
                                           brick / count_[0] / count_[1]};
        for (std::size_t a = 0; a < 3; ++a) place[a] <<= bits_[a];
        unsigned from = 0;
        for (int bit = 0; bit < 5; ++bit)
            for (std::size_t a = 0; a < 3; ++a)
                if (bit < bits_[a]) place[a] |= (code >> from++ & 1) << bit;
        return place[0] + size_[0] * (place[1] + size_[1] * place[2]);
    }

 private:
    std::array<std::uint64_t, 3> size_, count_{};
    std::array<int, 3> bits_{};
    unsigned inBrick_ = 0;
    bool plain_ = false;
};

std::vector<std::uint64_t> codesOf(std::string_view ids, std::size_t points) {
    const Bytes bytes(ids);
    std::vector<std::uint64_t> codes{bytes.at<std::uint32_t>(0)};
    const std::string_view frame = bytes.part(8, bytes.at<std::uint32_t>(4));
    std::vector<std::uint8_t> classes(points - 1);
    EXPECT_EQ(ZSTD_decompress(classes.data(), classes.size(), frame.data(), frame.size()),
              points - 1);
    Bits open(ids.substr(8 + frame.size()));
    for (const unsigned c : classes) {
        std::uint64_t gap = c;
        if (c >= 16) {
            const unsigned w = (c - 16) / 4 + 5, j = (c - 16) % 4;
            gap = std::uint64_t{4 | j} << (w - 3) | open.next(w - 3);
        }
        codes.push_back(codes.back() + gap + 1);
    }
    return codes;
}

struct Point {
    std::uint64_t gridIndex, key;
    friend auto operator<=>(const Point& a, const Point& b) {
        return std::pair(a.key, a.gridIndex) <=> std::pair(b.key, b.gridIndex);
    }
    friend bool operator==(const Point&, const Point&) = default;
};

std::vector<std::uint64_t> keysOf(std::string_view stored, std::size_t points, std::uint64_t least,
                                  bool dictionary, unsigned bits, unsigned shift) {
    std::vector<std::uint64_t> keys, entries;
    if (dictionary) {
        const Bytes bytes(stored);
        const auto count = bytes.at<std::uint32_t>(0);
        const auto of = bytes.at<std::uint8_t>(4);
        Bits fields(stored.substr(5));
        for (std::uint32_t i = 0; i < count; ++i) entries.push_back(fields.next(of));
        stored = stored.substr(5 + (std::size_t{count} * of + 7) / 8);
    }
    Bits fields(stored);
    for (std::size_t i = 0; i < points; ++i) {
        const std::uint64_t field = fields.next(bits);
        keys.push_back(least + ((dictionary ? entries[field] : field) << shift));
    }
    return keys;
}

// Of each 256 blocks first their ids lie one behind the other, then their keys; from the header on.
void expectInPlace(const Bytes& file, std::size_t directory, std::uint64_t blocks) {
    std::uint64_t at = 4096;
    for (std::uint64_t first = 0; first < blocks; first += 256)
        for (const std::size_t part : {0u, 1u})  // ids, keys
            for (std::uint64_t b = first; b < std::min(first + 256, blocks); ++b) {
                const std::size_t block = directory + 56 * b;
                EXPECT_EQ(file.at<std::uint64_t>(block + 16 + 8 * part), at);
                at += file.at<std::uint32_t>(block + 32 + 4 * part);
            }
}

// All of a file's points, in the order of their codes within each block.
std::vector<Point> pointsOf(const Bytes& file, const std::array<std::uint64_t, 3>& size) {
    EXPECT_EQ(file.part(0, 8), "isostep\n");
    EXPECT_EQ(file.at<std::uint32_t>(8), 1u);
    EXPECT_EQ(file.at<std::uint32_t>(12), 0x01020304u);
    EXPECT_EQ(file.at<std::uint64_t>(16), file.size());
    EXPECT_EQ(file.at<std::uint32_t>(28), 32768u);
    for (std::size_t a = 0; a < 3; ++a) EXPECT_EQ(file.at<std::uint32_t>(32 + 4 * a), size[a]);
    EXPECT_EQ(file.at<std::uint64_t>(160), hashOf(file.part(0, 160)));
    const auto directory = file.at<std::uint64_t>(112);
    EXPECT_EQ(file.at<std::uint64_t>(128),
              hashOf(file.part(directory, file.at<std::uint64_t>(120))));
    EXPECT_EQ(file.at<std::uint64_t>(152),
              hashOf(file.part(file.at<std::uint64_t>(136), file.at<std::uint64_t>(144))));
    for (std::size_t at = 168; at < 4096; ++at) EXPECT_EQ(file.at<std::uint8_t>(at), 0) << at;
    expectInPlace(file, directory, file.at<std::uint64_t>(64));
    const Bricks bricks(size);
    std::vector<Point> points;
    for (std::uint64_t block = 0; block < file.at<std::uint64_t>(64); ++block) {
        const std::size_t at = directory + 56 * block;
        const auto ids =
                       file.part(file.at<std::uint64_t>(at + 16), file.at<std::uint32_t>(at + 32)),
                   keys =
                       file.part(file.at<std::uint64_t>(at + 24), file.at<std::uint32_t>(at + 36));
        EXPECT_EQ(file.at<std::uint32_t>(at + 40), std::uint32_t(hashOf(ids)));
        EXPECT_EQ(file.at<std::uint32_t>(at + 44), std::uint32_t(hashOf(keys)));
        const auto count = file.at<std::uint32_t>(at + 48);
        const auto codes = codesOf(ids, count);
        const auto keysHere =
            keysOf(keys, count, file.at<std::uint64_t>(at), file.at<std::uint8_t>(at + 52) == 1,
                   file.at<std::uint8_t>(at + 53), file.at<std::uint8_t>(at + 54));
        std::uint64_t least = ~std::uint64_t{0}, greatest = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            points.push_back({bricks.gridIndex(codes[i]), keysHere[i]});
            least = std::min(least, keysHere[i]);
            greatest = std::max(greatest, keysHere[i]);
        }
        EXPECT_EQ(least, file.at<std::uint64_t>(at));
        EXPECT_EQ(greatest, file.at<std::uint64_t>(at + 8));
    }
    EXPECT_EQ(points.size(), file.at<std::uint64_t>(48));
    return points;
}

template <typename T>
std::uint64_t keyOf(T value) {
    if constexpr (std::is_floating_point_v<T>) {
        using Unsigned = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
        const Unsigned bits = std::bit_cast<Unsigned>(value == 0 ? T{0} : value);
        const Unsigned sign = Unsigned{1} << (8 * sizeof(T) - 1);
        return static_cast<Unsigned>(bits & sign ? ~bits : bits | sign);
    } else {
        using Unsigned = std::make_unsigned_t<T>;
        return static_cast<Unsigned>(
            static_cast<Unsigned>(value) ^
            (std::is_signed_v<T> ? Unsigned(1) << (8 * sizeof(T) - 1) : Unsigned(0)));
    }
}

// The type's number in the header's table.
template <typename T>
constexpr std::uint32_t numberOfType() {
    if (std::is_floating_point_v<T>) return sizeof(T) == 4 ? 8 : 9;
    return 2 * std::uint32_t(std::bit_width(sizeof(T)) - 1) + (std::is_signed_v<T> ? 1 : 0);
}

// What header and summary tell of all points, of a list of their values in order and of how many
// there are none.
template <typename T>
void expectFacts(const Bytes& file, std::vector<T> list, std::uint64_t missing) {
    EXPECT_EQ(file.at<std::uint32_t>(24), numberOfType<T>());
    EXPECT_EQ(file.at<std::uint64_t>(56), missing);
    EXPECT_EQ(file.at<T>(72), list.front());
    EXPECT_EQ(file.at<T>(80), list.back());
    std::erase_if(list, [](T value) { return !std::isfinite(static_cast<double>(value)); });
    EXPECT_EQ(file.at<std::uint64_t>(104), list.empty() ? 0u : 1u);
    const auto summary = file.at<std::uint64_t>(136), bytes = file.at<std::uint64_t>(144);
    const auto quantiles = file.at<std::uint64_t>(summary);
    EXPECT_EQ(file.part(summary + 8 + 8 * quantiles, bytes - 8 - 8 * quantiles), "about");
    ASSERT_EQ(quantiles > 1, !list.empty());
    if (list.empty()) return;
    EXPECT_EQ(file.at<T>(88), list.front());
    EXPECT_EQ(file.at<T>(96), list.back());
    for (std::uint64_t q = 0; q < quantiles; ++q) {
        const double rank = double(q) / double(quantiles - 1) * double(list.size() - 1);
        EXPECT_EQ(file.at<double>(summary + 8 + 8 * q),
                  static_cast<double>(list[std::size_t(std::llround(rank))]));
    }
}

template <typename T>
class StepFormatOf : public testing::Test {};
using Types = testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::uint32_t,
                             std::int32_t, std::uint64_t, std::int64_t, float, double>;
TYPED_TEST_SUITE(StepFormatOf, Types);

TYPED_TEST(StepFormatOf, IsWhatIsWrittenDown) {
    using T = TypeParam;
    std::mt19937_64 random(7);
    for (int kind = 0; kind < 4; ++kind)
        for (const std::array<std::uint64_t, 3> size :
             {std::array<std::uint64_t, 3>{50, 41, 37}, {300, 230, 1}, {7, 5, 3}, {1, 1, 60000}}) {
            const Field field =
                tests::randomField<T>(random, {std::size_t(size[0]), size[1], size[2]}, kind);
            const auto& values = std::get<std::vector<T>>(field.values);
            std::vector<Point> expected;
            std::vector<T> list;
            for (std::size_t i = 0; i < values.size(); ++i)
                if (values[i] == values[i] && (field.missing.empty() || !field.missing[i])) {
                    expected.push_back({i, keyOf(values[i])});
                    list.push_back(values[i]);
                }
            std::ranges::sort(expected);
            std::ranges::sort(list);
            const auto written = tests::written(SortedStep::build(field), "about");
            const Bytes bytes({reinterpret_cast<const char*>(written.data()), written.size()});
            expectFacts(bytes, list, values.size() - list.size());
            auto points = pointsOf(bytes, size);
            ASSERT_EQ(points.size(), expected.size());
            // A block's points are those of the list, whatever their order in it.
            constexpr std::size_t kBlock = 32768;
            for (std::size_t first = 0; first < points.size(); first += kBlock)
                std::sort(points.begin() + std::ptrdiff_t(first),
                          points.begin() + std::ptrdiff_t(std::min(points.size(), first + kBlock)));
            EXPECT_TRUE(points == expected);
        }
}

}  // namespace
}  // namespace timeseries::step_format
