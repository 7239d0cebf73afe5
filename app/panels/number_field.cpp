#include "app/panels/number_field.h"

#include "app/choice_text.h"
#include "timeseries/number.h"

namespace app::panels {

std::optional<double> numberField(Desk& desk, TextField& field, const char* id, const Rect& at,
                                  std::string_view what, double shown) {
    const auto entered = field.draw(desk.theme, id, at, timeseries::toText(shown));
    if (!entered) return std::nullopt;
    try {
        return parseNumber(what, *entered);
    } catch (const ChoiceError& error) {
        desk.exploration.tell(error.what(), true);
        return std::nullopt;
    }
}

}  // namespace app::panels
