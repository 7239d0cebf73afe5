// Steps that are kept on disk, and made from there.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "tests/support/files.h"
#include "timeseries/readers/reader.h"
#include "timeseries/series/step_maker.h"

namespace tests {

// Each step of a variable is written once, and is the same from there.
inline void expectKept(const std::vector<std::filesystem::path>& files, std::size_t variable) {
    using namespace timeseries;
    const auto store =
        std::make_shared<StepStore>(testFolder() / "steps", StoreKind::Cache, StepStore::kNoBudget,
                                    std::chrono::milliseconds(0));
    const auto maker = [&] {
        return StepMaker(openReader(files), variable, RangeSet::everything(), {{store}, store, 1});
    };
    const auto reader = openReader(files);
    StepMaker writing = maker(), reading = maker();
    const std::size_t steps = reader->variables()[variable].time->points.size();
    for (std::size_t step = 0; step < steps; ++step) {
        SCOPED_TRACE(step);
        EXPECT_EQ(writing.keep(step), StepMaker::Kept::Written);
        const auto found = reading.make(step);
        ASSERT_TRUE(found->file());
        EXPECT_EQ(found->sharedGrid(), reading.variable().grid);
        const SortedStep expected = SortedStep::build(reader->read(variable, step));
        EXPECT_TRUE(std::ranges::equal(found->gridIndex(), expected.gridIndex()));
        ASSERT_EQ(found->size(), expected.size());
        for (std::uint64_t i = 0; i < found->size(); ++i)
            ASSERT_EQ(toText(found->value(i)), toText(expected.value(i))) << i;
    }
}

}  // namespace tests
