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

constexpr const char* kSuffix = ".isostep";

std::int64_t nanosecondsOf(const timespec& at) {
    return std::int64_t{at.tv_sec} * 1'000'000'000 + at.tv_nsec;
}

Clock::time_point timeOf(std::int64_t sinceEpoch) {
    return Clock::time_point(
        std::chrono::duration_cast<Clock::duration>(std::chrono::nanoseconds(sinceEpoch)));
}

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

// `pathOf` gives such names, 32 digits; what else lies in a folder is somebody's own.
bool isStored(const fs::path& path) {
    const std::string name = path.stem().string();
    return path.extension() == kSuffix && name.size() == 32 &&
           name.find_first_not_of("0123456789abcdef") == name.npos;
}

// JSON holds UTF-8 alone, names of files any bytes.
std::string textOf(const std::string& text) {
    return ordered_json(text).dump(-1, ' ', true, ordered_json::error_handler_t::replace);
}

}  // namespace

fs::path StepStore::nameOf(const fs::path& file) const {
    if (kind_ == StoreKind::Beside) return fromBeside(folder_, file);
    std::error_code failed;
    const fs::path whole = fs::weakly_canonical(file, failed);
    return failed ? fs::absolute(file, failed) : whole;
}

StepStore::StepStore(fs::path folder, StoreKind kind, std::uint64_t budget,
                     std::chrono::milliseconds settled)
    : folder_(std::move(folder)), kind_(kind), budget_(budget), settled_(settled) {}

std::optional<OriginStamp> StepStore::stampOf(const StepOrigin& origin) const {
    OriginStamp stamp;
    std::string files;
    for (const fs::path& file : origin.files) {
        struct stat status {};
        if (::stat(file.c_str(), &status) != 0) return std::nullopt;
        files += fmt::format("{}{{\"file\": {}, \"bytes\": {}, \"modified\": {}",
                             files.empty() ? "" : ", ", textOf(nameOf(file).string()),
                             status.st_size, nanosecondsOf(status.st_mtim));
        std::int64_t last = nanosecondsOf(status.st_mtim);
        if (kind_ == StoreKind::Cache) {
            files += fmt::format(", \"changed\": {}", nanosecondsOf(status.st_ctim));
            last = std::max(last, nanosecondsOf(status.st_ctim));
        }
        files += "}";
        stamp.changed = std::max(stamp.changed, timeOf(last));
    }
    stamp.text = fmt::format(
        "{{\"variable\": {}, \"storedAs\": {}, \"step\": {}, \"readers\": {}, \"files\": [{}]}}",
        textOf(origin.variable), textOf(origin.storedAs), origin.step, textOf(kReadersVersion),
        files);
    return stamp;
}

fs::path StepStore::pathOf(const StepOrigin& origin) const {
    // Each part with its length, so that no two origins read the same.
    std::string whole;
    const auto add = [&](const std::string& part) {
        whole += fmt::format("{}:{};", part.size(), part);
    };
    for (const fs::path& file : origin.files) add(nameOf(file).string());
    add(origin.variable);
    add(origin.storedAs);
    add(std::to_string(origin.step));
    const XXH128_hash_t hash = XXH3_128bits(whole.data(), whole.size());
    return folder_ / fmt::format("{:016x}{:016x}{}", hash.high64, hash.low64, kSuffix);
}

std::shared_ptr<const StepFile> StepStore::find(const StepOrigin& origin) {
    auto file = look(origin);
    if (!file) return nullptr;
    // When it was used last; a folder that cannot be written to keeps what it has.
    (void)::utimensat(AT_FDCWD, file->name().c_str(), nullptr, 0);
    own(pathOf(origin));
    return file;
}

std::shared_ptr<const StepFile> StepStore::look(const StepOrigin& origin) {
    const fs::path path = pathOf(origin);
    const auto stamp = stampOf(origin);
    if (!stamp) return nullptr;
    try {
        auto bytes = timeseries::openBytes(path);
        if (!bytes) return nullptr;
        auto file = std::make_shared<const StepFile>(std::move(bytes));
        return file->about() == stamp->text ? file : nullptr;
    } catch (const DamagedStepError& error) {
        discard(path, error.what());
    } catch (const StepFileError& error) {
        note(error.what());
    }
    return nullptr;
}

bool StepStore::write(const StepOrigin& origin, const OriginStamp& stamp, const SortedStep& step,
                      Clock::time_point opened, const std::function<bool(double)>& goOn) {
    return write(origin, stamp, opened,
                 [&](WholeFile& file) { return writeStep(step, stamp.text, file, goOn); });
}

bool StepStore::write(const StepOrigin& origin, const OriginStamp& stamp, Clock::time_point opened,
                      const std::function<bool(WholeFile&)>& into) {
    const auto isStill = [&] {
        const auto now = stampOf(origin);
        return now && now->text == stamp.text;
    };
    if (stamp.changed + settled_ > std::min(opened, Clock::now()) || !isStill()) return false;
    std::error_code failed;
    fs::create_directories(folder_, failed);
    if (failed) throw StepFileError(fmt::format("{}: {}", folder_.string(), failed.message()));
    removeUnfinished(folder_, isStored);
    WholeFile file(pathOf(origin));
    if (!into(file) || !isStill()) return false;
    file.finish();
    own(pathOf(origin));
    makeRoom();
    return true;
}

std::vector<StepStore::Entry> StepStore::list() const {
    std::vector<Entry> entries;
    std::error_code failed;
    for (const auto& item : fs::directory_iterator(folder_, failed)) {
        if (!isStored(item.path())) continue;
        struct stat status {};
        if (::stat(item.path().c_str(), &status) != 0 || !S_ISREG(status.st_mode)) continue;
        entries.push_back({item.path(), static_cast<std::uint64_t>(status.st_size),
                           timeOf(nanosecondsOf(status.st_mtim))});
    }
    std::ranges::sort(entries, std::greater(), &Entry::used);
    return entries;
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
    return timeOf(std::max(nanosecondsOf(status.st_mtim), nanosecondsOf(status.st_ctim)));
}

std::uint64_t StepStore::clear() {
    removeUnfinished(folder_, isStored);
    std::uint64_t bytes = 0;
    for (const Entry& entry : list()) {
        std::error_code failed;
        if (fs::remove(entry.path, failed)) bytes += entry.bytes;
        if (failed)
            throw StepFileError(fmt::format("{}: cannot be removed: {}; {:.1f} MB were before it",
                                            entry.path.string(), failed.message(),
                                            static_cast<double>(bytes) * 1e-6));
    }
    return bytes;
}

// Those used last stay.
void StepStore::makeRoom() {
    if (budget_ == kNoBudget) return;
    std::uint64_t bytes = 0;
    std::error_code failed;
    for (const Entry& entry : list()) {
        bytes += entry.bytes;
        if (bytes <= budget_ || !fs::remove(entry.path, failed)) continue;
        const std::lock_guard lock(mutex_);
        lost_ += own_.erase(entry.path);
    }
}

void StepStore::own(fs::path path) {
    const std::lock_guard lock(mutex_);
    own_.insert(std::move(path));
}

std::size_t StepStore::lost() const {
    const std::lock_guard lock(mutex_);
    return lost_;
}

void StepStore::discard(const fs::path& path, const std::string& why) {
    std::error_code failed;
    fs::remove(path, failed);
    note(why +
         (failed ? fmt::format("; it cannot be removed ({})", failed.message())
                 : "; it was removed") +
         ", and the step is read from its own file");
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
