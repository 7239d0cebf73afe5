// Where the rays of a picture end. Pure.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <limits>
#include <span>
#include <vector>

#include "render/points/view.h"

namespace render {

// The view depth of what is opaque at each pixel; row 0 at the bottom. Of none, nowhere.
class OpaqueDepths {
 public:
    OpaqueDepths() = default;
    // Of what GL's depth buffer has: windowDepth(), turned about; 1 is nothing.
    OpaqueDepths(const View& view, std::span<const float> windowDepths) : width_(view.size.x) {
        for (const float depth : windowDepths)
            depths_.push_back(depth < 1 ? view.clipFromView[3][2] /
                                              (static_cast<double>(depth) + view.clipFromView[2][2])
                                        : kNowhere);
    }
    double at(const glm::ivec2& pixel) const {
        if (depths_.empty()) return kNowhere;
        return depths_[static_cast<std::size_t>(pixel.y * width_ + pixel.x)];
    }

 private:
    static constexpr double kNowhere = std::numeric_limits<double>::infinity();

    int width_ = 0;
    std::vector<double> depths_;
};

}  // namespace render
