// How time and the swept window play (Crawfis 1996, figure 4).
#pragma once

#include "app/panels/form.h"

namespace app::panels {

class AnimationPage {
 public:
    void draw(PanelContext& context, const Rect& at);

 private:
    void time(PanelContext& context, Form& form);
    void sweep(PanelContext& context, Form& form);
    TextField speed_, stride_, range_, delta_, timerSteps_, step_, frequency_;
};

}  // namespace app::panels
