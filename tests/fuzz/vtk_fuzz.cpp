// VTK files: XML, legacy, and collections, whose members may be a whole file beside the input.
#include "tests/fuzz/read_all.h"
#include "timeseries/readers/vtk/vtk_glance.h"

namespace {

// A file that opens has the time that a series would take for its own.
void compareGlance(const std::filesystem::path& path) {
    try {
        const auto glance = timeseries::vtkGlanceAt(path);
        if (!glance) return;
        if (glance->flaw.find('\n') != std::string::npos) std::abort();
        const auto reader = timeseries::openReader(std::span(&path, 1));
        const auto& time = *reader->variables()[0].time;
        if (!glance->flaw.empty() || glance->variables.size() != reader->variables().size() ||
            glance->time->counted != time.counted || glance->time->name != time.name ||
            glance->time->points[0].value != time.points[0].value)
            std::abort();
    } catch (const timeseries::FileError&) {
    }
}

constexpr std::string_view kMember =
    R"(<VTKFile type="ImageData"><ImageData WholeExtent="0 1 0 0 0 0"><Piece Extent="0 1 0 0 0 0">
<PointData><DataArray type="Int8" Name="v">1 2</DataArray></PointData></Piece></ImageData></VTKFile>)";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto member = fuzz::write("member.vti", kMember);
    const std::string_view bytes = fuzz::text(data, size);
    if (bytes.starts_with('#') || bytes.starts_with('<')) {
        fuzz::readAll(bytes, "file.vtk");
        compareGlance(fuzz::folder() / "file.vtk");
    }
    return 0;
}
