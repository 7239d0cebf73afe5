// What the program has to say: quiet cards over the picture's lower half. Errors stay until they
// are closed; a long text is cut, and opened on demand.
#pragma once

#include <chrono>
#include <map>
#include <set>

#include "app/panels/desk.h"

namespace app::panels {

class Messages {
 public:
    // Upwards from `bottom`.
    void draw(Desk& desk, float bottom, std::chrono::nanoseconds dt);
    // Until the next one goes by itself; none when none does.
    std::optional<std::chrono::nanoseconds> untilNextGoes() const;

 private:
    static constexpr std::chrono::nanoseconds kStay = std::chrono::seconds(7);
    float card(Desk& desk, const Exploration::Message& message, float bottom, bool& closed);
    std::map<std::uint64_t, std::chrono::nanoseconds> shownFor_;  // of those that go by themselves
    std::set<std::uint64_t> opened_;                              // long ones, shown whole
};

}  // namespace app::panels
