#include "app/panels/number_field.h"

#include "app/choices/choice_text.h"
#include "app/choices/decimals.h"
#include "timeseries/index/number.h"

namespace app::panels {
namespace {

timeseries::ValueType typeOf(const Desk& desk) {
    const auto shown = desk.exploration.shown();
    return shown ? shown->sorted->type() : timeseries::ValueType::F64;
}

}  // namespace

std::optional<double> numberField(Desk& desk, TextField& field, const char* id, const Rect& at,
                                  std::string_view what, double shown) {
    const auto entered = field.draw(desk.theme, id, at, timeseries::toText(shown));
    if (!entered) return std::nullopt;
    try {
        return parseNumber(what, *entered);
    } catch (const ChoiceError& error) {
        field.refuse(error.what());
        return std::nullopt;
    }
}

std::optional<double> valueField(Desk& desk, TextField& field, const char* id, const Rect& at,
                                 std::string_view what, double shown) {
    return numberField(desk, field, id, at, what, shortestIn(typeOf(desk), shown));
}

std::string rangesText(const Desk& desk, const timeseries::RangeSet& ranges) {
    return shortestIn(typeOf(desk), ranges).text();
}

}  // namespace app::panels
