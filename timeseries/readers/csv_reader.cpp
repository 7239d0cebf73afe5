#include "timeseries/readers/csv_reader.h"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>

#include "timeseries/grid/scattered.h"
#include "timeseries/readers/components.h"
#include "timeseries/readers/csv_table.h"
#include "timeseries/readers/other_formats.h"

namespace timeseries {
namespace {

class CsvReader final : public Reader {
 public:
    explicit CsvReader(const std::filesystem::path& path) : paths_{path} {
        std::ifstream file(path, std::ios::binary);
        std::string start(kBeginningBytes, '\0');
        file.read(start.data(), static_cast<std::streamsize>(start.size()));
        start.resize(static_cast<std::size_t>(file.gcount()));
        const auto header = csvHeaderOf(start);
        if (!header) fail("expected a table with the columns x and y, and one more");
        columns_ = readCsv(path, *header);
        place(*header);
        addVariables(*header);
    }

    std::string format() const override { return "CSV"; }
    std::span<const std::filesystem::path> files() const override { return paths_; }
    std::span<const Variable> variables() const override { return variables_; }
    Field read(std::size_t variable, std::size_t) override {
        const CsvNumbers& column = columns_[sources_[variable]];
        return {.grid = grid_, .values = column.values, .missing = column.missing};
    }

 private:
    [[noreturn]] void fail(std::string_view what) const {
        throw FileError(fmt::format("{}: {}", paths_[0].string(), what));
    }
    void place(const CsvHeader& header) {
        const auto doubles = [&](std::size_t i) -> auto& {
            return std::get<std::vector<double>>(columns_[i].values);
        };
        std::vector<glm::dvec3> at(doubles(header.places[0].value()).size(), glm::dvec3(0));
        auto axes = spaceAxes();
        for (std::size_t c = 0; c < 3; ++c) {
            if (!header.places[c]) continue;
            axes[c].units = header.columns[*header.places[c]].units;
            auto& column = doubles(*header.places[c]);
            for (std::size_t i = 0; i < at.size(); ++i) at[i][static_cast<int>(c)] = column[i];
            column = {};
        }
        try {
            grid_ = std::make_shared<const Grid>(std::move(axes),
                                                 std::make_shared<const Mesh>(meshOfScattered(at)));
        } catch (const std::invalid_argument& flaw) {
            fail(fmt::format("expected points that take space, found that {}", flaw.what()));
        }
    }
    void addVariables(const CsvHeader& header) {
        const auto time = std::make_shared<const TimeAxis>(TimeAxis{
            .name = "step", .units = "", .calendar = "", .points = {{0, ""}}, .counted = true});
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            const Values& values = columns_[i].values;
            if (std::visit([](const auto& v) { return v.empty(); }, values))
                continue;  // coordinates, text
            Variable variable;
            variable.name = header.columns[i].name;
            variable.units = header.columns[i].units;
            variable.type = static_cast<ValueType>(values.index());
            variable.storedAs = "text";
            variable.grid = grid_;
            variable.time = time;
            variable.notes = notesOf(*grid_->mesh());
            variables_.push_back(std::move(variable));
            sources_.push_back(i);
        }
        tellApart(variables_);
    }

    std::vector<std::filesystem::path> paths_;
    std::vector<CsvNumbers> columns_;  // none of coordinates
    std::shared_ptr<const Grid> grid_;
    std::vector<Variable> variables_;
    std::vector<std::size_t> sources_;  // columns
};

}  // namespace

bool isCsv(std::string_view start) { return csvHeaderOf(start).has_value(); }

std::unique_ptr<Reader> openCsv(std::span<const std::filesystem::path> paths) {
    return std::make_unique<CsvReader>(paths[0]);
}

}  // namespace timeseries
