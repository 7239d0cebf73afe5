// Cells put in order of depth by the GPU.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <vector>

#include "render/gl/headless_context.h"
#include "render/splat/gl_cells.h"
#include "render/splat/gl_piece_order.h"
#include "tests/support/gl_buffers.h"

namespace render {
namespace {

class GlPieceOrdering : public testing::Test {
 protected:
    gl::HeadlessContext context_;
    GlPieceOrder order_;

    std::vector<std::uint32_t> ordered(const std::vector<GlCell>& pieces, const glm::uvec3& size,
                                       const glm::uvec3& eye) {
        const gl::Buffer buffer{std::span<const GlCell>(pieces)};
        const auto count = static_cast<std::uint32_t>(pieces.size());
        const auto places = order_(CellsToOrder{count, size, buffer}, eye);
        return tests::contentsOf<std::uint32_t>(*places, pieces.size());
    }
};

// Whether a ray from the eye's cell may meet a before b.
bool mayHide(const glm::ivec3& a, const glm::ivec3& b, const glm::ivec3& eye) {
    for (int k = 0; k < 3; ++k) {
        const int toA = a[k] - eye[k], toB = b[k] - eye[k];
        if (std::abs(toA) > std::abs(toB)) return false;
        if (toA != 0 && (toA < 0) != (toB < 0)) return false;
    }
    return true;
}

// Also of grids so long that bricks of cells would have keys beyond 32 bits.
TEST_F(GlPieceOrdering, NoCellIsDrawnBeforeOneThatItHides) {
    std::mt19937 random(5);
    const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
    for (const glm::uvec3& size :
         {glm::uvec3(12, 9, 10), glm::uvec3(70, 40, 33), glm::uvec3(1), glm::uvec3(1600),
          glm::uvec3(700'000, 3, 3), glm::uvec3(2, 2, 60'000'000)})
        for (int eyes = 0; eyes < 4; ++eyes) {
            glm::uvec3 eye(below(size.x), below(size.y), below(size.z));
            if (eyes == 0) eye = glm::uvec3(0);
            if (eyes == 1) eye = size - 1u;
            std::vector<GlCell> pieces(1500);
            for (std::size_t i = 0; i < pieces.size(); ++i) {
                const glm::uvec3 at(below(size.x), below(size.y), below(size.z));
                pieces[i].cell =
                    i % 5 == 4 ? pieces[i - 1].cell : at.x + size.x * (at.y + size.y * at.z);
            }
            const std::vector<std::uint32_t> list = ordered(pieces, size, eye);
            const auto cellOf = [&](std::uint32_t piece) {
                const std::uint32_t cell = pieces[piece].cell;
                return glm::ivec3(cell % size.x, cell / size.x % size.y, cell / size.x / size.y);
            };
            std::vector<bool> seen(pieces.size());
            for (std::size_t i = 0; i < list.size(); ++i) {
                ASSERT_LT(list[i], pieces.size());
                ASSERT_FALSE(seen[list[i]]) << "twice";
                seen[list[i]] = true;
                const glm::ivec3 later = cellOf(list[i]);
                for (std::size_t k = 0; k < i; ++k) {
                    const glm::ivec3 before = cellOf(list[k]);
                    if (before == later) {
                        ASSERT_GT(list[k], list[i]) << "of one cell the last comes first";
                    } else {
                        ASSERT_FALSE(mayHide(before, later, glm::ivec3(eye)))
                            << size.x << ' ' << size.z << ' ' << eyes;
                    }
                }
            }
        }
}

}  // namespace
}  // namespace render
