#include "timeseries/readers/arrays/nrrd_header.h"

#include <fmt/format.h>
#include <teem/nrrd.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <fstream>
#include <memory>
#include <mutex>

#include "timeseries/readers/arrays/nrrd_files.h"
#include "timeseries/readers/text/words.h"

namespace timeseries {
namespace {

// Slicer writes whole XML texts into key/value pairs; more than this is no header.
constexpr std::size_t kMaxHeaderBytes = std::size_t{1} << 24;
constexpr std::size_t kMaxLines = std::size_t{1} << 20;
// teem compares each key, and each comment, with all before it.
constexpr std::size_t kMaxPairs = std::size_t{1} << 13;
// teem 1.12 writes a field that it does not understand into about a thousand bytes of the stack,
// however long it is.
constexpr std::size_t kMaxField = 800;

// teem and its error texts (biff) are global.
std::mutex& teemMutex() {
    static std::mutex one;
    return one;
}

std::string_view trim(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r";
    const auto first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

// The header as teem reads it, without comments and the lines taken out here.
struct HeaderText {
    std::string forTeem;
    std::size_t lines = 0, pairs = 0;
    bool ended = false;  // by a blank line
    NrrdDataFile dataFile;
};

// "0", "-3", "x" -> what is wrong with it, for sizes; teem reads the first two as huge or zero.
void checkSizes(const ArrayHeader& header, std::string_view list) {
    for (const std::string& word : words(list)) {
        std::uint64_t size = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), size);
        if (error != std::errc() || end != word.data() + word.size() || size == 0)
            header.fail("field 'sizes'",
                        fmt::format("expected whole numbers from 1 to 2^64 - 1, found '{}'",
                                    word.substr(0, 40)));
    }
}

// teem 1.12 loses memory over a quotation that does not end.
void checkQuotes(const ArrayHeader& header, const std::string& field, std::string_view text) {
    bool open = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\\' && open)
            ++i;
        else if (text[i] == '"')
            open = !open;
    }
    if (open) header.fail(fmt::format("field '{}'", field), "expected quotation marks in pairs");
}

void takeLine(std::string_view line, const ArrayHeader& header, HeaderText& text) {
    if (line[0] == '#') return;
    // "name: description"; "key:=value" is teem's.
    const auto colon = line.find(": ");
    const auto pair = line.find(":=");
    const bool field = colon != std::string_view::npos && colon < pair;
    const bool isPair = !field && pair != std::string_view::npos;
    if (isPair && ++text.pairs > kMaxPairs)
        header.fail("header", fmt::format("expected at most {} key/value pairs", kMaxPairs));
    const std::string name = field ? lower(trim(line.substr(0, colon))) : "";
    if (name == "data file" || name == "datafile") {
        if (text.dataFile.field) header.fail("field 'data file'", "expected it once");
        text.dataFile.field = std::string(trim(line.substr(colon + 2)));
        return;
    }
    if (!isPair && name != "content" && line.size() > kMaxField)
        header.fail(fmt::format("line {}", text.lines),
                    fmt::format("expected a field of at most {} characters, found {}", kMaxField,
                                line.size()));
    if (name == "sizes") checkSizes(header, line.substr(colon + 2));
    if (name == "labels" || name == "units" || name == "space units")
        checkQuotes(header, name, line.substr(colon + 2));
    if (name == "encoding") {
        const std::string encoding = lower(trim(line.substr(colon + 2)));
        if (encoding == "hex" || encoding == "zrl")
            header.fail("field 'encoding'",
                        fmt::format("expected raw, gzip, bzip2 or text, found {}", encoding));
    }
    text.forTeem += line;
    text.forTeem += '\n';
}

