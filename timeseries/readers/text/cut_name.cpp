#include "timeseries/readers/text/cut_name.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

namespace timeseries {
namespace {

using Path = std::filesystem::path;

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

bool numberLess(const std::string& a, const std::string& b) {
    const std::string x = withoutZeros(a), y = withoutZeros(b);
    return x.size() != y.size() ? x.size() < y.size() : x < y;
}

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

std::optional<std::vector<std::size_t>> differences(const Name& a, const Name& b) {
    if (a.texts != b.texts || a.extension != b.extension) return std::nullopt;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < a.digits.size(); ++i)
        if (a.digits[i] != b.digits[i]) places.push_back(i);
    return places;
}

}  // namespace timeseries
