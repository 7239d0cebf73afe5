// What the program has to say: quiet cards over the picture. Errors stay until they are closed.
#pragma once

#include <chrono>
#include <map>

#include "app/panels/desk.h"

namespace app::panels {

class Messages {
 public:
    void draw(Desk& desk, std::chrono::nanoseconds dt);
    // Until the next one goes by itself; none when none does.
    std::optional<std::chrono::nanoseconds> untilNextGoes() const;

 private:
    static constexpr std::chrono::nanoseconds kStay = std::chrono::seconds(7);
    std::map<std::uint64_t, std::chrono::nanoseconds> shownFor_;  // of those that go by themselves
};

}  // namespace app::panels
