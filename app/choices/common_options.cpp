#include "app/choices/common_options.h"

#include "app/choices/option_checks.h"

namespace app {

void addCommon(CLI::App& app, CommonOptions& into) {
    app.add_option("--threads", into.threads,
                   "At most so many cores; without it, as many as there are, 16 at most")
        ->check(wholeBetween(1, 1024));
    app.add_option("--cache", into.cache,
                   "The folder in which sorted steps are kept, or off; without it the user's own")
        ->check(notEmpty());
    app.add_option("--cache-size", into.cacheSize,
                   "At most so much for it, as 200GB: what was used last stays; without it a tenth "
                   "of its disk, 64GiB at most")
        ->transform(sizeOfBytes());
}

void addMemory(CLI::App& app, CommonOptions& into) {
    app.add_option(
           "--memory", into.memory,
           "At most so much memory for loaded steps, as 8GB, though for one always; without "
           "it a quarter of the machine's")
        ->transform(sizeOfBytes());
}

}  // namespace app
