// A layer's colour, chosen in a popup: one colour, or a map and its ends.
#pragma once

#include "app/choices/explorer.h"
#include "app/panels/panel_context.h"
#include "app/panels/widgets.h"

namespace app::panels {

class ColorEditor {
 public:
    // In a popup that is open; true when it has changed the layer's colour.
    bool draw(PanelContext& context, LayerChoice& layer);

 private:
    bool drawConstant(PanelContext& context, LayerChoice& layer, float width);
    bool drawMaps(PanelContext& context, LayerChoice& layer, float width);
    TextField hex_, lo_, hi_;
};

}  // namespace app::panels
