#include "timeseries/numbered_names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace timeseries {

using Path = std::filesystem::path;
using Paths = std::vector<Path>;

namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

Name cut(const Path& path) {
    const std::string whole = path.filename().string();
    Name name;
    name.extension = path.extension().string();
    // "plt.0041": the number stands where an extension would.
    if (name.extension.size() > 1 &&
        std::all_of(name.extension.begin() + 1, name.extension.end(), isDigit))
        name.extension.clear();
    bool inDigits = false;
    for (const char c : std::string_view(whole).substr(0, whole.size() - name.extension.size())) {
        if (isDigit(c)) {
            if (!inDigits) name.digits.emplace_back();
            name.digits.back() += c;
        } else {
            if (inDigits) name.texts.emplace_back();
            name.texts.back() += c;
        }
        inDigits = isDigit(c);
    }
    if (inDigits) name.texts.emplace_back();
    return name;
}

std::string shapeOf(const Path& file) {
    const Name name = cut(file);
    return fmt::format("{}{}", fmt::join(name.texts, "*"), name.extension);
}

std::string withoutZeros(const std::string& digits) {
    const std::size_t first = digits.find_first_not_of('0');
    return first == std::string::npos ? "0" : digits.substr(first);
}

namespace {

// Of any length: simulations number their steps with more digits than an integer has.
bool numberLess(const std::string& a, const std::string& b) {
    const std::string x = withoutZeros(a), y = withoutZeros(b);
    return x.size() != y.size() ? x.size() < y.size() : x < y;
}

}  // namespace

bool nameLess(const Path& a, const Path& b) {
    const Name x = cut(a), y = cut(b);
    for (std::size_t i = 0; i < std::min(x.texts.size(), y.texts.size()); ++i) {
        if (x.texts[i] != y.texts[i]) return x.texts[i] < y.texts[i];
        if (i >= x.digits.size() || i >= y.digits.size()) break;
        if (numberLess(x.digits[i], y.digits[i])) return true;
        if (numberLess(y.digits[i], x.digits[i])) return false;
    }
    return a.filename() < b.filename();
}

std::optional<std::size_t> onlyDifference(const Name& a, const Name& b) {
    if (a.texts != b.texts || a.extension != b.extension) return std::nullopt;
    std::optional<std::size_t> at;
    for (std::size_t i = 0; i < a.digits.size(); ++i) {
        if (a.digits[i] == b.digits[i]) continue;
        if (at) return std::nullopt;
        at = i;
    }
    return at;
}

bool ambiguous(const Name& name, std::size_t at, std::span<const std::string> numbers) {
    return at > 0 && name.texts[at] == "." &&
           std::ranges::any_of(numbers, [&](const std::string& digits) {
               return digits.size() != numbers.front().size();
           });
}

Numbered byNumber(Paths files, std::size_t at) {
    struct Member {
        Path file;
        std::string digits;
    };
    std::vector<Member> members;
    for (Path& file : files) {
        std::string digits = cut(file).digits[at];
        members.push_back({std::move(file), std::move(digits)});
    }
    std::ranges::stable_sort(members, [](const Member& a, const Member& b) {
        return numberLess(a.digits, b.digits) ||
               (!numberLess(b.digits, a.digits) && a.file < b.file);
    });
    Numbered series;
    for (Member& member : members) {
        series.files.push_back(std::move(member.file));
        series.numbers.push_back(withoutZeros(member.digits));
    }
    return series;
}

std::optional<Numbered> numbered(std::span<const Path> paths) {
    if (paths.size() < 2) return std::nullopt;
    const Name first = cut(paths.front());
    std::optional<std::size_t> at;
    for (const Path& path : paths) {
        if (path.parent_path() != paths.front().parent_path()) return std::nullopt;
        if (path.filename() == paths.front().filename()) continue;
        const auto difference = onlyDifference(first, cut(path));
        if (!difference || (at && at != difference)) return std::nullopt;
        at = difference;
    }
    if (!at) return std::nullopt;
    std::vector<std::string> digits;
    for (const Path& path : paths) digits.push_back(cut(path).digits[*at]);
    if (ambiguous(first, *at, digits)) return std::nullopt;
    return byNumber({paths.begin(), paths.end()}, *at);
}

}  // namespace timeseries
