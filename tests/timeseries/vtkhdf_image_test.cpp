// VTKHDF files of images: where their points lie, steps, rows of numbers, ghosts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/support/hdf_file.h"
#include "tests/support/read_variables.h"

namespace timeseries::vtkhdf_image {
namespace {

using namespace tests;
using testing::ElementsAre;
using testing::HasSubstr;
using Numbers = std::vector<std::int64_t>;

constexpr std::size_t kX = 4, kY = 3, kZ = 2;
const glm::dvec3 kOrigin{10, 20, 30}, kSpacing{0.5, 2, 3};
const glm::dvec3 kFirst{2, -1, 5};  // index

class ImageFile : public HdfFile {
 public:
    explicit ImageFile(const std::vector<double>& direction = {}, bool inTime = false)
        : inTime_(inTime) {
        say("VTKHDF", "Type", std::string("ImageData"));
        say("VTKHDF", "Version", Numbers{2, 0});
        say("VTKHDF", "WholeExtent", Numbers{2, 2 + kX - 1, -1, -1 + kY - 1, 5, 5 + kZ - 1});
        say("VTKHDF", "Origin", std::vector<double>{kOrigin.x, kOrigin.y, kOrigin.z});
        say("VTKHDF", "Spacing", std::vector<double>{kSpacing.x, kSpacing.y, kSpacing.z});
        if (!direction.empty()) say("VTKHDF", "Direction", direction);
    }
    // Of value(step, x, y, z, component), 3 steps in time.
    template <typename T>
    void image(const std::string& name, const std::array<std::size_t, 3>& size,
               std::size_t components,
               const std::function<T(std::size_t, std::size_t, std::size_t, std::size_t,
                                     std::size_t)>& value) {
        std::vector<T> values;
        const std::size_t steps = inTime_ ? 3 : 1;
        for (std::size_t t = 0; t < steps; ++t)
            for (std::size_t z = 0; z < size[2]; ++z)
                for (std::size_t y = 0; y < size[1]; ++y)
                    for (std::size_t x = 0; x < size[0]; ++x)
                        for (std::size_t c = 0; c < components; ++c)
                            values.push_back(value(t, x, y, z, c));
        std::vector<std::size_t> lengths{size[2], size[1], size[0]};
        if (inTime_) lengths.insert(lengths.begin(), steps);
        if (components > 1) lengths.push_back(components);
        put("VTKHDF/" + name, values, lengths);
    }

