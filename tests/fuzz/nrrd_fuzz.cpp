// NRRD files: the magic is given, so that other readers are not what is tested.
#include "tests/fuzz/read_all.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::readAll("NRRD0005\n" + std::string(fuzz::text(data, size)), "file.nrrd");
    return 0;
}
