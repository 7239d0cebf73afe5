#include "timeseries/readers/cf/cf_heights.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "timeseries/readers/cf/cf_mpas.h"
#include "timeseries/readers/text/units.h"

namespace timeseries {
namespace {

using Formula = HeightFormula::Kind;

struct Known {
    Formula kind;
    std::string_view standardName;
    // That make it this one, and the one whose units the heights have. Those beside these are 0
    // where they are not given, as the conventions have it.
    std::array<std::string_view, 4> terms;
    std::string_view measure;
    const char* name;
    bool down;
};
constexpr std::array kKnown{
    Known{Formula::HybridPressure,
          "atmosphere_hybrid_sigma_pressure_coordinate",
          {"b", "ps"},
          "ps",
          "air pressure",
          true},
    Known{
        Formula::Sigma, "atmosphere_sigma_coordinate", {"sigma", "ps"}, "ps", "air pressure", true},
    Known{Formula::HybridHeight,
          "atmosphere_hybrid_height_coordinate",
          {"a", "b", "orog"},
          "orog",
          "altitude",
          false},
    Known{Formula::OceanS2,
          "ocean_s_coordinate_g2",
          {"s", "C", "depth", "depth_c"},
          "depth",
          "height",
          false},
    Known{Formula::OceanS1,
          "ocean_s_coordinate_g1",
          {"s", "C", "depth", "depth_c"},
          "depth",
          "height",
          false},
    Known{
        Formula::OceanS, "ocean_s_coordinate", {"s", "a", "b", "depth"}, "depth", "height", false},
    Known{Formula::OceanSigma,
          "ocean_sigma_coordinate",
          {"sigma", "depth"},
          "depth",
          "height",
          false},
};

// "a: hyam b: hybm p0: P0 ps: PS", with or without blanks.
std::map<std::string, std::string> termsIn(std::string text) {
    for (std::size_t at = 0; (at = text.find(':', at)) != text.npos; at += 2)
        text.insert(at + 1, " ");
    std::map<std::string, std::string> terms;
    std::string key;
    for (const std::string& word : words(text)) {
        if (word.ends_with(':'))
            key = word.substr(0, word.size() - 1);
        else if (!key.empty())
            terms[key] = word;
    }
    return terms;
}

// As CCM's files have them, which are older than that attribute (NCL's names for it). By what
// their levels are, 1000 (A + B), the pressure that A is of is 1000 hPa.
constexpr const char* kOfCcm = "atmosphere_hybrid_sigma_pressure_coordinate";
std::map<std::string, std::string> termsOfCcm(const NcVariable& level) {
    std::map<std::string, std::string> terms;
    for (const auto& [term, attribute] :
         {std::pair{"a", "A_var"}, {"b", "B_var"}, {"p0", "P0_var"}, {"ps", "PS_var"}})
        if (std::string name = level.text(attribute); !name.empty()) terms[term] = std::move(name);
    return terms.size() == 4 ? terms : std::map<std::string, std::string>();
}

bool has(const NcVariable& variable, std::size_t dimension) {
    return std::ranges::find(variable.dimensions, dimension) != variable.dimensions.end();
}

// Of the coordinates of the levels, by the dimension or by the attribute `coordinates`; above
// places in a list each may have its own.
std::vector<const NcVariable*> levelsOf(const NcHeader& header, const NcVariable& variable,
                                        const Roles& roles) {
    const std::size_t dimension = variable.dimensions[*roles.z];
    std::vector<const NcVariable*> levels;
    const auto add = [&](const std::string& name) {
        const NcVariable* const level = header.find(name, variable.group);
        if (!level) return;
        const bool ofEach =
            roles.list && has(*level, dimension) && spansNoMore(header, *level, variable, roles);
        if (level->isAlong(dimension) || ofEach) levels.push_back(level);
    };
    add(header.dimensions[dimension].name);
    for (const std::string& name : words(variable.text("coordinates"))) add(name);
    return levels;
}

// Of each place and level, above places in a list.
std::optional<HeightFormula> givenHeightsOf(const NcHeader& header, const NcVariable& variable,
                                            const Roles& roles) {
    if (!roles.list) return std::nullopt;
    const auto heightsIn = [&](const std::string& name,
                               bool mustSay) -> std::optional<HeightFormula> {
        const NcVariable* const found = header.find(name, variable.group);
        if (!found || !has(*found, variable.dimensions[*roles.z]) ||
            !has(*found, variable.dimensions[*roles.list]) ||
            !spansNoMore(header, *found, variable, roles))
            return std::nullopt;
        const std::string units = found->text("units");
        const bool says = kindByAttributes(*found) == AxisKind::Z &&
                          (sameDimension(units, "m") || sameDimension(units, "Pa"));
        if (mustSay && !says) return std::nullopt;
        HeightFormula formula;
        formula.kind = Formula::Given;
        formula.terms["z"] = found->name;
        formula.name = found->baseName();
        formula.units = units.empty() ? "m" : units;  // as SCHISM's are
        formula.down = lower(found->text("positive")) == "down";
        formula.inTime = hasTime(*found, variable, roles);
        return formula;
    };
    for (const std::string& name : words(variable.text("coordinates")))
        if (auto given = heightsIn(name, true)) return given;
    return heightsIn("zcor", false);
}

// MPAS's, of its cells: of the levels between the variable's, or of these.
std::optional<HeightFormula> mpasHeightsOf(const NcHeader& header, const NcVariable& variable,
                                           const Roles& roles) {
    if (!roles.list || !isMpas(header) || header.dimension(variable, *roles.list).name != "nCells")
        return std::nullopt;
    for (const char* name : {"zgrid", "zMid"}) {
        const NcVariable* const found = header.find(name, variable.group);
        if (!found) continue;
        const bool isHere = has(*found, variable.dimensions[*roles.z]) &&
                            has(*found, variable.dimensions[*roles.list]) &&
                            spansNoMore(header, *found, variable, roles);
        if (!isHere && !rolesBeside(header, *found, variable, roles)) continue;
        HeightFormula formula;
        formula.kind = Formula::Given;
        formula.terms["z"] = found->name;
        formula.name = found->baseName();
        formula.units = found->text("units").empty() ? "m" : found->text("units");
        formula.inTime = hasTime(*found, variable, roles);
        return formula;
    }
    return std::nullopt;
}

std::optional<HeightFormula> formulaOf(const NcHeader& header, const NcVariable& variable,
                                       const Roles& roles, const NcVariable& level) {
    HeightFormula formula;
    formula.terms = termsIn(level.text("formula_terms"));
    std::string kind = level.text("standard_name");
    if (formula.terms.empty() && !(formula.terms = termsOfCcm(level)).empty()) {
        kind = kOfCcm;
        if (!header.find(formula.terms["p0"], level.group)) {
            formula.terms.erase("p0");
            formula.guessedPascals = 1e5;
        }
    }
    const auto known = std::ranges::find(kKnown, kind, &Known::standardName);
    if (known == kKnown.end()) return std::nullopt;
    for (const std::string_view term : known->terms)
        if (!term.empty() && !formula.terms.contains(std::string(term))) return std::nullopt;
    for (auto& [term, name] : formula.terms) {
        const NcVariable* const found = header.find(name, level.group);
        if (!found) return std::nullopt;
        if (!spansNoMore(header, *found, variable, roles)) {
            if (roles.list || !rolesBeside(header, *found, variable, roles)) return std::nullopt;
            formula.beside.push_back(found->name);
        }
        name = found->name;
        formula.inTime = formula.inTime || hasTime(*found, variable, roles);
        if (term == known->measure) formula.units = found->text("units");
    }
    if (formula.guessedPascals && !sameDimension(formula.units, "Pa")) return std::nullopt;
    formula.kind = known->kind;
    formula.name = known->name;
    formula.down = known->down;
    return formula;
}

// PH and PHB, on levels between those of most variables, and on columns between those of winds.
const Roles kGeopotentialRoles{.x = 3, .y = 2, .z = 1, .t = 0, .extra = {}, .list = {}};

std::optional<HeightFormula> wrfFormulaOf(const NcHeader& header, const NcVariable& variable,
                                          const Roles& roles) {
    const std::array names{"PH", "PHB"};
    HeightFormula formula;
    formula.kind = Formula::Wrf;
    formula.name = "height";
    formula.units = "m";
    for (const char* name : names) {
        const NcVariable* const part = header.find(name, variable.group);
        if (!part || !part->type || part->dimensions.size() != 4) return std::nullopt;
        formula.terms[name] = part->name;
        const std::array positions{roles.x, roles.y, roles.z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto without = [](std::string text) {
                constexpr std::string_view kBetween = "_stag";
                if (text.ends_with(kBetween)) text.resize(text.size() - kBetween.size());
                return text;
            };
            const NcDimension &own = header.dimension(variable, *positions[axis]),
                              &its = header.dimension(*part, 3 - axis);
            const bool isLevel = axis == 2;
            const bool fits = own.length == its.length || (isLevel ? own.length + 1 == its.length
                                                                   : own.length == its.length + 1);
            if (without(own.name) != without(its.name) || !fits) return std::nullopt;
        }
        formula.inTime = formula.inTime || roles.t;
    }
    return formula;
}

std::vector<double> wrfHeights(const CfFile& file, const HeightFormula& formula,
                               const std::array<std::size_t, 3>& size, std::size_t step) {
    constexpr double kGravity = 9.81;  // WRF's own (share/module_model_constants.F)
    std::vector<double> heights(size[0] * size[1] * size[2]);
    for (const char* name : {"PH", "PHB"}) {
        const NcVariable* const part = file.header().find(formula.terms.at(name), "");
        if (!part || part->dimensions.size() != 4)
            file.fail(name, "expected it as when the series was opened");
        const TermValues values = termBeside(file, *part, kGeopotentialRoles, size, step);
        for (std::size_t n = 0; n < heights.size(); ++n) heights[n] += values.values[n] / kGravity;
    }
    return heights;
}

// One term in the units of the heights; 0 where the formula has none of it.
struct Term {
    TermValues values;
    double factor = 0, otherwise = 0;
    double at(std::size_t i, std::size_t j, std::size_t k) const {
        return factor == 0 ? otherwise : factor * values.at(i, j, k);
    }
};

}  // namespace

std::optional<HeightFormula> heightFormulaOf(const NcHeader& header, const NcVariable& variable,
                                             const Roles& roles) {
    if (auto given = givenHeightsOf(header, variable, roles)) return given;
    if (auto ofMpas = mpasHeightsOf(header, variable, roles)) return ofMpas;
    for (const NcVariable* level : levelsOf(header, variable, roles))
        if (auto formula = formulaOf(header, variable, roles, *level)) return formula;
    return roles.y ? wrfFormulaOf(header, variable, roles) : std::nullopt;
}

std::string approximationIn(const HeightFormula& formula) {
    std::string told, terms;
    if (formula.guessedPascals)
        told = fmt::format(
            "its heights are by a reference pressure of {:g} hPa, which the file names but has not",
            *formula.guessedPascals / 100);
    for (const std::string& name : formula.beside) terms += (terms.empty() ? "" : " and ") + name;
    if (terms.empty()) return told;
    return told + (told.empty() ? "" : "; ") +
           fmt::format(
               "its heights are near what their formula says: of {}, which other columns have, it "
               "takes the mean of those beside each point",
               terms);
}

std::vector<double> heightsOf(const CfFile& file, const NcVariable& variable, const Roles& roles,
                              const HeightFormula& formula, std::size_t step) {
    const std::array size{
        file.header().dimension(variable, *roles.x).length,
        roles.y ? file.header().dimension(variable, *roles.y).length : std::size_t{1},
        file.header().dimension(variable, *roles.z).length};
    if (formula.kind == Formula::Wrf) return wrfHeights(file, formula, size, step);
    const auto term = [&](const char* name) {
        const auto found = formula.terms.find(name);
        if (found == formula.terms.end()) return Term{};
        const NcVariable* const from = file.header().find(found->second, "");
        const bool isHere = from && spansNoMore(file.header(), *from, variable, roles);
        const auto own =
            from && !isHere ? rolesBeside(file.header(), *from, variable, roles) : std::nullopt;
        if (!isHere && !own)
            file.fail("variable '" + variable.name + "'",
                      "expected the terms of its heights as when the series was opened");
        const auto ratio = unitRatio(from->text("units"), formula.units);
        return Term{isHere ? termOf(file, *from, variable, roles, step)
                           : termBeside(file, *from, *own, size, step),
                    ratio.value_or(1)};
    };
    std::vector<double> heights;
    heights.reserve(size[0] * size[1] * size[2]);
    const auto fill = [&](const auto& of) {
        for (std::size_t k = 0; k < size[2]; ++k)
            for (std::size_t j = 0; j < size[1]; ++j)
                for (std::size_t i = 0; i < size[0]; ++i)
                    heights.push_back(of([&](const Term& t) { return t.at(i, j, k); }));
    };
    switch (formula.kind) {
        case Formula::Wrf:
            break;
        case Formula::Given: {
            const Term z = term("z");
            fill([&](const auto& of) { return of(z); });
            break;
        }
        case Formula::HybridPressure: {
            const Term ap = term("ap"), a = term("a"), b = term("b"), ps = term("ps");
            Term p0 = term("p0");
            p0.otherwise =
                formula.guessedPascals.value_or(0) * unitRatio("Pa", formula.units).value();
            fill([&](const auto& of) { return of(ap) + of(a) * of(p0) + of(b) * of(ps); });
            break;
        }
        case Formula::Sigma: {
            const Term sigma = term("sigma"), ps = term("ps"), top = term("ptop");
            fill([&](const auto& of) { return of(top) + of(sigma) * (of(ps) - of(top)); });
            break;
        }
        case Formula::HybridHeight: {
            const Term a = term("a"), b = term("b"), orog = term("orog");
            fill([&](const auto& of) { return of(a) + of(b) * of(orog); });
            break;
        }
        case Formula::OceanSigma: {
            const Term sigma = term("sigma"), eta = term("eta"), depth = term("depth");
            fill([&](const auto& of) { return of(eta) + of(sigma) * (of(depth) + of(eta)); });
            break;
        }
        case Formula::OceanS: {
            const Term s = term("s"), eta = term("eta"), depth = term("depth"), a = term("a"),
                       b = term("b"), critical = term("depth_c");
            fill([&](const auto& of) {
                const double steep = of(a), share = of(b), at = of(s);
                const double surface = std::sinh(steep * at) / std::sinh(steep),
                             bottom =
                                 std::tanh(steep * (at + 0.5)) / (2 * std::tanh(steep / 2)) - 0.5;
                const double c = (1 - share) * surface + share * bottom;
                return of(eta) * (1 + at) + of(critical) * at + (of(depth) - of(critical)) * c;
            });
            break;
        }
        case Formula::OceanS1: {
            const Term s = term("s"), c = term("C"), eta = term("eta"), depth = term("depth"),
                       critical = term("depth_c");
            fill([&](const auto& of) {
                const double still = of(critical) * of(s) + (of(depth) - of(critical)) * of(c);
                return still + of(eta) * (1 + still / of(depth));
            });
            break;
        }
        case Formula::OceanS2: {
            const Term s = term("s"), c = term("C"), eta = term("eta"), depth = term("depth"),
                       critical = term("depth_c");
            fill([&](const auto& of) {
                const double still =
                    (of(critical) * of(s) + of(depth) * of(c)) / (of(depth) + of(critical));
                return of(eta) + (of(eta) + of(depth)) * still;
            });
            break;
        }
    }
    return heights;
}

}  // namespace timeseries
