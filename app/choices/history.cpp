#include "app/choices/history.h"

#include <cassert>
#include <utility>

namespace app {
namespace {

// A tick of one is the same window of the other, however fast they are.
bool sweepsAlike(const Explorer& a, const Explorer& b) {
    if (!sweepOf(a) || !sweepOf(b)) return false;
    timeseries::SweepSettings one = *sweepOf(a);
    one.frequency = sweepOf(b)->frequency;
    return one == *sweepOf(b) && a.variable == b.variable && a.files == b.files;
}

}  // namespace

void keepAcrossUndo(Explorer& state, const Explorer& left) {
    state.size = left.size;
    if (sweepsAlike(state, left)) state.play.tick = left.play.tick;
}

History::History(Explorer start) { states_.push_back(std::move(start)); }

void History::edit(Explorer next, std::string_view gesture) {
    if (next == now()) return;
    const bool isSame = goesOn(gesture);
    gesture_ = gesture;
    states_.erase(states_.begin() + static_cast<std::ptrdiff_t>(at_) + 1, states_.end());
    if (isSame) {
        states_[at_] = std::move(next);
        return;
    }
    states_.push_back(std::move(next));
    if (states_.size() > kSteps + 1)
        states_.pop_front();
    else
        ++at_;
}

void History::replace(Explorer next) { states_[at_] = std::move(next); }

void History::undo() {
    assert(canUndo());
    goTo(at_ - 1);
}

void History::redo() {
    assert(canRedo());
    goTo(at_ + 1);
}

void History::goTo(std::size_t at) {
    endGesture();
    const Explorer& left = now();
    at_ = at;
    keepAcrossUndo(states_[at_], left);
}

}  // namespace app
