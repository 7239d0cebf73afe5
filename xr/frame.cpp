#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "xr/poses.h"
#include "xr/session.h"
#include "xr/session_impl.h"

namespace xr {

void Session::Frame::Impl::locate() {
    auto location = typed<XrSpaceLocation>(XR_TYPE_SPACE_LOCATION);
    session.runtime.check(
        xrLocateSpace(session.head, session.stage, timing.predictedDisplayTime, &location),
        "xrLocateSpace");
    head = validPose(location);
    hands = session.actions.read(session.stage, timing.predictedDisplayTime);
}

std::vector<Eye> Session::Frame::Impl::located() const {
    auto info = typed<XrViewLocateInfo>(XR_TYPE_VIEW_LOCATE_INFO);
    info.viewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
    info.displayTime = timing.predictedDisplayTime;
    info.space = session.stage;
    auto state = typed<XrViewState>(XR_TYPE_VIEW_STATE);
    std::array<XrView, 2> views;
    views.fill(typed<XrView>(XR_TYPE_VIEW));
    std::uint32_t count = 0;
    session.runtime.check(
        xrLocateViews(session.session, &info, &state, views.size(), &count, views.data()),
        "xrLocateViews");
    std::vector<Eye> found;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const auto eye = validEye(views[i], state.viewStateFlags);
        if (!eye) return {};
        found.push_back({.stageFromEye = eye->stageFromEye,
                         .fov = eye->fov,
                         .size = {},
                         .hidden = session.hidden[i]});
    }
    return found;
}

void Session::Frame::Impl::end(const std::vector<const XrCompositionLayerBaseHeader*>& layers) {
    open = false;
    for (EyeImages& images : session.eyes) images.release();
    auto info = typed<XrFrameEndInfo>(XR_TYPE_FRAME_END_INFO);
    info.displayTime = timing.predictedDisplayTime;
    info.environmentBlendMode = session.blendMode;
    info.layerCount = static_cast<std::uint32_t>(layers.size());
    info.layers = layers.data();
    session.runtime.check(xrEndFrame(session.session, &info), "xrEndFrame");
}

Session::Frame::Frame(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Session::Frame::~Frame() {
    if (!impl_->open || impl_->session.lost) return;
    try {
        impl_->session.orLost([&] { impl_->end({}); }, impl_->session.patience.withDrawing);
    } catch (const LostError&) {
        // The session remembers, and the next call tells.
    }
}

std::chrono::nanoseconds Session::Frame::displayTime() const {
    return std::chrono::nanoseconds(impl_->timing.predictedDisplayTime);
}
std::chrono::nanoseconds Session::Frame::period() const { return impl_->session.period.now(); }
bool Session::Frame::shouldRender() const { return impl_->timing.shouldRender; }
const std::array<Hand, 2>& Session::Frame::hands() const { return impl_->hands; }
const std::optional<Pose>& Session::Frame::head() const { return impl_->head; }

std::span<const Eye> Session::Frame::eyes(double scale) {
    assert(impl_->open && scale > 0 && scale <= 1);
    if (!shouldRender() || !impl_->eyes.empty()) return impl_->eyes;
    impl_->session.orLost([&] {
        std::vector<Eye> eyes = impl_->located();
        for (std::size_t i = 0; i < eyes.size(); ++i) {
            EyeImages& images = impl_->session.eyes[i];
            eyes[i].size = glm::ivec2(glm::ceil(glm::dvec2(images.size()) * scale));
            eyes[i].framebuffer = images.acquire();
        }
        impl_->eyes = std::move(eyes);
    });
    return impl_->eyes;
}

void Session::Frame::submit(double near, double far) {
    assert(impl_->open && 0 < near && near < far);
    std::array<XrCompositionLayerProjectionView, 2> views;
    std::array<XrCompositionLayerDepthInfoKHR, 2> depths;
    for (std::size_t i = 0; i < impl_->eyes.size(); ++i) {
        const Eye& eye = impl_->eyes[i];
        const EyeImages& images = impl_->session.eyes[i];
        views[i] =
            typed<XrCompositionLayerProjectionView>(XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW);
        views[i].pose = toXr(eye.stageFromEye);
        views[i].fov = {static_cast<float>(eye.fov.left), static_cast<float>(eye.fov.right),
                        static_cast<float>(eye.fov.up), static_cast<float>(eye.fov.down)};
        views[i].subImage = images.color(eye.size);
        if (const auto depth = images.depth(eye.size)) {
            depths[i] =
                typed<XrCompositionLayerDepthInfoKHR>(XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR);
            depths[i].subImage = *depth;
            depths[i].minDepth = 0;
            depths[i].maxDepth = 1;
            depths[i].nearZ = static_cast<float>(near);
            depths[i].farZ = static_cast<float>(far);
            views[i].next = &depths[i];
        }
    }
    auto layer = typed<XrCompositionLayerProjection>(XR_TYPE_COMPOSITION_LAYER_PROJECTION);
    layer.space = impl_->session.stage;
    layer.viewCount = static_cast<std::uint32_t>(views.size());
    layer.views = views.data();
    std::vector<const XrCompositionLayerBaseHeader*> layers;
    if (!impl_->eyes.empty())
        layers.push_back(reinterpret_cast<const XrCompositionLayerBaseHeader*>(&layer));
    impl_->session.orLost([&] { impl_->end(layers); }, impl_->session.patience.withDrawing);
}

}  // namespace xr
