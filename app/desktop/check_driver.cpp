#include "app/desktop/check_driver.h"

#include <fmt/format.h>

#include <stdexcept>

#include "render/gl/debug_output.h"

namespace app {

#ifdef NDEBUG
void checkDriver(Exploration& exploration) {
    try {
        render::gl::throwOnError();
    } catch (const std::runtime_error& error) {
        exploration.tell(fmt::format("The graphics driver complains; the picture may be wrong ({})",
                                     error.what()),
                         true);
    }
}
#else
void checkDriver(Exploration&) { render::gl::throwOnError(); }
#endif

}  // namespace app
