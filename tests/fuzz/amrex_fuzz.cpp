// Plotfiles of AMReX: a Header, the Cell_H of two levels and a file of FABs for both, apart by
// bytes of 0. The levels' folders are those that the corpus names.
#include "tests/fuzz/read_all.h"

namespace {

namespace fs = std::filesystem;

// Of what comes before the next byte of 0, which is passed.
std::string_view next(std::string_view& rest) {
    const std::size_t end = std::min(rest.find('\0'), rest.size());
    const std::string_view part = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    return part;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string_view rest = fuzz::text(data, size);
    const std::string_view header = next(rest), coarse = next(rest), fine = next(rest);
    if (header.find("-V") == header.npos) return 0;
    static const fs::path plotfile = fuzz::folder() / "plt00000";
    for (const char* level : {"Level_0", "Level_1"}) {
        fs::create_directories(plotfile / level);
        fuzz::write(std::string("plt00000/") + level + "/Cell_D_00000", rest);
    }
    fuzz::write("plt00000/Level_0/Cell_H", coarse);
    fuzz::write("plt00000/Level_1/Cell_H", fine);
    fuzz::write("plt00000/Header", header);
    fuzz::readAll(plotfile);
    return 0;
}
