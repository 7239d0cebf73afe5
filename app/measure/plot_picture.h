// A plot as pixels, drawn without GL: what `--png` writes.
#pragma once

#include "app/measure/plot.h"
#include "render/image/image.h"

namespace app {

// kPlotScale (plot_text.h) times the plot's size, opaque, with the font inside the program. Tips
// are left out.
render::Image plotPicture(const Plot& plot);

}  // namespace app
