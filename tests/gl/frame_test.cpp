// Whole frames: two eyes are one list drawn twice, and pictures are what the truth resolves to.
#include "render/frame/frame.h"
#include "render/reference/exact_order.h"
#include "render/splat/depth_order.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "render/image/encode_srgb.h"
#include "render/reference/cpu_splatter.h"
#include "render/reference/image_compare.h"
#include "render/splat/tile_splatter.h"
#include "tests/support/frame_world.h"
#include "tests/support/measured_axis.h"
#include "tests/support/scenes.h"

namespace render {
namespace {

using timeseries::RangeSet;

using tests::FrameWorld;

// Drawn by GL, by the program and in double.
class Frame : public FrameWorld, public testing::TestWithParam<SplatterChoice> {
 protected:
    std::vector<EyePicture> draw(const std::vector<View>& eyes, const Extras& extras = {}) {
        return renderer_.render(content(), onGpu_, eyes, extras);
    }
    FrameRenderer renderer_{GetParam()};
};

class FrameInMemory : public FrameWorld, public testing::Test {
 protected:
    FrameRenderer renderer_{SplatterChoice::Cpu};
};

TEST_P(Frame, TwoEyesAreOneListOrderedAndUploadedOnce) {
    // Selecting is over before: a Scene holds runs, and nothing that draws it knows a range.
    for (const Order order : {Order::None, Order::BackToFront}) {
        scene_.order = order;
        const auto before = renderer_.counts();
        draw({left_, right_});
        EXPECT_EQ(renderer_.counts().orders - before.orders, 1u);
        EXPECT_EQ(renderer_.counts().eyes - before.eyes, 2u);
    }
}

TEST_P(Frame, EyesAtOnePlaceSeeTheSameBits) {
    for (const Order order : {Order::None, Order::BackToFront}) {
        scene_.order = order;
        const auto pictures = draw({left_, left_});
        EXPECT_EQ(pictures[0].image, pictures[1].image);
        EXPECT_NE(pictures[0].image, draw({right_})[0].image) << "or nothing was compared";
    }
}

// A white volume fills the picture; around the legend's letters there is its ground.
TEST_P(Frame, TheLegendStandsOnAGroundBeforeABrightVolume) {
    scene_.layers = {{step_.select(RangeSet::everything()), {Constant{glm::vec3(1)}, 0.9}}};
    View near = tests::lookFrom({0.1, -1.2, 0}, {400, 320});
    const Legend legend{"Temperature (K)", "step 3 of 9", {}, {"a note below"}};
    const Image plain = renderer_.render(content(), onGpu_, std::array{near})[0].image;
    FrameContent told = content();
    told.legend = legend;
    const Image picture = renderer_.render(told, onGpu_, std::array{near})[0].image;
    const Font font(std::array{labelStyle(near.size), titleStyle(near.size)});
    const FlatMesh texts = legendMesh(legend, font, near.size);
    for (const PixelRect& text : texts.covers()) {
        float least = 1, before = 0;  // without a legend, a line or a name may stand there
        for (int y = static_cast<int>(text.lo.y); y < static_cast<int>(text.hi.y); ++y)
            for (int x = static_cast<int>(text.lo.x); x < static_cast<int>(text.hi.x); ++x) {
                least = std::min(least, picture.at(x, y).g);
                before = std::max(before, plain.at(x, y).g);
            }
        EXPECT_GT(before, 0.9f) << "or nothing was tested";
        EXPECT_LT(least, 0.15f);
    }
}

// The most that is drawn beyond what was asked for.
constexpr std::uint64_t kPiece = std::max(kPiecePoints, TileSum::kLeast + kSubsetUnevenness);

// 64,000 points: pieces of two layers in two blocks.
TEST_P(Frame, AnEyeDrawnBitByBitIsTheSameBitForBit) {
    const timeseries::SortedStep step = tests::noise(tests::cube(40));
    const PlacedPoints placed(step.grid());
    GlStep onGpu(step, placed);
    for (const Order order : {Order::None, Order::BackToFront})
        // From outside by point sprites, from inside by quads.
        for (const glm::dvec3 from : {glm::dvec3(-0.05, -3, 0), glm::dvec3(0.2, 0.1, 0.3)}) {
            const Scene scene{
                .step = step,
                .placed = placed,
                .layers = {{step.select(RangeSet::parse("0.1:0.3,0.6:0.9")),
                            {ByValue{{}, 0, 1}, 0.3}},
                           {step.select(RangeSet::parse("0.7:0.8")), {Constant{{1, 0, 0}}, 0.2}}},
                .footprint = {},
                .order = order,
                .clip = {}};
            const FrameContent content{scene, step.grid(), {}, glm::dvec3(0.02)};
            const std::array eyes{tests::lookFrom(from, {120, 90})};
            const Image expected = renderer_.render(content, onGpu, eyes)[0].image;
            // A list made before, for the program's tiles put all of theirs in order at once.
            const auto frame =
                GetParam() == SplatterChoice::Cpu
                    ? renderer_.prepare(content, onGpu, eyes, render::order(scene, midEye(eyes)))
                    : renderer_.prepare(content, onGpu, eyes);
            const double cost = renderer_.cost(frame, eyes[0]);
            for (const double atOnce : {1.0, 20'000.0, cost}) {
                auto work = renderer_.begin(frame, eyes[0]);
                const double piece = kPiece * *std::ranges::max_element(work.splatCosts);
                double before = 0, calls = 1;
                for (; !renderer_.goOn(work, atOnce); ++calls) {
                    EXPECT_GT(work.cost, before) << "one piece at least";
                    EXPECT_LE(work.cost - before, atOnce + piece);
                    before = work.cost;
                }
                EXPECT_NEAR(work.cost, cost, 1e-9 * cost);
                EXPECT_GE(calls, std::floor(cost / (atOnce + piece)));
                EXPECT_EQ(renderer_.targets().readLight(), expected) << atOnce << " at a time";
            }
            // To a time that has come nothing is drawn; to one that comes, a part or all.
            auto work = renderer_.begin(frame, eyes[0]);
            const double begun = work.cost;
            EXPECT_FALSE(renderer_.goOn(work, cost, FrameRenderer::Clock::now()));
            EXPECT_EQ(work.cost, begun);
            using namespace std::chrono_literals;
            while (!renderer_.goOn(work, cost, FrameRenderer::Clock::now() + 1ms))
                EXPECT_LT(work.cost, (1 + 1e-9) * cost);
            EXPECT_EQ(renderer_.targets().readLight(), expected) << "by the clock";
        }
}

TEST_P(Frame, ResolvedColoursAreTheTruths) {
    for (const Order order : {Order::None, Order::BackToFront}) {
        scene_.order = order;
        Accumulator<double> sums(left_.size, channelsFor(scene_));
        splat(scene_, orderExactly(scene_, pixelRays(left_).eye), left_, {}, sums);
        // The same picture without splats is the ground that they stand before.
        const Image drawn = draw({left_})[0].image;
        const std::vector<Layer> layers = std::move(scene_.layers);
        scene_.layers = {};
        const Image ground = draw({left_})[0].image;
        scene_.layers = layers;
        Image expected(left_.size);
        for (int y = 0; y < left_.size.y; ++y)
            for (int x = 0; x < left_.size.x; ++x) {
                const Resolved r = resolvePixel(sums, layers, x, left_.size.y - 1 - y);
                expected.at(x, y) = glm::vec4(glm::dvec4(r.rgb, r.alpha) +
                                              (1 - r.alpha) * glm::dvec4(ground.at(x, y)));
            }
        // Where the box's thin lines stand, some splats are behind them: a few pixels differ more.
        const PictureError error = comparePictures(drawn, expected, 1e-4);
        EXPECT_LE(error.differingPixels, 200 * 160 / 20);
        EXPECT_GE(error.psnrLinear, 40);
    }
}

TEST_P(Frame, OneColourDoesNotDependOnTheOrderOfDrawing) {
    // A constant layer drawn by runs and drawn back to front: the same light to float rounding.
    scene_.layers.pop_back();
    const Image runs = draw({left_})[0].image;
    scene_.order = Order::BackToFront;
    EXPECT_LE(comparePictures(draw({left_})[0].image, runs).maxAbsolute, 2e-5);
}

// What nothing opaque hides, in double; row 0 at the top.
struct Data {
    std::vector<double> opticalDepth, count;
};
Data truthOf(Scene scene, const View& view) {
    scene.order = Order::None;
    Accumulator<double> sums(view.size, channelsFor(scene)), counts(view.size, {Channels::Count});
    splat(scene, Runs{}, view, {}, sums);
    splat(scene, Runs{}, view, {}, counts);
    Data data;
    for (int y = view.size.y - 1; y >= 0; --y)
        for (int x = 0; x < view.size.x; ++x) {
            data.opticalDepth.push_back(resolvePixel(sums, scene.layers, x, y).opticalDepth);
            data.count.push_back(counts.planes[0][std::size_t(y) * view.size.x + x]);
        }
    return data;
}

double sum(const auto& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

void expectTruth(const EyePicture& drawn, const Data& truth) {
    EXPECT_LE(compareScalars(drawn.opticalDepth, truth.opticalDepth).relativeL2, 1e-5);
    const double mass = sum(truth.opticalDepth);
    ASSERT_GT(mass, 0) << "or nothing was compared";
    EXPECT_NEAR(sum(drawn.opticalDepth), mass, 1e-5 * mass);
    // A pixel on a footprint's very border may fall to either side in float.
    EXPECT_LE(compareScalars(drawn.splatCount, truth.count).relativeL2, 1e-3);
}

// Also where lines of the box stand before splats: on its faces there are some that lie behind.
TEST_P(Frame, ChannelsOfDataAreTheTruthsOnEveryPixelOrderedOrNot) {
    for (const glm::dvec3 from : {glm::dvec3(-0.05, -3, 0), glm::dvec3(1.5, -2, 1)}) {
        const View view = tests::lookFrom(from, {200, 160});
        const Data truth = truthOf(scene_, view);
        for (const Order order : {Order::None, Order::BackToFront}) {
            scene_.order = order;
            expectTruth(draw({view}, {.opticalDepth = true, .splatCount = true})[0], truth);
        }
    }
}

TEST_P(Frame, ChannelsOfDataAreTheTruthsWhereCellsAreAThousandTimesAsLongAsWide) {
    const timeseries::Grid grid({tests::axis(12), tests::axis(10), tests::axis(8, 0, 1000)});
    const auto step = tests::noise(std::make_shared<timeseries::Grid>(grid));
    const PlacedPoints placed(grid);
    GlStep onGpu(step, placed);
    const Scene scene{
        .step = step,
        .placed = placed,
        .layers = {{step.select(RangeSet::parse("0:0.5")), {Constant{{1, 0.2, 0}}, 0.2}}},
        .footprint = {},
        .order = Order::None,
        .clip = {}};
    const FrameContent content{scene, grid, {}, glm::dvec3(0)};
    const View view = tests::lookFrom({1.5, -2, 1}, {200, 160});
    const auto pictures = renderer_.render(content, onGpu, std::array{view},
                                           {.opticalDepth = true, .splatCount = true});
    expectTruth(pictures[0], truthOf(scene, view));
}

// The picture does not depend on whether data is asked for, nor the second eye's data on the first.
TEST_P(Frame, ChannelsOfDataLeaveThePictureAlone) {
    const auto plain = draw({left_, right_});
    const auto both = draw({left_, right_}, {.opticalDepth = true, .splatCount = true});
    const auto right = draw({right_}, {.opticalDepth = true, .splatCount = true});
    EXPECT_EQ(both[0].image, plain[0].image);
    EXPECT_EQ(both[1].image, plain[1].image);
    EXPECT_EQ(both[1].opticalDepth, right[0].opticalDepth);
    EXPECT_EQ(both[1].splatCount, right[0].splatCount);
}

TEST_P(Frame, ManyLayersUpToTheLimitAreDrawn) {
    scene_.layers.clear();
    for (std::size_t i = 0; i < kMaxLayers; ++i) {
        const double lo = static_cast<double>(i) / 10;
        const RangeSet range(std::vector{timeseries::Range{{lo}, {lo + 0.05}}});
        scene_.layers.push_back({step_.select(range), {Constant{glm::dvec3(1)}, 0.2}});
    }
    const Image all = draw({left_})[0].image;
    scene_.layers.pop_back();
    EXPECT_NE(draw({left_})[0].image, all) << "the last layer counts";
}

TEST_P(Frame, PicturesOfAnotherSizeFollow) {
    draw({left_});
    const View larger = tests::lookFrom({0, -3, 0}, {256, 300});
    EXPECT_EQ(draw({larger})[0].image.size, glm::ivec2(256, 300));
}

// What stands around the points, and the light that they are resolved to, by two ways that share
// nothing. Drivers place corners on 1/256 of a pixel: soft edges differ by that.
TEST_P(Frame, LinesLabelsAndLegendAreTheSameByGlAndByTheProgram) {
    FrameRenderer other(GetParam() == SplatterChoice::Gl ? SplatterChoice::Cpu
                                                         : SplatterChoice::Gl);
    FrameContent told = content();
    told.legend = {"Temperature (K)",
                   "step 3 of 9",
                   {{scene_.layers[0].style, "0.1:0.2", "80 points"},
                    {scene_.layers[1].style, "0.7:0.9", "160 points"}},
                   {"a note below"}};
    const std::array eyes{tests::lookFrom({-1, -2.2, 0.9}, {420, 330}),
                          tests::lookFrom({0.2, 0.1, 0.3}, {420, 330})};  // and from inside
    for (const Order order : {Order::None, Order::BackToFront}) {
        scene_.order = order;
        const auto here = renderer_.render(told, onGpu_, eyes),
                   there = other.render(told, onGpu_, eyes);
        for (std::size_t i = 0; i < eyes.size(); ++i) {
            const PictureError error = comparePictures(here[i].image, there[i].image, 0.004);
            EXPECT_LE(error.differingPixels, 420 * 330 / 500) << "eye " << i;
            EXPECT_LE(error.maxAbsolute, 0.06);
            EXPECT_GE(error.psnrLinear, 60);
        }
    }
}

// For a window: the bytes are those of the light that is read, frame after frame.
TEST_F(FrameInMemory, LightAsBytesIsTheLightEncoded) {
    FrameRenderer toShow(SplatterChoice::Cpu, LightAs::Srgb8);
    const View aside = tests::lookFrom({9, 4, -2}, left_.size);
    for (const auto& [view, ground] :
         {std::pair(left_, 0.1), std::pair(aside, 0.1), std::pair(left_, 0.6)}) {
        const std::array eyes{view};
        FrameContent of = content();
        of.background = glm::dvec3(ground);
        const Image light = renderer_.render(of, onGpu_, eyes)[0].image;
        toShow.drawEye(toShow.prepare(of, onGpu_, eyes), view);
        const auto bytes = toShow.targets().srgb8();
        ASSERT_EQ(bytes.size(), 4u * 200 * 160);
        for (std::size_t y = 0; y < 160; ++y) {
            std::vector<std::uint8_t> expected(std::size_t(4) * 200);
            encodeSrgb8(std::span(&light.at(0, static_cast<int>(159 - y)).x, expected.size()),
                        expected);
            EXPECT_TRUE(
                std::ranges::equal(bytes.subspan(y * expected.size(), expected.size()), expected))
                << y;
        }
        EXPECT_EQ(toShow.render(of, onGpu_, eyes)[0].image, light) << "when read all the same";
    }
}

// For a headset's swapchain.
TEST_F(FrameInMemory, OnGlThereIsTheSameLightAndDepth) {
    const std::array eyes{left_};
    renderer_.drawEye(renderer_.prepare(content(), onGpu_, eyes), left_);
    Targets& memory = renderer_.targets();
    std::vector<float> room;
    const std::span<const float> depth = memory.opaqueDepth(room);
    EXPECT_LT(*std::ranges::min_element(depth), 1) << "lines behind the volume";
    GlTargets& onGl = memory.onGl();
    EXPECT_EQ(onGl.readLight(), memory.readLight());
    std::vector<float> read;
    EXPECT_TRUE(std::ranges::equal(onGl.opaqueDepth(read), depth));
}

// Noise on a shell, by points and by cells, beside what double draws; and of what lies behind the
// Earth alone nothing.
TEST_P(Frame, AGlobeIsTheTruthsAndItsEarthHidesTheFarSide) {
    const auto grid = std::make_shared<const timeseries::Grid>(
        std::array{tests::measuredAxis("lon", "degrees_east", 0, 355, 72),
                   tests::measuredAxis("lat", "degrees_north", -87.5, 87.5, 36),
                   tests::measuredAxis("level", "1", 0, 4, 5)});
    const auto noise = tests::noise(grid);
    const auto halves =
        tests::stepOf(grid, [&](std::size_t i) { return grid->position(i).x < 180 ? 1 : 2; });
    const PlacedPoints placed(*grid, {}, Map::Globe);
    const View view = tests::lookFrom({0, -4, 0}, {200, 160}, 0.2);  // from longitude 270
    const auto pictureOf = [&](FrameRenderer& by, const timeseries::SortedStep& step,
                               const char* range, Order order, bool cells) {
        Scene scene{.step = step,
                    .placed = placed,
                    .layers = {{step.select(RangeSet::parse(range)), {ByValue{{}, 0, 1}, 0.4}}},
                    .footprint = {},
                    .order = order,
                    .clip = {}};
        if (cells) {
            scene.cells = step.cells();
            auto& of = scene.layers[0].cells;
            of.ranges = timeseries::betweenPoints(RangeSet::parse(range), step.type());
            of.candidates = scene.cells->select(of.ranges);
        }
        GlStep onGpu(step, placed);
        return by.render({scene, *grid, {}, glm::dvec3(0.02)}, onGpu, std::array{view})[0].image;
    };
    FrameRenderer exact(SplatterChoice::Exact);
    for (const Order order : {Order::None, Order::BackToFront})
        for (const bool cells : {false, true}) {
            const Image drawn = pictureOf(renderer_, noise, "0.6:1", order, cells),
                        truth = pictureOf(exact, noise, "0.6:1", order, cells);
            std::size_t apart = 0;  // where a splat's middle is beside the Earth's edge
            for (std::size_t i = 0; i < truth.pixels.size(); ++i)
                for (int c = 0; c < 3; ++c)
                    if (std::abs(drawn.pixels[i][c] - truth.pixels[i][c]) > 0.03f) ++apart;
            EXPECT_LT(apart, truth.pixels.size() / 200) << cells;
            const Image near = pictureOf(renderer_, halves, "2", order, cells),
                        far = pictureOf(renderer_, halves, "1", order, cells),
                        none = pictureOf(renderer_, halves, "3", order, cells);
            EXPECT_NE(near.at(97, 83), none.at(97, 83));
            EXPECT_EQ(far.at(97, 83), none.at(97, 83));
        }
}

INSTANTIATE_TEST_SUITE_P(By, Frame,
                         testing::Values(SplatterChoice::Gl, SplatterChoice::Cpu,
                                         SplatterChoice::Exact),
                         [](const auto& choice) { return tests::nameOf(choice.param); });

}  // namespace
}  // namespace render
