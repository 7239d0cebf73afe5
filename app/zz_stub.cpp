#include "app/command_line.h"
#include "render/frame_pace.h"
#include "render/pick.h"
namespace app {
std::vector<std::string> renderArguments(const Explorer&, const std::filesystem::path&, const std::filesystem::path&) { return {}; }
std::string shellText(const std::vector<std::string>&) { return {}; }
}
namespace render {
std::optional<Picked> pick(const Scene&, const View&, const glm::dvec2&) { return {}; }
FramePace::FramePace(std::chrono::nanoseconds t) : targetNs_(double(t.count())), budget_(5000000) { (void)targetNs_; (void)fixedNs_; (void)perSplatNs_; }
void FramePace::setTarget(std::chrono::nanoseconds) {}
void FramePace::took(std::uint64_t, std::chrono::nanoseconds) {}
}
