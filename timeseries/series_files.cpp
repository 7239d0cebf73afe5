#include "timeseries/series_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glob.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <numeric>

#include "timeseries/numbered_names.h"
#include "timeseries/reader.h"

namespace timeseries {
namespace {

using Path = std::filesystem::path;
using Paths = std::vector<Path>;

constexpr std::size_t kMostTold = 8;  // numbers, files or gaps, in one sentence
constexpr std::string_view kByName = "in the order of their names";

// Null beyond 18 digits.
std::optional<std::vector<std::int64_t>> integers(const std::vector<std::string>& numbers) {
    std::vector<std::int64_t> values;
    for (const std::string& number : numbers) {
        if (number.size() > 18) return std::nullopt;
        values.push_back(std::stoll(number));
    }
    return values;
}

std::string missingText(const std::vector<std::int64_t>& values, std::int64_t every) {
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
        const std::int64_t from = values[i - 1] + every, to = values[i] - every;
        text += (text.empty() ? "" : ", ") + (gap == 1   ? fmt::format("{}", from)
                                              : gap == 2 ? fmt::format("{}, {}", from, to)
                                                         : fmt::format("{} to {}", from, to));
    }
    if (untold > 0) text += fmt::format(" and {} more", untold);
    return missing == 1 ? fmt::format("number {} is missing", text)
                        : fmt::format("{} numbers are missing: {}", missing, text);
}

std::string namesText(const Paths& files) {
    return fmt::format("{} files {} to {}", files.size(), files.front().filename().string(),
                       files.back().filename().string());
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
std::string spacingText(const std::vector<std::int64_t>& values, const Spacing& spacing,
                        const std::string& ends) {
    if (spacing.uneven && values.size() <= kMostTold)
        return fmt::format("{}: uneven", fmt::join(values, ", "));
    if (spacing.uneven) return ends + ": uneven";
    std::string text = ends;
    if (spacing.every > 1) text += fmt::format(" every {}", spacing.every);
    if (spacing.gaps) text += ", with gaps";
    return text;
}

void describe(const Numbered& series, ExpandedSeries& into) {
    const bool twice = tellTwice(series, into);
    const std::string &first = series.numbers.front(), &last = series.numbers.back();
    std::string shape = fmt::format("{} to {}", first, last);
    if (auto values = integers(series.numbers)) {
        values->erase(std::unique(values->begin(), values->end()), values->end());
        const Spacing spacing = spacingOf(*values);
        shape = values->size() == 2 && !twice ? fmt::format("{} and {}", first, last)
                                              : spacingText(*values, spacing, shape);
        if (spacing.gaps) into.notes.push_back(missingText(*values, spacing.every));
    }
    into.recognised = fmt::format("{}, numbers {}", namesText(series.files), shape);
}

// The ordinary files of a folder, hidden ones left out. None when there are too many.
std::optional<Paths> filesIn(const Path& folder) {
    Paths files;
    std::size_t seen = 0;
    std::error_code error;
    const Path where = folder.empty() ? Path(".") : folder;
    for (std::filesystem::directory_iterator entry(where, error), end; !error && entry != end;
         entry.increment(error)) {
        if (++seen > kMaxSeriesFiles) return std::nullopt;
        std::error_code ignored;
        if (entry->path().filename().string().starts_with('.') || !entry->is_regular_file(ignored))
            continue;
        files.push_back(folder / entry->path().filename());
    }
    if (error)
        throw FileError(fmt::format("{}: expected a folder that can be listed, but {}",
                                    where.string(), error.message()));
    return files;
}

// Files named alike that are no part of the series.
void tellOthers(Paths others, ExpandedSeries& into) {
    if (others.empty()) return;
    std::ranges::sort(others, nameLess);
    const std::string first = others.front().filename().string();
    into.notes.push_back(
        others.size() == 1
            ? fmt::format("{} is not taken: it differs in another number, or in several", first)
            : fmt::format("{} files {} to {} are not taken: they differ in another number, or in "
                          "several; a folder or a pattern opens them together",
                          others.size(), first, others.back().filename().string()));
}

ExpandedSeries member(const Path& file) {
    ExpandedSeries alone{{file}, {}, "", {}};
    const Name name = cut(file);
    if (name.digits.empty() || name.extension == ".pvd") return alone;
    std::optional<Paths> listed;
    try {
        listed = filesIn(file.parent_path());
    } catch (const FileError&) {
        alone.notes.push_back("only this file is opened: its folder cannot be listed");
        return alone;
    }
    if (!listed) {
        alone.notes.push_back(
            fmt::format("only this file is opened: its folder holds more than {} "
                        "files",
                        kMaxSeriesFiles));
        return alone;
    }
    std::map<std::size_t, Paths> siblings;  // by the number in which they differ
    Paths further;                          // in several numbers
    for (const Path& other : *listed) {
        const Name its = cut(other);
        if (its.texts != name.texts || its.extension != name.extension || its.digits == name.digits)
            continue;
        if (const auto at = onlyDifference(name, its))
            siblings[*at].push_back(other);
        else
            further.push_back(other);
    }

    // The last number that takes another value: a_1 and a_01 alone are no series.
    const auto varies = std::find_if(siblings.rbegin(), siblings.rend(), [&](const auto& each) {
        return std::ranges::any_of(each.second, [&](const Path& other) {
            return withoutZeros(cut(other).digits[each.first]) !=
                   withoutZeros(name.digits[each.first]);
        });
    });
    if (varies == siblings.rend()) {
        for (const auto& [at, files] : siblings)
            alone.notes.push_back(
                fmt::format("number {} stands twice: {} and {}; only the file "
                            "named is opened",
                            withoutZeros(name.digits[at]), file.filename().string(),
                            files.front().filename().string()));
        tellOthers(std::move(further), alone);
        return alone;
    }
    const std::size_t at = varies->first;
    Paths files = varies->second;
    files.push_back(file);
    std::vector<std::string> digits;
    for (const Path& each : files) digits.push_back(cut(each).digits[at]);
    if (ambiguous(name, at, digits)) {
        alone.notes.push_back(fmt::format(
            "only this file is opened: the numbers of {} and {} may be decimal or whole; name the "
            "files in their order",
            file.filename().string(), files.front().filename().string()));
        return alone;
    }
    const Numbered series = byNumber(std::move(files), at);
    ExpandedSeries result;
    describe(series, result);
    for (const auto& [number, others] : siblings)
        if (number != at) further.insert(further.end(), others.begin(), others.end());
    tellOthers(std::move(further), result);
    result.files = series.files;
    result.here =
        static_cast<std::size_t>(std::ranges::find(series.files, file) - series.files.begin());
    return result;
}

// Files found together are ordered by whole numbers, which fractions need not follow.
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

// Files that were named or found together.
ExpandedSeries together(Paths files, std::string_view order) {
    const auto isCollection = [](const Path& file) { return file.extension() == ".pvd"; };
    const auto collection = std::ranges::find_if(files, isCollection);
    if (collection != files.end() && !std::ranges::all_of(files, isCollection))
        throw FileError(fmt::format("{}: expected it alone, for it lists the files of its series",
                                    collection->string()));
    ExpandedSeries result;
    if (const auto series = numbered(files)) {
        describe(*series, result);
        result.files = series->files;
        return result;
    }
    if (files.size() > 1) result.recognised = fmt::format("{}, {}", namesText(files), order);
    if (order == kByName) tellFractions(files, result);
    result.files = std::move(files);
    return result;
}

// "a_#_#": the name's texts, whatever its numbers.
std::string shapeOf(const Path& file) {
    const Name name = cut(file);
    return fmt::format("{}{}", fmt::join(name.texts, "*"), name.extension);
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

[[noreturn]] void refuseCandidates(const Path& folder, const std::vector<Paths>& candidates) {
    std::string text;
    for (std::size_t i = 0; i < std::min(candidates.size(), kMostTold); ++i)
        text += (text.empty() ? "" : ", ") + candidate(candidates[i]);
    if (candidates.size() > kMostTold)
        text += fmt::format(" and {} more", candidates.size() - kMostTold);
    throw FileError(
        fmt::format("{}: expected a folder that holds one series, found {}; name one "
                    "of them",
                    folder.string(), text));
}

ExpandedSeries folder(const Path& folder) {
    std::optional<Paths> listed = filesIn(folder);
    if (!listed)
        throw FileError(fmt::format("{}: expected a folder of at most {} files, found more",
                                    folder.string(), kMaxSeriesFiles));
    std::ranges::sort(*listed, nameLess);
    std::map<std::string, Paths> byExtension;
    for (const Path& file : *listed) byExtension[cut(file).extension].push_back(file);
    if (byExtension.empty())
        throw FileError(fmt::format(
            "{}: expected a folder that holds a series, found no files in it", folder.string()));

    std::vector<Paths> candidates;
    for (auto& [extension, files] : byExtension) candidates.push_back(std::move(files));
    if (candidates.size() > 1) {  // beside a readme, beside the raw data of detached headers
        std::vector<Paths> readable;
        for (const Paths& files : candidates)
            if (isReadable(files.front())) readable.push_back(files);
        if (!readable.empty()) candidates = std::move(readable);
        // A collection lists the others, with their times.
        for (const Paths& files : candidates)
            if (files.size() == 1 && files.front().extension() == ".pvd") {
                candidates = {Paths(files)};
                break;
            }
    }
    if (candidates.size() > 1) refuseCandidates(folder, candidates);
    Paths files = candidates.front();
    if (numbered(files)) return together(std::move(files), "");

    // Several numbered series of one extension are no series together.
    std::map<std::string, Paths> byShape;
    for (const Path& file : files) byShape[shapeOf(file)].push_back(file);
    const bool series =
        std::ranges::any_of(byShape, [](const auto& shape) { return shape.second.size() > 1; });
    if (byShape.size() > 1 && series) {
        candidates.clear();
        for (auto& [shape, each] : byShape) candidates.push_back(std::move(each));
        refuseCandidates(folder, candidates);
    }
    ExpandedSeries result = together(std::move(files), kByName);
    if (result.files.size() == 1)
        result.recognised =
            fmt::format("{}, the only file to open here", result.files.front().filename().string());
    return result;
}

bool isPattern(const Path& path) {
    std::error_code ignored;
    return path.string().find_first_of("*?[") != std::string::npos &&
           !std::filesystem::exists(path, ignored);
}

Paths matches(const Path& pattern) {
    glob_t found{};
    const int code = glob(pattern.c_str(), GLOB_NOSORT, nullptr, &found);
    const std::unique_ptr<glob_t, void (*)(glob_t*)> release(&found, globfree);
    if (code != 0 && code != GLOB_NOMATCH)
        throw FileError(
            fmt::format("{}: expected a pattern whose folders can be listed", pattern.string()));
    if (found.gl_pathc > kMaxSeriesFiles)
        throw FileError(fmt::format("{}: expected a pattern of at most {} files, found {}",
                                    pattern.string(), kMaxSeriesFiles, found.gl_pathc));
    Paths files;
    for (std::size_t i = 0; i < found.gl_pathc; ++i) {
        std::error_code ignored;
        if (!std::filesystem::is_directory(found.gl_pathv[i], ignored))
            files.emplace_back(found.gl_pathv[i]);
    }
    if (files.empty())
        throw FileError(fmt::format("{}: no file has such a name", pattern.string()));
    std::ranges::sort(files, [](const Path& a, const Path& b) {
        return a.parent_path() == b.parent_path() ? nameLess(a, b)
                                                  : a.parent_path() < b.parent_path();
    });
    return files;
}

}  // namespace

ExpandedSeries expandSeries(std::span<const Path> named) {
    if (named.size() == 1) {
        const Path& one = named.front();
        if (isPattern(one)) return together(matches(one), kByName);
        std::error_code ignored;
        if (std::filesystem::is_directory(one, ignored)) return folder(one);
        if (std::filesystem::is_regular_file(one, ignored)) return member(one);
        return {{one}, {}, "", {}};
    }
    Paths files;
    for (const Path& path : named) {
        if (isPattern(path)) {
            const Paths found = matches(path);
            files.insert(files.end(), found.begin(), found.end());
        } else {
            files.push_back(path);
        }
    }
    return together(std::move(files), "in the order given");
}

std::optional<std::vector<double>> ascendingNumbers(std::span<const Path> paths) {
    const auto series = numbered(paths);
    if (!series || !std::ranges::equal(series->files, paths)) return std::nullopt;
    std::vector<double> values;
    for (const std::string& number : series->numbers) {
        if (number.size() > 300) return std::nullopt;
        values.push_back(std::stod(number));
        if (values.size() > 1 && !(values[values.size() - 2] < values.back())) return std::nullopt;
    }
    return values;
}

}  // namespace timeseries
