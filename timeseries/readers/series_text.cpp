#include "timeseries/readers/series_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <numeric>

namespace timeseries {
namespace {

using Path = std::filesystem::path;
using Paths = std::vector<Path>;

constexpr std::size_t kMostTold = 8;  // numbers, files or gaps, in one sentence

// Numbers times the power of ten that makes all of them whole.
struct Scaled {
    std::vector<std::int64_t> values;
    std::size_t decimals = 0;  // the power

    std::string text(std::int64_t value) const {
        std::string digits = fmt::format("{:0{}}", std::abs(value), decimals + 1);
        if (decimals > 0) digits.insert(digits.size() - decimals, ".");
        return (value < 0 ? "-" : "") + digits;
    }
};

// None beyond 18 digits.
std::optional<Scaled> scaled(const std::vector<std::string>& numbers) {
    const auto decimalsOf = [](const std::string& number) {
        const std::size_t dot = number.find('.');
        return dot == number.npos ? 0 : number.size() - dot - 1;
    };
    Scaled result;
    for (const std::string& number : numbers)
        result.decimals = std::max(result.decimals, decimalsOf(number));
    for (const std::string& number : numbers) {
        std::string digits = number + std::string(result.decimals - decimalsOf(number), '0');
        std::erase(digits, '.');
        if (digits.size() > 18) return std::nullopt;
        result.values.push_back(std::stoll(digits));
    }
    return result;
}

std::string missingText(const Scaled& numbers, std::int64_t every) {
    const auto& values = numbers.values;
    std::string text;
    std::size_t told = 0;
    std::int64_t missing = 0, untold = 0;
    for (std::size_t i = 1; i < values.size(); ++i) {
        const std::int64_t gap = (values[i] - values[i - 1]) / every - 1;
        if (gap <= 0) continue;
        missing += gap;
        if (told++ >= kMostTold) {
            untold += gap;
            continue;
        }
        const std::string from = numbers.text(values[i - 1] + every),
                          to = numbers.text(values[i] - every);
        text += (text.empty() ? "" : ", ") + (gap == 1   ? from
                                              : gap == 2 ? fmt::format("{}, {}", from, to)
                                                         : fmt::format("{} to {}", from, to));
    }
    if (untold > 0) text += fmt::format(" and {} more", untold);
    return missing == 1 ? fmt::format("number {} is missing", text)
                        : fmt::format("{} numbers are missing: {}", missing, text);
}

// Returns whether any number stands twice.
bool tellTwice(const Numbered& series, ExpandedSeries& into) {
    std::size_t told = 0;
    bool twice = false;
    for (std::size_t i = 1; i < series.numbers.size(); ++i) {
        if (series.numbers[i] != series.numbers[i - 1]) continue;
        twice = true;
        if (told++ < kMostTold)
            into.notes.push_back(fmt::format("number {} stands twice: {} and {}", series.numbers[i],
                                             series.files[i - 1].filename().string(),
                                             series.files[i].filename().string()));
    }
    return twice;
}

// How ascending numbers follow each other.
struct Spacing {
    std::int64_t every = 0;  // divides all distances
    bool uneven = false;     // none of them is just that
    bool gaps = false;       // some of them are more
};
Spacing spacingOf(const std::vector<std::int64_t>& values) {
    std::int64_t least = 0;
    Spacing spacing;
    for (std::size_t i = 1; i < values.size(); ++i) {
        const std::int64_t step = values[i] - values[i - 1];
        least = i == 1 ? step : std::min(least, step);
        spacing.every = std::gcd(spacing.every, step);
    }
    spacing.uneven = least != spacing.every;
    spacing.gaps = !spacing.uneven && spacing.every > 0 &&
                   (values.back() - values.front()) / spacing.every + 1 > std::ssize(values);
    return spacing;
}

// "0 to 20 every 5, with gaps".
std::string spacingText(const Scaled& numbers, const Spacing& spacing, const std::string& ends) {
    if (spacing.uneven && numbers.values.size() <= kMostTold) {
        std::vector<std::string> all;
        for (const std::int64_t value : numbers.values) all.push_back(numbers.text(value));
        return fmt::format("{}: uneven", fmt::join(all, ", "));
    }
    if (spacing.uneven) return ends + ": uneven";
    std::string text = ends;
    if (spacing.every > 1 || numbers.decimals > 0) text += " every " + numbers.text(spacing.every);
    if (spacing.gaps) text += ", with gaps";
    return text;
}

// "a.nc is not taken: it", "2 files a.nc to b.nc are not taken: they".
std::string notTaken(Paths others) {
    std::ranges::sort(others, nameLess);
    return others.size() == 1
               ? fmt::format("{} is not taken: it", others.front().filename().string())
               : namesText(others) + " are not taken: they";
}

std::string candidate(const Paths& files) {
    const std::string name = files.front().filename().string();
    if (files.size() == 1) return name;
    const std::string shape = shapeOf(files.front());
    const bool alike =
        std::ranges::all_of(files, [&](const Path& file) { return shapeOf(file) == shape; });
    return fmt::format("{} ({} files)", alike ? shape : "*" + cut(files.front()).extension,
                       files.size());
}

}  // namespace

std::string namesText(const Paths& files) {
    return fmt::format("{} files {} to {}", files.size(), files.front().filename().string(),
                       files.back().filename().string());
}

void describe(const Numbered& series, ExpandedSeries& into) {
    const bool twice = tellTwice(series, into);
    const std::string &first = series.numbers.front(), &last = series.numbers.back();
    std::string shape = fmt::format("{} to {}", first, last);
    if (auto numbers = scaled(series.numbers)) {
        auto& values = numbers->values;
        values.erase(std::unique(values.begin(), values.end()), values.end());
        const Spacing spacing = spacingOf(values);
        shape = values.size() == 2 && !twice ? fmt::format("{} and {}", first, last)
                                             : spacingText(*numbers, spacing, shape);
        if (spacing.gaps) into.notes.push_back(missingText(*numbers, spacing.every));
    }
    into.recognised = fmt::format("{}, numbers {}", namesText(series.files), shape);
}

void tellOthers(Paths others, ExpandedSeries& into) {
    if (others.empty()) return;
    const bool one = others.size() == 1;
    into.notes.push_back(notTaken(std::move(others)) +
                         (one ? " differs in another number, or in several"
                              : " differ in another number, or in several; a folder or a pattern "
                                "opens them together"));
}

void tellOtherDots(Paths others, ExpandedSeries& into) {
    if (others.empty()) return;
    const bool one = others.size() == 1;
    into.notes.push_back(notTaken(std::move(others)) + (one ? " has" : " have") +
                         " another number of dots; name the files in their order");
}

void tellUnclear(const Paths& files, std::size_t at, ExpandedSeries& into) {
    const std::size_t length = cut(files.front()).digits[at].size();
    const auto other = std::ranges::find_if(
        files, [&](const Path& file) { return cut(file).digits[at].size() != length; });
    into.notes.push_back(fmt::format(
        "only this file is opened: the numbers of {} and {} may be decimal or whole; name the "
        "files in their order",
        files.front().filename().string(), other->filename().string()));
}

void tellFractions(const Paths& files, ExpandedSeries& into) {
    const Name first = cut(files.front());
    for (std::size_t at = 1; at < first.digits.size(); ++at)
        for (const Path& file : files) {
            const Name name = cut(file);
            if (name.texts != first.texts ||
                !ambiguous(name, at, std::array{first.digits[at], name.digits[at]}))
                continue;
            into.notes.push_back(fmt::format(
                "the numbers of {} and {} may be decimal or whole, and are taken as whole; name "
                "the files in their order",
                files.front().filename().string(), file.filename().string()));
            return;
        }
}

std::string candidatesText(std::span<const Paths> candidates) {
    std::string text;
    for (std::size_t i = 0; i < std::min(candidates.size(), kMostTold); ++i)
        text += (text.empty() ? "" : ", ") + candidate(candidates[i]);
    if (candidates.size() > kMostTold)
        text += fmt::format(" and {} more", candidates.size() - kMostTold);
    return text;
}

}  // namespace timeseries
