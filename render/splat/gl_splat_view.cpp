#include "render/splat/gl_splat_view.h"

#include "render/model/footprint.h"
#include "render/points/mesh_bounds.h"

namespace render {
namespace {

// How the world and the clip box lie to a mesh's own floats.
void placeMesh(SplatViewBlock& b, const Scene& scene) {
    const timeseries::Mesh& mesh = *scene.placed.mesh();
    const auto stored = mesh.stored();
    const MeshBounds bounds = boundsIn(mesh, scene.clip);
    b.meshScale = glm::vec4(glm::dvec4(stored.unit * scene.placed.scale(), stored.turned));
    b.meshOffset = glm::vec4(
        glm::dvec4(scene.placed.axesFromGrid(stored.origin), mesh.volumePerDeterminant()));
    b.meshFrom = glm::vec4(bounds.lo, 0);
    b.meshTo = glm::vec4(bounds.hi, 0);
    b.placed.w = static_cast<std::uint32_t>(stored.points.size());
    b.clipLo = {0, 0, bounds.firstLevel, 0};
    b.clipHi = {0, 0, bounds.lastLevel, 0};
}

}  // namespace

SplatViewBlock pointsBlock(const Scene& scene) {
    SplatViewBlock b{};
    b.placed = {scene.placed.size(), 0};
    b.clipLo = {scene.clip.lo, 0};
    b.clipHi = {scene.clip.hi, 0};
    if (scene.placed.isMesh()) placeMesh(b, scene);
    return b;
}

SplatViewBlock viewBlock(const Scene& scene, const View& view, const PointsView& seen, int guard) {
    SplatViewBlock b = pointsBlock(scene);
    const glm::dmat4& clip = view.clipFromView;
    const PixelRays& rays = seen.rays;
    const Footprint& footprint = scene.footprint;
    b.viewFromAxes = glm::mat4(scene.placed.inAxes(view).viewFromWorld);
    b.rayAxis = glm::vec4(glm::dvec4(rays.axis, seen.rayLength));
    b.perPixelX = glm::vec4(glm::dvec4(rays.perPixelX, rays.focal.x));
    b.perPixelY = glm::vec4(glm::dvec4(rays.perPixelY, rays.focal.y));
    b.window = {glm::vec2(rays.centre), glm::vec2(view.size)};
    b.depths = {rays.near, -clip[2][2], clip[3][2], guard};
    // A point's mass is its cell's volume; a kernel's is that over the kernel's.
    const double perSides = footprint.kernel == Kernel::Point ? seen.cellVolume : 1;
    b.kernel = {footprint.size * kQuarticRadius, seen.smallestRadius, perSides / seen.unitLength,
                static_cast<float>(pointSide(footprint))};
    b.slopeAndLengths = glm::vec4(glm::dvec4(
        1.0 / (rays.focal * rays.focal), seen.lengthening.most / seen.rayLength, seen.pixelArea));
    b.domainLo = glm::vec4(glm::dvec4(seen.domain.lo, kQuarticRadius));
    b.domainHi = glm::vec4(glm::dvec4(seen.domain.hi, 0));
    b.boxHalf = glm::vec4(glm::dvec4(scene.placed.boxHalf(), 0));
    return b;
}

}  // namespace render
