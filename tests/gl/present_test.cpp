// What a display gets of a picture is what a PNG file has of it.
#include "render/frame/present.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <optional>

#include "render/gl/debug_output.h"
#include "render/gl/headless_context.h"
#include "render/gl/pass.h"
#include "render/image/color.h"
#include "render/image/png.h"
#include "tests/support/files.h"

namespace render {
namespace {

class Presented : public testing::Test {
 protected:
    static constexpr glm::ivec2 kWindow{320, 300};

    // Into a window of RGBA 9, 9, 9, 9, rows from the top: as bytes, or into a framebuffer that
    // encodes it.
    enum class Shown { Bytes, Linear };
    std::vector<glm::u8vec4> window(const Image& picture, glm::ivec2 at, Shown as = Shown::Bytes,
                                    bool onProcessor = true,
                                    std::optional<glm::ivec2> scaledTo = {}) {
        GlTargets targets(picture.size);
        gl::begin(
            {.framebuffer = targets.lightFramebuffer(), .size = picture.size, .clearDepth = 1.0f});
        std::vector<glm::vec4> rows;  // GL's order
        for (int y = picture.size.y - 1; y >= 0; --y)
            for (int x = 0; x < picture.size.x; ++x) rows.push_back(picture.at(x, y));
        glTextureSubImage2D(targets.light().id(), 0, 0, 0, picture.size.x, picture.size.y, GL_RGBA,
                            GL_FLOAT, rows.data());
        KeptPicture kept(kWindow);
        const std::vector<std::uint8_t> nines(std::size_t(4) * kWindow.x * kWindow.y, 9);
        kept.write(nines, {0, 0}, kWindow);
        const gl::Texture swapchain(GL_SRGB8_ALPHA8, kWindow);
        glClearTexImage(swapchain.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE, nines.data());
        const GLuint id = swapchain.id();
        const gl::Framebuffer encoding(std::span(&id, 1));
        const Present& present = onProcessor ? here_ : shader_;
        if (scaledTo)
            present.drawScaled(targets, kept.framebuffer(), at, *scaledTo);
        else if (as == Shown::Bytes)
            present.draw(targets, kept, at);
        else
            present.drawLinear(targets, encoding.id());
        std::vector<glm::u8vec4> upwards(std::size_t(kWindow.x) * kWindow.y), read;
        glBindFramebuffer(GL_READ_FRAMEBUFFER,
                          as == Shown::Bytes ? kept.framebuffer() : encoding.id());
        glReadPixels(0, 0, kWindow.x, kWindow.y, GL_RGBA, GL_UNSIGNED_BYTE, upwards.data());
        gl::throwOnError();
        for (int y = kWindow.y - 1; y >= 0; --y)
            read.insert(read.end(), upwards.begin() + y * kWindow.x,
                        upwards.begin() + (y + 1) * kWindow.x);
        return read;
    }

