// Bytes that lie somewhere else than in memory, read and written at offsets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

namespace timeseries {

// A sorted step on disk that cannot be read or written. what() is one sentence that names the file.
struct StepFileError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// One that is there and is not what it should be: to be made anew.
struct DamagedStepError : StepFileError {
    using StepFileError::StepFileError;
};

// One that says it is of another version of the program, or of a machine of the other byte order.
struct OtherStepError : DamagedStepError {
    using DamagedStepError::DamagedStepError;
};

// Every member is safe to call from any thread.
class ByteSource {
 public:
    virtual ~ByteSource() = default;
    virtual std::string name() const = 0;  // for messages
    virtual std::uint64_t size() const = 0;
    // All of `into`, or throws StepFileError.
    virtual void read(std::uint64_t at, std::span<std::byte> into) const = 0;
    // These bytes will be read soon.
    virtual void willNeed(std::uint64_t, std::uint64_t) const {}
};

class ByteSink {
 public:
    virtual ~ByteSink() = default;
    // All of `bytes`, or throws StepFileError. What lies between two writes is zero.
    virtual void write(std::uint64_t at, std::span<const std::byte> bytes) = 0;
    // Likewise, bytes of which each piece lies behind the one before it: as one write, where that
    // is known how, for which the system takes larger pages of its cache than for many.
    virtual void writePieces(std::uint64_t at, std::span<const std::span<const std::byte>> pieces) {
        for (const auto piece : pieces) {
            write(at, piece);
            at += piece.size();
        }
    }
};

// An ordinary file; null where there is none of this name. It stays readable when its name is gone.
// Throws StepFileError.
std::unique_ptr<const ByteSource> openBytes(const std::filesystem::path& path);

}  // namespace timeseries
