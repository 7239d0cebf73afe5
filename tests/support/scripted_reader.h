// A dataset made by a test, whose reads wait where the test says so.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/files/dataset.h"
#include "tests/support/scenes.h"

namespace tests {

// What a test and its readers share; readers may outlive the test's other objects.
class Script {
 public:
    // Reads wait from here on, each until it is let go by its step.
    void hold() {
        const std::lock_guard lock(mutex_);
        held_ = true;
    }
    void letGo(std::size_t step) {
        const std::lock_guard lock(mutex_);
        free_.insert(step);
        changed_.notify_all();
    }
    void letAllGo() {
        const std::lock_guard lock(mutex_);
        held_ = false;
        changed_.notify_all();
    }
    void failAt(std::size_t step, std::string why) {
        const std::lock_guard lock(mutex_);
        failures_.emplace_back(step, std::move(why));
    }
    void mend() {
        const std::lock_guard lock(mutex_);
        failures_.clear();
    }
    // Steps whose reading began, in order.
    std::vector<std::size_t> begun() const {
        const std::lock_guard lock(mutex_);
        return begun_;
    }
    void waitUntilBegun(std::size_t step) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return std::ranges::count(begun_, step) > 0; });
    }
    void waitUntilReadersEnded(int count) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return ended_ >= count; });
    }
    // A front end's wake and wait: whatever came since the last wait, the beginning of a read too,
    // ends it at once.
    void wake() {
        const std::lock_guard lock(mutex_);
        ++woken_;
        changed_.notify_all();
    }
    void waitForWake() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return woken_ != waited_; });
        waited_ = woken_;
    }

    void read(std::size_t step) {
        std::unique_lock lock(mutex_);
        begun_.push_back(step);
        ++woken_;
        changed_.notify_all();
        changed_.wait(lock, [&] { return !held_ || free_.erase(step) > 0; });
        for (const auto& [failing, why] : failures_)
            if (failing == step) throw timeseries::FileError(why);
    }
    void readerEnded() {
        const std::lock_guard lock(mutex_);
        ++ended_;
        changed_.notify_all();
    }

 private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    bool held_ = false;
    std::set<std::size_t> free_;
    std::vector<std::pair<std::size_t, std::string>> failures_;
    std::vector<std::size_t> begun_;
    int ended_ = 0;
    std::uint64_t woken_ = 0, waited_ = 0;
};

// The value of a point; `variable` is its place.
using ValueAt = std::function<float(std::size_t variable, std::size_t step, std::size_t point)>;

struct World {
    std::vector<std::string> variables{"T", "P"};
    std::size_t steps = 10;
    std::vector<double> times = {};                          // counted without
    std::size_t edge = 4;                                    // points along each axis of a cube
    std::shared_ptr<const timeseries::Grid> grid = nullptr;  // instead of the cube
    // Of steps whose points lie elsewhere.
    std::map<std::size_t, std::shared_ptr<const timeseries::Grid>> gridsOfSteps = {};
    ValueAt value = [](std::size_t variable, std::size_t step, std::size_t point) {
        return static_cast<float>(1000 * variable + (point * 7 + step * 13) % 64);
    };
};

class ScriptedReader : public timeseries::Reader {
 public:
    ScriptedReader(World world, std::shared_ptr<Script> script)
        : world_(std::move(world)), script_(std::move(script)) {
        auto time = std::make_shared<timeseries::TimeAxis>();
        time->name = "time";
        time->counted = world_.times.empty();
        for (std::size_t i = 0; i < world_.steps; ++i)
            time->points.push_back({time->counted ? static_cast<double>(i) : world_.times[i], ""});
        const auto grid = world_.grid ? world_.grid : cube(world_.edge);
        for (const std::string& name : world_.variables)
            variables_.push_back({.name = name,
                                  .longName = "",
                                  .units = "",
                                  .type = timeseries::ValueType::F32,
                                  .storedAs = "",
                                  .missing = "",
                                  .grid = grid,
                                  .time = time,
                                  .notes = {}});
    }
    ~ScriptedReader() override { script_->readerEnded(); }
    std::string format() const override { return "scripted"; }
    std::span<const std::filesystem::path> files() const override { return {}; }
    std::span<const timeseries::Variable> variables() const override { return variables_; }
    timeseries::Field read(std::size_t variable, std::size_t step) override {
        script_->read(step);
        const auto own = world_.gridsOfSteps.find(step);
        const auto& grid =
            own != world_.gridsOfSteps.end() ? own->second : variables_[variable].grid;
        std::vector<float> values(grid->count());
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = world_.value(variable, step, i);
        return {grid, std::move(values), {}};
    }

 private:
    World world_;
    std::shared_ptr<Script> script_;
    std::vector<timeseries::Variable> variables_;
};

// As app::openDataset chooses the variable.
inline app::OpenDataset scriptedDataset(const World& world, std::shared_ptr<Script> script,
                                        const std::string& name, const std::string& variable) {
    app::OpenDataset dataset;
    dataset.reader = std::make_unique<ScriptedReader>(world, std::move(script));
    dataset.series.files = {name};
    dataset.name = name;
    dataset.defaultStep = world.steps / 2;
    const auto at = std::ranges::find(world.variables, variable);
    if (!variable.empty() && at == world.variables.end())
        throw timeseries::FileError(fmt::format("{}: no variable '{}'", name, variable));
    if (!variable.empty())
        dataset.variableIndex = static_cast<std::size_t>(at - world.variables.begin());
    const auto variables = dataset.reader->variables();
    dataset.variables.assign(variables.begin(), variables.end());
    dataset.variable = variables[dataset.variableIndex];
    return dataset;
}

}  // namespace tests
