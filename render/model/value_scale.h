// How values become what a shader sees.
#pragma once

#include <optional>
#include <vector>

#include "render/model/scene.h"

namespace render {

// A float that is 0 and 1 at the ends of the narrowest colour map, beyond which it may lie. A
// field's own extent may be so much wider than a map (a fill value that the file does not tell)
// that no float over it would tell the map's values apart.
struct ValueScale {
    double lo = 0, halfWidth = 0;  // halves: the difference of two huge values stays finite
    // Of layers that are coloured by value; halfWidth is 0 when no map has a width.
    static ValueScale of(const std::vector<Layer>& layers);
    // Whether values on this scale serve as well as on `wanted`: to 1e-4 of its map.
    bool serves(const ValueScale& wanted) const;
    float operator()(double value) const;
    friend bool operator==(const ValueScale&, const ValueScale&) = default;
};

// What a scene's colours need of the values: nothing, when no layer is coloured by value.
std::optional<ValueScale> neededScale(const Scene& scene);

}  // namespace render
