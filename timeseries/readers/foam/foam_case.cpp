#include "timeseries/readers/foam/foam_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "timeseries/readers/foam/foam_file.h"
#include "timeseries/readers/limits.h"
#include "timeseries/readers/reader.h"
#include "timeseries/readers/text/cut_name.h"
#include "timeseries/readers/text/number_text.h"

namespace timeseries {
namespace {

namespace fs = std::filesystem;

using FoamTimes = std::vector<FoamTime>;

bool isFoamFolder(const fs::path& folder) {
    std::error_code ignored;
    return fs::exists(folder / "system" / "controlDict", ignored) ||
           fs::is_directory(folder / "constant" / "polyMesh", ignored);
}

fs::path caseFolderOf(const fs::path& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) return path;
    const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
    if (path.filename() != "controlDict") return folder;
    // "system" alone is beside the case's other folders.
    return folder.has_parent_path() ? folder.parent_path() : folder == "." ? ".." : ".";
}

// The names in a folder, in natural order; none where it cannot be listed.
std::vector<std::string> foldersOrFilesIn(const fs::path& folder, fs::file_type type) {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        std::error_code ignored;
        if (entry->status(ignored).type() == type)
            names.push_back(entry->path().filename().string());
    }
    std::ranges::sort(names, [](const auto& a, const auto& b) { return nameLess(a, b); });
    return names;
}

std::optional<double> timeOf(const std::string& name) {
    if (name.find_first_not_of("0123456789.eE+-") != name.npos) return std::nullopt;
    const auto value = numberOfText<double>(name);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

FoamTimes timesIn(const fs::path& folder) {
    FoamTimes times;
    for (const std::string& name : foldersOrFilesIn(folder, fs::file_type::directory))
        if (const auto value = timeOf(name)) times.push_back({*value, name});
    std::ranges::stable_sort(times, {}, &FoamTime::value);
    if (times.size() > kMaxSteps)
        throw FileError(fmt::format("{}: expected at most {} times, found {}", folder.string(),
                                    kMaxSteps, times.size()));
    return times;
}

// Without .gz; nothing of what editors and OpenFOAM itself leave beside fields.
std::set<std::string> fieldNamesIn(const fs::path& folder) {
    std::set<std::string> fields;
    for (std::string name : foldersOrFilesIn(folder, fs::file_type::regular)) {
        if (name.ends_with(".gz")) name.resize(name.size() - 3);
        if (!name.empty() && name.front() != '.' && name.back() != '~') fields.insert(name);
    }
    return fields;
}

bool holds(const fs::path& folder, const std::string& name) {
    std::error_code ignored;
    return fs::exists(foamPath(folder, name), ignored);
}

FoamCase::Meshes meshesIn(const fs::path& part, const FoamTimes& times) {
    FoamCase::Meshes meshes;
    const auto add = [&](double since, const fs::path& folder) {
        if (holds(folder, "points")) meshes.points.push_back({since, folder});
        if (holds(folder, "faces")) meshes.faces.push_back({since, folder});
    };
    add(-std::numeric_limits<double>::infinity(), part / "constant" / "polyMesh");
    for (const FoamTime& time : times) {
        std::error_code ignored;
        const fs::path folder = part / time.name / "polyMesh";
        if (fs::is_directory(folder, ignored)) add(time.value, folder);
    }
    return meshes;
}

// Of the processors of a case that was decomposed, in the order of their numbers.
std::vector<fs::path> processorsOf(const fs::path& folder) {
    std::vector<fs::path> all;
    for (const std::string& name : foldersOrFilesIn(folder, fs::file_type::directory)) {
        constexpr std::string_view kProcessor = "processor";
        if (!name.starts_with(kProcessor) || name.size() == kProcessor.size() ||
            name.find_first_not_of("0123456789", kProcessor.size()) != name.npos)
            continue;
        all.push_back(folder / name);
    }
    return all;
}

void expectAllFromZero(std::span<const fs::path> processors) {
    for (std::size_t i = 0; i < processors.size(); ++i)
        if (processors[i].filename() != fmt::format("processor{}", i))
            throw FileError(fmt::format("{}: expected a folder processor{}, found {}",
                                        processors[i].parent_path().string(), i,
                                        processors[i].filename().string()));
}

// Collated: "processors4", or "processors4_0-1".
std::string collatedIn(const fs::path& folder) {
    for (const std::string& name : foldersOrFilesIn(folder, fs::file_type::directory))
        if (name.starts_with("processors") && name.size() > 10 && name[10] >= '0' &&
            name[10] <= '9')
            return name;
    return "";
}

[[noreturn]] void refuseFoam(const fs::path& folder, std::string_view what) {
    throw FileError(fmt::format("{}: {}", folder.string(), what));
}

// Of the times of one part, those that are a step: the first of several of one value, that have
// fields.
void addTimes(FoamCase& all, const FoamTimes& times) {
    for (const FoamTime& time : times) {
        const auto fields = fieldNamesIn(all.parts[0] / time.name);
        if (fields.empty()) continue;
        if (!all.times.empty() && all.times.back().value == time.value) {
            all.notes.push_back(fmt::format("{} is left out: its time is that of {}", time.name,
                                            all.times.back().name));
            continue;
        }
        for (const std::string& field : fields) all.fields[field].push_back(all.times.size());
        all.times.push_back(time);
    }
}

// The case's own times, or those that all processors have where these are more.
FoamTimes chooseParts(FoamCase& all) {
    all.parts = {all.folder};
    FoamTimes own = timesIn(all.folder);
    const auto processors = processorsOf(all.folder);
    FoamTimes common = processors.empty() ? FoamTimes() : timesIn(processors[0]);
    // Of a time, how many processors have it.
    std::map<std::pair<double, std::string>, std::size_t> holders;
    for (const fs::path& processor : processors)
        for (const FoamTime& time : timesIn(processor)) ++holders[{time.value, time.name}];
    std::erase_if(common, [&](const FoamTime& time) {
        return holders[{time.value, time.name}] < processors.size();
    });
    std::erase_if(holders, [&](const auto& each) { return each.second == processors.size(); });
    if (common.size() > own.size()) {
        expectAllFromZero(processors);
        all.parts = processors;
        all.notes.push_back(fmt::format("read from its {} processor folders", processors.size()));
        if (holders.empty()) return common;
        const auto& [time, count] = *holders.begin();
        all.notes.push_back(fmt::format("{} is left out: {} of {} processor folders have it",
                                        time.second, count, processors.size()));
        if (holders.size() > 1)
            all.notes.back() += fmt::format(", and so are {} later times", holders.size() - 1);
        return common;
    }
    const std::string collated = collatedIn(all.folder);
    if (collated.empty()) return own;
    const std::string what = fmt::format(
        "{} is collated, which is not read: reconstructPar makes times of it", collated);
    if (own.size() < 2 && timesIn(all.folder / collated).size() > own.size())
        refuseFoam(all.folder, what);
    all.notes.push_back(what);
    return own;
}

// The latest that is not after the time.
fs::path latest(const std::vector<FoamCase::MeshFolder>& folders, double time, const fs::path& part,
                const char* name) {
    const auto after = std::ranges::upper_bound(folders, time, {}, &FoamCase::MeshFolder::since);
    const fs::path folder =
        after == folders.begin() ? part / "constant" / "polyMesh" : std::prev(after)->folder;
    return foamPath(folder, name);
}

}  // namespace

