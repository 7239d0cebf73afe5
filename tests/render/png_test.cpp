#include "render/image/png.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <vector>

#include "render/image/color.h"
#include "tests/support/files.h"
#include "timeseries/together.h"

namespace render {
namespace {

using testing::HasSubstr;
using tests::freshFolder;
using tests::readBytes;
using tests::writeBytes;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

float linear8(int step) { return static_cast<float>(linearFromSrgb(step / 255.0)); }

std::uint32_t bigEndian32(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
    return value;
}

// Chunks in file order, read as PNG chapter 5 lays them out: length, type, data, CRC.
std::vector<std::pair<std::string, std::string>> chunksOf(const std::string& bytes) {
    std::vector<std::pair<std::string, std::string>> chunks;
    for (std::size_t at = 8; at + 12 <= bytes.size();) {
        const std::size_t length = bigEndian32(bytes, at);
        chunks.emplace_back(bytes.substr(at + 4, 4), bytes.substr(at + 8, length));
        at += 12 + length;
    }
    return chunks;
}

std::string chunk(const std::string& bytes, const std::string& type) {
    for (const auto& [name, data] : chunksOf(bytes)) {
        if (name == type) return data;
    }
    ADD_FAILURE() << "no chunk " << type;
    return {};
}

Image everyStep() {
    Image image({256, 3}, glm::vec4(0, 0, 0, 1));
    for (int step = 0; step < 256; ++step) {
        for (int c = 0; c < 3; ++c) image.at(step, c)[c] = linear8(step);
    }
    return image;
}

TEST(Png, EveryEightBitColorSurvivesTheRoundTrip) {
    const auto file = freshFolder() / "steps.png";
    writePng(file, everyStep());
    EXPECT_EQ(readPng(file).image, everyStep());
}

TEST(Png, TopRowIsTheFirstInTheFile) {
    const auto file = freshFolder() / "rows.png";
    Image image({1, 2}, glm::vec4(0, 0, 0, 1));
    image.at(0, 0).r = 1;
    writePng(file, image);
    EXPECT_EQ(readPng(file).image.pixels.front(), glm::vec4(1, 0, 0, 1));
}

TEST(Png, OpaquePicturesAreRgbAndOthersRgba) {
    const auto file = freshFolder() / "kind.png";
    constexpr std::size_t kColorType = 9;  // width 4, height 4, depth 1, colour type (PNG 11.2.2)
    Image image({2, 2}, glm::vec4(0.5f, 0.5f, 0.5f, 1));
    writePng(file, image);
    EXPECT_EQ(chunk(readBytes(file), "IHDR")[kColorType], 2);
    image.at(1, 1) = glm::vec4(0.25f, 0.25f, 0.25f, 0.5f);
    writePng(file, image);
    EXPECT_EQ(chunk(readBytes(file), "IHDR")[kColorType], 6);
}

TEST(Png, AlphaIsStoredStraightAndReadPremultiplied) {
    const auto file = freshFolder() / "alpha.png";
    // Alpha 51/255 = 0.2 exactly representable in the file; the straight colour is an encoded step.
    const float alpha = 51 / 255.0f;
    writePng(file, Image({1, 1}, glm::vec4(linear8(200) * alpha, linear8(100) * alpha, 0, alpha)));
    const glm::vec4 read = readPng(file).image.pixels[0];
    EXPECT_FLOAT_EQ(read.r, linear8(200) * alpha);
    EXPECT_FLOAT_EQ(read.g, linear8(100) * alpha);
    EXPECT_EQ(read.b, 0);
    EXPECT_FLOAT_EQ(read.a, alpha);
}

TEST(Png, DeclaresSrgbWithAgreeingGamma) {
    const auto file = freshFolder() / "gamma.png";
    writePng(file, everyStep());
    const std::string bytes = readBytes(file);
    EXPECT_EQ(chunk(bytes, "sRGB").size(), 1u);
    EXPECT_EQ(bigEndian32(chunk(bytes, "gAMA"), 0), 45455u);  // PNG 11.3.2.5
}

TEST(Png, ValuesThatAreNoLightAreClamped) {
    const auto file = freshFolder() / "wild.png";
    Image image({4, 1});
    image.at(0, 0) = {kNan, kInf, -kInf, 1};
    image.at(1, 0) = {-1, 5, 0, kInf};
    image.at(2, 0) = {1, 1, 1, kNan};
    image.at(3, 0) = {kInf, kNan, 0.1f, 0};
    writePng(file, image);
    const auto read = readPng(file).image.pixels;
    EXPECT_EQ(read[0], glm::vec4(0, 1, 0, 1));
    EXPECT_EQ(read[1], glm::vec4(0, 1, 0, 1));
    EXPECT_EQ(read[2], glm::vec4(0));
    EXPECT_EQ(read[3], glm::vec4(0));
}

// Noise, which no filter predicts, in more rows than are deflated at once (256 KiB), and in strips
// of which more are made than are kept until they are written (64).
Image noise(glm::ivec2 size, bool opaque) {
    Image image(size);
    std::minstd_rand random(7);
    const auto step = [&] { return static_cast<int>(random() % 256); };
    for (glm::vec4& pixel : image.pixels) {
        const float alpha = opaque ? 1.0f : static_cast<float>(step()) / 255;
        pixel = glm::vec4(linear8(step()), linear8(step()), linear8(step()), 1) * alpha;
    }
    return image;
}

TEST(Png, EveryPixelOfALargePictureComesBack) {
    const auto file = freshFolder() / "noise.png";
    for (const glm::ivec2 size : {glm::ivec2(300, 700), {1, 70'000}, {70'000, 70}}) {
        const Image image = noise(size, true);
        writePng(file, image);
        EXPECT_EQ(readPng(file).image, image) << size.x << " x " << size.y;
    }
    const Image image = noise({300, 700}, false);
    writePng(file, image);
    const Image read = readPng(file).image;
    ASSERT_EQ(read.size, image.size);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        ASSERT_LT(glm::distance(read.pixels[i], image.pixels[i]), 1e-6f) << "pixel " << i;
}

TEST(Png, TheBytesAreTheSameForAnyNumberOfThreads) {
    const auto folder = freshFolder();
    const Image image = noise({500, 1000}, true);
    const unsigned before = timeseries::threadLimit.exchange(1);
    writePng(folder / "one.png", image);
    timeseries::threadLimit = before;
    for (int i = 0; i < 5; ++i) {
        writePng(folder / "several.png", image);
        EXPECT_EQ(readBytes(folder / "several.png"), readBytes(folder / "one.png"));
    }
}

TEST(Png, MetadataComeBackAsWritten) {
    const auto file = freshFolder() / "text.png";
    const Metadata metadata{{"Software", "isochron"},
                            {"isochron session", "{\"unit\": \"µm³ → 10⁻¹\",\n \"step\": 3}"},
                            {"empty", ""},
                            {"long", std::string(300'000, 'x')}};
    writePng(file, everyStep(), metadata);
    EXPECT_EQ(readPng(file).metadata, metadata);
    // International text, since tEXt would be Latin-1.
    EXPECT_THAT(chunk(readBytes(file), "iTXt"), HasSubstr("Software"));
}

TEST(Png, DamagedTextIsToldAndNotLeftOut) {
    const auto file = freshFolder() / "text.png";
    writePng(file, everyStep(), {{"session", "what was to be seen"}});
    std::string bytes = readBytes(file);
    bytes[bytes.find("to be seen")] ^= 1;
    writeBytes(file, bytes);
    try {
        readPng(file);
        ADD_FAILURE() << "read";
    } catch (const ImageError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("text.png"), HasSubstr("CRC")));
    }
}

TEST(Png, TheSamePictureGivesTheSameBytes) {
    const auto folder = freshFolder();
    writePng(folder / "a.png", everyStep(), {{"k", "v"}});
    writePng(folder / "b.png", everyStep(), {{"k", "v"}});
    EXPECT_EQ(readBytes(folder / "a.png"), readBytes(folder / "b.png"));
}

TEST(Png, EveryShortenedFileIsRefusedInASentenceNamingIt) {
    const auto folder = freshFolder();
    writePng(folder / "whole.png", everyStep(), {{"key", "value"}});
    const std::string whole = readBytes(folder / "whole.png");
    for (std::size_t length = 0; length < whole.size(); ++length) {
        writeBytes(folder / "cut.png", whole.substr(0, length));
        try {
            readPng(folder / "cut.png");
            ADD_FAILURE() << "read a file cut to " << length << " of " << whole.size() << " bytes";
        } catch (const ImageError& error) {
            EXPECT_THAT(error.what(), HasSubstr("cut.png: "));
        }
    }
}

TEST(Png, OtherFilesAreRefused) {
    const auto folder = freshFolder();
    writePng(folder / "whole.png", everyStep());
    std::string wrongMagic = readBytes(folder / "whole.png");
    wrongMagic[1] = 'Q';
    for (const std::string& content : {wrongMagic, std::string("not a picture\n"), std::string()}) {
        writeBytes(folder / "other.png", content);
        EXPECT_THROW(readPng(folder / "other.png"), ImageError);
    }
    EXPECT_THROW(readPng(folder / "absent.png"), ImageError);
    EXPECT_THROW(readPng(folder), ImageError);
}

TEST(Png, FlippedBytesAreRefusedOrHarmless) {
    const auto folder = freshFolder();
    writePng(folder / "whole.png", everyStep());
    const std::string whole = readBytes(folder / "whole.png");
    int refused = 0;
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(~damaged[at]);
        writeBytes(folder / "damaged.png", damaged);
        try {
            EXPECT_EQ(readPng(folder / "damaged.png").image.size, glm::ivec2(256, 3)) << at;
        } catch (const ImageError&) {
            ++refused;
        }
    }
    EXPECT_EQ(refused, static_cast<int>(whole.size()));  // CRCs guard everything
}

TEST(Png, AHeaderPromisingMoreThanTheFileHoldsIsRefused) {
    const auto folder = freshFolder();
    writePng(folder / "whole.png", everyStep());
    std::string bytes = readBytes(folder / "whole.png");
    const auto crcOf = [](const std::string& data) {  // PNG annex D
        std::uint32_t crc = ~0u;
        for (const char c : data) {
            crc ^= static_cast<std::uint8_t>(c);
            for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? 0xedb88320u ^ crc >> 1 : crc >> 1;
        }
        return ~crc;
    };
    ASSERT_EQ(crcOf(bytes.substr(12, 17)), bigEndian32(bytes, 29));
    bytes.replace(16, 8, std::string("\0\0\x3f\xff\0\0\x3f\xff", 8));  // 16383 x 16383
    const std::uint32_t crc = crcOf(bytes.substr(12, 17));
    for (int i = 0; i < 4; ++i)
        bytes[29 + static_cast<std::size_t>(i)] = static_cast<char>(crc >> (24 - 8 * i));
    writeBytes(folder / "huge.png", bytes);
    try {
        readPng(folder / "huge.png");
        FAIL() << "16383 x 16383 pixels from " << bytes.size() << " bytes";
    } catch (const ImageError& error) {  // before memory is taken, not when the data end
        EXPECT_THAT(error.what(), HasSubstr("declares more pixels than it holds"));
    }
}

TEST(Png, AFailedWriteLeavesNothingBehind) {
    const auto folder = freshFolder();
    EXPECT_THROW(writePng(folder / "no" / "such" / "folder.png", everyStep()), ImageError);
    // A folder of that name cannot be renamed over.
    std::filesystem::create_directories(folder / "taken.png" / "inside");
    EXPECT_THROW(writePng(folder / "taken.png", everyStep()), ImageError);
    EXPECT_TRUE(std::filesystem::exists(folder / "taken.png" / "inside"));
    const auto entries = std::distance(std::filesystem::directory_iterator(folder), {});
    EXPECT_EQ(entries, 1);
}

// The device takes nothing, as a full disk; a picture of which more than a stream's buffer is
// written fails within libpng, a small one when it is closed.
TEST(Png, AFullDiskIsToldAsTheSystemTellsIt) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    const std::string expected = std::generic_category().message(ENOSPC);
    for (const Image& image : {noise({300, 700}, true), everyStep()}) {
        try {
            writePng("/dev/full", image);
            FAIL() << "written";
        } catch (const ImageError& error) {
            EXPECT_THAT(error.what(), HasSubstr(expected));
        }
    }
}

TEST(Png, WritingReplacesTheOldFileAndLeavesOnlyIt) {
    const auto folder = freshFolder();
    writeBytes(folder / "picture.png", "old");
    writePng(folder / "picture.png", everyStep());
    EXPECT_EQ(readPng(folder / "picture.png").image, everyStep());
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
}

}  // namespace
}  // namespace render
