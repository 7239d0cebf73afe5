// What the window reads off the data: the point under the pointer, and how far two are apart.
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/choices/camera.h"
#include "render/points/placed_points.h"
#include "tests/ui/demo_values.h"
#include "tests/ui/desk_test.h"
#include "tests/ui/screen_text.h"

namespace ui {
namespace {

using Index = std::array<std::size_t, 3>;

// A point that nothing hides, and the pixel of the picture that its middle is on, y down.
struct Foremost {
    std::size_t index;
    double depth;
    glm::ivec2 pixel;
};

// Of the points selected, those whose splat is the first that the ray of their own pixel meets.
// Their splats reach less than 1.5 cells.
std::vector<Foremost> foremost(const app::Explorer& e, const timeseries::Grid& grid) {
    const render::PlacedPoints placed(grid, e.scale);
    const render::View eye = app::eyes(e, placed.outline()).front();
    const double cell = placed.cell(0).x * render::pixelRays(eye).focal.x;
    const std::vector<float> values = valuesAt(e.steps->first);
    struct Seen {
        std::size_t index;
        render::Projected at;
    };
    std::vector<Seen> seen;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (oracle::holds(e.layers.at(0).ranges.ranges(), values[i]))
            seen.push_back({i, render::project(eye, placed.position(i))});
    std::vector<Foremost> found;
    for (const Seen& p : seen) {
        const glm::dvec2 pixel = glm::floor(p.at.window);
        const bool hidden = std::ranges::any_of(seen, [&](const Seen& q) {
            return q.index != p.index && q.at.depth <= p.at.depth &&
                   glm::distance(q.at.window, pixel + 0.5) < 1.5 * cell / q.at.depth;
        });
        if (!hidden)
            found.push_back(
                {p.index,
                 p.at.depth,
                 {static_cast<int>(pixel.x), eye.size.y - 1 - static_cast<int>(pixel.y)}});
    }
    return found;
}

class DeskReads : public DeskWithFire {
 protected:
    // In one colour and so opaque that one splat hides what is behind its middle.
    DeskReads() : DeskWithFire({"--range", "600:max", "--color", "#ffa040", "--opacity", "0.99"}) {}
    void SetUp() override {
        DeskWithFire::SetUp();
        if (IsSkipped()) return;
        e_ = now();
        picture();
        points_ = foremost(e_, *grid_);
        ASSERT_GE(points_.size(), 3u);
        std::ranges::sort(points_, {}, [](const Foremost& p) { return p.pixel.x; });
    }

    glm::vec2 placeOf(const Foremost& p) const {
        return at_.window.picture.min + glm::vec2(p.pixel);
    }
    Index indexOf(const Foremost& p) const {
        const auto size = grid_->size();
        return {p.index % size[0], p.index / size[0] % size[1], p.index / size[0] / size[1]};
    }
    glm::dvec3 positionOf(const Foremost& p) const {
        glm::dvec3 out;
        for (int i = 0; i < 3; ++i) {
            const auto axis = static_cast<std::size_t>(i);
            out[i] = grid_->axes()[axis].coordinates[indexOf(p)[axis]];
        }
        return out;
    }
    // What the page of readings says beside a label.
    std::string said(const Shot& window, const std::string& label) const {
        return text_.beside(window, side_.page, label);
    }

    std::shared_ptr<const timeseries::Grid> grid_ = demoReader().variables()[0].grid;
    app::Explorer e_;
    std::vector<Foremost> points_;  // from the left to the right
    ScreenText text_;
};

TEST_F(DeskReads, ThePointUnderADoubleClickAsTheFileHasIt) {
    const std::vector<float> values = valuesAt(e_.steps->first);
    for (const Foremost& point : {points_.front(), points_[points_.size() / 2], points_.back()}) {
        desk_->doubleClick(placeOf(point));
        const Shot window = desk_->settled();
        EXPECT_EQ(said(window, "T"), fmt::format("{} K", values[point.index]));
        for (int i = 0; i < 3; ++i) {
            const auto axis = static_cast<std::size_t>(i);
            EXPECT_EQ(said(window, grid_->axes()[axis].name),
                      fmt::format("{:.6g} m   [{}]", positionOf(point)[i], indexOf(point)[axis]));
        }
        EXPECT_EQ(said(window, "Time"), fmt::format("{:g} s", demoTimes()[e_.steps->first]));
    }
}

TEST_F(DeskReads, HowFarTheSecondPointIsFromTheFirst) {
    desk_->doubleClick(placeOf(points_.front()));
    EXPECT_EQ(said(desk_->settled(), "Distance"), "");
    desk_->hold("shift");
    desk_->doubleClick(placeOf(points_.back()));
    desk_->release("shift");
    const glm::dvec3 apart = positionOf(points_.back()) - positionOf(points_.front());
    EXPECT_EQ(said(desk_->settled(), "Distance"), fmt::format("{:.6g} m", glm::length(apart)));
    // The page has more rows than it shows.
    desk_->move(side_.page.centre());
    desk_->wheel(-20);
    const Shot window = desk_->settled();
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(said(window, "Δ " + grid_->axes()[static_cast<std::size_t>(i)].name),
                  fmt::format("{:.6g} m", apart[i]));
}

}  // namespace
}  // namespace ui
