#include "render/image/png.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <span>
#include <system_error>

#include "render/image/color.h"
#include "render/image/encode_srgb.h"
#include "render/image/picture_file.h"
#include "render/image/png_rows.h"

namespace render {

namespace {

// libpng reports an error by a callback that must not return.
struct Failure {
    std::array<char, 200> text{};
};

[[noreturn]] void fail(png_structp png, png_const_charp what) {
    auto& failure = *static_cast<Failure*>(png_get_error_ptr(png));
    std::strncpy(failure.text.data(), what, failure.text.size() - 1);
    png_longjmp(png, 1);
}

void ignoreWarning(png_structp, png_const_charp) {}

// Runs calls into libpng; false when one of them failed. An exception must not pass through C, so
// the way out is longjmp: REQUIRES that `calls` owns nothing that a destructor would have to free.
template <class Calls>
[[nodiscard]] bool succeeds(png_structp png, const Calls& calls) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    calls();
    return true;
}

struct Writer {
    Writer() {
        png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &failure, fail, ignoreWarning);
        if (png != nullptr) info = png_create_info_struct(png);
        if (info == nullptr) throw std::bad_alloc();
    }
    ~Writer() { png_destroy_write_struct(&png, &info); }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;

    Failure failure;
    png_structp png = nullptr;
    png_infop info = nullptr;
};

struct Reader {
    Reader() {
        png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &failure, fail, ignoreWarning);
        if (png != nullptr) info = png_create_info_struct(png);
        if (info == nullptr) throw std::bad_alloc();
        // Text that is damaged is not left out, as if there were none.
        png_set_crc_action(png, PNG_CRC_DEFAULT, PNG_CRC_ERROR_QUIT);
    }
    ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    Failure failure;
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::span<const std::byte> rest;
};

std::uint8_t alpha8(float alpha) {
    if (!(alpha > 0)) return 0;  // NaN too
    return static_cast<std::uint8_t>(std::min(alpha, 1.0f) * 255.0 + 0.5);
}

// Pixels as bytes, alpha straight: the colour divided by the unrounded alpha. What 0 / 0 gives is
// black.
void encode(std::span<const glm::vec4> pixels, bool opaque, std::span<std::uint8_t> bytes) {
    std::vector<float> straight;
    straight.reserve(3 * pixels.size());
    for (const glm::vec4& pixel : pixels) {
        const float weight = std::min(pixel.a, 1.0f);
        for (int c = 0; c < 3; ++c) straight.push_back(pixel[c] / weight);
    }
    if (opaque) return encodeSrgb8(straight, bytes);
    std::vector<std::uint8_t> rgb(straight.size());
    encodeSrgb8(straight, rgb);
    for (std::size_t x = 0; x < pixels.size(); ++x) {
        std::copy_n(&rgb[3 * x], 3, &bytes[4 * x]);
        bytes[4 * x + 3] = alpha8(pixels[x].a);
    }
}

std::vector<png_text> textChunks(const Metadata& metadata) {
    std::vector<png_text> chunks;
    for (const auto& [key, value] : metadata) {
        assert(isMetadataKey(key) && value.find('\0') == std::string::npos);
        png_text chunk{};
        chunk.compression = PNG_ITXT_COMPRESSION_NONE;
        // libpng copies both and changes neither; its types predate const.
        chunk.key = const_cast<char*>(key.c_str());
        chunk.text = const_cast<char*>(value.c_str());
        chunk.itxt_length = value.size();
        chunks.push_back(chunk);
    }
    return chunks;
}

void writeHeader(png_structp png, png_infop info, glm::ivec2 size, bool opaque,
                 std::span<const png_text> texts) {
    png_set_IHDR(png, info, static_cast<png_uint_32>(size.x), static_cast<png_uint_32>(size.y), 8,
                 opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_RELATIVE);
    if (!texts.empty()) png_set_text(png, info, texts.data(), static_cast<int>(texts.size()));
    png_write_info(png, info);
}

void readBytes(png_structp png, png_bytep out, std::size_t count) {
    auto& rest = static_cast<Reader*>(png_get_io_ptr(png))->rest;
    if (count > rest.size()) png_error(png, "the file ends too early");
    std::memcpy(out, rest.data(), count);
    rest = rest.subspan(count);
}

