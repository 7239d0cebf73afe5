// A layer's colours as panels draw them.
#pragma once

#include "app/choices/explorer.h"
#include "app/panels/panel_context.h"

namespace app::panels {

// At a value; a layer whose colour is not chosen yet is neutral.
ImU32 colorAt(const LayerChoice& layer, double value, float alpha = 1);
// The constant colour, or the map's middle.
ImU32 colorOf(const LayerChoice& layer, float alpha = 1);
// The colour, or the map from left (lo) to right (hi).
void drawSwatch(ImDrawList& list, const Rect& at, const LayerChoice& layer, float scale);
void drawMap(ImDrawList& list, const Rect& at, const render::ColorMap& map);

}  // namespace app::panels
