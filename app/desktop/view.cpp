// `isochron view`: a window.
#include <cstdio>
#include <cstdlib>

#include "app/commands.h"
#include "app/desktop/desktop.h"

namespace app {

int view(const ViewOptions& options) {
    desktop::Desktop(options).run();
    return 0;
}

}  // namespace app
