#include "app/history.h"

#include <utility>

namespace app {

History::History(Explorer start) { states_.push_back(std::move(start)); }

void History::edit(Explorer next, std::string_view gesture) {
    if (next == now()) return;
    const bool continues = !gesture.empty() && gesture == gesture_;
    states_.resize(at_ + 1);
    if (continues) {
        states_[at_] = std::move(next);
        return;
    }
    states_.push_back(std::move(next));
    if (states_.size() > kSteps) states_.pop_front();
    at_ = states_.size() - 1;
    gesture_ = gesture;
}

void History::replace(Explorer next) { states_[at_] = std::move(next); }

void History::undo() {
    const Explorer& left = states_[at_--];
    states_[at_].size = left.size;
    states_[at_].play.tick = left.play.tick;
    gesture_.clear();
}

void History::redo() {
    const Explorer& left = states_[at_++];
    states_[at_].size = left.size;
    states_[at_].play.tick = left.play.tick;
    gesture_.clear();
}

}  // namespace app
