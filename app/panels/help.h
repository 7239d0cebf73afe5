// All keys and gestures over the picture.
#pragma once

#include "app/panels/panel_context.h"

namespace app::panels {

class Help {
 public:
    bool isOpen() const { return isOpen_; }
    void turn() { isOpen_ = !isOpen_; }
    // Up and down scroll what is higher than the picture; false where the key is another's.
    bool take(const KeyPress& key);
    void draw(const PanelContext& context);

 private:
    bool isOpen_ = false, scrolls_ = false;
    float moved_ = 0;  // by keys, in lines, since it was drawn
};

}  // namespace app::panels
