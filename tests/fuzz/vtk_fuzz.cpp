// VTK files: XML, legacy, and collections, whose members may be a whole file beside the input.
#include "tests/fuzz/read_all.h"

namespace {

constexpr std::string_view kMember =
    R"(<VTKFile type="ImageData"><ImageData WholeExtent="0 1 0 0 0 0"><Piece Extent="0 1 0 0 0 0">
<PointData><DataArray type="Int8" Name="v">1 2</DataArray></PointData></Piece></ImageData></VTKFile>)";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto member = fuzz::write("member.vti", kMember);
    const std::string_view bytes = fuzz::text(data, size);
    if (bytes.starts_with('#') || bytes.starts_with('<')) fuzz::readAll(bytes, "file.vtk");
    return 0;
}
