// Zarr hierarchies that say what is not there, what is not read, or what would take all memory.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/read_variables.h"
#include "tests/support/zarr_store.h"

namespace timeseries::zarr_damaged {
namespace {

using namespace tests;
using namespace tests::zarr;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using Members = std::map<std::string, std::string>;

const Layout kCube{.shape = {4, 4, 4}, .chunk = {2, 4, 4}};

float indexOf3(const Lengths& at) { return static_cast<float>(16 * at[0] + 4 * at[1] + at[2]); }

// Why an array of such metadata is not read; "" when it is.
std::string v2Refusal(const Members& members, const std::string& attributes = "{}") {
    const auto store = v2Group();
    put(store / "v/.zarray", v2Array(kCube, "<f4", members));
    put(store / "v/.zattrs", attributes);
    return refusalOf(store);
}
std::string v3Refusal(const Members& members) {
    const auto store = v3Group();
    put(store / "v/zarr.json", v3Array(kCube, "float32", members));
    return refusalOf(store);
}

TEST(DamagedZarr, WhatIsNotReadOfVersion2IsNamed) {
    for (const auto& [members, told] : std::vector<std::pair<Members, std::string>>{
             {{{"dtype", "\"<f2\""}},
              "dtype: expected integers of 8 to 64 bits, float32 or "
              "float64, found <f2"},
             {{{"dtype", "\"<M8[M]\""}},
              "times: expected them in W, D, h, m, s, ms, us or ns, found \"M\""},
             {{{"dtype", "\"<m8[0s]\""}}, "times: expected them in"},
             {{{"dtype", "\"|M8[s]\""}}, "found |M8[s]"},
             {{{"dtype", "\"<M8\""}}, "found <M8"},
             {{{"dtype", "\"|b1\""}}, "found |b1"},
             {{{"dtype", R"([["a", "<f4"]])"}}, R"(found [["a","<f4"]])"},
             {{{"dtype", "\"f4\""}}, "found f4"},
             {{{"dtype", "\"\""}}, "dtype: expected"},
             {{{"compressor", R"({"id": "lzma"})"}},
              "compressor: expected none, zlib, gzip, bz2, "
              "zstd, lz4 or blosc, found lzma"},
             {{{"compressor", "7"}}, "found none"},
             {{{"filters", R"([{"id": "delta"}])"}}, "filters: expected none, found delta"},
             {{{"order", "\"A\""}}, "order: expected C or F, found A"},
             {{{"chunks", "[2, 4]"}}, "chunks: expected 3 lengths greater than 0, found [2,4]"},
             {{{"chunks", "[2, 0, 4]"}}, "chunks: expected 3 lengths greater than 0"},
             {{{"chunks", "[2, -4, 4]"}}, "chunks: expected 3 lengths greater than 0"},
             {{{"chunks", "[4611686018427387904, 4, 4]"}}, "expected a chunk of at most"},
             {{{"chunks", "[1000000, 1000000, 1000000]"}}, "expected a chunk of at most"},
             {{{"chunks", "[4294967296, 4294967296, 4294967296]"}}, "expected a chunk of at most"},
             {{{"fill_value", "\"none\""}}, "fill_value: expected a value of float32, found none"},
             {{{"fill_value", "1e300"}}, "fill_value: expected a value of float32, found 1e+300"},
             {{{"fill_value", "300"}, {"dtype", "\"|u1\""}},
              "expected a value of uint8, found 300"},
             {{{"fill_value", "1.5"}, {"dtype", "\"|u1\""}},
              "expected a value of uint8, found 1.5"},
             {{{"dimension_separator", "\"../\""}},
              "dimension_separator: expected . or /, found "
              "../"},
             {{{"shape", "[4, 4, 4.5]"}}, "shape: expected a list of whole numbers"},
             {{{"shape", "7"}}, "shape: expected a list of whole numbers, found 7"},
             {{{"shape", "[9223372036854775808, 4, 4]"}}, "lengths of at most 2^62"},
             {{{"shape", "[1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1]"}},
              "at most 32 dimensions, found 33"},
         })
        EXPECT_THAT(v2Refusal(members), AllOf(HasSubstr("store.zarr/v: "), HasSubstr(told)));
    EXPECT_THAT(
        v2Refusal({}, R"({"_ARRAY_DIMENSIONS": ["x", "y"]})"),
        HasSubstr("_ARRAY_DIMENSIONS: expected 3 names of dimensions, found [\"x\",\"y\"]"));
    EXPECT_EQ(v2Refusal({}), "");
}

TEST(DamagedZarr, WhatIsNotReadOfVersion3IsNamed) {
    const std::string bytes = R"({"name": "bytes", "configuration": {"endian": "little"}})";
    const auto codecs = [](const std::string& list) { return Members{{"codecs", list}}; };
    const auto shards = [&](const std::string& chunk, const std::string& inner,
                            const std::string& index, const std::string& more = "") {
        return codecs(R"([{"name": "sharding_indexed", "configuration": {"chunk_shape": )" + chunk +
                      R"(, "codecs": )" + inner + R"(, "index_codecs": )" + index + more + "}}]");
    };
    for (const auto& [members, told] : std::vector<std::pair<Members, std::string>>{
             {{{"data_type", "\"float16\""}},
              "data_type: expected integers of 8 to 64 bits, "
              "float32 or float64, found float16"},
             {{{"data_type", R"({"name": "numpy.void"})"}}, "found numpy.void"},
             {{{"data_type", R"({"name": "numpy.datetime64"})"}}, "times: expected them in"},
             {codecs("[]"), "codecs: expected bytes, found none"},
             {codecs("7"), "codecs: expected a list, found 7"},
             {codecs(R"([{"name": "bytes"}])"), "endian: expected little or big, found none"},
             {codecs("[" + bytes + R"(, {"name": "zfpy"}])"), "behind bytes, found zfpy"},
             {codecs("[" + bytes + R"(, "zstd", "gzip"])"), "one that compresses, found several"},
             {codecs(R"([{"name": "transpose", "configuration": {"order": [0, 0, 1]}}, )" + bytes +
                     "]"),
              "codec transpose: order: expected each dimension once, found [0,0,1]"},
             {codecs(R"([{"name": "transpose", "configuration": {"order": "F"}}, )" + bytes + "]"),
              "expected each dimension once, found F"},
             {shards("[2, 3, 4]", "[" + bytes + "]", "[" + bytes + "]"), "shards of whole chunks"},
             {codecs(R"([{"name": "sharding_indexed"}, "gzip"])"), "none beside sharding_indexed"},
             {shards("[1, 1]", "[" + bytes + "]", "[" + bytes + "]"), "expected 3 lengths"},
             {shards("[1, 1, 1]", "[" + bytes + "]", "[" + bytes + R"(, "gzip"])"),
              "index_codecs: expected bytes and crc32c alone"},
             {shards("[1, 1, 1]", "[" + bytes + "]", "[]"), "index_codecs: expected bytes"},
             {shards("[1, 1, 1]", "[" + bytes + "]", "[" + bytes + "]",
                     R"(, "index_location": "middle")"),
              "index_location: expected end or start, found middle"},
             {{{"chunk_grid", R"({"name": "rectilinear"})"}},
              "expected regular, found rectilinear"},
             {{{"chunk_key_encoding", R"({"name": "other"})"}}, "default or v2, found other"},
             {{{"chunk_key_encoding",
                R"({"name": "default", "configuration": {"separator": "/../"}})"}},
              "separator: expected . or /, found /../"},
             {{{"dimension_names", "[1, 2, 3]"}}, "dimension_names: expected 3 names"},
             {{{"storage_transformers", R"([{"name": "other"}])"}}, "expected none, found [{"},
             {{{"fill_value", "\"0x12\""}}, "fill_value: expected a value of float32, found 0x12"},
             {{{"node_type", "\"table\""}}, "node_type: expected array or group, found table"},
         })
        EXPECT_THAT(v3Refusal(members), HasSubstr(told));
    EXPECT_EQ(v3Refusal({}), "");
    // Shards of 2^60 chunks have no index that anybody could read.
    Members vast = shards("[1, 1, 1]", "[" + bytes + "]", "[" + bytes + "]");
    vast["chunk_grid"] =
        R"({"name": "regular", "configuration": {"chunk_shape": [1048576, 1048576, 1048576]}})";
    EXPECT_THAT(v3Refusal(vast), HasSubstr("at most 1048576 in each"));
}

TEST(DamagedZarr, OneThatIsNotReadCostsOnlyItself) {
    const auto store = v2Group();
    for (const char* name : {"a", "half", "none"}) {
        put(store / name / ".zarray", v2Array(kCube, name == std::string("half") ? "<f2" : "<f4"));
        writeChunks<float>(store / name, kCube, indexOf3);
    }
    put(store / "none/.zarray", "{not JSON");
    const auto reader = open(store);
    EXPECT_EQ(reader->variables().size(), 1u);
    ASSERT_EQ(reader->damaged().size(), 2u);
    EXPECT_EQ(reader->damaged()[0].name, "none");
    EXPECT_THAT(reader->damaged()[0].why, HasSubstr("none/.zarray: expected a JSON object"));
    EXPECT_EQ(reader->damaged()[1].name, "half");
    EXPECT_TRUE(open(store / "a")->damaged().empty());
    EXPECT_THAT(refusalOf(store / "half"), HasSubstr("found <f2"));
}

TEST(DamagedZarr, ACoordinateThatIsNotReadCostsWhatItPlaces) {
    const auto store = v2Group();
    putCoordinate(store, "x", {0, 1, 2, 3});
    for (const auto& [name, dimensions] : std::vector<std::pair<std::string, std::string>>{
             {"placed", R"(["z", "y", "x"])"}, {"free", R"(["c", "b", "a"])"}}) {
        put(store / name / ".zarray", v2Array(kCube, "<f4"));
        put(store / name / ".zattrs", R"({"_ARRAY_DIMENSIONS": )" + dimensions + "}");
        writeChunks<float>(store / name, kCube, indexOf3);
    }
    EXPECT_EQ(open(store)->variables().size(), 2u);
    const auto expectLeftOut = [&](const std::string& why) {
        const auto reader = open(store);
        EXPECT_EQ(reader->variables().size(), 1u) << why;
        ASSERT_EQ(reader->damaged().size(), 1u) << why;
        EXPECT_EQ(reader->damaged()[0].name, "placed");
        EXPECT_THAT(reader->damaged()[0].why, HasSubstr(why));
    };
    put(store / "x/0", "too few");
    expectLeftOut("x/0: expected 32 bytes, found 7");
    put(store / "x/.zarray",
        v2Array({.shape = {4}, .chunk = {4}}, "<f8", {{"compressor", R"({"id": "lzma"})"}}));
    expectLeftOut("variable 'x': compressor: expected");
}

// What reading an array says of its only chunk, of 128 bytes, that holds these.
std::string chunkRefusal(const std::string& compressor, const std::string& bytes) {
    const auto store = v2Group();
    const std::string id = compressor.empty() ? "null" : "{\"id\": \"" + compressor + "\"}";
    put(store / "v/.zarray",
        v2Array({.shape = {2, 4, 4}, .chunk = {2, 4, 4}}, "<f4", {{"compressor", id}}));
    put(store / "v/0.0.0", bytes);
    try {
        open(store)->read(0, 0);
    } catch (const FileError& error) {
        return error.what();
    }
    return "";
}

TEST(DamagedZarr, AChunkHasAsManyBytesAsItsShapeSays) {
    const std::vector<std::pair<std::string, Pack>> packers{
        {"", unpacked},   {"zlib", byZlib}, {"gzip", byGzip},   {"bz2", byBzip2},
        {"zstd", byZstd}, {"lz4", byLz4},   {"blosc", byBlosc},
    };
    const std::string whole(128, 'a');  // of which no packer makes nothing
    for (const auto& [name, pack] : packers) {
        EXPECT_EQ(chunkRefusal(name, pack(whole)), "") << name;
        for (const std::string& wrong :
             {pack(whole.substr(1)), pack(whole + "a"), pack(whole + whole), std::string(),
              std::string("x"), pack(whole).substr(0, pack(whole).size() - 3),
              pack(whole).substr(0, 2)})
            EXPECT_THAT(chunkRefusal(name, wrong),
                        AllOf(HasSubstr("v/0.0.0: expected"), HasSubstr("128")))
                << name << ", " << wrong.size();
    }
    // Sizes that a packer states, of 2 GB.
    const std::string huge = littleEndian(0x7FFFFFFF, 4);
    EXPECT_THAT(chunkRefusal("lz4", huge + "abcdef"),
                HasSubstr("expected 128 bytes packed by lz4, found 2147483647"));
    std::string blosc = byBlosc(whole);
    blosc.replace(4, 4, huge);
    EXPECT_THAT(chunkRefusal("blosc", blosc), HasSubstr("expected 128 bytes packed by blosc"));
}

TEST(DamagedZarr, ChecksumsAreHeld) {
    const auto store = v3Group();
    const Layout one{.shape = {2, 4, 4}, .chunk = {2, 4, 4}};
    put(store / "v/zarr.json",
        v3Array(one, "float32",
                {{"codecs",
                  R"([{"name": "bytes", "configuration": {"endian": "little"}}, "crc32c"])"}}));
    std::string bytes = withCrc32c(std::string(128, 'a'));
    put(store / "v/c/0/0/0", bytes);
    EXPECT_NO_THROW(open(store)->read(0, 0));
    bytes[5] = 'b';
    put(store / "v/c/0/0/0", bytes);
    EXPECT_THROW(open(store)->read(0, 0), FileError);
    put(store / "v/c/0/0/0", "abc");
    EXPECT_THROW(open(store)->read(0, 0), FileError);
}

TEST(DamagedZarr, AShardSaysOnlyWhatItHolds) {
    const auto store = v3Group();
    const Layout outer{.shape = {2, 2, 2}, .chunk = {2, 2, 2}};
    const std::string bytes = R"([{"name": "bytes", "configuration": {"endian": "little"}}])";
    put(store / "v/zarr.json",
        v3Array(outer, "uint8",
                {{"codecs", R"([{"name": "sharding_indexed", "configuration": {"chunk_shape": )"
                            R"([1, 2, 2], "codecs": )" +
                                bytes + R"(, "index_codecs": )" + bytes + "}}]"}}));
    const auto refusal = [&](const std::string& shard) {
        put(store / "v/c/0/0/0", shard);
        try {
            open(store)->read(0, 0);
        } catch (const FileError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const auto index = [](std::uint64_t a, std::uint64_t n, std::uint64_t b, std::uint64_t m) {
        return littleEndian(a, 8) + littleEndian(n, 8) + littleEndian(b, 8) + littleEndian(m, 8);
    };
    const std::uint64_t most = ~std::uint64_t{0};
    EXPECT_EQ(refusal("abcdefgh" + index(4, 4, 0, 4)), "");
    EXPECT_EQ(refusal(index(most, most, most, most)), "");
    EXPECT_THAT(refusal("abcdefgh" + index(4, 4, 60, 4)), HasSubstr("found a file of 40"));
    EXPECT_THAT(refusal("abcdefgh" + index(4, 4, most - 1, 4)), HasSubstr("found a file of 40"));
    EXPECT_THAT(refusal("abcdefgh" + index(4, most - 1, 0, 4)), HasSubstr("in the shard's index"));
    EXPECT_THAT(refusal("abcdefgh" + index(4, 3, 0, 4)), HasSubstr("expected 4 bytes, found 3"));
    EXPECT_THAT(refusal("abc"), HasSubstr("expected 32 bytes at 0, found a file of 3"));
    EXPECT_THAT(refusal(""), HasSubstr("expected 32 bytes at 0, found a file of 0"));
}

TEST(DamagedZarr, SizesThatNoFilesHoldAreRefused) {
    for (const std::string shape :
         {"[1152921504606846976, 4, 4]", "[4294967296, 4294967296, 4294967296]",
          "[1024, 1024, 1024]", "[4611686018427387904, 4611686018427387904, 4]"}) {
        EXPECT_THAT(v2Refusal({{"shape", shape}}),
                    testing::AnyOf(HasSubstr("expected files that hold"), HasSubstr("2^32 points"),
                                   HasSubstr("2^24 points")))
            << shape;
    }
    // Where something is stored, more is believed: 2^25 points, of which a few were written.
    const auto store = v2Group();
    const Layout layout{.shape = {128, 512, 512}, .chunk = {128, 512, 512}};
    put(store / "v/.zarray", v2Array(layout, "|u1", {{"compressor", R"({"id": "zstd"})"}}));
    EXPECT_THAT(refusalOf(store), HasSubstr("expected files that hold 33554432 bytes"));
    put(store / "v/0.0.0", byZstd(std::string(std::size_t{1} << 25, 'a')));
    const auto values = valuesOf<std::uint8_t>(*open(store), "v");
    EXPECT_EQ(std::ranges::count(values, 'a'), std::ssize(values));
    // But not more points than a step has, whatever is stored.
    put(store / "v/.zarray",
        v2Array({.shape = {2048, 2048, 2048}, .chunk = {256, 256, 256}}, "|u1"));
    put(store / "v/0.0.0", std::string(1 << 18, 'a'));
    EXPECT_THAT(refusalOf(store), HasSubstr("expected at most 2^32 points, found 8589934592"));
    // Nor 2 GB of chunk from a few bytes.
    const Layout vast{.shape = {128, 512, 512}, .chunk = {8000, 512, 512}};
    put(store / "v/.zarray", v2Array(vast, "|u1", {{"compressor", R"({"id": "zlib"})"}}));
    put(store / "v/0.0.0", byZlib(std::string(1 << 20, 'a')));
    try {
        open(store)->read(0, 0);
        ADD_FAILURE();
    } catch (const FileError& error) {
        EXPECT_THAT(error.what(), HasSubstr("zlib cannot hold"));
    }
}

TEST(DamagedZarr, StepsInTooManyChunksAreRefused) {
    const auto store = v2Group();
    put(store / "v/.zarray", v2Array({.shape = {128, 128, 128}, .chunk = {1, 1, 1}}, "|u1"));
    const auto reader = open(store);
    EXPECT_THROW(reader->read(0, 0), FileError);
}

TEST(DamagedZarr, AChunkIsAnOrdinaryFile) {
    const auto store = v2Group();
    put(store / "v/.zarray", v2Array(kCube, "<f4"));
    std::filesystem::create_directories(store / "v/1.0.0");
    EXPECT_THROW(open(store)->read(0, 0), FileError);
    std::filesystem::remove(store / "v/1.0.0");
    std::filesystem::create_symlink("nowhere", store / "v/1.0.0");
    EXPECT_THROW(open(store)->read(0, 0), FileError);  // not one that was never written
    std::filesystem::remove(store / "v/1.0.0");
    EXPECT_NO_THROW(open(store)->read(0, 0));
}

TEST(DamagedZarr, GroupsEnd) {
    // A link to the group around it.
    auto store = v2Group();
    put(store / "v/.zarray", v2Array(kCube, "<f4"));
    std::filesystem::create_directory_symlink(".", store / "loop");
    EXPECT_THAT(refusalOf(store), HasSubstr("expected groups at most 16 deep, found more"));
    store = v2Group();
    std::filesystem::path deep = store;
    for (int i = 0; i < 40; ++i) put((deep /= "g") / ".zgroup", "{}");
    EXPECT_THAT(refusalOf(store), HasSubstr("expected groups at most 16 deep, found more"));
}

TEST(DamagedZarr, MetadataThatAreNoneAreRefused) {
    auto store = v2Group();
    EXPECT_THAT(refusalOf(store), HasSubstr("expected a numeric variable"));
    for (const std::string text : {"", "[]", "{", "nul", "{\"zarr_format\": 2}"}) {
        put(store / ".zarray", text);
        EXPECT_THAT(refusalOf(store), testing::AnyOf(HasSubstr(".zarray: expected a JSON object"),
                                                     HasSubstr("shape: expected a list")))
            << text;
    }
    std::filesystem::remove(store / ".zarray");
    put(store / ".zattrs", "{" + std::string(17 << 20, ' ') + "}");
    EXPECT_THAT(refusalOf(store), HasSubstr("expected metadata of at most 16777216 bytes"));
    const std::string open(1 << 20, '['), close(1 << 20, ']');
    put(store / ".zattrs", "{\"a\": " + open + close + "}");
    EXPECT_THAT(refusalOf(store), HasSubstr("nested at most 100 deep"));
    put(store / ".zattrs", open);
    EXPECT_THAT(refusalOf(store), HasSubstr("expected a JSON object"));
    store = v3Group();
    put(store / "zarr.json", "{\"node_type\": \"a\\nb\"}");
    EXPECT_THAT(refusalOf(store), HasSubstr("expected array or group, found a b"));
}

TEST(DamagedZarr, ImagesThatAreNoneAreTold) {
    const auto store = v2Group();
    put(store.parent_path() / "outside/.zarray", v2Array(kCube, "<f4"));
    put(store / "0/.zarray", v2Array(kCube, "<f4"));
    for (const auto& [said, told] : std::vector<std::pair<std::string, std::string>>{
             {"7", "multiscales: expected a list, found 7"},
             {"[7]", "multiscales: datasets: expected a list, found none"},
             {R"([{"datasets": [{"path": "../outside"}]}])",
              "multiscales: path: expected an array of the group, found ../outside"},
             {R"([{"datasets": [{"path": "/"}]}])", "expected an array of the group, found /"},
             {R"([{"datasets": [{}]}])", "expected an array of the group, found none"},
             {R"([{"datasets": [{"path": "0"}]}])", "each of the 3 dimensions of 0, found 5"},
             {R"([{"axes": [{}, {}, {}], "datasets": [{"path": "0"}]}])", "an axis with a name"},
         }) {
        put(store / ".zattrs", R"({"multiscales": )" + said + "}");
        const auto reader = open(store);
        ASSERT_EQ(reader->damaged().size(), 1u) << said;
        EXPECT_THAT(reader->damaged()[0].why, HasSubstr(told));
        EXPECT_EQ(reader->variables().size(), 1u);  // by its indices
    }
}

}  // namespace
}  // namespace timeseries::zarr_damaged
