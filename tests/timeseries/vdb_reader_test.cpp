// OpenVDB files: what OpenVDB writes here is read again, voxel by voxel.
#include "timeseries/readers/arrays/vdb_reader.h"

#include <gmock/gmock.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <fstream>
#include <random>
#include <set>

#include "tests/support/files.h"
#include "tests/support/read_variables.h"
#include "tests/support/rounds.h"
#include "timeseries/readers/arrays/vdb_file.h"

namespace timeseries {
namespace {

using Path = std::filesystem::path;
using openvdb::Coord;

constexpr float kBackground = 7;

// Made by the library, which has all that grids of its types can do: a file that makes one itself
// compiles all of it once more, eight seconds a type.
template <typename GridType>
typename GridType::Ptr gridOf(const typename GridType::ValueType& background) {
    openvdb::initialize();
    auto grid = openvdb::gridPtrCast<GridType>(openvdb::GridBase::createGrid(GridType::gridType()));
    grid->tree().root().setBackground(background, false);
    return grid;
}

// A sphere of voxels of which no two have the same value, and nothing beside it.
template <typename GridType, typename ValueAt>
typename GridType::Ptr sphere(const char* name, const typename GridType::ValueType& background,
                              const ValueAt& valueAt) {
    auto grid = gridOf<GridType>(background);
    grid->setName(name);
    auto to = grid->getAccessor();
    for (int z = -2; z <= 9; ++z)
        for (int y = -6; y <= 5; ++y)
            for (int x = 3; x <= 14; ++x)
                if (std::hypot(x - 8.5, y + 0.5, z - 3.5) < 6)
                    to.setValue({x, y, z}, valueAt(x, y, z));
    return grid;
}
float valueAt(int x, int y, int z) { return static_cast<float>(100 + x + 20 * y + 500 * z); }
openvdb::FloatGrid::Ptr floats(const char* name = "density") {
    return sphere<openvdb::FloatGrid>(name, kBackground, valueAt);
}

Path written(const openvdb::GridCPtrVec& grids, const std::string& name = "file.vdb",
             bool tellsBoxes = true) {
    const Path path = tests::testFolder() / name;
    openvdb::io::File file(path.string());
    file.setGridStatsMetadataEnabled(tellsBoxes);
    file.write(grids);
    return path;
}
// Each point of a field has the value of the voxel whose middle lies there, another for each.
void expectVoxels(const Field& field, const openvdb::FloatGrid& grid) {
    const auto& values = std::get<std::vector<float>>(field.values);
    ASSERT_EQ(values.size(), field.grid->count());
    const auto from = grid.getConstAccessor();
    std::size_t active = 0;
    std::set<Coord> seen;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const glm::dvec3 at = field.grid->position(i);
        const openvdb::Vec3d voxel = grid.transform().worldToIndex({at.x, at.y, at.z});
        const Coord nearest = Coord::round(voxel);
        ASSERT_LT((voxel - nearest.asVec3d()).length(), 1e-5) << i;
        ASSERT_EQ(values[i], from.getValue(nearest)) << nearest;
        ASSERT_TRUE(seen.insert(nearest).second) << nearest;
        active += from.isValueOn(nearest);
    }
    EXPECT_EQ(active, grid.activeVoxelCount());
}

TEST(VdbReader, VoxelsLieWhereTheTransformSays) {
    const auto grid = floats();
    const auto box = grid->evalActiveVoxelBoundingBox();
    openvdb::Mat4d turned = openvdb::math::rotation<openvdb::Mat4d>(openvdb::math::Z_AXIS, 0.4);
    turned.postTranslate(openvdb::Vec3d(1, 2, 3));
    // Rows: what a step along each index is in space, and where index 0 lies.
    const auto affine = [](const std::array<double, 12>& rows) {
        openvdb::Mat4d map = openvdb::Mat4d::identity();
        for (int i = 0; i < 12; ++i) map[i / 3][i % 3] = rows[std::size_t(i)];
        return map;
    };
    const auto swapped = affine({0, 2, 0, 0, 0, -0.5, 3, 0, 0, 1, 2, 3});
    const auto sheared = affine({1, 0.2, 0, 0, 1, 0, 0.3, 0, 2, 0, 0, 0});
    const auto scaled = affine({0.5, 0, 0, 0, 0.25, 0, 0, 0, 0.125, 10, -4, 0.1});
    for (const openvdb::Mat4d& map :
         {openvdb::Mat4d::identity(), scaled, turned, swapped, sheared}) {
        grid->setTransform(openvdb::math::Transform::createLinearTransform(map));
        const auto reader = tests::open(written({grid}));
        EXPECT_EQ(reader->format(), "OpenVDB");
        const Variable& variable = reader->variables()[0];
        EXPECT_EQ(variable.name, "density");
        EXPECT_EQ(variable.type, ValueType::F32);
        EXPECT_EQ(variable.grid->count(), box.volume());
        expectVoxels(reader->read(0, 0), *grid);
    }
}

TEST(VdbReader, EachTypeIsItsOwn) {
    const auto whole = [](int x, int y, int z) { return std::int64_t(valueAt(x, y, z)); };
    const std::int64_t beyond = (std::int64_t{1} << 53) + 1;
    const auto path = written(
        {sphere<openvdb::DoubleGrid>("d", 0.1,
                                     [](int x, int y, int z) { return valueAt(x, y, z) / 3.0; }),
         sphere<openvdb::Int32Grid>("i", -3,
                                    [&](int x, int y, int z) { return int(whole(x, y, z)); }),
         sphere<openvdb::Int64Grid>("l", beyond,
                                    [&](int x, int y, int z) { return whole(x, y, z) + beyond; }),
         sphere<openvdb::BoolGrid>("b", false, [](int x, int y, int) { return (x + y) % 2 == 0; }),
         sphere<openvdb::Vec3SGrid>("v", openvdb::Vec3s(0, 3, 4), [](int x, int y, int z) {
             return openvdb::Vec3s(float(x), float(y), float(z));
         })});
    const auto reader = tests::open(path);
    std::map<std::string, std::pair<ValueType, std::size_t>> types;
    for (std::size_t v = 0; v < reader->variables().size(); ++v)
        types[reader->variables()[v].name] = {reader->variables()[v].type, v};
    using testing::FieldsAre;
    EXPECT_THAT(types, testing::ElementsAre(
                           testing::Pair("b", FieldsAre(ValueType::U8, testing::_)),
                           testing::Pair("d", FieldsAre(ValueType::F64, testing::_)),
                           testing::Pair("i", FieldsAre(ValueType::I32, testing::_)),
                           testing::Pair("l", FieldsAre(ValueType::I64, testing::_)),
                           testing::Pair("v magnitude", FieldsAre(ValueType::F64, testing::_)),
                           testing::Pair("v[0]", FieldsAre(ValueType::F32, testing::_)),
                           testing::Pair("v[1]", FieldsAre(ValueType::F32, testing::_)),
                           testing::Pair("v[2]", FieldsAre(ValueType::F32, testing::_))));
    const auto expectAt = [&](const char* name, const auto& expected, const auto& background) {
        using T = std::decay_t<decltype(background)>;
        const Field field = reader->read(types[name].second, 0);
        const auto& values = std::get<std::vector<T>>(field.values);
        ASSERT_EQ(values.size(), 12u * 12 * 12) << name << ": the sphere's box";
        for (std::size_t i = 0; i < values.size(); ++i) {
            const glm::ivec3 at = glm::round(field.grid->position(i));
            const bool is = std::hypot(at.x - 8.5, at.y + 0.5, at.z - 3.5) < 6;
            ASSERT_EQ(values[i], is ? static_cast<T>(expected(at.x, at.y, at.z)) : background)
                << name;
        }
    };
    expectAt(
        "d", [](int x, int y, int z) { return valueAt(x, y, z) / 3.0; }, 0.1);
    expectAt("i", whole, std::int32_t{-3});
    expectAt(
        "l", [&](int x, int y, int z) { return whole(x, y, z) + beyond; }, beyond);
    expectAt(
        "b", [](int x, int y, int) { return (x + y) % 2 == 0; }, std::uint8_t{0});
    expectAt(
        "v[1]", [](int, int y, int) { return y; }, 3.0f);
    expectAt(
        "v magnitude", [](int x, int y, int z) { return std::sqrt(double(x * x + y * y + z * z)); },
        5.0);
}

// Of two steps the box that holds both, which a file opened alone has not.
TEST(VdbReader, SeveralFilesAreStepsInOneBox) {
    const auto one = floats(), other = floats();
    other->getAccessor().setValue({30, 0, 0}, 5);
    const Path first = written({one}, "step_1.vdb"), second = written({other}, "step_2.vdb");
    const std::array both{first, second};
    const auto reader = openReader(both);
    EXPECT_EQ(reader->variables()[0].time->points.size(), 2u);
    // The sphere's from 3 on, and the voxel at 30.
    EXPECT_EQ(reader->variables()[0].grid->size(),
              (std::array<std::size_t, 3>{30 - 3 + 1, 12, 12}));
    expectVoxels(reader->read(0, 0), *one);
    expectVoxels(reader->read(0, 1), *other);
    EXPECT_EQ(tests::open(first)->variables()[0].grid->size(),
              (std::array<std::size_t, 3>{12, 12, 12}));
}

TEST(VdbReader, FilesWithoutBoxesAndHalfFloatsAreReadAlike) {
    const auto grid = floats();
    expectVoxels(tests::open(written({grid}, "bare.vdb", false))->read(0, 0), *grid);
    grid->setSaveFloatAsHalf(true);  // which holds these whole numbers up to 2048
    for (auto value = grid->beginValueOn(); value; ++value)
        value.setValue(std::fmod(std::abs(*value), 2000.0f));
    const auto reader = tests::open(written({grid}, "half.vdb"));
    EXPECT_THAT(reader->variables()[0].storedAs, testing::StartsWith("16-bit floats"));
    expectVoxels(reader->read(0, 0), *grid);
}

TEST(VdbReader, WhatIsNotReadIsTold) {
    EXPECT_THAT(tests::refusalOfRead(written({})),
                testing::EndsWith("file.vdb: expected a grid, found none"));
    EXPECT_THAT(tests::refusalOfRead(written({gridOf<openvdb::FloatGrid>(1)})),
                testing::HasSubstr("expected active voxels, found none"));
    auto frustum = floats("eye");
    frustum->setTransform(openvdb::math::Transform::createFrustumTransform(
        openvdb::BBoxd({0, 0, 0}, {10, 10, 10}), 0.5, 10, 1));
    EXPECT_THAT(
        tests::refusalOfRead(written({frustum})),
        testing::HasSubstr("grid 'eye': expected voxels that lie along straight axes, found a "
                           "frustum"));
    auto points = openvdb::GridBase::createGrid("Tree_ptdataidx32_5_4_3");
    points->setName("points");
    const auto grid = floats();
    const auto reader = tests::open(written({points, grid}));
    EXPECT_EQ(reader->variables().size(), 1u);
    ASSERT_EQ(reader->damaged().size(), 1u);
    EXPECT_THAT(
        reader->damaged()[0].why,
        testing::HasSubstr("grid 'points': expected numbers or vectors of three, found a "));
    auto tile = gridOf<openvdb::FloatGrid>(1);
    tile->fill(openvdb::CoordBBox({0, 0, 0}, {1023, 1023, 1023}), 2.0f);
    EXPECT_THAT(tests::refusalOfRead(written({tile})),
                testing::HasSubstr("voxels a byte of the file, found a box of 1073741824"));
    auto far = gridOf<openvdb::FloatGrid>(1);
    far->getAccessor().setValue({0, 0, 0}, 1);
    far->getAccessor().setValue({1 << 30, 0, 0}, 1);
    EXPECT_THAT(tests::refusalOfRead(written({far})),
                testing::HasSubstr("expected at most 2^32 voxels, found 1073741825 x 1 x 1"));
}

// Boxes are believed only as far as the voxels agree.
TEST(VdbReader, ABoxThatLiesIsTold) {
    const auto grid = floats();
    grid->insertMeta("file_bbox_min", openvdb::Vec3IMetadata({5, 0, 0}));
    grid->insertMeta("file_bbox_max", openvdb::Vec3IMetadata({8, 2, 2}));
    EXPECT_THAT(tests::refusalOfRead(written({grid}, "lies.vdb", false)),
                testing::HasSubstr("expected active voxels that fill the box of its metadata"));
}

// Cut anywhere, or with bytes that are wrong, a file is read or refused in one sentence.
// Wherever it ends: OpenVDB takes what stands in memory for the last values of a leaf.
TEST(VdbReader, AFileThatIsCutIsRefused) {
    const Path path = tests::testFolder() / "cut.vdb";
    const auto few = gridOf<openvdb::FloatGrid>(kBackground);
    for (int i = 0; i < 40; ++i) few->getAccessor().setValue({i % 8, i / 8, 2}, 1.5f + float(i));
    few->setName("few");
    constexpr std::size_t kStep =
        tests::kSanitized ? 8 * 997 : 4 * 997;  // each is tried by a process
    for (const std::uint32_t packing :
         {0u + openvdb::io::COMPRESS_NONE, 0u + openvdb::io::COMPRESS_ACTIVE_MASK,
          0u + openvdb::io::COMPRESS_ZIP + openvdb::io::COMPRESS_ACTIVE_MASK}) {
        openvdb::io::File file((tests::testFolder() / "whole.vdb").string());
        file.setCompression(packing);
        file.write(openvdb::GridCPtrVec{few});
        const std::string whole = tests::readBytes(tests::testFolder() / "whole.vdb");
        for (std::size_t cut = 1; cut < whole.size(); cut += cut < 40 ? 1 : kStep) {
            tests::writeBytes(path, whole.substr(0, whole.size() - cut));
            EXPECT_THROW(tests::open(path)->read(0, 0), FileError) << cut << " bytes, " << packing;
        }
    }
}

TEST(VdbReader, DamagedFilesAreRefusedOrRead) {
    const Path whole = written({floats()}), path = tests::testFolder() / "damaged.vdb";
    std::ifstream from(whole, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(from), {}};
    std::mt19937 random(5);
    // Whether it was refused.
    const auto expectOneSentence = [&](const std::string& damaged) {
        tests::writeBytes(path, damaged);
        const std::string told = tests::refusalOfRead(path);
        if (told.empty()) return false;
        EXPECT_THAT(told, testing::StartsWith(path.string()));
        EXPECT_EQ(told.find('\n'), told.npos) << told;
        return true;
    };
    for (int n = 0; n < tests::rounds(16); ++n)
        EXPECT_TRUE(expectOneSentence(bytes.substr(0, random() % bytes.size()))) << n;
    for (std::size_t at = 0; at < 8; ++at) {  // by which the format is told
        std::string damaged = bytes;
        damaged[at] = static_cast<char>(damaged[at] ^ 1);
        EXPECT_TRUE(expectOneSentence(damaged)) << at;
    }
    for (int n = 0; n < tests::rounds(40); ++n) {
        std::string damaged = bytes;
        for (int k = 0; k <= n % 3; ++k)  // most of what is wrong lies in the header
            damaged[random() % (n % 2 == 0 ? 1200 : bytes.size())] = static_cast<char>(random());
        expectOneSentence(damaged);
    }
}

}  // namespace
}  // namespace timeseries
