#include "render/gl/gpu_timer.h"

namespace render::gl {
namespace {

std::uint64_t result(const Query& query, GLenum what) {
    GLuint64 value = 0;
    glGetQueryObjectui64v(query.id(), what, &value);
    return value;
}

}  // namespace

GpuTimer::GpuTimer()
    : ring_{Section{Query(GL_TIMESTAMP), Query(GL_TIMESTAMP)},
            Section{Query(GL_TIMESTAMP), Query(GL_TIMESTAMP)},
            Section{Query(GL_TIMESTAMP), Query(GL_TIMESTAMP)},
            Section{Query(GL_TIMESTAMP), Query(GL_TIMESTAMP)}} {}

void GpuTimer::begin() {
    timing_ = pending_ < ring_.size();
    if (timing_) glQueryCounter(ring_[(first_ + pending_) % ring_.size()].from.id(), GL_TIMESTAMP);
}

void GpuTimer::end(std::uint64_t label) {
    if (!timing_) return;
    timing_ = false;
    Section& section = ring_[(first_ + pending_++) % ring_.size()];
    section.label = label;
    glQueryCounter(section.to.id(), GL_TIMESTAMP);
}

std::optional<GpuTimer::Time> GpuTimer::poll() {
    std::optional<Time> newest;
    // Done in the order of their making.
    while (pending_ > 0 && result(ring_[first_].to, GL_QUERY_RESULT_AVAILABLE) == GL_TRUE) {
        const Section& done = ring_[first_];
        const std::uint64_t from = result(done.from, GL_QUERY_RESULT);
        const std::uint64_t to = result(done.to, GL_QUERY_RESULT);
        newest = {done.label, std::chrono::nanoseconds(to > from ? to - from : 0)};
        first_ = (first_ + 1) % ring_.size();
        --pending_;
    }
    return newest;
}

}  // namespace render::gl
