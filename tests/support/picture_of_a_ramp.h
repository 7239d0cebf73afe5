// A ramp of values and what a reader would say of it, for tests of its pictures.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/choices/choice_text.h"
#include "app/picture/picture.h"
#include "app/picture/resolved.h"
#include "tests/support/scenes.h"
#include "tests/support/sorted.h"

namespace app::ramp {

using timeseries::RangeSet;
using timeseries::SortedStep;

// Values 0, 1, ..., 999 on 10^3 points in grid order, and what a reader would say of them.
class PictureOfARamp : public testing::Test {
 protected:
    static std::shared_ptr<const SortedStep> ramp(double first, const RangeSet& kept) {
        std::vector<float> values(1000);
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = static_cast<float>(first + static_cast<double>(i));
        return std::make_shared<const SortedStep>(
            tests::sorted({tests::cube(10), std::move(values), {}}, kept));
    }
    PictureOfARamp() {
        about_.name = "T";
        about_.longName = "temperature";
        about_.units = "K";
        about_.grid = step_->sharedGrid();
        about_.time = std::make_shared<const timeseries::TimeAxis>(
            timeseries::TimeAxis{"time", "s", "", {{0, ""}, {0.5, ""}, {1, ""}}});
    }
    Picture pictureOf(const Explorer& e, std::int64_t tick = 0) const {
        return makePicture(resolved(e, steps_), about_, 1, *step_, placed_, tick);
    }
    static Explorer withRanges(const std::vector<const char*>& ranges) {
        Explorer e;
        e.model = Model::Points;
        for (const char* range : ranges) e.layers.push_back({RangeSet::parse(range), {}, {}});
        return e;
    }

    std::shared_ptr<const SortedStep> step_ = ramp(0, RangeSet::everything());
    Steps steps_{{1, step_}};
    render::PlacedPoints placed_{step_->grid()};
    timeseries::Variable about_;
};

}  // namespace app::ramp
