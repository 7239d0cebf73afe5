// A runtime's library that does not do what the loader asks of it first: it crashes, or never
// answers, as ISOCHRON_TEST_RUNTIME says.
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>

extern "C" int xrNegotiateLoaderRuntimeInterface(const void*, void*) {
    const char* what = std::getenv("ISOCHRON_TEST_RUNTIME");
    if (what != nullptr && std::strcmp(what, "crashes") == 0) std::raise(SIGSEGV);
    while (true) pause();
}
