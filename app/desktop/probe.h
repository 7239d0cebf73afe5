// What a user points at.
#pragma once

#include <optional>

#include "app/exploration.h"
#include "app/panels/desk.h"
#include "render/view.h"

namespace app::desktop {

// The point seen at `at` (pixels of the picture, y down); none where nothing is drawn. Costs a pass
// over the selected points.
std::optional<panels::Reading> probe(const Shown& shown, const render::Lattice& lattice,
                                     const render::View& eye, glm::vec2 at);

}  // namespace app::desktop
