// A number in a field: what was entered, when it is a finite number; else the field says what was
// expected.
#pragma once

#include <cstdint>

#include "app/panels/panel_context.h"
#include "app/panels/widgets.h"

namespace app::panels {

// `what` names the number to its user. Keeps what is being typed in `field`.
std::optional<double> numberField(PanelContext& context, TextField& field, const char* id,
                                  const Rect& at, std::string_view what, double shown);
// A whole number from 1 to 2^30, as counts of steps are.
std::optional<std::int64_t> countField(PanelContext& context, TextField& field, const char* id,
                                       const Rect& at, std::string_view what, std::int64_t shown);
// A number that is a value of the field that is explored, told with the digits of its own type.
std::optional<double> valueField(PanelContext& context, TextField& field, const char* id,
                                 const Rect& at, std::string_view what, double shown);
// As the text of a field of ranges.
std::string rangesText(const PanelContext& context, const timeseries::RangeSet& ranges);

}  // namespace app::panels
