// A layer's colour, chosen in a popup: one colour, or a map and its ends.
#pragma once

#include <imgui.h>

#include <map>
#include <string>

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
    // The last map of each layer, by its popup, for when it is coloured by value again; of this
    // variable, while no layer is taken away.
    std::map<ImGuiID, MapChoice> maps_;
    std::string variable_;
    std::size_t layers_ = 0;
};

}  // namespace app::panels
