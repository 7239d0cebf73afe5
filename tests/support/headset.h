// A session of xr::Session with Monado's devices, and frames of it, for tests.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <variant>

#include "render/gl/headless_context.h"
#include "render/gl/pass.h"
#include "tests/ui/waiting.h"
#include "xr/session.h"

namespace tests {

// Fails the test, and gives null, when there is none.
inline std::unique_ptr<xr::Session> openHeadset(const render::gl::HeadlessContext& context,
                                                const xr::Patience& patience = {}) {
    const auto egl = context.eglNames();
    auto opened = xr::Session::open(xr::EglBinding{egl.display, nullptr, egl.context}, patience);
    if (auto* session = std::get_if<0>(&opened)) return std::move(*session);
    ADD_FAILURE() << std::get<xr::NoHeadset>(opened).why;
    return nullptr;
}

// Draws a frame: both eyes of one colour, and nothing nearer than the far plane.
inline void submitColor(xr::Session::Frame& frame, const glm::vec4& color = {0, 0.5f, 1, 1}) {
    for (const xr::Eye& eye : frame.eyes(1))
        render::gl::begin({.framebuffer = eye.framebuffer,
                           .size = eye.size,
                           .clearColor = color,
                           .clearDepth = 1.0f,
                           .depth = render::gl::DepthTest::TestAndWrite,
                           .srgbWrite = true});
    frame.submit(0.05, 100);
}

// Frames, each given to `look` before it is drawn, until `done` holds; false when it never did.
template <typename Look, typename Done>
bool framesUntil(xr::Session& session, Look look, Done done) {
    const auto end = std::chrono::steady_clock::now() + ui::kDeadline;
    while (!done()) {
        if (session.ended() || std::chrono::steady_clock::now() > end) return done();
        const auto frame = session.beginFrame();
        if (!frame) continue;
        look(*frame);
        submitColor(*frame);
    }
    return true;
}
inline bool framesUntilFocused(xr::Session& session) {
    return framesUntil(
        session, [](auto&) {}, [&] { return session.state().focused(); });
}

}  // namespace tests
