#include "timeseries/series_files.h"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <map>
#include <memory>

#include "timeseries/numbered_names.h"
#include "timeseries/reader.h"
#include "timeseries/series_text.h"

namespace timeseries {
namespace {

using Path = std::filesystem::path;
using Paths = std::vector<Path>;

constexpr std::string_view kByName = "in the order of their names";

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

[[noreturn]] void refuseCandidates(const Path& folder, std::span<const Paths> candidates) {
    throw FileError(
        fmt::format("{}: expected a folder that holds one series, found {}; name one of them",
                    folder.string(), candidatesText(candidates)));
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
