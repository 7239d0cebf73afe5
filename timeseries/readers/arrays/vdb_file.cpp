#include "timeseries/readers/arrays/vdb_file.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string>

#include "timeseries/readers/forked_call.h"

namespace timeseries {
namespace {

// This process may take so many bytes more than it has; none are told of a length that lies.
void allowMemory(std::uint64_t bytes) {
    std::ifstream taken("/proc/self/statm");
    std::uint64_t pages = 0;
    if (!(taken >> pages)) return;
    const rlim_t most = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) + bytes;
    const rlimit limit{most, most};
    setrlimit(RLIMIT_AS, &limit);
}

// As it was built and installed with the program, for good. Throws std::runtime_error, of the
// linker's words.
const VdbLibrary* loaded() {
    void* const library = dlopen("libisochron_vdb.so", RTLD_LAZY | RTLD_LOCAL);
    const void* const found = library == nullptr ? nullptr : dlsym(library, "isochronVdb");
    if (found == nullptr) throw std::runtime_error(dlerror());
    return static_cast<const VdbLibrary*>(found);
}

}  // namespace

VdbFile::VdbFile(const std::filesystem::path& path, Header header) : path_(path) {
    const auto read = [&] { contents_ = loaded()->contents(path); };
    if (header == Header::New) tryInCopy("header", 0, read);
    try {
        library_ = loaded();
    } catch (const std::runtime_error& error) {
        fail("OpenVDB",
             fmt::format("expected this program's part that reads it, but {}", error.what()));
    }
    told("header", read);
}

Values VdbFile::read(const VdbGrid& grid, const VdbBox& box) const {
    Values values;
    const auto work = [&] { values = library_->read(path_, grid, box); };
    const std::string place = fmt::format("grid '{}'", grid.name);
    tryInCopy(place, sizeof(double) * grid.numbers * *box.count(), work);
    told(place, work);
    return values;
}

void VdbFile::fail(std::string_view place, std::string_view what) const {
    throw FileError(fmt::format("{}: {}: {}", path_.string(), place, what));
}

void VdbFile::told(std::string_view place, const std::function<void()>& work) const {
    try {
        work();
    } catch (const std::bad_alloc&) {
        fail(place, "expected what memory holds, but there is not as much of it");
    }
}

void VdbFile::tryInCopy(std::string_view place, std::uint64_t more,
                        const std::function<void()>& work) const {
    constexpr std::chrono::seconds kMostTime(30);
    constexpr std::uint64_t kUnpacked = 256, kBeside = std::uint64_t{256} << 20;
    std::error_code unknown;
    const auto fileBytes = std::filesystem::file_size(path_, unknown);
    const std::string end = endOfForked(
        [&] {
            // Here first: it starts threads, and to copy a process while its threads begin may copy
            // a lock that stays shut.
            loaded();
            allowMemory((unknown ? 0 : kUnpacked * fileBytes) + kBeside + more);
            try {
                work();
            } catch (const std::bad_alloc&) {
                std::abort();
            }
        },
        kMostTime);
    if (!end.empty()) fail(place, "expected what OpenVDB can read, but OpenVDB " + end);
}

}  // namespace timeseries
