// Which control has the keys, for hands without a mouse: Tab goes from one control to the next, and
// arrows that a control does not take itself go to the one that lies there. Controls make
// themselves known as they are drawn, in every frame. A click gives the keys back to the picture;
// the next Tab goes on from where it was.
//
// Dear ImGui's own navigation is not used: it stays within one window, needs items of its own
// where a hand-drawn histogram has handles, and differs between the versions that we build with.
#pragma once

#include <imgui.h>

#include <optional>
#include <span>
#include <vector>

#include "app/panels/keys.h"
#include "app/panels/layout.h"

namespace app::panels {

class Focus {
 public:
    // The arrows that a control takes; Typing: all keys but Tab, up, down and Escape.
    enum class Takes { Nothing, LeftRight, UpDown, Typing };

    // What the control with the focus is told.
    struct Turn {
        bool has = false;      // it has the focus
        bool came = false;     // and did not when it was drawn before
        bool entered = false;  // Enter or Space
        int by = 0;     // arrows that it takes: right and up 1, left and down −1, with Shift ten
        int toEnd = 0;  // Home −1, End 1
    };

    // One, as it was drawn: what of it the ImGui window shows, and how many things that stand
    // before all else hold it.
    struct Control {
        ImGuiID id;
        Rect at, clip;
        Takes takes;
        bool isStop;
        int depth;
    };

    // Begins a frame. True when the key was meant for controls. `typing`: a field takes the text.
    bool begin(const std::optional<KeyPress>& key, bool typing);
    // REQUIRES: between begin() and end(), within the ImGui window that shows the control. Tab
    // passes over one that is no stop; arrows reach it.
    Turn control(ImGuiID id, const Rect& at, Takes takes = Takes::Nothing, bool isStop = true);
    // It was pressed with the mouse: Tab goes on from there.
    void touch(ImGuiID id) { place_ = id; }
    // What opens in front with it begins at it, not at its first.
    void beginAt(ImGuiID id) { begun_ = id; }
    // Between these two is drawn what stands before all else, as a popup: keys reach nothing behind
    // it.
    void enterFront() { ++depth_; }
    void leaveFront() { --depth_; }
    // Ends a frame: draws the ring.
    void end(float scale);

    // The control that has it lies in what the current ImGui window shows of a place.
    bool in(const Rect& place) const;

    // Those of the last whole frame that keys can reach, in the order of Tab.
    std::span<const Control> controls() const { return shown_; }
    // The control that has the keys.
    std::optional<ImGuiID> holder() const { return has_ ? std::optional(place_) : std::nullopt; }
    // The control that has the keys, or was pressed last: where Tab goes on from.
    ImGuiID place() const { return place_; }

    // The field where text is typed takes it, as it does where it is left.
    static void endTyping();
    // Text may come before the field that has just got the focus has begun to take it.
    bool expectsText() const { return untilTyping_ > 0; }
    // So it may before one takes it again from the next frame on.
    void expectText();

 private:
    bool press(const KeyPress& key, bool typing);
    void tab(bool back);
    bool arrow(Key key, bool shift);
    const Control* here() const;
    const Control* beside(const Control& from, Key way) const;
    const Control* nearest(const Rect& to) const;
    void go(const Control* to);

    std::vector<Control> shown_;  // of the last whole frame: those in front
    std::vector<Control> coming_;
    bool has_ = false;
    ImGuiID place_ = 0, behind_ = 0;  // behind_: place_ when something opened in front
    bool hadBehind_ = false;          // has_, likewise
    Rect at_;                         // of place_
    Turn turn_;
    bool came_ = false;  // and place_ was not drawn since
    ImGuiID begun_ = 0;  // of this frame, as beginAt() has it
    int depth_ = 0, front_ = 0;
    int untilTyping_ = 0;  // frames
};

// Of the interface that is being drawn. REQUIRES: setFocus() in this ImGui context.
Focus& focus();
void setFocus(Focus& focus);

}  // namespace app::panels
