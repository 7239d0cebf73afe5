// `isochron index`: steps sorted ahead, into files that are opened at once.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <new>

#include "app/command/commands.h"
#include "app/command/index_work.h"
#include "app/files/dataset.h"
#include "app/say.h"
#include "timeseries/together.h"

namespace app {
namespace {

namespace fs = std::filesystem;
using timeseries::FileError;

int check(const IndexOptions& options) {
    int code = 0;
    for (const fs::path& file : options.files) {
        try {
            auto bytes = timeseries::openBytes(file);
            if (!bytes)
                throw timeseries::StepFileError(fmt::format("{}: no such file", file.string()));
            const timeseries::StepFile step(std::move(bytes));
            step.check();
            say("{}: {} points, all as they were written\n", file.string(),
                withCommas(step.statistics().points));
        } catch (const timeseries::StepFileError& error) {
            sayTo(stderr, "isochron: {}\n", error.what());
            code = 1;
        } catch (const std::bad_alloc&) {
            sayTo(stderr, "isochron: {}: there is not enough memory to read it\n", file.string());
            code = 1;
        }
    }
    return code;
}

// Set by Open MPI, by MPICH and its kin, and by PMIx, which Slurm's srun speaks.
bool startedByMpi() {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"})
        if (std::getenv(name)) return true;
    return false;
}

}  // namespace

int index(const IndexOptions& options) {
    if (options.check) return check(options);
    if (startedByMpi()) {
#ifdef ISOCHRON_MPI
        return indexByRanks(options);
#else
        throw FileError(
            "this program was built without MPI: start it alone, or build it anew where "
            "libopenmpi-dev is installed");
#endif
    }
    const auto store = indexStoreOf(options);
    const std::vector<IndexTask> tasks = indexTasksOf(options);
    const auto jobs = static_cast<unsigned>(std::min<std::size_t>(options.jobs, tasks.size()));
    IndexedSteps done;
    {
        IndexProgress progress(tasks.size());
        IndexWork all(options, store, tasks, tasks, progress);
        if (jobs > 1)  // each sorts on its share of the cores
            timeseries::threadLimit = std::max(1u, timeseries::sharingThreads() / jobs);
        timeseries::sharing(jobs, [&](unsigned) { all.work(); });
        done = all.done();
    }
    return tellIndexed(done, *store);
}

}  // namespace app
