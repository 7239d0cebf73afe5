// Heights of levels that a formula gives, of each column and step its own: CF 1.10, section 4.3.3
// and appendix D; and WRF's, whose geopotential stands in two parts (ARW's user's guide, chapter
// 5).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "timeseries/readers/cf/cf_terms.h"

namespace timeseries {

struct HeightFormula {
    enum class Kind {
        HybridPressure,
        Sigma,
        HybridHeight,
        OceanSigma,
        OceanS,
        OceanS1,
        OceanS2,
        Wrf,
        Given  // in a variable of its own
    };
    Kind kind{};
    std::map<std::string, std::string> terms;  // the variable of each, "ps": "PS"
    std::string name, units;                   // of what it gives: "air pressure", "Pa"
    bool down = false, inTime = false;
    // Of the terms those that lie on other columns, and are taken from there.
    std::vector<std::string> beside = {};
    // The reference pressure, where the file names one that it does not have.
    std::optional<double> guessedPascals = {};
    friend bool operator==(const HeightFormula&, const HeightFormula&) = default;
};

// That of a coordinate of the variable's levels, or WRF's, whose terms are all there; above places
// in a list also heights that a variable has: one that the attribute `coordinates` names and that
// says it is vertical, by length or pressure, SCHISM's `zcor`, or MPAS's `zgrid` (of the levels
// between which those of most variables are) or `zMid`. REQUIRES: roles.x and z, and y of what is
// no list.
std::optional<HeightFormula> heightFormulaOf(const NcHeader& header, const NcVariable& variable,
                                             const Roles& roles);

// What is only near what the formula says, as a note; "" where nothing is.
std::string approximationIn(const HeightFormula& formula);

// [z][y][x], x fastest, of one step, without y of a list; not a number where a term is none.
// REQUIRES: heightFormulaOf gave it. Throws FileError, and std::invalid_argument when there is too
// much of a term.
std::vector<double> heightsOf(const CfFile& file, const NcVariable& variable, const Roles& roles,
                              const HeightFormula& formula, std::size_t step);

}  // namespace timeseries
