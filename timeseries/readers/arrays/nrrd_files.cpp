#include "timeseries/readers/arrays/nrrd_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "timeseries/readers/text/words.h"

namespace timeseries {
namespace {

constexpr std::string_view kDataFile = "field 'data file'";
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

// Into how many files the values are cut, when each holds the `subdim` fastest axes; when it holds
// all of them, slabs of the slowest.
void expectFiles(const ArrayHeader& header, std::uint64_t found, std::size_t subdim) {
    if (subdim < 1 || subdim > header.axes.size())
        header.fail(kDataFile, fmt::format("expected files of 1 to {} dimensions, found {}",
                                           header.axes.size(), subdim));
    if (found > kMaxFiles)
        header.fail(kDataFile,
                    fmt::format("expected at most {} files, found {}", kMaxFiles, found));
    std::uint64_t expected = 1;
    for (std::size_t i = subdim; i < header.axes.size(); ++i) expected *= header.axes[i].size;
    if (subdim == header.axes.size()) {
        if (found == 0 || header.axes.back().size % found != 0)
            header.fail(kDataFile, fmt::format("expected files that cut {} slices evenly, found {}",
                                               header.axes.back().size, found));
    } else if (found != expected) {
        header.fail(kDataFile, fmt::format("expected {} files, found {}", expected, found));
    }
}

std::size_t subdimOf(const ArrayHeader& header, std::string_view text) {
    const auto subdim = wholeNumber<std::size_t>(text);
    if (!subdim)
        header.fail(kDataFile,
                    fmt::format("expected a number of dimensions, found '{}'", text.substr(0, 40)));
    return *subdim;
}

std::vector<std::string> listed(const ArrayHeader& header, const NrrdDataFile& dataFile,
                                const std::vector<std::string>& head) {
    if (head[0] != "LIST" || head.size() > 2)
        header.fail(kDataFile, fmt::format("expected LIST and a number at most, found '{}'",
                                           dataFile.field->substr(0, 40)));
    expectFiles(header, dataFile.list.size(),
                head.size() == 2 ? subdimOf(header, head[1]) : header.axes.size() - 1);
    return dataFile.list;
}

// "PATTERN MIN MAX STEP [SUBDIM]"; nothing when the text has no such numbers: then it is a name.
std::optional<std::vector<std::string>> namedByNumbers(const ArrayHeader& header,
                                                       const NrrdDataFile& dataFile,
                                                       const std::vector<std::string>& head) {
    if (head.size() < 4 || head.size() > 5 || head[0].find('%') == std::string::npos)
        return std::nullopt;
    const auto pattern = Pattern::parse(head[0]);
    if (!pattern)
        header.fail(kDataFile, fmt::format("expected a pattern with one %d, found '{}'",
                                           head[0].substr(0, 200)));
    const auto min = wholeNumber<std::int32_t>(head[1]), max = wholeNumber<std::int32_t>(head[2]),
               step = wholeNumber<std::int32_t>(head[3]);
    if (!min || !max || !step || *step == 0 || (*max != *min && (*max > *min) != (*step > 0)))
        header.fail(kDataFile,
                    fmt::format("expected first and last number and a step between them, "
                                "found '{}'",
                                dataFile.field->substr(0, 200)));
    const std::int64_t count = (std::int64_t{*max} - *min) / *step + 1;
    expectFiles(header, static_cast<std::uint64_t>(count),
                head.size() == 5 ? subdimOf(header, head[4]) : header.axes.size() - 1);
    std::vector<std::string> names;
    for (std::int64_t i = 0; i < count; ++i)
        names.push_back(pattern->name(std::int64_t{*min} + i * *step));
    return names;
}

}  // namespace

std::vector<std::string> namesOf(const ArrayHeader& header, const NrrdDataFile& dataFile) {
    const std::string& field = *dataFile.field;
    const std::vector<std::string> head = words(field);
    if (head.empty()) header.fail(kDataFile, "expected the name of a file");
    if (field.starts_with("LIST") || field.starts_with("SKIPLIST"))
        return listed(header, dataFile, head);
    if (auto names = namedByNumbers(header, dataFile, head)) return *names;
    return {field};
}

}  // namespace timeseries