// Asks libpng for 16-bit RGBA of whatever is stored; 8-bit values arrive exactly, as v * 257.
void readHeader(Reader& reader) {
    png_set_sig_bytes(reader.png, 0);
    png_set_user_limits(reader.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_read_info(reader.png, reader.info);
}

void checkSize(const Reader& reader, const std::filesystem::path& file) {
    const std::int64_t width = png_get_image_width(reader.png, reader.info);
    const std::int64_t height = png_get_image_height(reader.png, reader.info);
    if (width * height > kMaxPixels) {
        throw ImageError(file, "declares " + std::to_string(width) + " x " +
                                   std::to_string(height) +
                                   " pixels, more than this program reads");
    }
    // Deflate packs at most 1032 to 1 (zlib's technical notes), so a header that promises more than
    // that is refused before memory is taken for it.
    const auto storedBytes = static_cast<double>(png_get_rowbytes(reader.png, reader.info)) *
                             static_cast<double>(height);
    if (storedBytes > 1032.0 * static_cast<double>(reader.rest.size())) {
        throw ImageError(file,
                         "is not a complete PNG picture: it declares more pixels than it holds");
    }
}

void expandToRgba16(png_structp png, png_infop info) {
    png_set_expand_16(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 0xffff, PNG_FILLER_AFTER);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
}

Image decode(std::span<const png_byte> rgba16, glm::ivec2 size) {
    Image image(size);
    const auto channel = [&](std::size_t i) {  // big-endian
        return (rgba16[2 * i] * 256 + rgba16[2 * i + 1]) / 65535.0;
    };
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const double alpha = channel(4 * i + 3);
        const glm::dvec3 straight =
            linearFromSrgb(glm::dvec3(channel(4 * i), channel(4 * i + 1), channel(4 * i + 2)));
        image.pixels[i] = glm::vec4(glm::dvec4(straight * alpha, alpha));
    }
    return image;
}

Metadata readTexts(const Reader& reader) {
    png_textp texts = nullptr;
    const int count = png_get_text(reader.png, reader.info, &texts, nullptr);
    Metadata metadata;
    for (int i = 0; i < count; ++i) {
        const bool international = texts[i].compression >= PNG_ITXT_COMPRESSION_NONE;
        const std::size_t length = international ? texts[i].itxt_length : texts[i].text_length;
        metadata.try_emplace(texts[i].key, std::string(texts[i].text, length));
    }
    return metadata;
}

}  // namespace

void writePng(const std::filesystem::path& file, const Image& image, const Metadata& metadata) {
    assert(image.size.x >= 1 && image.size.y >= 1);
    const bool opaque = std::all_of(image.pixels.begin(), image.pixels.end(),
                                    [](glm::vec4 pixel) { return alpha8(pixel.a) == 255; });
    const auto texts = textChunks(metadata);
    const auto width = static_cast<std::size_t>(image.size.x);
    PartialFile out(file);
    Writer writer;
    const auto check = [&](bool succeeded) {
        if (succeeded) return;
        const bool isOfFile = std::ferror(out.stream()) != 0;  // which libpng does not tell why
        throw ImageError(
            file, "cannot be written: " + (isOfFile ? std::generic_category().message(errno)
                                                    : std::string(writer.failure.text.data())));
    };
    png_init_io(writer.png, out.stream());
    check(succeeds(writer.png,
                   [&] { writeHeader(writer.png, writer.info, image.size, opaque, texts); }));
    const auto writeChunk = [&](const char* type, std::span<const std::uint8_t> bytes) {
        check(succeeds(writer.png, [&] {
            png_write_chunk(writer.png, reinterpret_cast<png_const_bytep>(type), bytes.data(),
                            bytes.size());
        }));
    };
    const std::span pixels(image.pixels);
    const std::size_t pixelBytes = opaque ? 3 : 4;
    deflateRows({static_cast<std::size_t>(image.size.y), pixelBytes * width, pixelBytes,
                 [&](std::size_t y, std::span<std::uint8_t> row) {
                     encode(pixels.subspan(y * width, width), opaque, row);
                 }},
                [&](std::span<const std::uint8_t> bytes) { writeChunk("IDAT", bytes); });
    writeChunk("IEND", {});
    out.commit();
}

PngPicture readPng(const std::filesystem::path& file) {
    const auto bytes = readPictureFile(file);
    Reader reader;
    reader.rest = bytes;
    const auto check = [&](bool succeeded) {
        if (!succeeded)
            throw ImageError(
                file, std::string("is not a complete PNG picture: ") + reader.failure.text.data());
    };
    png_set_read_fn(reader.png, &reader, readBytes);
    check(succeeds(reader.png, [&] { readHeader(reader); }));
    checkSize(reader, file);
    check(succeeds(reader.png, [&] { expandToRgba16(reader.png, reader.info); }));
    const glm::ivec2 size(png_get_image_width(reader.png, reader.info),
                          png_get_image_height(reader.png, reader.info));
    const std::size_t rowBytes = png_get_rowbytes(reader.png, reader.info);
    std::vector<png_byte> rgba16(rowBytes * static_cast<std::size_t>(size.y));
    std::vector<png_bytep> rows;
    for (int y = 0; y < size.y; ++y)
        rows.push_back(&rgba16[rowBytes * static_cast<std::size_t>(y)]);
    check(succeeds(reader.png, [&] {
        png_read_image(reader.png, rows.data());
        png_read_end(reader.png, reader.info);
    }));
    return {decode(rgba16, size), readTexts(reader)};
}

}  // namespace render
