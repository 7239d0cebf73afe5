// What the program has to say: quiet cards over the picture's lower half. Errors stay until they
// are closed, the last one in sight and the earlier ones behind a counter; a long text is cut, and
// opened on demand.
#pragma once

#include <chrono>
#include <map>
#include <set>

#include "app/panels/panel_context.h"

namespace app::panels {

class Messages {
 public:
    // Upwards from `bottom`.
    void draw(PanelContext& context, float bottom, std::chrono::nanoseconds dt);
    // Until the next one goes by itself; none when none does.
    std::optional<std::chrono::nanoseconds> untilNextGoes() const;

 private:
    static constexpr std::chrono::nanoseconds kStay = std::chrono::seconds(7);
    struct Others {  // errors before this one
        std::size_t count = 0;
        bool shown = false;
    };
    struct Pressed {
        bool close = false, closeAll = false;
    };
    float card(PanelContext& context, const Exploration::Message& message, float bottom,
               const Others& others, Pressed& pressed);
    std::map<std::uint64_t, std::chrono::nanoseconds> shownFor_;  // of those that go by themselves
    std::set<std::uint64_t> opened_;                              // long ones, shown whole
    bool areAllShown_ = false;                                    // of the errors
};

}  // namespace app::panels
