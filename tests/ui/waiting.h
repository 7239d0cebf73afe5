// Waiting for what is to happen, never for a time: a loaded machine makes tests slow, not wrong.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <stdexcept>
#include <string_view>
#include <thread>

namespace ui {

constexpr std::chrono::seconds kDeadline{60};

// Asks again and again, after a pause each time; throws std::runtime_error when `holds` has not
// become true in time.
template <typename Condition>
void waitUntil(std::string_view what, const Condition& holds,
               std::chrono::milliseconds pause = std::chrono::milliseconds(5)) {
    const auto end = std::chrono::steady_clock::now() + kDeadline;
    while (!holds()) {
        if (std::chrono::steady_clock::now() > end)
            throw std::runtime_error(fmt::format("waited in vain: {}", what));
        std::this_thread::sleep_for(pause);
    }
}

}  // namespace ui
