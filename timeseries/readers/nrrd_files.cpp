#include "timeseries/readers/nrrd_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "timeseries/readers/ordinary_file.h"
#include "timeseries/readers/words.h"

namespace timeseries {
namespace {

constexpr std::string_view kPlace = "field 'data file'";
constexpr std::uint64_t kMaxFiles = std::uint64_t{1} << 20;

template <typename T>
std::optional<T> wholeNumber(std::string_view text) {
    T number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

// "quarter.%03d": one %d, with a width at most; %% is a percent sign. printf is never asked.
struct Pattern {
    std::string before, after;
    std::size_t width = 0;
    bool zeros = false;

    static std::optional<Pattern> parse(std::string_view text) {
        Pattern pattern;
        bool found = false;
        for (std::size_t i = 0; i < text.size(); ++i) {
            std::string& out = found ? pattern.after : pattern.before;
            if (text[i] != '%') {
                out += text[i];
                continue;
            }
            if (text.substr(i, 2) == "%%") {
                out += text[i++];
                continue;
            }
            std::size_t end = text.find_first_not_of("0123456789", i + 1);
            const std::string_view digits = text.substr(i + 1, std::min(end, text.size()) - i - 1);
            if (found || end == std::string_view::npos || text[end] != 'd' || digits.size() > 2)
                return std::nullopt;
            pattern.zeros = digits.starts_with('0');
            pattern.width = wholeNumber<std::size_t>(digits).value_or(0);
            found = true;
            i = end;
        }
        return found ? std::optional(pattern) : std::nullopt;
    }

    std::string name(std::int64_t number) const {
        return before +
               (zeros ? fmt::format("{:0{}d}", number, width)
                      : fmt::format("{:{}d}", number, width)) +
               after;
    }
};

// As teem has it: from the header's folder, upwards too, unless the name is absolute.
std::filesystem::path fromHeader(const NrrdHeader& header, const std::string& name) {
    if (name.empty()) header.fail(kPlace, "expected the name of a file");
    return header.path.parent_path() / name;
}

// Into how many files the values are cut, when each holds the `subdim` fastest axes; when it holds
// all of them, slabs of the slowest.
void expectFiles(const NrrdHeader& header, std::uint64_t found, std::size_t subdim) {
    if (subdim < 1 || subdim > header.axes.size())
        header.fail(kPlace, fmt::format("expected files of 1 to {} dimensions, found {}",
                                        header.axes.size(), subdim));
    if (found > kMaxFiles)
        header.fail(kPlace, fmt::format("expected at most {} files, found {}", kMaxFiles, found));
    std::uint64_t expected = 1;
    for (std::size_t i = subdim; i < header.axes.size(); ++i) expected *= header.axes[i].size;
    if (subdim == header.axes.size()) {
        if (found == 0 || header.axes.back().size % found != 0)
            header.fail(kPlace, fmt::format("expected files that cut {} slices evenly, found {}",
                                            header.axes.back().size, found));
    } else if (found != expected) {
        header.fail(kPlace, fmt::format("expected {} files, found {}", expected, found));
    }
}

std::size_t subdimOf(const NrrdHeader& header, std::string_view text) {
    const auto subdim = wholeNumber<std::size_t>(text);
    if (!subdim)
        header.fail(kPlace,
                    fmt::format("expected a number of dimensions, found '{}'", text.substr(0, 40)));
    return *subdim;
}

std::vector<std::string> listed(const NrrdHeader& header, const std::vector<std::string>& head) {
    if (head[0] != "LIST" || head.size() > 2)
        header.fail(kPlace, fmt::format("expected LIST and a number at most, found '{}'",
                                        header.dataFile->substr(0, 40)));
    expectFiles(header, header.dataFileList.size(),
                head.size() == 2 ? subdimOf(header, head[1]) : header.axes.size() - 1);
    return header.dataFileList;
}

// "PATTERN MIN MAX STEP [SUBDIM]"; nothing when the text has no such numbers: then it is a name.
std::optional<std::vector<std::string>> numbered(const NrrdHeader& header,
                                                 const std::vector<std::string>& head) {
    if (head.size() < 4 || head.size() > 5 || head[0].find('%') == std::string::npos)
        return std::nullopt;
    const auto pattern = Pattern::parse(head[0]);
    if (!pattern)
        header.fail(kPlace, fmt::format("expected a pattern with one %d, found '{}'",
                                        head[0].substr(0, 200)));
    const auto min = wholeNumber<std::int32_t>(head[1]), max = wholeNumber<std::int32_t>(head[2]),
               step = wholeNumber<std::int32_t>(head[3]);
    if (!min || !max || !step || *step == 0 || (*max != *min && (*max > *min) != (*step > 0)))
        header.fail(kPlace, fmt::format("expected first and last number and a step between them, "
                                        "found '{}'",
                                        header.dataFile->substr(0, 200)));
    const std::int64_t count = (std::int64_t{*max} - *min) / *step + 1;
    expectFiles(header, static_cast<std::uint64_t>(count),
                head.size() == 5 ? subdimOf(header, head[4]) : header.axes.size() - 1);
    std::vector<std::string> names;
    for (std::int64_t i = 0; i < count; ++i)
        names.push_back(pattern->name(std::int64_t{*min} + i * *step));
    return names;
}

std::vector<std::string> namesOf(const NrrdHeader& header) {
    const std::vector<std::string> head = words(*header.dataFile);
    if (head.empty()) header.fail(kPlace, "expected the name of a file");
    if (header.dataFile->starts_with("LIST") || header.dataFile->starts_with("SKIPLIST"))
        return listed(header, head);
    if (auto names = numbered(header, head)) return *names;
    return {*header.dataFile};
}

std::uint64_t sizeOf(const NrrdHeader& header, const std::filesystem::path& path) {
    std::string flaw = flawOfFile(path);
    std::error_code error;
    const std::uint64_t bytes = std::filesystem::file_size(path, error);
    if (error && flaw.empty()) flaw = "expected a file that can be read";
    if (!flaw.empty()) header.fail(kPlace, fmt::format("{}: {}", path.string(), flaw));
    return bytes;
}

// bzip2 packs megabytes of one value into 50 bytes: so much is believed of any file.
constexpr double kBzip2FreeBytes = 67108864;

// The fewest bytes that can stand for the values of one piece. Deflate unpacks to at most about
// 1032 times its bytes (RFC 1951), and so much more is believed of bzip2; text needs a digit and a
// blank a value.
double leastBytes(const NrrdHeader& header, std::uint64_t count) {
    const double points = static_cast<double>(count);
    const double bytes = points * static_cast<double>(header.valueBytes());
    switch (header.encoding) {
        case NrrdEncoding::Raw:
            return bytes;
        case NrrdEncoding::Gzip:
            return bytes / 1100;
        case NrrdEncoding::Bzip2:
            return std::max(bytes - kBzip2FreeBytes, 0.0) / 1100;
        case NrrdEncoding::Ascii:
            return 2 * points - 1;
    }
    return bytes;
}

}  // namespace

NrrdPieces piecesOf(const NrrdHeader& header, std::vector<std::string>& notes) {
    if (header.byteSkip < -1)
        header.fail("field 'byte skip'",
                    fmt::format("expected -1 or more, found {}", header.byteSkip));
    if (header.byteSkip == -1 && header.encoding != NrrdEncoding::Raw)
        header.fail("field 'byte skip'", "expected -1 for the encoding raw alone");
    NrrdPieces pieces;
    const std::uint64_t count = header.pointCount();
    if (header.dataFile) {
        for (const std::string& name : namesOf(header))
            pieces.paths.push_back(fromHeader(header, name));
    } else {
        pieces.paths = {header.path};
        pieces.headerBytes = header.headerBytes;
    }
    pieces.pieceCount = count / pieces.paths.size();

    const double least = leastBytes(header, pieces.pieceCount);
    const bool raw = header.encoding == NrrdEncoding::Raw;
    const auto before =
        pieces.headerBytes +
        (raw ? static_cast<std::uint64_t>(std::max<std::int64_t>(header.byteSkip, 0)) : 0);
    std::uint64_t beyond = 0;
    for (const std::filesystem::path& path : pieces.paths) {
        const std::uint64_t bytes = sizeOf(header, path);
        const std::uint64_t left = bytes - std::min(bytes, before);
        if (static_cast<double>(left) < least)
            header.fail(
                pieces.paths.size() > 1 ? path.string() : "values",
                fmt::format("expected at least {:.0f} bytes for {} values{}, found {}", least,
                            pieces.pieceCount, raw ? "" : " in this encoding", left));
        if (raw && header.byteSkip >= 0 && header.lineSkip == 0)
            beyond += left - pieces.pieceCount * header.valueBytes();
    }
    if (beyond > 0)
        notes.push_back(
            fmt::format("{} bytes behind the values are not read: the file is larger than its "
                        "header declares",
                        beyond));
    return pieces;
}

}  // namespace timeseries
