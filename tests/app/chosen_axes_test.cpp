#include "app/files/chosen_axes.h"

#include <gtest/gtest.h>

#include "render/points/placed_points.h"
#include "tests/support/netcdf_builder.h"
#include "tests/support/scripted_reader.h"

namespace app {
namespace {

OpenDataset scripted() {
    return tests::scriptedDataset({}, std::make_shared<tests::Script>(), "a", "");
}

TEST(ChosenAxes, NoneLeaveTheDatasetAlone) {
    OpenDataset dataset = scripted();
    const auto* const reader = dataset.reader.get();
    chooseAxes(dataset, {});
    EXPECT_EQ(dataset.reader.get(), reader);
}

TEST(ChosenAxes, AreThoseOfEveryVariableAndStepWithTheFilesCoordinates) {
    const OpenDataset file = scripted();
    OpenDataset dataset = scripted();
    const std::string format = dataset.reader->format();
    std::array<AxisChoice, 3> axes;
    axes[1].name = "latitude";
    axes[2] = {true, "depth"};
    chooseAxes(dataset, axes);
    EXPECT_EQ(dataset.reader->format(), format);
    const auto variables = file.reader->variables();
    ASSERT_EQ(dataset.variables.size(), variables.size());
    ASSERT_GE(variables.size(), 2u);
    for (std::size_t v = 0; v < variables.size(); ++v) {
        const auto& before = variables[v].grid->axes();
        const auto& after = dataset.variables[v].grid->axes();
        for (std::size_t a = 0; a < 3; ++a) {
            EXPECT_EQ(after[a].coordinates, before[a].coordinates);
            EXPECT_EQ(after[a].units, before[a].units);
            EXPECT_EQ(after[a].down, before[a].down != axes[a].flip);
            EXPECT_EQ(after[a].name, axes[a].name.empty() ? before[a].name : axes[a].name);
        }
    }
    EXPECT_EQ(dataset.variable.grid, dataset.variables[dataset.variableIndex].grid);
    const auto field = dataset.reader->read(dataset.variableIndex, 0);
    EXPECT_EQ(*field.grid, *dataset.variable.grid);
    EXPECT_EQ(field.values, file.reader->read(file.variableIndex, 0).values);
    EXPECT_EQ(dataset.reader->read(dataset.variableIndex, 1).grid, field.grid)
        << "shared as before";
    // Drawn the other way round: a point and its mirror image change places.
    const render::PlacedPoints one(*file.variable.grid), other(*dataset.variable.grid);
    for (std::uint64_t i = 0; i < file.variable.grid->count(); ++i) {
        const glm::dvec3 p = one.position(i), q = other.position(i);
        EXPECT_EQ(q, glm::dvec3(p.x, p.y, -p.z));
        EXPECT_EQ(dataset.variable.grid->position(i), file.variable.grid->position(i));
    }
}

// The names and ways are those of space; where each point lies is the file's.
TEST(ChosenAxes, LeaveAMeshWhereItIs) {
    tests::NetcdfBuilder file("a.nc");
    const int j = file.dimension("j", 2), i = file.dimension("i", 3);
    const int lon = file.variable("lon", NC_DOUBLE, {j, i}),
              lat = file.variable("lat", NC_DOUBLE, {j, i});
    file.text(lon, "units", "degrees_east");
    file.text(lat, "units", "degrees_north");
    file.variable("v", NC_FLOAT, {j, i});
    file.write(lon, std::vector<double>{0, 1, 2, 0.5, 1.5, 2.5});
    file.write(lat, std::vector<double>{5, 5, 5.25, 6, 6, 6});
    const std::filesystem::path path = file.close();
    const OpenDataset before = openDataset(std::span(&path, 1), "");
    OpenDataset dataset = openDataset(std::span(&path, 1), "");
    ASSERT_TRUE(before.variable.grid->mesh());
    std::array<AxisChoice, 3> axes;
    axes[0] = {true, "Longitude"};
    chooseAxes(dataset, axes);
    EXPECT_EQ(dataset.variable.grid->axes()[0].name, "Longitude");
    EXPECT_TRUE(dataset.variable.grid->axes()[0].down);
    EXPECT_EQ(*dataset.variable.grid->mesh(), *before.variable.grid->mesh());
    EXPECT_EQ(dataset.reader->read(0, 0).grid, dataset.variable.grid);
}

}  // namespace
}  // namespace app
