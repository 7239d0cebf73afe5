// The rows of a picture as PNG keeps them, on all threads. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

namespace render {

struct PngRows {
    std::size_t count, bytes, pixelBytes;  // of a row, of a pixel
    // Writes row y, 0 the top one, as bytes; on several threads at once.
    std::function<void(std::size_t y, std::span<std::uint8_t> row)> encode;
};

// Filtered by Paeth's predictor (PNG 9) and deflated into one zlib stream (PNG 10), of which
// `write` gets the parts in their order, on the caller's thread; none is empty. The same for any
// number of threads. REQUIRES: at least one row, of whole pixels. Passes on what the two throw.
void deflateRows(const PngRows& rows,
                 const std::function<void(std::span<const std::uint8_t>)>& write);

}  // namespace render
