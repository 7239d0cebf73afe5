#include "app/headset/hand_interaction.h"

#include <utility>

namespace app::headset {
namespace {

using namespace std::chrono_literals;

// Amplitude and duration.
constexpr Pulse kGrabbed{0, 0.5, 30ms}, kTurned{0, 0.4, 15ms}, kAtEnd{0, 0.3, 20ms};
constexpr auto kGrab = 300ms;        // a longer press is a grab
constexpr double kScrollLines = 12;  // a second
constexpr std::size_t kTimeHand = 0, kValueHand = 1;

}  // namespace

HandOutcome HandInteraction::update(Exploration& exploration, const HandInput& input) {
    outcome_ = {};
    place(input);
    if (input.asked) obey(*input.asked, input);
    for (std::size_t hand = 0; hand < 2; ++hand) {
        press(exploration, hand, input);
        pushButtons(exploration, hand, input);
    }
    carry(input);
    turn(input);
    clip(exploration, input);
    point(input);
    play(exploration, input);
    probe_.update(input.drawn, placement_, {tipOf(0, input), tipOf(1, input)});
    before_ = input.hands;
    return std::move(outcome_);
}

void HandInteraction::place(const HandInput& input) {
    if (!input.head) return;
    if (!std::exchange(panelPlaced_, true)) panel_ = panelBefore(*input.head);
    if (input.drawn && !std::exchange(placed_, true)) {
        placement_ = volumeBefore(*input.head, input.drawn->placed->boxHalfEdges());
        placements_.settle(placement_);
    }
}

void HandInteraction::obey(HandCommand command, const HandInput& input) {
    if (!placed_) return;
    // A volume in a hand rests for this moment, and the hand goes on from where it then is.
    placements_.settle(placement_);
    switch (command) {
        case HandCommand::Bring:
            bring(input);
            break;
        case HandCommand::UndoMove:
            if (placements_.canUndo()) placement_ = placements_.undo();
            break;
        case HandCommand::ResetSize:
            if (input.drawn)
                placement_.metresPerUnit = firstSize(input.drawn->placed->boxHalfEdges());
            break;
        case HandCommand::ClipByHand:
            clipsByHand_ = !clipsByHand_;
            break;
    }
    placements_.settle(placement_);
}

void HandInteraction::bring(const HandInput& input) {
    if (!input.head || !input.drawn) return;
    placement_ = volumeBefore(*input.head, input.drawn->placed->boxHalfEdges());
    panel_ = panelBefore(*input.head);
}

bool HandInteraction::pointsAtPanel(const xr::Hand& hand) const {
    return panel_ && hand.aim && hitOf(*hand.aim, *panel_);
}

// None of a hand that holds something or points at the panel.
std::optional<glm::dvec3> HandInteraction::tipOf(std::size_t hand, const HandInput& input) const {
    const xr::Hand& now = input.hands[hand];
    if (!now.aim || holds(hand) || holdsFace(hand) || pointsAtPanel(now)) return std::nullopt;
    return now.aim->position;
}

// What a grab of this hand would take of the clip box.
std::optional<Hold> HandInteraction::holdOfFace(const Exploration& exploration, std::size_t hand,
                                                const HandInput& input) const {
    const auto& aim = input.hands[hand].aim;
    if (!clipsByHand_ || !input.drawn || !aim || holds(hand) || holdsFace(hand))
        return std::nullopt;
    return ClipHand::holdAt(*aim, *input.drawn, placement_, exploration);
}

// REQUIRES: grab or select was pressed just now.
HandInteraction::Meaning HandInteraction::meant(const Exploration& exploration, std::size_t hand,
                                                const HandInput& input) const {
    const xr::Hand& now = input.hands[hand];
    const bool grabs = now.grab && !before_[hand].grab;
    const bool selects = now.select && !before_[hand].select;
    if (selects && pointsAtPanel(now)) return Meaning::Panel;
    if (grabs && holdOfFace(exploration, hand, input)) return Meaning::Face;
    if (!selects) return Meaning::Volume;
    if (!now.aim || !input.drawn) return Meaning::Other;
    if (grabs) {
        const glm::dmat3 box = input.drawn->placed->boxHalfEdges();
        return meetsBox(*now.aim, placement_, box) ? Meaning::Volume : Meaning::Other;
    }
    const auto tip = tipOf(hand, input);
    return tip && isInBox(*input.drawn, placement_, *tip) ? Meaning::Point : Meaning::Other;
}

void HandInteraction::press(Exploration& exploration, std::size_t hand, const HandInput& input) {
    const xr::Hand& now = input.hands[hand];
    const xr::Hand& before = before_[hand];
    if (taps_[hand]) taps_[hand]->age += input.dt;
    if (holds(hand) || holdsFace(hand) ? !now.grab : !now.select) letGo(exploration, hand, input);
    if ((now.select && !before.select) || (now.grab && !before.grab))
        begin(exploration, hand, input);
}

void HandInteraction::begin(Exploration& exploration, std::size_t hand, const HandInput& input) {
    // A trigger that is pulled while something is held does not let it go.
    const bool isFree = !holds(hand) && !holdsFace(hand);
    const Meaning pressed = meant(exploration, hand, input);
    const auto tip = tipOf(hand, input);
    if (pressed == Meaning::Other) exploration.togglePlay();
    if (pressed == Meaning::Panel) pointing_ = hand;
    if (pressed == Meaning::Point) outcome_.reading = readingAt(*input.drawn, placement_, *tip);
    if (pressed == Meaning::Volume) {
        feel(hand, kGrabbed);
        const bool selects = input.hands[hand].select && !before_[hand].select;
        if (selects && tip) taps_[hand] = Tap{placement_, *tip};
    }
    if (pressed == Meaning::Face) {
        feel(hand, kGrabbed);
        clip_.take(hand, *holdOfFace(exploration, hand, input), *input.hands[hand].aim,
                   *input.drawn, placement_, exploration);
    }
    if (isFree) meaning_[hand] = pressed;
}

void HandInteraction::letGo(Exploration& exploration, std::size_t hand, const HandInput& input) {
    meaning_[hand] = Meaning::Nothing;
    clip_.letGo(hand, exploration);
    const auto tap = std::exchange(taps_[hand], std::nullopt);
    if (!tap || tap->age > kGrab || !input.drawn) return;
    outcome_.reading = readingAt(*input.drawn, tap->from, tap->tip);
    // A tap carries nothing.
    if (outcome_.reading && !holds(1 - hand)) placement_ = tap->from;
}

void HandInteraction::pushButtons(Exploration& exploration, std::size_t hand,
                                  const HandInput& input) {
    const xr::Hand& now = input.hands[hand];
    const xr::Hand& before = before_[hand];
    if (now.bring && !before.bring) obey(HandCommand::Bring, input);
    if (now.swing && !before.swing) toggleSwing(exploration);
    if (now.menu && !before.menu) {
        const bool shown = panel_.has_value();
        panel_.reset();
        if (!shown && input.head) panel_ = panelBefore(*input.head);
    }
}

void HandInteraction::carry(const HandInput& input) {
    std::array<std::optional<xr::Pose>, 2> holding;
    for (std::size_t hand = 0; hand < 2; ++hand)
        if (holds(hand)) holding[hand] = input.hands[hand].grip;
    placement_ = grab_.update(placement_, holding);
    const bool carries = holds(0) || holds(1);
    if (std::exchange(carried_, carries) && !carries) placements_.settle(placement_);
}

// Each turn is a move of its own, also amid a carry.
void HandInteraction::turn(const HandInput& input) {
    for (std::size_t hand = 0; hand < 2; ++hand) {
        const int steps = snap_[hand].update(holds(hand), input.hands[hand].stick.x);
        if (steps == 0) continue;
        placements_.settle(placement_);
        placement_ = turned(placement_, steps);
        placements_.settle(placement_);
        feel(hand, kTurned);
    }
}

void HandInteraction::clip(Exploration& exploration, const HandInput& input) {
    clipEdges_.clear();
    if (!input.drawn) return;
    clip_.move(exploration, {input.hands[0].aim, input.hands[1].aim}, *input.drawn, placement_);
    if (clipsByHand_)
        clipEdges_ =
            clip_.edges({holdOfFace(exploration, 0, input), holdOfFace(exploration, 1, input)},
                        *input.drawn, exploration);
}

void HandInteraction::point(const HandInput& input) {
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

void HandInteraction::play(Exploration& exploration, const HandInput& input) {
    // A face that is dragged is one step of undo: nothing else may be dragged meanwhile.
    const bool rest = holdsFace(0) || holdsFace(1);
    std::array<double, 2> sticks{};
    for (std::size_t hand = 0; hand < 2; ++hand)
        if (!rest && !snap_[hand].owns()) sticks[hand] = input.hands[hand].stick.x;
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

void HandInteraction::feel(std::size_t hand, Pulse pulse) {
    pulse.hand = static_cast<int>(hand);
    outcome_.pulses.push_back(pulse);
}

}  // namespace app::headset
