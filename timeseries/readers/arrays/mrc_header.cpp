#include "timeseries/readers/arrays/mrc_header.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

namespace timeseries {
namespace {

constexpr std::size_t kHeaderBytes = 1024;

// Words of four bytes, counted from 1 as the format's description does.
class Words {
 public:
    explicit Words(const ArrayHeader& header) {
        std::ifstream file(header.path, std::ios::binary);
        file.read(bytes_.data(), kHeaderBytes);
        if (file.gcount() != kHeaderBytes)
            header.fail("header",
                        fmt::format("expected {} bytes, found {}", kHeaderBytes, file.gcount()));
        // By the machine stamp; files without one are told by a number of columns that is small.
        const unsigned char stamp = static_cast<unsigned char>(bytes_[212]);
        const bool little = std::endian::native == std::endian::little;
        if (stamp == 0x44 || stamp == 0x11)
            swapped_ = (stamp == 0x44) != little;
        else
            swapped_ = static_cast<std::uint32_t>(integer(1)) > 0xFFFF;
    }
    bool swapped() const { return swapped_; }
    std::int32_t integer(std::size_t word) const {
        std::uint32_t bits;
        std::memcpy(&bits, bytes_.data() + 4 * (word - 1), 4);
        return static_cast<std::int32_t>(swapped_ ? __builtin_bswap32(bits) : bits);
    }
    double real(std::size_t word) const {
        return static_cast<double>(std::bit_cast<float>(integer(word)));
    }
    glm::ivec3 integers(std::size_t word) const {
        return {integer(word), integer(word + 1), integer(word + 2)};
    }
    glm::dvec3 reals(std::size_t word) const {
        return {real(word), real(word + 1), real(word + 2)};
    }

 private:
    std::array<char, kHeaderBytes> bytes_{};
    bool swapped_ = false;
};

ValueType typeOf(const ArrayHeader& header, const Words& words) {
    // IMOD's programs wrote bytes without a sign, and say so in flags of their own.
    constexpr std::int32_t kImod = 1146047817;
    const bool unsignedBytes = words.integer(39) == kImod && (words.integer(40) & 1) == 0;
    switch (const std::int32_t mode = words.integer(4)) {
        case 0:
            return unsignedBytes ? ValueType::U8 : ValueType::I8;
        case 1:
            return ValueType::I16;
        case 2:
            return ValueType::F32;
        case 6:
            return ValueType::U16;
        default:
            header.fail("mode", fmt::format("expected 0 (int8), 1 (int16), 2 (float32) or 6 "
                                            "(uint16), found {}",
                                            mode));
    }
}

// Which coordinate columns, rows and sections run along.
glm::ivec3 orderOf(ArrayHeader& header, const Words& words) {
    const glm::ivec3 order = words.integers(17);
    const bool each = [&] {
        unsigned seen = 0;
        for (int i = 0; i < 3; ++i)
            if (order[i] >= 1 && order[i] <= 3) seen |= 1u << (order[i] - 1);
        return seen == 7;
    }();
    if (each) return order - 1;
    if (order != glm::ivec3(0))
        header.notes.push_back(
            "columns, rows and sections are taken for x, y and z: the header's MAPC, MAPR and MAPS "
            "name no three axes");
    return {0, 1, 2};
}

// Columns: the steps along x, y and z from voxel to voxel of a cell that is cut into so many: its
// first edge lies along x, the second in the plane of x and y. Without a cell, 1.
glm::dmat3 stepsOf(ArrayHeader& header, const Words& words, const glm::ivec3& intervals) {
    const glm::dvec3 edges = words.reals(11);
    glm::dvec3 angles = words.reals(14);
    for (int c = 0; c < 3; ++c) {
        if (!(angles[c] > 0 && angles[c] < 180)) angles = glm::dvec3(90);
        if (edges[c] > 0 && std::isfinite(edges[c])) continue;
        header.notes.push_back("voxels are drawn as cubes: the header has no unit cell");
        return glm::dmat3(1);
    }
    // Of right angles exactly.
    const auto cosine = [](double degrees) {
        return degrees == 90 ? 0 : std::cos(glm::radians(degrees));
    };
    const double a = cosine(angles.x), b = cosine(angles.y), c = cosine(angles.z);
    const double sine = std::sqrt(1 - c * c), y = (a - b * c) / sine;
    const double z2 = 1 - b * b - y * y;
    if (!(z2 > 0)) header.fail("cell angles", "expected three that a cell can have");
    const glm::dvec3 side = edges / glm::dvec3(intervals);
    return {side.x * glm::dvec3(1, 0, 0), side.y * glm::dvec3(c, sine, 0),
            side.z * glm::dvec3(b, y, std::sqrt(z2))};
}

// How many volumes stand behind each other: space groups from 401 on tell a stack of them.
std::int32_t volumesOf(ArrayHeader& header, const Words& words, const glm::ivec3& size) {
    const std::int32_t group = words.integer(23), deep = words.integer(10);
    if (group < 401 || group > 630 || deep < 1) return 1;
    if (size.z % deep != 0)
        header.fail("MZ", fmt::format("expected a stack of {} sections to be whole volumes of {}",
                                      size.z, deep));
    return size.z / deep;
}

void takeAxes(ArrayHeader& header, const Words& words) {
    glm::ivec3 size = words.integers(1);
    for (int i = 0; i < 3; ++i)
        if (size[i] < 1) header.fail("header", "expected one or more columns, rows and sections");
    const std::int32_t volumes = volumesOf(header, words, size);
    size.z /= volumes;
    const glm::ivec3 order = orderOf(header, words), first = words.integers(5);
    glm::ivec3 intervals = words.integers(8);
    for (int i = 0; i < 3; ++i)
        if (intervals[order[i]] < 1) intervals[order[i]] = size[i];
    const glm::dmat3 steps = stepsOf(header, words, intervals);
    glm::dvec3 origin = words.reals(50);
    if (origin == glm::dvec3(0) || !std::isfinite(origin.x + origin.y + origin.z)) {
        origin = glm::dvec3(0);
        for (int i = 0; i < 3; ++i) origin += static_cast<double>(first[i]) * steps[order[i]];
    }
    header.spaceDimension = 3;
    header.origin = {origin.x, origin.y, origin.z, 0};
    header.spaceUnits.fill("Å");
    for (int i = 0; i < 3; ++i) {
        ArrayAxis axis;
        axis.size = static_cast<std::uint64_t>(size[i]);
        axis.kind = ArrayKind::Space;
        const glm::dvec3& step = steps[order[i]];
        axis.direction = {step.x, step.y, step.z, 0};
        header.axes.push_back(std::move(axis));
    }
    if (volumes == 1) return;
    ArrayAxis list;
    list.size = static_cast<std::uint64_t>(volumes);
    list.kind = ArrayKind::List;
    header.axes.push_back(std::move(list));
}

}  // namespace

bool isMrc(std::string_view start) { return start.size() >= 212 && start.substr(208, 4) == "MAP "; }

ArrayHeader readMrcHeader(const std::filesystem::path& path) {
    ArrayHeader header;
    header.path = path;
    header.format = "MRC";
    header.name = "density";
    const Words words(header);
    header.swapped = words.swapped();
    header.type = typeOf(header, words);
    takeAxes(header, words);
    const std::int32_t extended = words.integer(24);
    if (extended < 0)
        header.fail("NSYMBT", fmt::format("expected 0 or more bytes, found {}", extended));
    header.headerBytes = kHeaderBytes + static_cast<std::uint64_t>(extended);
    return header;
}

}  // namespace timeseries
