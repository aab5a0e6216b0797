/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/direct/mumps.h"

#include "algebra/krylov/energy_error.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/free_memory.h"

#include <dmumps_c.h>
#include <float.h>
#include <limits.h>
#include <stdio.h>

/* The MUMPS manual numbers controls and results from 1. */
#define ICNTL(k) icntl[(k)-1]
#define INFOG(k) infog[(k)-1]
#define INFO(k) info[(k)-1]
#define RINFOG(k) rinfog[(k)-1]

enum {
    JOB_START = -1,
    JOB_END = -2,
    JOB_ANALYSE = 1,
    JOB_FACTOR = 2,
    JOB_SOLVE = 3,
    POSITIVE_DEFINITE = 1, /* SYM */
    SYMMETRIC = 2,
    SPARE_PERCENT = 30,        /* ICNTL(14): workspace beyond the estimate; doubled if it is not enough, */
    MOST_SPARE_PERCENT = 2000, /* up to this */
    ERROR_WORKSPACE = -9,      /* INFOG(1) */
    ERROR_INTEGER_WORKSPACE = -8,
    ERROR_SINGULAR = -10,
    ERROR_ALLOCATION = -13,
    ERROR_INDEFINITE_ROOT = -40
};

static const double mebibyte = 1048576.0;

/* Shifts of a diagonal of order 1: the first, the factor to the next, and the largest. Rounding never needed more than
 * 6e-14. */
static const double least_shift = 4.0 * DBL_EPSILON, next_shift = 8.0, rounding_shift = 5e-13;

struct OstMumps {
    OstContext *ctx;
    DMUMPS_STRUC_C id;
    int started;
    int unknowns;         /* of this rank */
    OstGlobal first, all; /* global number of its first one; number over all ranks */
    double memory;        /* bytes it may take over all ranks; 0: what is free */
    double shift;         /* added to the diagonal */
    double most_shift;    /* the largest that may be */
    int *counts;          /* rank 0: unknowns of each rank, and where they start */
    int *starts;
    double *vector; /* rank 0: the whole right-hand side, then the solution */
};

static void call(OstMumps *mumps, int job)
{
    mumps->id.job = job;
    dmumps_c(&mumps->id);
}

void ost_mumps_destroy(OstMumps **mumps)
{
    if (!*mumps)
        return;
    if ((*mumps)->started)
        call(*mumps, JOB_END);
    OST_FREE((*mumps)->counts, (*mumps)->vector);
    OST_FREE(*mumps);
}

static OstStatus raise_singular(OstContext *ctx, const char *finding)
{
    return OST_RAISE(ctx, OST_NOT_CONVERGED,
                     "rounded to double precision, %s: rounding leaves the displacement less than one digit; %s",
                     finding, ost_rounding_remedy);
}

/* INFOG is the same on all ranks, so all return the same. */
static OstStatus check(OstMumps *mumps, const char *phase)
{
    OstContext *ctx = mumps->ctx;
    const int code = mumps->id.INFOG(1);
    if (code >= 0)
        return OST_SUCCESS;
    switch (code) {
    case ERROR_SINGULAR:
        return raise_singular(ctx, "the stiffness is singular");
    case ERROR_INDEFINITE_ROOT:
        return raise_singular(ctx, "the stiffness is not positive definite");
    case ERROR_WORKSPACE:
    case ERROR_INTEGER_WORKSPACE:
    case ERROR_ALLOCATION:
        return OST_RAISE(ctx, OST_OUT_OF_MEMORY,
                         "MUMPS ran out of memory in its %s (codes %d, %d); use more machines, or an iterative method",
                         phase, code, mumps->id.INFOG(2));
    default:
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "MUMPS failed in its %s with codes %d, %d", phase, code,
                         mumps->id.INFOG(2));
    }
}

