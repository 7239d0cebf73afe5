// The steps that a canvas has on the GPU: the one on the screen, the one that is coming, and a few
// more under a byte budget.
#pragma once

#include <list>
#include <memory>

#include "render/splat/gl_splatter.h"
#include "timeseries/index/sorted_step.h"

namespace app {

class GlSteps {
 public:
    struct Held {
        // `mesh`: that of another step, if it is of this one, too.
        Held(const std::shared_ptr<const timeseries::SortedStep>& of,
             const std::optional<glm::dvec3>& stretch, std::shared_ptr<render::GlMesh> mesh);
        // Drawn with other proportions from now on.
        void stretch(const std::optional<glm::dvec3>& by);

        std::weak_ptr<const timeseries::SortedStep> sorted;
        std::optional<glm::dvec3> scale;
        render::PlacedPoints placed;
        render::GlStep onGpu;
    };

    // The step, first in the list; made without points where it is not held yet. Pointers to others
    // stay valid until trim().
    Held& use(const std::shared_ptr<const timeseries::SortedStep>& sorted,
              const std::optional<glm::dvec3>& scale);
    // Frees what no reader holds any more, and the least recently used beyond the budget; never the
    // two given.
    void trim(std::uint64_t budgetBytes, const Held* drawn, const Held* coming);
    std::uint64_t bytes() const;

 private:
    std::list<Held> held_;  // most recently used first
};

}  // namespace app
