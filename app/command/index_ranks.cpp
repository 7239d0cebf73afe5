// `mpirun isochron index`: steps are shared among ranks, and those that are left over, or that no
// rank has memory for, are sorted by all of them together.
#ifdef ISOCHRON_MPI
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <optional>

#include "app/command/index_work.h"
#include "app/files/dataset.h"
#include "app/say.h"
#include "timeseries/grid/with_type.h"
#include "timeseries/machine_memory.h"
#include "timeseries/ranks/shared_step.h"
#include "timeseries/sentence.h"
#include "timeseries/together.h"

namespace app {
namespace {

using Clock = std::chrono::system_clock;
using timeseries::FileError;
using timeseries::OriginStamp;
using timeseries::Ranks;
using timeseries::StepMaker;
using timeseries::StepOrigin;
using timeseries::StepStore;

struct MpiProgram {
    MpiProgram() {
        int provided = 0;
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    }
    MpiProgram(const MpiProgram&) = delete;
    MpiProgram& operator=(const MpiProgram&) = delete;
    ~MpiProgram() { MPI_Finalize(); }
};

// This rank's part of a grid: slices along the last index that has enough of them, else along the
// longest.
timeseries::Slab slabOf(const std::array<std::size_t, 3>& size, const Ranks& ranks) {
    timeseries::Slab slab;
    slab.axis = static_cast<std::size_t>(std::ranges::max_element(size) - size.begin());
    for (std::size_t a = 0; a < 3; ++a)
        if (size[a] >= ranks.size()) slab.axis = a;
    const std::uint64_t slices = size[slab.axis];
    slab.first = slices * ranks.rank() / ranks.size();
    slab.count = slices * (ranks.rank() + 1) / ranks.size() - slab.first;
    return slab;
}

// Sorts steps together with all other ranks.
class TogetherWork {
 public:
    TogetherWork(const Ranks& ranks, const IndexOptions& options, std::shared_ptr<StepStore> store)
        : ranks_(ranks), options_(options), store_(std::move(store)) {}

    // Collective. Throws RanksError.
    StepMaker::Kept keep(const IndexTask& task) {
        std::optional<StepOrigin> origin;
        auto without = StepMaker::Kept::Unknown;
        ranks_.agreed([&] {
            if (!dataset_ || dataset_->variable.name != task.variable)
                dataset_ = openDataset(options_.files, task.variable);
            if (dataset_->variable.grid->count() > std::uint64_t{1} << 32)
                throw FileError(
                    fmt::format("{}: variable '{}': expected at most the 2^32 points that one list "
                                "holds",
                                dataset_->name, task.variable));
            origin = originOf(*dataset_->reader, dataset_->variableIndex, task.step);
            if (!origin)
                without = StepMaker::keptWithoutOrigin(*dataset_->reader, dataset_->variableIndex);
        });
        if (ranks_.sum(origin.has_value()) < ranks_.size()) return without;
        std::optional<OriginStamp> stamp;
        bool before = false;
        ranks_.agreed([&] {
            if (!ranks_.isFirst()) return;
            expectThere(*origin);
            stamp = store_->stampOf(*origin);
            before = store_->find(*origin) != nullptr;
        });
        if (ranks_.sum(before) > 0) return StepMaker::Kept::Before;
        if (ranks_.sum(stamp.has_value()) == 0) return StepMaker::Kept::Changed;
        if (isFull_) return StepMaker::Kept::NoRoom;
        const auto wrote = write(task, *origin, stamp, firstOpening());
        if (ranks_.sum(wrote == StepStore::Wrote::All) > 0) return StepMaker::Kept::Written;
        isFull_ = ranks_.sum(wrote == StepStore::Wrote::NoRoom) > 0;
        if (isFull_) return StepMaker::Kept::NoRoom;
        ranks_.agreed([&] { expectThere(*origin); });
        return StepMaker::Kept::Changed;
    }

 private:
    // Each rank has opened the files for itself: what changed since the first of them did is not
    // kept.
    Clock::time_point firstOpening() const {
        const std::int64_t mine = dataset_->reader->openedAt.time_since_epoch().count();
        const std::vector<std::int64_t> all = ranks_.gather<std::int64_t>({&mine, 1});
        return Clock::time_point(Clock::duration(std::ranges::min(all)));
    }

    // The first rank has the file, if its store wants one; the others write where it tells them.
    StepStore::Wrote write(const IndexTask& task, const StepOrigin& origin,
                           const std::optional<OriginStamp>& stamp, Clock::time_point opened) {
        auto wrote = StepStore::Wrote::Nothing;
        ranks_.agreed([&] {
            if (!ranks_.isFirst()) {
                if (ranks_.fromFirst("") == "go on") writePart(task, "", nullptr);
                return;
            }
            bool told = false;
            std::exception_ptr failure;
            try {
                wrote = store_->write(origin, *stamp, opened, [&](timeseries::WholeFile& file) {
                    told = true;
                    ranks_.fromFirst("go on");
                    writePart(task, stamp->text, &file);
                    return true;
                });
            } catch (...) {
                failure = std::current_exception();
            }
            if (!told) ranks_.fromFirst("no");
            if (failure) std::rethrow_exception(failure);
        });
        return wrote;
    }

