#include "timeseries/readers/foam/foam_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "timeseries/readers/limits.h"
#include "timeseries/readers/ordinary_file.h"
#include "timeseries/readers/reader.h"

namespace timeseries {
namespace {

constexpr std::size_t kFoamBuffer = std::size_t{1} << 18;

bool isFoamBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
bool isFoamMark(char c) {
    return c == '(' || c == ')' || c == '{' || c == '}' || c == '[' || c == ']' || c == ';';
}

// Whether a byte of this name may unpack to more.
bool isPacked(const std::filesystem::path& path) { return path.extension() == ".gz"; }

std::uint64_t mostBytesOf(const std::filesystem::path& path) {
    std::error_code ignored;
    const auto size = std::filesystem::file_size(path, ignored);
    if (ignored) return 0;
    return isPacked(path) ? size * kMaxInflated : size;
}

}  // namespace

std::filesystem::path foamPath(const std::filesystem::path& folder, const std::string& name) {
    std::error_code ignored;
    if (std::filesystem::path packed = folder / (name + ".gz");
        !std::filesystem::exists(folder / name, ignored) &&
        std::filesystem::exists(packed, ignored))
        return packed;
    return folder / name;
}

FoamFile::FoamFile(std::filesystem::path path)
    : path_(std::move(path)), mostBytes_(0), file_(nullptr, gzclose_r), buffer_(kFoamBuffer) {
    expectFile(path_);
    mostBytes_ = mostBytesOf(path_);
    // What is not packed zlib reads as it is, but of what is packed a name must say so.
    file_.reset(gzopen(path_.c_str(), "rbe"));
    if (!file_) fail("expected a file that can be read");
    gzbuffer(file_.get(), kFoamBuffer);
    if (!isPacked(path_) && !gzdirect(file_.get()))
        fail("expected a name that ends in .gz, for it is compressed");
    readHeader();
}

void FoamFile::fail(std::string_view what) const {
    // It may quote the file, of which a string may have several lines.
    constexpr std::size_t kLongestSentence = 300;
    std::string sentence(what.substr(0, kLongestSentence));
    for (char& c : sentence)
        if (static_cast<unsigned char>(c) < ' ') c = '?';
    const auto lines = std::count(buffer_.begin(), buffer_.begin() + std::ptrdiff_t(at_), '\n');
    const std::string place = header_.isBinary
                                  ? fmt::format("byte {}", passed_ + at_)
                                  : fmt::format("line {}", lines_ + std::uint64_t(lines) + 1);
    throw FileError(fmt::format("{}: {}: {}", path_.string(), place, sentence));
}

// Whether so many bytes stand in the buffer, if the file has them.
bool FoamFile::fill(std::size_t bytes) {
    if (end_ - at_ >= bytes || atEnd_) return end_ - at_ >= bytes;
    const auto begin = buffer_.begin();
    lines_ += std::uint64_t(std::count(begin, begin + std::ptrdiff_t(at_), '\n'));
    std::copy(begin + std::ptrdiff_t(at_), begin + std::ptrdiff_t(end_), begin);
    passed_ += at_;
    end_ -= at_;
    at_ = 0;
    while (end_ < buffer_.size()) {
        const int got = gzread(file_.get(), buffer_.data() + end_, unsigned(buffer_.size() - end_));
        if (got < 0) fail("expected data that can be unpacked");
        atEnd_ = got == 0;
        if (atEnd_) break;
        end_ += std::size_t(got);
    }
    return end_ >= bytes;
}

void FoamFile::skipLine() {
    while (fill(1) && buffer_[at_] != '\n') ++at_;
}

// And comments.
void FoamFile::skipBlanks() {
    while (fill(1)) {
        if (isFoamBlank(buffer_[at_])) {
            ++at_;
            continue;
        }
        if (buffer_[at_] != '/' || !fill(2)) return;
        if (buffer_[at_ + 1] == '/') {
            skipLine();
        } else if (buffer_[at_ + 1] == '*') {
            at_ += 2;
            while (fill(2) && !(buffer_[at_] == '*' && buffer_[at_ + 1] == '/')) ++at_;
            if (!fill(2)) fail("expected the end of a comment");
            at_ += 2;
        } else {
            return;
        }
    }
}

// Of the word that begins here, in the buffer.
std::size_t FoamFile::wordEnd() const {
    const std::size_t most = std::min(end_, at_ + kLongestWord);
    std::size_t last = at_;
    while (last < most && !isFoamBlank(buffer_[last]) && !isFoamMark(buffer_[last]) &&
           buffer_[last] != '"' &&
           !(buffer_[last] == '/' && last + 1 < most &&
             (buffer_[last + 1] == '/' || buffer_[last + 1] == '*')))
        ++last;
    if (last == at_ + kLongestWord)
        fail(fmt::format("expected words of less than {} characters", kLongestWord));
    return last;
}

std::string_view FoamFile::next() {
    skipBlanks();
    fill(kLongestWord);
    if (at_ == end_) return {};
    const std::size_t first = at_;
    if (isFoamMark(buffer_[at_])) {
        ++at_;
    } else if (buffer_[at_] == '"') {
        const std::size_t most = std::min(end_, at_ + kLongestWord);
        for (++at_; at_ < most && buffer_[at_] != '"'; ++at_)
            if (buffer_[at_] == '\\' && at_ + 1 < most) ++at_;
        if (at_ == most) fail("expected the end of a string in quotes");
        ++at_;
    } else {
        at_ = wordEnd();
    }
    return {buffer_.data() + first, at_ - first};
}

std::string_view FoamFile::peek() {
    skipBlanks();
    fill(kLongestWord);
    const std::size_t before = at_;
    const std::string_view token = next();
    at_ = before;  // what was filled before stays where it is
    return token;
}

bool FoamFile::take(std::string_view token) {
    if (peek() != token) return false;
    at_ += token.size();
    return true;
}

void FoamFile::expect(std::string_view token) {
    if (!take(token)) fail(fmt::format("expected '{}'", token));
}

void FoamFile::skipEntry() {
    for (std::uint64_t depth = 0;;) {
        const std::string_view token = next();
        if (token.empty()) fail("expected the end of an entry");
        if (token == "{" || token == "(" || token == "[") ++depth;
        if (token == "}" || token == ")" || token == "]") {
            if (depth == 0) fail(fmt::format("expected ';', found '{}'", token));
            if (--depth == 0 && token == "}") return;
        }
        if (token == ";" && depth == 0) return;
    }
}

void FoamFile::readArch(std::string_view arch) {
    header_.hasArch = true;
    const auto bytesOf = [&](std::string_view key) {
        const std::size_t at = arch.find(key);
        const std::string_view bits = at == arch.npos ? "" : arch.substr(at + key.size(), 2);
        if (bits != "32" && bits != "64")
            fail(fmt::format("expected an arch that says {}32 or {}64", key, key));
        return bits == "32" ? 4u : 8u;
    };
    header_.labelBytes = bytesOf("label=");
    header_.scalarBytes = bytesOf("scalar=");
}

void FoamFile::readHeader() {
    if (!take("FoamFile")) fail("expected a header that begins with FoamFile");
    expect("{");
    bool isBinary = false, isMsb = false;
    while (!take("}")) {
        const std::string keyword(next());
        if (keyword.empty()) fail("expected the end of the header");
        if (keyword == ";") continue;  // behind a dictionary
        if (keyword == "{") fail("expected entries in the header, found '{'");
        const std::string value(peek());
        if (keyword == "class") header_.className = value;
        if (keyword == "arch") {
            readArch(value);
            isMsb = value.find("MSB") != value.npos;
        }
        if (keyword == "format") {
            if (value != "ascii" && value != "binary")
                fail(fmt::format("expected the format ascii or binary, found '{}'", value));
            isBinary = value == "binary";
        }
        skipEntry();
    }
    if (isBinary && isMsb) fail("expected numbers in the byte order of this machine, found MSB");
    header_.isBinary = isBinary;
}

}  // namespace timeseries