// Up to the first blank line, or to the end of the file.
HeaderText scan(ArrayHeader& header) {
    std::ifstream file(header.path, std::ios::binary);
    if (!file.is_open()) header.fail("", "expected a file that can be read");
    HeaderText text;
    bool list = false;
    std::string chunk(1 << 16, '\0'), line;
    std::uint64_t consumed = 0;
    const auto finishLine = [&] {
        if (!line.empty() && line.back() == '\r') line.pop_back();
        if (line.find('\0') != std::string::npos)
            header.fail(fmt::format("line {}", text.lines + 1), "expected text, found binary data");
        if (++text.lines > kMaxLines)
            header.fail("header", fmt::format("expected at most {} lines", kMaxLines));
        if (line.empty()) {
            text.ended = true;
        } else if (list) {
            text.dataFile.list.emplace_back(trim(line));
        } else {
            takeLine(line, header, text);
            const auto& field = text.dataFile.field;
            list = field && (field->starts_with("LIST") || field->starts_with("SKIPLIST"));
        }
        line.clear();
    };
    while (!text.ended && file) {
        file.read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
        const auto got = static_cast<std::size_t>(file.gcount());
        for (std::size_t i = 0; i < got && !text.ended; ++i) {
            ++consumed;
            if (chunk[i] == '\n')
                finishLine();
            else
                line += chunk[i];
        }
        if (consumed > kMaxHeaderBytes)
            header.fail("header", fmt::format("expected it to end within {} bytes, by a blank line",
                                              kMaxHeaderBytes));
    }
    if (file.bad()) header.fail("", "expected a file that can be read");
    if (!text.ended && !line.empty()) finishLine();
    header.headerBytes = consumed;
    return text;
}

// The innermost message of teem, without the names of its functions.
std::string folded(std::string message) {
    while (!message.empty() && message.back() == '\n') message.pop_back();
    const auto lastLine = message.rfind('\n');
    if (lastLine != std::string::npos) message.erase(0, lastLine + 1);
    if (message.starts_with('[')) message.erase(0, message.find(' ') + 1);
    const auto colon = message.find(": ");
    if (message.starts_with("_nrrd") || message.starts_with("nrrd"))
        if (colon != std::string::npos) message.erase(0, colon + 2);
    return message.substr(0, 200);
}

ValueType valueType(const ArrayHeader& header, int type) {
    switch (type) {
        case nrrdTypeChar:
            return ValueType::I8;
        case nrrdTypeUChar:
            return ValueType::U8;
        case nrrdTypeShort:
            return ValueType::I16;
        case nrrdTypeUShort:
            return ValueType::U16;
        case nrrdTypeInt:
            return ValueType::I32;
        case nrrdTypeUInt:
            return ValueType::U32;
        case nrrdTypeLLong:
            return ValueType::I64;
        case nrrdTypeULLong:
            return ValueType::U64;
        case nrrdTypeFloat:
            return ValueType::F32;
        case nrrdTypeDouble:
            return ValueType::F64;
        default:
            header.fail("field 'type'", "expected numbers, found blocks of bytes");
    }
}

ArrayEncoding encodingOf(const ArrayHeader& header, const ::NrrdEncoding* encoding) {
    if (encoding == nrrdEncodingRaw) return ArrayEncoding::Raw;
    if (encoding == nrrdEncodingGzip) return ArrayEncoding::Gzip;
    if (encoding == nrrdEncodingBzip2) return ArrayEncoding::Bzip2;
    if (encoding == nrrdEncodingAscii) return ArrayEncoding::Ascii;
    header.fail("field 'encoding'",
                fmt::format("expected raw, gzip, bzip2 or text, found {}", encoding->name));
}

ArrayKind kindOf(const NrrdAxisInfo& axis) {
    switch (axis.kind) {
        case nrrdKindUnknown:
            return ArrayKind::Unknown;
        case nrrdKindDomain:
        case nrrdKindSpace:
            return ArrayKind::Space;
        case nrrdKindTime:
            return ArrayKind::Time;
        case nrrdKindList:
            return ArrayKind::List;
        default:
            return ArrayKind::Components;
    }
}

std::string textOf(const char* text) { return text ? text : ""; }

void takeAxis(const NrrdAxisInfo& from, std::size_t spaceDimension, ArrayAxis& axis) {
    axis.size = from.size;
    axis.spacing = from.spacing;
    axis.min = from.min;
    axis.max = from.max;
    if (from.center == nrrdCenterCell) axis.cell = true;
    if (from.center == nrrdCenterNode) axis.cell = false;
    axis.kind = kindOf(from);
    if (from.kind != nrrdKindUnknown) axis.kindName = airEnumStr(nrrdKind, from.kind);
    axis.label = textOf(from.label);
    axis.units = textOf(from.units);
    if (spaceDimension == 0 || std::isnan(from.spaceDirection[0])) return;
    axis.direction.emplace();
    for (std::size_t i = 0; i < spaceDimension; ++i) (*axis.direction)[i] = from.spaceDirection[i];
}

