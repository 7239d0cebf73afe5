// What stands where no picture is yet: how to open one.
#pragma once

#include <span>

#include "app/choices/preferences.h"
#include "app/panels/panel_context.h"

namespace app::panels {

struct StartOffers {
    std::span<const Named> recent;
    std::filesystem::path demo;      // "" when it is not found
    std::filesystem::path autosave;  // of a session that did not end well; "" without one
};

void drawStartScreen(PanelContext& context, const StartOffers& offers);

}  // namespace app::panels
