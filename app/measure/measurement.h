// What each way of drawing a scene costs and how far it is from the continuous truth
// (render/reference/interval_truth.h): the trade of speed for accuracy, measured.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/choices/explorer.h"
#include "app/choices/rung.h"
#include "app/picture/depth_error.h"
#include "render/model/scene.h"
#include "render/splat/splatter.h"
#include "timeseries/index/sorted_step.h"

namespace app {

// One way to draw.
struct Mode {
    Rung rung{Model::Points};
    // Front to back or back to front; None mixes colours along the ray.
    render::Order order = render::Order::None;
    // Of cells by depth alone, and then the truth that they are held against is lit alike. All
    // others, as points always are, are measured in the light that comes from within.
    render::Light light = render::Light::Off;

    std::string name() const;  // "points", "coarse points 1/4", "cells", "lit cells"
    friend bool operator==(const Mode&, const Mode&) = default;
};
struct ModesOf {
    bool severalColors = false;
    bool coarsePoints = true;  // mayBeCoarse() of the footprint
    render::Light light = render::Light::Off;
};
// In which a scene can be drawn: points, subsets of them, cells; both orders where it has more than
// one colour; the first of them in coarse pixels, too; then cells in this light.
std::vector<Mode> modesFor(const ModesOf& of);
// Those of them with one of the names, in the same order; without names, all. Throws ChoiceError
// for a name that none has.
std::vector<Mode> modesNamed(std::span<const std::string> names, const ModesOf& of);

// A mass that is more than 5 % off is not to be overlooked beside a short time.
inline constexpr double kMassTolerance = 0.05;

inline constexpr double kTurnDegrees = 0.1;

struct Measured {
    Mode mode;
    double frame = 0;   // seconds, the median of all views' frames
    double before = 0;  // seconds for what the mode needs first: its selection, the cells' index
    double drawn = 0;   // splats or cells a frame
    // Of optical depth, all layers together, over all views, against the truth's.
    double depthError = 0;  // relative L2
    double mass = 1;        // its sum over the truth's
    // What arithmetic alone does to it: as drawn, against the same splats or cells and rays in
    // double, relative to the truth's depth; at some pixels of the first view.
    double arithmetic = 0;
    // What the picture changes by and the truth does not when the first view turns by kTurnDegrees:
    // relative to the truth's depth, as depthError is.
    double popping = 0;
    // Of the light, over all views, against the truth's; of the whole picture.
    double rmse = 0, psnr = 0;   // linear; dB, infinite for the same picture
    double largest = 0;          // linear, of one channel
    double colorDifference = 0;  // CIEDE2000, the 95th percentile of pixels that show something
    // What the depth's error comes from, and what order costs of light (app/picture/depth_error.h):
    // of the first view, from some of its pixels, against 8 x 8 rays in each.
    RungError parts = {};

    bool massIsOff() const { return !(mass >= 1 - kMassTolerance && mass <= 1 + kMassTolerance); }
};

struct Measuring {
    unsigned views = 3;
    unsigned frames = 5;  // timed, of each view
    // The truth's in a pixel; small cells are drawn by 3, whose places it is not to share.
    unsigned raysAcross = 5;
    std::vector<std::string> modes = {};  // names of those to be measured; none: all
    // ByDevice and Gl need a current GL context.
    render::SplatterChoice splatter = render::SplatterChoice::Cpu;
};

// The explorer's view, and others about it: each turned by 137.5 degrees (the golden angle) more,
// so that no two are alike.
std::vector<ViewChoice> viewsAbout(const ViewChoice& view, unsigned count);

// Draws without axes and legend, which all modes share; timed by turns.
// `progress` is told the share that is done. REQUIRES: a resolved explorer; step.canHaveCells(),
// and no mode asked for its cells before, or their time is not in `before`. Throws OutsideKeptError
// as makeScene does, ChoiceError as modesNamed does.
std::vector<Measured> measure(const Explorer& explorer, const timeseries::SortedStep& step,
                              const render::PlacedPoints& placed, const Measuring& how,
                              const std::function<void(double)>& progress = {});

}  // namespace app
