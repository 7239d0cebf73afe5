// Everything that a user chooses of a picture, as one plain value: no GL, no window, no data.
// The command line makes one, a session file holds one, a front end changes one.
#pragma once

#include <array>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "render/model/color_map.h"
#include "render/model/scene.h"
#include "timeseries/index/range_set.h"
#include "timeseries/series/time_cursor.h"
#include "timeseries/series/value_sweep.h"

namespace app {

using timeseries::kInfinity;

struct MapChoice {
    render::ColorMap map;
    // Values of the map's ends, the higher one first to turn it round; the layer's own ends where
    // absent.
    std::optional<double> lo, hi;
    friend bool operator==(const MapChoice&, const MapChoice&) = default;
};
// As it is drawn; from 0 to 1 where nothing is said.
inline render::ByValue byValue(const MapChoice& choice) {
    const double lo = choice.lo.value_or(0), hi = choice.hi.value_or(1);
    if (lo > hi) return {choice.map.reversed(), hi, lo};
    return {choice.map, lo, hi};
}

// What of the field is drawn: the points in a range, or the cells between them
// (render/model/cell_splat.h), where a step has them; else points.
enum class Model { Points, Cells };

struct LayerChoice {
    timeseries::RangeSet ranges;  // that stand; of a layer that moves none
    // sRGB components as written, #rrggbb / 255; or a map. Absent: chosen by place (see styled()).
    std::optional<std::variant<glm::dvec3, MapChoice>> color;
    std::optional<double> opacity;  // of one unit length of fully selected points, [0, 1]
    bool visible = true;            // a hidden layer is neither drawn nor counted in totals
    std::optional<Model> model{};   // absent: as all layers are
    // The swept window: the layer shows values that move.
    std::optional<timeseries::SweepSettings> motion{};
    friend bool operator==(const LayerChoice&, const LayerChoice&) = default;
};

// Which steps: first, first + stride, ... up to `last`, counted from 0. Absent `last` is the
// series' last.
struct StepChoice {
    std::size_t first = 0;
    std::optional<std::size_t> last;
    std::size_t stride = 1;  // >= 1
    friend bool operator==(const StepChoice&, const StepChoice&) = default;
};

struct ClipBox {
    glm::dvec3 lo, hi;  // closed, grid coordinates; infinite where unbounded
    friend bool operator==(const ClipBox&, const ClipBox&) = default;
};

// What a user says of an axis where the file does not. Its coordinates stay the file's.
struct AxisChoice {
    bool flip = false;  // drawn the other way round
    std::string name;   // "": the file's
    friend bool operator==(const AxisChoice&, const AxisChoice&) = default;
};

// Orthographic is drawn as a perspective from very far (see camera.h): one path of projection.
enum class Projection { Perspective, Orthographic };

// The eye looks at `target`. Azimuth 0 stands at -y (x to the right), 90 at +x.
struct ViewChoice {
    double azimuthDegrees = 30, elevationDegrees = 20;
    // In half diagonals of the box; absent: all of it is seen. Orthographic, it is the distance at
    // which a perspective shows the target as large.
    std::optional<double> distance;
    glm::dvec3 target{0};  // world: half diagonals of the box from its centre
    Projection projection = Projection::Perspective;
    // Where the target stands in the picture, in halves of its sides from the middle, as a lens is
    // shifted: eye and directions stay. Absent: where all of it is seen beside the legend, and of a
    // distance that is said the middle.
    std::optional<glm::dvec2> shift = {};
    // Whether these angles were asked for (see first_look.h): no part of what is seen.
    bool chosen = false;
    friend bool operator==(const ViewChoice& a, const ViewChoice& b) {
        return a.azimuthDegrees == b.azimuthDegrees && a.elevationDegrees == b.elevationDegrees &&
               a.distance == b.distance && a.target == b.target && a.projection == b.projection &&
               a.shift == b.shift;
    }
};

enum class Stereo { Off, SideBySide, TopBottom, MultiView, LeftRight };

struct StereoChoice {
    Stereo mode = Stereo::Off;
    // In half diagonals of the box. Absent: a thirtieth of the distance, and the box's centre.
    std::optional<double> eyeDistance, convergence;
    friend bool operator==(const StereoChoice&, const StereoChoice&) = default;
};

// How time and the swept window play, and where the window stands. Pictures do not depend on it,
// but for `tick` where one picture of a sweep is shown.
struct PlayChoice {
    timeseries::CursorSettings time;  // in and out points, stride, ending, direction, pace
    bool timeMoves = true, sweepMoves = true;
    std::int64_t tick = 0;  // of the sweep
    friend bool operator==(const PlayChoice&, const PlayChoice&) = default;
};

// A lamp far away, which stands still in the data's world: turning the volume, by mouse or hand,
// turns its light with it. Angles as a view's: from where an eye there would look.
struct LampChoice {
    double azimuthDegrees = 0, elevationDegrees = 0;
    friend bool operator==(const LampChoice&, const LampChoice&) = default;
};

struct Explorer {
    std::vector<std::filesystem::path> files;
    std::string variable;             // "": the file's first
    std::optional<StepChoice> steps;  // absent: the middle one
    // Of one step of a session, its time then (timeKept()): whoever opens the data asks for it
    // once.
    std::string stepTime = {};
    std::optional<timeseries::RangeSet> keep;
    std::array<AxisChoice, 3> axes;  // x, y, z
    // Empty: a first choice from the data, but for `noLayers`. The first one alone may move.
    std::vector<LayerChoice> layers;
    bool noLayers = false;  // the last one was taken away: none are wanted
    // One picture of the sweep, where it stands (play.tick), instead of its whole cycle. A window
    // shows one at a time anyway and has no use for it.
    bool oneTick = false;
    Model model = Model::Cells;                                    // of layers without their own
    render::Light light = render::Light::Soft;                     // on cells in depth order
    std::optional<LampChoice> lamp;                                // absent: light from the eye
    render::OpacityPer opacityPer = render::OpacityPer::Crossing;  // of cells
    render::Footprint footprint;
    render::Order order = render::Order::BackToFront;  // where it shows
    std::optional<ClipBox> clip;
    std::optional<glm::dvec3> scale;
    render::Map map = render::Map::Flat;  // a globe: of longitudes and latitudes alone
    ViewChoice view;
    StereoChoice stereo;
    bool legend = true;  // in the picture; a figure may have a caption instead
    glm::ivec2 size{1200, 900};
    PlayChoice play;

