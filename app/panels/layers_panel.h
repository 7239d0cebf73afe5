// The layers: colour, ranges as text, exact count, opacity, visibility.
#pragma once

#include <vector>

#include "app/panels/color_editor.h"
#include "app/panels/desk.h"
#include "app/panels/widgets.h"

namespace app::panels {

class LayersPanel {
 public:
    void draw(Desk& desk, const Rect& at);

    // Rows that the explorer's layers take, the swept one counted.
    static std::size_t rows(const Explorer& explorer);

 private:
    void row(Desk& desk, const LayerRowLayout& at, std::size_t row);
    void colorPopup(Desk& desk, const Rect& swatch, std::size_t row);
    void editText(Desk& desk, const LayerRowLayout& at, std::size_t row);
    std::vector<TextField> texts_;
    ColorEditor color_;
};

}  // namespace app::panels
