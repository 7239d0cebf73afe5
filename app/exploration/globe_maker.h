// The meshes of globes (render/points/globe.h), made beside the interface: of millions of points
// they take seconds.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "timeseries/grid/grid.h"

namespace app {

// One thread.
class GlobeMaker {
 public:
    // `wake` is called from another thread when a mesh is there, also after this is gone.
    explicit GlobeMaker(std::function<void()> wake) : wake_(std::move(wake)) {}
    GlobeMaker(const GlobeMaker&) = delete;
    GlobeMaker& operator=(const GlobeMaker&) = delete;
    ~GlobeMaker() { forget(); }

    // The points of a grid, stretched so (PlacedPoints).
    struct Wish {
        std::shared_ptr<const timeseries::Grid> grid;
        std::optional<glm::dvec3> stretch;
    };
    // Who holds the mesh has points placed on the globe at once. Null where the grid lies flat, and
    // why.
    struct Made {
        std::shared_ptr<const timeseries::Mesh> mesh;
        std::string whyFlat;
    };
    // Nothing while it is not there.
    std::optional<Made> made(const Wish& wish) const;
    // Begins to make it: few points at once, many on a thread of its own, one grid after the other,
    // which nobody waits for. One that is stretched otherwise is broken off. Whether it began.
    bool want(const Wish& wish);
    void forget();  // nobody wants any more what is being made or was made last

 private:
    struct Work;
    std::function<void()> wake_;
    std::shared_ptr<Work> work_;  // the one that was begun last, which its thread shares
};

}  // namespace app
