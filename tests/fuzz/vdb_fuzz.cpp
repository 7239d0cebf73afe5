// OpenVDB files. A copy of the process tries each first, which is not measured: what is, is the
// file that this one reads after it, and our own code. A crash or a lie that the copy lets through
// is a finding.
#include "tests/fuzz/read_all.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    // By which the format is told: other readers are not what is tested.
    constexpr std::string_view kMagic(" BDV\0\0\0\0", 8);
    std::string file(fuzz::text(data, size));
    file.replace(0, std::min(file.size(), kMagic.size()), kMagic);
    fuzz::readAll(file, "file.vdb");
    return 0;
}
