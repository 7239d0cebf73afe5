#include "timeseries/readers/vtk/vtk_blocks.h"

#include <fmt/format.h>
#include <lz4.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <fstream>
#include <initializer_list>

#include "timeseries/readers/limits.h"
#include "timeseries/readers/vtk/vtk_header.h"
#include "timeseries/readers/vtk/vtk_number.h"

namespace timeseries {
namespace {

// The most that a byte can unpack to: LZ4's limit is 255 (one length byte); LZMA states none, and
// 8000 is meant to be beyond what it reaches.
std::uint64_t unpackedPerByte(std::string_view compressor) {
    if (compressor == "vtkLZ4DataCompressor") return 256;
    return compressor == "vtkLZMADataCompressor" ? 8000 : kMaxInflated;
}

constexpr std::string_view kBase64 =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

// The bytes of one array where they lie, decoded where they are base64.
class Source {
 public:
    Source(const std::filesystem::path& path, std::uint64_t at, bool base64)
        : file_(path, std::ios::binary), base64_(base64) {
        file_.seekg(static_cast<std::streamoff>(at));
    }

    // False at the end of the file, of the text, or of the characters that mean something.
    bool get(unsigned char& byte) {
        while (bits_ < 8) {
            char c = 0;
            if (!file_.get(c)) return false;
            if (base64_ && (c == ' ' || c == '\n' || c == '\r' || c == '\t')) continue;
            const std::size_t digit = base64_ ? kBase64.find(c) : static_cast<unsigned char>(c);
            if (digit == kBase64.npos) return false;
            held_ = (held_ << (base64_ ? 6 : 8) | static_cast<unsigned>(digit)) & 0xFFFF;
            bits_ += base64_ ? 6 : 8;
        }
        bits_ -= 8;
        byte = static_cast<unsigned char>(held_ >> bits_);
        return true;
    }

    // As many of so many bytes as there are.
    std::string bytes(std::size_t count) {
        std::string all;
        for (unsigned char byte = 0; all.size() < count && get(byte);)
            all += static_cast<char>(byte);
        return all;
    }

    bool number(const VtkEncoding& encoding, std::uint64_t& value) {
        value = 0;
        for (std::size_t i = 0; i < encoding.headerBytes; ++i) {
            unsigned char byte = 0;
            if (!get(byte)) return false;
            if (encoding.bigEndian)
                value = value << 8 | byte;
            else
                value |= static_cast<std::uint64_t>(byte) << (8 * i);
        }
        return true;
    }

 private:
    std::ifstream file_;
    bool base64_;
    unsigned held_ = 0;
    int bits_ = 0;
};

constexpr std::uint64_t kMostBlockBytes = std::uint64_t{1} << 50;

// How many characters stand for so many bytes.
std::uint64_t characters(bool base64, std::uint64_t bytes) {
    return base64 ? (bytes + 2) / 3 * 4 : bytes;
}

// Whether base64 of these numbers of bytes, one encoded behind the other, stands there without
// anything between: VTK 9.1 takes blanks, comments and other padding for values.
bool isUnbroken(const std::filesystem::path& path, std::uint64_t at, bool mayBeginWithBlanks,
                std::initializer_list<std::uint64_t> all) {
    constexpr std::uint64_t kPiece = 1 << 16;
    std::ifstream file(path, std::ios::binary);
    file.seekg(static_cast<std::streamoff>(at));
    if (mayBeginWithBlanks) file >> std::ws;
    std::array<bool, 256> isDigit{};
    for (const char c : kBase64) isDigit[static_cast<unsigned char>(c)] = true;
    std::string piece;
    const auto read = [&](std::uint64_t count) {
        piece.resize(count);
        return static_cast<bool>(file.read(piece.data(), static_cast<std::streamsize>(count)));
    };
    for (const std::uint64_t bytes : all) {
        const std::uint64_t padding = (3 - bytes % 3) % 3;
        for (std::uint64_t left = characters(true, bytes) - padding; left > 0;) {
            if (!read(std::min(left, kPiece))) return false;
            if (!std::ranges::all_of(
                    piece, [&](char c) { return isDigit[static_cast<unsigned char>(c)]; }))
                return false;
            left -= piece.size();
        }
        if (!read(padding) || piece.find_first_not_of('=') != piece.npos) return false;
    }
    return true;
}

struct Check {
    const std::filesystem::path& path;
    const VtkEncoding& encoding;
    std::string_view place;
    bool base64;
    std::uint64_t available;  // characters from the array's first on
    std::uint64_t bytes;      // of the values, unpacked
    std::uint64_t at;         // of the file, the array's first
    bool isAppended = false;

    [[noreturn]] void fail(const std::string& what) const { failVtk(path, place, what); }

    void expectUnbroken(std::initializer_list<std::uint64_t> all) const {
        if (base64 && !isUnbroken(path, at, !isAppended, all))
            fail("expected base64 in one piece, without blanks or anything else within");
    }

