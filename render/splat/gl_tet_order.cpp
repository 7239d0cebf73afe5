#include "render/splat/gl_tet_order.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "render/shader_sources.h"

namespace render {

void GlTetOrder::findKeys(const TetsToOrder& tets, const glm::dvec3& eye, bool ofCells) {
    constexpr GLuint kGroup = 256, kAcross = 1 << 15;
    const double away = glm::length(eye), s = std::max(away, tets.radius);
    const glm::vec4 overS = s > 0 ? glm::vec4(glm::dvec4(eye / s, away / s)) : glm::vec4(0);
    glUseProgram(programs_->keys.id());
    glUniform1ui(0, tets.count);
    glUniform1i(1, ofCells ? 1 : 0);
    glUniform4fv(2, 1, &overS.x);
    glUniform1f(3, s > 0 ? static_cast<float>(1 / s) : 0);
    tets.pieces.bindStorage(0);
    tets.cells.bindStorage(1);
    tets.middles.bindStorage(2);
    sort_.entries().bindStorage(3);
    const GLuint groups = (tets.count + kGroup - 1) / kGroup, across = std::min(groups, kAcross);
    glDispatchCompute(across, (groups + across - 1) / across, 1);
    betweenShaders();
}

std::shared_ptr<const gl::Buffer> GlTetOrder::operator()(const TetsToOrder& tets,
                                                         const glm::dvec3& eye) {
    auto places = std::make_shared<const gl::Buffer>(tets.count * sizeof(std::uint32_t));
    if (tets.count == 0) return places;
    if (!programs_)
        programs_.emplace(Programs{gl::Program::ofCompute("tet_keys", shaders::tet_keys_comp),
                                   GlRadixSort::scatter("#define PLACES\n")});
    constexpr unsigned kDigitsOfAKey = 4;
    sort_.begin(tets.count);
    findKeys(tets, eye, false);
    sort_.sort(0, kDigitsOfAKey);
    findKeys(tets, eye, true);
    sort_.sort(0, kDigitsOfAKey - 1);
    places->bindStorage(2);
    sort_.last(8 * (kDigitsOfAKey - 1), programs_->places);
    sort_.shrink();
    return places;
}

}  // namespace render
