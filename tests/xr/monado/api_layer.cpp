// An OpenXR API layer: the loader puts it between the program and the runtime (OpenXR loader
// specification, "API Layer Interaction"). It pretends what Monado never does by itself
// (kPretenceVariable), and writes down what the compositor is given. submitted_view.h says how it
// is told and what it writes; api_layer.h puts it in place.
#include <openxr/openxr.h>
#define XR_USE_GRAPHICS_API_OPENGL
#include <openxr/openxr_loader_negotiation.h>
#include <openxr/openxr_platform.h>

#include <dlfcn.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/xr/monado/submitted_view.h"

namespace {

// The runtime's functions, or the next layer's, of the one instance that lives at a time.
struct Next {
    PFN_xrGetInstanceProcAddr address;
    PFN_xrGetSystem getSystem;
    PFN_xrEnumerateSwapchainImages enumerateImages;
    PFN_xrAcquireSwapchainImage acquire;
    PFN_xrEndFrame endFrame;
    PFN_xrSuggestInteractionProfileBindings suggest;
    PFN_xrPathToString pathToString;
} next;

struct Images {
    std::vector<std::uint32_t> textures;
    std::uint32_t acquired = 0;  // the last one
};
std::map<XrSwapchain, Images> imagesOf;

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
}
bool pretends(const char* what) { return variable(tests::kPretenceVariable) == what; }

XrResult getSystem(XrInstance instance, const XrSystemGetInfo* info, XrSystemId* system) {
    if (pretends(tests::kNoHeadset)) return XR_ERROR_FORM_FACTOR_UNAVAILABLE;
    return next.getSystem(instance, info, system);
}

XrResult enumerateImages(XrSwapchain swapchain, std::uint32_t capacity, std::uint32_t* count,
                         XrSwapchainImageBaseHeader* images) {
    const XrResult result = next.enumerateImages(swapchain, capacity, count, images);
    if (XR_FAILED(result) || capacity == 0) return result;
    imagesOf[swapchain] = {};
    for (const auto& image :
         std::span(reinterpret_cast<XrSwapchainImageOpenGLKHR*>(images), *count))
        imagesOf[swapchain].textures.push_back(image.image);
    return result;
}

XrResult acquire(XrSwapchain swapchain, const XrSwapchainImageAcquireInfo* info,
                 std::uint32_t* index) {
    const XrResult result = next.acquire(swapchain, info, index);
    if (XR_SUCCEEDED(result)) imagesOf[swapchain].acquired = *index;
    return result;
}

XrResult suggest(XrInstance instance, const XrInteractionProfileSuggestedBinding* bindings) {
    char profile[XR_MAX_PATH_LENGTH];
    std::uint32_t size = 0;
    next.pathToString(instance, bindings->interactionProfile, sizeof profile, &size, profile);
    if (pretends(tests::kNoIndex) && std::string_view(profile).ends_with("index_controller"))
        return XR_SUCCESS;
    return next.suggest(instance, bindings);
}

// An enumerant that GL does not know.
void leaveGlError() {
    using GetProcAddress = void (*(*)(const char*))();
    const auto find = reinterpret_cast<GetProcAddress>(dlsym(RTLD_DEFAULT, "eglGetProcAddress"));
    reinterpret_cast<void (*)(unsigned)>(find("glEnable"))(0xBEEF);
}

tests::SubmittedView submitted(const XrCompositionLayerProjectionView& view) {
    const auto& [turn, at] = view.pose;
    tests::SubmittedView out{.orientation = {turn.x, turn.y, turn.z, turn.w},
                             .position = {at.x, at.y, at.z},
                             .left = view.fov.angleLeft,
                             .right = view.fov.angleRight,
                             .up = view.fov.angleUp,
                             .down = view.fov.angleDown};
    const auto* depth = static_cast<const XrCompositionLayerDepthInfoKHR*>(view.next);
    if (depth == nullptr || depth->type != XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR) return out;
    const XrRect2Di& rect = depth->subImage.imageRect;
    const Images& images = imagesOf[depth->subImage.swapchain];
    out.hasDepth = true;
    out.near = depth->nearZ, out.far = depth->farZ;
    out.minDepth = depth->minDepth, out.maxDepth = depth->maxDepth;
    out.depthRect = {rect.offset.x, rect.offset.y, rect.extent.width, rect.extent.height};
    out.depthTexture = images.textures.at(images.acquired);
    return out;
}

