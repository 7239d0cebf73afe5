// Cells of interest on a ray, met by way of bricks.
#include "render/reference/sparse_walk.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "tests/support/cell_worlds.h"

namespace render {
namespace {

struct Visit {
    glm::uvec3 cell;
    double from, to;
};

class SparseWalks {
 public:
    explicit SparseWalks(const std::array<std::size_t, 3>& size, double share)
        : world_(tests::noise(std::make_shared<timeseries::Grid>(
                     std::array{uneven(size[0], 1), uneven(size[1], -0.7), uneven(size[2], 1)})),
                 {"0:0.5"}),
          all_(world_.placed),
          share_(share),
          sparse_(all_, [&](const glm::uvec3& cell) { return isIn(cell); }) {}

    // Of cells of interest, by each cell in turn and by bricks.
    std::array<std::vector<Visit>, 2> visits(const glm::dvec3& eye, const glm::dvec3& along,
                                             double near) const {
        std::array<std::vector<Visit>, 2> met;
        all_(eye, along, near, [&](const glm::uvec3& cell, double from, double to) {
            if (isIn(cell)) met[0].push_back({cell, from, to});
        });
        sparse_(eye, along, near, [&](const glm::uvec3& cell, double from, double to) {
            ++asked_;
            if (isIn(cell)) met[1].push_back({cell, from, to});
        });
        return met;
    }
    std::size_t asked() const { return asked_; }
    const SparseWalk& sparse() const { return sparse_; }
    PlacedPoints::Box space() const { return world_.placed.domain(); }

 private:
    timeseries::Axis uneven(std::size_t count, double step) {
        timeseries::Axis axis = tests::axis(count, 3, step);
        for (double& at : axis.coordinates) at += 0.3 * step * side_(random_);
        return axis;
    }
    // A few bricks that are full, and single cells.
    bool isIn(const glm::uvec3& cell) const {
        const auto drawn = [](const glm::uvec3& of) {
            return static_cast<double>((of.x * 73856093u ^ of.y * 19349663u ^ of.z * 83492791u) %
                                       1000u) /
                   1000;
        };
        return drawn(cell / 8u) < share_ || drawn(cell) < share_ / 100;
    }

    std::mt19937 random_{7};
    std::uniform_real_distribution<double> side_{-1, 1};
    tests::CellWorld world_;
    CellWalk all_;
    double share_;
    SparseWalk sparse_;
    mutable std::size_t asked_ = 0;
};

TEST(SparseWalk, MeetsWhatAWalkThroughAllCellsMeets) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> side(-1, 1);
    for (const std::array<std::size_t, 3>& size :
         {std::array<std::size_t, 3>{40, 33, 21}, {100, 3, 1}, {7, 8, 64}})
        for (const double share : {0.0, 0.1, 1.0}) {
            const SparseWalks walks(size, share);
            const glm::dvec3 lo(walks.space().lo), hi(walks.space().hi);
            std::size_t met = 0;
            for (int i = 0; i < 2000; ++i) {
                const double far = std::array{0.3, 0.9, 4.0}[static_cast<std::size_t>(i) % 3];
                glm::dvec3 eye, through;
                for (int a = 0; a < 3; ++a) {
                    eye[a] = std::lerp(lo[a], hi[a], 0.5 + far * side(random));
                    through[a] = std::lerp(lo[a], hi[a], 0.5 + 0.5 * side(random));
                }
                glm::dvec3 along = through - eye;
                // Along planes and lines of the grid, too.
                for (int a = 0; a < i % 5 - 2; ++a) along[(i + a) % 3] = 0;
                const auto [one, other] = walks.visits(eye, along, i % 7 == 0 ? 0.4 : 0);
                ASSERT_EQ(one.size(), other.size());
                for (std::size_t k = 0; k < one.size(); ++k) {
                    EXPECT_EQ(one[k].cell, other[k].cell);
                    EXPECT_NEAR(one[k].from, other[k].from, 1e-12);
                    EXPECT_NEAR(one[k].to, other[k].to, 1e-12);
                }
                met += one.size();
            }
            EXPECT_EQ(met > 1000, share > 0);
            EXPECT_EQ(walks.asked() > 0, share > 0);
        }
}

TEST(SparseWalk, EndsWhereItIsTold) {
    const SparseWalks walks({40, 40, 40}, 1);
    const glm::dvec3 lo(walks.space().lo), hi(walks.space().hi);
    for (const int most : {1, 20}) {
        int met = 0;
        EXPECT_FALSE(
            walks.sparse()(lo - (hi - lo), hi - lo, 0,
                           [&](const glm::uvec3&, double, double) { return ++met < most; }));
        EXPECT_EQ(met, most);
    }
    EXPECT_TRUE(walks.sparse()(lo - (hi - lo), hi - lo, 0,
                               [](const glm::uvec3&, double, double) { return true; }));
}

}  // namespace
}  // namespace render