    void writePart(const IndexTask& task, const std::string& about, timeseries::WholeFile* file) {
        const auto size = dataset_->variable.grid->size();
        const timeseries::Slab slab = slabOf(size, ranks_);
        timeseries::Field field;
        ranks_.agreed([&] {
            if (slab.count > 0)
                field = dataset_->reader->slab(dataset_->variableIndex, task.step, slab);
            else
                field.values = timeseries::withType(dataset_->variable.type, []<typename T>(T) {
                    return timeseries::Values(std::vector<T>());
                });
        });
        timeseries::GridBox box;
        timeseries::SharedStep step;
        for (std::size_t a = 0; a < 3; ++a) {
            step.size[a] = static_cast<std::uint32_t>(size[a]);
            box.size[a] = size[a];
        }
        box.first[slab.axis] = slab.first;
        box.size[slab.axis] = slab.count;
        step.about = about;
        writeShared(ranks_, std::move(field), box, step, file);
    }

    const Ranks& ranks_;
    const IndexOptions& options_;
    const std::shared_ptr<StepStore> store_;
    std::optional<OpenDataset> dataset_;
    bool isFull_ = false;  // the store, on all ranks
};

// What failed on any rank, on each of them.
void addErrorsOfAll(const Ranks& ranks, IndexedSteps& done) {
    std::string mine;  // of each "steps sentence" and a 0
    for (const auto& [why, steps] : done.errors) mine += fmt::format("{} {}", steps, why) + '\0';
    const std::vector<char> all = ranks.gather<char>(mine);
    done.failed = 0;
    done.errors.clear();
    for (auto from = all.begin(); from != all.end();) {
        const auto end = std::find(from, all.end(), '\0');
        const std::string error(from, end);
        const std::size_t space = error.find(' ');
        done.fail(error.substr(space + 1), std::stoull(error.substr(0, space)));
        from = end + 1;
    }
}

// By each rank for itself those that it has memory for, as many for all of them; the rest together.
IndexedSteps indexAll(const Ranks& ranks, const IndexOptions& options,
                      const std::shared_ptr<StepStore>& store, std::vector<IndexTask> tasks) {
    std::vector<IndexTask> alone, shared;
    const unsigned beside = ranks.onThisMachine();
    std::size_t rounds = tasks.size() / ranks.size();
    ranks.agreed([&] {
        std::string last;
        for (const IndexTask& task : tasks) {
            if (task.variable == last) continue;
            last = task.variable;
            if (!fitsEach(openDataset(options.files, last).variable, timeseries::machineMemory(),
                          beside))
                rounds = 0;
        }
    });
    if (ranks.sum(rounds == 0) > 0) rounds = 0;  // machines may differ
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        if (i >= rounds * ranks.size())
            shared.push_back(tasks[i]);
        else if (i % ranks.size() == ranks.rank())
            alone.push_back(tasks[i]);
    }
    IndexedSteps done;
    const auto shown = ranks.isFirst() ? IndexProgress::Shown::Yes : IndexProgress::Shown::No;
    ranks.agreed([&] {
        IndexProgress progress(rounds * ranks.size(), shown, ranks.size());
        IndexWork own(options, store, std::move(alone), tasks, progress);
        own.work();
        done = own.done();
    });
    TogetherWork together(ranks, options, store);
    IndexProgress progress(shared.size(), shown);
    for (const IndexTask& task : shared) {
        try {
            const StepMaker::Kept kept = together.keep(task);
            if (ranks.isFirst()) ++done.of(kept);
            progress.finish(0, isQuick(kept));
        } catch (const timeseries::RanksError& error) {  // all have it
            if (ranks.isFirst()) done.fail(error.what());
            progress.finish(0, isQuick({}));
        }
    }
    std::array<std::uint64_t, StepMaker::kKept> sums{};
    std::ranges::copy(done.kept, sums.begin());
    ranks.sum(sums);
    std::copy_n(sums.begin(), StepMaker::kKept, done.kept.begin());
    addErrorsOfAll(ranks, done);
    const std::uint64_t refused = store->room().refused();
    done.refusedBytes = std::ranges::max(ranks.gather<std::uint64_t>({&refused, 1}));
    return done;
}

int indexOf(const Ranks& ranks, const IndexOptions& options) {
    if (timeseries::threadLimit == 0)
        timeseries::threadLimit =
            std::max(1u, timeseries::sharingThreads() / ranks.onThisMachine());
    std::shared_ptr<StepStore> store;
    std::vector<IndexTask> tasks;
    ranks.agreed([&] {
        if (options.jobs > 1)
            throw FileError(fmt::format(
                "--jobs {}: expected none beside mpirun, of whose processes each sorts a step",
                options.jobs));
        store = indexStoreOf(options);
        tasks = indexTasksOf(options);
    });
    const IndexedSteps done = indexAll(ranks, options, store, std::move(tasks));
    if (ranks.isFirst()) return tellIndexed(done, *store);
    return exitCodeOf(done);
}

}  // namespace

int indexByRanks(const IndexOptions& options) {
    const MpiProgram program;
    const Ranks ranks(MPI_COMM_WORLD);
    try {
        return indexOf(ranks, options);
    } catch (const timeseries::RanksError& error) {  // all have it, one tells it
        if (ranks.isFirst()) sayTo(stderr, "isochron: {}\n", error.what());
        return 1;
    } catch (const std::exception& error) {  // the others would wait for ever
        sayTo(stderr, "isochron: {}\n", timeseries::sentenceOf(error));
        MPI_Abort(MPI_COMM_WORLD, 1);
        return 1;
    }
}

}  // namespace app
#endif
