// `isochron view`: a window.
#include <cstdio>
#include <cstdlib>

#include "app/commands.h"
#include "app/desktop/desktop.h"

namespace app {

int view(const ViewOptions& options) {
    desktop::Desktop(options).run();
    // A read that nobody waits for may still run: see exploration.h.
    std::fflush(nullptr);
    std::_Exit(EXIT_SUCCESS);
}

}  // namespace app
