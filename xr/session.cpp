#include "xr/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <thread>
#include <utility>

#include "xr/forked_answer.h"
#include "xr/manifest.h"
#include "xr/session_impl.h"
#include "xr/visibility_mask.h"

namespace xr {
namespace {

constexpr auto kViews = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
// Between questions whether the session runs again.
constexpr std::chrono::milliseconds kIdle(10);
// Of LOCAL, whose origin is at the eyes, above the floor, where the runtime knows no floor.
constexpr float kGuessedEyeHeight = 1.5f;

// A session's images are made when it opens.
constexpr std::chrono::nanoseconds kPatienceToOpen = std::chrono::seconds(10);
// To let go of a runtime.
constexpr std::chrono::nanoseconds kPatienceToClose = std::chrono::seconds(3);

std::vector<const char*> extensionsFor(const Binding& binding) {
    std::vector<const char*> names{XR_KHR_OPENGL_ENABLE_EXTENSION_NAME,
                                   XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME,
                                   XR_KHR_VISIBILITY_MASK_EXTENSION_NAME,
                                   XR_FB_DISPLAY_REFRESH_RATE_EXTENSION_NAME, kLocalFloorExtension};
    if (std::holds_alternative<EglBinding>(binding))
        names.push_back(XR_MNDX_EGL_ENABLE_EXTENSION_NAME);
    return names;
}

std::string noOpenGl(const Runtime& runtime) {
    return fmt::format("the OpenXR runtime {} takes no OpenGL", runtime.name());
}

XrSession createSession(const Runtime& runtime, const void* graphics) {
    auto info = typed<XrSessionCreateInfo>(XR_TYPE_SESSION_CREATE_INFO);
    info.systemId = runtime.system();
    info.next = graphics;
    XrSession session = XR_NULL_HANDLE;
    runtime.check(xrCreateSession(runtime.instance(), &info, &session), "xrCreateSession");
    return session;
}

XrSession createSession(const Runtime& runtime, const Binding& binding) {
    // Asking is a duty, also for who needs no less than GL 4.5.
    auto needed = typed<XrGraphicsRequirementsOpenGLKHR>(XR_TYPE_GRAPHICS_REQUIREMENTS_OPENGL_KHR);
    runtime.check(
        runtime.function<PFN_xrGetOpenGLGraphicsRequirementsKHR>(
            "xrGetOpenGLGraphicsRequirementsKHR")(runtime.instance(), runtime.system(), &needed),
        "xrGetOpenGLGraphicsRequirementsKHR");
    if (const auto* egl = std::get_if<EglBinding>(&binding)) {
        auto graphics = typed<XrGraphicsBindingEGLMNDX>(XR_TYPE_GRAPHICS_BINDING_EGL_MNDX);
        // The type of the function differs between versions of the header.
        graphics.getProcAddress =
            reinterpret_cast<decltype(graphics.getProcAddress)>(&eglGetProcAddress);
        graphics.display = egl->display;
        graphics.config = egl->config;
        graphics.context = egl->context;
        return createSession(runtime, &graphics);
    }
    const auto& x = std::get<XlibBinding>(binding);
    auto graphics = typed<XrGraphicsBindingOpenGLXlibKHR>(XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR);
    graphics.xDisplay = static_cast<Display*>(x.display);
    graphics.visualid = x.visual;
    graphics.glxFBConfig = static_cast<GLXFBConfig>(x.fbConfig);
    graphics.glxDrawable = x.drawable;
    graphics.glxContext = static_cast<GLXContext>(x.context);
    return createSession(runtime, &graphics);
}

XrSpace createSpace(const Runtime& runtime, XrSession session, XrReferenceSpaceType type,
                    float y = 0) {
    auto info = typed<XrReferenceSpaceCreateInfo>(XR_TYPE_REFERENCE_SPACE_CREATE_INFO);
    info.referenceSpaceType = type;
    info.poseInReferenceSpace.orientation.w = 1;
    info.poseInReferenceSpace.position.y = y;
    XrSpace space = XR_NULL_HANDLE;
    runtime.check(xrCreateReferenceSpace(session, &info, &space), "xrCreateReferenceSpace");
    return space;
}

// Seated or standing, on the floor, where the user was when the runtime was last recentred.
XrSpace createStage(const Runtime& runtime, XrSession session) {
    std::uint32_t count = 0;
    runtime.check(xrEnumerateReferenceSpaces(session, 0, &count, nullptr),
                  "xrEnumerateReferenceSpaces");
    std::vector<XrReferenceSpaceType> offered(count);
    runtime.check(xrEnumerateReferenceSpaces(session, count, &count, offered.data()),
                  "xrEnumerateReferenceSpaces");
    if (std::ranges::count(offered, kLocalFloor) > 0)
        return createSpace(runtime, session, kLocalFloor);
    return createSpace(runtime, session, XR_REFERENCE_SPACE_TYPE_LOCAL, -kGuessedEyeHeight);
}

std::vector<EyeImages> createEyes(const Runtime& runtime, XrSession session) {
    std::array<XrViewConfigurationView, 2> views;
    views.fill(typed<XrViewConfigurationView>(XR_TYPE_VIEW_CONFIGURATION_VIEW));
    std::uint32_t count = 0;
    runtime.check(xrEnumerateViewConfigurationViews(runtime.instance(), runtime.system(), kViews,
                                                    views.size(), &count, views.data()),
                  "xrEnumerateViewConfigurationViews");
    const ImageFormats formats = imageFormats(runtime, session);
    std::vector<EyeImages> eyes;
    for (const XrViewConfigurationView& view : views)
        eyes.emplace_back(
            runtime, session,
            glm::ivec2(view.recommendedImageRectWidth, view.recommendedImageRectHeight),
            formats.color, formats.depth);
    return eyes;
}

// None where the runtime does not tell, also by an error: a display without a choice is no loss.
std::vector<double> offeredRates(const Runtime& runtime, XrSession session) {
    if (!runtime.has(XR_FB_DISPLAY_REFRESH_RATE_EXTENSION_NAME)) return {};
    const auto enumerate =
        runtime.function<PFN_xrEnumerateDisplayRefreshRatesFB>("xrEnumerateDisplayRefreshRatesFB");
    std::uint32_t count = 0;
    if (XR_FAILED(enumerate(session, 0, &count, nullptr))) return {};
    std::vector<float> rates(count);
    if (XR_FAILED(enumerate(session, count, &count, rates.data()))) return {};
    return {rates.begin(), rates.end()};
}

// Opaque where there is a choice; a see-through headset offers only others.
XrEnvironmentBlendMode chooseBlendMode(const Runtime& runtime) {
    std::uint32_t count = 0;
    runtime.check(xrEnumerateEnvironmentBlendModes(runtime.instance(), runtime.system(), kViews, 0,
                                                   &count, nullptr),
                  "xrEnumerateEnvironmentBlendModes");
    std::vector<XrEnvironmentBlendMode> modes(count);
    runtime.check(xrEnumerateEnvironmentBlendModes(runtime.instance(), runtime.system(), kViews,
                                                   count, &count, modes.data()),
                  "xrEnumerateEnvironmentBlendModes");
    if (modes.empty() || std::ranges::count(modes, XR_ENVIRONMENT_BLEND_MODE_OPAQUE) > 0)
        return XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
    return modes.front();
}

}  // namespace

Session::Impl::Impl(Runtime opened, const Binding& binding, const Patience& with)
    : patience(with),
      runtime(std::move(opened)),
      session(createSession(runtime, binding)),
      stage(createStage(runtime, session)),
      head(createSpace(runtime, session, XR_REFERENCE_SPACE_TYPE_VIEW)),
      blendMode(chooseBlendMode(runtime)),
      eyes(createEyes(runtime, session)),
      hidden{hiddenArea(runtime, session, 0), hiddenArea(runtime, session, 1)},
      refreshRates(offeredRates(runtime, session)),
      actions(runtime, session),
      waiter(session, patience.calls) {
    takeRate();
}

Session::Impl::~Impl() {
    // The framebuffers go before the images they are of.
    eyes.clear();
    // Once is enough to have waited for a runtime that does not answer.
    const Watchman::Watch watch(watchman, lost ? std::chrono::nanoseconds(0) : kPatienceToClose);
    runtime.close();
}

void Session::Impl::takeRate() {
    if (!runtime.has(XR_FB_DISPLAY_REFRESH_RATE_EXTENSION_NAME)) return;
    float rate = 0;
    if (XR_SUCCEEDED(runtime.function<PFN_xrGetDisplayRefreshRateFB>("xrGetDisplayRefreshRateFB")(
            session, &rate)))
        period.told(static_cast<double>(rate));
}

void Session::Impl::onState(State next) {
    switch (state.on(next)) {
        case Duty::BeginSession: {
            auto info = typed<XrSessionBeginInfo>(XR_TYPE_SESSION_BEGIN_INFO);
            info.primaryViewConfigurationType = kViews;
            runtime.check(xrBeginSession(session, &info), "xrBeginSession");
            return;
        }
        case Duty::EndSession:
            runtime.check(xrEndSession(session), "xrEndSession");
            return;
        case Duty::Leave:
            ended = true;
            return;
        case Duty::Lost:
            throw LostError(
                fmt::format("the headset's runtime {} says that it goes away", runtime.name()));
        case Duty::None:
            return;
    }
}

void Session::Impl::handleEvents() {
    while (true) {
        auto event = typed<XrEventDataBuffer>(XR_TYPE_EVENT_DATA_BUFFER);
        const XrResult result = xrPollEvent(runtime.instance(), &event);
        runtime.check(result, "xrPollEvent");
        if (result == XR_EVENT_UNAVAILABLE) return;
        if (event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED) {
            XrEventDataSessionStateChanged change;
            std::memcpy(&change, &event, sizeof change);
            if (change.session != session) continue;
            onState(static_cast<State>(change.state));  // the numbers are the same
            return;
        } else if (event.type == XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED) {
            controls = actions.controls();
        } else if (event.type == XR_TYPE_EVENT_DATA_VISIBILITY_MASK_CHANGED_KHR) {
            XrEventDataVisibilityMaskChangedKHR change;
            std::memcpy(&change, &event, sizeof change);
            if (change.session == session && change.viewIndex < hidden.size())
                hidden[change.viewIndex] = hiddenArea(runtime, session, change.viewIndex);
        } else if (event.type == XR_TYPE_EVENT_DATA_DISPLAY_REFRESH_RATE_CHANGED_FB) {
            period.forget();
            takeRate();
        } else if (event.type == XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING) {
            onState(State::LossPending);
        }
    }
}

std::string Session::Impl::unanswered(std::chrono::nanoseconds limit) const {
    return fmt::format("the headset's runtime {} has not answered for {:.0f} s", runtime.name(),
                       std::chrono::duration<double>(limit).count());
}

void Session::Impl::orLost(const std::function<void()>& calls, std::chrono::nanoseconds limit) {
    if (lost) throw LostError(*lost);
    const Watchman::Watch watch(watchman, limit);
    try {
        calls();
    } catch (const LostError& error) {
        lost = error.what();
    }
    // Also where nothing has failed: Monado locates things with success when it was interrupted.
    if (watch.fired()) lost = unanswered(limit);
    if (lost) throw LostError(*lost);
}

XrFrameState Session::Impl::waitFrame() {
    const auto answer = waiter.wait();
    if (!answer) {
        runtime.abandon();
        throw LostError(unanswered(patience.calls));
    }
    runtime.check(answer->result, "xrWaitFrame");
    return answer->frame;
}

std::variant<Session::Offer, NoHeadset> Session::ask(std::chrono::seconds patience) {
    // The answer's first letter says what it is; why there is no headset follows.
    constexpr char kNone = 'n', kEgl = 'e', kXlib = 'x';
    const auto answer = forkedAnswer(
        [&] {
            auto runtime = Runtime::open(
                {XR_KHR_OPENGL_ENABLE_EXTENSION_NAME, XR_MNDX_EGL_ENABLE_EXTENSION_NAME});
            if (const auto* none = std::get_if<NoHeadset>(&runtime)) return kNone + none->why;
            const auto& opened = std::get<Runtime>(runtime);
            if (!opened.has(XR_KHR_OPENGL_ENABLE_EXTENSION_NAME)) return kNone + noOpenGl(opened);
            return std::string(1, opened.has(XR_MNDX_EGL_ENABLE_EXTENSION_NAME) ? kEgl : kXlib);
        },
        patience);
    if (const auto* text = std::get_if<std::string>(&answer)) {
        if (text->front() == kNone) return NoHeadset{text->substr(1)};
        return Offer{text->front() == kEgl};
    }
    const auto manifest = runtimeManifest();
    return NoHeadset{fmt::format("the OpenXR runtime{} {} when it is asked for a headset",
                                 manifest ? " of " + manifest->string() : "",
                                 std::get<NoAnswer>(answer) == NoAnswer::Crashed
                                     ? "crashes"
                                     : fmt::format("does not answer for {} s", patience.count()))};
}

std::variant<std::unique_ptr<Session>, NoHeadset> Session::open(const Binding& binding,
                                                                const Patience& patience) {
    Watchman watchman;
    const Watchman::Watch watch(watchman, kPatienceToOpen);
    const auto extensions = extensionsFor(binding);
    auto runtime = Runtime::open(extensions);
    if (auto* none = std::get_if<NoHeadset>(&runtime)) return std::move(*none);
    auto& opened = std::get<Runtime>(runtime);
    if (!opened.has(XR_KHR_OPENGL_ENABLE_EXTENSION_NAME)) return NoHeadset{noOpenGl(opened)};
    if (std::holds_alternative<EglBinding>(binding) &&
        !opened.has(XR_MNDX_EGL_ENABLE_EXTENSION_NAME))
        return NoHeadset{fmt::format("the OpenXR runtime {} takes OpenGL from Xlib, not from EGL",
                                     opened.name())};
    try {
        return std::unique_ptr<Session>(
            new Session(std::make_unique<Impl>(std::move(opened), binding, patience)));
    } catch (const std::runtime_error& error) {
        return NoHeadset{error.what()};
    }
}

Session::Session(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Session::~Session() = default;

const std::string& Session::runtimeName() const { return impl_->runtime.name(); }
const SessionState& Session::state() const { return impl_->state; }
const Controls& Session::controls() const { return impl_->controls; }
bool Session::ended() const { return impl_->ended; }

std::unique_ptr<Session::Frame> Session::beginFrame() {
    std::unique_ptr<Frame> frame;
    impl_->orLost([&] {
        impl_->handleEvents();
        if (impl_->ended || !impl_->state.running()) return;
        const XrFrameState timing = impl_->waitFrame();
        impl_->period.predicted(std::chrono::nanoseconds(timing.predictedDisplayPeriod));
        const auto begin = typed<XrFrameBeginInfo>(XR_TYPE_FRAME_BEGIN_INFO);
        impl_->runtime.check(xrBeginFrame(impl_->session, &begin), "xrBeginFrame");
        // From here on it must be ended, which is its destructor's work.
        frame.reset(new Frame(std::unique_ptr<Frame::Impl>(new Frame::Impl{*impl_, timing})));
        frame->impl_->locate();
    });
    if (!frame && !impl_->ended) std::this_thread::sleep_for(kIdle);
    return frame;
}

void Session::requestExit() {
    impl_->orLost([&] {
        const XrResult result = xrRequestExitSession(impl_->session);
        if (result == XR_ERROR_SESSION_NOT_RUNNING) {
            impl_->ended = true;
            return;
        }
        impl_->runtime.check(result, "xrRequestExitSession");
    });
}

const std::vector<double>& Session::refreshRates() const { return impl_->refreshRates; }

void Session::requestRefreshRate(double rate) {
    if (std::exchange(impl_->requestedRate, rate) == rate) return;
    impl_->orLost([&] {
        // A rate that is refused leaves the one that is.
        impl_->runtime.function<PFN_xrRequestDisplayRefreshRateFB>("xrRequestDisplayRefreshRateFB")(
            impl_->session, static_cast<float>(rate));
    });
}

void Session::vibrate(int hand, double amplitude, std::chrono::nanoseconds duration) {
    impl_->orLost([&] { impl_->actions.vibrate(hand, amplitude, duration); });
}

}  // namespace xr
