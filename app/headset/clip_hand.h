// Moving the faces of the clip box by hand: from poses edits of the exploration; knows no runtime.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "app/drawing/drawn.h"
#include "app/exploration/exploration.h"
#include "app/headset/clip_faces.h"

namespace app::headset {

class ClipHand {
 public:
    // An edge of the clip box in the world, or a part of it where it is bent; lit: of a face that
    // is held, or would be.
    struct Edge {
        glm::dvec3 from, to;
        bool lit;
    };

    // What a grab with this aim pose would take hold of. Nothing where what is drawn is not of the
    // grid that is shown, nor where the box has no faces (ClipSpace::has).
    static std::optional<Hold> holdAt(const xr::Pose& aim, const Drawn& drawn,
                                      const xr::Placement& placement,
                                      const Exploration& exploration);
    // REQUIRES: the hand holds nothing; `hold` as holdAt() gave it.
    void take(std::size_t hand, const Hold& hold, const xr::Pose& aim, const Drawn& drawn,
              const xr::Placement& placement, const Exploration& exploration);
    bool holds(std::size_t hand) const { return held_[hand].has_value(); }
    // Each held face goes along its axis so that it keeps its distance from the point that was
    // taken hold of; to the millimetre in the room, between the other face and the points' box,
    // where it is unbounded. A hand without a pose moves nothing. From taking hold to letting go is
    // one step of undo.
    void move(Exploration& exploration, const std::array<std::optional<xr::Pose>, 2>& aims,
              const Drawn& drawn, const xr::Placement& placement);
    void letGo(std::size_t hand, Exploration& exploration);

    std::vector<Edge> edges(const std::array<std::optional<Hold>, 2>& within, const Drawn& drawn,
                            const Exploration& exploration) const;

 private:
    struct Held {
        Face face;
        glm::dvec3 inAim;  // the point taken hold of, in the aim pose
        double offset;     // of the face from it, along the axis, in the clip space
        double at;         // where the face was last, likewise
    };
    std::array<std::optional<Held>, 2> held_;
};

}  // namespace app::headset
