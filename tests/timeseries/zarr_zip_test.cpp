// Zarr hierarchies in zip files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/read_variables.h"
#include "tests/support/zarr_store.h"
#include "tests/support/zip_file.h"

namespace timeseries::zarr_zip {
namespace {

using namespace tests;
using namespace tests::zarr;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using zip::Member;
using zip::zipOf;
using Path = std::filesystem::path;

const Layout kCube{.shape = {4, 4, 6}, .chunk = {2, 3, 4}};

float valueAt(const Lengths& at) {
    return static_cast<float>(100 * at[0] + 10 * at[1] + at[2]) / 7;
}

std::vector<float> expected() {
    std::vector<float> values;
    forEachAt(kCube.shape, [&](const Lengths& at) { values.push_back(valueAt(at)); });
    return values;
}

// A group with an array, of either version.
Path storeOf(int version) {
    Layout layout = kCube;
    if (version == 2) {
        const Path store = v2Group();
        put(store / "a b/v/.zarray", v2Array(layout, "<f4"));
        put(store / "a b/.zgroup", R"({"zarr_format": 2})");
        writeChunks<float>(store / "a b/v", layout, valueAt);
        return store;
    }
    layout.keyStart = "c";
    layout.separator = "/";
    const Path store = v3Group();
    put(store / "a b/zarr.json", R"({"zarr_format": 3, "node_type": "group"})");
    put(store / "a b/v/zarr.json", v3Array(layout, "float32"));
    writeChunks<float>(store / "a b/v", layout, valueAt);
    return store;
}

// A file beside the test's store.
Path written(const std::string& bytes, const std::string& name = "store.zarr.zip") {
    const Path file = testFolder() / name;
    writeBytes(file, bytes);
    return file;
}

// What opening a file, or reading its first step, says of it; "" when it is read.
std::string flawOf(const Path& file) {
    try {
        const auto reader = open(file);
        if (!reader->damaged().empty()) return reader->damaged()[0].why;
        reader->read(0, 0);
    } catch (const FileError& error) {
        return error.what();
    }
    return "";
}

TEST(ZarrZip, HoldsWhatItsFolderHolds) {
    for (const int version : {2, 3})
        for (const bool deflate : {false, true})
            for (const bool zip64 : {false, true})
                for (const std::string start : {"", "store.zarr/"}) {
                    const Path store = storeOf(version);
                    const Path file =
                        written(zipOf(zip::membersOf(store, start, deflate), {.zip64 = zip64}));
                    const auto reader = open(file);
                    EXPECT_EQ(reader->format(), fmt::format("Zarr v{} in a zip file", version));
                    EXPECT_TRUE(reader->damaged().empty());
                    EXPECT_EQ(valuesOf<float>(*reader, "a b/v"), expected())
                        << version << deflate << zip64 << start;
                    EXPECT_TRUE(isReadable(file));
                }
}

TEST(ZarrZip, ChunksThatAreNotThereAreTheFill) {
    const Path store = v2Group();
    put(store / "v/.zarray", v2Array(kCube, "<f4", {{"fill_value", "-2"}}));
    const auto reader = open(written(zipOf(zip::membersOf(store))));
    EXPECT_THAT(valuesOf<float>(*reader, "v"), testing::Each(-2.f));
}

// As Python's zipfile reads what zarr wrote twice.
TEST(ZarrZip, OfMembersOfOneNameTheLastCounts) {
    std::vector<Member> members = zip::membersOf(storeOf(2));
    members.insert(members.begin(), {"a b/v/0.0.0", std::string(96, 'x')});
    EXPECT_EQ(valuesOf<float>(*open(written(zipOf(members))), "a b/v"), expected());
}

TEST(ZarrZip, AnArrayAloneIsCalledAsItsFile) {
    const Path store = storeOf(3) / "a b/v";
    const auto reader = open(written(zipOf(zip::membersOf(store)), "alone.zarr.zip"));
    EXPECT_EQ(valuesOf<float>(*reader, "alone"), expected());
    // Nothing in it changes without the file.
    EXPECT_THAT(reader->sources(0, 0).files, ElementsAre(testFolder() / "alone.zarr.zip"));
    EXPECT_EQ(open(written(zipOf(zip::membersOf(store)), "b.zip"))->variables()[0].name, "b");
}

TEST(ZarrZip, SeveralAreOneSeries) {
    const Path folder = freshFolder();
    std::vector<Path> files;
    for (const int n : {0, 1}) {
        const Path store = folder / std::to_string(n);
        const Layout layout{.shape = {1, 2, 2, 2}, .chunk = {1, 2, 2, 2}};
        put(store / ".zgroup", R"({"zarr_format": 2})");
        put(store / "v/.zarray", v2Array(layout, "<f4"));
        put(store / "v/.zattrs", R"({"_ARRAY_DIMENSIONS": ["t", "z", "y", "x"]})");
        writeChunks<float>(store / "v", layout,
                           [&](const Lengths&) { return 5 + static_cast<float>(n); });
        putCoordinate(store, "t", {10.0 + n}, R"("units": "s")");
        files.push_back(written(zipOf(zip::membersOf(store)), fmt::format("{}.zarr.zip", n)));
    }
    const auto reader = openReader(files);
    EXPECT_THAT(timesOf(*reader), ElementsAre(10, 11));
    EXPECT_THAT(valuesOf<float>(*reader, "v", 0), testing::Each(5.f));
    EXPECT_THAT(valuesOf<float>(*reader, "v", 1), testing::Each(6.f));
}

// A shard of two chunks, of which parts are read.
Path shardStore(const std::string& shard) {
    const Path store = v3Group();
    const std::string bytes = R"([{"name": "bytes", "configuration": {"endian": "little"}}])";
    put(store / "v/zarr.json",
        v3Array({.shape = {2, 2, 2}, .chunk = {2, 2, 2}}, "uint8",
                {{"codecs", R"([{"name": "sharding_indexed", "configuration": {"chunk_shape": )"
                            R"([1, 2, 2], "codecs": )" +
                                bytes + R"(, "index_codecs": )" + bytes + "}}]"}}));
    put(store / "v/c/0/0/0", shard);
    return store;
}

TEST(ZarrZip, PartsOfAMemberAreRead) {
    std::string shard = "efghabcd";
    for (const int n : {4, 4, 0, 4}) shard += littleEndian(static_cast<std::uint64_t>(n), 8);
    for (const bool deflate : {false, true}) {
        const Path file = written(zipOf(zip::membersOf(shardStore(shard), "", deflate)));
        const auto values = valuesOf<std::uint8_t>(*open(file), "v");
        EXPECT_EQ(std::string(values.begin(), values.end()), "abcdefgh") << deflate;
    }
    // All of a member that is deflated is unpacked for a part of it: of one that is small enough.
    auto members = zip::membersOf(shardStore(std::string(300000, 'a')));
    for (Member& member : members)
        if (member.name == "v/c/0/0/0") {
            member.saidMethod = 8;
            member.saidSize = (std::uint64_t{1} << 28) + 1;
        }
    EXPECT_THAT(flawOf(written(zipOf(members))),
                HasSubstr("v/c/0/0/0: expected a member that is stored, or deflated from at most"));
}

TEST(ZarrZip, WhatAMemberSaysIsHeldAgainstTheFile) {
    // Of the chunk, or of the array's metadata.
    for (const std::string name : {"a b/v/0.0.0", "a b/v/.zarray"}) {
        const auto flawWith = [&](const std::function<void(Member&)>& change) {
            auto members = zip::membersOf(storeOf(2));
            const auto member = std::ranges::find(members, name, &Member::name);
            change(*member);
            return flawOf(written(zipOf(members)));
        };
        const auto expectFlaw = [&](const std::string& told,
                                    const std::function<void(Member&)>& change) {
            EXPECT_THAT(flawWith(change),
                        AllOf(HasSubstr("store.zarr.zip/" + name + ": "), HasSubstr(told)));
        };
        EXPECT_EQ(flawWith([](Member&) {}), "");
        expectFlaw("not encrypted", [](Member& m) { m.flags = 1; });
        expectFlaw("stored or deflated, found method 12", [](Member& m) { m.saidMethod = 12; });
        const std::uint64_t vast = std::uint64_t{1} << 60;
        expectFlaw("found 1152921504606846976", [&](Member& m) { m.saidSize = vast; });
        expectFlaw("found 1152921504606846976",
                   [&](Member& m) { m.saidSize = m.saidPacked = vast; });
        expectFlaw("found 1152921504606846976", [&](Member& m) {
            m.deflate = true;
            m.saidSize = vast;
        });
        expectFlaw("is whole", [](Member& m) { m.saidChecksum = 5; });
        expectFlaw("is whole", [](Member& m) {
            m.deflate = true;
            m.saidSize = m.bytes.size() + 1;
        });
        expectFlaw("is whole", [](Member& m) {
            m.deflate = true;
            m.saidSize = m.bytes.size() - 1;
        });
        expectFlaw("is whole", [](Member& m) { m.saidMethod = 8; });
    }
}

TEST(ZarrZip, CutAnywhereItIsRefused) {
    const std::string whole = zipOf(zip::membersOf(storeOf(2)));
    EXPECT_EQ(flawOf(written(whole)), "");
    for (std::size_t size = 4; size < whole.size(); ++size)
        ASSERT_THAT(flawOf(written(whole.substr(0, size))),
                    HasSubstr("store.zarr.zip: expected a whole zip file"))
            << size;
    // Of another name nobody can tell what it was.
    EXPECT_THAT(flawOf(written(whole.substr(0, whole.size() - 1), "store.zip")),
                HasSubstr("is a zip archive"));
}

TEST(ZarrZip, AListOfMoreMembersThanTheFileHoldsIsRefused) {
    const auto members = zip::membersOf(storeOf(2));
    for (const std::uint64_t count :
         {std::uint64_t{60000}, std::uint64_t{1} << 32, std::uint64_t{1} << 58})
        EXPECT_THAT(flawOf(written(zipOf(members, {.zip64 = count > 60000, .saidCount = count}))),
                    HasSubstr("store.zarr.zip: expected a whole zip file"));
}

TEST(ZarrZip, AFileOfOtherThingsIsNone) {
    EXPECT_THAT(flawOf(written(zipOf({{"words.txt", "words"}}), "words.zip")),
                HasSubstr("words.zip is a zip archive"));
    // Two hierarchies side by side are none.
    auto members = zip::membersOf(storeOf(2), "a/");
    for (const Member& member : zip::membersOf(storeOf(2), "b/")) members.push_back(member);
    EXPECT_THAT(flawOf(written(zipOf(members), "two.zip")), HasSubstr("two.zip is a zip archive"));
}

}  // namespace
}  // namespace timeseries::zarr_zip
