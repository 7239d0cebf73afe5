#include "timeseries/readers/vtk/vtk_library.h"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkDataSet.h>
#include <vtkFieldData.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkRectilinearGrid.h>
#include <vtkRectilinearGridReader.h>
#include <vtkSmartPointer.h>
#include <vtkStructuredGrid.h>
#include <vtkStructuredGridReader.h>
#include <vtkStructuredPoints.h>
#include <vtkStructuredPointsReader.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLRectilinearGridReader.h>
#include <vtkXMLStructuredGridReader.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <type_traits>

#include "timeseries/grid/with_type.h"
#include "timeseries/grid/without_cells.h"
#include "timeseries/readers/vtk/vtk_cells.h"
#include "timeseries/readers/vtk/vtk_raw_cells.h"
#include "timeseries/readers/vtk/vtk_values.h"

namespace timeseries {
namespace {

// Keeps the first error in place of printing it.
class FirstError final : public vtkOutputWindow {
 public:
    static FirstError* New();
    vtkTypeMacro(FirstError, vtkOutputWindow);

    void DisplayText(const char*) override {}
    void DisplayErrorText(const char* text) override {
        if (first_.empty()) first_ = text;
    }
    // "Error reading ascii data" is among these.
    void DisplayGenericWarningText(const char* text) override { DisplayErrorText(text); }
    void DisplayWarningText(const char*) override {}
    void DisplayDebugText(const char*) override {}

    // Without VTK's source file, line and object; "" when there was none.
    std::string sentence() const {
        std::string text = first_;
        if (const std::size_t line = text.find('\n'); line != text.npos) text.erase(0, line + 1);
        // What follows is no sentence: its objects, attribute by attribute.
        if (text.find("returned failure for request") != text.npos) return "its reader stops there";
        if (const std::size_t object = text.find("): "); object != text.npos)
            text.erase(0, object + 3);
        while (!text.empty() && (text.back() == '\n' || text.back() == ' ' || text.back() == '.'))
            text.pop_back();
        return text;
    }

 private:
    std::string first_;
};
vtkStandardNewMacro(FirstError);

// Calls `read` with VTK to itself; what goes wrong in VTK becomes a FileError.
template <typename Read>
auto withVtk(const VtkHeader& header, std::string_view place, Read read) {
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    const vtkSmartPointer<vtkOutputWindow> usual = vtkOutputWindow::GetInstance();
    const vtkNew<FirstError> errors;
    vtkOutputWindow::SetInstance(errors);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // or all is printed there too
    struct Restore {
        vtkOutputWindow* window;
        ~Restore() { vtkOutputWindow::SetInstance(window); }
    } const restore{usual};
    try {
        auto result = read();
        if (const std::string why = errors->sentence(); !why.empty())
            failVtk(header.path, place, "expected values that VTK can read, but: " + why);
        return result;
    } catch (const std::bad_alloc&) {
        failVtk(header.path, place, "expected values that fit in memory");
    }
}

// VTK takes the arrays' names and types from the first piece, also where that is empty.
template <typename Base>
class WithoutEmptyPieces final : public Base {
 public:
    static WithoutEmptyPieces* New() { VTK_STANDARD_NEW_BODY(WithoutEmptyPieces); }

 protected:
    int ReadPrimaryElement(vtkXMLDataElement* primary) override {
        std::vector<vtkSmartPointer<vtkXMLDataElement>> kept;
        for (int i = 0; i < primary->GetNumberOfNestedElements(); ++i)
            if (vtkXMLDataElement* element = primary->GetNestedElement(i); !isEmpty(*element))
                kept.emplace_back(element);
        primary->RemoveAllNestedElements();
        for (const auto& element : kept) primary->AddNestedElement(element);
        return Base::ReadPrimaryElement(primary);
    }

