// The layers: colour, ranges as text, exact count, opacity, visibility.
#pragma once

#include <vector>

#include "app/panels/color_editor.h"
#include "app/panels/panel_context.h"
#include "app/panels/widgets.h"

namespace app::panels {

class LayersPanel {
 public:
    void draw(PanelContext& context, const Rect& at);

 private:
    void row(PanelContext& context, const LayerRowLayout& at, std::size_t row);
    void colorPopup(PanelContext& context, const Rect& swatch, std::size_t row);
    void editText(PanelContext& context, const LayerRowLayout& at, std::size_t row);
    std::vector<TextField> texts_;
    ColorEditor color_;
};

}  // namespace app::panels
