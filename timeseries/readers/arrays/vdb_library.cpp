// libisochron_vdb.so: what the program has of OpenVDB.
#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include "timeseries/readers/arrays/vdb_archive.h"
#include "timeseries/readers/arrays/vdb_library.h"

namespace timeseries {
namespace {

using Path = std::filesystem::path;

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

[[noreturn]] void fail(const Path& path, std::string_view place, std::string_view what) {
    throw FileError(fmt::format("{}: {}: {}", path.string(), place, what));
}
[[noreturn]] void failAs(const Path& path, std::string_view place, const std::exception& error) {
    std::string says = error.what();
    std::ranges::replace(says, '\n', ' ');
    fail(path, place, fmt::format("expected what OpenVDB can read, but OpenVDB says \"{}\"", says));
}

// work(), of which what OpenVDB throws becomes a FileError.
template <typename Work>
auto withOpenVdb(const Path& path, std::string_view place, const Work& work) {
    try {
        initialize();
        return work();
    } catch (const openvdb::Exception& error) {
        failAs(path, place, error);
    } catch (const std::ios_base::failure&) {
        fail(path, place, "expected what OpenVDB can read, but the file ends before");
    } catch (const std::length_error& error) {
        failAs(path, place, error);
    }
}

VdbContents readContents(const Path& path) {
    VdbContents contents;
    VdbArchive archive(path);
    openvdb::io::File file(path.string());
    file.open(false);
    const std::uint64_t bytes = file.getSize();
    std::vector<std::string> names;
    for (auto name = file.beginName(); name != file.endName(); ++name)
        names.push_back(name.gridName());
    for (const std::string& name : names) {
        const auto refuse = [&](std::string_view what) {
            contents.damaged.push_back(
                {name, fmt::format("{}: grid '{}': {}", path.string(), name, what)});
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
        contents.grids.push_back(std::move(found));
    }
    return contents;
}

Values readValues(const Path& path, const VdbGrid& of, const VdbBox& box, std::string_view place) {
    Values values;
    const openvdb::GridBase::Ptr grid = VdbArchive(path).read(of.name);
    // Before so much memory is taken.
    const openvdb::CoordBBox active = grid->evalActiveVoxelBoundingBox();
    if (boxOf(active.min(), active.max()) != of.box)
        fail(path, place, "expected active voxels that fill the box of its metadata, found others");
    const bool isRead = grid->apply<ReadGrids>([&](const auto& typed) {
        using Kind = Voxel<typename std::decay_t<decltype(typed)>::ValueType>;
        using Number = typename Kind::Number;
        std::vector<Number> numbers(*box.count() * Kind::kNumbers);
        openvdb::tools::Dense<typename Kind::Kept, openvdb::tools::LayoutXYZ> dense(
            boxOf(box), reinterpret_cast<typename Kind::Kept*>(numbers.data()));
        openvdb::tools::copyToDense(typed, dense, /*serial=*/true);
        values = std::move(numbers);
    });
    if (!isRead) fail(path, place, "expected the type that it had, found another");
    return values;
}

}  // namespace
}  // namespace timeseries

const timeseries::VdbLibrary isochronVdb{
    .contents =
        [](const std::filesystem::path& path) {
            return timeseries::withOpenVdb(path, "header",
                                           [&] { return timeseries::readContents(path); });
        },
    .read =
        [](const std::filesystem::path& path, const timeseries::VdbGrid& grid,
           const timeseries::VdbBox& box) {
            const std::string place = fmt::format("grid '{}'", grid.name);
            return timeseries::withOpenVdb(
                path, place, [&] { return timeseries::readValues(path, grid, box, place); });
        },
};
