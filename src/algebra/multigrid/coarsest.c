/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/multigrid/coarsest.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"

#include <math.h>
#include <string.h>

enum { SHIFT_TRIES = 5 };

static const double first_shift =
    1e-10; /* relative to the largest diagonal entry; each next one is a hundred times larger */

extern void dpotrf_(const char *uplo, const int *n, double *a, const int *leading, int *info, size_t length);
extern void dpotrs_(const char *uplo, const int *n, const int *columns, const double *a, const int *leading, double *b,
                    const int *b_leading, int *info, size_t length);

void ost_coarsest_destroy(OstCoarsest **coarsest)
{
    if (!*coarsest)
        return;
    OST_FREE((*coarsest)->count, (*coarsest)->factor);
    ost_mumps_destroy(&(*coarsest)->sparse);
    OST_FREE(*coarsest);
}

/* Has one rank all of them? Few are factored as a dense matrix. */
static OstStatus count_unknowns(OstCoarsest *coarsest)
{
    OstGlobal all = coarsest->owned, most = coarsest->owned;
    OST_TRY(ost_sum_numbers(coarsest->ctx, 1, &all));
    OST_TRY(ost_max_numbers(coarsest->ctx, 1, &most));
    coarsest->dense = all <= OST_COARSEST_LIMIT;
    coarsest->alone = most == all;
    coarsest->order = !coarsest->dense ? 0 : coarsest->alone ? coarsest->owned : (int)all;
    return OST_SUCCESS;
}

/* Where each rank's unknowns are, if several have some. */
static OstStatus number_unknowns(OstCoarsest *coarsest)
{
    OstContext *ctx = coarsest->ctx;
    const size_t ranks = coarsest->alone ? 1 : (size_t)ost_size(ctx);
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &coarsest->count, 2 * ranks)));
    coarsest->start = coarsest->count + ranks;
    if (coarsest->alone)
        return OST_SUCCESS;
    OST_TRY(OST_MPI(ctx, MPI_Allgather(&coarsest->owned, 1, MPI_INT, coarsest->count, 1, MPI_INT, ost_comm(ctx))));
    for (size_t r = 1; r < ranks; r++)
        coarsest->start[r] = coarsest->start[r - 1] + coarsest->count[r - 1];
    return OST_SUCCESS;
}

/* Copies this rank's rows into the dense matrix. `number` is the first global unknown of each block column. */
static void spread_rows(const OstDoubleMatrix *matrix, const OstGlobal *number, OstCoarsest *coarsest)
{
    const int size = matrix->size;
    const size_t order = (size_t)coarsest->order;
    double room[OST_BLOCK];
    for (OstLocal i = 0; i < matrix->rows; i++)
        for (OstLocal k = matrix->row_start[i]; k < matrix->row_start[i + 1]; k++) {
            const double *value = ost_double_matrix_block(matrix, size, i, k, room);
            double *target = coarsest->factor + (size_t)number[i] * order + (size_t)number[matrix->column[k]];
            for (int r = 0; r < size; r++)
                for (int c = 0; c < size; c++)
                    target[(size_t)r * order + (size_t)c] = value[r * size + c];
        }
}

/* Sends all rows to every rank. A row is one MPI type, so that counts fit an int. */
static OstStatus gather_rows(OstCoarsest *coarsest)
{
    OstContext *ctx = coarsest->ctx;
    MPI_Datatype row;
    OST_TRY(OST_MPI(ctx, MPI_Type_contiguous(coarsest->order, MPI_DOUBLE, &row)));
    OstStatus status = OST_MPI(ctx, MPI_Type_commit(&row));
    OST_THEN(OST_MPI(ctx, MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, coarsest->factor, coarsest->count,
                                         coarsest->start, row, ost_comm(ctx))));
    const OstStatus freed = OST_MPI(ctx, MPI_Type_free(&row));
    return status != OST_SUCCESS ? status : freed;
}

/* Restores the matrix after a failed factorisation. LAPACK, by columns, factors what is the upper triangle of our rows;
 * the lower one still has the entries. */
static void restore(OstCoarsest *coarsest, const double *diagonal, double shift)
{
    const size_t n = (size_t)coarsest->order;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = i + 1; j < n; j++)
            coarsest->factor[i * n + j] = coarsest->factor[j * n + i];
        coarsest->factor[i * n + i] = diagonal[i] + shift;
    }
}

