#include "timeseries/readers/arrays/vdb_file.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <mutex>
#include <type_traits>

#include "timeseries/readers/arrays/vdb_archive.h"
#include "timeseries/readers/forked_call.h"
#include "timeseries/readers/limits.h"

namespace timeseries {
namespace {

using ReadGrids = openvdb::TypeList<openvdb::FloatGrid, openvdb::DoubleGrid, openvdb::Int32Grid,
                                    openvdb::Int64Grid, openvdb::BoolGrid, openvdb::Vec3SGrid,
                                    openvdb::Vec3DGrid, openvdb::Vec3IGrid>;

// How a voxel's value is kept: numbers of a type, so many.
template <typename T>
struct Voxel {
    using Number = T;
    using Kept = T;
    static constexpr std::uint64_t kNumbers = 1;
};
template <>
struct Voxel<bool> {
    using Number = std::uint8_t;
    using Kept = std::uint8_t;
    static constexpr std::uint64_t kNumbers = 1;
};
template <typename T>
struct Voxel<openvdb::math::Vec3<T>> {
    using Number = T;
    using Kept = openvdb::math::Vec3<T>;
    static constexpr std::uint64_t kNumbers = 3;
};

openvdb::CoordBBox boxOf(const VdbBox& box) {
    return {openvdb::Coord(box.first.data()), openvdb::Coord(box.last.data())};
}
VdbBox boxOf(const openvdb::Coord& first, const openvdb::Coord& last) {
    return {{first.x(), first.y(), first.z()}, {last.x(), last.y(), last.z()}};
}

// What the file says of the box of its active voxels; none where it does not.
std::optional<VdbBox> toldBox(const openvdb::GridBase& grid) {
    const auto least =
        grid.getMetadata<openvdb::Vec3IMetadata>(openvdb::GridBase::META_FILE_BBOX_MIN);
    const auto most =
        grid.getMetadata<openvdb::Vec3IMetadata>(openvdb::GridBase::META_FILE_BBOX_MAX);
    if (!least || !most) return std::nullopt;
    return boxOf(openvdb::Coord(least->value()), openvdb::Coord(most->value()));
}

void initialize() {
    static std::once_flag once;
    std::call_once(once, [] { openvdb::initialize(); });
}

// This process may take so many bytes more than it has; none are told of a length that lies.
void allowMemory(std::uint64_t bytes) {
    std::ifstream taken("/proc/self/statm");
    std::uint64_t pages = 0;
    if (!(taken >> pages)) return;
    const rlim_t most = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) + bytes;
    const rlimit limit{most, most};
    setrlimit(RLIMIT_AS, &limit);
}

// On one line.
std::string saysOf(const std::exception& error) {
    std::string says = error.what();
    std::ranges::replace(says, '\n', ' ');
    return says;
}

}  // namespace

std::array<std::uint64_t, 3> VdbBox::size() const {
    std::array<std::uint64_t, 3> size{};
    for (std::size_t a = 0; a < 3; ++a)
        size[a] = static_cast<std::uint64_t>(
            std::max(std::int64_t{last[a]} - std::int64_t{first[a]} + 1, std::int64_t{0}));
    return size;
}

std::optional<std::uint64_t> VdbBox::count() const {
    std::uint64_t count = 1;
    for (const std::uint64_t side : size()) {
        if (side == 0 || side > kMaxAxis || count > kMaxPoints / side) return std::nullopt;
        count *= side;
    }
    return count;
}

void VdbBox::add(const VdbBox& other) {
    for (std::size_t a = 0; a < 3; ++a) {
        first[a] = std::min(first[a], other.first[a]);
        last[a] = std::max(last[a], other.last[a]);
    }
}

VdbFile::VdbFile(const std::filesystem::path& path, Header header) : path_(path) {
    initialize();
    const auto read = [this] { readHeader(); };
    if (header == Header::New) tryInCopy("header", 0, read);
    told("header", read);
}

void VdbFile::fail(std::string_view place, std::string_view what) const {
    throw FileError(fmt::format("{}: {}: {}", path_.string(), place, what));
}

void VdbFile::tryInCopy(std::string_view place, std::uint64_t more,
                        const std::function<void()>& work) const {
    constexpr std::chrono::seconds kMostTime(30);
    constexpr std::uint64_t kUnpacked = 256, kBeside = std::uint64_t{256} << 20;
    std::error_code unknown;
    const auto fileBytes = std::filesystem::file_size(path_, unknown);
    const std::string end = endOfForked(
        [&] {
            allowMemory((unknown ? 0 : kUnpacked * fileBytes) + kBeside + more);
            try {
                work();
            } catch (const std::bad_alloc&) {
                std::abort();
            }
        },
        kMostTime);
    if (!end.empty()) fail(place, "expected what OpenVDB can read, but OpenVDB " + end);
}