XrResult endFrame(XrSession session, const XrFrameEndInfo* info) {
    std::ofstream record(variable(tests::kRecordVariable), std::ios::binary | std::ios::app);
    for (const XrCompositionLayerBaseHeader* layer : std::span(info->layers, info->layerCount)) {
        if (layer->type != XR_TYPE_COMPOSITION_LAYER_PROJECTION) continue;
        const auto& eyes = *reinterpret_cast<const XrCompositionLayerProjection*>(layer);
        for (const auto& eye : std::span(eyes.views, eyes.viewCount)) {
            const tests::SubmittedView view = submitted(eye);
            record.write(reinterpret_cast<const char*>(&view), sizeof view);
        }
    }
    record.close();
    if (pretends(tests::kGlErrors)) leaveGlError();
    return next.endFrame(session, info);
}

XrResult getInstanceProcAddr(XrInstance instance, const char* name, PFN_xrVoidFunction* function) {
    const auto own = [&](const auto& replacement) {
        *function = reinterpret_cast<PFN_xrVoidFunction>(replacement);
        return XR_SUCCESS;
    };
    const std::string_view asked = name;
    if (asked == "xrGetSystem") return own(&getSystem);
    if (asked == "xrEnumerateSwapchainImages") return own(&enumerateImages);
    if (asked == "xrAcquireSwapchainImage") return own(&acquire);
    if (asked == "xrEndFrame") return own(&endFrame);
    if (asked == "xrSuggestInteractionProfileBindings") return own(&suggest);
    return next.address(instance, name, function);
}

// With OpenXR 1.0 and without the extension, a runtime does not offer LOCAL_FLOOR.
XrResult withoutFloor(XrInstanceCreateInfo& info, std::vector<const char*>& extensions) {
    if (XR_VERSION_MINOR(info.applicationInfo.apiVersion) > 0)
        return XR_ERROR_API_VERSION_UNSUPPORTED;
    std::erase_if(extensions,
                  [](std::string_view name) { return name == XR_EXT_LOCAL_FLOOR_EXTENSION_NAME; });
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.enabledExtensionNames = extensions.data();
    return XR_SUCCESS;
}

XrResult createApiLayerInstance(const XrInstanceCreateInfo* info,
                                const XrApiLayerCreateInfo* layers, XrInstance* instance) {
    XrInstanceCreateInfo asked = *info;
    std::vector<const char*> extensions(info->enabledExtensionNames,
                                        info->enabledExtensionNames + info->enabledExtensionCount);
    if (pretends(tests::kNoFloor))
        if (const XrResult refusal = withoutFloor(asked, extensions); XR_FAILED(refusal))
            return refusal;
    const XrApiLayerNextInfo& below = *layers->nextInfo;
    XrApiLayerCreateInfo layersBelow = *layers;
    layersBelow.nextInfo = below.next;
    const XrResult result = below.nextCreateApiLayerInstance(&asked, &layersBelow, instance);
    if (XR_FAILED(result)) return result;
    next.address = below.nextGetInstanceProcAddr;
    const auto find = [&](const char* name, auto& function) {
        next.address(*instance, name, reinterpret_cast<PFN_xrVoidFunction*>(&function));
    };
    find("xrGetSystem", next.getSystem);
    find("xrEnumerateSwapchainImages", next.enumerateImages);
    find("xrAcquireSwapchainImage", next.acquire);
    find("xrEndFrame", next.endFrame);
    find("xrSuggestInteractionProfileBindings", next.suggest);
    find("xrPathToString", next.pathToString);
    return result;
}

}  // namespace

// By this name the loader finds it.
extern "C" XRAPI_ATTR XrResult XRAPI_CALL xrNegotiateLoaderApiLayerInterface(
    const XrNegotiateLoaderInfo*, const char*, XrNegotiateApiLayerRequest* request) {
    request->layerInterfaceVersion = XR_CURRENT_LOADER_API_LAYER_VERSION;
    request->layerApiVersion = XR_CURRENT_API_VERSION;
    request->getInstanceProcAddr = &getInstanceProcAddr;
    request->createApiLayerInstance = &createApiLayerInstance;
    return XR_SUCCESS;
}
