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

// Of what comes before the next line of ====, which is passed.
std::string_view next(std::string_view& rest) {
    constexpr std::string_view kLine = "\n====\n";
    const std::size_t end = std::min(rest.find(kLine), rest.size());
    const std::string_view part = rest.substr(0, end);
    rest.remove_prefix(std::min(end + kLine.size(), rest.size()));
    return part;
}

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
        putInto(mesh, name, next(rest), isPacked);
    for (const char* name : {"T", "Tp"}) putInto(folder / "0", name, next(rest), isPacked);
    fuzz::readAll(folder);
    return 0;
}
