// NRRD files: the magic is given, so that other readers are not what is tested.
#include "tests/fuzz/read_all.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string bytes = "NRRD0005\n";
    bytes.append(reinterpret_cast<const char*>(data), size);
    fuzz::readAll(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), "file.nrrd");
    return 0;
}
