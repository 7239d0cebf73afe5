// What the cells of VTK's files take, of each kind and in each kind of grid: beside closed forms,
// the integral of a trilinear hexahedron, and the tetrahedra that VTK itself cuts them into, where
// these fill them.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkStructuredGrid.h>
#include <vtkTetra.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLStructuredGridReader.h>
#include <vtkXMLStructuredGridWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "tests/support/files.h"
#include "tests/support/read_variables.h"
#include "tests/support/shared_data.h"
#include "tests/support/trilinear.h"
#include "tests/support/unstructured.h"

namespace timeseries::vtk_volumes {
namespace {

using Path = std::filesystem::path;
constexpr double kError = 1e-6;  // cells are kept in floats

// One value a cell.
void addValues(vtkDataSet& data) {
    const vtkNew<vtkFloatArray> values;
    values->SetName("w");
    for (vtkIdType i = 0; i < data.GetNumberOfCells(); ++i)
        values->InsertNextValue(static_cast<float>(i));
    data.GetCellData()->AddArray(values);
}

template <typename Writer>
Path written(vtkDataSet& data, const char* name) {
    const Path path = tests::testFolder() / name;
    const vtkNew<Writer> writer;
    writer->SetFileName(path.c_str());
    writer->SetInputData(&data);
    EXPECT_EQ(writer->Write(), 1);
    return path;
}

// Of the tetrahedra that VTK cuts a cell into.
double volumeByVtk(vtkDataSet& data, vtkIdType cell) {
    const vtkNew<vtkIdList> ids;
    const vtkNew<vtkPoints> points;
    data.GetCell(cell)->Triangulate(0, ids, points);
    double sum = 0;
    for (vtkIdType t = 0; t + 3 < points->GetNumberOfPoints(); t += 4) {
        std::array<glm::dvec3, 4> p;
        for (vtkIdType c = 0; c < 4; ++c) points->GetPoint(t + c, &p[std::size_t(c)].x);
        sum += std::abs(vtkTetra::ComputeVolume(&p[0].x, &p[1].x, &p[2].x, &p[3].x));
    }
    return sum;
}

std::vector<glm::dvec3> cornersOf(vtkDataSet& data, vtkIdType cell) {
    vtkPoints* const points = data.GetCell(cell)->GetPoints();
    std::vector<glm::dvec3> corners(static_cast<std::size_t>(points->GetNumberOfPoints()));
    for (std::size_t i = 0; i < corners.size(); ++i)
        points->GetPoint(static_cast<vtkIdType>(i), &corners[i].x);
    return corners;
}

// Each of the first variable's cells takes what `expected` says, and so do all: this.
template <typename Expected>
double expectVolumes(const Path& path, std::size_t cells, const Expected& expected) {
    const auto reader = tests::open(path);
    const Mesh& mesh = *reader->variables()[0].grid->mesh();
    EXPECT_EQ(mesh.count(), cells) << path;
    double all = 0;
    for (std::size_t i = 0; i < std::min<std::size_t>(cells, mesh.count()); ++i) {
        const double its = expected(i);
        EXPECT_NEAR(tests::volume(mesh, i), its, kError * its) << path << ' ' << i;
        all += its;
    }
    EXPECT_NEAR(tests::volume(mesh), all, kError * all) << path;
    return tests::volume(mesh);
}

// By the places of its corners around it, of a flat polygon.
double areaOf(const std::vector<glm::dvec3>& corners) {
    glm::dvec3 twice(0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        twice += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    return glm::length(twice) / 2;
}

// Where VTK has the nodes of a cell of this type, in the unit cube.
std::vector<glm::dvec3> nodesOf(int type) {
    vtkCell* const cell = vtkGenericCell::InstantiateCell(type);
    const double* const at = cell->GetParametricCoords();
    std::vector<glm::dvec3> nodes;
    for (int i = 0; i < cell->GetNumberOfPoints(); ++i)
        nodes.emplace_back(at[3 * i], at[3 * i + 1], at[3 * i + 2]);
    cell->Delete();
    return nodes;
}
double prismOf(int type, std::size_t sides) {
    auto nodes = nodesOf(type);
    nodes.resize(sides);
    return areaOf(nodes);  // as high as 1
}

// Columns: turned, sheared and stretched.
const glm::dmat3 kLean(1.1, 0.2, 0.1, -0.3, 0.9, 0.2, 0.15, -0.1, 1.3);

class Cells {
 public:
    Cells() {
        points_->SetDataTypeToDouble();
        grid_->SetPoints(points_);
    }
    // Beside those before.
    void add(int type, const std::vector<glm::dvec3>& nodes, const glm::dmat3& space = kLean) {
        std::vector<vtkIdType> ids;
        const auto many = static_cast<vtkIdType>(nodes.size());
        for (const glm::dvec3& node : nodes) {
            const glm::dvec3 at = space * node + glm::dvec3(4.0 * double(cells_), 0, 0);
            ids.push_back(points_->InsertNextPoint(&at.x));
        }
        ++cells_;
        if (type != VTK_POLYHEDRON) {
            grid_->InsertNextCell(type, many, ids.data());
            return;
        }
        // A prism: its two ends, and the sides between them.
        const std::size_t n = nodes.size() / 2;
        std::vector<vtkIdType> faces;
        for (const std::size_t end : {std::size_t{0}, n}) {
            faces.push_back(static_cast<vtkIdType>(n));
            faces.insert(faces.end(), ids.begin() + long(end), ids.begin() + long(end + n));
        }
        for (std::size_t i = 0; i < n; ++i)
            faces.insert(faces.end(),
                         {4, ids[i], ids[(i + 1) % n], ids[n + (i + 1) % n], ids[n + i]});
        grid_->InsertNextCell(type, many, ids.data(), static_cast<vtkIdType>(n + 2), faces.data());
    }
    vtkUnstructuredGrid& grid() { return *grid_; }

 private:
    vtkNew<vtkUnstructuredGrid> grid_;
    vtkNew<vtkPoints> points_;
    std::size_t cells_ = 0;
};

struct Solid {
    int type;
    double volume;         // in the unit cube
    int placed = 0;        // as a cell of this type, whose nodes count; 0: of its own
    bool isFilled = true;  // by VTK's tetrahedra
};

TEST(VtkVolumes, OfEachKindOfSolid) {
    const std::vector<Solid> solids{
        {VTK_TETRA, 1.0 / 6},
        {VTK_HEXAHEDRON, 1},
        {VTK_WEDGE, 0.5},
        {VTK_PYRAMID, 1.0 / 3},
        {VTK_PENTAGONAL_PRISM, prismOf(VTK_PENTAGONAL_PRISM, 5)},
        {VTK_HEXAGONAL_PRISM, prismOf(VTK_HEXAGONAL_PRISM, 6)},
        {VTK_POLYHEDRON, prismOf(VTK_HEXAGONAL_PRISM, 6), VTK_HEXAGONAL_PRISM},
        {VTK_QUADRATIC_TETRA, 1.0 / 6},
        {VTK_QUADRATIC_HEXAHEDRON, 1},
        {VTK_QUADRATIC_WEDGE, 0.5},
        {VTK_QUADRATIC_PYRAMID, 1.0 / 3, 0, false},
        {VTK_TRIQUADRATIC_HEXAHEDRON, 1, 0, false},
        {VTK_QUADRATIC_LINEAR_WEDGE, 0.5, 0, false},
        {VTK_BIQUADRATIC_QUADRATIC_WEDGE, 0.5, 0, false},
        {VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON, 1, 0, false},
        {VTK_LAGRANGE_TETRAHEDRON, 1.0 / 6, VTK_TETRA, false},
        {VTK_LAGRANGE_HEXAHEDRON, 1, VTK_HEXAHEDRON, false},
        {VTK_LAGRANGE_WEDGE, 0.5, VTK_WEDGE, false},
        {VTK_LAGRANGE_PYRAMID, 1.0 / 3, VTK_PYRAMID, false},
        {VTK_BEZIER_TETRAHEDRON, 1.0 / 6, VTK_TETRA, false},
        {VTK_BEZIER_HEXAHEDRON, 1, VTK_HEXAHEDRON, false},
        {VTK_BEZIER_WEDGE, 0.5, VTK_WEDGE, false},
        {VTK_BEZIER_PYRAMID, 1.0 / 3, VTK_PYRAMID, false},
    };
    Cells cells;
    for (const Solid& solid : solids)
        cells.add(solid.type, nodesOf(solid.placed ? solid.placed : solid.type));
    const glm::dmat3 upright(1.5, 0, 0, 0, 0.5, 0, 0, 0, 2.5);
    cells.add(VTK_VOXEL, nodesOf(VTK_VOXEL), upright);
    addValues(cells.grid());
    const double leaning = glm::determinant(kLean);
    for (std::size_t i = 0; i < solids.size(); ++i) {
        const double expected = leaning * solids[i].volume;
        if (solids[i].isFilled) {
            EXPECT_NEAR(volumeByVtk(cells.grid(), vtkIdType(i)), expected, kError * expected) << i;
        }
    }
    for (const Path& path : {written<vtkXMLUnstructuredGridWriter>(cells.grid(), "solids.vtu"),
                             written<vtkUnstructuredGridWriter>(cells.grid(), "solids.vtk")})
        expectVolumes(path, solids.size() + 1, [&](std::size_t i) {
            return i < solids.size() ? leaning * solids[i].volume : 1.5 * 0.5 * 2.5;
        });
}

// Where there are no solids: as thick as their mean is wide.
TEST(VtkVolumes, OfEachKindOfSurface) {
    Cells cells;
    std::vector<double> areas;
    // So many nodes are corners around it.
    const auto add = [&](int type, std::size_t corners, const std::vector<glm::dvec3>& nodes) {
        cells.add(type, nodes);
        std::vector<glm::dvec3> around;
        for (std::size_t i = 0; i < corners; ++i) around.push_back(kLean * nodes[i]);
        if (type == VTK_PIXEL) std::swap(around[2], around[3]);
        areas.push_back(areaOf(around));
    };
    for (const int type : {VTK_TRIANGLE, VTK_QUADRATIC_TRIANGLE, VTK_BIQUADRATIC_TRIANGLE})
        add(type, 3, nodesOf(type));
    for (const int type :
         {VTK_QUAD, VTK_PIXEL, VTK_QUADRATIC_QUAD, VTK_BIQUADRATIC_QUAD, VTK_QUADRATIC_LINEAR_QUAD})
        add(type, 4, nodesOf(type));
    add(VTK_POLYGON, 5, {{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 2, 0}, {0, 1, 0}});
    addValues(cells.grid());
    double mean = 0;
    for (const double area : areas) mean += area / double(areas.size());
    expectVolumes(written<vtkXMLUnstructuredGridWriter>(cells.grid(), "surfaces.vtu"), areas.size(),
                  [&](std::size_t i) { return areas[i] * std::sqrt(mean); });
}

// Of so many points along each index.
vtkNew<vtkStructuredGrid> structured(std::array<int, 3> size,
                                     const std::function<glm::dvec3(double, double, double)>& at) {
    vtkNew<vtkStructuredGrid> grid;
    const vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (int k = 0; k < size[2]; ++k)
        for (int j = 0; j < size[1]; ++j)
            for (int i = 0; i < size[0]; ++i) {
                const glm::dvec3 place = at(i, j, k);
                points->InsertNextPoint(&place.x);
            }
    grid->SetDimensions(size.data());
    grid->SetPoints(points);
    addValues(*grid);
    return grid;
}

double expectTrilinear(vtkStructuredGrid& grid) {
    const Path path = written<vtkXMLStructuredGridWriter>(grid, "structured.vts");
    return expectVolumes(path, std::size_t(grid.GetNumberOfCells()), [&](std::size_t i) {
        return std::abs(tests::trilinearVolume(cornersOf(grid, vtkIdType(i))));
    });
}

TEST(VtkVolumes, OfStructuredCellsAreTheirOwnAlsoAtTheEnds) {
    // Each layer along i half as thick again as the one before.
    const auto stretched = structured({9, 4, 5}, [](double i, double j, double k) {
        return kLean * glm::dvec3(2 * std::pow(1.5, i), j, k * k);
    });
    expectTrilinear(*stretched);
    double all = 0;
    for (vtkIdType i = 0; i < stretched->GetNumberOfCells(); ++i) all += volumeByVtk(*stretched, i);
    const double exact = glm::determinant(kLean) * 2 * (std::pow(1.5, 8) - 1) * 3 * 16;
    EXPECT_NEAR(all, exact, kError * exact);
}

// They fill a box of 16 x 3 x 5.
glm::dvec3 bentInABox(double i, double j, double k) {
    const glm::dvec3 at = tests::bent(i, j, k);
    return {at.x * at.x, at.y, at.z};
}

TEST(VtkVolumes, OfStructuredCellsWithBentFacesFillWhatTheyAreIn) {
    const auto grid = structured({5, 4, 6}, bentInABox);
    EXPECT_NEAR(expectTrilinear(*grid), 16 * 3 * 5, 240 * kError);
    const auto reversed = structured({5, 4, 6}, [](double i, double j, double k) {
        return glm::dvec3(-1, 1, 1) * bentInABox(i, j, k);
    });
    EXPECT_NEAR(expectTrilinear(*reversed), 16 * 3 * 5, 240 * kError);
    // One layer, as thick as it is.
    const auto layer = structured({5, 4, 2}, [](double i, double j, double k) {
        return glm::dvec3(i, j + 0.1 * i * k, 7 * k);
    });
    EXPECT_NEAR(expectTrilinear(*layer), 4 * 3 * 7, 84 * kError);
}

// A sheet takes what surfaces take.
TEST(VtkVolumes, OfASheetAreAsThickAsItsCellsAreWide) {
    const auto sheet =
        structured({4, 6, 1}, [](double i, double j, double) { return glm::dvec3(i * i, j, 2); });
    const double mean = 9.0 / 3;
    expectVolumes(written<vtkXMLStructuredGridWriter>(*sheet, "sheet.vts"), 15,
                  [&](std::size_t n) { return double(2 * (n % 3) + 1) * std::sqrt(mean); });
}

// A curved one's cells are no parallelograms: their areas are those that their middle lines span.
TEST(VtkVolumes, OfACurvedSheetAreItsCellsAreas) {
    const auto place = [](double i, double j, double) {
        return glm::dvec3(i + 0.2 * std::sin(1.1 * j + 0.3 * i), j + 0.15 * std::cos(0.8 * i),
                          std::sin(0.9 * i) * std::cos(0.7 * j + 0.2 * i));
    };
    constexpr int kCells = 30;
    const auto sheet = structured({kCells + 1, kCells + 1, 1}, place);
    std::vector<double> areas;
    double sum = 0;
    for (int j = 0; j < kCells; ++j)
        for (int i = 0; i < kCells; ++i) {
            const auto middle = [&](double x, double y, double to, double up) {
                return 0.5 * (place(x, y, 0) + place(to, up, 0));
            };
            areas.push_back(
                glm::length(glm::cross(middle(i + 1, j, i + 1, j + 1) - middle(i, j, i, j + 1),
                                       middle(i, j + 1, i + 1, j + 1) - middle(i, j, i + 1, j))));
            sum += areas.back();
        }
    const double thick = std::sqrt(sum / double(areas.size()));
    expectVolumes(written<vtkXMLStructuredGridWriter>(*sheet, "sheet.vts"), areas.size(),
                  [&](std::size_t n) { return areas[n] * thick; });
}

// The cells of a file as VTK has them, with values of our own.
template <class Reader, class Grid>
vtkNew<Grid> cellsOf(const Path& path) {
    const vtkNew<Reader> vtk;
    vtk->SetFileName(path.c_str());
    vtk->Update();
    vtkNew<Grid> grid;
    grid->CopyStructure(vtk->GetOutput());
    addValues(*grid);
    return grid;
}

// The fin's cells at its tip have no volume.
TEST(VtkVolumes, OfABluntFin) {
    const Path path = tests::sharedData("bluntfin/bluntfin.vts");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no real data at " << path;
    expectTrilinear(*cellsOf<vtkXMLStructuredGridReader, vtkStructuredGrid>(path));
}

// Crushed hexahedra with bent faces: VTK's two cuttings of these differ by 6 %.
TEST(VtkVolumes, OfACrushedCan) {
    const Path path = tests::sharedData("can.vtu");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no real data at " << path;
    const auto grid = cellsOf<vtkXMLUnstructuredGridReader, vtkUnstructuredGrid>(path);
    expectVolumes(written<vtkXMLUnstructuredGridWriter>(*grid, "can.vtu"), 4800,
                  [&](std::size_t i) {
                      return std::abs(tests::trilinearVolume(cornersOf(*grid, vtkIdType(i))));
                  });
}

// Hexahedra and polyhedra.
TEST(VtkVolumes, OfABreakingDam) {
    const Path path = tests::sharedData("dambreak_amr/dambreak_010.vtu");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no real data at " << path;
    const auto grid = cellsOf<vtkXMLUnstructuredGridReader, vtkUnstructuredGrid>(path);
    expectVolumes(path, std::size_t(grid->GetNumberOfCells()),
                  [&](std::size_t i) { return volumeByVtk(*grid, vtkIdType(i)); });
}

}  // namespace
}  // namespace timeseries::vtk_volumes
