// What OME-NGFF says of Zarr arrays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/read_variables.h"
#include "tests/support/zarr_store.h"

namespace timeseries::zarr_images {
namespace {

using namespace tests;
using namespace tests::zarr;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr const char* kAxes =
    R"([{"name": "t", "type": "time", "unit": "second"}, {"name": "c", "type": "channel"},)"
    R"( {"name": "z", "type": "space", "unit": "micrometer"},)"
    R"( {"name": "y", "type": "space", "unit": "micrometer"},)"
    R"( {"name": "x", "type": "space", "unit": "micrometer"}])";

std::string dataset(const std::string& path, const std::string& scale,
                    const std::string& translation) {
    return fmt::format(R"({{"path": "{}", "coordinateTransformations": [{{"type": "scale", )"
                       R"("scale": {}}}, {{"type": "translation", "translation": {}}}]}})",
                       path, scale, translation);
}

void putLevel(const std::filesystem::path& folder, const Lengths& shape, bool isV3) {
    const Layout layout{
        .shape = shape, .chunk = shape, .keyStart = isV3 ? "c" : "", .separator = "/"};
    put(folder / (isV3 ? "zarr.json" : ".zarray"),
        isV3 ? v3Array(layout, "uint16")
             : v2Array(layout, "<u2", {{"dimension_separator", "\"/\""}}));
    writeChunks<std::uint16_t>(folder, layout, digitsOf<std::uint16_t>);
}

// Version 0.5 says the same as 0.4 under another name.
TEST(ZarrConventions, ImagesOfOmeAreResolutionsAndChannels) {
    for (const bool isV3 : {false, true}) {
        const std::string said = fmt::format(
            R"("multiscales": [{{"axes": {}, "datasets": [{}, {}], "coordinateTransformations": )"
            R"([{{"type": "scale", "scale": [30, 1, 2, 1, 1]}}]}}], "omero": {{"channels": )"
            R"([{{"label": "DAPI"}}, {{}}]}})",
            kAxes, dataset("0", "[1, 1, 2, 0.5, 0.25]", "[0, 0, 10, 0, 0]"),
            dataset("1", "[1, 1, 2, 1, 0.5]", "[0, 0, 10, 0.25, 0.125]"));
        const auto store =
            isV3 ? v3Group(R"({"ome": {"version": "0.5", )" + said + "}}") : v2Group();
        if (!isV3) put(store / ".zattrs", "{" + said + "}");
        putLevel(store / "0", {2, 2, 2, 4, 6}, isV3);
        putLevel(store / "1", {2, 2, 2, 2, 3}, isV3);
        const auto reader = open(store);
        ASSERT_THAT(namesOf(*reader),
                    ElementsAre("0 DAPI", "0 channel 1", "1 DAPI", "1 channel 1"));
        const Variable& fine = reader->variables()[0];
        const auto& axes = fine.grid->axes();
        EXPECT_EQ(axes[0], (Axis{"x", "micrometer", {0, 0.25, 0.5, 0.75, 1, 1.25}, false}));
        EXPECT_EQ(axes[1], (Axis{"y", "micrometer", {0, 0.5, 1, 1.5}, false}));
        EXPECT_EQ(axes[2], (Axis{"z", "micrometer", {20, 24}, false}));
        EXPECT_THAT(timesOf(*reader), ElementsAre(0, 30));
        EXPECT_EQ(fine.time->units, "second");
        EXPECT_THAT(fine.notes, IsEmpty());
        EXPECT_EQ(reader->variables()[2].grid->axes()[0],
                  (Axis{"x", "micrometer", {0.125, 0.625, 1.125}, false}));
        EXPECT_THAT(valuesOf<std::uint16_t>(*reader, "1 channel 1", 1),
                    ElementsAre(11000, 11001, 11002, 11010, 11011, 11012, 11100, 11101, 11102,
                                11110, 11111, 11112));
        // The array alone.
        const auto one = open(store / "1");
        EXPECT_THAT(namesOf(*one), ElementsAre("1 DAPI", "1 channel 1"));
        EXPECT_EQ(one->variables()[0].grid->axes()[2].coordinates, (std::vector<double>{20, 24}));
    }
}

TEST(ZarrConventions, LabelsOfOmeAreCategories) {
    const auto store = v2Group();
    put(store / ".zattrs",
        R"({"multiscales": [{"axes": ["z", "y", "x"], "datasets": [{"path": "s 0", )"
        R"("coordinateTransformations": [{"type": "scale", "scale": [5, 1, 1]}]}]}]})");
    putLevel(store / "s 0", {2, 3, 4}, false);
    put(store / "labels/.zgroup", "{}");
    put(store / "labels/the cells/.zgroup", "{}");
    put(store / "labels/the cells/.zattrs",
        R"({"image-label": {}, "multiscales": [{"axes": ["z", "y", "x"], "datasets": )"
        R"([{"path": "0", "coordinateTransformations": [{"type": "scale", "scale": [3, 2, 1]}]}]}]})");
    putLevel(store / "labels/the cells/0", {2, 3, 4}, false);
    const auto reader = open(store);
    ASSERT_THAT(namesOf(*reader), ElementsAre("s 0", "labels/the cells/0"));
    EXPECT_FALSE(reader->variables()[0].categories);
    EXPECT_EQ(reader->variables()[0].grid->axes()[2].coordinates, (std::vector<double>{0, 5}));
    EXPECT_TRUE(reader->variables()[1].categories);
    EXPECT_EQ(reader->variables()[1].grid->axes()[2].coordinates, (std::vector<double>{0, 3}));
}

TEST(ZarrConventions, AxesOfOmeAreWhatTheirTypesSay) {
    const auto store = v2Group();
    put(store / ".zattrs",
        R"({"multiscales": [{"axes": [{"name": "frame", "type": "time"}, {"name": "row", "type": )"
        R"("space"}, {"name": "column", "type": "space"}], "datasets": [{"path": "0", )"
        R"("coordinateTransformations": [{"type": "scale", "scale": [1, 2, 3]}]}]}]})");
    putLevel(store / "0", {3, 2, 4}, false);
    const auto reader = open(store);
    EXPECT_EQ(reader->variables()[0].grid->size(), (std::array<std::size_t, 3>{4, 2, 1}));
    EXPECT_EQ(reader->variables()[0].time->points.size(), 3u);
    EXPECT_TRUE(reader->variables()[0].time->counted);  // for want of a unit
}

TEST(ZarrConventions, ChannelsOfOneNameAreNumbered) {
    const auto store = v2Group();
    put(store / ".zattrs", R"({"multiscales": [{"datasets": [{"path": "0"}]}], "omero": )"
                           R"({"channels": [{"label": "a"}, {"label": "a"}, {"label": "b"}]}})");
    putLevel(store / "0", {1, 3, 2, 3, 4}, false);
    EXPECT_THAT(namesOf(*open(store)), ElementsAre("0 a", "0 channel 1", "0 b"));
}

// Before version 0.3 the axes are t, c, z, y, x; a transformation that is not read places nothing.
TEST(ZarrConventions, OldImagesOfOmeHaveFiveAxes) {
    const auto store = v2Group();
    for (const std::string transformations :
         {"", R"(, "coordinateTransformations": [{"type": "affine", "affine": [[1]]}])"}) {
        put(store / ".zattrs",
            R"({"multiscales": [{"datasets": [{"path": "0"}])" + transformations + "}]}");
        putLevel(store / "0", {3, 1, 2, 3, 4}, false);
        const auto reader = open(store);
        ASSERT_THAT(namesOf(*reader), ElementsAre("0"));
        EXPECT_EQ(reader->variables()[0].time->points.size(), 3u);
        EXPECT_TRUE(reader->variables()[0].time->counted);
        EXPECT_EQ(reader->variables()[0].grid->size(), (std::array<std::size_t, 3>{4, 3, 2}));
        EXPECT_EQ(reader->variables()[0].grid->axes()[0].units, "index");
    }
    put(store / ".zattrs", R"({"multiscales": [{"datasets": [)" +
                               dataset("0", "[1, 1, 2, 2, 2]", "[0, 0, 0, 0, 0]") +
                               R"(], "coordinateTransformations": [{"type": "affine"}]}]})");
    EXPECT_EQ(open(store)->variables()[0].grid->axes()[0].units, "index");
}

}  // namespace
}  // namespace timeseries::zarr_images
