#include "app/panels/focus.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <utility>

#include "app/panels/theme.h"

namespace app::panels {
namespace {

constexpr int kShiftFactor = 10;
// ImGui gives a field the text two frames after it was asked for.
constexpr int kFramesUntilTyping = 2;

bool isArrow(Key key) {
    return key == Key::Left || key == Key::Right || key == Key::Up || key == Key::Down;
}
bool isAcross(Key key) { return key == Key::Left || key == Key::Right; }

float distance(const Rect& a, const Rect& b) {
    const glm::vec2 gap = glm::max(glm::max(a.min - b.max, b.min - a.max), glm::vec2(0));
    return gap.x + gap.y;
}

// The window scrolls to what lies outside.
void bringIntoView(const Rect& at) {
    const float top = ImGui::GetWindowPos().y, bottom = top + ImGui::GetWindowHeight();
    const float margin = 0.5f * at.size().y;
    if (at.min.y < top) ImGui::SetScrollY(ImGui::GetScrollY() + at.min.y - margin - top);
    if (at.max.y > bottom) ImGui::SetScrollY(ImGui::GetScrollY() + at.max.y + margin - bottom);
}

}  // namespace

bool Focus::begin(const std::optional<KeyPress>& key, bool typing) {
    turn_ = {};
    untilTyping_ = std::max(0, untilTyping_ - 1);
    if (ImGui::IsMouseClicked(0) || ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2))
        has_ = hadBehind_ = false;
    return key && !key->ctrl && press(*key, typing);
}

bool Focus::press(const KeyPress& key, bool typing) {
    const ImGuiID before = place_;
    bool taken = true;
    if (key.key == Key::Tab) {
        tab(key.shift);
    } else if (!has_ && front_ == 0) {
        return false;
    } else if (key.key == Key::Escape) {
        if (front_ > 0) return false;  // what stands in front closes itself
        has_ = false;
    } else if (isArrow(key.key)) {
        if (typing && isAcross(key.key)) return true;
        taken = arrow(key.key, key.shift);
    } else if (!has_ || typing) {
        return typing;
    } else if (key.key == Key::Enter || key.key == Key::KeypadEnter || key.key == Key::Space) {
        turn_.entered = true;
        const Control* now = here();
        if (now != nullptr && now->takes == Takes::Typing) untilTyping_ = kFramesUntilTyping;
    } else if (key.key == Key::Home || key.key == Key::End) {
        turn_.toEnd = key.key == Key::End ? 1 : -1;
    } else {
        return false;
    }
    // ImGui would leave the field where the text was.
    if (typing && place_ != before) endTyping();
    return taken;
}

void Focus::endTyping() { ImGui::ClearActiveID(); }

void Focus::expectText() { untilTyping_ = kFramesUntilTyping + 1; }

void Focus::tab(bool back) {
    const auto stops = [&](const Control& c) { return c.isStop || c.id == place_; };
    std::vector<const Control*> ring;
    std::size_t now = 0;
    for (const Control& c : shown_) {
        if (!stops(c)) continue;
        if (c.id == place_) now = ring.size() + 1;
        ring.push_back(&c);
    }
    if (ring.empty()) return;
    const std::size_t n = ring.size();
    if (now == 0) return go(back ? ring.back() : ring.front());
    go(ring[(now - 1 + (back ? n - 1 : 1)) % n]);
}

bool Focus::arrow(Key key, bool shift) {
    const Control* now = here();
    if (now == nullptr) {
        if (!shown_.empty()) go(&shown_.front());
        return true;
    }
    const Takes axis = isAcross(key) ? Takes::LeftRight : Takes::UpDown;
    if (now->takes == axis)
        turn_.by = (key == Key::Right || key == Key::Up ? 1 : -1) * (shift ? kShiftFactor : 1);
    else if (const Control* next = beside(*now, key))
        go(next);
    return true;
}

const Focus::Control* Focus::here() const {
    const auto found = std::ranges::find(shown_, place_, &Control::id);
    return found == shown_.end() ? nullptr : &*found;
}

