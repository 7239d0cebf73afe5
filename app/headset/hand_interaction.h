// Where volume and panel stand in the room, and what hands do with them and with the exploration.
// Pure: poses and buttons in, edits and placements out; no runtime, no GL.
#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <vector>

#include "app/drawing/drawn.h"
#include "app/exploration/exploration.h"
#include "app/headset/clip_hand.h"
#include "app/headset/placement_history.h"
#include "app/headset/snap_turn.h"
#include "app/headset/standing.h"
#include "app/headset/sticks.h"
#include "app/headset/tip_probe.h"
#include "xr/grab.h"
#include "xr/session.h"

namespace app::headset {

// What a button asks for (hand_buttons.h).
enum class HandCommand {
    Bring,       // volume and panel before the head
    UndoMove,    // the volume where it rested before; see PlacementHistory
    ResetSize,   // the volume as large as it was at first, about its middle
    ClipByHand,  // on and off
};

// What a frame brings.
struct HandInput {
    std::array<xr::Hand, 2> hands;  // left, right
    std::optional<xr::Pose> head;
    std::chrono::nanoseconds dt{0};
    std::optional<Drawn> drawn;  // none before there is any
    std::optional<HandCommand> asked = {};
};

// The panel as a mouse sees it: [0, 1] from its upper left corner.
struct Pointer {
    glm::dvec2 at;
    bool pressed = false;
    double scroll = 0;  // lines; > 0 is away from the user
};

// What a hand is to feel.
struct Pulse {
    int hand;
    double amplitude;
    std::chrono::nanoseconds duration;
};

// What a frame leads to, beside edits and placements.
struct HandOutcome {
    std::vector<Pulse> pulses;
    std::optional<Reading> reading;  // asked for, to be kept
};

class HandInteraction {
 public:
    // Grab moves the volume. Left stick: time, right stick: value; but of a hand that holds the
    // volume, it turns that by steps. Select on the panel clicks; with the tip (the aim pose's
    // place) in the volume's box, it keeps the point there as a reading; elsewhere it plays and
    // pauses. With clip by hand on, a grab with the tip or the ray at a face of the clip box moves
    // that face instead. Menu hides and shows the panel; swing turns the sweep's path; bring is
    // HandCommand::Bring. A controller with one button means the panel or the volume where its ray
    // meets them, and else plays; in the volume, a tap keeps the point at its tip.
    HandOutcome update(Exploration& exploration, const HandInput& input);

    const xr::Placement& placement() const { return placement_; }
    const std::optional<Plate>& panel() const { return panel_; }  // none while hidden
    const std::optional<Pointer>& pointer() const { return pointer_; }
    // Whether the volume has moved since it was placed, or since all of that was undone.
    bool canUndoMove() const { return placements_.canUndo(); }
    bool holds(std::size_t hand) const { return meaning_[hand] == Meaning::Volume; }
    bool clipsByHand() const { return clipsByHand_; }
    bool holdsFace(std::size_t hand) const { return clip_.holds(hand); }
    // Of the clip box, as of the last update; none while clip by hand is off.
    const std::vector<ClipHand::Edge>& clipEdges() const { return clipEdges_; }
    // The point that a hand's tip is at, which holds nothing and points beside the panel.
    const std::optional<TipProbe::At>& tip() const { return probe_.at(); }

 private:
    // What a hand's pressed button was taken for, until it is let go.
    enum class Meaning { Nothing, Volume, Face, Panel, Point, Other };
    // A press of a controller's only button in the volume: a grab, or a tap where it is short.
    struct Tap {
        xr::Placement from;
        glm::dvec3 tip;
        std::chrono::nanoseconds age{0};
    };

    void place(const HandInput& input);
    void obey(HandCommand command, const HandInput& input);
    void bring(const HandInput& input);
    Meaning meant(const Exploration& exploration, std::size_t hand, const HandInput& input) const;
    std::optional<Hold> holdOfFace(const Exploration& exploration, std::size_t hand,
                                   const HandInput& input) const;
    bool pointsAtPanel(const xr::Hand& hand) const;
    std::optional<glm::dvec3> tipOf(std::size_t hand, const HandInput& input) const;
    void press(Exploration& exploration, std::size_t hand, const HandInput& input);
    void begin(Exploration& exploration, std::size_t hand, const HandInput& input);
    void letGo(Exploration& exploration, std::size_t hand, const HandInput& input);
    void pushButtons(Exploration& exploration, std::size_t hand, const HandInput& input);
    void carry(const HandInput& input);
    void turn(const HandInput& input);
    void clip(Exploration& exploration, const HandInput& input);
    void point(const HandInput& input);
    void play(Exploration& exploration, const HandInput& input);
    void feel(std::size_t hand, Pulse pulse);

    xr::Placement placement_;
    bool placed_ = false;
    PlacementHistory placements_;
    std::optional<Plate> panel_;
    bool panelPlaced_ = false;
    std::optional<Pointer> pointer_;
    std::size_t pointing_ = 1;
    std::array<xr::Hand, 2> before_;
    std::array<Meaning, 2> meaning_{};
    bool carried_ = false;  // a hand has held the volume since it rested
    xr::Grab grab_;
    std::array<SnapTurn, 2> snap_;
    Sticks sticks_;
    Sticks::Ends atEnd_;
    std::array<std::optional<Tap>, 2> taps_;
    TipProbe probe_;
    bool clipsByHand_ = false;
    ClipHand clip_;
    std::vector<ClipHand::Edge> clipEdges_;
    HandOutcome outcome_;
};

}  // namespace app::headset
