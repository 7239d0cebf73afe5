// Memory while NetCDF and NRRD files are read.
#include <fmt/format.h>

#include <array>

#include "tests/support/array_builder.h"
#include "tests/support/netcdf_builder.h"
#include "tests/support/reading_memory.h"

namespace timeseries {
namespace {

using namespace tests;

// The axes in their order in the file, slowest first; t is time, of three steps.
std::filesystem::path netcdf(int mode, nc_type type, const std::string& axes,
                             const std::function<void(NetcdfBuilder&, int)>& declare) {
    NetcdfBuilder file("file.nc", mode);
    std::vector<int> dimensions;
    std::vector<std::size_t> last;
    for (const char axis : axes) {
        last.push_back((axis == 't' ? 3 : kSide) - 1);
        const auto coordinate = file.coordinate(std::string(1, axis), last.back() + 1, "");
        const char letter = static_cast<char>(axis - 'a' + 'A');
        file.text(coordinate.variable, "axis", std::string(1, letter));
        dimensions.push_back(coordinate.dimension);
    }
    const int v = file.variable("v", type, dimensions);
    declare(file, v);
    // Only the last value is written: what stands before it takes no room on the disk.
    NetcdfBuilder::check(nc_set_fill(file.id(), NC_NOFILL, nullptr));
    file.write(v, last, std::vector<std::size_t>(4, 1), std::vector<double>{0});
    return file.close();
}

constexpr StepBytes kFloat{4 * kPoints, 4 * kPoints};

TEST(ReadingMemory, OfNetcdfIsTwiceAStepAtMost) {
    const auto nothing = [](NetcdfBuilder&, int) {};
    const auto chunked = [](NetcdfBuilder& file, int v) {
        const std::array<std::size_t, 4> chunk{1, kSide / 2, kSide, kSide};
        NetcdfBuilder::check(nc_def_var_chunking(file.id(), v, NC_CHUNKED, chunk.data()));
    };
    const auto packed = [](NetcdfBuilder& file, int v) { file.number(v, "scale_factor", 0.5); };
    const auto missing = [](NetcdfBuilder& file, int v) { file.number(v, "missing_value", 0.0f); };
    expectTwiceAtMost(netcdf(NC_64BIT_OFFSET, NC_FLOAT, "tzyx", nothing), kFloat);
    expectTwiceAtMost(netcdf(NC_64BIT_OFFSET, NC_FLOAT, "xtyz", missing), kFloat);
    expectTwiceAtMost(netcdf(NC_NETCDF4, NC_FLOAT, "tzyx", chunked), kFloat);
    expectTwiceAtMost(netcdf(NC_NETCDF4, NC_SHORT, "tzyx", packed), {2 * kPoints, 8 * kPoints});
}

TEST(ReadingMemory, OfNrrdIsTwiceAStepAtMost) {
    const std::string xyz = fmt::format("{0} {0} {0}", kSide);
    for (const auto& [axes, steps] :
         {std::pair{"dimension: 3\nsizes: " + xyz + "\n", 1u},
          std::pair{"dimension: 3\nspace dimension: 3\nsizes: " + xyz +
                        "\nspace directions: (0,0,1) (0,1,0) (1,0,0)\n",
                    1u},
          std::pair{"dimension: 4\nkinds: space space space time\nsizes: " + xyz + " 3\n", 3u},
          std::pair{"dimension: 4\nkinds: time space space space\nsizes: 3 " + xyz + "\n", 3u}}) {
        const auto path = testFolder() / "file.nrrd";
        writeHollow(path, nrrd("type: float\nendian: big\nencoding: raw\n" + axes, ""),
                    steps * kFloat.stored);
        expectTwiceAtMost(path, kFloat);
    }
}

TEST(ReadingMemory, OfAnEighthIsTwiceAnEighthAtMost) {
    const auto packed = [](NetcdfBuilder& file, int v) { file.number(v, "scale_factor", 0.5); };
    expectTwiceAtMost(netcdf(NC_64BIT_OFFSET, NC_FLOAT, "tzyx", [](NetcdfBuilder&, int) {}), kFloat,
                      0, true);
    expectTwiceAtMost(netcdf(NC_NETCDF4, NC_SHORT, "tzyx", packed), {2 * kPoints, 8 * kPoints}, 0,
                      true);
    const auto path = testFolder() / "file.nrrd";
    writeHollow(
        path,
        nrrd(fmt::format("type: float\nendian: big\nencoding: raw\ndimension: 4\nkinds: space "
                         "space space time\nsizes: {0} {0} {0} 3\n",
                         kSide),
             ""),
        3 * kFloat.stored);
    expectTwiceAtMost(path, kFloat, 0, true);
}

}  // namespace
}  // namespace timeseries
