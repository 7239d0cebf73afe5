// OpenFOAM cases: a mesh, and a field of cells and one of points. The input is their files, apart
// by lines of ====; its first byte tells whether they are packed by gzip.
#include <zlib.h>

#include "tests/fuzz/read_all.h"

namespace {

namespace fs = std::filesystem;

void putInto(const fs::path& folder, const std::string& name, std::string_view bytes,
             bool isPacked) {
    if (!isPacked) {
        std::ofstream(folder / name, std::ios::binary)
            .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        return;
    }
    gzFile file = gzopen((folder / (name + ".gz")).c_str(), "wb1");
    gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
    gzclose(file);
}

constexpr std::string_view kLine = "\n====\n";  // between texts

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string_view rest = fuzz::text(data, size);
    if (rest.empty()) return 0;
    const bool isPacked = rest[0] == 'z';
    rest.remove_prefix(1);
    const fs::path folder = fuzz::folder() / "case", mesh = folder / "constant" / "polyMesh";
    fs::remove_all(folder);
    fs::create_directories(mesh);
    fs::create_directories(folder / "0");
    for (const char* name : {"points", "faces", "owner", "neighbour"})
        putInto(mesh, name, fuzz::next(rest, kLine), isPacked);
    for (const char* name : {"T", "Tp"})
        putInto(folder / "0", name, fuzz::next(rest, kLine), isPacked);
    fuzz::readAll(folder);
    return 0;
}
