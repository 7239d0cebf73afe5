// Steps of n^3 points, one at a time in memory: 512^3 floats with their sorted list are 1.5 GiB.
#pragma once

#include <memory>

#include "render/model/scene.h"
#include "tests/bench/turbulence.h"
#include "tests/support/scenes.h"

namespace bench {

struct Volume {
    explicit Volume(std::size_t n)
        : points(n),
          field(turbulence<float>(n)),
          step(timeseries::SortedStep::build(field)),
          placed(*field.grid) {}
    const std::vector<float>& values() const { return std::get<std::vector<float>>(field.values); }

    // The range of values about the median that holds this share of the points.
    timeseries::Range range(double share) const {
        const auto half = static_cast<std::uint64_t>(static_cast<double>(step.size()) * share / 2);
        const auto at = [&](std::uint64_t p) { return timeseries::toDouble(step.value(p)); };
        const std::uint64_t middle = step.size() / 2;
        return {{at(middle - half)}, {at(std::min(middle + half, step.size() - 1))}};
    }
    timeseries::RangeSet rangeSet(double share) const {
        return timeseries::RangeSet(std::vector{range(share)});
    }
    // Of that range, in one colour; seen from outside, the whole volume in the picture.
    render::Scene scene(double share) const {
        return {.step = step,
                .placed = placed,
                .layers = {{step.select(rangeSet(share)), {render::Constant{{1, 0.5, 0.1}}, 0.3}}},
                .footprint = {},
                .order = render::Order::None,
                .clip = {}};
    }

    std::size_t points;  // along an axis
    timeseries::Field field;
    timeseries::SortedStep step;
    render::PlacedPoints placed;
};

// The volume of this size, made unless it is the last one that was asked for.
inline const Volume& volume(std::size_t n) {
    static std::unique_ptr<Volume> last;
    if (!last || last->points != n) {
        last.reset();
        last = std::make_unique<Volume>(n);
    }
    return *last;
}

constexpr glm::ivec2 kPicture{1024, 1024};
inline render::View outside() { return tests::lookFrom({1, -3, 1}, kPicture); }

}  // namespace bench
