// Files that are a header and an array: the magic is given, so that other readers are not what is
// tested. The first byte tells which format; NRRD's begin with text.
#include <algorithm>

#include "tests/fuzz/read_all.h"

namespace {

void put(std::string& file, std::size_t at, std::string_view magic) {
    file.resize(std::max(file.size(), at + magic.size()));
    file.replace(at, magic.size(), magic);
}

// For PLOT3D, whose places stand in a file beside: 2 x 2 x 2 of them.
std::string cornersOfACube() {
    std::string file("\2\0\0\0\2\0\0\0\2\0\0\0", 12);
    for (int c = 0; c < 3; ++c)
        for (int point = 0; point < 8; ++point) {
            const auto at = static_cast<float>(point >> c & 1);
            file.append(reinterpret_cast<const char*>(&at), 4);
        }
    return file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace std::string_view_literals;
    std::string file(fuzz::text(data, size));
    const char kind = file.empty() ? '\0' : file[0];
    if (kind >= '\1' && kind <= '\6') file.erase(0, 1);
    switch (kind) {
        case '\1':
            put(file, 344, "n+1\0"sv);
            break;
        case '\2':
            put(file, 4, "n+2\0\r\n\x1a\n"sv);
            break;
        case '\3':
            put(file, 208, "MAP "sv);
            break;
        case '\4':
            put(file, 0, "SIMPLE  =                    T"sv);
            break;
        case '\5': {
            static const auto places = fuzz::write("places.xyz", cornersOfACube());
            put(file, 0, "\2\0\0\0\2\0\0\0\2\0\0\0"sv);
            break;
        }
        case '\6':
            file.insert(0, "x,y,z,T\n0,0,0,1\n");
            break;
        default:
            file.insert(0, "NRRD0005\n");
    }
    fuzz::readAll(file, "file.array");
    return 0;
}
