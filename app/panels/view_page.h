// Where the picture is seen from: sides, projection, eyes, clip box, the axes' scale.
#pragma once

#include <array>

#include "app/panels/form.h"

namespace app::panels {

class ViewPage {
 public:
    // Of a side of the clip box, right of its slider; in units of the design.
    static constexpr float kSideField = 148, kSideGap = 8;

    void draw(PanelContext& context, const Rect& at);

 private:
    void map(PanelContext& context, Form& form);
    void clip(PanelContext& context, Form& form);
    void scale(PanelContext& context, Form& form);
    void axes(PanelContext& context, Form& form);
    TextField scale_;
    std::array<TextField, 3> clip_;  // a side an axis
    std::array<TextField, 3> names_;
};

}  // namespace app::panels
