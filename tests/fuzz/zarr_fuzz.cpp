// Zarr hierarchies: a group with a variable and a coordinate. The input is their metadata and one
// chunk, apart by bytes of 0; its first byte tells the version, or that a zip file follows.
#include <array>

#include "tests/fuzz/read_all.h"

namespace {

namespace fs = std::filesystem;

void putInto(const fs::path& folder, const char* name, std::string_view bytes) {
    fs::create_directories(folder);
    std::ofstream(folder / name, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string_view rest = fuzz::text(data, size);
    if (rest.empty()) return 0;
    if (rest[0] == 'z') {
        fuzz::readAll(rest.substr(1), "store.zarr.zip");
        return 0;
    }
    const bool isV3 = rest[0] == '3';
    rest.remove_prefix(1);
    const fs::path store = fuzz::folder() / "store.zarr";
    fs::remove_all(store);
    const std::string_view group = fuzz::next(rest), array = fuzz::next(rest),
                           attributes = fuzz::next(rest), coordinate = fuzz::next(rest);
    if (isV3) {
        putInto(store, "zarr.json", group);
        putInto(store / "0", "zarr.json", array);
        putInto(store / "x", "zarr.json", coordinate);
        putInto(store / "0" / "c" / "0" / "0", "0", rest);
        putInto(store / "x" / "c", "0", rest);
    } else {
        putInto(store, ".zgroup", "{}");
        putInto(store, ".zattrs", group);
        putInto(store / "0", ".zarray", array);
        putInto(store / "0", ".zattrs", attributes);
        putInto(store / "0", "0.0.0", rest);
        putInto(store / "x", ".zarray", coordinate);
        putInto(store / "x", ".zattrs", R"({"_ARRAY_DIMENSIONS": ["x"]})");
        putInto(store / "x", "0", rest);
    }
    fuzz::readAll(store);
    return 0;
}
