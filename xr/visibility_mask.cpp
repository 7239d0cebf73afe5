#include "xr/visibility_mask.h"

#include <algorithm>
#include <vector>

namespace xr {

std::shared_ptr<const render::HiddenArea> hiddenArea(const Runtime& runtime, XrSession session,
                                                     std::uint32_t view) {
    if (!runtime.has(XR_KHR_VISIBILITY_MASK_EXTENSION_NAME)) return nullptr;
    const auto ask = runtime.function<PFN_xrGetVisibilityMaskKHR>("xrGetVisibilityMaskKHR");
    auto mask = typed<XrVisibilityMaskKHR>(XR_TYPE_VISIBILITY_MASK_KHR);
    const auto get = [&] {
        return XR_SUCCEEDED(ask(session, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, view,
                                XR_VISIBILITY_MASK_TYPE_HIDDEN_TRIANGLE_MESH_KHR, &mask));
    };
    if (!get()) return nullptr;
    std::vector<XrVector2f> vertices(mask.vertexCountOutput);
    std::vector<std::uint32_t> indices(mask.indexCountOutput);
    if (vertices.empty() || indices.empty()) return nullptr;
    mask.vertexCapacityInput = mask.vertexCountOutput;
    mask.vertices = vertices.data();
    mask.indexCapacityInput = mask.indexCountOutput;
    mask.indices = indices.data();
    if (!get()) return nullptr;
    render::HiddenArea area;
    for (const std::uint32_t index : indices) {
        if (index >= vertices.size()) return nullptr;
        area.corners.emplace_back(vertices[index].x, vertices[index].y);
    }
    return std::make_shared<const render::HiddenArea>(std::move(area));
}

}  // namespace xr
