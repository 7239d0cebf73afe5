// The few controls that all panels are made of. Pure ImGui; each draws inside the rectangle that it
// is given. `id` is unique within its window.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/panels/fitted_text.h"
#include "app/panels/focus.h"
#include "app/panels/icons.h"
#include "app/panels/theme.h"

namespace app::panels {

// Text at a point; `align` 0 begins there, 0.5 is centred, 1 ends there. y is the middle of the
// line.
void text(const Theme& theme, glm::vec2 at, std::string_view what, ImU32 color = kText,
          float align = 0, ImFont* font = nullptr);
void text(ImDrawList& list, glm::vec2 at, std::string_view what, ImU32 color, float align,
          ImFont& font);

// What happened to a rectangle that is pressed and dragged.
struct Pressing {
    bool hovered = false, pressed = false, held = false, released = false, doubled = false;
    bool clicked = false;  // released where it was pressed, or entered with the keyboard
    bool focused = false;
};
// Under the mouse alone.
Pressing area(const char* id, const Rect& at);
// The keyboard reaches it too (focus.h).
Pressing button(const char* id, const Rect& at, bool isStop = true);

bool iconButton(const Theme& theme, const char* id, const Rect& at, Icon icon,
                const char* tip = nullptr, bool lit = false);
bool textButton(const Theme& theme, const char* id, const Rect& at, std::string_view label,
                bool lit = false);
// One of a few, side by side; arrows choose. Returns the one chosen now.
std::optional<std::size_t> segmented(const Theme& theme, const char* id, const Rect& at,
                                     std::span<const char* const> labels, std::size_t chosen);
// Where its labels lie: in equal parts, or by their lengths where these have no room, and cut where
// that does not help; and how wide it is for equal ones.
std::vector<Rect> segments(const Theme& theme, const Rect& at, std::span<const char* const> labels);
float segmentsWidth(const Theme& theme, std::span<const char* const> labels);
// A thin slider of [0, 1]; true when it comes to another value, by `step` with a key.
bool slider(const Theme& theme, const char* id, const Rect& at, double& fraction,
            double step = 0.02);
// A slider of two ends, lo <= hi, in [0, 1].
bool rangeSlider(const Theme& theme, const char* id, const Rect& at, double& lo, double& hi);

// Makes ImGui's field `id`, which follows, a control; true when it is to take the text now.
bool takesText(const char* id, const Rect& at);

// ImGui's field, of any bytes (field_text.h): whether Enter was pressed.
bool inputText(const char* id, const char* hint, std::string& text);

// A field of text that reports what was entered (Enter, or leaving the field) and takes the shown
// text again otherwise. Keeps what is being typed while it is active.
class TextField {
 public:
    static constexpr float kPad = 8;  // beside the text, in units of the design

    // `shown`: what stands there while nobody types.
    std::optional<std::string> draw(const Theme& theme, const char* id, const Rect& at,
                                    std::string_view shown, const char* hint = "");
    bool active() const { return active_; }
    // What was entered cannot be, as one sentence says: both stay, the sentence below the field,
    // until the text is changed, given up with Escape, or another is to be shown. After Enter it
    // keeps the keyboard.
    void refuse(std::string why);

 private:
    void drawRefusal(const Theme& theme, const Rect& at) const;

    std::string typed_, shown_;
    bool active_ = false;
    bool entered_ = false;       // with Enter, in the frame that was drawn last
    bool retakes_ = false;       // the keyboard, when it is drawn next
    std::string why_, refused_;  // the sentence, and the text that it is about; "": none
};

// ImGui's, closed by Escape too, with the keys to itself.
bool beginPopup(const char* id);
void endPopup();
// At the cursor, or beside what has the focus.
void tip(const Theme& theme, std::string_view what);
void tipBeside(const Theme& theme, const Rect& at, std::string_view what);
// Horizontal hairline.
void hairline(float x0, float x1, float y);
// Slanted lines: what has not been seen.
void hatch(ImDrawList& list, const Rect& at, float scale, ImU32 color);

}  // namespace app::panels
