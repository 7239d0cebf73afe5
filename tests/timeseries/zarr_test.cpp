// Zarr hierarchies of both versions: types, orders, codecs, chunks, what is missing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>

#include "tests/support/read_variables.h"
#include "tests/support/zarr_steps.h"
#include "timeseries/index/sorted_step.h"
#include "timeseries/readers/zarr/zarr_hierarchy.h"

namespace timeseries::zarr {
namespace {

using namespace tests;
using namespace tests::zarr;
using testing::ElementsAre;
using testing::HasSubstr;

template <typename T>
void expectBothVersions(const std::string& code, const std::string& name) {
    for (const bool bigEndian : {false, true}) {
        Layout layout = kLayout;
        layout.bigEndian = bigEndian;
        std::filesystem::path store = v2Group();
        put(store / "v/.zarray", v2Array(layout, (sizeof(T) == 1 ? '|'
                                                  : bigEndian    ? '>'
                                                                 : '<') +
                                                     code));
        writeChunks<T>(store / "v", layout, valueAt<T>);
        expectStepsRead<T>(store, code + (bigEndian ? " big" : " little"));

        layout.keyStart = "c";
        layout.separator = "/";
        store = v3Group();
        put(store / "v/zarr.json",
            v3Array(layout, name,
                    {{"codecs", fmt::format(R"([{{"name": "bytes", "configuration": {{"endian": )"
                                            R"("{}"}}}}])",
                                            bigEndian ? "big" : "little")}}));
        writeChunks<T>(store / "v", layout, valueAt<T>);
        expectStepsRead<T>(store, name + (bigEndian ? " big" : " little"));
    }
}

// Chunks of several steps are unpacked once, but for those that were written since.
TEST(Zarr, ChunksThatAreWrittenAnewAreReadAnew) {
    const auto store = v2Group();
    put(store / "v/.zarray", v2Array(kLayout, "<i4"));
    writeChunks<std::int32_t>(store / "v", kLayout, valueAt<std::int32_t>);
    const auto reader = open(store);
    EXPECT_EQ(valuesOf<std::int32_t>(*reader, "v", 0), expected<std::int32_t>(kLayout.shape, 0));
    const auto other = [](const Lengths& at) { return ~valueAt<std::int32_t>(at); };
    writeChunks<std::int32_t>(store / "v", kLayout, other);
    for (const auto& file : std::filesystem::directory_iterator(store / "v"))
        std::filesystem::last_write_time(file, file.last_write_time() + std::chrono::seconds(1));
    std::vector<std::int32_t> anew = expected<std::int32_t>(kLayout.shape, 1);
    for (std::int32_t& value : anew) value = ~value;
    EXPECT_EQ(valuesOf<std::int32_t>(*reader, "v", 1), anew);
}

TEST(Zarr, NumbersOfAllTypesAndByteOrdersAreTheFiles) {
    expectBothVersions<std::int8_t>("i1", "int8");
    expectBothVersions<std::int16_t>("i2", "int16");
    expectBothVersions<std::int32_t>("i4", "int32");
    expectBothVersions<std::int64_t>("i8", "int64");
    expectBothVersions<std::uint8_t>("u1", "uint8");
    expectBothVersions<std::uint16_t>("u2", "uint16");
    expectBothVersions<std::uint32_t>("u4", "uint32");
    expectBothVersions<std::uint64_t>("u8", "uint64");
    expectBothVersions<float>("f4", "float32");
    expectBothVersions<double>("f8", "float64");
}

struct Packer {
    std::string name;
    Pack pack;
};
const std::vector<Packer> kPackers{{"zlib", byZlib}, {"gzip", byGzip},   {"bz2", byBzip2},
                                   {"zstd", byZstd}, {"blosc", byBlosc}, {"lz4", byLz4}};

TEST(Zarr, ChunksThatAnyCompressorPackedAreUnpacked) {
    for (const Packer& packer : kPackers) {
        Layout layout = kLayout;
        layout.pack = packer.pack;
        std::filesystem::path store = v2Group();
        put(store / "v/.zarray",
            v2Array(layout, "<f4",
                    {{"compressor", fmt::format(R"({{"id": "{}"}})", packer.name)}}));
        writeChunks<float>(store / "v", layout, valueAt<float>);
        expectStepsRead<float>(store, packer.name);

        // With a checksum before and behind it.
        layout.pack = [&](const std::string& bytes) {
            return withCrc32c(packer.pack(withCrc32c(bytes)));
        };
        layout.keyStart = "c";
        layout.separator = "/";
        store = v3Group();
        const std::string codecs = fmt::format(
            R"([{{"name": "bytes", "configuration": {{"endian": "little"}}}}, {{"name": "crc32c"}},)"
            R"( {{"name": "{}"}}, "crc32c"])",
            packer.name);
        put(store / "v/zarr.json", v3Array(layout, "float32", {{"codecs", codecs}}));
        writeChunks<float>(store / "v", layout, valueAt<float>);
        expectStepsRead<float>(store, packer.name);
    }
}

TEST(Zarr, AGzipFileMayHaveSeveralMembers) {
    Layout layout = kLayout;
    layout.pack = [](const std::string& bytes) {
        return byGzip(bytes.substr(0, 17)) + byGzip(bytes.substr(17));
    };
    const auto store = v2Group();
    put(store / "v/.zarray", v2Array(layout, "<f4", {{"compressor", R"({"id": "gzip"})"}}));
    writeChunks<float>(store / "v", layout, valueAt<float>);
    expectStepsRead<float>(store, "two members");
}

TEST(Zarr, ChunksOfAnyOrderAreTurned) {
    Layout layout = kLayout;
    layout.order = {3, 2, 1, 0};
    std::filesystem::path store = v2Group();
    put(store / "v/.zarray", v2Array(layout, "<i2", {{"order", "\"F\""}}));
    writeChunks<std::int16_t>(store / "v", layout, valueAt<std::int16_t>);
    expectStepsRead<std::int16_t>(store, "F");

    // Dimension i of what is stored is dimension order[i] of the array; then again.
    const auto v3 = [&](const std::string& transposes) {
        store = v3Group();
        layout.keyStart = "c";
        layout.separator = "/";
        put(store / "v/zarr.json",
            v3Array(
                layout, "int16",
                {{"codecs", "[" + transposes +
                                R"({"name": "bytes", "configuration": {"endian": "little"}}])"}}));
        writeChunks<std::int16_t>(store / "v", layout, valueAt<std::int16_t>);
        expectStepsRead<std::int16_t>(store, transposes);
    };
    const auto transpose = [](const std::string& order) {
        return R"({"name": "transpose", "configuration": {"order": )" + order + "}}, ";
    };
    layout.order = {1, 3, 0, 2};
    v3(transpose("[1, 3, 0, 2]"));
    layout.order = {3, 0, 2, 1};
    v3(transpose("[1, 3, 0, 2]") + transpose("[1, 2, 3, 0]"));
}

TEST(Zarr, ChunksHaveTheNamesThatTheirArraySays) {
    for (const std::string separator : {".", "/"}) {
        Layout layout = kLayout;
        layout.separator = separator;
        std::filesystem::path store = v2Group();
        put(store / "v/.zarray",
            v2Array(layout, "<f4", {{"dimension_separator", '"' + separator + '"'}}));
        writeChunks<float>(store / "v", layout, valueAt<float>);
        expectStepsRead<float>(store, "v2 " + separator);
        for (const std::string name : {"default", "v2"}) {
            layout.keyStart = name == "v2" ? "" : "c";
            store = v3Group();
            put(store / "v/zarr.json",
                v3Array(layout, "float32",
                        {{"chunk_key_encoding",
                          fmt::format(R"({{"name": "{}", "configuration": {{"separator": "{}"}}}})",
                                      name, separator)}}));
            writeChunks<float>(store / "v", layout, valueAt<float>);
            expectStepsRead<float>(store, name + separator);
        }
    }
}

// A shard is chunks behind each other, here in reverse and with something between them, and an
// index.
std::string shardOf(const Layout& layout, const Lengths& shard, const Lengths& perShard,
                    bool indexFirst, bool checked, const Lengths* missing) {
    std::map<Lengths, std::pair<std::uint64_t, std::uint64_t>> where;
    std::size_t count = 1;
    for (const std::size_t along : perShard) count *= along;
    const std::size_t indexBytes = 16 * count + (checked ? 4 : 0);
    std::vector<Lengths> chunks;
    forEachAt(perShard, [&](const Lengths& at) { chunks.push_back(at); });
    std::string bytes, index;
    for (auto within = chunks.rbegin(); within != chunks.rend(); ++within) {
        Lengths chunk = *within;
        for (std::size_t d = 0; d < chunk.size(); ++d) chunk[d] += shard[d] * perShard[d];
        if (missing && chunk == *missing) continue;
        const std::string packed =
            layout.pack(chunkOf<std::int32_t>(layout, chunk, valueAt<std::int32_t>));
        where[*within] = {bytes.size() + (indexFirst ? indexBytes : 0), packed.size()};
        bytes += packed + "between";
    }
    for (const Lengths& within : chunks) {
        const auto found = where.find(within);
        const std::uint64_t none = ~std::uint64_t{0};
        index += littleEndian(found == where.end() ? none : found->second.first, 8) +
                 littleEndian(found == where.end() ? none : found->second.second, 8);
    }
    if (checked) index = withCrc32c(index);
    return indexFirst ? index + bytes : bytes + index;
}

TEST(Zarr, ShardsHoldChunksWhereTheirIndexSays) {
    const Lengths perShard{1, 2, 1, 3};
    for (const bool first : {false, true})
        for (const bool checked : {false, true}) {
            Layout layout = kLayout;
            layout.pack = byZstd;
            Lengths shape = layout.chunk, shards;
            for (std::size_t d = 0; d < 4; ++d) {
                shape[d] *= perShard[d];
                shards.push_back((layout.shape[d] + shape[d] - 1) / shape[d]);
            }
            const auto store = v3Group();
            const std::string bytes = R"({"name": "bytes", "configuration": {"endian": "little"}})";
            const std::string codec = fmt::format(
                R"([{{"name": "sharding_indexed", "configuration": {{"chunk_shape": {}, )"
                R"("codecs": [{}, {{"name": "zstd"}}], "index_codecs": [{}{}], )"
                R"("index_location": "{}"}}}}])",
                listed(layout.chunk), bytes, bytes, checked ? R"(, {"name": "crc32c"})" : "",
                first ? "start" : "end");
            Layout outer = layout;
            outer.chunk = shape;
            put(store / "v/zarr.json",
                v3Array(outer, "int32", {{"codecs", codec}, {"fill_value", "-5"}}));
            const Lengths missing{0, 1, 0, 1};
            forEachAt(shards, [&](const Lengths& shard) {
                put(store / "v" / fmt::format("c/{}", fmt::join(shard, "/")),
                    shardOf(layout, shard, perShard, first, checked, &missing));
            });
            std::filesystem::remove(store / "v/c/1/0/0/0");
            const auto reader = open(store);
            for (const std::size_t step : {0, 1, 2}) {
                auto values = expected<std::int32_t>(kLayout.shape, step);
                std::size_t i = 0;
                forEachAt({5, 4, 7}, [&](const Lengths& at) {
                    const bool isMissing = step < 2 && at[0] / 2 == 1 && at[1] < 3 && at[2] >= 4;
                    const bool inShard = step == 2 && at[0] < 4 && at[1] < 3;
                    if (isMissing || inShard) values[i] = -5;
                    ++i;
                });
                EXPECT_EQ(valuesOf<std::int32_t>(*reader, "v", step), values)
                    << first << checked << step;
            }
        }
}

TEST(Zarr, ChunksThatAreNotThereAreTheFill) {
    for (const auto& [fill, filled] : std::vector<std::pair<std::string, float>>{
             {"null", 0},
             {"-3.5", -3.5f},
             {"7", 7},
             {"\"Infinity\"", HUGE_VALF},
             {"3.4028235e38", std::numeric_limits<float>::max()}}) {  // a little more, as a double
        const float value = filled;
        Layout layout = kLayout;
        layout.isWritten = [](const Lengths& chunk) { return chunk != Lengths{0, 1, 0, 1}; };
        const auto store = v2Group();
        put(store / "v/.zarray", v2Array(layout, "<f4", {{"fill_value", fill}}));
        writeChunks<float>(store / "v", layout, valueAt<float>);
        auto values = expected<float>(layout.shape, 1);
        std::size_t i = 0;
        forEachAt({5, 4, 7}, [&](const Lengths& at) {
            if (at[0] / 2 == 1 && at[1] < 3 && at[2] >= 4) values[i] = value;
            ++i;
        });
        const auto reader = open(store);
        EXPECT_EQ(valuesOf<float>(*reader, "v", 1), values) << fill;
        // A value, for nobody says that it stands for none.
        EXPECT_TRUE(reader->read(0, 1).missing.empty());
        EXPECT_EQ(valuesOf<float>(*reader, "v", 2), expected<float>(layout.shape, 2)) << fill;
    }
}

TEST(Zarr, BitsOfAFloatMayBeTheFill) {
    Layout layout{.shape = {2, 2, 2}, .chunk = {2, 2, 2}};
    const auto store = v3Group();
    put(store / "v/zarr.json", v3Array(layout, "float32", {{"fill_value", "\"0xc0200000\""}}));
    EXPECT_THAT(valuesOf<float>(*open(store), "v"), testing::Each(-2.5f));
    put(store / "v/zarr.json", v3Array(layout, "uint64", {{"fill_value", "18446744073709551615"}}));
    EXPECT_THAT(valuesOf<std::uint64_t>(*open(store), "v"), testing::Each(~std::uint64_t{0}));
}

TEST(Zarr, ASlabIsAPartOfItsStep) {
    const auto store = v2Group();
    put(store / "v/.zarray", v2Array(kLayout, "<i4"));
    writeChunks<std::int32_t>(store / "v", kLayout, valueAt<std::int32_t>);
    const auto reader = open(store);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<std::int32_t> values;
        forEachAt({5, 4, 7}, [&](const Lengths& at) {
            if (at[2 - axis] >= 1 && at[2 - axis] < 3)
                values.push_back(valueAt<std::int32_t>({2, at[0], at[1], at[2]}));
        });
        const Field slab = reader->slab(0, 2, {axis, 1, 2});
        EXPECT_EQ(std::get<std::vector<std::int32_t>>(slab.values), values) << axis;
    }
}

// A step is read though another one's chunks are damaged.
TEST(Zarr, OnlyTheChunksThatAStepTouchesAreRead) {
    const auto store = v2Group();
    put(store / "v/.zarray", v2Array(kLayout, "<i4"));
    writeChunks<std::int32_t>(store / "v", kLayout, valueAt<std::int32_t>);
    put(store / "v/1.0.0.0", "x");
    const auto reader = open(store);
    EXPECT_EQ(valuesOf<std::int32_t>(*reader, "v", 1), expected<std::int32_t>(kLayout.shape, 1));
    EXPECT_THROW(reader->read(0, 2), FileError);
}

TEST(Zarr, ASelectionIsWhatAFilterFinds) {
    const auto store = v2Group();
    Layout layout{.shape = {1, 20, 30, 40}, .chunk = {1, 7, 30, 11}, .pack = byBlosc};
    put(store / "v/.zarray", v2Array(layout, "<f4", {{"compressor", R"({"id": "blosc"})"}}));
    writeChunks<float>(store / "v", layout, valueAt<float>);
    const auto reader = open(store);
    const SortedStep step = SortedStep::build(reader->read(0, 0));
    const RangeSet ranges = RangeSet::parse("9300:9500, [10000, 10500), > 12000");
    std::uint64_t count = 0;
    forEachAt(layout.shape, [&](const Lengths& at) {
        const double v = valueAt<float>(at);
        count += (v >= 9300 && v <= 9500) || (v >= 10000 && v < 10500) || v > 12000;
    });
    EXPECT_GT(count, 1000u);
    EXPECT_EQ(step.count(ranges), count);
}

}  // namespace
}  // namespace timeseries::zarr
