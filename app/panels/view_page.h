// Where the picture is seen from: sides, projection, eyes, clip box, the axes' scale.
#pragma once

#include <array>

#include "app/panels/form.h"

namespace app::panels {

class ViewPage {
 public:
    void draw(Desk& desk, const Rect& at);

 private:
    void clip(Desk& desk, Form& form);
    void scale(Desk& desk, Form& form);
    TextField scale_;
};

}  // namespace app::panels
