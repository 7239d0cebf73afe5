#include "app/panels/hover_tip.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/panels/widgets.h"

namespace app::panels {

float nameColumn(ImFont& font, std::span<const std::string> names, float scale) {
    constexpr float kMost = 160;
    float widest = 0;
    for (const std::string& name : names) widest = std::max(widest, widthOf(font, name));
    return std::min(std::ceil(widest), kMost * scale);
}

void HoverTip::follow(PanelContext& context, const std::optional<glm::vec2>& cursor,
                      std::chrono::nanoseconds dt) {
    const std::uint64_t picture = context.performance.picture;
    const bool rests = cursor && cursor == at_ && picture == picture_ &&
                       context.performance.report.whole && !context.exploration.playback().playing;
    at_ = cursor;
    picture_ = picture;
    isNew_ = false;
    if (!rests) {
        rested_ = std::chrono::nanoseconds(0);
        asked_ = false;
        reading_.reset();
        return;
    }
    rested_ += dt;
    if (asked_ || rested_ < kRest) return;
    asked_ = true;
    context.requests.hover = at_;
}

void HoverTip::take(const std::optional<Reading>& reading) {
    reading_ = reading;
    isNew_ = reading.has_value();
}

std::optional<std::chrono::nanoseconds> HoverTip::untilNextChange() const {
    using std::chrono::nanoseconds;
    if (isNew_) return nanoseconds(0);  // it came after its frame was drawn
    if (!at_ || asked_) return std::nullopt;
    return std::max(nanoseconds(0), kRest - rested_);
}

void HoverTip::draw(const PanelContext& context) const {
    const auto shown = context.exploration.shown();
    if (!reading_ || !at_ || !shown) return;
    const Theme& theme = context.theme;
    const float s = theme.scale, line = 19 * s;
    // Long names and units end early: a number never does.
    const Rect& picture = context.layout.picture;
    const float most = std::min(420 * s, picture.size().x - 40 * s) - 22 * s;
    std::string value = beginning(*theme.strong, valueText(*reading_, *shown), 0.7f * most);
    value = fmt::format("{}  {}",
                        fitting(*theme.strong, shown->dataset.variable.name,
                                most - widthOf(*theme.strong, "  " + value)),
                        value);
    std::vector<std::string> places, names;
    for (auto& [name, place] : placeLines(*reading_, *shown)) {
        names.push_back(std::move(name));
        places.push_back(std::move(place));
    }
    if (!reading_->cell.empty()) {
        names.emplace_back("cell");
        places.push_back(reading_->cell);
    }
    const std::string between = beginning(*theme.small, betweenText(*reading_, *shown), most);
    const float column = nameColumn(*theme.small, names, s);
    for (std::string& place : places) place = fitting(*theme.small, place, most - column - 14 * s);
    float width = std::max(widthOf(*theme.strong, value), widthOf(*theme.small, between));
    for (const std::string& place : places)
        width = std::max(width, column + 14 * s + widthOf(*theme.small, place));
    const auto lines = static_cast<float>(places.size() + (between.empty() ? 1 : 2));
    // Below and right of the pointer; on its other side where the picture ends, and in it.
    const glm::vec2 size(width + 22 * s, lines * line + 14 * s), pointer = picture.min + *at_;
    glm::vec2 corner = pointer + glm::vec2(16 * s);
    if (corner.x + size.x > picture.max.x) corner.x = pointer.x - 12 * s - size.x;
    if (corner.y + size.y > picture.max.y) corner.y = pointer.y - 12 * s - size.y;
    corner = glm::floor(glm::max(corner, picture.min + 4 * s));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(im(corner), im(corner + size), faded(kPanel, 0.92f), 5 * s);
    list.AddRect(im(corner), im(corner + size), kLine, 5 * s);
    glm::vec2 at = corner + glm::vec2(11 * s, 7 * s + 0.5f * line);
    text(theme, at, value, kText, 0, theme.strong);
    if (!between.empty()) text(theme, at += glm::vec2(0, line), between, kDim, 0, theme.small);
    for (std::size_t i = 0; i < places.size(); ++i) {
        at.y += line;
        text(theme, at, fitting(*theme.small, names[i], column), kFaint, 0, theme.small);
        text(theme, at + glm::vec2(size.x - 22 * s, 0), places[i], kDim, 1, theme.small);
    }
}

}  // namespace app::panels