static OstStatus factor(OstCoarsest *coarsest)
{
    const size_t n = (size_t)coarsest->order;
    double *diagonal = coarsest->vector;
    double largest = 0.0, shift = 0.0;
    const int leading = coarsest->order > 0 ? coarsest->order : 1;
    int info = 0;
    for (size_t i = 0; i < n; i++) {
        diagonal[i] = coarsest->factor[i * n + i];
        largest = fmax(largest, diagonal[i]);
    }
    for (int try = 0; try <= SHIFT_TRIES; try++) {
        restore(coarsest, diagonal, shift);
        dpotrf_("L", &coarsest->order, coarsest->factor, &leading, &info, 1);
        if (info == 0)
            return OST_SUCCESS;
        shift = try == 0 ? first_shift * largest : 100.0 * shift;
    }
    return OST_RAISE(
        coarsest->ctx, OST_NOT_CONVERGED,
        "pivot %d of %d on the coarsest level is not positive: the stiffness is indefinite, or rounding makes it so",
        info, coarsest->order);
}

/* Of this rank. */
static int first_unknown(const OstCoarsest *coarsest)
{
    return coarsest->start[coarsest->alone ? 0 : ost_rank(coarsest->ctx)];
}

static OstStatus factor_dense(const OstDoubleMatrix *matrix, OstCoarsest *coarsest)
{
    OstContext *ctx = coarsest->ctx;
    const size_t order = (size_t)coarsest->order;
    OstGlobal *number = NULL;
    OstStatus status;
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &coarsest->factor, order * (order + OST_COLUMNS))));
    coarsest->vector = coarsest->factor + order * order;
    OST_TRY_DONE(ost_double_matrix_numbers(matrix, first_unknown(coarsest), &number));
    spread_rows(matrix, number, coarsest);
    if (!coarsest->alone)
        OST_TRY_DONE(ost_agree(ctx, gather_rows(coarsest)));
    OST_TRY_DONE(ost_agree(ctx, factor(coarsest)));
done:
    OST_FREE(number);
    return status;
}

OstStatus ost_coarsest_create(const OstDoubleMatrix *matrix, double memory, OstCoarsest **coarsest)
{
    OstContext *ctx = matrix->ctx;
    OstCoarsest *made = NULL;
    *coarsest = NULL;
    OstStatus status;
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &made, 1)));
    made->ctx = ctx;
    made->owned = matrix->size * matrix->rows;
    OST_TRY_DONE(count_unknowns(made));
    if (made->dense)
        OST_TRY_DONE(number_unknowns(made));
    if (made->dense)
        OST_TRY_DONE(factor_dense(matrix, made));
    else
        OST_TRY_DONE(ost_mumps_create(matrix, memory, &made->sparse));
done:
    if (status != OST_SUCCESS)
        ost_coarsest_destroy(&made);
    *coarsest = made;
    return status;
}

/* All unknowns of a vector. */
static OstStatus gather_vector(const OstCoarsest *coarsest, const double *b, double *all)
{
    OstContext *ctx = coarsest->ctx;
    if (coarsest->alone) {
        memcpy(all, b, (size_t)coarsest->owned * sizeof *b);
        return OST_SUCCESS;
    }
    OST_TRY(OST_MPI(ctx, MPI_Allgatherv(b, coarsest->owned, MPI_DOUBLE, all, coarsest->count, coarsest->start,
                                        MPI_DOUBLE, ost_comm(ctx))));
    ost_ledger_gathered(ctx, (double)coarsest->order * sizeof *b);
    return OST_SUCCESS;
}

OstStatus ost_coarsest_solve(OstCoarsest *coarsest, int columns, const double *b, double *x)
{
    OstContext *ctx = coarsest->ctx;
    const size_t order = (size_t)coarsest->order, owned = (size_t)coarsest->owned;
    int info = 0;
    for (size_t k = 0; k < (size_t)columns && coarsest->sparse; k++)
        OST_TRY(ost_mumps_solve(coarsest->sparse, b + k * owned, x + k * owned));
    if (coarsest->sparse || order == 0)
        return OST_SUCCESS;
    for (size_t k = 0; k < (size_t)columns; k++)
        OST_TRY(gather_vector(coarsest, b + k * owned, coarsest->vector + k * order));
    const double entries = columns * (double)coarsest->order * (double)coarsest->order;
    ost_ledger_multiplied(ctx, coarsest->alone ? entries : entries / ost_size(ctx));
    dpotrs_("L", &coarsest->order, &columns, coarsest->factor, &coarsest->order, coarsest->vector, &coarsest->order,
            &info, 1);
    if (info != 0)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "LAPACK's dpotrs returned %d", info);
    for (size_t k = 0; k < (size_t)columns; k++)
        memcpy(x + k * owned, coarsest->vector + k * order + first_unknown(coarsest), owned * sizeof *x);
    return OST_SUCCESS;
}
