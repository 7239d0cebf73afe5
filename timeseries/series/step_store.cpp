#include "timeseries/series/step_store.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <xxhash.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "readers_version.h"

namespace timeseries {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::system_clock;
using nlohmann::ordered_json;

// From where the store lies to a file that it lies beside, or in a folder there: of files alike in
// name there may be one for each case, run or time.
fs::path fromBeside(const fs::path& store, const fs::path& file) {
    const auto plain = [](const fs::path& path) {
        std::error_code failed;
        return fs::absolute(path, failed).lexically_normal();
    };
    const fs::path near = plain(file).lexically_relative(plain(store).parent_path());
    return near.empty() ? plain(file) : near;
}

// JSON holds UTF-8 alone, names of files any bytes.
std::string textOf(const std::string& text) {
    return ordered_json(text).dump(-1, ' ', true, ordered_json::error_handler_t::replace);
}

// What a stamp's text says of them; null where it is none.
ordered_json filesOf(const std::string& stamp) {
    const auto all = ordered_json::parse(stamp, nullptr, false);
    return all.is_object() ? all.value("files", ordered_json()) : ordered_json();
}

}  // namespace

std::vector<std::string> StepStore::namesOf(const StepOrigin& origin) const {
    std::vector<std::string> names;
    for (const fs::path& file : origin.files) {
        if (kind_ == StoreKind::Beside) {
            names.push_back(fromBeside(folder_, file).string());
            continue;
        }
        std::error_code failed;
        const fs::path whole = fs::weakly_canonical(file, failed);
        names.push_back((failed ? fs::absolute(file, failed) : whole).string());
    }
    return names;
}

StepStore::StepStore(fs::path folder, StoreKind kind, std::uint64_t budget,
                     std::chrono::milliseconds settled)
    : folder_(std::move(folder)), kind_(kind), settled_(settled), room_(folder_, budget) {}

std::optional<OriginStamp> StepStore::stampOf(const StepOrigin& origin) const {
    return stampOf(origin, namesOf(origin));
}

std::optional<OriginStamp> StepStore::stampOf(const StepOrigin& origin,
                                              std::span<const std::string> names) const {
    OriginStamp stamp;
    std::string files;
    for (std::size_t i = 0; i < names.size(); ++i) {
        struct stat status {};
        if (::stat(origin.files[i].c_str(), &status) != 0) return std::nullopt;
        files += fmt::format("{}{{\"file\": {}, \"bytes\": {}, \"modified\": {}",
                             files.empty() ? "" : ", ", textOf(names[i]), status.st_size,
                             nanosecondsOf(status.st_mtim));
        auto last = timeOf(status.st_mtim);
        if (kind_ == StoreKind::Cache) {
            files += fmt::format(", \"changed\": {}", nanosecondsOf(status.st_ctim));
            last = std::max(last, timeOf(status.st_ctim));
        }
        files += "}";
        stamp.changed = std::max(stamp.changed, last);
    }
    stamp.text = fmt::format(
        "{{\"variable\": {}, \"storedAs\": {}, \"step\": {}, \"readers\": {}, \"files\": [{}]}}",
        textOf(origin.variable), textOf(origin.storedAs), origin.step, textOf(kReadersVersion),
        files);
    return stamp;
}

fs::path StepStore::pathOf(const StepOrigin& origin) const {
    return pathOf(origin, namesOf(origin));
}

fs::path StepStore::pathOf(const StepOrigin& origin, std::span<const std::string> names) const {
    // Each part with its length, so that no two origins read the same.
    std::string whole;
    const auto add = [&](const std::string& part) {
        whole += fmt::format("{}:{};", part.size(), part);
    };
    for (const std::string& name : names) add(name);
    add(origin.variable);
    add(origin.storedAs);
    add(std::to_string(origin.step));
    const XXH128_hash_t hash = XXH3_128bits(whole.data(), whole.size());
    return folder_ / fmt::format("{:016x}{:016x}{}", hash.high64, hash.low64, kStoredSuffix);
}

std::shared_ptr<const StepFile> StepStore::find(const StepOrigin& origin, bool* changed) {
    auto file = look(origin, changed);
    if (!file) return nullptr;
    // When it was used last; a folder that cannot be written to keeps what it has.
    (void)::utimensat(AT_FDCWD, file->name().c_str(), nullptr, 0);
    return file;
}

std::shared_ptr<const StepFile> StepStore::look(const StepOrigin& origin, bool* changed) {
    const std::vector<std::string> names = namesOf(origin);
    const fs::path path = pathOf(origin, names);
    const auto stamp = stampOf(origin, names);
    if (!stamp) return nullptr;
    try {
        auto bytes = timeseries::openBytes(path);
        if (!bytes) return nullptr;
        auto file = std::make_shared<const StepFile>(std::move(bytes));
        if (file->about() == stamp->text) return file;
        if (changed && filesOf(file->about()) != filesOf(stamp->text)) *changed = true;
    } catch (const OtherStepError&) {  // which may be of use to whoever wrote it
        note(folder_.string() +
             ": steps that another version of the program sorted, or another kind of machine, are "
             "sorted anew");
    } catch (const DamagedStepError& error) {
        discard(path, error.what());
    } catch (const StepFileError& error) {
        note(error.what());
    }
    return nullptr;
}

