// How long a part of a frame took, on the GPU or on this side of the driver, whichever was longer;
// told some frames later: asking never waits.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>

#include "render/gl/object.h"

namespace render::gl {

// Sections do not nest; two timers' may overlap.
class Timer {
 public:
    Timer();

    // A section is not timed when the GPU is so far behind that no query is free.
    void begin();
    // `label` comes back with the time.
    void end(std::uint64_t label = 0);

    struct Time {
        std::uint64_t label;
        std::chrono::nanoseconds took;
    };
    // The newest section that is done and was not told yet.
    std::optional<Time> poll();

 private:
    static constexpr std::size_t kSections = 4;
    using Clock = std::chrono::steady_clock;
    struct Section {
        Query from, to;
        Clock::time_point began{};
        std::chrono::nanoseconds here{0};  // between the calls of begin() and end()
        std::uint64_t label = 0;
    };
    std::array<Section, kSections> ring_;
    std::size_t first_ = 0, pending_ = 0;  // of the ring: oldest not told, and how many
    bool timing_ = false;
};

}  // namespace render::gl
