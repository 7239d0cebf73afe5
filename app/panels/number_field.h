// A number in a field: what was entered, when it is a finite number; else it is told what was
// expected.
#pragma once

#include "app/panels/desk.h"
#include "app/panels/widgets.h"

namespace app::panels {

// `what` names the number to its user. Keeps what is being typed in `field`.
std::optional<double> numberField(Desk& desk, TextField& field, const char* id, const Rect& at,
                                  std::string_view what, double shown);

}  // namespace app::panels
