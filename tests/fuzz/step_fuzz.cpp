// Sorted steps on disk, all of whose checksums are right: whatever they say is refused, or is
// points of the grid.
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/step_bytes.h"
#include "timeseries/index/step_file.h"
#include "timeseries/readers/step_reader.h"

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
        const timeseries::StepFile file(std::make_unique<const tests::BytesRead>(std::move(bytes)));
        for (std::size_t block = 0; block < file.blocks().size(); ++block)
            if (file.below(block, file.blocks()[block].greatest) > file.blocks()[block].count)
                std::abort();
        file.check();
        (void)timeseries::variableOf(file);
    } catch (const timeseries::FileError& error) {
        if (std::string(error.what()).find('\n') != std::string::npos) std::abort();
    } catch (const timeseries::StepFileError& error) {
        if (std::string(error.what()).find('\n') != std::string::npos) std::abort();
    }
    return 0;
}