    std::uint64_t plainBytes(Source& source) const {
        std::uint64_t declared = 0;
        if (!source.number(encoding, declared)) fail("expected values, but the file ends");
        return declared;
    }
    // As the blocks say: not more than the file can unpack to.
    std::uint64_t unpackedBytes(Source& source) const {
        std::uint64_t blocks = 0, blockBytes = 0, lastBytes = 0;
        if (!source.number(encoding, blocks) || !source.number(encoding, blockBytes) ||
            !source.number(encoding, lastBytes))
            fail("expected values, but the file ends");
        const std::uint64_t full = blocks - (blocks > 0 && lastBytes != 0 ? 1 : 0);
        if (blocks > available || (full > 0 && blockBytes > kMostBlockBytes / full))
            fail(fmt::format("expected blocks within the file, found {} of {} bytes", blocks,
                             blockBytes));
        return full * blockBytes + lastBytes;
    }

    // The characters that the values take.
    std::uint64_t plain(Source& source) const {
        const std::uint64_t declared = plainBytes(source);
        if (declared != bytes)
            fail(fmt::format("expected {} bytes of values, found {}", bytes, declared));
        if (bytes > available || characters(base64, encoding.headerBytes + bytes) > available)
            fail(fmt::format("expected {} bytes of values, but the file ends before", bytes));
        expectUnbroken({encoding.headerBytes + bytes});
        return characters(base64, encoding.headerBytes + bytes);
    }

