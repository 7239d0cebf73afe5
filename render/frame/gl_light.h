// An eye's light drawn by GL, with placards and what nobody sees of a picture.
#pragma once

#include <map>
#include <optional>

#include "render/annotate/flat_pass.h"
#include "render/annotate/hidden_area_pass.h"
#include "render/frame/light_pass.h"
#include "render/splat/gl_targets.h"

namespace render {

class GlLight final : public LightPass {
 public:
    // `layers`: the buffer in which GlSplatter::setLayers puts the scene's.
    explicit GlLight(const gl::Buffer& layers) : layers_(layers) {}

    void setFont(const Font& font) override { flat_.emplace(font); }
    std::unique_ptr<Targets> targets(glm::ivec2 size) const override;
    void drawDepth(const FlatMesh& behind, std::span<const Placard> placards, const View& view,
                   Targets& targets) override;
    void enlarge(const Scene& scene, const View& view, int across, Targets& from,
                 Targets& to) override;
    void drawLight(const EyeContent& content, LightAs as, Targets& targets) override;
    // Light of placards alone.
    void drawPlacards(std::span<const Placard> placards, const glm::dvec3& background,
                      const View& view, Targets& targets);

 private:
    void resolve(const Scene& scene, const View& view, const GlTargets& targets);
    const gl::Program& resolveProgram(const Scene& scene);

    const gl::Buffer& layers_;
    std::optional<FlatPass> flat_;
    std::map<int, gl::Program> resolve_;  // by the number of layers; -1 for an ordered scene
    PlacardPass placards_;
    HiddenAreaPass hidden_;
    std::optional<gl::Program> enlarge_;
    gl::VertexArray noVertices_;
};

}  // namespace render