// Of the controls that begin where this one ends, the nearest one; sideways only those of its row.
const Focus::Control* Focus::beside(const Control& from, Key way) const {
    const int along = isAcross(way) ? 0 : 1, across = 1 - along;
    const bool forward = way == Key::Right || way == Key::Down;
    const Control* best = nullptr;
    float least = std::numeric_limits<float>::infinity();
    for (const Control& c : shown_) {
        const Rect& first = forward ? from.at : c.at;
        const Rect& second = forward ? c.at : from.at;
        const float gap = second.min[along] - first.max[along];
        if (c.id == from.id || gap < -0.4f * std::min(c.at.size()[along], from.at.size()[along]))
            continue;
        const float aside = std::max(
            {0.0f, c.at.min[across] - from.at.max[across], from.at.min[across] - c.at.max[across]});
        if (aside > 0 && isAcross(way)) continue;
        const float off = std::abs(c.at.centre()[across] - from.at.centre()[across]);
        const float cost = std::max(0.0f, gap) + 3 * aside + 0.01f * off;
        if (cost < least) {
            least = cost;
            best = &c;
        }
    }
    return best;
}

const Focus::Control* Focus::nearest(const Rect& to) const {
    const auto found =
        std::ranges::min_element(shown_, {}, [&](const Control& c) { return distance(c.at, to); });
    return found == shown_.end() ? nullptr : &*found;
}

void Focus::go(const Control* to) {
    has_ = came_ = true;
    place_ = to->id;
    at_ = to->at;
    untilTyping_ = to->takes == Takes::Typing ? kFramesUntilTyping : 0;
}

bool Focus::in(const Rect& place) const {
    const ImDrawList& list = *ImGui::GetWindowDrawList();
    const Rect seen{vec(list.GetClipRectMin()), vec(list.GetClipRectMax())};
    return has_ && front_ == 0 && place.holds(at_.centre()) && seen.holds(at_.centre());
}

Focus::Turn Focus::control(ImGuiID id, const Rect& at, Takes takes, bool isStop) {
    const ImDrawList& list = *ImGui::GetWindowDrawList();
    const Rect clip{vec(list.GetClipRectMin()), vec(list.GetClipRectMax())};
    coming_.push_back({id, at, clip, takes, isStop, depth_});
    if (!has_ || id != place_) return {};
    Turn turn = std::exchange(turn_, {});
    turn.has = true;
    turn.came = std::exchange(came_, false);
    if (turn.came) bringIntoView(at);
    return turn;
}

void Focus::end(float scale) {
    int front = 0;
    for (const Control& c : coming_) front = std::max(front, c.depth);
    std::erase_if(coming_, [&](const Control& c) { return c.depth < front; });
    shown_ = std::exchange(coming_, {});
    if (front > front_) {
        behind_ = std::exchange(place_, 0);
        hadBehind_ = has_;
    }
    if (front < front_) {
        place_ = behind_;
        has_ = hadBehind_;
    }
    const bool opened = front > std::exchange(front_, front);
    if (const ImGuiID begun = std::exchange(begun_, 0); opened && begun != 0) {
        place_ = begun;
        if (const Control* first = here(); first != nullptr && has_) go(first);
    }
    if (!has_ || shown_.empty()) return;
    const Control* now = here();
    // What had it is gone, or lies behind what has just opened.
    if (now == nullptr) {
        go(opened ? &shown_.front() : nearest(at_));
        now = here();
    }
    at_ = now->at;
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    const glm::vec2 out(2 * scale);
    list.PushClipRect(im(now->clip.min - out), im(now->clip.max + out));
    const ImVec2 from = im(at_.min - out), to = im(at_.max + out);
    list.AddRect(from, to, faded(kGround, 0.85f), 6 * scale, 0, 4 * scale);
    list.AddRect(from, to, kAccent, 6 * scale, 0, 1.75f * scale);
    list.PopClipRect();
}

Focus& focus() { return *static_cast<Focus*>(ImGui::GetIO().UserData); }
void setFocus(Focus& focus) { ImGui::GetIO().UserData = &focus; }

}  // namespace app::panels
