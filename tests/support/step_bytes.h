// Sorted steps on disk, in memory: what was written, and sources that fail where a test says so.
#pragma once

#include <xxhash.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "timeseries/index/step_file.h"
#include "timeseries/index/step_header.h"

namespace tests {

class BytesWritten : public timeseries::ByteSink {
 public:
    void write(std::uint64_t at, std::span<const std::byte> part) override {
        bytes.resize(std::max<std::size_t>(bytes.size(), at + part.size()));
        std::ranges::copy(part, bytes.begin() + static_cast<std::ptrdiff_t>(at));
    }
    std::vector<std::byte> bytes;
};

class BytesRead final : public timeseries::ByteSource {
 public:
    explicit BytesRead(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}
    std::string name() const override { return "bytes"; }
    std::uint64_t size() const override { return bytes_.size(); }
    void read(std::uint64_t at, std::span<std::byte> into) const override {
        if (at > bytes_.size() || into.size() > bytes_.size() - at)
            throw timeseries::DamagedStepError("bytes: read beyond its end");
        std::memcpy(into.data(), bytes_.data() + at, into.size());
    }

 private:
    std::vector<std::byte> bytes_;
};

inline std::vector<std::byte> written(const timeseries::SortedStep& step,
                                      const std::string& about = "", unsigned threads = 2) {
    BytesWritten out;
    EXPECT_TRUE(timeseries::writeStep(step, about, out, {}, threads));
    return out.bytes;
}

inline std::shared_ptr<const timeseries::StepFile> opened(std::vector<std::byte> bytes) {
    return std::make_shared<const timeseries::StepFile>(
        std::make_unique<const BytesRead>(std::move(bytes)));
}

// Makes all checksums of a file right, whatever is in it, as far as its header and its directory
// say where things are.
inline void sumAnew(std::vector<std::byte>& bytes) {
    using timeseries::StepBlock;
    timeseries::StepHeader header;
    if (bytes.size() < timeseries::kHeaderBytes) return;
    std::memcpy(&header, bytes.data(), sizeof header);
    const auto sumOf = [&](std::uint64_t at, std::uint64_t size) {
        if (at > bytes.size() || size > bytes.size() - at) return std::uint64_t{0};
        return std::uint64_t{XXH3_64bits(bytes.data() + at, size)};
    };
    const timeseries::StepSection& directory = header.directory;
    if (directory.at <= bytes.size() && directory.bytes <= bytes.size() - directory.at)
        for (std::uint64_t at = 0; at + sizeof(StepBlock) <= directory.bytes;
             at += sizeof(StepBlock)) {
            StepBlock block;
            std::byte* const entry = bytes.data() + directory.at + at;
            std::memcpy(&block, entry, sizeof block);
            block.idsSum = static_cast<std::uint32_t>(sumOf(block.idsAt, block.idsBytes));
            block.keysSum = static_cast<std::uint32_t>(sumOf(block.keysAt, block.keysBytes));
            std::memcpy(entry, &block, sizeof block);
        }
    header.directory.sum = sumOf(directory.at, directory.bytes);
    header.summary.sum = sumOf(header.summary.at, header.summary.bytes);
    std::memcpy(bytes.data(), &header, sizeof header);
    header.sum = sumOf(0, offsetof(timeseries::StepHeader, sum));
    std::memcpy(bytes.data(), &header, sizeof header);
}

}  // namespace tests
