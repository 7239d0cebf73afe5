// What a ray sees of layers that it passes, from the eye on, of the colour that the field's value
// has: emission and absorption, or the sum of all without them.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "render/model/cell_splat.h"
#include "render/model/scene.h"

namespace render {

class LightOnRay {
 public:
    enum class Of { Front, All };
    // The layers outlive this.
    explicit LightOnRay(std::span<const Layer> layers, Of what = Of::Front)
        : layers_(layers), what_(what) {}

    void begin() {
        rgb_ = glm::dvec3(0);
        through_ = 1;
        depth_ = 0;
    }
    // The next piece of the way, on all of which it is in these layers, each of an optical depth of
    // its own there: valueAt(i, share) is the field's value for the i-th of them at a share of the
    // piece, and shadeAt(i, share) what light makes of its colour there.
    template <typename ValueAt, typename ShadeAt>
    void pass(std::span<const std::size_t> in, std::span<const double> depths,
              const ValueAt& valueAt, const ShadeAt& shadeAt) {
        double depth = 0;
        for (const double each : depths) depth += each;
        if (!(depth > 0)) return;
        const double taken = -std::expm1(-depth / kSteps);
        // Where in a step what leaves it comes from, in the mean.
        const double front = what_ == Of::All ? 0.5 : shareFromFront(depth / kSteps);
        for (int step = 0; step < kSteps; ++step) {
            glm::dvec3 colors(0);
            for (std::size_t i = 0; i < in.size(); ++i) {
                const double share = (step + front) / kSteps;
                const Shade shade = shadeAt(i, share);
                colors += depths[i] * shade.of(colorOf(layers_[in[i]].style, valueAt(i, share)));
            }
            if (what_ == Of::All) {
                rgb_ += colors / double{kSteps};
                continue;
            }
            rgb_ += through_ * taken / depth * colors;
            through_ *= 1 - taken;
        }
        depth_ += depth;
    }
    // What would come from behind is not seen.
    bool isOpaque() const { return through_ < 1e-7; }
    // Premultiplied, linear; of all, the sum of optical depths times colours, and of those alone.
    glm::dvec4 light() const { return {rgb_, what_ == Of::All ? depth_ : 1 - through_}; }

    // Along a piece a colour by value is taken in so many steps.
    static constexpr int kSteps = 8;

 private:
    std::span<const Layer> layers_;
    Of what_;
    glm::dvec3 rgb_{0};
    double through_ = 1, depth_ = 0;
};

}  // namespace render
