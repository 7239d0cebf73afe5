/* Sorted steps from inside a simulation (in situ): every rank hands over its part of the grid, and
 * one file appears that isochron opens at once. Plain C; link with -lisochron_step. */
#ifndef ISOCHRON_STEP_H
#define ISOCHRON_STEP_H

#include <mpi.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif
#ifdef __GNUC__
#define ISOCHRON_API __attribute__((visibility("default")))
#else
#define ISOCHRON_API
#endif

enum isochron_type {
    ISOCHRON_UINT8,
    ISOCHRON_INT8,
    ISOCHRON_UINT16,
    ISOCHRON_INT16,
    ISOCHRON_UINT32,
    ISOCHRON_INT32,
    ISOCHRON_UINT64,
    ISOCHRON_INT64,
    ISOCHRON_FLOAT,
    ISOCHRON_DOUBLE
};

/* An axis of the whole grid. */
struct isochron_axis {
    const char* name;          /* "x"; NULL: x, y or z */
    const char* units;         /* "m"; NULL: none */
    uint64_t points;           /* at least 1 */
    double origin, spacing;    /* where its points are: origin + i spacing; spacing is not 0 */
    const double* coordinates; /* NULL, or where each point is, strictly monotonic, instead */
};

/* All but the last five are the same on all ranks. Set it to zero first: members that are zero mean
 * none of what they name. */
struct isochron_step {
    const char* variable;         /* "temperature"; not NULL */
    const char* units;            /* "K" */
    double time;                  /* files of one series are in order of it */
    const char* time_units;       /* "s", "days since 2000-01-01" */
    enum isochron_type type;      /* of the values, which are kept to the bit */
    struct isochron_axis axis[3]; /* the first runs fastest in memory */
    const void* missing;          /* a value that stands for none; NaN is one by itself */

    uint64_t first[3], size[3]; /* this rank's box of the grid; a size of 0: it has none */
    const void* values;         /* its first point's; those of the box, in the grid's order */
    uint64_t row, slice; /* from a row's first value to the next one's, and a slice's, in values,
                            where ghost cells lie between; 0: nothing does */
};

/* Collective over `comm`. The boxes of all ranks are the whole grid, each point in one of them.
 * Takes about 20 bytes a point (40 of types of 8 bytes) of the box, or of a rank's share of all
 * points where that is more, while it runs, and keeps a few MB a thread.
 *
 * `path` (end it in .isostep) is replaced when all is on the disk: who opens it finds the old file
 * or the new one. What a killed run leaves beside it ends in .unfinished. All ranks must see the
 * same file system.
 *
 * Returns 0, or on all ranks another number; then `message`, unless NULL, has one sentence that
 * says why, cut to `message_bytes` with the final 0, and the file is what it was before. */
ISOCHRON_API int isochron_write_step(MPI_Comm comm, const char* path,
                                     const struct isochron_step* step, char* message,
                                     size_t message_bytes);

#ifdef __cplusplus
}
#endif

#endif
