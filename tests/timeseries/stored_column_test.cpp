#include "timeseries/index/stored_column.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "tests/support/random_field.h"
#include "tests/support/scenes.h"
#include "tests/support/step_bytes.h"

namespace timeseries {
namespace {

using Asked = std::vector<std::pair<std::uint64_t, std::uint64_t>>;  // where, and how many bytes

class Asking final : public tests::BytesRead {
 public:
    Asking(std::vector<std::byte> bytes, Asked& asked)
        : BytesRead(std::move(bytes)), asked_(asked) {}
    void willNeed(std::uint64_t at, std::uint64_t bytes) const override {
        asked_.emplace_back(at, bytes);
    }

 private:
    Asked& asked_;
};

TEST(StoredColumn, AsksForTheBytesOfBlocksThatAreNotThereAndForNoOthers) {
    const auto grid = tests::gridOf({64, 64, 64});
    const SortedStep step = tests::stepOf(
        grid, [](std::size_t i) { return std::sin(static_cast<float>(i * i % 7919) * 0.01f); });
    Asked asked;
    const auto file = std::make_shared<const StepFile>(
        std::make_unique<const Asking>(tests::written(step), asked));
    const auto blocks = file->blocks();
    ASSERT_EQ(blocks.size(), 8u);
    const auto column = storedColumn<float>(file, {}, 2);
    column->order({3 * kStepBlock, 1});
    EXPECT_EQ(asked, (Asked{{blocks[3].idsAt, blocks[3].idsBytes},
                            {blocks[3].keysAt, blocks[3].keysBytes}}));
    asked.clear();
    column->order({2 * kStepBlock + 7, 3 * kStepBlock});  // of blocks 2 to 5
    // The ids of neighbours lie together, and so do their keys.
    EXPECT_EQ(asked, (Asked{{blocks[2].idsAt, blocks[2].idsBytes},
                            {blocks[2].keysAt, blocks[2].keysBytes},
                            {blocks[4].idsAt, blocks[4].idsBytes + blocks[5].idsBytes},
                            {blocks[4].keysAt, blocks[4].keysBytes + blocks[5].keysBytes}}));
    asked.clear();
    column->order({2 * kStepBlock, 4 * kStepBlock});
    EXPECT_TRUE(asked.empty());
}

TEST(StoredColumn, AsksForNothingWhereBlocksHaveNothing) {
    const auto grid = tests::gridOf({64, 64, 16});  // two blocks of one value, which need no keys
    const SortedStep step = tests::stepOf(grid, [](std::size_t) { return 1; });
    Asked asked;
    const auto file = std::make_shared<const StepFile>(
        std::make_unique<const Asking>(tests::written(step), asked));
    const auto blocks = file->blocks();
    ASSERT_EQ(blocks.size(), 2u);
    ASSERT_EQ(blocks[0].keysBytes, 0u);
    storedColumn<float>(file, {}, 1)->orderAll();
    EXPECT_EQ(asked, (Asked{{blocks[0].idsAt, blocks[0].idsBytes + blocks[1].idsBytes}}));
}

}  // namespace
}  // namespace timeseries
