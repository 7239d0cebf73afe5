// Sorted steps on disk, all of whose checksums are right: whatever they say is refused, or is
// points of the grid.
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/step_sums.h"
#include "timeseries/index/step_file.h"

namespace {

class Bytes final : public timeseries::ByteSource {
 public:
    explicit Bytes(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}
    std::string name() const override { return "input"; }
    std::uint64_t size() const override { return bytes_.size(); }
    void read(std::uint64_t at, std::span<std::byte> into) const override {
        if (at > bytes_.size() || into.size() > bytes_.size() - at) std::abort();
        std::memcpy(into.data(), bytes_.data() + at, into.size());
    }

 private:
    std::vector<std::byte> bytes_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::vector<std::byte> bytes(size);
    if (size > 0) std::memcpy(bytes.data(), data, size);
    if (size >= timeseries::kHeaderBytes) {  // what every file has
        timeseries::StepHeader header;
        std::memcpy(&header, bytes.data(), sizeof header);
        header.magic = timeseries::kStepMagic;
        header.version = timeseries::kStepVersion;
        header.endian = timeseries::kEndianMark;
        header.fileBytes = size;
        std::memcpy(bytes.data(), &header, sizeof header);
    }
    tests::sumAnew(bytes);
    try {
        const timeseries::StepFile file(std::make_unique<const Bytes>(std::move(bytes)));
        for (std::size_t block = 0; block < file.blocks().size(); ++block)
            if (file.below(block, file.blocks()[block].greatest) > file.blocks()[block].count)
                std::abort();
        file.check();
    } catch (const timeseries::StepFileError& error) {
        if (std::string(error.what()).find('\n') != std::string::npos) std::abort();
    }
    return 0;
}
