#include "timeseries/readers/vtk/vtk_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>

#include "timeseries/grid/with_type.h"
#include "timeseries/readers/text/words.h"
#include "timeseries/readers/vtk/vtk_number.h"

namespace timeseries {
namespace {

constexpr std::size_t kMaxWord = 255;  // of VTK's reader

bool blank(int c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

static_assert(std::endian::native == std::endian::little);

// Of the file's big-endian bytes. An id has 32 bits there and 64 in memory.
double decode(const VtkType& type, const char* bytes) {
    const bool id = type.type == ValueType::I64 && type.bytes == 4;
    return withType(id ? ValueType::I32 : type.type, [&](auto number) {
        std::reverse_copy(bytes, bytes + sizeof number, reinterpret_cast<char*>(&number));
        return static_cast<double>(number);
    });
}

}  // namespace

VtkText::VtkText(const std::filesystem::path& path)
    : path_(path), bytes_(std::filesystem::file_size(path)), file_(path, std::ios::binary) {
    if (!file_) fail("expected a file that can be read");
}

std::string VtkText::place() const { return fmt::format("line {}", line_); }

void VtkText::fail(std::string_view what) const { failVtk(path_, place(), what); }

int VtkText::next() {
    const int c = file_.rdbuf()->sbumpc();
    if (c == '\n') ++line_;
    return c;
}

std::string VtkText::line() {
    std::string text;
    for (int c = next(); c != '\n'; c = next()) {
        if (c < 0) fail("expected another line, but the file ends");
        if (text.size() == kMaxWord) fail("expected at most 255 characters in a line");
        text += static_cast<char>(c);
    }
    if (text.ends_with('\r')) text.pop_back();
    return text;
}

std::string VtkText::word() {
    int c = file_.rdbuf()->sgetc();
    while (blank(c)) {
        next();
        c = file_.rdbuf()->sgetc();
    }
    std::string text;
    for (; c >= 0 && !blank(c); c = file_.rdbuf()->sgetc()) {
        if (text.size() == kMaxWord) fail("expected at most 255 characters in a word");
        text += static_cast<char>(next());
    }
    return text;
}

std::string VtkText::lowerWord() { return lower(word()); }

// VTK 9.1 reads on behind a '%' that ends a word of one or two characters.
void VtkText::checkCodes(std::string_view word) const {
    if (word.size() < 3 && word.find('%') != word.npos)
        fail(fmt::format("expected %25 for a per cent sign, found \"{}\"", word));
}

std::string VtkText::decoded(std::string_view name) const {
    checkCodes(name);
    std::string plain;
    for (std::size_t i = 0; i < name.size(); ++i) {
        unsigned char code = 0;
        const char* const digits = name.data() + i + 1;
        const bool coded = name[i] == '%' && i + 2 < name.size() &&
                           std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
        plain += coded ? static_cast<char>(code) : name[i];
        if (coded) i += 2;
    }
    return plain;
}

std::string VtkText::name() {
    const std::string text = word();
    if (text.empty()) fail("expected a name, but the file ends");
    return decoded(text);
}

std::uint64_t VtkText::count(std::string_view what) {
    const std::string text = word();
    const auto value = vtkNumber<std::int32_t>(text);  // VTK's int
    if (!value || *value < 0)
        fail(fmt::format("expected {}, a whole number, found \"{}\"", what, text));
    return static_cast<std::uint64_t>(*value);
}

double VtkText::number(std::string_view what) {
    const std::string text = word();
    const auto value = vtkNumber<double>(text);
    if (!value) fail(fmt::format("expected {}, a finite number, found \"{}\"", what, text));
    return *value;
}

std::optional<std::size_t> VtkText::skipEncodedLine() {
    std::size_t solid = 0;
    std::string word;  // as much of it as is checked
    for (int c = next();; c = next()) {
        if (c >= 0 && !blank(c)) {
            ++solid;
            if (word.size() < 3) word += static_cast<char>(c);
            continue;
        }
        checkCodes(word);
        word.clear();
        if (c < 0) return std::nullopt;
        if (c == '\n') return solid;
    }
}

void VtkText::skipParagraph() {
    if (!skipEncodedLine()) return;
    while (skipEncodedLine().value_or(0) > 0) {
    }
}

void VtkText::beginBytes(std::uint64_t bytes) {
    for (int c = next(); c != '\n'; c = next())
        if (c < 0) fail("expected values, but the file ends");
    const auto at = static_cast<std::uint64_t>(file_.tellg());
    if (bytes > bytes_ - at)
        fail(fmt::format("expected {} bytes of values, but the file ends after {}", bytes,
                         bytes_ - at));
}

void VtkText::skipBytesOrWords(std::uint64_t bytes, std::uint64_t words) {
    if (binary_) {
        beginBytes(bytes);
        file_.seekg(static_cast<std::streamoff>(bytes), std::ios::cur);
        return;
    }
    checkWords(words);
    for (std::uint64_t i = 0; i < words; ++i)
        if (word().empty()) fail(fmt::format("expected {} values, found {}", words, i));
}

void VtkText::checkWords(std::uint64_t count) const {
    if (count > bytes_) fail(fmt::format("expected {} values, but the file is too small", count));
}

void VtkText::skipNumbers(const VtkType& type, std::uint64_t count) {
    if (binary_) return skipBytesOrWords(count * type.bytes, 0);
    checkWords(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::string text = word();
        if (text.empty()) fail(fmt::format("expected {} values, found {}", count, i));
        if (!isVtkNumber(type.type, text))
            fail(fmt::format("expected a finite number of type {}, found \"{}\"",
                             typeName(type.type), text));
    }
}

std::vector<double> VtkText::numbers(const VtkType& type, std::uint64_t count) {
    std::vector<double> found;
    if (!binary_) {
        while (found.size() < count) found.push_back(number("a value"));
        return found;
    }
    beginBytes(count * type.bytes);
    std::array<char, 8> bytes{};
    while (found.size() < count) {
        file_.read(bytes.data(), static_cast<std::streamsize>(type.bytes));
        found.push_back(decode(type, bytes.data()));
    }
    return found;
}

// A line each, or each after its length: two bits tell how long the length is, in 6, 14, 30 or 62
// bits (vtkDataReader::ReadArray).
void VtkText::skipStrings(std::uint64_t count) {
    if (!skipEncodedLine()) fail("expected text, but the file ends");
    for (std::uint64_t i = 0; i < count; ++i) {
        if (!binary_) {
            if (!skipEncodedLine()) fail("expected another line of text, but the file ends");
            continue;
        }
        const int c = next();
        if (c < 0) fail("expected text, but the file ends");
        const unsigned form = static_cast<unsigned>(c) >> 6;
        std::uint64_t length = static_cast<unsigned>(c) & 63;
        for (unsigned more = form == 3 ? 0 : form == 2 ? 1 : form == 1 ? 3 : 7; more > 0; --more)
            length = length << 8 | static_cast<unsigned char>(next());
        const auto at = static_cast<std::uint64_t>(file_.tellg());
        if (length > bytes_ - at) fail("expected text, but the file ends");
        file_.seekg(static_cast<std::streamoff>(length), std::ios::cur);
    }
}

}  // namespace timeseries
