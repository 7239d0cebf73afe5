#include "app/picture/depth_error.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "app/picture/picture.h"
#include "render/frame/plain_frame.h"
#include "render/reference/sampled_error.h"

namespace app {

double depthErrorOf(const Explorer& explorer, const timeseries::SortedStep& step,
                    const render::View& view, unsigned threads, const std::atomic<bool>& wanted) {
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    const render::PlacedPoints placed(step.grid(), explorer.scale);
    Explorer e = explorer;
    e.opacityPer = render::OpacityPer::Length;
    e.order = render::Order::None;  // depth alone
    const render::Scene scene = makeScene(e, step, placed, e.play.tick);
    if (scene.layers.empty()) return kUnknown;
    const std::vector<float> depth = opticalDepthOf(scene, view, wanted);
    if (!wanted) return kUnknown;
    const auto cells = step.cellsIfMade();
    const timeseries::Field field = cells ? timeseries::Field{} : fieldOf(step);
    return sampledError(scene, cells ? cells->field() : field, view, depth, {.threads = threads})
        .relativeL2;
}

std::string depthErrorText(const std::optional<double>& error) {
    if (!error || !std::isfinite(*error)) return "";
    const double percent = 100 * *error;
    if (percent < 0.1) return "error below 0.1 %";
    return fmt::format("error about {:.{}f} %", percent, percent < 1 ? 1 : 0);
}

}  // namespace app
