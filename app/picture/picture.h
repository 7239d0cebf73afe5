// From a user's choices and the data of one step to what is drawn. No GL.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/choices/explorer.h"
#include "app/files/dataset.h"
#include "render/annotate/legend.h"
#include "render/model/scene.h"

namespace app {

// What a layer selects: its ranges, or where its window stands at `tick`. That reaches beyond the
// animation's ends, and only what was kept can be shown of it. REQUIRES: a resolved layer.
timeseries::RangeSet rangesAt(const LayerChoice& layer, const timeseries::SortedStep& step,
                              std::int64_t tick);

// The choices of one picture of a series: its step alone, and a sweep that stands at `tick`. Draws
// the same pixels.
Explorer onlyThis(const Explorer& explorer, std::size_t stepIndex, std::int64_t tick);

// Ranges between points such that a step's cells that reach into them are all that the explorer
// shows of it, at any tick: those of its visible layers, or everything where a window is swept.
std::vector<timeseries::Interval<double>> cellsNeeded(const Explorer& explorer,
                                                      timeseries::ValueType type);

// Whether some of the picture is drawn by cells.
bool needsCells(const Explorer& explorer, const timeseries::SortedStep& step);

// And whether light falls on them by the gradients of a mesh's points.
bool needsGradients(const Explorer& explorer, const timeseries::SortedStep& step,
                    const render::PlacedPoints& placed);

// Who does not wait for a step's cells draws points until they are there, and tetrahedra in their
// own light until there are gradients.
enum class Await { Cells, Nothing };

// One step as the explorer wants it drawn. REQUIRES: a resolved explorer; `tick` of its sweep, if
// it has one. Hidden layers are neither in the scene nor in the legend. `step` and `placed` must
// outlive the scene. Throws OutsideKeptError when a visible layer asks for values that were
// dropped.
render::Scene makeScene(const Explorer& explorer, const timeseries::SortedStep& step,
                        const render::PlacedPoints& placed, std::int64_t tick = 0,
                        Await await = Await::Cells);
// What is said of it. With a clip box every selected point is looked at, for the counts.
render::Legend makeLegend(const Explorer& explorer, const timeseries::Variable& variable,
                          std::size_t stepIndex, const render::Scene& scene, std::int64_t tick = 0);
// "nothing is drawn: every layer is hidden"; "" where some layer is seen.
std::string whyNothing(const Explorer& explorer);
// Whether the picture is to say that its colours are mixed (render/frame/mean_depth.h), and how it
// does. Apart from the legend, for it depends on the view and takes milliseconds.
bool isMixed(const Explorer& explorer, const render::Scene& scene);
inline constexpr const char* kMixedColors =
    "colours mixed, not in depth order (--order depth, or Quality: By depth)";
// What the picture has of it: all, or nothing where none is wanted.
render::Legend asDrawn(const Explorer& explorer, render::Legend legend);
// Whether a note of the legend holds only where the scene is drawn by cells.
bool isOfCells(const std::string& note);
struct Picture {
    render::Scene scene;
    render::Legend legend;
};
Picture makePicture(const Explorer& explorer, const timeseries::Variable& variable,
                    std::size_t stepIndex, const timeseries::SortedStep& step,
                    const render::PlacedPoints& placed, std::int64_t tick = 0);

}  // namespace app
