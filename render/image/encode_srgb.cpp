#include "render/image/encode_srgb.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>

namespace render {
namespace {

// Pixels of three channels and of four repeat after so many.
constexpr std::size_t kPeriod = 12, kAtOnce = 20 * kPeriod;

// 255 (1.055 x^(1/2.4) - 0.055) + 0.5 as a polynomial in x^(1/4), interpolated at Chebyshev's
// points: to 2.2e-6 of the whole. shaders/present.frag has the same. Compiled for wider vectors,
// too, where a machine has them: this is a fifth of a frame without a GPU. Which is chosen before
// the thread sanitizer is there.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
__attribute__((target_clones("avx2", "default")))
#endif
void encode(const float* linear, float* steps, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const float light = linear[i] > 0 ? linear[i] : 0.0f;
        const float x = light < 1 ? light : 1.0f;
        const float s = std::sqrt(std::sqrt(x));
        const float curve =
            -0.05973901135623381f +
            s * (0.1419582632365757f +
                 s * (1.3545726486376297f +
                      s * (-0.8252800165996645f +
                           s * (0.6210022840852661f +
                                s * (-0.29424763719151525f + s * 0.06173430754682886f)))));
        steps[i] = 255.0f * (x <= 0.0031308f ? 12.92f * x : curve) + 0.5f;
    }
}

}  // namespace

void encodeSrgb8(std::span<const float> linear, std::span<std::uint8_t> bytes) {
    assert(linear.size() == bytes.size());
    std::array<float, kAtOnce> steps;
    for (std::size_t first = 0; first < linear.size(); first += kAtOnce) {
        const std::size_t count = std::min(kAtOnce, linear.size() - first);
        const float* const light = &linear[first];
        std::uint8_t* const to = &bytes[first];
        // Ground, mostly: one colour again and again.
        const bool repeats = count > kPeriod && std::memcmp(light, light + kPeriod,
                                                            (count - kPeriod) * sizeof(float)) == 0;
        std::size_t done = repeats ? kPeriod : count;
        encode(light, steps.data(), done);
        for (std::size_t i = 0; i < done; ++i)
            to[i] = static_cast<std::uint8_t>(static_cast<int>(steps[i]));
        for (; done < count; done += std::min(done, count - done))
            std::memcpy(to + done, to, std::min(done, count - done));
    }
}

}  // namespace render
