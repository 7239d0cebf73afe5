// Sums into light, many pixels at once, against the formula in double.
#include "render/frame/resolve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "render/reference/cpu_splatter.h"
#include "tests/support/vector_targets.h"

namespace render {
namespace {

constexpr int kPixels = 61;  // no whole number of any vector

// Sums from nothing to far beyond what lets light through, some of them nothing.
std::vector<float> someSums(std::size_t floats, std::mt19937& random) {
    std::uniform_real_distribution<float> exponent(-9, 3), share(0, 1);
    std::vector<float> sums(floats * kPixels);
    for (std::size_t x = 0; x < kPixels; ++x) {
        const float sum = x % 7 == 3 ? 0 : std::pow(10.0f, exponent(random));
        for (std::size_t c = 0; c + 1 < floats; ++c) sums[floats * x + c] = sum * share(random);
        sums[floats * x + floats - 1] = sum;
    }
    return sums;
}

void expectTruth(const std::vector<Layer>& layers, std::mt19937& random) {
    std::vector<Channels> channels;
    std::vector<std::vector<float>> sums;
    std::vector<SummedRow> rows;
    for (const Layer& layer : layers) {
        const auto* constant = std::get_if<Constant>(&layer.style.color);
        channels.push_back(constant ? Channels::Weight : Channels::WeightedColor);
        sums.push_back(someSums(constant ? 1 : 4, random));
        const glm::vec3 rgb = constant ? glm::vec3(constant->linearRgb) : glm::vec3(0);
        rows.push_back({channels.back(),
                        nullptr,
                        static_cast<float>(opticalDepthPerWeight(layer.style.opacity)),
                        {rgb.x, rgb.y, rgb.z}});
    }
    Accumulator<double> truth({kPixels, 1}, channels);
    for (std::size_t k = 0; k < layers.size(); ++k) {
        truth.planes[k].assign(sums[k].begin(), sums[k].end());
        rows[k].sums = sums[k].data();
    }
    const glm::vec4 ground(0.3f, 0.2f, 0.1f, 1);
    std::vector<glm::vec4> light(kPixels + 1, ground);
    resolveRow(rows, kPixels, &light[0].x);
    for (int x = 0; x < kPixels; ++x) {
        const Resolved r = resolvePixel(truth, layers, x, 0);
        const glm::dvec4 expected = glm::dvec4(r.rgb, r.alpha) + (1 - r.alpha) * glm::dvec4(ground);
        for (int c = 0; c < 4; ++c) EXPECT_NEAR(light[x][c], expected[c], 1e-6) << x << ' ' << c;
        if (r.opticalDepth == 0) {
            EXPECT_EQ(light[x], ground) << "not a bit is changed where there is nothing";
        }
    }
    EXPECT_EQ(light[kPixels], ground) << "nor beside the pixels";
}

TEST(ResolveRow, LayersOfEitherKindMixByOpticalDepth) {
    std::mt19937 random(5);
    const Layer one{{}, {Constant{{1, 0.5, 0.25}}, 0.5}}, other{{}, {Constant{{0, 0.2, 1}}, 1}},
        byValue{{}, {ByValue{{}, 0, 1}, 0.3}};
    tests::onEachVectorTarget([&] {
        expectTruth({one}, random);
        expectTruth({byValue}, random);
        expectTruth({one, byValue, other}, random);
        expectTruth({}, random);
    });
}

TEST(ResolveRow, AnOrderedPlaneIsLightAlready) {
    std::mt19937 random(6);
    std::vector<float> sums;
    std::uniform_real_distribution<float> share(0, 1);
    for (int x = 0; x < kPixels; ++x) {
        const float opacity = share(random);
        for (int c = 0; c < 3; ++c) sums.push_back(opacity * share(random));
        sums.push_back(opacity);
    }
    const glm::vec4 ground(0.3f, 0.2f, 0.1f, 1);
    tests::onEachVectorTarget([&] {
        std::vector<glm::vec4> light(kPixels, ground);
        resolveRow(std::array{SummedRow{Channels::Over, sums.data(), 1, {}}}, kPixels, &light[0].x);
        for (std::size_t x = 0; x < kPixels; ++x)
            for (int c = 0; c < 4; ++c) {
                const float* sum = &sums[4 * x];
                EXPECT_NEAR(light[x][c], sum[c] + (1 - sum[3]) * ground[c], 1e-6);
            }
    });
}

}  // namespace
}  // namespace render
