// The clip box.
#include <glm/common.hpp>
#include <utility>

#include "app/choices/camera.h"
#include "app/panels/view_page.h"
#include "render/points/placed_points.h"
#include "tests/ui/demo_values.h"
#include "tests/ui/desk_test.h"

namespace ui {
namespace {

using app::panels::Rect;

// Pixels of the fire: lines and text are grey.
std::size_t colorful(const Shot& shot) {
    return static_cast<std::size_t>(std::ranges::count_if(shot.pixels, [](const auto& pixel) {
        const auto [least, most] = std::ranges::minmax(pixel);
        return most - least > 40;
    }));
}

class DeskClips : public DeskWithFire {
 protected:
    // A place on the slider of the heights.
    glm::vec2 height(float fraction) const {
        constexpr float kRadius = 5.5f;  // of a handle
        const Rect bar = slider();
        return {glm::mix(bar.min.x + kRadius, bar.max.x - kRadius, fraction), bar.centre().y};
    }
    Rect slider() const {
        Rect row = pageRow(side_, 7, 1);
        row.max.x -= app::panels::ViewPage::kSideField + app::panels::ViewPage::kSideGap;
        return row;
    }
    // The part of the clear picture from row to row of the picture.
    Rect rows(double from, double to) const {
        Rect out = at_.clear;
        out.min.y = std::max(out.min.y, at_.window.picture.min.y + static_cast<float>(from));
        out.max.y = std::min(out.max.y, at_.window.picture.min.y + static_cast<float>(to));
        return out;
    }
    Shot clear(const Shot& picture, const Rect& place) const {
        return part(picture, {place.min - at_.clear.min, place.max - at_.clear.min});
    }
};

TEST_F(DeskClips, WhatLiesBeyondTheDraggedFaceUntilItIsUndone) {
    // A height is a row of an orthographic picture from the front.
    desk_->press("1");
    desk_->press("p");
    desk_->click(tabPlace(side_, Tab::View));
    const app::Explorer before = now();
    const Shot whole = picture();

    desk_->drag(height(1), height(0.4f));
    const Shot clipped = picture();
    app::Explorer after = now();
    ASSERT_TRUE(after.clip);
    const std::shared_ptr<const timeseries::Grid> grid = demoReader().variables()[0].grid;
    const std::vector<double>& z = grid->axes()[2].coordinates;
    const double length = z.back() - z.front(), face = after.clip->hi.z;
    EXPECT_NEAR(face, z.front() + 0.4 * length,
                2 * length / static_cast<double>(slider().size().x));
    EXPECT_EQ(after.clip->lo, glm::dvec3(-app::kInfinity));
    EXPECT_EQ(after.clip->hi, glm::dvec3(app::kInfinity, app::kInfinity, face));
    const app::ClipBox clip = *std::exchange(after.clip, before.clip);
    EXPECT_TRUE(after == before) << "and nothing else";

    // The last points drawn lie on or below the face, and their splats reach less than 1.5 cells
    // beyond them.
    const render::PlacedPoints placed(*grid, after.scale);
    const render::View eye = app::eyes(after, placed.outline()).front();
    const auto row = [&](double height) {
        const glm::dvec3 world = placed.axesFromGrid({0, 0, height});
        return static_cast<double>(eye.size.y) - render::project(eye, world).window.y;
    };
    const double reach = 1.5 * (z[1] - z[0]), infinity = eye.size.y;
    const Rect above = rows(0, row(face + reach)), below = rows(row(face - reach), infinity);
    EXPECT_GT(colorful(clear(whole, above)), 1000u);
    EXPECT_EQ(colorful(clear(clipped, above)), 0u);
    EXPECT_GT(colorful(clear(clipped, below)), 1000u);
    EXPECT_EQ(differing(clear(clipped, below), clear(whole, below)), 0u);

    desk_->press("ctrl+z");
    EXPECT_EQ(differing(picture(), whole), 0u);
    EXPECT_TRUE(now() == before);
    desk_->press("ctrl+y");
    EXPECT_EQ(differing(picture(), clipped), 0u);
    EXPECT_EQ(now().clip, clip);
}

}  // namespace
}  // namespace ui
