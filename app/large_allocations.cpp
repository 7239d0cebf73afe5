// What is large in the program, as a picture's pixels are, lies in large pages. Of small ones a
// picture of a million pixels takes some twenty thousand, each 0.2 to 0.5 us of the kernel's time,
// and 10 to 20 in some virtual machines.
#include <algorithm>
#include <cstdlib>
#include <new>

#include "timeseries/grid/pages.h"

void* operator new(std::size_t bytes) {
    if (bytes >= timeseries::kWorthLargePages) return timeseries::takePages(bytes);
    void* const at = std::malloc(std::max<std::size_t>(bytes, 1));
    if (at == nullptr) throw std::bad_alloc();
    return at;
}
void operator delete(void* at) noexcept { std::free(at); }
void operator delete(void* at, std::size_t) noexcept { std::free(at); }
