#include "timeseries/readers/series_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string_view>

#include "timeseries/readers/amrex/amrex_header.h"
#include "timeseries/readers/file_pattern.h"
#include "timeseries/readers/foam/foam_case.h"
#include "timeseries/readers/netcdf/snapshot_files.h"
#include "timeseries/readers/other_formats.h"
#include "timeseries/readers/plot3d_reader.h"
#include "timeseries/readers/reader.h"
#include "timeseries/readers/series_text.h"
#include "timeseries/readers/text/decimal_names.h"
#include "timeseries/readers/text/numbered_names.h"
#include "timeseries/readers/text/words.h"
#include "timeseries/readers/zarr/zarr_hierarchy.h"

namespace timeseries {
namespace {

using Path = std::filesystem::path;
using Paths = std::vector<Path>;

constexpr std::string_view kByName = "in the order of their names";

// What the members of a series are: a plotfile is a folder, and so is a store of Zarr.
enum class Members { Files, Plotfiles, Stores };

// By its name, too: a group may hold numbered arrays, each a hierarchy of its own.
bool isStore(const Path& folder) {
    return lower(folder.extension().string()) == ".zarr" && isZarr(folder);
}

// Which lists the files of its series, with their times.
bool isList(const Path& file) {
    return file.extension() == ".pvd" || file.extension() == ".series";
}

// The ordinary files of a folder, or others of its members, hidden ones left out. None when there
// are too many.
std::optional<Paths> filesIn(const Path& folder, Members members = Members::Files) {
    Paths files;
    std::size_t seen = 0;
    std::error_code error;
    const Path where = folder.empty() ? Path(".") : folder;
    for (std::filesystem::directory_iterator entry(where, error), end; !error && entry != end;
         entry.increment(error)) {
        if (++seen > kMaxSeriesFiles) return std::nullopt;
        std::error_code ignored;
        if (entry->path().filename().string().starts_with('.')) continue;
        const bool isMember = members == Members::Files
                                  ? entry->is_regular_file(ignored)
                                  : entry->is_directory(ignored) &&
                                        (members == Members::Plotfiles ? isAmrex : isStore)(*entry);
        if (!isMember) continue;
        files.push_back(folder / entry->path().filename());
    }
    if (error)
        throw FileError(fmt::format("{}: expected a folder that can be listed, but {}",
                                    where.string(), error.message()));
    return files;
}

// A file of a folder that is named as another is, but for these of its numbers.
struct Sibling {
    Path file;
    std::vector<std::size_t> differences;  // places in Name::digits, ascending; not empty
};

// A number of a name, or the two at the dot of a decimal one.
struct Place {
    std::size_t first, last;
    bool decimal() const { return first != last; }
    bool holds(const Sibling& sibling) const {
        return sibling.differences.front() >= first && sibling.differences.back() <= last;
    }
};

// Where a name may be numbered, the last place first. Before another number that varies, what may
// be decimal may also be a version.
std::vector<Place> placesOf(const Name& name, std::span<const Sibling> siblings) {
    std::size_t lastVaried = 0;
    for (const Sibling& sibling : siblings)
        lastVaried = std::max(lastVaried, sibling.differences.back());
    const std::vector<std::size_t> decimals = decimalPlaces(name);
    std::vector<Place> places;
    for (std::size_t at = name.digits.size(); at-- > 0;) {
        if (at >= lastVaried && std::ranges::find(decimals, at - 1) != decimals.end())
            places.push_back({at - 1, at});
        places.push_back({at, at});
    }
    return places;
}

// The file first, then those that differ from it there alone.
Paths alikeBut(Place place, const Path& file, std::span<const Sibling> siblings) {
    Paths files{file};
    for (const Sibling& sibling : siblings)
        if (place.holds(sibling)) files.push_back(sibling.file);
    return files;
}

// a_1 and a_01 alone are no series.
bool varies(std::span<const Path> files, Place place) {
    const Name first = cut(files.front());
    return std::ranges::any_of(files, [&](const Path& file) {
        const Name name = cut(file);
        for (std::size_t at = place.first; at <= place.last; ++at)
            if (withoutZeros(name.digits[at]) != withoutZeros(first.digits[at])) return true;
        return false;
    });
}

ExpandedSeries joined(const Path& file, const Numbered& series, const Paths& others) {
    ExpandedSeries result;
    describe(series, result);
    tellOthers(others, result);
    result.files = series.files;
    result.here =
        static_cast<std::size_t>(std::ranges::find(series.files, file) - series.files.begin());
    return result;
}

// The file's series: by the last number that varies.
ExpandedSeries seriesOf(const Path& file, std::span<const Sibling> siblings) {
    ExpandedSeries alone{{file}, {}, "", {}};
    const Name name = cut(file);
    for (const Place place : placesOf(name, siblings)) {
        const Paths files = alikeBut(place, file, siblings);
        if (!varies(files, place)) continue;
        if (place.decimal() && readingOf(files, place.first) == Dotted::Whole) continue;
        if (const auto series = numbered(files)) {
            Paths others;
            for (const Sibling& sibling : siblings)
                if (!place.holds(sibling)) others.push_back(sibling.file);
            return joined(file, *series, others);
        }
        tellUnclear(files, place.last, alone);
        return alone;
    }
    Paths others;
    for (const Sibling& sibling : siblings)
        if (sibling.differences.size() > 1)
            others.push_back(sibling.file);
        else
            alone.notes.push_back(
                fmt::format("number {} stands twice: {} and {}; only the file named is opened",
                            withoutZeros(name.digits[sibling.differences.front()]),
                            file.filename().string(), sibling.file.filename().string()));
    tellOthers(std::move(others), alone);
    return alone;
}

ExpandedSeries member(const Path& named, Members members = Members::Files) {
    ExpandedSeries alone{{named}, {}, "", {}};
    if (const Name name = cut(named); name.digits.empty() || isList(named)) return alone;
    std::optional<Paths> listed;
    try {
        listed = filesIn(named.parent_path(), members);
    } catch (const FileError&) {
        alone.notes.push_back("only this file is opened: its folder cannot be listed");
        return alone;
    }
    if (!listed) {
        alone.notes.push_back(fmt::format(
            "only this file is opened: its folder holds more than {} files", kMaxSeriesFiles));
        return alone;
    }
    *listed = firstPartsOf(std::move(*listed));
    const Path file = firstPartOf(named, *listed);
    const Name name = cut(file);
    std::vector<Sibling> siblings;
    Paths otherDots;
    for (const Path& other : *listed) {
        const Name its = cut(other);
        if (auto places = differences(name, its)) {
            if (!places->empty()) siblings.push_back({other, std::move(*places)});
        } else if (withoutFractions(its).texts == withoutFractions(name).texts &&
                   its.extension == name.extension) {
            otherDots.push_back(other);
        }
    }
    ExpandedSeries result = seriesOf(file, siblings);
    tellOtherDots(std::move(otherDots), result);
    return result;
}

// Files that were named or found together.
ExpandedSeries together(Paths files, std::string_view order) {
    files = firstPartsOf(std::move(files));
    const auto list = std::ranges::find_if(files, isList);
    if (list != files.end() && !std::ranges::all_of(files, isList))
        throw FileError(fmt::format("{}: expected it alone, for it lists the files of its series",
                                    list->string()));
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

// Those that begin as a format does that is read.
std::vector<Paths> readableOf(const Path& folder, const std::vector<Paths>& candidates) {
    std::vector<Paths> readable;
    for (const Paths& files : candidates)
        if (isReadable(files.front())) readable.push_back(files);
    if (!readable.empty()) return readable;
    constexpr std::size_t kMostTold = 8;
    std::string found;
    for (const Paths& files : std::span(candidates).first(std::min(candidates.size(), kMostTold))) {
        const std::string format = formatNotRead(files.front());
        found += (found.empty() ? "" : "; ") + candidatesText(std::span(&files, 1)) +
                 (format.empty() ? "" : ", " + format);
    }
    if (candidates.size() > kMostTold)
        found += fmt::format("; and {} more", candidates.size() - kMostTold);
    throw FileError(
        fmt::format("{}: expected a folder that holds NetCDF, NRRD, NIfTI, MRC, FITS or VTK files "
                    "that are read, "
                    "found {}",
                    folder.string(), found));
}

[[noreturn]] void refuseCandidates(const Path& folder, std::span<const Paths> candidates) {
    throw FileError(
        fmt::format("{}: expected a folder that holds one series, found {}; name one of them",
                    folder.string(), candidatesText(candidates)));
}

ExpandedSeries folder(const Path& folder) {
    if (const std::string other = otherFolder(folder); !other.empty())
        throw FileError(notReadSentence(folder, other));
    std::optional<Paths> listed = filesIn(folder);
    if (!listed)
        throw FileError(fmt::format("{}: expected a folder of at most {} files, found more",
                                    folder.string(), kMaxSeriesFiles));
    *listed = firstPartsOf(std::move(*listed));
    if (auto plotfiles = filesIn(folder, Members::Plotfiles); plotfiles && !plotfiles->empty())
        listed = std::move(plotfiles);
    if (const auto stores = filesIn(folder, Members::Stores))
        listed->insert(listed->end(), stores->begin(), stores->end());
    std::ranges::sort(*listed, nameLess);
    std::map<std::string, Paths> byExtension;
    for (const Path& file : *listed) byExtension[cut(file).extension].push_back(file);
    if (byExtension.empty())
        throw FileError(fmt::format(
            "{}: expected a folder that holds a series, found no files in it", folder.string()));

    std::vector<Paths> candidates;
    for (auto& [extension, files] : byExtension) candidates.push_back(std::move(files));
    if (candidates.size() > 1) {  // beside a readme, beside the raw data of detached headers
        candidates = readableOf(folder, candidates);
        for (const Paths& files : candidates)
            if (files.size() == 1 && isList(files.front())) {
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
        readableOf(folder, candidates);  // one at least
        // What is damaged stays beside it: it may be what was meant.
        std::erase_if(candidates,
                      [](const Paths& each) { return !formatNotRead(each.front()).empty(); });
        if (candidates.size() > 1) refuseCandidates(folder, candidates);
        files = candidates.front();
    }
    constexpr std::size_t kFew = 64;  // each is looked into
    if (files.size() > 1 && files.size() <= kFew && !std::ranges::all_of(files, isPlot3dPlaces))
        std::erase_if(files, isPlot3dPlaces);
    ExpandedSeries result = together(std::move(files), kByName);
    if (result.files.size() == 1)
        result.recognised =
            fmt::format("{}, the only file to open here", result.files.front().filename().string());
    return result;
}

}  // namespace

ExpandedSeries expandSeries(std::span<const Path> named) {
    if (named.size() == 1) {
        const Path& one = named.front();
        if (isPattern(one)) return together(filesOfPattern(one), kByName);
        if (isFoamCase(one)) return {{one}, {}, "", {}};
        if (isAmrex(one)) return member(amrexFolderOf(one), Members::Plotfiles);
        std::error_code ignored;
        if (std::filesystem::is_directory(one, ignored)) {
            const Path store = one.has_filename() ? one : one.parent_path();
            if (isStore(store)) {
                ExpandedSeries found = member(store, Members::Stores);
                if (found.files.size() == 1) found.files = {one};  // as it was named
                return found;
            }
            if (!isZarr(one)) return folder(one);
        }
        if (std::filesystem::is_regular_file(one, ignored)) return member(one);
        return {{one}, {}, "", {}};
    }
    Paths files;
    for (const Path& path : named) {
        if (isPattern(path)) {
            const Paths found = filesOfPattern(path);
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
        values.push_back(std::strtod(number.c_str(), nullptr));
        if (values.size() > 1 && !(values[values.size() - 2] < values.back())) return std::nullopt;
    }
    return values;
}

std::string commonName(std::span<const Path> paths) {
    const std::string first = paths.front().stem().string();
    std::size_t length = first.size();
    for (const Path& path : paths) {
        const std::string other = path.stem().string();
        const auto end = std::ranges::mismatch(std::string_view(first).substr(0, length), other);
        length = static_cast<std::size_t>(end.in1 - first.data());
    }
    while (length > 0 && (first[length] & 0xC0) == 0x80) --length;  // not within a UTF-8 character
    const std::string_view common = std::string_view(first).substr(0, length);
    const std::size_t last = common.find_last_not_of("0123456789 ._-");
    return last == common.npos ? "values" : std::string(common.substr(0, last + 1));
}

}  // namespace timeseries
