#include "xr/runtime.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "xr/manifest.h"

namespace xr {
namespace {

// Some results of instance and system have no text before there is an instance.
std::string resultText(XrInstance instance, XrResult result) {
    char text[XR_MAX_RESULT_STRING_SIZE];
    if (instance != XR_NULL_HANDLE && XR_SUCCEEDED(xrResultToString(instance, result, text)))
        return text;
    return fmt::format("OpenXR error {}", static_cast<int>(result));
}

// The loader tells every missing file on stderr; our sentence says it once.
void quietLoader() { setenv("XR_LOADER_DEBUG", "none", 0); }

NoHeadset noRuntime() {
    const auto manifest = runtimeManifest();
    if (!manifest)
        return {
            "no OpenXR runtime is active on this machine (no openxr/1/active_runtime.json in its "
            "configuration folders, and XR_RUNTIME_JSON is not set)"};
    std::error_code unreadable;
    if (!std::filesystem::exists(*manifest, unreadable))
        return {fmt::format(
            "XR_RUNTIME_JSON names {} as the OpenXR runtime's, and there is no such file",
            manifest->string())};
    return {
        fmt::format("the OpenXR runtime that {} tells of cannot be loaded", manifest->string())};
}

NoHeadset noInstance(XrResult result) {
    if (result == XR_ERROR_RUNTIME_UNAVAILABLE || result == XR_ERROR_FILE_ACCESS_ERROR ||
        result == XR_ERROR_FILE_CONTENTS_INVALID)
        return noRuntime();
    const auto manifest = runtimeManifest();
    const std::string which = manifest ? " of " + manifest->string() : "";
    if (result == XR_ERROR_RUNTIME_FAILURE)
        return {fmt::format(
            "the OpenXR runtime{} does not answer: its service is to be started first", which)};
    return {fmt::format("the OpenXR runtime{} refuses to start: {}", which,
                        resultText(XR_NULL_HANDLE, result))};
}

XrResult extensionNames(std::vector<std::string>& names) {
    std::uint32_t count = 0;
    XrResult result = xrEnumerateInstanceExtensionProperties(nullptr, 0, &count, nullptr);
    if (XR_FAILED(result)) return result;
    std::vector<XrExtensionProperties> found(
        count, typed<XrExtensionProperties>(XR_TYPE_EXTENSION_PROPERTIES));
    result = xrEnumerateInstanceExtensionProperties(nullptr, count, &count, found.data());
    for (const XrExtensionProperties& e : found) names.emplace_back(e.extensionName);
    return result;
}

XrResult create(const std::vector<const char*>& extensions, XrInstance& instance) {
    auto info = typed<XrInstanceCreateInfo>(XR_TYPE_INSTANCE_CREATE_INFO);
    std::strcpy(info.applicationInfo.applicationName, "isochron");
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.enabledExtensionNames = extensions.data();
    info.applicationInfo.apiVersion = kApi11;
    const XrResult result = xrCreateInstance(&info, &instance);
    if (result != XR_ERROR_API_VERSION_UNSUPPORTED) return result;
    info.applicationInfo.apiVersion = kApi10;
    return xrCreateInstance(&info, &instance);
}

}  // namespace

std::variant<Runtime, NoHeadset> Runtime::open(const std::vector<const char*>& extensions) {
    quietLoader();
    std::vector<std::string> offered;
    if (const XrResult result = extensionNames(offered); XR_FAILED(result))
        return noInstance(result);
    std::vector<const char*> enabled;
    std::copy_if(extensions.begin(), extensions.end(), std::back_inserter(enabled),
                 [&](const char* name) { return std::ranges::count(offered, name) > 0; });
    XrInstance instance = XR_NULL_HANDLE;
    if (const XrResult result = create(enabled, instance); XR_FAILED(result))
        return noInstance(result);

    Runtime runtime(instance);
    runtime.enabled_.assign(enabled.begin(), enabled.end());
    auto properties = typed<XrInstanceProperties>(XR_TYPE_INSTANCE_PROPERTIES);
    runtime.name_ = XR_SUCCEEDED(xrGetInstanceProperties(instance, &properties))
                        ? properties.runtimeName
                        : "OpenXR";
    auto wanted = typed<XrSystemGetInfo>(XR_TYPE_SYSTEM_GET_INFO);
    wanted.formFactor = XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY;
    const XrResult result = xrGetSystem(instance, &wanted, &runtime.system_);
    if (result == XR_ERROR_FORM_FACTOR_UNAVAILABLE)
        return NoHeadset{fmt::format("the OpenXR runtime {} finds no headset", runtime.name_)};
    if (XR_FAILED(result))
        return NoHeadset{fmt::format("the OpenXR runtime {} offers no headset: {}", runtime.name_,
                                     resultText(instance, result))};
    return runtime;
}

Runtime::Runtime(Runtime&& other) noexcept
    : instance_(std::exchange(other.instance_, XR_NULL_HANDLE)),
      system_(other.system_),
      name_(std::move(other.name_)),
      enabled_(std::move(other.enabled_)) {}

void Runtime::close() {
    if (instance_ != XR_NULL_HANDLE) xrDestroyInstance(instance_);
    instance_ = XR_NULL_HANDLE;
}

bool Runtime::has(const char* extension) const {
    return std::ranges::count(enabled_, extension) > 0;
}

XrPath Runtime::path(const std::string& text) const {
    XrPath path = XR_NULL_PATH;
    check(xrStringToPath(instance_, text.c_str(), &path), "xrStringToPath");
    return path;
}

void Runtime::check(XrResult result, const char* call) const {
    if (XR_SUCCEEDED(result)) return;
    throw LostError(fmt::format("the headset's runtime {} went away: {} answers {}", name_, call,
                                resultText(instance_, result)));
}

}  // namespace xr
