#include "app/panels/number_field.h"

#include <fmt/format.h>

#include <cmath>

#include "app/choices/choice_text.h"
#include "app/choices/decimals.h"
#include "timeseries/index/number.h"

namespace app::panels {
namespace {

timeseries::ValueType typeOf(const PanelContext& context) {
    const auto shown = context.exploration.shown();
    return shown ? shown->sorted->type() : timeseries::ValueType::F64;
}

}  // namespace

std::optional<double> numberField(PanelContext& context, TextField& field, const char* id,
                                  const Rect& at, std::string_view what, double shown) {
    const auto entered = field.draw(context.theme, id, at, timeseries::toText(shown));
    if (!entered) return std::nullopt;
    try {
        return parseNumber(what, *entered);
    } catch (const ChoiceError& error) {
        field.refuse(error.what());
        return std::nullopt;
    }
}

std::optional<std::int64_t> countField(PanelContext& context, TextField& field, const char* id,
                                       const Rect& at, std::string_view what, std::int64_t shown) {
    constexpr double kMost = 1 << 30;
    const auto entered = numberField(context, field, id, at, what, static_cast<double>(shown));
    if (!entered) return std::nullopt;
    if (*entered >= 1 && *entered <= kMost && *entered == std::floor(*entered))
        return static_cast<std::int64_t>(*entered);
    field.refuse(fmt::format("{} must be whole, from 1 to 2^30, not {}", what, *entered));
    return std::nullopt;
}

std::optional<double> valueField(PanelContext& context, TextField& field, const char* id,
                                 const Rect& at, std::string_view what, double shown) {
    return numberField(context, field, id, at, what, shortestIn(typeOf(context), shown));
}

std::string rangesText(const PanelContext& context, const timeseries::RangeSet& ranges) {
    return shortestIn(typeOf(context), ranges).text();
}

}  // namespace app::panels