    std::uint64_t compressed(Source& source) const {
        std::uint64_t blocks = 0, blockBytes = 0, lastBytes = 0;
        if (!source.number(encoding, blocks) || !source.number(encoding, blockBytes) ||
            !source.number(encoding, lastBytes))
            fail("expected values, but the file ends");
        // The last block may be a part, also when it is the only one.
        const std::uint64_t full = blocks - (lastBytes != 0 ? 1 : 0);
        const bool possible = blocks > 0 && blocks <= available && lastBytes <= blockBytes &&
                              (full == 0 || blockBytes <= bytes / full) &&
                              full * blockBytes + lastBytes == bytes;
        if (!possible)
            fail(fmt::format("expected {} bytes of values, found {} blocks of {} and {}", bytes,
                             blocks, blockBytes, lastBytes));
        std::uint64_t packed = 0;
        for (std::uint64_t i = 0; i < blocks; ++i) {
            std::uint64_t size = 0;
            if (!source.number(encoding, size)) fail("expected values, but the file ends");
            const bool last = i + 1 == blocks && lastBytes != 0;
            const std::uint64_t unpacked = last ? lastBytes : blockBytes;
            if (size > available || (packed += size) > available)
                fail("expected packed values, but the file ends before");
            if (unpacked > size * unpackedPerByte(encoding.compressor))
                fail(fmt::format("expected a block of {} bytes, which {} bytes cannot hold",
                                 unpacked, size));
        }
        // The sizes and the values are encoded apart.
        const std::uint64_t taken =
            characters(base64, (3 + blocks) * encoding.headerBytes) + characters(base64, packed);
        if (taken > available) fail("expected packed values, but the file ends before");
        expectUnbroken({(3 + blocks) * encoding.headerBytes, packed});
        return taken;
    }
};

}  // namespace

VtkEncoding vtkEncodingOf(const XmlFile& file) {
    const XmlElement& root = file.root;
    VtkEncoding encoding;
    const auto choice = [&](std::string_view name, std::string_view usual, std::string_view other) {
        const std::string_view value = root.has(name) ? root.attribute(name) : usual;
        if (value != usual && value != other)
            failVtk(file.path, "VTKFile",
                    fmt::format("expected {} {} or {}, found \"{}\"", name, usual, other, value));
        return value == other;
    };
    encoding.bigEndian = choice("byte_order", "LittleEndian", "BigEndian");
    encoding.headerBytes = choice("header_type", "UInt32", "UInt64") ? 8 : 4;
    encoding.compressor = root.attribute("compressor");
    if (!encoding.compressor.empty() && encoding.compressor != "vtkZLibDataCompressor" &&
        encoding.compressor != "vtkLZ4DataCompressor" &&
        encoding.compressor != "vtkLZMADataCompressor")
        failVtk(file.path, "VTKFile",
                fmt::format("expected a compressor of zlib, LZ4 or LZMA, found \"{}\"",
                            encoding.compressor));
    return encoding;
}

namespace {

// Where an array's bytes lie; of text none.
struct Stored {
    Check check;
    bool isText = false;
};

Stored storedAt(const XmlFile& file, const VtkEncoding& encoding, const XmlElement& array,
                std::string_view place, std::uint64_t bytes) {
    const std::string_view format = array.has("format") ? array.attribute("format") : "ascii";
    Stored stored{{file.path, encoding, place, true, array.characters, bytes, array.textAt}};
    if (format == "ascii") {
        stored.isText = true;
        return stored;
    }
    Check& check = stored.check;
    if (format == "appended") {
        const std::string_view text = array.attribute("offset");
        const auto offset = vtkNumber<std::uint64_t>(text);
        if (!offset) check.fail(fmt::format("expected an offset, found \"{}\"", text));
        if (file.appendedAt == 0 || *offset >= file.bytes - file.appendedAt)
            check.fail("expected appended values, but the file ends before");
        check.isAppended = true;
        check.at = file.appendedAt + *offset;
        check.available = file.bytes - check.at;
        check.base64 = file.appendedEncoding == "base64";
    } else if (format != "binary") {
        check.fail(
            fmt::format("expected the format ascii, binary or appended, found \"{}\"", format));
    }
    return stored;
}

}  // namespace

std::uint64_t checkVtkValues(const XmlFile& file, const VtkEncoding& encoding,
                             const XmlElement& array, std::string_view place, std::uint64_t values,
                             std::size_t valueBytes) {
    const Stored stored = storedAt(file, encoding, array, place, values * valueBytes);
    if (stored.isText) {
        if (array.words != values)
            stored.check.fail(fmt::format("expected {} values, found {}", values, array.words));
        return array.characters;
    }
    if (stored.check.bytes == 0) return 0;
    Source source(file.path, stored.check.at, stored.check.base64);
    return encoding.compressor.empty() ? stored.check.plain(source)
                                       : stored.check.compressed(source);
}

std::optional<std::uint64_t> rawVtkValuesAt(const XmlFile& file, const VtkEncoding& encoding,
                                            const XmlElement& array, std::string_view place) {
    const Stored stored = storedAt(file, encoding, array, place, 0);
    const bool isNative = encoding.bigEndian == (std::endian::native == std::endian::big);
    if (stored.isText || stored.check.base64 || !encoding.compressor.empty() || !isNative)
        return std::nullopt;
    return stored.check.at + encoding.headerBytes;
}

std::uint64_t countVtkValues(const XmlFile& file, const VtkEncoding& encoding,
                             const XmlElement& array, std::string_view place,
                             std::size_t valueBytes) {
    const Stored stored = storedAt(file, encoding, array, place, 0);
    if (stored.isText) return array.words;
    Source source(file.path, stored.check.at, stored.check.base64);
    const std::uint64_t bytes = encoding.compressor.empty() ? stored.check.plainBytes(source)
                                                            : stored.check.unpackedBytes(source);
    if (bytes % valueBytes != 0)
        stored.check.fail(
            fmt::format("expected values of {} bytes, found {} bytes", valueBytes, bytes));
    return bytes / valueBytes;
}

namespace {

constexpr std::size_t kMostPackedBytes = 1024;  // of few values

// "" where they unpack to something else than so many bytes.
std::string unpacked(const std::string& packed, std::size_t bytes, std::string_view compressor) {
    std::string out(bytes, '\0');
    uLongf size = bytes;
    bool done = false;
    if (compressor == "vtkZLibDataCompressor")
        done = uncompress(reinterpret_cast<Bytef*>(out.data()), &size,
                          reinterpret_cast<const Bytef*>(packed.data()), packed.size()) == Z_OK &&
               size == bytes;
    else
        done = LZ4_decompress_safe(packed.data(), out.data(), static_cast<int>(packed.size()),
                                   static_cast<int>(bytes)) == static_cast<int>(bytes);
    return done ? out : "";
}

// Where they are one block.
std::optional<std::string> packedValues(const Stored& stored) {
    const Check& check = stored.check;
    Source source(check.path, check.at, check.base64);
    check.compressed(source);
    Source header(check.path, check.at, check.base64);
    std::array<std::uint64_t, 4> numbers{};  // blocks, bytes of each and of the last, packed bytes
    for (std::uint64_t& number : numbers) header.number(check.encoding, number);
    if (numbers[0] != 1 || numbers[3] > kMostPackedBytes) return std::nullopt;
    // The sizes and the values are encoded apart.
    Source values(check.path,
                  check.at + characters(check.base64, numbers.size() * check.encoding.headerBytes),
                  check.base64);
    std::string found = unpacked(values.bytes(numbers[3]), check.bytes, check.encoding.compressor);
    return found.empty() ? std::nullopt : std::optional(std::move(found));
}

}  // namespace

std::optional<std::string> readVtkValues(const XmlFile& file, const VtkEncoding& encoding,
                                         const XmlElement& array, std::string_view place,
                                         std::size_t bytes) {
    const Stored stored = storedAt(file, encoding, array, place, bytes);
    if (stored.isText || encoding.compressor == "vtkLZMADataCompressor") return std::nullopt;
    if (!encoding.compressor.empty()) return packedValues(stored);
    Source source(file.path, stored.check.at, stored.check.base64);
    stored.check.plain(source);
    std::string found = source.bytes(bytes);
    return found.size() == bytes ? std::optional(std::move(found)) : std::nullopt;
}

}  // namespace timeseries