void takeSpace(const Nrrd& nrrd, ArrayHeader& header) {
    header.spaceDimension = std::min<std::size_t>(nrrd.spaceDim, 4);
    if (nrrd.spaceDim > 4)
        header.fail("field 'space dimension'",
                    fmt::format("expected at most 4, found {}", nrrd.spaceDim));
    if (nrrd.space != nrrdSpaceUnknown) header.space = airEnumStr(nrrdSpace, nrrd.space);
    header.timeInSpace = header.space.ends_with("time");
    header.leftHanded = nrrd.space == nrrdSpaceLeftAnteriorSuperior ||
                        nrrd.space == nrrdSpaceLeftAnteriorSuperiorTime ||
                        nrrd.space == nrrdSpace3DLeftHanded ||
                        nrrd.space == nrrdSpace3DLeftHandedTime;
    bool origin = header.spaceDimension > 0;
    for (std::size_t i = 0; i < header.spaceDimension; ++i) {
        header.spaceUnits[i] = textOf(nrrd.spaceUnits[i]);
        origin = origin && std::isfinite(nrrd.spaceOrigin[i]);
    }
    if (!origin) return;
    header.origin.emplace();
    std::copy_n(nrrd.spaceOrigin, header.spaceDimension, header.origin->begin());
}

void take(const Nrrd& nrrd, const NrrdIoState& io, ArrayHeader& header) {
    header.type = valueType(header, nrrd.type);
    header.encoding = encodingOf(header, io.encoding);
    const bool little = std::endian::native == std::endian::little;
    header.swapped = header.valueBytes() > 1 && header.encoding != ArrayEncoding::Ascii &&
                     io.endian == (little ? airEndianBig : airEndianLittle);
    takeSpace(nrrd, header);
    header.axes.resize(nrrd.dim);
    for (std::size_t i = 0; i < nrrd.dim; ++i)
        takeAxis(nrrd.axis[i], header.spaceDimension, header.axes[i]);
    for (unsigned i = 0; i < nrrdKeyValueSize(&nrrd); ++i)
        header.keyValues.emplace_back(textOf(nrrd.kvp[2 * i]), textOf(nrrd.kvp[2 * i + 1]));
    header.name = textOf(nrrd.content);
    header.longName = header.keyValue("quantity");
    header.units = textOf(nrrd.sampleUnits);
    for (const char* key : {"unit", "units"})
        if (header.units.empty()) header.units = header.keyValue(key);
    header.lineSkip = io.lineSkip;
    header.byteSkip = io.byteSkip;
}

void parse(const std::string& text, ArrayHeader& header) {
    const std::lock_guard lock(teemMutex());
    const std::unique_ptr<Nrrd, decltype(&nrrdNuke)> nrrd(nrrdNew(), nrrdNuke);
    const std::unique_ptr<NrrdIoState, decltype(&nrrdIoStateNix)> io(nrrdIoStateNew(),
                                                                     nrrdIoStateNix);
    nrrdIoStateSet(io.get(), nrrdIoStateSkipData, AIR_TRUE);
    if (nrrdStringRead(nrrd.get(), text.c_str(), io.get())) {
        const std::unique_ptr<char, decltype(&std::free)> message(biffGetDone(NRRD), std::free);
        header.fail("header", fmt::format("expected a whole NRRD header, but the library says: {}",
                                          folded(textOf(message.get()))));
    }
    take(*nrrd, *io, header);
}

}  // namespace

ArrayHeader readNrrdHeader(const std::filesystem::path& path) {
    ArrayHeader header;
    header.path = path;
    const HeaderText text = scan(header);
    header.format = text.forTeem.substr(0, text.forTeem.find('\n'));
    if (!header.format.starts_with("NRRD") || header.format.size() > 16)
        header.fail("line 1", "expected NRRD and a version, as in NRRD0004");
    parse(text.forTeem, header);
    if (!text.dataFile.field && !text.ended)
        header.fail("header", "expected a blank line that ends it, or the field 'data file'");
    if (header.byteSkip < -1)
        header.fail("field 'byte skip'",
                    fmt::format("expected -1 or more, found {}", header.byteSkip));
    if (header.byteSkip == -1 && header.encoding != ArrayEncoding::Raw)
        header.fail("field 'byte skip'", "expected -1 for the encoding raw alone");
    if (text.dataFile.field) {
        header.dataFiles = namesOf(header, text.dataFile);
        header.format += ", detached values";
    }
    return header;
}

}  // namespace timeseries
