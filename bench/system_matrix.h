/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_BENCH_SYSTEM_MATRIX_H
#define ORTHOSTAT_BENCH_SYSTEM_MATRIX_H

#include "algebra/matrix/block_matrix.h"
#include "case/case_data.h"
#include "system_file.h"

/* Collective. Reads a case, assembles its system as `orthostat solve` does, and writes each rank's rows into FOLDER. */
OstStatus ost_bench_write_system(OstContext *ctx, const char *case_path, const char *folder);

/* Collective. The matrix of a system that was read; its arrays are copies. */
OstStatus ost_bench_matrix(OstContext *ctx, const SystemFile *system, OstBlockMatrix **matrix);

#endif
