/* A simulation in miniature that writes sorted steps while it runs: a wave in a box, cut into slabs,
 * with a layer of ghost cells below and above each.
 *
 *   mpicc wave.c -IPREFIX/include -LPREFIX/lib -Wl,-rpath,PREFIX/lib -lisochron_step -lm -o wave
 *   mpirun -n 4 ./wave 64 10 wave
 *   isochron wave_*.isostep
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "isochron_step.h"

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int rank, ranks;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    if (argc != 4) {
        if (rank == 0) fprintf(stderr, "usage: wave POINTS STEPS NAME\n");
        MPI_Finalize();
        return 2;
    }
    const long n = atol(argv[1]), steps = atol(argv[2]);
    const long first = n * rank / ranks, slices = n * (rank + 1) / ranks - first;

    float* values = malloc((size_t)(n * n * (slices + 2)) * sizeof *values);
    if (!values) MPI_Abort(MPI_COMM_WORLD, 1);

    struct isochron_step step = {0};
    step.variable = "height";
    step.units = "m";
    step.time_units = "s";
    step.type = ISOCHRON_FLOAT;
    for (int a = 0; a < 3; ++a) {
        step.axis[a].units = "m";
        step.axis[a].points = (uint64_t)n;
        step.axis[a].spacing = 1.0 / (double)n;
        step.size[a] = (uint64_t)n;
    }
    step.first[2] = (uint64_t)first;
    step.size[2] = (uint64_t)slices;
    step.values = values + n * n; /* behind the ghosts below */

    int failed = 0;
    for (long s = 0; s < steps && !failed; ++s) {
        step.time = 0.1 * (double)s;
        for (long z = -1; z <= slices; ++z)
            for (long y = 0; y < n; ++y)
                for (long x = 0; x < n; ++x) {
                    const double dx = (double)x / (double)n - 0.5, dy = (double)y / (double)n - 0.5,
                                 dz = (double)(first + z) / (double)n - 0.5;
                    const double r = sqrt(dx * dx + dy * dy + dz * dz);
                    values[((z + 1) * n + y) * n + x] =
                        (float)(exp(-4 * r) * cos(20 * r - 2 * step.time));
                }
        char path[4096], why[1024];
        snprintf(path, sizeof path, "%s_%04ld.isostep", argv[3], s);
        failed = isochron_write_step(MPI_COMM_WORLD, path, &step, why, sizeof why);
        if (failed && rank == 0) fprintf(stderr, "wave: %s: %s\n", path, why);
    }
    free(values);
    MPI_Finalize();
    return failed;
}
