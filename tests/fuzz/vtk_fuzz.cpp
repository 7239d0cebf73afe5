// VTK files: XML, legacy, and those that name others, which are whole files beside the input.
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

struct Member {
    const char* name;
    std::string_view text;
};
constexpr Member kMembers[] = {
    {"member.vti",
     R"(<VTKFile type="ImageData"><ImageData WholeExtent="0 1 0 0 0 0"><Piece Extent="0 1 0 0 0 0">
<PointData><DataArray type="Int8" Name="v">1 2</DataArray></PointData></Piece></ImageData></VTKFile>)"},
    {"coarse.vti",
     R"(<VTKFile type="ImageData"><ImageData WholeExtent="0 2 0 1 0 1"><Piece Extent="0 2 0 1 0 1">
<CellData><DataArray type="Int8" Name="c">1 2</DataArray></CellData></Piece></ImageData></VTKFile>)"},
    {"fine.vti",
     R"(<VTKFile type="ImageData"><ImageData WholeExtent="0 2 0 2 0 2" Spacing=".5 .5 .5"><Piece Extent="0 2 0 2 0 2">
<CellData><DataArray type="Int8" Name="c">1 2 3 4 5 6 7 8</DataArray></CellData></Piece></ImageData></VTKFile>)"},
    {"member.vtu",
     R"(<VTKFile type="UnstructuredGrid"><UnstructuredGrid><Piece NumberOfPoints="4" NumberOfCells="1"><PointData><DataArray type="Int8" Name="v">1 2 3 4</DataArray></PointData>
<Points><DataArray type="Float32" NumberOfComponents="3">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity">0 1 2 3</DataArray><DataArray type="Int32" Name="offsets">4</DataArray><DataArray type="UInt8" Name="types">10</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>)"},
    {"member.vts",
     R"(<VTKFile type="StructuredGrid"><StructuredGrid WholeExtent="0 1 0 1 0 0"><Piece Extent="0 1 0 1 0 0"><PointData><DataArray type="Int8" Name="v">1 2 3 4</DataArray></PointData>
<Points><DataArray type="Float32" NumberOfComponents="3">0 0 0 1 0 0 0 1 0 1 1 1</DataArray></Points></Piece></StructuredGrid></VTKFile>)"},
};

bool writeMembers() {
    for (const auto& [name, text] : kMembers) fuzz::write(name, text);
    return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    [[maybe_unused]] static const bool areThere = writeMembers();
    const std::string_view bytes = fuzz::text(data, size);
    if (bytes.starts_with('#') || bytes.starts_with('<')) {
        fuzz::readAll(bytes, "file.vtk");
        compareGlance(fuzz::folder() / "file.vtk");
    }
    return 0;
}
