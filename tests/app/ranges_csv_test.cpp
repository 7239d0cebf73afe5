// The whole path of `isochron count` against percentages that other software (numpy) counted: every
// row of ranges.csv, whatever the format of its file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "app/files/dataset.h"
#include "tests/support/shared_data.h"
#include "tests/support/sorted.h"
#include "timeseries/index/sorted_step.h"

namespace app {
namespace {

struct Row {
    std::string variable;
    timeseries::RangeSet ranges;
    std::vector<std::string> percents;  // two decimals, a step each
};

using Rows = std::map<std::string, std::vector<Row>>;  // by file

Rows rowsOf(const char* list) {
    std::ifstream in(tests::sharedData(list));
    std::string line;
    std::getline(in, line);
    EXPECT_TRUE(line.starts_with("file,variable,lo,hi,steps,min_pct,max_pct,pct_per_step")) << line;
    Rows rows;
    while (std::getline(in, line)) {
        std::istringstream cut(line);
        std::array<std::string, 8> cells;
        for (std::string& cell : cells) std::getline(cut, cell, ',');
        Row row{cells[1], timeseries::RangeSet::parse(cells[2] + ":" + cells[3]), {}};
        std::istringstream percents(cells[7]);
        for (std::string one; percents >> one;) row.percents.push_back(one);
        EXPECT_EQ(std::to_string(row.percents.size()), cells[4]) << line;
        rows[cells[0]].push_back(std::move(row));
    }
    return rows;
}

std::string refusalOf(const std::filesystem::path& file) {
    try {
        openDataset(std::span(&file, 1), "");
    } catch (const timeseries::FileError& error) {
        return error.what();
    }
    return "";
}

// By the name that is selected by, without what tells points' from cells', the end of its path in
// HDF5, without the number that FEniCS gives it, or in full; the file's default one where the list
// has no name.
std::size_t indexOf(const OpenDataset& dataset, const std::string& name) {
    if (name.empty()) return dataset.variableIndex;
    const auto variables = dataset.reader->variables();
    const auto found = std::ranges::find_if(variables, [&](const auto& v) {
        return v.name == name || v.name == name + " (points)" || v.name.ends_with('/' + name) ||
               v.name.starts_with(name + '_') || v.longName == name;
    });
    if (found == variables.end()) throw std::runtime_error(dataset.name + ": no variable " + name);
    return static_cast<std::size_t>(found - variables.begin());
}

void expectAgreement(const std::filesystem::path& file, const std::vector<Row>& rows) {
    const OpenDataset dataset = openDataset(std::span(&file, 1), "");
    std::map<std::size_t, std::vector<const Row*>> byVariable;
    for (const Row& row : rows) byVariable[indexOf(dataset, row.variable)].push_back(&row);
    for (const auto& [variable, its] : byVariable) {
        const std::size_t steps = dataset.reader->variables()[variable].time->points.size();
        for (const Row* row : its) ASSERT_EQ(row->percents.size(), steps) << file;
        for (std::size_t step = 0; step < steps; ++step) {
            const auto sorted = tests::sorted(dataset.reader->read(variable, step));
            for (const Row* row : its) {
                const double percent = 100.0 * static_cast<double>(sorted.count(row->ranges)) /
                                       static_cast<double>(sorted.statistics().points);
                // Half a unit of the last digit printed; the rest is for percents that lie on a
                // tie.
                EXPECT_NEAR(percent, std::stod(row->percents[step]), 0.005 + 1e-9)
                    << file << ' ' << row->variable << ' ' << row->ranges.text() << " step "
                    << step;
            }
        }
    }
}

TEST(RangesCsv, CountAgreesInEveryStepOfEveryRow) {
    Rows rows;
    for (const char* list : {"ranges.csv", "grids/ranges.csv"}) {
        if (!std::filesystem::exists(tests::sharedData(list)))
            GTEST_SKIP() << "no real data at " << tests::sharedData(list);
        rows.merge(rowsOf(list));
    }
    // Of nodes that blocks share there are two: tests/timeseries/exodus_reader_test.cpp.
    EXPECT_EQ(rows.erase("mug_transient.e"), 1u);
    for (const auto& [file, its] : rows) {
        const std::string refusal = refusalOf(tests::sharedData(file));
        // A build without VTK says of each VTK file that it has none.
        if (refusal.find("--with-") != refusal.npos) continue;
        if (refusal.empty())
            expectAgreement(tests::sharedData(file), its);
        else
            ADD_FAILURE() << refusal;
    }
}

}  // namespace
}  // namespace app
