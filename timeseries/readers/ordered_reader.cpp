#include "timeseries/readers/ordered_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace timeseries {
namespace {

using Points = std::vector<TimePoint>;

bool ascends(const TimeAxis& time) {
    const auto isLater = [](const TimePoint& a, const TimePoint& b) { return b.value < a.value; };
    return time.counted || (std::ranges::adjacent_find(time.points, isLater) == time.points.end() &&
                            std::ranges::none_of(time.points, [](const TimePoint& each) {
                                return std::isnan(each.value);
                            }));
}

struct TimeOrder {
    std::vector<std::size_t> steps;
    std::string flaw;  // why there is none; "" where there is
};
TimeOrder orderOf(const Points& points) {
    TimeOrder order;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (std::isnan(points[i].value)) return {{}, fmt::format("step {} has none", i)};
        order.steps.push_back(i);
    }
    auto& steps = order.steps;
    std::ranges::stable_sort(
        steps, [&](std::size_t a, std::size_t b) { return points[a].value < points[b].value; });
    for (std::size_t i = 1; i < steps.size(); ++i)
        if (const double time = points[steps[i]].value; time == points[steps[i - 1]].value)
            return {{}, fmt::format("steps {} and {} both have {}", steps[i - 1], steps[i], time)};
    return order;
}

class OrderedReader final : public Reader {
 public:
    explicit OrderedReader(std::unique_ptr<Reader> file) : file_(std::move(file)) {
        const auto all = file_->variables();
        variables_.assign(all.begin(), all.end());
        steps_.resize(variables_.size());
        for (std::size_t v = 0; v < variables_.size(); ++v) order(v);
    }
    std::string format() const override { return file_->format(); }
    std::span<const std::filesystem::path> files() const override { return file_->files(); }
    std::span<const Variable> variables() const override { return variables_; }
    std::span<const DamagedVariable> damaged() const override { return file_->damaged(); }
    Field read(std::size_t variable, std::size_t step) override {
        return file_->read(variable, own(variable, step));
    }
    void readSlab(std::size_t variable, std::size_t step, const Slab& slab, Field& into) override {
        file_->readSlab(variable, own(variable, step), slab, into);
    }
    bool readsPlanes(std::size_t variable, std::size_t step) override {
        return file_->readsPlanes(variable, own(variable, step));
    }
    std::shared_ptr<const StepFile> sorted(std::size_t variable, std::size_t step) override {
        return file_->sorted(variable, own(variable, step));
    }
    StepSources sources(std::size_t variable, std::size_t step) override {
        return file_->sources(variable, own(variable, step));
    }
    StepGrids stepGrids(std::size_t variable) override { return file_->stepGrids(variable); }
    void expectToFit(std::size_t file) override { file_->expectToFit(file); }
    std::optional<StepSpan> stepsOf(std::size_t variable, std::size_t file) const override;

 private:
    void order(std::size_t v);
    std::size_t own(std::size_t variable, std::size_t step) const {
        const auto& steps = steps_[variable];
        return steps.empty() ? step : steps[step];
    }

    std::unique_ptr<Reader> file_;
    std::vector<Variable> variables_;
    std::vector<std::vector<std::size_t>> steps_;  // [variable]: the file's, in order; none: as it
};

void OrderedReader::order(std::size_t v) {
    Variable& variable = variables_[v];
    if (ascends(*variable.time)) return;
    const Points& points = variable.time->points;
    TimeOrder found = orderOf(points);
    if (!found.flaw.empty()) {
        variable.notes.push_back("steps are as the file has them, not in order of time: " +
                                 found.flaw);
        return;
    }
    variable.notes.push_back("steps are in order of time, in which the file has them not");
    steps_[v] = std::move(found.steps);
    const auto all = file_->variables();
    for (std::size_t other = 0; other < v; ++other)
        if (all[other].time == all[v].time) {
            variable.time = variables_[other].time;
            return;
        }
    auto time = std::make_shared<TimeAxis>(*variable.time);
    for (std::size_t i = 0; i < points.size(); ++i) time->points[i] = points[steps_[v][i]];
    variable.time = std::move(time);
}

// None where others' stand between them.
std::optional<StepSpan> OrderedReader::stepsOf(std::size_t variable, std::size_t file) const {
    const auto span = file_->stepsOf(variable, file);
    const auto& steps = steps_[variable];
    if (!span || steps.empty()) return span;
    const auto isIts = [&](std::size_t step) {
        return step >= span->first && step - span->first < span->count;
    };
    const auto first = std::ranges::find_if(steps, isIts);
    const auto behind = std::find_if_not(first, steps.end(), isIts);
    if (static_cast<std::size_t>(behind - first) != span->count) return std::nullopt;
    return StepSpan{static_cast<std::size_t>(first - steps.begin()), span->count};
}

}  // namespace

std::unique_ptr<Reader> inOrderOfTime(std::unique_ptr<Reader> reader) {
    if (std::ranges::all_of(reader->variables(),
                            [](const Variable& each) { return ascends(*each.time); }))
        return reader;
    return std::make_unique<OrderedReader>(std::move(reader));
}

}  // namespace timeseries
