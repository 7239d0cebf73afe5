// A mesh that is turned, or mirrored, with the eye: the same picture, or its mirror image.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "render/splat/depth_order.h"
#include "render/splat/tile_splatter.h"
#include "tests/support/cell_worlds.h"
#include "tests/support/meshes.h"

namespace render {
namespace {

using tests::CellWorld;

constexpr glm::ivec2 kSize{72, 60};

// Bent, and with a hole.
glm::dvec3 bent(double i, double j, double k) {
    if (i == 4 && j == 3 && k == 2) return glm::dvec3(std::nan(""));
    return {i + 0.3 * std::sin(j), 1.3 * j + 0.1 * k * k, 0.8 * k + 0.05 * i * j};
}
using Moved = std::function<glm::dvec3(const glm::dvec3&)>;

CellWorld worldOf(const Moved& moved, const char* range, Order order) {
    const auto grid = tests::curvilinear(
        {8, 7, 6}, [&](double i, double j, double k) { return moved(bent(i, j, k)); });
    CellWorld world(tests::stepOf(grid,
                                  [](std::size_t i) {
                                      return std::sin(0.7 * double(i % 8)) +
                                             std::cos(0.9 * double(i / 8 % 7)) +
                                             0.2 * double(i / 56);
                                  }),
                    {range});
    world.scene.order = order;
    world.scene.layers[0].style.color = ByValue{{}, -1, 2};
    return world;
}

std::vector<float> pictureOf(const CellWorld& world, const View& view, bool byCells) {
    Scene scene = world.scene;
    const Channels channels = channelsFor(scene)[0];
    if (byCells) return tests::drawn(scene, view, channels);
    scene.cells = nullptr;
    const DrawList list =
        scene.order == Order::None ? DrawList(Runs{}) : order(scene, pixelRays(view).eye);
    return sumTiles(scene, list, view, channels, 0, {});
}

std::vector<float> mirrored(std::vector<float> picture) {
    const std::size_t floats = picture.size() / std::size_t(kSize.x * kSize.y),
                      row = floats * kSize.x;
    std::vector<float> out(picture.size());
    for (std::size_t i = 0; i < picture.size(); ++i) {
        const std::size_t x = i % row / floats;
        out[i] = picture[i / row * row + (std::size_t(kSize.x) - 1 - x) * floats + i % floats];
    }
    return out;
}

void expectAlike(const std::vector<float>& a, const std::vector<float>& b, double error) {
    const float most = *std::ranges::max_element(a);
    ASSERT_GT(most, 0);
    double sum = 0, apart = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += double(a[i]) * a[i];
        apart += (double(a[i]) - b[i]) * (double(a[i]) - b[i]);
    }
    EXPECT_LT(std::sqrt(apart / sum), error);
}

TEST(TurnedMesh, IsTheSamePictureAndAMirroredOneItsMirrorImage) {
    const Moved stays = [](const glm::dvec3& p) { return p; };
    const Moved turns = [](const glm::dvec3& p) { return glm::dvec3(-p.y, p.x, p.z); };
    const Moved mirrors = [](const glm::dvec3& p) { return glm::dvec3(-p.x, p.y, p.z); };
    const glm::dvec3 from(1.1, -2.2, 0.9);
    for (const Order order : {Order::None, Order::BackToFront})
        for (const char* range : {"min:max", "0.5:1.2", "0.8:0.81"})
            for (const bool byCells : {false, true}) {
                SCOPED_TRACE(testing::Message() << range << (byCells ? " by cells" : " by points")
                                                << (order == Order::None ? "" : ", in order"));
                const auto picture = [&](const Moved& moved) {
                    return pictureOf(worldOf(moved, range, order),
                                     tests::lookFrom(moved(from), kSize), byCells);
                };
                const std::vector<float> is = picture(stays);
                if (!byCells && std::ranges::max(is) == 0) continue;  // no point in a thin range
                expectAlike(is, picture(turns), 1e-3);
                // Cells are seen a few thousandths of a pixel beside the middle (besideFaces).
                expectAlike(is, mirrored(picture(mirrors)), byCells ? 1e-2 : 1e-3);
            }
}

}  // namespace
}  // namespace render
