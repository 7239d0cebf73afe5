#include "app/files/chosen_axes.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

namespace app {
namespace {

using timeseries::Field;
using timeseries::Grid;
using timeseries::Reader;
using timeseries::Variable;

using Axes = std::array<AxisChoice, 3>;

// Grids by those that they stand for: who shares one before shares one after. But for those of
// single steps, which are not kept.
class Grids {
 public:
    explicit Grids(const Axes& chosen) : chosen_(chosen) {}

    std::shared_ptr<const Grid> kept(const std::shared_ptr<const Grid>& file) {
        return made_[file] = of(file);
    }
    std::shared_ptr<const Grid> of(const std::shared_ptr<const Grid>& file) const {
        const auto known = made_.find(file);
        std::shared_ptr<const Grid> grid = known == made_.end() ? nullptr : known->second;
        if (!grid) {
            grid = std::make_shared<const Grid>(
                file->relabelled({chosen_[0].name, chosen_[1].name, chosen_[2].name},
                                 {chosen_[0].flip, chosen_[1].flip, chosen_[2].flip}));
        }
        return grid;
    }

 private:
    Axes chosen_;
    std::map<std::shared_ptr<const Grid>, std::shared_ptr<const Grid>> made_;
};

class AxesReader : public Reader {
 public:
    AxesReader(std::unique_ptr<Reader> file, const Axes& chosen)
        : file_(std::move(file)), grids_(chosen) {
        const auto all = file_->variables();
        variables_.assign(all.begin(), all.end());
        for (Variable& each : variables_) each.grid = grids_.kept(each.grid);
    }
    std::string format() const override { return file_->format(); }
    std::span<const std::filesystem::path> files() const override { return file_->files(); }
    std::span<const Variable> variables() const override { return variables_; }
    std::span<const timeseries::DamagedVariable> damaged() const override {
        return file_->damaged();
    }
    Field read(std::size_t variable, std::size_t step) override {
        Field field = file_->read(variable, step);
        field.grid = grids_.of(field.grid);
        return field;
    }
    std::optional<timeseries::StepSpan> stepsOf(std::size_t variable,
                                                std::size_t file) const override {
        return file_->stepsOf(variable, file);
    }

 private:
    std::unique_ptr<Reader> file_;
    Grids grids_;
    std::vector<Variable> variables_;
};

}  // namespace

void chooseAxes(OpenDataset& dataset, const Axes& axes) {
    if (axes == Axes{}) return;
    dataset.reader = std::make_unique<AxesReader>(std::move(dataset.reader), axes);
    const auto all = dataset.reader->variables();
    dataset.variables.assign(all.begin(), all.end());
    dataset.variable = dataset.variables[dataset.variableIndex];
}

}  // namespace app