static OstStatus start(OstMumps *mumps, int symmetry)
{
    DMUMPS_STRUC_C *id = &mumps->id;
    id->par = 1;
    id->sym = symmetry;
    id->comm_fortran = (MUMPS_INT)MPI_Comm_c2f(ost_comm(mumps->ctx));
    call(mumps, JOB_START);
    mumps->started = id->INFOG(1) >= 0;
    OST_TRY(check(mumps, "start"));
    id->ICNTL(1) = -1; /* no messages */
    id->ICNTL(2) = -1;
    id->ICNTL(3) = -1;
    id->ICNTL(4) = 0;
    id->ICNTL(18) = 3; /* each rank passes its own entries */
    if (symmetry == SYMMETRIC)
        id->ICNTL(13) = 1; /* ScaLAPACK would not count the negative pivots of the last front */
    return OST_SUCCESS;
}

static OstStatus number_unknowns(OstMumps *mumps, OstGlobal mine)
{
    OstContext *ctx = mumps->ctx;
    OstGlobal end = 0;
    mumps->unknowns = (int)mine;
    OST_TRY(OST_MPI(ctx, MPI_Scan(&mine, &end, 1, MPI_INT64_T, MPI_SUM, ost_comm(ctx))));
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(&mine, &mumps->all, 1, MPI_INT64_T, MPI_SUM, ost_comm(ctx))));
    mumps->first = end - mine;
    if (mumps->all > INT_MAX)
        return OST_RAISE(ctx, OST_LIMIT_EXCEEDED,
                         "%lld unknowns are more than MUMPS can number (2^31 - 1); use an iterative method",
                         (long long)mumps->all);
    return OST_SUCCESS;
}

/* This rank's entries on and above the diagonal, by global numbers from 1; `number` is each column's first unknown. */
static void fill_entries(const OstDoubleMatrix *matrix, const OstGlobal *number, DMUMPS_STRUC_C *id)
{
    const int size = matrix->size;
    MUMPS_INT8 n = 0;
    double room[OST_BLOCK];
    for (OstLocal i = 0; i < matrix->rows; i++)
        for (OstLocal k = matrix->row_start[i]; k < matrix->row_start[i + 1]; k++) {
            const OstLocal j = matrix->column[k];
            if (number[j] < number[i])
                continue;
            const double *block = ost_double_matrix_block(matrix, size, i, k, room);
            for (int c = 0; c < size; c++)
                for (int d = i == j ? c : 0; d < size; d++, n++) {
                    id->irn_loc[n] = (MUMPS_INT)(number[i] + c + 1);
                    id->jcn_loc[n] = (MUMPS_INT)(number[j] + d + 1);
                    id->a_loc[n] = block[size * c + d];
                }
        }
    id->nnz_loc = n;
}

static OstStatus allocate_entries(const OstDoubleMatrix *matrix, DMUMPS_STRUC_C *id)
{
    const size_t most = (size_t)(matrix->size * matrix->size) * (size_t)matrix->row_start[matrix->rows];
    OST_TRY(OST_NEW(matrix->ctx, &id->irn_loc, most));
    OST_TRY(OST_NEW(matrix->ctx, &id->jcn_loc, most));
    return OST_NEW(matrix->ctx, &id->a_loc, most);
}

/* Compares the analysis's forecast for each rank with the memory allowed or free. */
static OstStatus check_memory(OstMumps *mumps)
{
    OstContext *ctx = mumps->ctx;
    const double foreseen = 1e6 * mumps->id.INFOG(17);
    OstMemoryDemand demand;
    OST_TRY(ost_memory_demand(ctx, 1e6 * mumps->id.INFO(15), &demand));
    const double allowed = mumps->memory > 0.0 ? mumps->memory : demand.free;
    const double wanted = mumps->memory > 0.0 ? foreseen : demand.wanted;
    if (wanted <= allowed)
        return OST_SUCCESS;
    const int would_fit = mumps->memory > 0.0 && demand.wanted <= demand.free;
    return OST_RAISE(ctx, OST_OUT_OF_MEMORY, "factoring %lld unknowns would take %.0f MiB, but %s %.3g MiB; %s",
                     (long long)mumps->all, wanted / mebibyte,
                     mumps->memory > 0.0 ? "solver.factor_memory allows" : "there are", allowed / mebibyte,
                     would_fit ? "raise it or leave it out" : "use more or larger machines, or an iterative method");
}

