#include "render/image/image.h"

#include <gtest/gtest.h>

namespace render {
namespace {

Image numbered(int width, int height, float first) {
    Image image({width, height});
    for (auto& pixel : image.pixels) pixel = glm::vec4(first++);
    return image;
}

TEST(Image, SideBySidePutsTheSecondPictureRight) {
    const Image left = numbered(3, 2, 0), right = numbered(3, 2, 100);
    const Image both = sideBySide(left, right);
    ASSERT_EQ(both.size, glm::ivec2(6, 2));
    ASSERT_EQ(both.pixels.size(), 12u);
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 3; ++x) {
            EXPECT_EQ(both.at(x, y), left.at(x, y));
            EXPECT_EQ(both.at(x + 3, y), right.at(x, y));
        }
    }
}

TEST(Image, TopBottomPutsTheSecondPictureBelow) {
    const Image top = numbered(3, 2, 0), bottom = numbered(3, 2, 100);
    const Image both = topBottom(top, bottom);
    ASSERT_EQ(both.size, glm::ivec2(3, 4));
    ASSERT_EQ(both.pixels.size(), 12u);
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 3; ++x) {
            EXPECT_EQ(both.at(x, y), top.at(x, y));
            EXPECT_EQ(both.at(x, y + 2), bottom.at(x, y));
        }
    }
}

TEST(Metadata, KeysArePlainAsciiWithoutStraySpaces) {
    EXPECT_TRUE(isMetadataKey("isochron session"));
    EXPECT_TRUE(isMetadataKey(std::string(79, 'k')));
    for (const std::string bad : {"", " a", "a ", "a  b", "a\nb", "µ"})
        EXPECT_FALSE(isMetadataKey(bad)) << bad;
    EXPECT_FALSE(isMetadataKey(std::string(80, 'k')));
}

}  // namespace
}  // namespace render
