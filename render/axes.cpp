#include "render/axes.h"
namespace render {
FontStyle labelStyle(glm::ivec2) { return {}; }
FontStyle titleStyle(glm::ivec2) { return {FontWeight::SemiBold, 24}; }
AxesMeshes axesMeshes(const timeseries::Grid&, const Lattice&, const View&, const glm::dvec3&,
                      const Font&) {
    return {};
}
}  // namespace render
