// A plot as SVG 1.1: text that a browser or an editor of drawings opens.
#pragma once

#include <string>

#include "app/measure/plot.h"

namespace app {

// Texts are in the reader's own font; tips are <title>s.
std::string plotSvg(const Plot& plot);

}  // namespace app
