// The room that the steps of a folder take, and who leaves where it does not suffice.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <utility>
#include <vector>

#include "timeseries/series/store_files.h"

namespace timeseries {

// To look at a folder of thousands of files takes longer than to write a small one: it is counted
// once, and then again only now and then, for others write there, too. Every member is safe to call
// from any thread.
class StoreRoom {
 public:
    static constexpr std::uint64_t kNoBudget = ~std::uint64_t{0};
    static constexpr std::chrono::milliseconds kBetweenCounts{1000};
    // What others write is seen after `betweenCounts`, or later where to look takes more than a
    // small part of the time.
    StoreRoom(std::filesystem::path folder, std::uint64_t budget,
              std::chrono::milliseconds betweenCounts = kBetweenCounts);

    std::uint64_t budget() const { return budget_; }
    // Makes room for this file of so many bytes, and takes it as written: those used last stay.
    // False, and none leaves, where it does not fit beside those that are held.
    bool make(const std::filesystem::path& file, std::uint64_t bytes);
    // Whether this file of so many bytes fits without any other leaving.
    bool isFree(const std::filesystem::path& file, std::uint64_t bytes);
    // Those of one request do not make room for each other. Which they are is asked when one has to
    // leave, once.
    void hold(std::function<std::vector<std::filesystem::path>()> which);
    // Counts anew, and what others have written beyond the budget meanwhile leaves; of those that
    // are held the last ones, where all of them are too many. Returns how many of these.
    std::size_t settle();
    struct Held {
        std::size_t files = 0;  // that are there
        std::uint64_t bytes = 0;
    };
    Held held();
    // The bytes of the largest file that did not fit.
    std::uint64_t refused() const;

 private:
    using Time = std::chrono::system_clock::time_point;
    struct Counted {
        std::uint64_t bytes;
        Time used;
    };
    // REQUIRES, as what follows: mutex_ is held.
    void count();
    void put(const std::filesystem::path& file, Counted as);
    void forget(const std::filesystem::path& file);
    void askWhichAreHeld();
    std::uint64_t bytesWithout(const std::filesystem::path& file) const;
    std::uint64_t bytesBesideHeld(const std::filesystem::path& file) const;
    // Unless it turns out to have been used later than another. False where there is none.
    bool removeOldest();

    const std::filesystem::path folder_;
    const std::uint64_t budget_;
    const std::chrono::milliseconds betweenCounts_;
    mutable std::mutex mutex_;
    std::map<std::filesystem::path, Counted> files_;          // guarded by mutex_, as what follows
    std::set<std::pair<Time, std::filesystem::path>> byUse_;  // those that are not held
    std::uint64_t bytes_ = 0;                                 // of files_
    std::chrono::steady_clock::time_point nextCount_{};
    std::function<std::vector<std::filesystem::path>()> which_;
    std::set<std::filesystem::path> held_;
    Held heldThere_;
    std::uint64_t refused_ = 0;
};

}  // namespace timeseries
