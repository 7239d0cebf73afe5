#include "app/headset/room.h"

#include <utility>

namespace app::headset {
namespace {

using namespace std::chrono_literals;

// Amplitude and duration.
constexpr Pulse kGrabbed{0, 0.5, 30ms}, kTurned{0, 0.4, 15ms}, kAtEnd{0, 0.3, 20ms};
constexpr double kScrollLines = 12;  // a second
constexpr std::size_t kTimeHand = 0, kValueHand = 1;

}  // namespace

std::vector<Pulse> Room::update(Exploration& exploration, const RoomInput& input) {
    pulses_.clear();
    place(input);
    if (input.asked) obey(*input.asked, input);
    for (std::size_t hand = 0; hand < 2; ++hand) press(exploration, hand, input);
    carry(input);
    turn(input);
    point(input);
    play(exploration, input);
    before_ = input.hands;
    return std::move(pulses_);
}

void Room::place(const RoomInput& input) {
    if (!input.head) return;
    if (!std::exchange(panelPlaced_, true)) panel_ = panelBefore(*input.head);
    if (input.boxHalfEdges && !std::exchange(placed_, true)) {
        placement_ = volumeBefore(*input.head, *input.boxHalfEdges);
        placements_.settle(placement_);
    }
}

void Room::obey(RoomCommand command, const RoomInput& input) {
    if (!placed_) return;
    // A volume in a hand rests for this moment, and the hand goes on from where it then is.
    placements_.settle(placement_);
    switch (command) {
        case RoomCommand::Bring:
            bring(input);
            break;
        case RoomCommand::UndoMove:
            if (placements_.canUndo()) placement_ = placements_.undo();
            break;
        case RoomCommand::ResetSize:
            if (input.boxHalfEdges) placement_.metresPerUnit = firstSize(*input.boxHalfEdges);
            break;
    }
    placements_.settle(placement_);
}

void Room::bring(const RoomInput& input) {
    if (!input.head || !input.boxHalfEdges) return;
    placement_ = volumeBefore(*input.head, *input.boxHalfEdges);
    panel_ = panelBefore(*input.head);
}

// REQUIRES: grab or select was pressed just now.
Room::Meaning Room::meant(std::size_t hand, const RoomInput& input) const {
    const xr::Hand& now = input.hands[hand];
    const bool grabs = now.grab && !before_[hand].grab;
    const bool selects = now.select && !before_[hand].select;
    if (selects && panel_ && now.aim && hitOf(*now.aim, *panel_)) return Meaning::Panel;
    if (!selects) return Meaning::Volume;
    const bool onVolume = grabs && now.aim && input.boxHalfEdges &&
                          meetsBox(*now.aim, placement_, *input.boxHalfEdges);
    return onVolume ? Meaning::Volume : Meaning::Other;
}

void Room::press(Exploration& exploration, std::size_t hand, const RoomInput& input) {
    const xr::Hand& now = input.hands[hand];
    const xr::Hand& before = before_[hand];
    Meaning& meaning = meaning_[hand];
    if (meaning == Meaning::Volume ? !now.grab : !now.select) meaning = Meaning::Nothing;
    const bool selects = now.select && !before.select, grabs = now.grab && !before.grab;
    if (selects || grabs) {
        const Meaning pressed = meant(hand, input);
        if (pressed == Meaning::Other) exploration.togglePlay();
        if (pressed == Meaning::Panel) pointing_ = hand;
        if (pressed == Meaning::Volume) feel(hand, kGrabbed);
        // A trigger that is pulled while the volume is held does not let it go.
        if (meaning != Meaning::Volume) meaning = pressed;
    }
    if (now.bring && !before.bring) obey(RoomCommand::Bring, input);
    if (now.swing && !before.swing) toggleSwing(exploration);
    if (now.menu && !before.menu) {
        const bool shown = panel_.has_value();
        panel_.reset();
        if (!shown && input.head) panel_ = panelBefore(*input.head);
    }
}

void Room::carry(const RoomInput& input) {
    std::array<std::optional<xr::Pose>, 2> holding;
    for (std::size_t hand = 0; hand < 2; ++hand)
        if (holds(hand)) holding[hand] = input.hands[hand].grip;
    placement_ = grab_.update(placement_, holding);
    const bool carries = holds(0) || holds(1);
    if (std::exchange(carried_, carries) && !carries) placements_.settle(placement_);
}

// Each turn is a move of its own, also amid a carry.
void Room::turn(const RoomInput& input) {
    for (std::size_t hand = 0; hand < 2; ++hand) {
        const int steps = snap_[hand].update(holds(hand), input.hands[hand].stick.x);
        if (steps == 0) continue;
        placements_.settle(placement_);
        placement_ = turned(placement_, steps);
        placements_.settle(placement_);
        feel(hand, kTurned);
    }
}

void Room::point(const RoomInput& input) {
    pointer_.reset();
    if (!panel_) return;
    // The hand that pressed last goes on pointing; the other takes over where that one points
    // elsewhere.
    for (const std::size_t hand : {pointing_, 1 - pointing_}) {
        const xr::Hand& now = input.hands[hand];
        if (!now.aim) continue;
        if (const auto hit = hitOf(*now.aim, *panel_)) {
            pointing_ = hand;
            const double seconds = std::chrono::duration<double>(input.dt).count();
            pointer_ = Pointer{hit->at, meaning_[hand] == Meaning::Panel,
                               kScrollLines * rateOf(now.stick.y) * seconds};
            return;
        }
    }
}

void Room::play(Exploration& exploration, const RoomInput& input) {
    std::array<double, 2> sticks{};
    for (std::size_t hand = 0; hand < 2; ++hand)
        if (!snap_[hand].owns()) sticks[hand] = input.hands[hand].stick.x;
    const Sticks::Ends ends =
        sticks_.move(exploration, sticks[kValueHand], sticks[kTimeHand], input.dt);
    const auto feelEnd = [&](std::size_t hand, bool now, bool& was) {
        // An end is felt once, until the stick comes back.
        if (now && !was) feel(hand, kAtEnd);
        was = now || (was && rateOf(sticks[hand]) != 0);
    };
    feelEnd(kValueHand, ends.value, atEnd_.value);
    feelEnd(kTimeHand, ends.time, atEnd_.time);
}

void Room::feel(std::size_t hand, Pulse pulse) {
    pulse.hand = static_cast<int>(hand);
    pulses_.push_back(pulse);
}

}  // namespace app::headset
