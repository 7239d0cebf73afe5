#include "timeseries/readers/text/numbered_names.h"

#include <algorithm>
#include <set>

#include "timeseries/readers/text/decimal_names.h"

namespace timeseries {
namespace {

using Path = std::filesystem::path;

// Ascending by the number at a place of their names, and by the fraction at the next, if any.
Numbered ascending(std::span<const Path> files, std::size_t at, bool decimal) {
    struct Member {
        Path file;
        std::string whole, fraction;
    };
    std::vector<Member> members;
    for (const Path& file : files) {
        const Name name = cut(file);
        members.push_back({file, name.digits[at], decimal ? '.' + name.digits[at + 1] : ""});
    }
    std::ranges::stable_sort(members, [](const Member& a, const Member& b) {
        if (numberLess(a.whole, b.whole)) return true;
        if (numberLess(b.whole, a.whole)) return false;
        if (a.fraction != b.fraction) return (a.fraction < b.fraction) != isNegative(a.whole);
        return a.file < b.file;
    });
    Numbered series;
    for (Member& member : members) {
        series.files.push_back(std::move(member.file));
        series.numbers.push_back(withoutZeros(member.whole) + member.fraction);
    }
    return series;
}

// The places at which names differ; none when they differ elsewhere, or lie in other folders.
std::optional<std::set<std::size_t>> variedPlaces(std::span<const Path> paths) {
    const Name first = cut(paths.front());
    std::set<std::size_t> places;
    for (const Path& path : paths) {
        if (path.parent_path() != paths.front().parent_path()) return std::nullopt;
        const auto differ = differences(first, cut(path));
        if (!differ) return std::nullopt;
        places.insert(differ->begin(), differ->end());
    }
    return places;
}

}  // namespace

bool ambiguous(const Name& name, std::size_t at, std::span<const std::string> numbers) {
    return at > 0 && name.texts[at] == "." &&
           std::ranges::any_of(numbers, [&](const std::string& digits) {
               return digits.size() != numbers.front().size();
           });
}

std::optional<Numbered> numbered(std::span<const Path> paths) {
    if (paths.size() < 2) return std::nullopt;
    const auto places = variedPlaces(paths);
    if (!places || places->empty()) return std::nullopt;
    const std::size_t firstPlace = *places->begin(), lastPlace = *places->rbegin();
    const Name name = cut(paths.front());
    for (const std::size_t at : decimalPlaces(name)) {
        if (firstPlace < at || lastPlace > at + 1) continue;
        const Dotted reading = readingOf(paths, at);
        if (reading == Dotted::Decimal) return ascending(paths, at, true);
        if (reading == Dotted::Unclear) return std::nullopt;
    }
    if (firstPlace != lastPlace) return std::nullopt;
    std::vector<std::string> digits;
    for (const Path& path : paths) digits.push_back(cut(path).digits[firstPlace]);
    if (ambiguous(name, firstPlace, digits)) return std::nullopt;
    return ascending(paths, firstPlace, false);
}

}  // namespace timeseries