 private:
    bool inTime_;
};

float numberOf(std::size_t t, std::size_t x, std::size_t y, std::size_t z, std::size_t c) {
    return float(10000 * t + 1000 * c + 100 * z + 10 * y + x);
}
const std::array<std::size_t, 3> kPoints{kX, kY, kZ}, kCells{kX - 1, kY - 1, kZ - 1};

// Each point's value is where the file's formula puts it.
void expectPlaces(const Field& field, const glm::dmat3& directions,
                  const std::array<std::size_t, 3>& size, double middle) {
    const auto& values = std::get<std::vector<float>>(field.values);
    ASSERT_EQ(values.size(), size[0] * size[1] * size[2]);
    ASSERT_EQ(field.grid->count(), values.size());
    for (std::uint64_t i = 0; i < values.size(); ++i) {
        const int value = int(values[i]);
        const glm::dvec3 index{value % 10, value / 10 % 10, value / 100 % 10};
        const glm::dvec3 at =
            kOrigin + directions * (kSpacing * (index + kFirst + glm::dvec3(middle)));
        // Of axes that are turned, positions are in space.
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(field.grid->position(i)[c], at[c], 1e-9) << value;
    }
}

TEST(VtkHdfImage, PointsLieWhereOriginSpacingAndDirectionSay) {
    const double s = std::sqrt(0.5);
    for (const std::vector<double>& rows :
         std::vector<std::vector<double>>{{},
                                          {1, 0, 0, 0, 1, 0, 0, 0, 1},
                                          {0, 0, 1, 1, 0, 0, 0, 1, 0},    // other axes
                                          {-1, 0, 0, 0, 1, 0, 0, 0, -1},  // backwards
                                          {s, -s, 0, s, s, 0, 0, 0, 1}})  // turned
    {
        glm::dmat3 directions(1);
        for (int r = 0; r < 3 && !rows.empty(); ++r)
            for (int c = 0; c < 3; ++c) directions[c][r] = rows[std::size_t(3 * r + c)];
        ImageFile file(rows);
        file.image<float>("PointData/p", kPoints, 1, numberOf);
        file.image<float>("CellData/c", kCells, 1, numberOf);
        const auto reader = open(file.close());
        EXPECT_EQ(reader->format(), "VTKHDF image");
        expectPlaces(reader->read(indexOf(*reader, "p"), 0), directions, kPoints, 0);
        expectPlaces(reader->read(indexOf(*reader, "c"), 0), directions, kCells, 0.5);
        EXPECT_EQ(reader->sources(0, 0).files.size(), 1u);
    }
}

TEST(VtkHdfImage, StepsStandBehindEachOtherOrWhereOffsetsSay) {
    ImageFile file({}, true);
    file.image<float>("PointData/p", kPoints, 1, numberOf);
    file.image<float>("PointData/q", kPoints, 1, numberOf);
    file.put("VTKHDF/Steps/Values", std::vector<double>{0.5, 1, 4});
    file.put("VTKHDF/Steps/PointDataOffsets/q", Numbers{2, 0, 0});
    const auto reader = open(file.close());
    EXPECT_THAT(timesOf(*reader), ElementsAre(0.5, 1, 4));
    for (const std::size_t step : {2, 0, 1}) {
        EXPECT_EQ(valuesOf<float>(*reader, "p", step)[5], numberOf(step, 1, 1, 0, 0));
        EXPECT_EQ(valuesOf<float>(*reader, "q", step)[5], numberOf(step == 0 ? 2 : 0, 1, 1, 0, 0));
    }
}

TEST(VtkHdfImage, RowsAreTheirNumbersAndGhostsAreMissing) {
    ImageFile file({0, 0, 1, 1, 0, 0, 0, 1, 0});  // turned, and so are the flags
    file.image<float>("PointData/v", kPoints, 3, numberOf);
    file.image<std::uint8_t>(
        "PointData/vtkGhostType", kPoints, 1,
        [](std::size_t, std::size_t x, std::size_t y, std::size_t, std::size_t) {
            return std::uint8_t(x == 1 && y == 2 ? 2 : x == 2 ? 8 : 0);
        });
    file.put("VTKHDF/FieldData/TimeValue", std::vector<double>{7});
    const auto reader = open(file.close());
    EXPECT_THAT(timesOf(*reader), ElementsAre(7));
    const Field field = reader->read(indexOf(*reader, "v[1]"), 0);
    const auto& values = std::get<std::vector<float>>(field.values);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const int value = int(values[i]);
        EXPECT_EQ(value / 1000, 1);
        EXPECT_EQ(field.missing[i], value % 10 == 1 && value / 10 % 10 == 2) << value;
    }
    EXPECT_DOUBLE_EQ(valuesOf<double>(*reader, "v magnitude")[0], std::hypot(0, 1000, 2000));
}

// Those of a column of cells, which is the last along x, in the second step alone.
TEST(VtkHdfImage, PointsOfGhostCellsAloneAreMissing) {
    ImageFile file({0, 0, 1, 1, 0, 0, 0, 1, 0}, true);
    file.image<float>("PointData/p", kPoints, 1, numberOf);
    file.image<std::uint8_t>(
        "CellData/vtkGhostType", kCells, 1,
        [](std::size_t t, std::size_t x, std::size_t, std::size_t, std::size_t) {
            return std::uint8_t(t == 1 && x == kX - 2 ? 32 : 16);
        });
    file.put("VTKHDF/Steps/Values", std::vector<double>{0, 1, 2});
    const auto reader = open(file.close());
    for (const std::size_t step : {0, 1, 2}) {
        const Field field = reader->read(0, step);
        const auto& values = std::get<std::vector<float>>(field.values);
        for (std::size_t i = 0; i < values.size(); ++i)
            EXPECT_EQ(!field.missing.empty() && field.missing[i],
                      step == 1 && int(values[i]) % 10 == kX - 1)
                << values[i];
    }
    EXPECT_EQ(reader->variables()[0].missing, "ghost and blanked, by vtkGhostType");
}

TEST(VtkHdfImage, WhatIsNoWholeImageIsRefused) {
    const auto told = [](const std::function<void(ImageFile&)>& change) {
        ImageFile file;
        file.image<float>("PointData/p", kPoints, 1, numberOf);
        change(file);
        return tests::refusalOf(file.close());
    };
    using File = ImageFile&;
    EXPECT_EQ(told([](File) {}), "");
    EXPECT_THAT(told([](File f) {
                    f.say("VTKHDF", "Origin", std::vector<double>{1, 2});
                }),
                HasSubstr("VTKHDF: expected 3 numbers of Origin, found 2"));
    EXPECT_THAT(told([](File f) {
                    f.say("VTKHDF", "Spacing", std::vector<double>{1, NAN, 2});
                }),
                HasSubstr("expected 3 numbers of Spacing, found 0"));
    for (const Numbers& extent : {Numbers{0, -1, 0, 1, 0, 1}, Numbers{0, 1ll << 40, 0, 1, 0, 1}})
        EXPECT_THAT(told([&](File f) { f.say("VTKHDF", "WholeExtent", extent); }),
                    HasSubstr("expected a WholeExtent of 1 to 2^24 points along each axis"));
    const Numbers vast{0, 1 << 20, 0, 1 << 20, 0, 1 << 20};
    EXPECT_THAT(told([&](File f) { f.say("VTKHDF", "WholeExtent", vast); }),
                HasSubstr("expected at most 2^32 points"));
    EXPECT_THAT(told([](File f) {
                    f.say("VTKHDF", "WholeExtent", Numbers{0, 3, 0, 2, 0, 2});
                }),
                HasSubstr("'VTKHDF/PointData/p': expected 3, 3, 4 numbers, found 2, 3, 4"));
    EXPECT_THAT(told([](File f) {
                    f.put("VTKHDF/Steps/Values", std::vector<double>{1, 2});
                }),
                HasSubstr("expected steps of 2, 3, 4 numbers, found 2, 3, 4"));
    // Offsets beyond the array's steps.
    ImageFile file({}, true);
    file.image<float>("PointData/p", kPoints, 1, numberOf);
    file.put("VTKHDF/Steps/Values", std::vector<double>{1, 2, 3});
    file.put("VTKHDF/Steps/PointDataOffsets/p", Numbers{0, 3, -1});
    const auto reader = open(file.close());
    EXPECT_NO_THROW(reader->read(0, 0));
    EXPECT_THROW(reader->read(0, 1), FileError);
    EXPECT_THROW(reader->read(0, 2), FileError);
}

}  // namespace
}  // namespace timeseries::vtkhdf_image
