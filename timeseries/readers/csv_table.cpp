#include "timeseries/readers/csv_table.h"

#include <csv.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>

#include "timeseries/readers/limits.h"
#include "timeseries/readers/reader.h"
#include "timeseries/readers/text/number_text.h"
#include "timeseries/readers/text/words.h"

namespace timeseries {
namespace {

using Row = std::vector<std::string>;

// libcsv calls back through C: what goes on is told by the row's use, and nothing is thrown.
class CsvRows {
 public:
    // `use` gets each row that is not empty, until it returns false.
    CsvRows(char separator, std::function<bool(const Row&)> use)
        : blanks_(separator == ' '), use_(std::move(use)) {
        if (csv_init(&parser_, CSV_APPEND_NULL) != 0) throw std::bad_alloc();
        csv_set_delim(&parser_, static_cast<unsigned char>(separator));
    }
    ~CsvRows() { csv_free(&parser_); }
    CsvRows(const CsvRows&) = delete;
    CsvRows& operator=(const CsvRows&) = delete;

    // Whether more is wanted.
    bool take(std::string_view text) {
        if (csv_parse(&parser_, text.data(), text.size(), field, row, this) != text.size())
            throw std::bad_alloc();
        return more_;
    }
    bool end() {
        csv_fini(&parser_, field, row, this);
        return more_;
    }

 private:
    static void field(void* text, std::size_t length, void* self) {
        auto& rows = *static_cast<CsvRows*>(self);
        // Between words that blanks part may be several.
        if (rows.blanks_ && length == 0) return;
        rows.row_.emplace_back(static_cast<const char*>(text), length);
    }
    static void row(int, void* self) {
        auto& rows = *static_cast<CsvRows*>(self);
        if (rows.more_ && !rows.row_.empty()) rows.more_ = rows.use_(rows.row_);
        rows.row_.clear();
    }

    csv_parser parser_{};
    bool blanks_, more_ = true;
    std::function<bool(const Row&)> use_;
    Row row_;
};

std::optional<double> numberIn(const std::string& text) {
    const std::string word = text.size() <= 4 ? lower(text) : "";
    if (text.empty() || word == "na" || word == "n/a" || word == "null")
        return std::numeric_limits<double>::quiet_NaN();
    return numberOfText<double>(text);
}

// "X [ m ]", "T (K)": what the last brackets hold is the unit.
CsvColumn columnOf(const std::string& title) {
    for (const auto& [open, close] : {std::pair{'[', ']'}, {'(', ')'}}) {
        const auto from = title.rfind(open);
        if (from == title.npos || from == 0 || title.back() != close) continue;
        const auto trimmed = [](std::string text) {
            const auto first = text.find_first_not_of(' ');
            return first == text.npos ? ""
                                      : text.substr(first, text.find_last_not_of(' ') + 1 - first);
        };
        return {trimmed(title.substr(0, from)),
                trimmed(title.substr(from + 1, title.size() - from - 2))};
    }
    return {title, ""};
}

// 0 to 2 for x to z, as the programs that write tables call them.
std::optional<std::size_t> coordinateOf(const std::string& name) {
    const std::string text = lower(name);
    for (std::size_t c = 0; c < 3; ++c) {
        const char letter = "xyz"[c], number = "012"[c];
        for (const std::string& each :
             {fmt::format("{}", letter), fmt::format("{}-coordinate", letter),
              fmt::format("{}_coordinate", letter), fmt::format("coord_{}", letter),
              fmt::format("points:{}", number), fmt::format("points_{}", number)})
            if (text == each) return c;
    }
    return std::nullopt;
}

// Nothing but numbers.
bool isNumbers(std::string_view line) {
    constexpr std::string_view kBetween = ",; \t\r";
    std::size_t numbers = 0;
    for (std::size_t at = 0; (at = line.find_first_not_of(kBetween, at)) != line.npos; ++numbers) {
        const std::size_t end = std::min(line.find_first_of(kBetween, at), line.size());
        if (!numberIn(std::string(line.substr(at, end - at)))) return false;
        at = end;
    }
    return numbers > 0;
}

// Where the titles begin: behind what is a comment, or in its last line, where numbers follow (as
// numpy writes titles).
std::size_t beginOf(std::string_view start) {
    std::size_t at = 0, last = start.npos;
    while (at < start.size() && (start[at] == '#' || start[at] == '\n' || start[at] == '\r')) {
        const auto line = start.find('\n', at);
        if (line == start.npos) return start.size();
        if (start[at] == '#') last = at;
        at = line + 1;
    }
    if (last == start.npos || !isNumbers(start.substr(at, start.find('\n', at) - at))) return at;
    return std::min(start.find_first_not_of("# \t", last), at);
}

bool isText(std::string_view start) {
    return std::ranges::none_of(start, [](char c) {
        return (c >= 0 && c < ' ' && c != '\t' && c != '\n' && c != '\r') || c == '\x7f';
    });
}

std::string_view withoutMark(std::string_view start) {
    constexpr std::string_view kMark = "\xEF\xBB\xBF";
    return start.starts_with(kMark) ? start.substr(kMark.size()) : start;
}

}  // namespace

namespace {

// The titles, and the first row below them, by one separator.
struct FirstRows {
    CsvHeader header;
    Row row;
    std::array<bool, 3> names{};  // of coordinates, among the titles
    std::ptrdiff_t others = 0;    // that have numbers

