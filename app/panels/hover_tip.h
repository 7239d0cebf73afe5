// What stands under a pointer that rests on a picture that rests: value, position and index, beside
// it, until either moves.
#pragma once

#include <chrono>
#include <optional>
#include <span>
#include <string>

#include "app/panels/panel_context.h"

namespace app::panels {

// How wide the names of axes are that stand one below the other: as the longest, within what leaves
// room for the numbers beside them.
float nameColumn(ImFont& font, std::span<const std::string> names, float scale);

class HoverTip {
 public:
    // Once a frame. `cursor`: where the pointer is on the picture, in its pixels; none where it is
    // elsewhere or has pressed something. Asks for a reading by Requests::hover.
    void follow(PanelContext& context, const std::optional<glm::vec2>& cursor,
                std::chrono::nanoseconds dt);
    void take(const std::optional<Reading>& reading);
    void draw(const PanelContext& context) const;
    // Until something happens by itself.
    std::optional<std::chrono::nanoseconds> untilNextChange() const;

 private:
    static constexpr std::chrono::milliseconds kRest{300};
    std::optional<glm::vec2> at_;
    std::uint64_t picture_ = 0;
    std::chrono::nanoseconds rested_{0};
    bool asked_ = false, isNew_ = false;
    std::optional<Reading> reading_;
};

}  // namespace app::panels