StepStore::Wrote StepStore::write(const StepOrigin& origin, const OriginStamp& stamp,
                                  const SortedStep& step, Clock::time_point opened,
                                  const std::function<bool(double)>& goOn) {
    return write(origin, stamp, opened,
                 [&](WholeFile& file) { return writeStep(step, stamp.text, file, goOn); });
}

StepStore::Wrote StepStore::write(const StepOrigin& origin, const OriginStamp& stamp,
                                  Clock::time_point opened,
                                  const std::function<bool(WholeFile&)>& into) {
    const auto isStill = [&] {
        const auto now = stampOf(origin);
        return now && now->text == stamp.text;
    };
    if (stamp.changed + settled_ > std::min(opened, Clock::now()) || !isStill())
        return Wrote::Nothing;
    std::error_code failed;
    fs::create_directories(folder_, failed);
    if (failed)
        throw StepFileError(
            fmt::format("{}: no folder can be made there: {}", folder_.string(), failed.message()));
    removeLeftovers();
    const fs::path path = pathOf(origin);
    WholeFile file(path);
    if (!file.isLocked())
        note(folder_.string() +
             ": its file system knows no locks, so that what interrupted programs leave there (" +
             WholeFile::kSuffix + ") stays");
    if (!into(file) || !isStill()) return Wrote::Nothing;
    if (!room_.make(path, file.bytes())) return Wrote::NoRoom;
    file.finish();
    return Wrote::All;
}

std::vector<StoredFile> StepStore::list() const {
    std::vector<StoredFile> files = storedFiles(folder_);
    std::erase_if(files, [](const StoredFile& file) { return !isOfStore(file.path); });
    std::ranges::sort(files, std::greater(), &StoredFile::used);
    return files;
}

bool StepStore::isEmpty() const {
    try {
        return storedFiles(folder_).empty();
    } catch (const StepFileError&) {
        return true;
    }
}

std::string StepStore::aboutOf(const fs::path& path) {
    try {
        auto bytes = timeseries::openBytes(path);
        return bytes ? StepFile(std::move(bytes)).about() : "";
    } catch (const StepFileError&) {
        return "";
    }
}

std::optional<Clock::time_point> StepStore::changedAt(const fs::path& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0) return std::nullopt;
    return std::max(timeOf(status.st_mtim), timeOf(status.st_ctim));
}

// Programs that are interrupted are few: once for each that writes.
void StepStore::removeLeftovers() {
    {
        const std::lock_guard lock(mutex_);
        if (std::exchange(isTidied_, true)) return;
    }
    removeUnfinished(folder_, isStored);
}

std::uint64_t StepStore::clear() {
    removeUnfinished(folder_, isStored);
    std::uint64_t bytes = 0;
    for (const StoredFile& file : list()) {
        std::error_code failed;
        if (fs::remove(file.path, failed)) bytes += file.bytes;
        if (failed)
            throw StepFileError(fmt::format("{}: cannot be removed: {}; {:.1f} MB were before it",
                                            file.path.string(), failed.message(),
                                            static_cast<double>(bytes) * 1e-6));
    }
    return bytes;
}

void StepStore::discard(const fs::path& path, const std::string& why) {
    std::error_code failed;
    fs::remove(path, failed);
    note(why +
         (failed ? fmt::format("; it cannot be removed ({})", failed.message())
                 : "; it was removed") +
         ", and the step is read from its own file");
}

void StepStore::tellChanged(const fs::path& file) {
    note(file.string() +
         ": it has changed since it was sorted; it, and others that have, are sorted anew");
}

void StepStore::giveUp(const std::string& why) {
    note(why + ": sorted steps are not kept on disk");
}

void StepStore::note(std::string text) {
    const std::lock_guard lock(mutex_);
    if (std::ranges::find(told_, text) != told_.end()) return;
    told_.push_back(text);
    notes_.push_back(std::move(text));
}

std::vector<std::string> StepStore::takeNotes() {
    const std::lock_guard lock(mutex_);
    return std::exchange(notes_, {});
}

std::uint64_t defaultCacheBudget(const fs::path& folder) {
    constexpr std::uint64_t kMost = std::uint64_t{64} << 30;
    std::error_code failed;
    fs::path there = folder;
    while (!fs::exists(there, failed) && there.has_relative_path()) there = there.parent_path();
    const fs::space_info space = fs::space(there, failed);
    return failed ? kMost : std::min<std::uint64_t>(kMost, space.capacity / 10);
}

}  // namespace timeseries
