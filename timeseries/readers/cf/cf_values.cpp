#include "timeseries/readers/cf/cf_values.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "timeseries/readers/cf/cf_packing.h"

namespace timeseries {

std::vector<Number> numbersOf(const CfFile& file, const NcVariable& coordinate) {
    const Packing packing = packingOf(
        coordinate, [&](const std::string& what) { file.failAttribute(coordinate, what); });
    std::vector<Number> numbers = file.numbers(coordinate);
    for (Number& number : numbers) {
        number = asMeant(packing, number);
        const bool isMissing = std::ranges::any_of(
            packing.missing, [&](const Number& fill) { return compare(number, fill) == 0; });
        if (isMissing)
            number = std::nan("");
        else if (packing.scaled)
            number = packing.unpack(toDouble(number));
    }
    return numbers;
}

std::vector<double> valuesOf(const CfFile& file, const NcVariable& coordinate) {
    const std::vector<Number> numbers = numbersOf(file, coordinate);
    std::vector<double> values(numbers.size());
    std::ranges::transform(numbers, values.begin(), toDouble);
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