    gl::HeadlessContext context_;
    Present here_{true}, shader_{false};
};

// Every step, the floats on both sides of each border, and what no light should be.
Image trickyLight() {
    Image image({256, 256}, glm::vec4(0, 0, 0, 1));
    std::vector<float> light{-1,
                             0,
                             1,
                             2,
                             std::numeric_limits<float>::infinity(),
                             std::numeric_limits<float>::quiet_NaN()};
    for (const double border : srgb8Steps()) {
        float at = std::nextafter(static_cast<float>(border), -1.0f);
        for (int i = 0; i < 4; ++i, at = std::nextafter(at, 2.0f)) light.push_back(at);
    }
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const auto ramp = static_cast<float>(i) / 65535.0f;
        image.pixels[i] = {i < light.size() ? light[i] : ramp, ramp * ramp, 1 - ramp, 1};
    }
    return image;
}

TEST_F(Presented, BytesAreThoseOfAPngButForLightOnABorder) {
    // Blending may leave the ground's alpha an ulp or two below 1.
    for (const auto& [alpha, here] : {std::pair(1.0f, true), std::pair(1 - 1.2e-7f, true),
                                      std::pair(1.0f, false), std::pair(1 - 1.2e-7f, false)}) {
        Image light = trickyLight();
        for (glm::vec4& pixel : light.pixels) pixel.a = alpha;
        const auto file = tests::freshFolder() / "light.png";
        writePng(file, light);
        const Image decoded = readPng(file).image;
        const auto shown = window(light, {0, kWindow.y - 256}, Shown::Bytes, here);
        for (int y = 0; y < 256; ++y)
            for (int x = 0; x < 256; ++x) {
                const glm::u8vec4 pixel = shown[std::size_t(y) * kWindow.x + x];
                ASSERT_EQ(pixel.a, 255);
                for (int c = 0; c < 3; ++c) {
                    const int byte = srgb8FromLinear(decoded.at(x, y)[c]);
                    if (pixel[c] == byte) continue;
                    const auto linear = static_cast<double>(light.at(x, y)[c]);
                    const double steps = 255 * srgbFromLinear(linear);
                    ASSERT_NEAR(steps, (pixel[c] + byte) / 2.0, Present::kBorder)
                        << x << ' ' << y << ' ' << c << ": " << int{pixel[c]} << ' ' << byte;
                }
            }
    }
}

TEST_F(Presented, OnlyItsRectangleIsDrawn) {
    const glm::ivec2 at{40, 20}, size{100, 50};
    for (const bool here : {true, false}) {
        const auto shown = window(Image(size, glm::vec4(1)), at, Shown::Bytes, here);
        for (int y = 0; y < kWindow.y; ++y)
            for (int x = 0; x < kWindow.x; ++x) {
                const int up = kWindow.y - 1 - y;
                const bool inside =
                    x >= at.x && x < at.x + size.x && up >= at.y && up < at.y + size.y;
                ASSERT_EQ(shown[std::size_t(y) * kWindow.x + x], glm::u8vec4(inside ? 255 : 9))
                    << x << ' ' << y;
            }
    }
}

TEST_F(Presented, AnSrgbFramebufferEncodesTheSame) {
    // GL allows an encoding to be off by 0.6 of a step (4.5 core, 17.3.9 leaves it to the driver).
    const Image light = trickyLight();
    const auto byShader = window(light, {0, 0});
    const auto byFramebuffer = window(light, {0, 0}, Shown::Linear);
    for (std::size_t i = 6; i < byShader.size(); ++i)  // what is no light is left out
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(byFramebuffer[i][c], byShader[i][c], 1) << i;
}

TEST(FittedInto, IsTheLargestOfItsShapeInTheMiddle) {
    for (const glm::ivec2 window : {glm::ivec2(900, 900), {1600, 500}, {3, 700}, {1, 1}})
        for (const glm::ivec2 picture : {glm::ivec2(896, 1007), {320, 240}, {2064, 2208}}) {
            const Fitted fitted = fittedInto(window, picture);
            EXPECT_TRUE(fitted.size.x == window.x || fitted.size.y == window.y);
            for (int a = 0; a < 2; ++a) {
                EXPECT_LE(fitted.at[a] + fitted.size[a], window[a]);
                EXPECT_LE(std::abs(2 * fitted.at[a] + fitted.size[a] - window[a]), 1);
            }
            // Of the shape, to half a pixel.
            const double scale = static_cast<double>(fitted.size.y) / picture.y;
            if (fitted.size.y == window.y) {
                EXPECT_NEAR(fitted.size.x, std::max(1.0, scale * picture.x), 0.51);
            }
        }
}

// A ramp that is linear in x and y stays one at every size, but at its outer half pixels.
TEST_F(Presented, ScaledItIsAllOfThePicture) {
    constexpr glm::ivec2 kPicture{64, 48};
    const auto rampAt = [](glm::dvec2 share) {
        return glm::dvec3(0.1 + 0.8 * share.x, 0.9 - 0.7 * share.y, 0.25);
    };
    Image picture(kPicture, glm::vec4(0, 0, 0, 1));
    for (int y = 0; y < kPicture.y; ++y)
        for (int x = 0; x < kPicture.x; ++x)
            picture.at(x, y) =
                glm::vec4(glm::vec3(rampAt((glm::dvec2(x, y) + 0.5) / glm::dvec2(kPicture))), 1);
    for (const glm::ivec2 size : {glm::ivec2(200, 150), {32, 24}, kPicture}) {
        const glm::ivec2 at(11, 7);
        const auto pixels = window(picture, at, Shown::Bytes, true, size);
        for (int y = 0; y < kWindow.y; ++y)
            for (int x = 0; x < kWindow.x; ++x) {
                const glm::u8vec4 pixel = pixels[std::size_t(y) * kWindow.x + x];
                const glm::ivec2 in(x - at.x, y - (kWindow.y - at.y - size.y));  // from its top
                if (in.x < 0 || in.y < 0 || in.x >= size.x || in.y >= size.y) {
                    ASSERT_EQ(pixel, glm::u8vec4(9));
                    continue;
                }
                const glm::dvec2 edge = 0.5 / glm::dvec2(kPicture);
                const glm::dvec2 share =
                    glm::clamp((glm::dvec2(in) + 0.5) / glm::dvec2(size), edge, 1.0 - edge);
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(pixel[c], srgb8FromLinear(rampAt(share)[c]), 1)
                        << size.x << ": " << in.x << ' ' << in.y;
            }
    }
}

}  // namespace
}  // namespace render
