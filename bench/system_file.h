/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_BENCH_SYSTEM_FILE_H
#define ORTHOSTAT_BENCH_SYSTEM_FILE_H

#include <stdint.h>

/* A linear system on its way from Orthostat to another solver: one file a rank, in the numbers and byte order of this
 * machine. It leans on nothing of Orthostat, so that a peer's process carries none of it. Every function returns 0, or
 * -1 with the reason in the text `failure` (SYSTEM_FAILURE bytes). */

enum { SYSTEM_PATH = 1000, SYSTEM_FAILURE = SYSTEM_PATH + 200 };

/* One rank's rows of A u = f, by 3×3 blocks. Arrays are of malloc. */
typedef struct SystemFile {
    int32_t rank, ranks;
    int32_t rows, ghosts, blocks; /* block rows, columns of other ranks, blocks of this rank */
    int32_t has_metric;
    int64_t first_row, global_rows; /* rows are numbered over all ranks from 0, contiguously */
    int32_t *row_start;             /* rows + 1 */
    int32_t *column;                /* blocks: own rows first, then ghosts; ascending within a row */
    int64_t *ghost_row;             /* ghosts: global rows, grouped by ascending owner */
    int64_t *label;                 /* rows: the node's number in the mesh file */
    double *value;                  /* blocks × 9, row-major */
    double *right_side;             /* rows × 3 */
    double *coordinates;            /* rows × 3 */
    double *modes;                  /* 6 columns of rows × 3: rigid body modes, three translations, three rotations */
    double *metric;                 /* rows × 6 if has_metric, else nothing: see algebra/solver.h */
} SystemFile;

/* FOLDER/system.RANK. The reader's arrays are the caller's to free by system_file_release. */
int system_file_write(const SystemFile *system, const char *folder, char *failure);
int system_file_read(const char *folder, int rank, SystemFile *system, char *failure);
void system_file_release(SystemFile *system);

/* FOLDER/solution.NAME.RANK: 3 × rows numbers. */
int system_solution_write(const char *folder, const char *name, int rank, int32_t rows, const double *u, char *failure);
int system_solution_read(const char *folder, const char *name, int rank, int32_t rows, double *u, char *failure);

#endif
