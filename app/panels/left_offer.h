// A session that broke off is offered over the data that were opened instead.
#pragma once

#include "app/panels/desk.h"

namespace app::panels {

// `session`: its file. Asks to open or to discard it.
void drawLeftOffer(Desk& desk, const std::filesystem::path& session);

}  // namespace app::panels
