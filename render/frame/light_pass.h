// What becomes of an eye's planes: the opaque scene that hides splats, and the finished light. GL
// draws it (render/frame/gl_light.h), or the program (render/frame/memory_light.h).
#pragma once

#include <memory>
#include <span>

#include "render/annotate/axes.h"
#include "render/annotate/legend.h"
#include "render/annotate/placard.h"
#include "render/splat/targets.h"

namespace render {

// All that stands in an eye's picture beside splats. Refers to what it was made of.
struct EyeContent {
    const Scene& scene;
    const View& view;
    const glm::dvec3& background;  // linear
    const AxesMeshes& axes;
    const FlatMesh& legend;
    std::span<const Placard> placards;
};

class LightPass {
 public:
    virtual ~LightPass() = default;
    // `font`: of the meshes drawn from then on; it must outlive this.
    virtual void setFont(const Font& font) = 0;
    virtual std::unique_ptr<Targets> targets(glm::ivec2 size) const = 0;
    // Leaves the targets' depth holding what hides splats, and nothing else.
    virtual void drawDepth(const FlatMesh& behind, std::span<const Placard> placards,
                           const View& view, Targets& targets) = 0;
    // Planes of the scene that were summed in coarser(view, across), in the view's pixels: between
    // the middles of coarse ones, what lies around them. REQUIRES of both: this one's targets(),
    // of these sizes.
    virtual void enlarge(const Scene& scene, const View& view, int across, Targets& from,
                         Targets& to) = 0;
    // Makes the light of the planes that channelsFor(scene) names. REQUIRES: drawDepth() before.
    virtual void drawLight(const EyeContent& content, LightAs as, Targets& targets) = 0;
};

}  // namespace render
