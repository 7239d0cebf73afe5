// Writes a step together with the other processes that mpirun started, one of which is killed in
// place of one of its calls.
//   shared_killed_writer FILE SEED [RANK CALL]
#include <cstdlib>
#include <optional>
#include <random>

#include "tests/faults/system_calls.h"
#include "tests/ranks/ranks_world.h"
#include "tests/support/random_field.h"
#include "timeseries/together.h"

int main(int argc, char** argv) {
    using namespace timeseries;
    MPI_Init(&argc, &argv);
    if (argc != 3 && argc != 5) MPI_Abort(MPI_COMM_WORLD, 2);
    threadLimit = 1;  // calls are counted without a lock
    const std::filesystem::path path = argv[1];
    constexpr std::array<std::size_t, 3> kSize{128, 64, 64};  // 16 blocks
    std::mt19937_64 random(std::strtoull(argv[2], nullptr, 10));
    const Ranks& ranks = ranks_world::world();
    const Field whole = tests::randomField<float>(random, kSize, 0);
    const GridBox box = ranks_world::cutAtRandom(random, kSize, ranks.size())[ranks.rank()];
    if (argc == 5 && std::strtoul(argv[3], nullptr, 10) == ranks.rank())
        tests::calls.killedAt = std::strtoull(argv[4], nullptr, 10);
    std::optional<WholeFile> file;
    if (ranks.isFirst()) {
        removeUnfinished(path.parent_path(), [](const auto&) { return true; });
        file.emplace(path);
    }
    writeShared(ranks, ranks_world::partOf<float>(whole, box), box,
                {{kSize[0], kSize[1], kSize[2]}, "about"}, file ? &*file : nullptr);
    if (file) file->finish();
    tests::calls.killedAt.reset();
    MPI_Finalize();
}
