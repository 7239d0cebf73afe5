// The whole path of `isochron count` against percentages that other software (numpy) counted.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "app/dataset.h"
#include "tests/support/shared_data.h"
#include "timeseries/sorted_step.h"

namespace app {
namespace {

struct Row {
    std::string file, variable, lo, hi;
    std::vector<std::string> percents;  // two decimals, a step each
};

bool ofFormat(const std::string& file, const std::vector<std::string>& extensions) {
    return std::ranges::any_of(extensions, [&](const std::string& e) { return file.ends_with(e); });
}

std::vector<Row> rowsOf(const std::vector<std::string>& extensions) {
    std::ifstream in(tests::sharedData("ranges.csv"));
    std::vector<Row> rows;
    for (std::string line; std::getline(in, line);) {
        std::istringstream cut(line);
        std::vector<std::string> cells;
        for (std::string cell; std::getline(cut, cell, ',');) cells.push_back(cell);
        if (cells.size() != 8 || !ofFormat(cells[0], extensions)) continue;
        Row row{cells[0], cells[1], cells[2], cells[3], {}};
        std::istringstream percents(cells[7]);
        for (std::string one; percents >> one;) row.percents.push_back(one);
        rows.push_back(row);
    }
    return rows;
}

void expectAgreement(const std::vector<Row>& rows) {
    std::set<std::pair<std::string, std::string>> done;
    for (const Row& row : rows) {
        // Each step is built once for all rows of its file.
        if (!done.insert({row.file, row.variable}).second) continue;
        const std::filesystem::path file = tests::sharedData(row.file);
        // Formats of one variable: the list has their unit or nothing for a name.
        const bool named = row.file.ends_with(".nc");
        Dataset dataset = openDataset(std::span(&file, 1), named ? row.variable : "");
        for (std::size_t step = 0; step < dataset.stepCount(); ++step) {
            const auto sorted =
                timeseries::SortedStep::build(dataset.reader->read(dataset.variable, step));
            for (const Row& each : rows) {
                if (each.file != row.file || each.variable != row.variable) continue;
                ASSERT_EQ(each.percents.size(), dataset.stepCount()) << row.file;
                const auto ranges = timeseries::RangeSet::parse(each.lo + ":" + each.hi);
                const double percent = 100.0 * static_cast<double>(sorted.count(ranges)) /
                                       static_cast<double>(sorted.statistics().points);
                // Half a unit of the last digit printed; the rest is for percents that lie on a
                // tie.
                EXPECT_NEAR(percent, std::stod(each.percents[step]), 0.005 + 1e-9)
                    << row.file << ' ' << row.variable << ' ' << ranges.text() << " step " << step;
            }
        }
    }
}

class RangesCsv : public testing::Test {
 protected:
    void SetUp() override {
        if (!std::filesystem::exists(tests::sharedData("ranges.csv")))
            GTEST_SKIP() << "no real data at " << tests::sharedData("ranges.csv");
    }
};

TEST_F(RangesCsv, CountAgreesInEveryStepOfEveryNetcdfRow) {
    const std::vector<Row> rows = rowsOf({".nc"});
    EXPECT_GE(rows.size(), 19u);
    expectAgreement(rows);
}

TEST_F(RangesCsv, CountAgreesInEveryStepOfEveryNrrdRow) {
    const std::vector<Row> rows = rowsOf({".nrrd", ".nhdr"});
    EXPECT_GE(rows.size(), 7u);
    expectAgreement(rows);
}

}  // namespace
}  // namespace app
