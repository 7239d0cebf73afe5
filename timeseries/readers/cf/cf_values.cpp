#include "timeseries/readers/cf/cf_values.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "timeseries/readers/cf/cf_packing.h"

namespace timeseries {

std::vector<double> valuesOf(const CfFile& file, const NcVariable& coordinate) {
    const Packing packing = packingOf(
        coordinate, [&](const std::string& what) { file.failAttribute(coordinate, what); });
    std::vector<double> values;
    for (const Number& stored : file.numbers(coordinate)) {
        const bool missing = std::ranges::any_of(
            packing.missing, [&](const Number& fill) { return compare(stored, fill) == 0; });
        values.push_back(missing ? std::nan("") : packing.unpack(toDouble(stored)));
    }
    return values;
}

double turnIn(const std::string& units) {
    const std::string low = lower(units);
    if (low.starts_with("deg")) return 360;
    return low.starts_with("rad") ? 2 * std::numbers::pi : 0;
}

double degreesIn(const std::string& units) {
    return lower(units).starts_with("rad") ? 180 / std::numbers::pi : 1;
}

}  // namespace timeseries
