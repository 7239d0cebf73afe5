// A folder of sorted steps on disk, each under a name made of where it came from, so that a step
// sorted once is opened, not sorted again.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "timeseries/index/sorted_step.h"
#include "timeseries/index/step_file.h"
#include "timeseries/series/store_files.h"
#include "timeseries/series/store_room.h"
#include "timeseries/series/whole_file.h"

namespace timeseries {

// What a step was made of.
struct StepOrigin {
    std::vector<std::filesystem::path> files;  // all that its values come from, at least one
    std::size_t step = 0;                      // of those that the files have
    std::string variable, storedAs;            // Variable::name, and what else tells it from others
    friend bool operator==(const StepOrigin&, const StepOrigin&) = default;
};

// An origin as it was at a moment: a text that is another one when a file of it has changed.
struct OriginStamp {
    std::string text;
    // When the last change was, by the clock of the files.
    std::chrono::system_clock::time_point changed;
};

// Whose the steps are.
enum class StoreKind {
    Cache,  // this machine's: files by their whole paths, and by all that the system knows of them
    Beside  // lies beside the data and moves with it: how files are reached from there, their sizes
            // and times of modification
};

// Every member is safe to call from any thread, and several processes may use one folder. What
// cannot be read is as if it were not there; nothing is ever locked for readers.
class StepStore {
 public:
    static constexpr std::uint64_t kNoBudget = StoreRoom::kNoBudget;
    static constexpr std::chrono::milliseconds kSettled{2000};
    // A file of the origin that changed less than `settled` before it was opened may have changed
    // again and have the same time: such a step is not written.
    StepStore(std::filesystem::path folder, StoreKind kind, std::uint64_t budget = kNoBudget,
              std::chrono::milliseconds settled = kSettled);

    const std::filesystem::path& folder() const { return folder_; }
    // None when a file of it is not there.
    std::optional<OriginStamp> stampOf(const StepOrigin& origin) const;
    // Null where there is none, or it was made of what the origin no longer is, whose files may
    // have `changed` since; what is damaged is removed and told, what another version wrote told
    // alone.
    std::shared_ptr<const StepFile> find(const StepOrigin& origin, bool* changed = nullptr);
    // As find(), but it does not count as use.
    std::shared_ptr<const StepFile> look(const StepOrigin& origin, bool* changed = nullptr);
    // The file that a step is, or would be, in.
    std::filesystem::path pathOf(const StepOrigin& origin) const;

    // Writes the step, whole or not at all, over one that is there. `stamp`: of the origin before
    // the step was read; `opened`: when its files were opened. Nothing is written when
    // the stamp is another now, or was not settled then, or goOn() says no. Throws StepFileError,
    // whose sentence says what is not possible.
    enum class Wrote { All, Nothing, NoRoom };
    Wrote write(const StepOrigin& origin, const OriginStamp& stamp, const SortedStep& step,
                std::chrono::system_clock::time_point opened,
                const std::function<bool(double)>& goOn = {});
    // Written by whoever knows the points: into(file) writes all but finish(), and says whether
    // it did.
    Wrote write(const StepOrigin& origin, const OriginStamp& stamp,
                std::chrono::system_clock::time_point opened,
                const std::function<bool(WholeFile&)>& into);
    // Steps cannot be written there: why, is told.
    void giveUp(const std::string& why);
    // A file of steps that will be sorted anew.
    void tellChanged(const std::filesystem::path& file);

    // The last used first. Throws StepFileError where the folder is none, or cannot be listed.
    std::vector<StoredFile> list() const;
    // Whether none would be found: nothing is there, or cannot be listed.
    bool isEmpty() const;
    // What one of them was made of, OriginStamp::text; "" where it cannot be read.
    static std::string aboutOf(const std::filesystem::path& path);
    // When a file was changed last; none where it is not there.
    static std::optional<std::chrono::system_clock::time_point> changedAt(
        const std::filesystem::path& file);
    // Removes all, and what interrupted writers have left; what no store has written stays.
    // Returns the bytes that were taken. Throws StepFileError.
    std::uint64_t clear();

    // A step turned out to be damaged: it is removed, and told.
    void discard(const std::filesystem::path& path, const std::string& why);
    // For how much, and for what, there is room here.
    StoreRoom& room() { return room_; }
    std::uint64_t budget() const { return room_.budget(); }
    // What a user should know, each once, since the last call.
    std::vector<std::string> takeNotes();

 private:
    // What the origin's files are known by, which asks the system for each folder on their ways.
    std::vector<std::string> namesOf(const StepOrigin& origin) const;
    std::optional<OriginStamp> stampOf(const StepOrigin& origin,
                                       std::span<const std::string> names) const;
    std::filesystem::path pathOf(const StepOrigin& origin,
                                 std::span<const std::string> names) const;
    void removeLeftovers();
    void note(std::string text);

    const std::filesystem::path folder_;
    const StoreKind kind_;
    const std::chrono::milliseconds settled_;
    StoreRoom room_;
    mutable std::mutex mutex_;
    std::vector<std::string> notes_, told_;  // guarded by mutex_, as what follows
    bool isTidied_ = false;
};

// A tenth of the disk that the folder is, or would be, on, at most 64 GiB.
std::uint64_t defaultCacheBudget(const std::filesystem::path& folder);

}  // namespace timeseries
