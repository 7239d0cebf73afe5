// Undo and redo. The state is one plain value, so undoing is going back to an earlier one.
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>

#include "app/choices/explorer.h"

namespace app {

// What undo leaves as it is: the size, and where the window of a sweep stands (play.tick) while it
// is the same sweep of the same variable.
void keepAcrossUndo(Explorer& state, const Explorer& left);

// Keeps the last kSteps states that a user can go back to.
class History {
 public:
    static constexpr std::size_t kSteps = 500;

    explicit History(Explorer start = {});

    const Explorer& now() const { return states_[at_]; }
    // What an edit of this gesture changes: now(), or where the gesture that goes on began.
    const Explorer& before(std::string_view gesture) const {
        return states_[goesOn(gesture) ? at_ - 1 : at_];
    }

    // The user's doing. Nothing when `next` equals now(). What was undone is forgotten. Edits of
    // one gesture (a drag, a held key, a slider: any text but "") that follow each other are one
    // step of undo, until another gesture, endGesture(), undo() or redo().
    void edit(Explorer next, std::string_view gesture = {});
    void endGesture() { gesture_.clear(); }
    // Not the user's doing: play moves on, a window is resized. Changes now() without a step of
    // undo; the states undone stay.
    void replace(Explorer next);

    bool canUndo() const { return at_ > 0; }
    bool canRedo() const { return at_ + 1 < states_.size(); }
    // REQUIRES: canUndo(), canRedo(). As keepAcrossUndo().
    void undo();
    void redo();

 private:
    bool goesOn(std::string_view gesture) const { return !gesture.empty() && gesture == gesture_; }
    void goTo(std::size_t at);

    std::deque<Explorer> states_;  // at most kSteps before at_
    std::size_t at_ = 0;
    std::string gesture_;
};

}  // namespace app