bool isFoamCase(const fs::path& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) return isFoamFolder(path);
    const std::string extension = path.extension().string();
    if (!fs::is_regular_file(path, ignored)) return false;
    return extension == ".foam" || extension == ".OpenFOAM" ||
           (path.filename() == "controlDict" && isFoamFolder(caseFolderOf(path)));
}

std::vector<fs::path> FoamCase::filesOf(const std::string& field, std::size_t time) const {
    std::vector<fs::path> files;
    for (const fs::path& part : parts) files.push_back(foamPath(part / times[time].name, field));
    return files;
}

std::vector<FoamMeshFiles> FoamCase::meshAt(std::size_t time) const {
    std::vector<FoamMeshFiles> files;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const auto& [points, faces] = meshes[p];
        const double value = times[time].value;
        const fs::path face = latest(faces, value, parts[p], "faces");
        const fs::path of = face.parent_path();
        files.push_back({latest(points, value, parts[p], "points"), face, foamPath(of, "owner"),
                         foamPath(of, "neighbour")});
    }
    return files;
}

FoamCase foamCaseOf(const fs::path& path) {
    FoamCase all;
    all.folder = caseFolderOf(path);
    if (!isFoamFolder(all.folder))
        refuseFoam(path, "expected an OpenFOAM case around it, with system/controlDict");
    addTimes(all, chooseParts(all));
    for (const fs::path& part : all.parts) all.meshes.push_back(meshesIn(part, timesIn(part)));
    return all;
}

}  // namespace timeseries
