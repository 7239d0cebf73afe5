// A store of sorted steps beside a file that they are of.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>

#include "tests/support/files.h"
#include "timeseries/readers/reader.h"
#include "timeseries/series/step_maker.h"
#include "timeseries/series/step_store.h"

namespace timeseries::step_stores {

namespace fs = std::filesystem;

inline constexpr std::chrono::milliseconds kAtOnce{0};

// An .nrrd of 24^3 floats: f(i) = i mod m.
inline fs::path nrrdOf(const fs::path& path, int m) {
    std::string bytes(24 * 24 * 24 * sizeof(float), '\0');
    for (int i = 0; i < 24 * 24 * 24; ++i) {
        const auto value = static_cast<float>(i % m);
        std::memcpy(bytes.data() + i * sizeof value, &value, sizeof value);
    }
    tests::writeBytes(path,
                      "NRRD0004\ntype: float\ndimension: 3\nsizes: 24 24 24\nendian: little\n"
                      "encoding: raw\n\n" +
                          bytes);
    return path;
}

class StepStores : public testing::Test {
 protected:
    fs::path folder = tests::freshFolder();
    fs::path file = nrrdOf(folder / "field.nrrd", 100);
    std::shared_ptr<StepStore> store = std::make_shared<StepStore>(
        folder / "steps", StoreKind::Cache, StepStore::kNoBudget, kAtOnce);

    std::unique_ptr<StepMaker> maker(std::shared_ptr<StepStore> in = nullptr) {
        if (!in) in = store;
        auto reader = openReader(std::span(&file, 1));
        return std::make_unique<StepMaker>(std::move(reader), 0, RangeSet::everything(),
                                           timeseries::StepStores{{in}, in, 1});
    }
    // Or what is written within one tick of the clock would be taken for the same.
    void agedBy(std::chrono::hours before) const {
        fs::last_write_time(file, fs::file_time_type::clock::now() - before);
    }
    StepOrigin originOf(const fs::path& of) const {
        return {
            {of}, 0, of.stem().string(), openReader(std::span(&of, 1))->variables()[0].storedAs};
    }
    StepOrigin origin() const { return originOf(file); }
    std::size_t files() const {
        std::error_code none;
        return static_cast<std::size_t>(std::distance(
            fs::directory_iterator(folder / "steps", none), fs::directory_iterator()));
    }
};

inline void expectField(const SortedStep& step, int m) {
    const auto values = std::get<std::span<const float>>(step.columns().values);
    const auto index = step.columns().gridIndex;
    ASSERT_EQ(values.size(), 24u * 24 * 24);
    for (std::size_t i = 0; i < values.size(); ++i)
        ASSERT_EQ(values[i], static_cast<float>(static_cast<int>(index[i]) % m));
}

}  // namespace timeseries::step_stores
