// Makes the sorted steps of a variable: a step that is on disk is opened, another one read and
// sorted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "timeseries/readers/reader.h"
#include "timeseries/series/opened_files.h"
#include "timeseries/series/step_store.h"

namespace timeseries {

struct StepStores {
    std::vector<std::shared_ptr<StepStore>> read;  // in this order
    std::shared_ptr<StepStore> write = nullptr;    // null: nothing is written
    // make(): steps of fewer points are sorted as soon as a file is read.
    std::uint64_t worthWriting = 8'000'000;
};

// None where the reader does not know it. Throws FileError.
std::optional<StepOrigin> originOf(Reader& reader, std::size_t variable, std::size_t step);
// Throws FileError when a file of it has been removed: who has it open may read on, and what is
// read is of no file any more.
void expectThere(const StepOrigin& origin);

// One thread at a time.
class StepMaker {
 public:
    // What steps that are sorted have in memory (SortedStep::buildWithField).
    enum class Holds { Points, Field };
    // Steps that are sorted have the values in `kept`, outside of which nothing is told, or fewer:
    // those in the ranges that are `asked` for, and no others are put in order or written.
    // REQUIRES: variable < reader->variables().size().
    StepMaker(std::unique_ptr<Reader> reader, std::size_t variable, RangeSet kept,
              StepStores stores = {}, Holds holds = Holds::Points,
              RangeSet asked = RangeSet::everything());

    const Variable& variable() const { return reader_->variables()[variable_]; }
    // Throws FileError, std::length_error, std::bad_alloc.
    std::shared_ptr<const SortedStep> make(std::size_t step);

    // Writes it at once, unless it is there, or cannot be kept: its points move, it has no value,
    // its files have changed meanwhile or just before, nobody knows which these are, or there is no
    // room. Throws as make(), and StepFileError.
    enum class Kept { Before, Written, Moves, Empty, Changed, Unknown, NoRoom };
    static constexpr std::size_t kKept = 7;
    // Given how much of it is written, of 1, now and then: whether to go on. What is stopped is not
    // kept.
    using GoOn = std::function<bool(double)>;
    Kept keep(std::size_t step, const GoOn& goOn = {});
    // Of steps that have no origin: Unknown, or Moves. Throws FileError, of any of them.
    static Kept keptWithoutOrigin(Reader& reader, std::size_t variable);
    // As keep() where there is no room: without sorting.
    Kept keepNoMore(std::size_t step);

    // Of steps that were sorted and are worth writing, those that nobody has any more are left, or
    // read again, unless there is no room for them but that of others.
    enum class Again { Leave, Read };
    bool hasUnwritten() const { return !unwritten_.empty(); }
    bool canWrite(Again again) const;
    // Writes one of them, if there is one, while goOn() says so, which is not asked while it is
    // read; else it stays for later. Those still in use come first. Where the store cannot write it
    // tells so, and nothing more is written: false then. A step that cannot be read or sorted
    // again, or has no room, is let go.
    bool writeOne(Again again, const GoOn& goOn);

 private:
    struct Unwritten {
        std::size_t step;
        StepOrigin origin;
        OriginStamp stamp;
        std::weak_ptr<const SortedStep> sorted;
        std::uint64_t bytes;  // of its list in memory, which is more than it takes on disk
    };
    static bool isInUse(const Unwritten& one) { return !one.sorted.expired(); }
    // `sorted`: null where nobody has it any more.
    StepStore::Wrote write(const Unwritten& one, const SortedStep* sorted, const GoOn& goOn);
    // `changed`: as StepStore::find().
    std::shared_ptr<const SortedStep> find(const StepOrigin& origin, std::size_t step,
                                           bool* changed = nullptr);
    Kept keptAs(StepStore::Wrote wrote, const StepOrigin& origin) const;
    SortedStep sorted(Field field) const;
    // Of files that have not changed, before or meanwhile.
    Field read(std::size_t step);
    void tellSortedAnew(const StepOrigin& origin);

    const std::unique_ptr<Reader> reader_;
    const std::shared_ptr<const std::vector<std::filesystem::path>> files_;  // the reader's
    OpenedFiles opened_;
    const std::size_t variable_;
    const RangeSet kept_, asked_;
    const Holds holds_;
    StepStores stores_;
    bool toldChanged_ = false;
    std::deque<Unwritten> unwritten_;  // the first built first
};

}  // namespace timeseries