static OstStatus factor_entries(OstMumps *mumps)
{
    DMUMPS_STRUC_C *id = &mumps->id;
    int spare = SPARE_PERCENT;
    do {
        id->ICNTL(14) = spare;
        call(mumps, JOB_FACTOR);
        spare *= 2;
    } while ((id->INFOG(1) == ERROR_WORKSPACE || id->INFOG(1) == ERROR_INTEGER_WORKSPACE) &&
             spare <= MOST_SPARE_PERCENT);
    OST_TRY(check(mumps, "factorisation"));
    if (id->sym == POSITIVE_DEFINITE && id->INFOG(12) > 0) {
        char finding[96];
        snprintf(finding, sizeof finding, "the stiffness is not positive definite (%d negative pivots)", id->INFOG(12));
        return raise_singular(mumps->ctx, finding);
    }
    return OST_SUCCESS;
}

static void shift_diagonal(OstMumps *mumps, double shift)
{
    DMUMPS_STRUC_C *id = &mumps->id;
    for (MUMPS_INT8 n = 0; n < id->nnz_loc; n++)
        if (id->irn_loc[n] == id->jcn_loc[n])
            id->a_loc[n] += shift - mumps->shift;
    mumps->shift = shift;
}

static OstStatus analyse(OstMumps *mumps)
{
    mumps->id.ICNTL(14) = SPARE_PERCENT;
    call(mumps, JOB_ANALYSE);
    return check(mumps, "analysis");
}

static OstStatus factor(OstMumps *mumps)
{
    OST_TRY(analyse(mumps));
    OST_TRY(check_memory(mumps));
    OstStatus status = factor_entries(mumps);
    for (double shift = least_shift; status == OST_NOT_CONVERGED && shift <= mumps->most_shift; shift *= next_shift) {
        shift_diagonal(mumps, shift);
        status = factor_entries(mumps);
    }
    return status;
}

static OstStatus foretell(OstMumps *mumps, OstMumpsForecast *forecast)
{
    OST_TRY(analyse(mumps));
    *forecast = (OstMumpsForecast){1e6 * mumps->id.INFOG(17), mumps->id.RINFOG(1)};
    return check_memory(mumps);
}

static OstStatus take_matrix(OstMumps *mumps, const OstDoubleMatrix *matrix)
{
    OstGlobal *number = NULL;
    OST_TRY(ost_agree(mumps->ctx, allocate_entries(matrix, &mumps->id)));
    const OstStatus status = ost_double_matrix_numbers(matrix, mumps->first, &number);
    if (status == OST_SUCCESS)
        fill_entries(matrix, number, &mumps->id);
    OST_FREE(number);
    return status;
}

static void take_entries(OstMumps *mumps, OstMumpsEntries *entries)
{
    mumps->id.irn_loc = entries->row;
    mumps->id.jcn_loc = entries->column;
    mumps->id.a_loc = entries->value;
    mumps->id.nnz_loc = (MUMPS_INT8)entries->count;
    *entries = (OstMumpsEntries){0};
}

static void free_entries(OstMumps *mumps)
{
    OST_FREE(mumps->id.irn_loc, mumps->id.jcn_loc, mumps->id.a_loc);
}

/* Where each rank's unknowns are in the vectors on rank 0. */
static OstStatus prepare_vectors(OstMumps *mumps)
{
    OstContext *ctx = mumps->ctx;
    const int size = ost_rank(ctx) == 0 ? ost_size(ctx) : 0;
    OstStatus status = OST_NEW(ctx, &mumps->counts, 2 * size);
    OST_THEN(OST_NEW(ctx, &mumps->vector, size > 0 ? mumps->all : 0));
    OST_TRY(ost_agree(ctx, status));
    mumps->starts = mumps->counts + size;
    OST_TRY(OST_MPI(ctx, MPI_Gather(&mumps->unknowns, 1, MPI_INT, mumps->counts, 1, MPI_INT, 0, ost_comm(ctx))));
    for (int r = 1; r < size; r++)
        mumps->starts[r] = mumps->starts[r - 1] + mumps->counts[r - 1];
    return OST_SUCCESS;
}

