#include "timeseries/series/store_room.h"

#include <sys/stat.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

namespace timeseries {
namespace {

namespace fs = std::filesystem;

// Than a count took there are until the next.
constexpr int kTimesLonger = 20;

// A time of use that is so far to come is of a clock that was set back since; less is of a server
// whose clock is not ours.
constexpr std::chrono::minutes kAhead{1};

// Until that time came, such files would leave after all that are used meanwhile: they are used
// now, in their order.
void bringBack(std::vector<StoredFile>& files) {
    const auto now = std::chrono::system_clock::now();
    std::ranges::sort(files, std::greater(), &StoredFile::used);
    auto used = now;
    for (StoredFile& file : files) {
        if (file.used <= now + kAhead) break;
        file.used = used -= std::chrono::microseconds(1);
        setUse(file);
    }
}

}  // namespace

StoreRoom::StoreRoom(fs::path folder, std::uint64_t budget, std::chrono::milliseconds betweenCounts)
    : folder_(std::move(folder)), budget_(budget), betweenCounts_(betweenCounts) {}

bool StoreRoom::make(const fs::path& file, std::uint64_t bytes) {
    if (budget_ == kNoBudget) return true;
    const std::lock_guard lock(mutex_);
    if (std::chrono::steady_clock::now() >= nextCount_) count();
    const auto needed = [&] { return bytesWithout(file) + bytes; };
    if (needed() > budget_) askWhichAreHeld();
    const bool fits = needed() <= budget_ || bytesBesideHeld(file) + bytes <= budget_;
    while (fits && needed() > budget_ && removeOldest()) {
    }
    if (needed() > budget_) {  // also where those that should have left cannot be removed
        refused_ = std::max(refused_, bytes);
        return false;
    }
    put(file, {bytes, std::chrono::system_clock::now()});
    return true;
}

bool StoreRoom::isFree(const fs::path& file, std::uint64_t bytes) {
    if (budget_ == kNoBudget) return true;
    const std::lock_guard lock(mutex_);
    if (std::chrono::steady_clock::now() >= nextCount_) count();
    return bytesWithout(file) + bytes <= budget_;
}

// Which is written over.
std::uint64_t StoreRoom::bytesWithout(const fs::path& file) const {
    const auto there = files_.find(file);
    return bytes_ - (there == files_.end() ? 0 : there->second.bytes);
}

std::uint64_t StoreRoom::bytesBesideHeld(const fs::path& file) const {
    const auto there = files_.find(file);
    return heldThere_.bytes -
           (there != files_.end() && held_.contains(file) ? there->second.bytes : 0);
}

void StoreRoom::hold(std::function<std::vector<fs::path>()> which) {
    const std::lock_guard lock(mutex_);
    which_ = std::move(which);
}

void StoreRoom::askWhichAreHeld() {
    if (!which_) return;
    for (fs::path& file : std::exchange(which_, nullptr)()) {
        const auto there = files_.find(file);
        const auto as = there == files_.end() ? std::nullopt : std::optional(there->second);
        forget(file);
        held_.insert(file);
        if (as) put(file, *as);
    }
}

StoreRoom::Held StoreRoom::held() {
    const std::lock_guard lock(mutex_);
    count();
    askWhichAreHeld();
    return heldThere_;
}

std::uint64_t StoreRoom::refused() const {
    const std::lock_guard lock(mutex_);
    return refused_;
}

std::size_t StoreRoom::settle() {
    if (budget_ == kNoBudget) return 0;
    const std::lock_guard lock(mutex_);
    count();
    if (bytes_ > budget_) askWhichAreHeld();
    while (bytes_ > budget_ && removeOldest()) {
    }
    std::vector<std::pair<Time, fs::path>> lastFirst;
    if (bytes_ > budget_)
        for (const fs::path& file : held_)
            if (const auto there = files_.find(file); there != files_.end())
                lastFirst.emplace_back(there->second.used, file);
    std::ranges::sort(lastFirst, std::greater());
    std::size_t gone = 0;
    for (const auto& [used, file] : lastFirst) {
        std::error_code failed;
        if (bytes_ <= budget_) break;
        if (!fs::remove(file, failed)) continue;
        forget(file);
        ++gone;
    }
    return gone;
}

void StoreRoom::count() {
    const auto begin = std::chrono::steady_clock::now();
    files_.clear();
    byUse_.clear();
    bytes_ = 0;
    heldThere_ = {};
    std::vector<StoredFile> files = storedFiles(folder_);
    bringBack(files);
    for (const StoredFile& file : files) put(file.path, {file.bytes, file.used});
    const auto end = std::chrono::steady_clock::now();
    nextCount_ = end + std::max<std::chrono::steady_clock::duration>(betweenCounts_,
                                                                     kTimesLonger * (end - begin));
}

void StoreRoom::put(const fs::path& file, Counted as) {
    forget(file);
    files_[file] = as;
    bytes_ += as.bytes;
    if (held_.contains(file)) {
        ++heldThere_.files;
        heldThere_.bytes += as.bytes;
    } else {
        byUse_.emplace(as.used, file);
    }
}

void StoreRoom::forget(const fs::path& file) {
    const auto found = files_.find(file);
    if (found == files_.end()) return;
    bytes_ -= found->second.bytes;
    if (held_.contains(file)) {
        --heldThere_.files;
        heldThere_.bytes -= found->second.bytes;
    } else {
        byUse_.erase({found->second.used, file});
    }
    files_.erase(found);
}

bool StoreRoom::removeOldest() {
    if (byUse_.empty()) return false;
    const auto [used, file] = *byUse_.begin();
    struct stat status {};
    const bool isThere = ::lstat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode);
    if (isThere && timeOf(status.st_mtim) > used) {  // by whoever has it
        put(file, {static_cast<std::uint64_t>(status.st_size), timeOf(status.st_mtim)});
        return true;
    }
    std::error_code failed;
    // What stays takes its room still, what is somebody's own none.
    if (isThere && isOfStore(file) && !fs::remove(file, failed) && failed)
        byUse_.erase(byUse_.begin());
    else
        forget(file);
    return true;
}

}  // namespace timeseries
