// Heights that a file gives by a formula: CF 1.10, appendix D.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <tuple>

#include "tests/support/netcdf_axes.h"

namespace timeseries::netcdf_heights {
namespace {

using namespace netcdf_axes;

constexpr std::size_t kTimes = 2, kLevels = 3, kRows = 4, kColumns = 5;

// What a term is at a place, and of which dimensions: "z", "yx", "tyx", "".
struct Term {
    std::string name, dimensions, units;
    std::function<double(std::size_t t, std::size_t k, std::size_t j, std::size_t i)> at;
};

struct Levels {
    std::string standardName, formulaTerms;
    std::vector<Term> terms;
    bool curvilinear = false;
    std::map<std::string, std::string> attributes = {};  // more of the levels'
};

double level(std::size_t k) { return 0.25 + 0.25 * static_cast<double>(k); }

std::filesystem::path written(const Levels& how) {
    NetcdfBuilder file("heights.nc");
    const auto time = file.coordinate("time", kTimes, "days since 2000-01-01");
    const int z = file.dimension("lev", kLevels), y = file.dimension("lat", kRows),
              x = file.dimension("lon", kColumns);
    const int lev = file.variable("lev", NC_DOUBLE, {z});
    if (!how.standardName.empty()) file.text(lev, "standard_name", how.standardName);
    if (!how.formulaTerms.empty()) file.text(lev, "formula_terms", how.formulaTerms);
    for (const auto& [name, text] : how.attributes) file.text(lev, name.c_str(), text);
    file.text(lev, "units", "1");
    file.text(lev, "positive", "up");
    const std::vector<int> along = how.curvilinear ? std::vector<int>{y, x} : std::vector<int>{};
    const int lat = file.variable(how.curvilinear ? "nav_lat" : "lat", NC_DOUBLE,
                                  how.curvilinear ? along : std::vector<int>{y}),
              lon = file.variable(how.curvilinear ? "nav_lon" : "lon", NC_DOUBLE,
                                  how.curvilinear ? along : std::vector<int>{x});
    file.text(lat, "units", "degrees_north");
    file.text(lon, "units", "degrees_east");
    const int t = file.variable("T", NC_FLOAT, {time.dimension, z, y, x});
    if (how.curvilinear) file.text(t, "coordinates", "nav_lat nav_lon");
    std::vector<int> terms;
    for (const Term& term : how.terms) {
        std::vector<int> dimensions;
        for (const char c : term.dimensions)
            dimensions.push_back(c == 't' ? time.dimension : c == 'z' ? z : c == 'y' ? y : x);
        terms.push_back(file.variable(term.name, NC_DOUBLE, dimensions));
        if (!term.units.empty()) file.text(terms.back(), "units", term.units);
        file.number(terms.back(), "_FillValue", -999.0);
    }
    file.write(time.variable, std::vector<double>{0, 1});
    file.write(lev, std::vector<double>{level(0), level(1), level(2)});
    const auto places = [&](std::size_t rows, std::size_t columns, bool across) {
        std::vector<double> all;
        for (std::size_t j = 0; j < rows; ++j)
            for (std::size_t i = 0; i < columns; ++i)
                all.push_back(static_cast<double>(across ? i : j));
        return all;
    };
    file.write(lat, places(kRows, how.curvilinear ? kColumns : 1, false));
    file.write(lon, places(how.curvilinear ? kRows : 1, kColumns, true));
    file.write(t, std::vector<float>(kTimes * kLevels * kRows * kColumns, 7));
    for (std::size_t n = 0; n < terms.size(); ++n) {
        const auto has = [&](char c) {
            return how.terms[n].dimensions.find(c) != std::string::npos;
        };
        std::vector<double> values;
        for (std::size_t s = 0; s < (has('t') ? kTimes : 1); ++s)
            for (std::size_t k = 0; k < (has('z') ? kLevels : 1); ++k)
                for (std::size_t j = 0; j < (has('y') ? kRows : 1); ++j)
                    for (std::size_t i = 0; i < (has('x') ? kColumns : 1); ++i)
                        values.push_back(how.terms[n].at(s, k, j, i));
        file.write(terms[n], values);
    }
    return file.close();
}

auto ofLevel(double factor, double more = 0) {
    return [=](std::size_t, std::size_t k, std::size_t, std::size_t) {
        return more + factor * level(k);
    };
}
auto always(double value) {
    return [=](std::size_t, std::size_t, std::size_t, std::size_t) { return value; };
}
// Another one in every column, and at every time.
double surface(double base, std::size_t t, std::size_t j, std::size_t i) {
    return base * (1 + 0.01 * static_cast<double>(i) + 0.03 * static_cast<double>(j) +
                   0.1 * static_cast<double>(t));
}
auto ofColumn(double base) {
    return [=](std::size_t t, std::size_t, std::size_t j, std::size_t i) {
        return surface(base, t, j, i);
    };
}

struct Formula {
    std::string name;
    Levels levels;
    std::string axis, units;
    std::function<double(std::size_t t, double s, std::size_t j, std::size_t i)> height;
};

// Those of appendix D, written out by hand.
std::vector<Formula> formulas() {
    const auto depth = [](std::size_t j, std::size_t i) { return surface(4000, 0, j, i); };
    const auto eta = [](std::size_t t, std::size_t j, std::size_t i) {
        return surface(2, t, j, i);
    };
    const std::vector<Term> ocean{{"zeta", "tyx", "m", ofColumn(2)},
                                  {"h", "yx", "m", ofColumn(4000)},
                                  {"hc", "", "m", always(50)},
                                  {"Cs", "z", "", ofLevel(0.5, -1)},
                                  {"s", "z", "", ofLevel(1, -1)}};
    const std::string oceanTerms = "s: s C: Cs eta: zeta depth: h depth_c: hc";
    return {
        {"hybrid pressure",
         {"atmosphere_hybrid_sigma_pressure_coordinate",
          "a: hyam b: hybm p0: P0 ps: PS",
          {{"hyam", "z", "", ofLevel(0.5)},
           {"hybm", "z", "", ofLevel(0.75)},
           {"P0", "", "hPa", always(1000)},
           {"PS", "tyx", "Pa", ofColumn(1e5)}}},
         "air pressure",
         "Pa",
         [](std::size_t t, double s, std::size_t j, std::size_t i) {
             return 0.5 * s * 1e5 + 0.75 * s * surface(1e5, t, j, i);
         }},
        {"its other form",
         {"atmosphere_hybrid_sigma_pressure_coordinate",
          "ap:ap b:b ps:PS",
          {{"ap", "z", "Pa", ofLevel(100)},
           {"b", "z", "1", ofLevel(0.75)},
           {"PS", "tyx", "Pa", ofColumn(1e5)}}},
         "air pressure",
         "Pa",
         [](std::size_t t, double s, std::size_t j, std::size_t i) {
             return 100 * s + 0.75 * s * surface(1e5, t, j, i);
         }},
        {"as CCM's files have it",
         {"",
          "",
          {{"hyam", "z", "", ofLevel(0.5)},
           {"hybm", "z", "", ofLevel(0.75)},
           {"P0", "", "hPa", always(900)},
           {"PS", "tyx", "Pa", ofColumn(1e5)}},
          false,
          {{"A_var", "hyam"}, {"B_var", "hybm"}, {"P0_var", "P0"}, {"PS_var", "PS"}}},
         "air pressure",
         "Pa",
         [](std::size_t t, double s, std::size_t j, std::size_t i) {
             return 0.5 * s * 9e4 + 0.75 * s * surface(1e5, t, j, i);
         }},
        {"sigma",
         {"atmosphere_sigma_coordinate",
          "sigma: lev ps: PS ptop: top",
          {{"PS", "tyx", "Pa", ofColumn(1e5)}, {"top", "", "Pa", always(2000)}}},
         "air pressure",
         "Pa",
         [](std::size_t t, double s, std::size_t j, std::size_t i) {
             return 2000 + s * (surface(1e5, t, j, i) - 2000);
         }},
        {"hybrid height",
         {"atmosphere_hybrid_height_coordinate",
          "a: height b: sigma orog: orog",
          {{"height", "z", "m", ofLevel(8000)},
           {"sigma", "z", "", ofLevel(-0.5, 1)},
           {"orog", "yx", "m", ofColumn(500)}}},
         "altitude",
         "m",
         [](std::size_t, double s, std::size_t j, std::size_t i) {
             return 8000 * s + (1 - 0.5 * s) * surface(500, 0, j, i);
         }},
        {"ocean sigma",
         {"ocean_sigma_coordinate", "sigma: s eta: zeta depth: h", ocean},
         "height",
         "m",
         [=](std::size_t t, double s, std::size_t j, std::size_t i) {
             return eta(t, j, i) + (s - 1) * (depth(j, i) + eta(t, j, i));
         }},
        {"ocean s, first",
         {"ocean_s_coordinate_g1", oceanTerms, ocean},
         "height",
         "m",
         [=](std::size_t t, double s, std::size_t j, std::size_t i) {
             const double still = 50 * (s - 1) + (depth(j, i) - 50) * (0.5 * s - 1);
             return still + eta(t, j, i) * (1 + still / depth(j, i));
         }},
        {"ocean s, second",
         {"ocean_s_coordinate_g2", oceanTerms, ocean},
         "height",
         "m",
         [=](std::size_t t, double s, std::size_t j, std::size_t i) {
             const double still = (50 * (s - 1) + depth(j, i) * (0.5 * s - 1)) / (50 + depth(j, i));
             return eta(t, j, i) + (eta(t, j, i) + depth(j, i)) * still;
         }},
        {"ocean s",
         {"ocean_s_coordinate",
          "s: s eta: zeta depth: h a: a b: b depth_c: hc",
          {ocean[0],
           ocean[1],
           ocean[2],
           ocean[4],
           {"a", "", "", always(3)},
           {"b", "", "", always(0.4)}}},
         "height",
         "m",
         [=](std::size_t t, double l, std::size_t j, std::size_t i) {
             const double s = l - 1;
             const double c = 0.6 * std::sinh(3 * s) / std::sinh(3.0) +
                              0.4 * (std::tanh(3 * (s + 0.5)) / (2 * std::tanh(1.5)) - 0.5);
             return eta(t, j, i) * (1 + s) + 50 * s + (depth(j, i) - 50) * c;
         }},
    };
}

TEST(NetcdfHeights, AreThoseOfTheFormulaInEveryColumnAndStep) {
    for (const Formula& formula : formulas())
        for (const bool curvilinear : {false, true}) {
            Levels levels = formula.levels;
            levels.curvilinear = curvilinear;
            const auto reader = open(written(levels));
            const std::size_t v = tests::indexOf(*reader, "T");
            const Axis& z = reader->variables()[v].grid->axes()[2];
            EXPECT_EQ(z.name, formula.axis) << formula.name;
            EXPECT_EQ(z.units, formula.units) << formula.name;
            EXPECT_EQ(z.down, formula.units == "Pa") << formula.name;
            for (std::size_t t = 0; t < kTimes; ++t) {
                const Field field = reader->read(v, t);
                ASSERT_EQ(field.grid->count(), kLevels * kRows * kColumns) << formula.name;
                for (std::size_t k = 0; k < kLevels; ++k)
                    for (std::size_t j = 0; j < kRows; ++j)
                        for (std::size_t i = 0; i < kColumns; ++i) {
                            const glm::dvec3 at =
                                field.grid->position(i + kColumns * (j + kRows * k));
                            const double expected = formula.height(t, level(k), j, i);
                            EXPECT_NEAR(at.x, double(i), 1e-5) << formula.name;
                            EXPECT_NEAR(at.y, double(j), 1e-5) << formula.name;
                            EXPECT_NEAR(at.z, expected,
                                        1e-6 * std::abs(z.coordinates.back()) + 1e-3)
                                << formula.name << " t " << t << " k " << k;
                        }
            }
        }
}

// WRF's: the geopotential stands on the levels of W, between which are those of T; and U stands
// between the columns of both.
TEST(NetcdfHeights, OfWrfAreItsGeopotentialWhereEachVariableStands) {
    NetcdfBuilder file("wrfout.nc");
    const int t = file.dimension("Time", 2), z = file.dimension("bottom_top", 3),
              zs = file.dimension("bottom_top_stag", 4), y = file.dimension("south_north", 4),
              x = file.dimension("west_east", 5), xs = file.dimension("west_east_stag", 6);
    const auto coordinates = [&](const std::string& name, int along, std::size_t columns) {
        const int lat = file.variable("XLAT" + name, NC_FLOAT, {t, y, along}),
                  lon = file.variable("XLONG" + name, NC_FLOAT, {t, y, along});
        file.text(lat, "units", "degree_north");
        file.text(lon, "units", "degree_east");
        return [=, &file] {
            std::vector<float> lats, lons;
            for (std::size_t n = 0; n < 2 * 4 * columns; ++n) {
                lats.push_back(static_cast<float>(n / columns % 4));
                lons.push_back(static_cast<float>(n % columns) - (columns == 6 ? 0.5f : 0.0f));
            }
            file.write(lat, lats);
            file.write(lon, lons);
        };
    };
    const auto mass = coordinates("", x, 5), wind = coordinates("_U", xs, 6);
    const int ph = file.variable("PH", NC_DOUBLE, {t, zs, y, x}),
              phb = file.variable("PHB", NC_DOUBLE, {t, zs, y, x});
    const auto field = [&](const char* name, std::vector<int> dimensions, const char* of) {
        file.text(file.variable(name, NC_FLOAT, dimensions), "coordinates", of);
    };
    field("T", {t, z, y, x}, "XLONG XLAT");
    field("W", {t, zs, y, x}, "XLONG XLAT");
    field("U", {t, z, y, xs}, "XLONG_U XLAT_U");
    mass();
    wind();
    constexpr double kGravity = 9.81;
    const auto between = [](double s, double k, double j, double i) {
        return 1000 * s + 300 * k + 10 * j + i;
    };
    std::vector<double> moved, base;
    for (int n = 0; n < 2 * 4 * 4 * 5; ++n) {
        moved.push_back(kGravity * between(n / 80, 0, n / 5 % 4, n % 5));
        base.push_back(kGravity * between(0, n / 20 % 4, 0, 0));
    }
    file.write(ph, moved);
    file.write(phb, base);
    const auto reader = open(file.close());
    for (const auto& [name, size, down, left] : {std::tuple{"T", glm::ivec3(5, 4, 3), 0.5, 0.0},
                                                 {"W", glm::ivec3(5, 4, 4), 0.0, 0.0},
                                                 {"U", glm::ivec3(6, 4, 3), 0.5, 0.5}})
        for (std::size_t s = 0; s < 2; ++s) {
            const Field values = reader->read(tests::indexOf(*reader, name), s);
            EXPECT_EQ(values.grid->axes()[2].name, "height") << name;
            EXPECT_EQ(values.grid->axes()[2].units, "m") << name;
            EXPECT_THAT(reader->variables()[tests::indexOf(*reader, name)].notes,
                        testing::IsEmpty());
            ASSERT_EQ(values.grid->count(), std::uint64_t(size.x * size.y * size.z)) << name;
            for (int n = 0; n < size.x * size.y * size.z; ++n) {
                const int i = n % size.x, j = n / size.x % size.y, k = n / size.x / size.y;
                const double column = std::clamp(i - left, 0.0, 4.0);
                EXPECT_NEAR(values.grid->position(std::uint64_t(n)).z,
                            between(double(s), k + down, j, column), 1e-2)
                    << name << ' ' << n;
            }
        }
}

// Land, for one.
TEST(NetcdfHeights, ColumnsWithoutATermHaveNoPlace) {
    Formula formula = formulas()[5];
    formula.levels.terms[1].at = [](std::size_t, std::size_t, std::size_t j, std::size_t i) {
        return i == 2 && j == 1 ? -999.0 : surface(4000, 0, j, i);
    };
    const auto reader = open(written(formula.levels));
    const Variable& variable = reader->variables()[tests::indexOf(*reader, "T")];
    EXPECT_EQ(variable.grid->mesh()->absent(), kLevels);
    EXPECT_FALSE(std::isfinite(variable.grid->position(2 + kColumns).z));
    EXPECT_TRUE(std::isfinite(variable.grid->position(3 + kColumns).z));
}

// CCM's levels are 1000 (A + B).
TEST(NetcdfHeights, AReferencePressureThatIsNamedAndNotThereIsThousandHectopascals) {
    const Levels levels{"",
                        "",
                        {{"hyam", "z", "", ofLevel(0.5)},
                         {"hybm", "z", "", ofLevel(0.75)},
                         {"PS", "tyx", "hPa", ofColumn(1000)}},
                        false,
                        {{"A_var", "hyam"}, {"B_var", "hybm"}, {"P0_var", "P0"}, {"PS_var", "PS"}}};
    const auto reader = open(written(levels));
    const std::size_t t = tests::indexOf(*reader, "T");
    const Field values = reader->read(t, 1);
    EXPECT_EQ(values.grid->axes()[2].units, "hPa");
    for (std::size_t k = 0; k < kLevels; ++k)
        EXPECT_NEAR(values.grid->position(3 + kColumns * (2 + kRows * k)).z,
                    0.5 * level(k) * 1000 + 0.75 * level(k) * surface(1000, 1, 2, 3), 1e-3);
    EXPECT_THAT(reader->variables()[t].notes,
                testing::ElementsAre(testing::HasSubstr("a reference pressure of 1000 hPa")));
}

// Nor is it guessed of what is in no unit of pressure.
TEST(NetcdfHeights, AReferencePressureIsNotGuessedBesideNumbersWithoutUnits) {
    for (const char* units : {"", "m"}) {
        const Levels levels{
            "",
            "",
            {{"hyam", "z", "", ofLevel(0.5)},
             {"hybm", "z", "", ofLevel(0.75)},
             {"PS", "tyx", units, ofColumn(1000)}},
            false,
            {{"A_var", "hyam"}, {"B_var", "hybm"}, {"P0_var", "P0"}, {"PS_var", "PS"}}};
        const auto reader = open(written(levels));
        EXPECT_EQ(reader->variables()[tests::indexOf(*reader, "T")].grid->mesh(), nullptr);
    }
}

// Terms that are not there, of other dimensions, or that give one height for all.
TEST(NetcdfHeights, WithoutAFormulaThatHoldsLevelsAreUsedAsTheyAre) {
    const auto notesOf = [](const Levels& levels) {
        const auto reader = open(written(levels));
        const Variable& variable = reader->variables()[tests::indexOf(*reader, "T")];
        EXPECT_EQ(variable.grid->mesh(), nullptr);
        EXPECT_EQ(variable.grid->position(kColumns * kRows).z, level(1));
        std::string all;
        for (const std::string& note : variable.notes) all += note + '\n';
        return all;
    };
    const Levels good = formulas()[0].levels;
    Levels bad = good;
    bad.formulaTerms = "a: hyam b: hybm p0: P0 ps: NOT_THERE";
    EXPECT_THAT(notesOf(bad), testing::HasSubstr("lev is a level, not a height: used as it is"));
    bad.formulaTerms = "a: hyam b: hybm p0: P0";
    EXPECT_THAT(notesOf(bad), testing::HasSubstr("lev is a level, not a height: used as it is"));
    bad = good;
    bad.standardName = "atmosphere_sleve_coordinate";
    EXPECT_THAT(notesOf(bad), testing::HasSubstr("lev is a level, not a height: used as it is"));
    bad = good;
    bad.terms[3].at = always(std::numeric_limits<double>::quiet_NaN());
    EXPECT_THAT(notesOf(bad), testing::HasSubstr("drawn by levels: of the air pressure that a "
                                                 "formula gives, "));
}

}  // namespace
}  // namespace timeseries::netcdf_heights
