// Sorted steps on disk, in memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/step_sums.h"
#include "timeseries/index/step_file.h"

namespace tests {

class BytesWritten : public timeseries::ByteSink {
 public:
    void write(std::uint64_t at, std::span<const std::byte> part) override {
        bytes.resize(std::max<std::size_t>(bytes.size(), at + part.size()));
        std::ranges::copy(part, bytes.begin() + static_cast<std::ptrdiff_t>(at));
    }
    std::vector<std::byte> bytes;
};

class BytesRead : public timeseries::ByteSource {
 public:
    explicit BytesRead(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}
    std::string name() const override { return "bytes"; }
    std::uint64_t size() const override { return bytes_.size(); }
    void read(std::uint64_t at, std::span<std::byte> into) const override {
        if (at > bytes_.size() || into.size() > bytes_.size() - at)
            std::abort();  // never asked for
        std::memcpy(into.data(), bytes_.data() + at, into.size());
    }

 private:
    std::vector<std::byte> bytes_;
};

inline std::vector<std::byte> written(const timeseries::SortedStep& step,
                                      const std::string& about = "", unsigned threads = 2) {
    BytesWritten out;
    if (!timeseries::writeStep(step, about, out, {}, threads)) std::abort();
    return out.bytes;
}

inline std::shared_ptr<const timeseries::StepFile> opened(std::vector<std::byte> bytes) {
    return std::make_shared<const timeseries::StepFile>(
        std::make_unique<const BytesRead>(std::move(bytes)));
}

}  // namespace tests