    friend bool operator==(const Explorer&, const Explorer&) = default;
};

// Of the layer that moves; null where none does.
inline const timeseries::SweepSettings* sweepOf(const Explorer& e) {
    return !e.layers.empty() && e.layers.front().motion ? &*e.layers.front().motion : nullptr;
}
inline timeseries::SweepSettings* sweepOf(Explorer& e) {
    return const_cast<timeseries::SweepSettings*>(sweepOf(std::as_const(e)));
}

inline Model modelOf(const Explorer& e, const LayerChoice& layer) {
    return layer.model.value_or(e.model);
}
// What is drawn by cells, if the step has them: some layer that is seen. Without layers, as a first
// one would be.
inline Model modelOf(const Explorer& e) {
    bool isAny = false;
    for (const LayerChoice& layer : e.layers) {
        if (!layer.visible) continue;
        if (modelOf(e, layer) == Model::Cells) return Model::Cells;
        isAny = true;
    }
    return isAny ? Model::Points : e.model;
}
inline bool mixesModels(const Explorer& e) {
    bool byCells = false, byPoints = false;
    for (const LayerChoice& layer : e.layers)
        if (layer.visible) (modelOf(e, layer) == Model::Cells ? byCells : byPoints) = true;
    return byCells && byPoints;
}
// All layers by one model.
inline Explorer allBy(Model model, Explorer e) {
    e.model = model;
    for (LayerChoice& layer : e.layers) layer.model.reset();
    return e;
}

// Whether both are about the same sorted steps.
inline bool sameData(const Explorer& a, const Explorer& b) {
    return a.files == b.files && a.variable == b.variable && a.keep == b.keep && a.axes == b.axes;
}

}  // namespace app