    bool isAsLong() const { return row.size() == header.columns.size(); }
    bool isTable() const {
        return isAsLong() && header.places[0] && header.places[1] && others > 0;
    }
};

FirstRows firstRowsOf(std::string_view titles, char separator) {
    FirstRows first;
    first.header.separator = separator;
    CsvHeader& header = first.header;
    std::size_t rows = 0;
    CsvRows table(separator, [&](const Row& row) {
        if (++rows > 1) {
            first.row = row;
            return false;
        }
        for (const std::string& title : row)
            header.columns.push_back(columnOf(
                title.empty() ? fmt::format("column {}", header.columns.size() + 1) : title));
        return true;
    });
    // The first row, perhaps below lines without any; it may be cut where the beginning ends.
    const auto row = titles.find_first_not_of("\r\n", titles.find('\n'));
    const auto second = titles.find('\n', row);
    table.take(titles.substr(0, second == titles.npos ? titles.size() : second + 1));
    if (second == titles.npos) table.end();
    for (std::size_t i = 0; i < header.columns.size(); ++i) {
        CsvColumn& column = header.columns[i];
        const auto c = coordinateOf(column.name);
        if (c) first.names[*c] = true;
        column.isText = first.isAsLong() && !numberIn(first.row[i]);
        if (column.isText) continue;
        if (c && !header.places[*c])
            header.places[*c] = i;
        else
            ++first.others;
    }
    return first;
}

// What `of` makes of them by the first separator of which it makes something.
template <typename Of>
auto byFirstSeparator(std::string_view whole, const Of& of) -> decltype(of(FirstRows())) {
    const std::string_view start = withoutMark(whole);
    if (!isText(start)) return std::nullopt;
    const std::string_view titles = start.substr(beginOf(start));
    if (titles.find('\n') == titles.npos) return std::nullopt;
    for (const char separator : {',', ';', '\t', ' '})
        if (auto made = of(firstRowsOf(titles, separator))) return made;
    return std::nullopt;
}

}  // namespace

std::optional<CsvHeader> csvHeaderOf(std::string_view start) {
    return byFirstSeparator(start, [](const FirstRows& first) {
        return first.isTable() ? std::optional(first.header) : std::nullopt;
    });
}

std::optional<std::string> csvFlawOf(std::string_view start) {
    return byFirstSeparator(start, [](const FirstRows& first) -> std::optional<std::string> {
        const auto& columns = first.header.columns;
        if (!first.names[0] || !first.names[1] || first.row.empty()) return std::nullopt;
        if (!first.isAsLong())
            return fmt::format("row 2: expected {} numbers, found {}", columns.size(),
                               first.row.size());
        const auto text = std::ranges::find_if(columns, &CsvColumn::isText);
        if (text == columns.end()) return std::nullopt;
        return fmt::format("row 2: expected a number in column {}, found '{}'", text->name,
                           first.row[static_cast<std::size_t>(text - columns.begin())]);
    });
}

namespace {

// `use` gets each row below the titles, and its number counted from theirs, which is 1, and tells
// what is wrong with it, or "". Throws FileError.
void forRows(const std::filesystem::path& path, char separator,
             const std::function<std::string(const Row&, std::size_t)>& use) {
    std::ifstream file(path, std::ios::binary);
    std::string wrong = file ? "" : "expected a file that can be read";
    std::size_t rows = 0;
    CsvRows table(separator, [&](const Row& row) {
        if (rows++ > 0) wrong = use(row, rows);
        return wrong.empty();
    });
    std::string buffer(std::size_t{1} << 16, '\0');
    for (bool more = true, first = true; more && file; first = false) {
        file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
        std::string_view piece(buffer.data(), static_cast<std::size_t>(file.gcount()));
        if (first) {
            piece = withoutMark(piece);
            piece = piece.substr(beginOf(piece));
        }
        more = table.take(piece);
    }
    if (wrong.empty()) table.end();
    for (char& c : wrong)
        if (c >= '\0' && c < ' ') c = ' ';
    if (!wrong.empty()) throw FileError(fmt::format("{}: {}", path.string(), wrong));
}

// A column again; nothing where some number of it is not one of these.
template <typename T>
std::optional<CsvNumbers> wholeNumbers(const std::filesystem::path& path, char separator,
                                       std::size_t column) {
    std::vector<T> values;
    std::vector<bool> missing;
    bool all = true, some = false;
    forRows(path, separator, [&](const Row& row, std::size_t) -> std::string {
        if (!all || column >= row.size()) return "";
        const auto number = numberIn(row[column]);
        const auto whole = numberOfText<T>(row[column]);
        missing.push_back(number && std::isnan(*number));
        all = whole || missing.back();
        some = some || missing.back();
        values.push_back(whole.value_or(0));
        return "";
    });
    if (!all) return std::nullopt;
    if (!some) missing.clear();
    return CsvNumbers{std::move(values), std::move(missing)};
}

}  // namespace

std::vector<CsvNumbers> readCsv(const std::filesystem::path& path, const CsvHeader& header) {
    constexpr double kToldApart = 9007199254740992;  // 2^53
    const std::size_t count = header.columns.size();
    std::vector<std::vector<double>> columns(count);
    std::vector<bool> large(count), whole(count, true);
    forRows(path, header.separator, [&](const Row& row, std::size_t at) -> std::string {
        if (row.size() != count)
            return fmt::format("row {}: expected {} numbers, found {}", at, count, row.size());
        if (at > kMaxPoints) return "expected fewer than 2^32 rows";
        for (std::size_t i = 0; i < count; ++i) {
            if (header.columns[i].isText) continue;
            const auto number = numberIn(row[i]);
            if (!number)
                return fmt::format("row {}: expected a number in column {}, found '{}'", at,
                                   header.columns[i].name, row[i].substr(0, 80));
            columns[i].push_back(*number);
            if (std::abs(*number) >= kToldApart) large[i] = true;
            const bool isWhole = row[i].find_first_not_of("+-0123456789") == row[i].npos;
            if (!isWhole && !std::isnan(*number)) whole[i] = false;
        }
        return "";
    });
    std::vector<CsvNumbers> numbers(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t rows = columns[i].size();
        numbers[i].values = std::move(columns[i]);
        if (!large[i] || !whole[i] || std::ranges::find(header.places, i) != header.places.end())
            continue;
        auto exact = wholeNumbers<std::int64_t>(path, header.separator, i);
        if (!exact) exact = wholeNumbers<std::uint64_t>(path, header.separator, i);
        if (!exact) continue;
        numbers[i] = std::move(*exact);
        if (std::visit([](const auto& all) { return all.size(); }, numbers[i].values) != rows)
            throw FileError(fmt::format("{}: it changed while it was read", path.string()));
    }
    return numbers;
}

}  // namespace timeseries