/* Factors one or the other, or, unless `forecast` is NULL, only analyses. */
static OstStatus create(OstContext *ctx, OstGlobal unknowns, const OstDoubleMatrix *matrix, OstMumpsEntries *entries,
                        double memory, double most_shift, OstMumpsForecast *forecast, OstMumps **mumps)
{
    OstMumps *made = NULL;
    *mumps = NULL;
    OstStatus status;
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &made, 1)));
    made->ctx = ctx;
    made->memory = memory;
    made->most_shift = most_shift;
    OST_TRY_DONE(number_unknowns(made, unknowns));
    OST_TRY_DONE(prepare_vectors(made));
    OST_TRY_DONE(start(made, entries ? SYMMETRIC : POSITIVE_DEFINITE));
    if (entries)
        take_entries(made, entries);
    else
        OST_TRY_DONE(take_matrix(made, matrix));
    made->id.n = (MUMPS_INT)made->all;
    OST_TRY_DONE(forecast ? foretell(made, forecast) : factor(made));
done:
    if (made)
        free_entries(made);
    if (status != OST_SUCCESS)
        ost_mumps_destroy(&made);
    *mumps = made;
    return status;
}

OstStatus ost_mumps_create(const OstDoubleMatrix *matrix, double memory, OstMumps **mumps)
{
    return create(matrix->ctx, (OstGlobal)matrix->size * matrix->rows, matrix, NULL, memory, 0.0, NULL, mumps);
}

OstStatus ost_mumps_create_symmetric(OstContext *ctx, OstLocal unknowns, OstMumpsEntries *entries, double memory,
                                     OstGlobal *negative, OstMumps **mumps)
{
    OST_TRY(create(ctx, unknowns, NULL, entries, memory, 0.0, NULL, mumps));
    *negative = (*mumps)->id.INFOG(12);
    return OST_SUCCESS;
}

OstStatus ost_mumps_create_of_rows(const OstBlockMatrix *matrix, const OstScaling *scaling, double memory,
                                   double *shift, OstMumps **mumps)
{
    OstDoubleMatrix *view = NULL;
    *mumps = NULL;
    OST_TRY(ost_agree(matrix->ctx, ost_double_matrix_borrow(matrix, scaling, &view)));
    const OstStatus status =
        create(matrix->ctx, 3 * (OstGlobal)matrix->rows, view, NULL, memory, shift ? rounding_shift : 0.0, NULL, mumps);
    if (status == OST_SUCCESS && shift)
        *shift = (*mumps)->shift;
    ost_double_matrix_destroy(&view);
    return status;
}

OstStatus ost_mumps_foretell(const OstBlockMatrix *matrix, double memory, OstMumpsForecast *forecast)
{
    OstDoubleMatrix *view = NULL;
    OstMumps *mumps = NULL;
    *forecast = (OstMumpsForecast){0.0, 0.0};
    OST_TRY(ost_agree(matrix->ctx, ost_double_matrix_borrow(matrix, NULL, &view)));
    const OstStatus status =
        create(matrix->ctx, 3 * (OstGlobal)matrix->rows, view, NULL, memory, 0.0, forecast, &mumps);
    ost_mumps_destroy(&mumps);
    ost_double_matrix_destroy(&view);
    return status;
}

OstStatus ost_mumps_solve(void *data, const double *b, double *x)
{
    OstMumps *mumps = data;
    OstContext *ctx = mumps->ctx;
    OST_TRY(OST_MPI(ctx, MPI_Gatherv(b, mumps->unknowns, MPI_DOUBLE, mumps->vector, mumps->counts, mumps->starts,
                                     MPI_DOUBLE, 0, ost_comm(ctx))));
    ost_ledger_gathered(ctx, ost_rank(ctx) == 0 ? (double)mumps->all * sizeof *b : 0.0);
    mumps->id.rhs = mumps->vector;
    call(mumps, JOB_SOLVE);
    OST_TRY(check(mumps, "solve"));
    return OST_MPI(ctx, MPI_Scatterv(mumps->vector, mumps->counts, mumps->starts, MPI_DOUBLE, x, mumps->unknowns,
                                     MPI_DOUBLE, 0, ost_comm(ctx)));
}
