#include "app/command/drawing_device.h"

#include <fmt/format.h>

#include "render/together.h"

namespace app {

using Choice = render::SplatterChoice;

DrawingDevice::DrawingDevice(const DrawnBy& asked) : by_(asked.splatter) {
    if (by_ == Choice::ByDevice && render::gl::onlyProcessorsDraw(asked.device)) by_ = Choice::Cpu;
    if (by_ == Choice::ByDevice || by_ == Choice::Gl) context_.emplace(asked.device);
}

std::string DrawingDevice::program() const {
    if (by_ == Choice::Exact) return "the program in double";
    const unsigned threads = render::sharingThreads();
    return fmt::format("the program on {} thread{}", threads, threads == 1 ? "" : "s");
}

}  // namespace app
