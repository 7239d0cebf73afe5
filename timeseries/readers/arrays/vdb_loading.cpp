#include <dlfcn.h>

#include <stdexcept>

#include "timeseries/readers/arrays/vdb_library.h"

namespace timeseries {

const VdbLibrary& loadVdbLibrary(const char* name) {
    void* const library = dlopen(name, RTLD_LAZY | RTLD_LOCAL);  // for good
    const void* const found = library == nullptr ? nullptr : dlsym(library, "isochronVdb");
    if (found == nullptr) throw std::runtime_error(dlerror());
    return *static_cast<const VdbLibrary*>(found);
}

}  // namespace timeseries
