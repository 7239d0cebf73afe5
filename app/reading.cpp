#include "app/reading.h"

#include <fmt/format.h>

#include "render/ticks.h"

namespace app {

std::string withUnit(const std::string& number, const std::string& unit) {
    const std::string shown = render::shownUnit(unit);
    return shown.empty() || shown == "index" ? number : number + " " + shown;
}

std::string valueText(const timeseries::Number& value, timeseries::ValueType type,
                      const std::string& unit) {
    if (type == timeseries::ValueType::F32)
        return withUnit(fmt::format("{}", static_cast<float>(timeseries::toDouble(value))), unit);
    return withUnit(timeseries::toText(value), unit);
}

std::string placeText(const timeseries::Axis& axis, double position, std::size_t index) {
    return fmt::format("{}   [{}]", withUnit(fmt::format("{:.6g}", position), axis.units), index);
}

}  // namespace app
