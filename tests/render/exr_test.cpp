#include "render/image/exr.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "tests/support/files.h"

namespace render {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;
using tests::freshFolder;
using tests::readBytes;
using tests::writeBytes;

std::vector<float> noise(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> values(0, 100);
    std::vector<float> out(count);
    for (auto& value : out) value = values(random);
    return out;
}

ExrView noisyView(const std::string& name, unsigned seed) {
    ExrView view{name, Image({7, 20})};  // more rows than one ZIP block of 16
    const auto values = noise(view.image.pixels.size() * 4, seed);
    for (std::size_t i = 0; i < view.image.pixels.size(); ++i) {
        view.image.pixels[i] = {values[4 * i], values[4 * i + 1], values[4 * i + 2],
                                values[4 * i + 3]};
    }
    view.scalars["opticalDepth"] = noise(view.image.pixels.size(), seed + 1);
    view.scalars["splatCount"] = noise(view.image.pixels.size(), seed + 2);
    return view;
}

std::vector<ExrView> stereo() { return {noisyView("left", 1), noisyView("right", 10)}; }

struct Attribute {
    std::string type, value;
};

// The header as "OpenEXR File Layout" describes it, read without the library.
std::map<std::string, Attribute> headerOf(const std::string& bytes) {
    std::map<std::string, Attribute> header;
    std::size_t at = 8;
    const auto text = [&] {
        const std::string taken(bytes.c_str() + at);
        at += taken.size() + 1;
        return taken;
    };
    for (std::string name = text(); !name.empty(); name = text()) {
        const std::string type = text();
        std::uint32_t size = 0;
        for (std::size_t i = 4; i-- > 0;)
            size = size << 8 | static_cast<std::uint8_t>(bytes[at + i]);
        header[name] = {type, bytes.substr(at + 4, size)};
        at += 4 + size;
    }
    return header;
}

// Channel names and pixel types from a chlist: name \0, int32 type, 4 bytes linearity, 2 x int32.
std::vector<std::pair<std::string, int>> channelsOf(const std::string& chlist) {
    std::vector<std::pair<std::string, int>> channels;
    for (std::size_t at = 0; chlist[at] != '\0';) {
        const std::string name(chlist.c_str() + at);
        at += name.size() + 1;
        channels.emplace_back(name, chlist[at]);
        at += 16;
    }
    return channels;
}

float littleEndianFloat(const std::string& bytes, std::size_t at) {
    std::uint32_t bits = 0;
    for (std::size_t i = 4; i-- > 0;) bits = bits << 8 | static_cast<std::uint8_t>(bytes[at + i]);
    return std::bit_cast<float>(bits);
}

TEST(Exr, MonoFileComesBackBitForBit) {
    const auto file = freshFolder() / "mono.exr";
    ExrView view = noisyView("", 3);
    constexpr float kInf = std::numeric_limits<float>::infinity();
    view.image.at(0, 0) = {kInf, -kInf, std::numeric_limits<float>::denorm_min(), -0.0f};
    const std::vector views{view};
    writeExr(file, views);
    const auto read = readExr(file);
    EXPECT_EQ(read.views, views);
    EXPECT_TRUE(std::signbit(read.views[0].image.at(0, 0).a));
    EXPECT_FALSE(headerOf(readBytes(file)).contains("multiView"));
}

TEST(Exr, NanStaysNan) {
    const auto file = freshFolder() / "nan.exr";
    const std::vector views{ExrView{"", Image({1, 1}, glm::vec4(std::nanf("")))}};
    writeExr(file, views);
    EXPECT_TRUE(std::isnan(readExr(file).views[0].image.pixels[0].r));
}

TEST(Exr, StereoFileComesBackBitForBit) {
    const auto file = freshFolder() / "stereo.exr";
    writeExr(file, stereo());
    EXPECT_EQ(readExr(file).views, stereo());
}

TEST(Exr, StereoFileListsLeftThenRightAsViews) {
    const auto file = freshFolder() / "stereo.exr";
    writeExr(file, stereo());
    const auto header = headerOf(readBytes(file));
    ASSERT_TRUE(header.contains("multiView"));
    EXPECT_EQ(header.at("multiView").type, "stringvector");
    // Each string with its int32 length before it.
    EXPECT_EQ(header.at("multiView").value, std::string("\4\0\0\0left\5\0\0\0right", 17));
}

TEST(Exr, OnlyTheSecondViewIsNamedInItsChannels) {
    const auto file = freshFolder() / "stereo.exr";
    writeExr(file, stereo());
    constexpr int kFloat = 2;  // 0 UINT, 1 HALF, 2 FLOAT
    EXPECT_THAT(
        channelsOf(headerOf(readBytes(file)).at("channels").value),
        ElementsAre(Pair("A", kFloat), Pair("B", kFloat), Pair("G", kFloat), Pair("R", kFloat),
                    Pair("opticalDepth", kFloat), Pair("right.A", kFloat), Pair("right.B", kFloat),
                    Pair("right.G", kFloat), Pair("right.R", kFloat),
                    Pair("right.opticalDepth", kFloat), Pair("right.splatCount", kFloat),
                    Pair("splatCount", kFloat)));
}

TEST(Exr, AChannelOfOneViewCarriesThatViewsName) {
    const auto file = freshFolder() / "stereo.exr";
    auto views = stereo();
    views[0].scalars["seenLeft"] = views[0].scalars["splatCount"];
    views[1].scalars["seenRight"] = views[1].scalars["splatCount"];
    writeExr(file, views);
    std::vector<std::string> seen;
    for (const auto& [name, type] : channelsOf(headerOf(readBytes(file)).at("channels").value)) {
        if (name.find("seen") != std::string::npos) seen.push_back(name);
    }
    EXPECT_THAT(seen, ElementsAre("right.seenRight", "seenLeft"));
    EXPECT_EQ(readExr(file).views, views);
}

TEST(Exr, DeclaresZipAndTheSrgbPrimaries) {
    const auto file = freshFolder() / "mono.exr";
    writeExr(file, std::vector{noisyView("", 3)});
    const auto header = headerOf(readBytes(file));
    constexpr char kZip = 3;
    EXPECT_EQ(header.at("compression").value, std::string(1, kZip));
    const std::string& xy = header.at("chromaticities").value;
    // ITU-R BT.709 item 1.3 and 1.4: red, green, blue, white, as x and y.
    const float expected[] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(littleEndianFloat(xy, 4 * i), expected[i]) << i;
}

TEST(Exr, MetadataComeBackAsWritten) {
    const auto file = freshFolder() / "text.exr";
    const Metadata metadata{{"isochron session", "{\"unit\": \"µm³\"}"},
                            {"empty", ""},
                            {"a key longer than the 31 bytes of old files", "value"},
                            {"long", std::string(300'000, 'x')}};
    writeExr(file, stereo(), metadata);
    EXPECT_EQ(readExr(file).metadata, metadata);
}

TEST(Exr, ShortenedFilesAreRefusedInASentenceNamingThem) {
    const auto folder = freshFolder();
    writeExr(folder / "whole.exr", stereo(), {{"key", "value"}});
    const std::string whole = readBytes(folder / "whole.exr");
    for (std::size_t length = 0; length < whole.size(); length += length < 1000 ? 1 : 37) {
        writeBytes(folder / "cut.exr", whole.substr(0, length));
        try {
            readExr(folder / "cut.exr");
            ADD_FAILURE() << "read a file cut to " << length << " of " << whole.size() << " bytes";
        } catch (const ImageError& error) {
            EXPECT_THAT(error.what(), HasSubstr("cut.exr: "));
        }
    }
}

TEST(Exr, OtherFilesAreRefused) {
    const auto folder = freshFolder();
    writeExr(folder / "whole.exr", stereo());
    const std::string whole = readBytes(folder / "whole.exr");
    std::string wrongMagic = whole, wrongVersion = whole, multiPart = whole, deep = whole;
    wrongMagic[0] = 'Q';
    wrongVersion[4] = 9;
    multiPart[5] = 0x10;
    deep[5] = 0x08;
    for (const std::string& content : {wrongMagic, wrongVersion, multiPart, deep,
                                       std::string("not a picture\n"), std::string()}) {
        writeBytes(folder / "other.exr", content);
        EXPECT_THROW(readExr(folder / "other.exr"), ImageError);
    }
    EXPECT_THROW(readExr(folder / "absent.exr"), ImageError);
    EXPECT_THROW(readExr(folder), ImageError);
}

std::string littleEndian(std::int32_t value) {
    std::string bytes;
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 0xFF);
    return bytes;
}

std::string refusal(const std::filesystem::path& file) {
    try {
        readExr(file);
    } catch (const ImageError& error) {
        return error.what();
    }
    return "read";
}

TEST(Exr, AbsurdDataWindowsAreRefused) {
    const auto folder = freshFolder();
    writeExr(folder / "whole.exr", stereo());
    const std::string whole = readBytes(folder / "whole.exr");
    const std::string key("dataWindow\0box2i\0\x10\0\0\0", 21);
    const std::size_t window = whole.find(key) + key.size();
    ASSERT_GT(window, key.size());
    const auto refusalOf = [&](std::array<std::int32_t, 4> box) {
        std::string bytes;
        for (const auto bound : box) bytes += littleEndian(bound);
        std::string changed = whole;
        writeBytes(folder / "huge.exr", changed.replace(window, 16, bytes));
        return refusal(folder / "huge.exr");
    };
    constexpr auto kMost = std::numeric_limits<std::int32_t>::max();
    constexpr auto kLeast = std::numeric_limits<std::int32_t>::min();
    EXPECT_THAT(refusalOf({0, 0, 16384, 16384}), HasSubstr("declares 16385 x 16385 pixels"));
    EXPECT_THAT(refusalOf({0, 0, kMost / 4, 0}), HasSubstr("declares 536870912 x 1 pixels"));
    for (const std::array<std::int32_t, 4> box : {std::array{0, 0, kMost, 0},
                                                  {kLeast, kLeast, kMost, kMost},
                                                  {0, 0, -1, -1},
                                                  {5, 5, 2, 2}}) {
        EXPECT_NE(refusalOf(box), "read") << box[2];
    }
}

TEST(Exr, AnAttributeLongerThanTheFileIsRefusedBeforeItIsAllocated) {
    const auto folder = freshFolder();
    writeExr(folder / "whole.exr", stereo(), {{"key", "value"}});
    std::string bytes = readBytes(folder / "whole.exr");
    const std::string key("key\0string\0", 11);
    ASSERT_NE(bytes.find(key), std::string::npos);
    bytes.replace(bytes.find(key) + key.size(), 4, littleEndian(0x7fffffff));
    writeBytes(folder / "long.exr", bytes);
    EXPECT_THAT(refusal(folder / "long.exr"), HasSubstr("its header ends too early"));
}

TEST(Exr, ADamagedHeaderIsRefusedOrReadsAsAPicture) {
    const auto folder = freshFolder();
    writeExr(folder / "whole.exr", stereo(), {{"key", "value"}});
    const std::string whole = readBytes(folder / "whole.exr");
    int refused = 0;
    for (std::size_t at = 0; at < 700; ++at) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(~damaged[at]);
        writeBytes(folder / "damaged.exr", damaged);
        try {
            const auto picture = readExr(folder / "damaged.exr");
            for (const auto& view : picture.views) {
                EXPECT_EQ(view.image.pixels.size(),
                          static_cast<std::size_t>(view.image.size.x) *
                              static_cast<std::size_t>(view.image.size.y));
            }
        } catch (const ImageError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 300);  // names of attributes nobody needs may change freely
}

TEST(Exr, AFailedWriteLeavesNothingBehind) {
    const auto folder = freshFolder();
    EXPECT_THROW(writeExr(folder / "no" / "such.exr", stereo()), ImageError);
    std::filesystem::create_directories(folder / "taken.exr" / "inside");
    EXPECT_THROW(writeExr(folder / "taken.exr", stereo()), ImageError);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
}

}  // namespace
}  // namespace render
