// What draws a command's pictures: GL on a device, or the program itself, which needs no context.
#pragma once

#include <optional>
#include <string>

#include "app/choices/options.h"
#include "render/gl/headless_context.h"

namespace app {

class DrawingDevice {
 public:
    // Makes a GL context current, if one is needed, while this lives. Throws as HeadlessContext
    // does.
    explicit DrawingDevice(const DrawnBy& asked);
    // As asked, or Cpu where only a processor could have drawn.
    render::SplatterChoice splatter() const { return by_; }
    // "llvmpipe (LLVM 15.0.6, 256 bits), GL 4.5"; "the program on 2 threads", which draws where
    // there is no context, and what GL does not.
    std::string name() const { return context_ ? context_->renderer() : program(); }
    std::string program() const;

 private:
    render::SplatterChoice by_;
    std::optional<render::gl::HeadlessContext> context_;
};

}  // namespace app
