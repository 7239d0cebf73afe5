#include "render/gl/timer.h"

#include <algorithm>

namespace render::gl {
namespace {

std::uint64_t result(const Query& query, GLenum what) {
    GLuint64 value = 0;
    glGetQueryObjectui64v(query.id(), what, &value);
    return value;
}

}  // namespace

Timer::Timer()
    : ring_{Section{.from = Query(GL_TIMESTAMP), .to = Query(GL_TIMESTAMP)},
            Section{.from = Query(GL_TIMESTAMP), .to = Query(GL_TIMESTAMP)},
            Section{.from = Query(GL_TIMESTAMP), .to = Query(GL_TIMESTAMP)},
            Section{.from = Query(GL_TIMESTAMP), .to = Query(GL_TIMESTAMP)}} {}

void Timer::begin() {
    timing_ = pending_ < ring_.size();
    if (!timing_) return;
    Section& section = ring_[(first_ + pending_) % ring_.size()];
    section.began = Clock::now();
    glQueryCounter(section.from.id(), GL_TIMESTAMP);
}

void Timer::end(std::uint64_t label) {
    if (!timing_) return;
    timing_ = false;
    Section& section = ring_[(first_ + pending_++) % ring_.size()];
    section.label = label;
    section.here = Clock::now() - section.began;
    glQueryCounter(section.to.id(), GL_TIMESTAMP);
}

std::optional<Timer::Time> Timer::poll() {
    std::optional<Time> newest;
    // Done in the order of their making.
    while (pending_ > 0 && result(ring_[first_].to, GL_QUERY_RESULT_AVAILABLE) == GL_TRUE) {
        const Section& done = ring_[first_];
        const std::uint64_t from = result(done.from, GL_QUERY_RESULT);
        const std::uint64_t to = result(done.to, GL_QUERY_RESULT);
        const std::chrono::nanoseconds there(to > from ? to - from : 0);
        newest = {done.label, std::max(there, done.here)};
        first_ = (first_ + 1) % ring_.size();
        --pending_;
    }
    return newest;
}

}  // namespace render::gl
