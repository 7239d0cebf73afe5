// What is drawn: layers of runs of one step's sorted points, each with its style, and how splats
// are shaped and ordered. Plain values; no GL.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <variant>
#include <vector>

#include "render/model/color_map.h"
#include "render/model/light.h"
#include "render/points/placed_points.h"
#include "render/points/subset.h"
#include "timeseries/index/cell_index.h"
#include "timeseries/index/point_gradients.h"
#include "timeseries/index/sorted_step.h"

namespace render {

struct Constant {
    glm::dvec3 linearRgb;
};
struct ByValue {
    ColorMap map;
    double lo, hi;  // values of the map's two ends; lo >= hi gives its middle everywhere
    double halfWidth() const { return 0.5 * hi - 0.5 * lo; }  // halves: the whole may overflow
};

// Where a value stands on a scale from 0 at `lo` to 1, two half widths farther. All that turns
// values into colours asks this. REQUIRES: halfWidth > 0.
inline double placeOnScale(double value, double lo, double halfWidth) {
    return (0.5 * value - 0.5 * lo) / halfWidth;
}

// Position of a value in its map, [0, 1]; the limit case lo == hi is the middle.
inline double mapPosition(const ByValue& style, double value) {
    if (!(style.halfWidth() > 0)) return 0.5;
    return std::clamp(placeOnScale(value, style.lo, style.halfWidth()), 0.0, 1.0);
}

struct RangeStyle {
    std::variant<Constant, ByValue> color;
    double opacity = 0.5;  // of one unit length l of fully selected points, [0, 1]
};

// Linear, of a point of this value.
inline glm::dvec3 colorOf(const RangeStyle& style, double value) {
    if (const auto* constant = std::get_if<Constant>(&style.color)) return constant->linearRgb;
    const auto& byValue = std::get<ByValue>(style.color);
    return glm::dvec3(byValue.map.at(mapPosition(byValue, value)));
}

// Optical depth per unit of accumulated weight W. Opacity 1 stands for the 16 at which nothing
// visible (1e-7) comes through: infinity would make 0 * inf of empty pixels.
inline double opticalDepthPerWeight(double opacity) {
    constexpr double kOpaque = 16;
    return opacity >= 1 ? kOpaque : std::min(kOpaque, -std::log1p(-opacity));
}

// The cells between points, of which a ray takes what lies in the ranges
// (render/model/cell_splat.h): the interval volume of the field interpolated between its points.
struct Cells {
    std::vector<timeseries::Interval<double>> ranges;
    std::vector<timeseries::Run> candidates;  // as CellIndex::select gives them
};

struct Layer {
    std::vector<timeseries::Run> runs;  // as SortedStep::select gives them
    RangeStyle style;
    Cells cells = {};       // of which there are candidates where the layer is drawn by cells
    bool byPoints = false;  // all the same, where the scene has cells
};
constexpr std::size_t kMaxLayers = 8;

// All have one and the same constant colour, or there is none: what is in front of what does not
// show, whatever their opacities.
bool areOneColor(const std::vector<Layer>& layers);

std::uint64_t pointCount(const Layer& layer);
// What a scene's stride is for this layer: halved until a point is drawn, if there is one.
std::uint32_t strideOf(const Layer& layer, std::uint32_t stride);
std::uint64_t splatCount(const Layer& layer, std::uint32_t stride);  // drawn of the points
std::uint64_t cellCount(const Layer& layer);                         // looked at
// The exact share: a layer's mass is the same at every stride.
double pointsPerSplat(const Layer& layer, std::uint32_t stride);

enum class Kernel {
    Point,   // a square of `size` pixels, rounded to whole ones
    Quartic  // (1 - q)^4, `size` times the radius that suits the spacing
};
struct Footprint {
    Kernel kernel = Kernel::Quartic;
    double size = 1;
    friend bool operator==(const Footprint&, const Footprint&) = default;
};
// Of a splat that stands for so many points: it fills their place, which at equal cost is nearer to
// the whole than more, smaller splats (tests/bench/canvas_bench.cpp). Points keep their pixels.
Footprint standingFor(Footprint footprint, double points);
enum class Order { None, BackToFront };

// What a layer's opacity is of, where cells are drawn: a unit length l of a ray's way within a
// range, or one passage through it from end to end, whichever makes more of each piece of the way,
//   dW = max(ds / l, |df| / (hi - lo)),
// so that a contour stays visible however thin its range is.
enum class OpacityPer { Length, Crossing };

// Refers to the step and the placed points, which must outlive it.
struct Scene {
    const timeseries::SortedStep& step;
    const PlacedPoints& placed;
    std::vector<Layer> layers;  // at most kMaxLayers
    Footprint footprint;
    Order order = Order::None;
    IndexBox clip;
    // One of so many points is drawn and stands for its neighbours in value: less to draw, for the
    // same mass. A power of two, at most kMaxStride; which points: render/points/subset.h.
    std::uint32_t stride = 1;
    // The step's, where layers are drawn by cells instead of points, but for those that are drawn
    // by points all the same; of both all then, always.
    std::shared_ptr<const timeseries::CellIndex> cells = {};
    Light light = Light::Off;  // on cells, where they are drawn in order
    // The step's on the mesh of the placed points, where light falls on the cells of one; null:
    // each tetrahedron is lit by its own gradient, which has an edge at every face.
    std::shared_ptr<const timeseries::PointGradients> gradients = {};
    Lamp lamp = {};
    OpacityPer opacityPer = OpacityPer::Length;
    // Cells of a mesh in the order of their middles, which is sooner there, and where cells lean or
    // grow not in the order in which they hide each other.
    bool byMiddles = false;
};

inline bool isByCells(const Scene& scene, const Layer& layer) {
    return scene.cells && !layer.byPoints;
}
// Points have lengths alone.
inline OpacityPer opacityPerOf(const Scene& scene, const Layer& layer) {
    return isByCells(scene, layer) ? scene.opacityPer : OpacityPer::Length;
}
// Some layers are drawn by cells and others by points. REQUIRES then: stride 1.
bool mixesModels(const Scene& scene);
// What it has of either: the layers are as many, those of the other show nothing.
Scene onlyPoints(Scene scene);
Scene onlyCells(Scene scene);

// Splats or cells that are drawn of a layer.
inline std::uint64_t drawnCount(const Scene& scene, const Layer& layer) {
    return isByCells(scene, layer) ? cellCount(layer) : splatCount(layer, scene.stride);
}

// What the step knows of its points, of which only those of the scene's runs may be read.
timeseries::Columns columnsOf(const Scene& scene);
// As colours take it.
inline double valueOf(const timeseries::Columns& columns, std::uint64_t point) {
    return std::visit([&](auto values) { return static_cast<double>(values[point]); },
                      columns.values);
}

// The draw list: the runs as they lie; one list of all layers' points, farthest first; or that who
// made it for itself puts them in that order when it draws them, by distances from here.
struct Runs {};
struct SortWhenDrawn {
    glm::dvec3 midEye;
};
struct Sorted {
    std::vector<std::uint32_t> point;  // position in the sorted step
    std::vector<std::uint8_t> layer;
};
using DrawList = std::variant<Runs, Sorted, SortWhenDrawn>;

// What a plane of pixels accumulates. Weight (W) and WeightedColor (W times colour, W) belong to
// one layer each; Over (premultiplied colour, opacity) and Count (splats that touch the pixel) take
// every layer and stand alone.
enum class Channels { Weight, WeightedColor, Over, Count };
inline std::size_t floatsPerPixel(Channels channels) {
    return channels == Channels::Weight || channels == Channels::Count ? 1 : 4;
}
// What the scene's picture needs: one entry a layer, or a single Over when it is ordered.
std::vector<Channels> channelsFor(const Scene& scene);

}  // namespace render
