// Plotfiles of AMReX: a Header, the Cell_H of two levels and a file of FABs for both, apart by
// bytes of 0. The levels' folders are those that the corpus names.
#include "tests/fuzz/read_all.h"

namespace {

namespace fs = std::filesystem;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string_view rest = fuzz::text(data, size);
    const std::string_view header = fuzz::next(rest), coarse = fuzz::next(rest),
                           fine = fuzz::next(rest);
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
