#include "render/annotate/label_places.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>

#include "tests/support/scenes.h"

namespace render {
namespace {

// By more than a rounding.
bool strictlyInside(const glm::dvec2& at, const PixelRect& outer) {
    const PixelRect rect = outer.grown(-1e-9);
    return at.x > rect.lo.x && at.y > rect.lo.y && at.x < rect.hi.x && at.y < rect.hi.y;
}

// Small whole numbers: lines along edges, through corners, and points among them.
TEST(PartInside, AgreesWithAWalkAlongTheLine) {
    std::mt19937 random(5);
    const auto number = [&] { return static_cast<double>(random() % 9); };
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec2 a(number(), number()), b(number(), number());
        const glm::dvec2 c(number(), number()), d(number(), number());
        const PixelRect rect{glm::min(c, d), glm::max(c, d)};
        const auto part = partInside(a, b, rect);
        constexpr int kSteps = 97;
        for (int k = 0; k <= kSteps; ++k) {
            const double t = static_cast<double>(k) / kSteps;
            const bool inside = strictlyInside(glm::mix(a, b, t), rect);
            const bool told = part && t > (*part)[0] && t < (*part)[1];
            const bool atEnd =
                part && (std::abs(t - (*part)[0]) < 1e-9 || std::abs(t - (*part)[1]) < 1e-9);
            if (atEnd || a == b) continue;
            EXPECT_EQ(inside, told) << i << " at " << t;
        }
    }
}

TEST(PiecesOutside, AreTheLineButForWhatIsInside) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> number(0, 100);
    for (int i = 0; i < 300; ++i) {
        const glm::dvec2 a(number(random), number(random)), b(number(random), number(random));
        std::vector<PixelRect> rects;
        for (auto n = random() % 5; n > 0; --n) {
            const glm::dvec2 lo(number(random), number(random));
            rects.push_back({lo, lo + 0.3 * glm::dvec2(number(random), number(random))});
        }
        const auto pieces = piecesOutside(a, b, rects);
        for (std::size_t p = 1; p < pieces.size(); ++p)
            EXPECT_GT(pieces[p][0], pieces[p - 1][1]) << i;
        for (int k = 0; k <= 200; ++k) {
            const double t = k / 200.0;
            const glm::dvec2 at = glm::mix(a, b, t);
            const bool inside = std::ranges::any_of(
                rects, [&](const PixelRect& rect) { return strictlyInside(at, rect); });
            const bool kept = std::ranges::any_of(
                pieces, [&](const glm::dvec2& piece) { return t >= piece[0] && t <= piece[1]; });
            EXPECT_NE(inside, kept) << i << " at " << t;
        }
    }
}

TEST(Distance, IsThatOfTheNearestPlaceOnTheLine) {
    std::mt19937 random(7);
    const auto number = [&] { return static_cast<double>(random() % 9); };
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec2 a(number(), number()), b(number(), number());
        const glm::dvec2 c(number(), number()), d(number(), number());
        if (c.x == d.x || c.y == d.y) continue;
        const PixelRect rect{glm::min(c, d), glm::max(c, d)};
        constexpr int kSteps = 200;
        double least = 1e9;
        for (int k = 0; k <= kSteps; ++k) {
            const glm::dvec2 at = glm::mix(a, b, static_cast<double>(k) / kSteps);
            least = std::min(least, glm::distance(at, glm::clamp(at, rect.lo, rect.hi)));
        }
        // Between two steps the distance changes by no more than half of one.
        EXPECT_LE(distance(rect, a, b), least + 1e-9) << i;
        EXPECT_GE(distance(rect, a, b), least - 0.5 * glm::distance(a, b) / kSteps - 1e-9) << i;
    }
}

class Places : public testing::Test {
 protected:
    const View view_ = tests::lookFrom({0, -4, 0}, {400, 300});
    const Sights sights_{view_, {{0, -4, 0}}, glm::dvec3(0.5)};
    // 20 x 10 pixels around where its anchor is seen.
    static Label label(const glm::dvec3& anchor) {
        return {"a", anchor, {{-10, -5}, {10, 5}}, {-10, -5}};
    }
    // The world's x of a pixel's column.
    static double column(double pixels) { return (pixels - 200) / 200 * 4 * 0.4 * 400 / 300; }
};