 private:
    static bool isEmpty(vtkXMLDataElement& element) {
        if (std::string_view(element.GetName()) != "Piece") return false;
        int extent[6];
        vtkIdType points = 0, cells = 0;
        if (element.GetVectorAttribute("Extent", 6, extent) == 6)
            return extent[1] < extent[0] || extent[3] < extent[2] || extent[5] < extent[4];
        element.GetScalarAttribute("NumberOfPoints", points);
        element.GetScalarAttribute("NumberOfCells", cells);
        return points == 0 && cells == 0;
    }
};

vtkSmartPointer<vtkXMLReader> readerOf(const VtkHeader& header) {
    vtkSmartPointer<vtkXMLReader> reader;
    if (header.kind == VtkKind::XmlImage)
        reader = vtkSmartPointer<WithoutEmptyPieces<vtkXMLImageDataReader>>::New();
    else if (header.kind == VtkKind::XmlRectilinear)
        reader = vtkSmartPointer<WithoutEmptyPieces<vtkXMLRectilinearGridReader>>::New();
    else if (header.kind == VtkKind::XmlStructured)
        reader = vtkSmartPointer<WithoutEmptyPieces<vtkXMLStructuredGridReader>>::New();
    else if (header.kind == VtkKind::XmlPolygons)
        reader = vtkSmartPointer<WithoutEmptyPieces<VtkPolygonReader>>::New();
    else
        reader = vtkSmartPointer<WithoutEmptyPieces<VtkCellReader>>::New();
    reader->SetFileName(header.path.c_str());
    return reader;
}

vtkSmartPointer<vtkDataSet> readBy(vtkXMLReader* reader, const VtkArray* wanted) {
    reader->UpdateInformation();
    for (const VtkPlace place : {VtkPlace::Points, VtkPlace::Cells}) {
        vtkDataArraySelection* selection = place == VtkPlace::Points
                                               ? reader->GetPointDataArraySelection()
                                               : reader->GetCellDataArraySelection();
        selection->DisableAllArrays();
        if (!wanted || wanted->place != place) continue;
        selection->EnableArray(wanted->name.c_str());
        for (int i = 0; i < selection->GetNumberOfArrays(); ++i)
            if (isVtkGhostName(selection->GetArrayName(i)))
                selection->EnableArray(selection->GetArrayName(i));
    }
    reader->Update();
    return reader->GetOutputAsDataSet();
}

// Of each keyword only the array of the name set is kept; the first when none is set.
void select(vtkDataReader& reader, const VtkArray* wanted) {
    const auto name = [&](VtkKeyword keyword) {
        const bool isIt = wanted && keyword == wanted->keyword;
        return isIt ? wanted->name.c_str() : "\x1f";  // no array is called so
    };
    reader.SetScalarsName(name(VtkKeyword::Scalars));
    reader.SetVectorsName(name(VtkKeyword::Vectors));
    reader.SetNormalsName(name(VtkKeyword::Normals));
    reader.SetTCoordsName(name(VtkKeyword::TextureCoordinates));
    reader.SetTensorsName(name(VtkKeyword::Tensors));
}

// VTK 9.1 looks for a structured grid's size in all words of the file, values too, and crashes on
// fields there. Its size is known.
class StructuredReader final : public vtkStructuredGridReader {
 public:
    static StructuredReader* New() { VTK_STANDARD_NEW_BODY(StructuredReader); }
    int ReadMetaDataSimple(const std::string&, vtkInformation*) override { return 1; }
};

template <typename Reader>
vtkSmartPointer<vtkDataSet> readLegacy(const VtkHeader& header, const VtkArray* wanted) {
    const vtkNew<Reader> reader;
    reader->SetFileName(header.path.c_str());
    const bool ghosts = wanted && header.ghosts[static_cast<std::size_t>(wanted->place)];
    // VTK 9.1 crashes on a field outside the attributes that it is not to keep.
    if (ghosts || header.fieldOutside || (wanted && wanted->keyword == VtkKeyword::Field))
        reader->ReadAllFieldsOn();
    else
        reader->SetFieldDataName("\x1f");
    if (ghosts) reader->ReadAllScalarsOn();
    select(*reader, wanted);
    reader->Update();
    return reader->GetOutput();
}

// VTK has several types for one of C++ (long and long long, char and signed char).
bool holds(vtkDataArray& array, ValueType type) {
    return withType(type, [&]<typename T>(T) {
        const int found = array.GetDataType();
        return array.GetDataTypeSize() == sizeof(T) &&
               (found == VTK_FLOAT || found == VTK_DOUBLE) == std::is_floating_point_v<T> &&
               (array.GetDataTypeMin() < 0) == std::is_signed_v<T>;
    });
}

struct Arrays {
    vtkSmartPointer<vtkDataArray> values, ghosts;
};

// Only the arrays outlive the reader and its output.
Arrays readArrays(const VtkHeader& header, const VtkArray& wanted) {
    vtkSmartPointer<vtkDataSet> output;
    switch (header.kind) {
        case VtkKind::XmlImage:
        case VtkKind::XmlRectilinear:
        case VtkKind::XmlStructured:
        case VtkKind::XmlUnstructured:
        case VtkKind::XmlPolygons:
            output = readBy(readerOf(header), &wanted);
            break;
        case VtkKind::LegacyPoints:
            output = readLegacy<vtkStructuredPointsReader>(header, &wanted);
            break;
        case VtkKind::LegacyRectilinear:
            output = readLegacy<vtkRectilinearGridReader>(header, &wanted);
            break;
        case VtkKind::LegacyStructured:
            output = readLegacy<StructuredReader>(header, &wanted);
            break;
        case VtkKind::LegacyUnstructured:
            output = readLegacy<vtkUnstructuredGridReader>(header, &wanted);
            break;
        case VtkKind::LegacyPolygons:
            output = readLegacy<vtkPolyDataReader>(header, &wanted);
            break;
        case VtkKind::XmlBlocks:  // has no values of its own
            break;
    }
    if (!output) return {};
    vtkDataSetAttributes* data = wanted.place == VtkPlace::Points
                                     ? static_cast<vtkDataSetAttributes*>(output->GetPointData())
                                     : output->GetCellData();
    Arrays arrays{data->GetArray(wanted.name.c_str()), data->GetArray("vtkGhostType")};
    if (!arrays.ghosts) arrays.ghosts = data->GetArray("vtkGhostLevels");
    return arrays;
}

std::vector<double> numbersOf(vtkDataArray* array) {
    std::vector<double> numbers;
    for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
        numbers.push_back(array->GetComponent(i, 0));
    return numbers;
}

template <typename Places>
Places placesOf(const VtkHeader& header, vtkPointSet& grid) {
    const auto count = static_cast<vtkIdType>(header.count(VtkPlace::Points));
    if (count > 0 && !grid.GetPoints())
        failVtk(header.path, "Points", "expected places, but VTK reads none");
    if (grid.GetNumberOfPoints() != count)
        failVtk(header.path, "Points",
                fmt::format("expected {} of them, but VTK reads something else", count));
    Places places(static_cast<std::size_t>(count));
    for (vtkIdType i = 0; i < count; ++i) grid.GetPoint(i, &places[static_cast<std::size_t>(i)].x);
    return places;
}

}  // namespace

VtkFrame readVtkFrame(const VtkHeader& header) {
    VtkFrame frame;
    bool isRaw = false;
    const auto output = withVtk(header, "", [&] {
        if (header.kind == VtkKind::LegacyStructured)
            return readLegacy<StructuredReader>(header, nullptr);
        const auto reader = readerOf(header);
        auto* const cells = dynamic_cast<VtkCells*>(reader.Get());
        auto raw = rawVtkCells(header);
        isRaw = raw.has_value();
        if (cells && !raw) cells->expect(&header.pieces);
        const auto found = readBy(reader, nullptr);
        if (cells) frame.unstructured = raw ? std::move(*raw) : cells->takeCells();
        return found;
    });
    if (!output) failVtk(header.path, "", "expected a grid, but VTK reads none");
    frame.unstructured.inParts = header.pieces.size() > 1;
    if (auto* grid = vtkRectilinearGrid::SafeDownCast(output))
        frame.coordinates = {numbersOf(grid->GetXCoordinates()), numbersOf(grid->GetYCoordinates()),
                             numbersOf(grid->GetZCoordinates())};
    if (auto* grid = vtkStructuredGrid::SafeDownCast(output))
        frame.places = placesOf<std::vector<glm::dvec3>>(header, *grid);
    if (auto* grid = vtkPointSet::SafeDownCast(output);
        grid && isUnstructured(header.kind) && !isRaw)
        frame.unstructured.points = placesOf<PageVector<glm::dvec3>>(header, *grid);
    vtkFieldData* data = output->GetFieldData();
    for (int i = 0; data && i < data->GetNumberOfArrays(); ++i) {
        vtkDataArray* array = data->GetArray(i);
        if (!array || !array->GetName() || array->GetNumberOfValues() != 1) continue;
        const auto name = vtkTimeName(array->GetName());
        const double value = array->GetComponent(0, 0);
        if (name && std::isfinite(value) && (!frame.time || *name == "time"))
            frame.time = VtkTime{*name, value};
    }
    return frame;
}

std::vector<bool> readVtkGhostCells(const VtkHeader& header) {
    if (!header.ghosts[static_cast<std::size_t>(VtkPlace::Cells)]) return {};
    VtkArray wanted;
    wanted.name = "vtkGhostType";
    wanted.place = VtkPlace::Cells;
    const std::string place = fmt::format("'{}'", wanted.name);
    const Arrays arrays = withVtk(header, place, [&] { return readArrays(header, wanted); });
    const std::uint64_t count = header.count(VtkPlace::Cells);
    std::vector<bool> ghosts;
    if (!arrays.ghosts) return ghosts;
    if (static_cast<std::uint64_t>(arrays.ghosts->GetNumberOfTuples()) != count)
        failVtk(header.path, place,
                fmt::format("expected {} values, but VTK reads something else", count));
    takeVtkGhosts(*arrays.ghosts, VtkPlace::Cells, {{count, 1, 1}, {1, count, count}}, ghosts);
    return ghosts;
}

void readVtkArray(const VtkHeader& header, const VtkArray& array, VtkPart part,
                  const StridedLayout& layout, Field& field) {
    const std::string place = fmt::format("'{}'", array.name);
    const Arrays arrays = withVtk(header, place, [&] { return readArrays(header, array); });
    const auto count = static_cast<vtkIdType>(header.count(array.place));
    if (!arrays.values || arrays.values->GetNumberOfTuples() != count ||
        static_cast<std::size_t>(arrays.values->GetNumberOfComponents()) != array.components ||
        !holds(*arrays.values, array.type) ||
        (arrays.ghosts && arrays.ghosts->GetNumberOfTuples() != count))
        failVtk(header.path, place,
                fmt::format("expected {} {} of {} values, but VTK reads something else", count,
                            typeName(array.type), array.components));
    takeVtkValues(*arrays.values, array, part, layout, field);
    if (arrays.ghosts) takeVtkGhosts(*arrays.ghosts, array.place, layout, field.missing);
    if (array.place == VtkPlace::Points && !header.pointsOfGhosts.empty())
        leaveOut(arranged(header.pointsOfGhosts, layout), field.missing);
}

}  // namespace timeseries
