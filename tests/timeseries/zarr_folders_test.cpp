// Zarr stores as files among others: by which names they are opened, and what they are called.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/zarr_steps.h"
#include "timeseries/readers/series_files.h"

namespace timeseries::zarr {
namespace {

using namespace tests;
using namespace tests::zarr;
using testing::ElementsAre;

TEST(ZarrFolders, AFolderIsOneDataSetHoweverItIsNamed) {
    const auto store = v2Group();
    put(store / ".zattrs", "{}");
    put(store / ".zmetadata", "{}");
    for (const char* name : {"a", "b"}) {
        put(store / name / ".zarray", v2Array(kLayout, "<f4"));
        writeChunks<float>(store / name, kLayout, valueAt<float>);
    }
    for (const std::filesystem::path& path :
         {store, store / "", store / ".zgroup", store / ".zattrs", store / ".zmetadata"}) {
        const auto series = expandSeries(std::span(&path, 1));
        EXPECT_THAT(series.files, ElementsAre(path));
        EXPECT_EQ(openReader(series.files)->variables().size(), 2u) << path;
        EXPECT_TRUE(isReadable(path)) << path;
    }
    for (const std::filesystem::path& path : {store / "a", store / "a" / "", store / "a/.zarray"}) {
        const auto reader = openReader(expandSeries(std::span(&path, 1)).files);
        ASSERT_EQ(reader->variables().size(), 1u) << path;
        EXPECT_EQ(reader->variables()[0].name, "a");
        EXPECT_EQ(reader->format(), "Zarr v2");
    }
    EXPECT_FALSE(isReadable(store / "a/0.0.0.0"));
    EXPECT_FALSE(isReadable(store.parent_path()));
}

TEST(ZarrFolders, AnArrayAloneIsCalledAsItsFolder) {
    const auto store = freshFolder() / "alone.zarr";
    put(store / "zarr.json", v3Array(kLayout, "float32"));
    Layout layout = kLayout;
    layout.keyStart = "c";
    layout.separator = "/";
    writeChunks<float>(store, layout, valueAt<float>);
    expectStepsRead<float>(store, "alone");
    EXPECT_EQ(open(store)->variables()[0].name, "alone");
    EXPECT_EQ(open(store)->format(), "Zarr v3");
    // Chunks may be written over without any sign of it in the folder itself.
    EXPECT_TRUE(open(store)->sources(0, 0).files.empty());
}

}  // namespace
}  // namespace timeseries::zarr