TEST_F(Places, AreInThePictureApartFromWhatIsTakenAndOffLines) {
    EXPECT_EQ(sights_.count(), 1u);
    const std::vector<PixelRect> taken = {{{230, 100}, {260, 200}}};
    LabelPlaces places(sights_, {400, 300}, taken);
    EXPECT_TRUE(places.fits(label({0, 0, 0}), 2, 19));
    EXPECT_FALSE(places.fits(label({0, 0, 0}), 2, 21)) << "30 pixels from the middle, 20 from it";
    EXPECT_TRUE(places.fits(label({column(15), 0, 0}), 4, 0));
    EXPECT_FALSE(places.fits(label({column(15), 0, 0}), 6, 0)) << "5 pixels from the edge";
    EXPECT_FALSE(places.fits(label({0, -8, 0}), 0, 0)) << "behind the eye";
    places.takeLine({column(180), 0, -0.5}, {column(180), 0, 0.5});
    EXPECT_FALSE(places.fits(label({column(185), 0, 0}), 0, 0));
    EXPECT_TRUE(places.fits(label({column(195), 0, 0}), 0, 0));
    places.take(label({0, 0, 0}));
    EXPECT_FALSE(places.fits(label({column(212), 0, 0}), 0, 0));
    places.takeTick({column(100), 0, 0}, {0, 30});
    EXPECT_FALSE(places.fits(label({column(105), 0, 0}), 0, 0));
}

// What one eye sees is the middle, however its picture is shifted; of two, what both share is.
TEST_F(Places, AreOfTheShiftThatBothEyesHave) {
    View eye = view_;
    eye.clipFromView[2] = {60.0 / 200, 30.0 / 150, eye.clipFromView[2].z, -1};
    const Middle shifted{{0, -4, 0}, glm::dvec2(eye.clipFromView[2])};
    EXPECT_EQ(Sights(eye, shifted, glm::dvec3(0.5)).count(), 1u);
    eye.clipFromView[2][0] = 100.0 / 200;
    const Sights both(eye, shifted, glm::dvec3(0.5));
    ASSERT_EQ(both.count(), 3u);
    const std::array columns = {140.0, 100.0, 180.0};
    for (std::size_t sight = 0; sight < columns.size(); ++sight) {
        const glm::dvec2 seen = both.pixel(sight, {0, 0, 0});
        EXPECT_NEAR(seen.x, columns[sight], 1e-9);
        EXPECT_NEAR(seen.y, 150 + 30, 1e-9);
    }
}

// A place 40 pixels to one side for this eye is 40 to the other for the other eye.
TEST_F(Places, WithTwoEyesAreFreeForBoth) {
    View eye = view_;
    eye.clipFromView[2][0] = 40.0 / 200;
    const Sights both(eye, {{0, -4, 0}}, glm::dvec3(0.5));
    ASSERT_EQ(both.count(), 3u);
    EXPECT_NEAR(both.pixel(1, {0, 0, 0}).x - 200, -40, 1e-9);
    EXPECT_NEAR(both.pixel(2, {0, 0, 0}).x - 200, 40, 1e-9);
    for (const double at : {200.0, 160.0, 240.0, 100.0}) {
        const std::vector<PixelRect> taken = {{{at - 8, 140}, {at + 8, 160}}};
        const LabelPlaces places(both, {400, 300}, taken);
        EXPECT_EQ(places.fits(label({0, 0, 0}), 0, 0), at == 100) << at;
    }
    // Two labels, seen at one place by different eyes, never meet.
    const LabelPlaces places(both, {400, 300}, {});
    EXPECT_TRUE(places.apart(label({column(180), 0, 0}), label({column(220), 0, 0}), 5));
}

}  // namespace
}  // namespace render
