// Another program with a headset session, for what that does to the first: frames until its input
// ends. Exits with 1 when it has no session.
#include <poll.h>

#include <cstdio>

#include "render/gl/headless_context.h"
#include "xr/session.h"

int main() {
    const render::gl::HeadlessContext context;
    const auto egl = context.eglNames();
    auto opened = xr::Session::open(xr::EglBinding{egl.display, nullptr, egl.context});
    if (auto* none = std::get_if<xr::NoHeadset>(&opened)) {
        std::fprintf(stderr, "%s\n", none->why.c_str());
        return 1;
    }
    xr::Session& session = *std::get<0>(opened);
    pollfd input{0, POLLIN, 0};
    while (!session.ended() && poll(&input, 1, 0) == 0) session.beginFrame();
}
