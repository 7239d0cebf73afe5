#include "timeseries/readers/text/cut_name.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace timeseries {
namespace {

using Path = std::filesystem::path;

bool isDigit(char c) { return c >= '0' && c <= '9'; }

// Whether digits that follow now have a sign: a minus that is no dash, at the start or behind this.
bool endsInSign(const Name& name) {
    constexpr std::string_view kBefore = "_= ";
    const std::string& text = name.texts.back();
    if (!text.ends_with('-')) return false;
    return text.size() == 1 ? name.digits.empty()
                            : kBefore.find(text[text.size() - 2]) != kBefore.npos;
}

// The digits at a place with the exponent that follows them become two, those before and after the
// dot.
void writeOut(Name& name, std::size_t at) {
    constexpr std::array<std::string_view, 6> kExponents{"e-", "e+", "e", "E-", "E+", "E"};
    constexpr std::size_t kMostDigits = 3;
    constexpr int kMost = 300;
    const auto isLetter = [](char c) { return (c | 0x20) >= 'a' && (c | 0x20) <= 'z'; };
    const std::string& behind = name.texts[at + 1];
    const std::string& exponent = name.digits[at + 1];
    const std::string& next = name.texts[at + 2];
    if (std::ranges::find(kExponents, behind) == kExponents.end() ||
        exponent.size() > kMostDigits || std::stoi(exponent) > kMost ||
        (!next.empty() && isLetter(next.front())))
        return;
    const bool hasFraction = at > 0 && name.texts[at] == "." && name.texts[at - 1] != ".";
    // Without its sign an exponent may be a part of any word.
    const std::string& before = name.texts[hasFraction ? at - 1 : at];
    if (behind.size() == 1 && !before.empty() && isLetter(before.back())) return;
    std::string all = hasFraction ? name.digits[at - 1] + name.digits[at] : name.digits[at];
    const bool negative = isNegative(all);
    if (negative) all.erase(0, 1);
    auto dot = static_cast<std::ptrdiff_t>(all.size()) -
               (hasFraction ? static_cast<std::ptrdiff_t>(name.digits[at].size()) : 0) +
               (behind.ends_with('-') ? -std::stoi(exponent) : std::stoi(exponent));
    if (dot < 1) all.insert(0, static_cast<std::size_t>(1 - dot), '0');
    dot = std::max(dot, std::ptrdiff_t{1});
    if (std::ssize(all) < dot + 1)
        all.append(static_cast<std::size_t>(dot + 1 - std::ssize(all)), '0');
    while (std::ssize(all) > dot + 1 && all.back() == '0') all.pop_back();
    // Both places are there, before and after, but for a fraction's: then there is one more.
    const std::size_t first = hasFraction ? at - 1 : at;
    name.digits[first] = (negative ? "-" : "") + all.substr(0, static_cast<std::size_t>(dot));
    name.digits[first + 1] = all.substr(static_cast<std::size_t>(dot));
    name.texts[first + 1] = ".";
    if (hasFraction) {
        name.digits.erase(name.digits.begin() + static_cast<std::ptrdiff_t>(at) + 1);
        name.texts.erase(name.texts.begin() + static_cast<std::ptrdiff_t>(at) + 1);
    }
    name.powers.push_back(first);
}

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
            if (!inDigits) {
                const bool negative = endsInSign(name);
                if (negative) name.texts.back().pop_back();
                name.digits.emplace_back(negative ? "-" : "");
            }
            name.digits.back() += c;
        } else {
            if (inDigits) name.texts.emplace_back();
            name.texts.back() += c;
        }
        inDigits = isDigit(c);
    }
    if (inDigits) name.texts.emplace_back();
    for (std::size_t at = 0; at + 1 < name.digits.size(); ++at) writeOut(name, at);
    return name;
}

std::string shapeOf(const Path& file) {
    const Name name = cut(file);
    return fmt::format("{}{}", fmt::join(name.texts, "*"), name.extension);
}

bool isNegative(const std::string& digits) { return digits.starts_with('-'); }

std::string withoutZeros(const std::string& digits) {
    if (isNegative(digits)) return '-' + withoutZeros(digits.substr(1));
    const std::size_t first = digits.find_first_not_of('0');
    return first == std::string::npos ? "0" : digits.substr(first);
}

bool numberLess(const std::string& a, const std::string& b) {
    if (isNegative(a) != isNegative(b)) return isNegative(a);
    if (isNegative(a)) return numberLess(b.substr(1), a.substr(1));
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
