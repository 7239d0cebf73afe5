// Checksums of sorted steps on disk, for those whose contents a test has changed.
#pragma once

#include <xxhash.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "timeseries/index/step_file.h"
#include "timeseries/index/step_header.h"

namespace tests {

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
