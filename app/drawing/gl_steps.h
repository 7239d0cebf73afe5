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
    // How a step's points are placed.
    struct Places {
        std::optional<glm::dvec3> scale;
        render::Map map;
        friend bool operator==(const Places&, const Places&) = default;
    };
    struct Held {
        // `mesh`: that of another step, if it is of this one, too.
        Held(const std::shared_ptr<const timeseries::SortedStep>& of, const Places& at,
             render::PlacedPoints points, std::shared_ptr<render::GlMesh> mesh);
        // Drawn there from now on, where what is on the GPU serves; else another is needed.
        bool place(const Places& at);

        std::weak_ptr<const timeseries::SortedStep> sorted;
        Places places;
        render::PlacedPoints placed;
        render::GlStep onGpu;
    };

    // The step placed so, first in the list; made without points where it is not held yet. Pointers
    // to others stay valid until trim().
    Held& use(const std::shared_ptr<const timeseries::SortedStep>& sorted, const Places& at);
    render::Outline outline(const std::shared_ptr<const timeseries::SortedStep>& sorted,
                            const Places& at) const;
    // Frees what no reader holds any more, what has been placed elsewhere since, and the least
    // recently used beyond the budget; never the two given.
    void trim(std::uint64_t budgetBytes, const Held* drawn, const Held* coming);
    std::uint64_t bytes() const;

 private:
    std::list<Held> held_;  // most recently used first
};

}  // namespace app
