// A slab is the part of read() that it names, whatever the format and however the values lie.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "tests/support/array_builder.h"
#include "tests/support/files.h"
#include "tests/support/netcdf_builder.h"
#include "tests/support/random_field.h"
#include "tests/support/step_bytes.h"
#include "timeseries/readers/reader.h"
#include "timeseries/readers/step_about.h"

namespace timeseries {
namespace {

namespace fs = std::filesystem;

// Every slab of every step along every axis.
void expectParts(const std::vector<fs::path>& paths) {
    const auto reader = openReader(paths);
    for (std::size_t v = 0; v < reader->variables().size(); ++v)
        for (std::size_t s = 0; s < reader->variables()[v].time->points.size(); ++s) {
            const Field whole = reader->read(v, s);
            const auto size = whole.grid->size();
            for (std::size_t axis = 0; axis < 3; ++axis)
                for (std::uint64_t first = 0; first < size[axis]; ++first)
                    for (std::uint64_t count = 1; first + count <= size[axis]; ++count) {
                        SCOPED_TRACE(testing::Message()
                                     << reader->variables()[v].name << ", step " << s << ", axis "
                                     << axis << ": " << first << " + " << count);
                        const Field part = reader->slab(v, s, {axis, first, count});
                        ASSERT_EQ(part.type(), whole.type());
                        std::visit(
                            [&]<typename T>(const std::vector<T>& values) {
                                const auto& all = std::get<std::vector<T>>(whole.values);
                                std::size_t next = 0;
                                for (std::size_t i = 0; i < all.size(); ++i) {
                                    const auto place = whole.grid->indices(i);
                                    const auto along = place[static_cast<int>(axis)];
                                    if (along < first || along >= first + count) continue;
                                    ASSERT_LT(next, values.size());
                                    // Of NaN too.
                                    ASSERT_EQ(std::memcmp(&values[next], &all[i], sizeof(T)), 0);
                                    ASSERT_EQ(!part.missing.empty() && part.missing[next],
                                              !whole.missing.empty() && whole.missing[i]);
                                    ++next;
                                }
                                ASSERT_EQ(next, values.size());
                            },
                            part.values);
                    }
        }
}

std::vector<std::int16_t> numbers(std::size_t n) {
    std::vector<std::int16_t> values(n);
    std::iota(values.begin(), values.end(), std::int16_t{-50});
    return values;
}

TEST(ReadSlab, OfNetcdf) {
    tests::NetcdfBuilder file("slabs.nc");
    const int t = file.dimension("time", 2), z = file.dimension("lev", 4),
              y = file.dimension("lat", 3), x = file.dimension("lon", 5);
    const int plain = file.variable("plain", NC_SHORT, {t, z, y, x});
    const int turned = file.variable("turned", NC_SHORT, {x, z, t, y});
    const int flat = file.variable("flat", NC_SHORT, {t, y, x});
    const int packed = file.variable("packed", NC_SHORT, {z, y, x});
    file.number(packed, "scale_factor", 0.5);
    file.number(packed, "_FillValue", std::int16_t{-45});
    file.number(plain, "missing_value", std::int16_t{-40});
    file.write(plain, numbers(120));
    file.write(turned, numbers(120));
    file.write(flat, numbers(30));
    file.write(packed, numbers(60));
    expectParts({file.close()});
}

TEST(ReadSlab, OfNrrd) {
    const std::string head = "type: short\ndimension: 4\nsizes: 5 4 3 2\nendian: little\n";
    const std::string bytes = tests::bytesOf(numbers(120));
    for (const std::string encoding : {"raw", "gzip"})
        for (const std::string kinds : {"domain domain domain time", "time domain domain domain",
                                        "domain time domain domain"}) {
            const fs::path path = tests::testFolder() / "slabs.nrrd";
            tests::writeBytes(
                path, tests::nrrd(head + "encoding: " + encoding + "\nkinds: " + kinds + "\n",
                                  tests::encoded(encoding, bytes)));
            expectParts({path});
        }
}

TEST(ReadSlab, OfPlanesIsNoMoreWorkThanOfAllWhereTheyLieOneAfterAnother) {
    const auto readsPlanes = [](const fs::path& path, const std::string& name = "") {
        const auto reader = openReader(std::span(&path, 1));
        const auto all = reader->variables();
        const auto found = std::ranges::find(all, name, &Variable::name);
        return reader->readsPlanes(name.empty() ? 0 : static_cast<std::size_t>(found - all.begin()),
                                   1);
    };
    const std::string head = "type: short\ndimension: 4\nsizes: 5 4 3 2\nendian: little\n",
                      bytes = tests::bytesOf(numbers(120));
    const auto nrrd = [&](const std::string& encoding, const std::string& kinds) {
        const fs::path path = tests::freshFolder() / "planes.nrrd";
        tests::writeBytes(path,
                          tests::nrrd(head + "encoding: " + encoding + "\nkinds: " + kinds + "\n",
                                      tests::encoded(encoding, bytes)));
        return path;
    };
    EXPECT_TRUE(readsPlanes(nrrd("raw", "domain domain domain time")));
    EXPECT_FALSE(readsPlanes(nrrd("gzip", "domain domain domain time")));
    EXPECT_FALSE(readsPlanes(nrrd("raw", "domain domain time domain")));
    tests::NetcdfBuilder file("planes.nc", NC_NETCDF4);
    const int t = file.dimension("time", 2), z = file.dimension("lev", 4),
              y = file.dimension("lat", 3), x = file.dimension("lon", 5);
    file.variable("plain", NC_SHORT, {t, z, y, x});
    file.variable("turned", NC_SHORT, {t, y, z, x});
    const std::array<std::size_t, 4> chunk{1, 2, 3, 5};
    tests::NetcdfBuilder::check(nc_def_var_chunking(
        file.id(), file.variable("chunked", NC_SHORT, {t, z, y, x}), NC_CHUNKED, chunk.data()));
    const fs::path path = file.close();
    EXPECT_TRUE(readsPlanes(path, "plain"));
    EXPECT_FALSE(readsPlanes(path, "turned"));
    EXPECT_FALSE(readsPlanes(path, "chunked"));
}

// Turned: not in the file's order.
TEST(ReadSlab, OfNrrdOfOtherDirections) {
    const fs::path path = tests::testFolder() / "turned.nrrd";
    tests::writeBytes(path, tests::nrrd("type: short\ndimension: 3\nsizes: 5 4 6\nendian: little\n"
                                        "space: RAS\nspace directions: (0,0,1) (1,0,0) (0,-1,0)\n"
                                        "encoding: raw\n",
                                        tests::bytesOf(numbers(120))));
    expectParts({path});
}

TEST(ReadSlab, OfSeriesAndOfSortedSteps) {
    std::vector<fs::path> nrrds, steps;
    std::mt19937_64 random(2);
    for (int i = 0; i < 3; ++i) {
        nrrds.push_back(tests::testFolder() / fmt::format("a{}.nrrd", i));
        tests::writeBytes(nrrds.back(),
                          tests::nrrd("type: short\ndimension: 3\nsizes: 5 4 6\nendian: little\n"
                                      "encoding: raw\n",
                                      tests::bytesOf(numbers(120 + static_cast<std::size_t>(i)))));
        steps.push_back(tests::testFolder() / fmt::format("b{}.isostep", i));
        StepAbout about;
        about.time = i;
        const auto bytes = tests::written(
            SortedStep::build(tests::randomField<std::int32_t>(random, {4, 5, 3}, 2)),
            textOf(about));
        tests::writeBytes(steps.back(),
                          std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    }
    expectParts(nrrds);
    expectParts(steps);
}

}  // namespace
}  // namespace timeseries