void VdbFile::told(std::string_view place, const std::function<void()>& work) const {
    try {
        work();
    } catch (const openvdb::Exception& error) {
        fail(place,
             fmt::format("expected what OpenVDB can read, but OpenVDB says \"{}\"", saysOf(error)));
    } catch (const std::ios_base::failure&) {
        fail(place, "expected what OpenVDB can read, but the file ends before");
    } catch (const std::bad_alloc&) {
        fail(place, "expected what memory holds, but there is not as much of it");
    } catch (const std::length_error& error) {
        fail(place,
             fmt::format("expected what OpenVDB can read, but OpenVDB says \"{}\"", saysOf(error)));
    }
}

void VdbFile::readHeader() {
    VdbArchive archive(path_);
    openvdb::io::File file(path_.string());
    file.open(false);
    const std::uint64_t bytes = file.getSize();
    std::vector<std::string> names;
    for (auto name = file.beginName(); name != file.endName(); ++name)
        names.push_back(name.gridName());
    for (const std::string& name : names) {
        const auto refuse = [&](std::string_view what) {
            damaged_.push_back(
                {name, fmt::format("{}: grid '{}': {}", path_.string(), name, what)});
        };
        // Without its voxels, where the file tells their box.
        openvdb::GridBase::Ptr grid = file.readGridMetadata(name);
        VdbGrid found{.name = name, .type = grid->type(), .isHalf = grid->saveFloatAsHalf()};
        found.kind = openvdb::GridBase::gridClassToString(grid->getGridClass());
        const bool isRead = grid->apply<ReadGrids>([&](const auto& typed) {
            using Kind = Voxel<typename std::decay_t<decltype(typed)>::ValueType>;
            found.value =
                static_cast<ValueType>(Values(std::vector<typename Kind::Number>()).index());
            found.numbers = Kind::kNumbers;
        });
        if (!isRead) {
            refuse(fmt::format("expected numbers or vectors of three, found a {}", found.type));
            continue;
        }
        if (!grid->transform().isLinear()) {
            refuse("expected voxels that lie along straight axes, found a frustum");
            continue;
        }
        if (const auto told = toldBox(*grid)) {
            found.box = *told;
        } else {
            const openvdb::CoordBBox box = archive.read(name)->evalActiveVoxelBoundingBox();
            found.box = boxOf(box.min(), box.max());
        }
        if (!found.box.count()) {
            const auto sides = found.box.size();
            refuse(sides[0] * sides[1] * sides[2] == 0
                       ? std::string("expected active voxels, found none")
                       : fmt::format("expected at most 2^32 voxels, found {} x {} x {}", sides[0],
                                     sides[1], sides[2]));
            continue;
        }
        // Tiles of a few bytes may stand for any number of voxels.
        constexpr std::uint64_t kVoxelsAByte = 1 << 12, kAlways = 1 << 26;
        if (*found.box.count() > kAlways + kVoxelsAByte * bytes) {
            refuse(fmt::format("expected at most {} voxels a byte of the file, found a box of {}",
                               kVoxelsAByte, *found.box.count()));
            continue;
        }
        // Rows, which a place is multiplied by from the left.
        const openvdb::Mat4d map = grid->transform().baseMap()->getAffineMap()->getMat4();
        for (int i = 0; i < 4; ++i)
            for (int c = 0; c < 3; ++c) (i < 3 ? found.steps[i] : found.origin)[c] = map[i][c];
        grids_.push_back(std::move(found));
    }
}

Values VdbFile::read(const VdbGrid& of, const VdbBox& box) const {
    const std::string place = fmt::format("grid '{}'", of.name);
    Values values;
    const std::uint64_t most = sizeof(double) * of.numbers * *box.count();
    const auto work = [&] {
        const openvdb::GridBase::Ptr grid = VdbArchive(path_).read(of.name);
        // Before so much memory is taken.
        const openvdb::CoordBBox active = grid->evalActiveVoxelBoundingBox();
        if (boxOf(active.min(), active.max()) != of.box)
            fail(place, "expected active voxels that fill the box of its metadata, found others");
        const bool isRead = grid->apply<ReadGrids>([&](const auto& typed) {
            using Kind = Voxel<typename std::decay_t<decltype(typed)>::ValueType>;
            using Number = typename Kind::Number;
            std::vector<Number> numbers(*box.count() * Kind::kNumbers);
            openvdb::tools::Dense<typename Kind::Kept, openvdb::tools::LayoutXYZ> dense(
                boxOf(box), reinterpret_cast<typename Kind::Kept*>(numbers.data()));
            openvdb::tools::copyToDense(typed, dense, /*serial=*/true);
            values = std::move(numbers);
        });
        if (!isRead) fail(place, "expected the type that it had, found another");
    };
    tryInCopy(place, most, work);
    told(place, work);
    return values;
}

}  // namespace timeseries
