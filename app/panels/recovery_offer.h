// A session that broke off is offered over the data that were opened instead.
#pragma once

#include "app/panels/panel_context.h"

namespace app::panels {

// `session`: its file. Asks to open or to discard it. Returns where it ends, above what follows.
float drawRecoveryOffer(PanelContext& context, const std::filesystem::path& session);

}  // namespace app::panels
