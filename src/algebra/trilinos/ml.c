/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/trilinos/ml.h"

#include "core/error.h"
#include "core/memory.h"

#include <limits.h>
#include <string.h>

OstStatus ost_ml_create(OstContext *ctx, int levels, ML **ml)
{
    *ml = NULL;
    ML_Set_PrintLevel(0);
    if (ML_Create(ml, levels) != 0 || !*ml)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "ML_Create failed for %d levels", levels);
    ML_Comm_Set_UsrComm((*ml)->comm, ost_comm(ctx));
    ML_Comm_Set_Mypid((*ml)->comm, ost_rank(ctx));
    ML_Comm_Set_Nprocs((*ml)->comm, ost_size(ctx));
    return OST_SUCCESS;
}

void ost_ml_matrix_destroy(OstMlMatrix **link)
{
    if (!*link)
        return;
    OST_FREE((*link)->vector);
    OST_FREE(*link);
}

OstStatus ost_ml_check(const OstMlMatrix *link)
{
    return ost_agree(link->matrix->ctx, link->status);
}

static void note_failure(OstMlMatrix *link, OstStatus status)
{
    if (link->status == OST_SUCCESS)
        link->status = status;
}

/* ML's row callback: scalar rows `rows[0..count)`; returns 0 when `space` is too small, and is called again. */
static int get_rows(ML_Operator *operator, int count, int *rows, int space, int *columns, double *values, int *lengths)
{
    const OstBlockMatrix *a = ((const OstMlMatrix *)ML_Get_MyGetrowData(operator))->matrix;
    int n = 0;
    for (int i = 0; i < count; i++) {
        const OstLocal row = rows[i] / 3;
        const size_t line = 3 * (size_t)(rows[i] % 3);
        const OstLocal start = a->row_start[row];
        const OstLocal end = a->row_start[row + 1];
        lengths[i] = 3 * (end - start);
        if (n + lengths[i] > space)
            return 0;
        for (OstLocal k = start; k < end; k++)
            for (int c = 0; c < 3; c++) {
                columns[n] = 3 * a->column[k] + c;
                values[n++] = a->value[9 * (size_t)k + line + (size_t)c];
            }
    }
    return 1;
}

static int multiply(ML_Operator *operator, int in_length, double *x, int out_length, double *y)
{
    OstMlMatrix *link = ML_Get_MyMatvecData(operator);
    (void)out_length;
    if (in_length > 0) /* ML passes NULL on a rank that has no rows */
        memcpy(link->vector, x, (size_t)in_length * sizeof *x);
    note_failure(link, ost_block_matrix_apply(link->matrix, link->vector, y));
    return 0;
}

/* ML finds its neighbours by calling this exchange. */
static int exchange(double *x, void *data)
{
    OstMlMatrix *link = data;
    note_failure(link, ost_halo_import(link->matrix->halo, 3 * sizeof *x, x));
    return 1;
}

static OstStatus check_limits(const OstBlockMatrix *a)
{
    const OstGlobal blocks = a->row_start[a->rows];
    if (a->global_rows > INT_MAX / 3)
        return OST_RAISE(a->ctx, OST_LIMIT_EXCEEDED,
                         "%lld unknowns are more than ML can number (2^31 - 1); use a smaller mesh",
                         3LL * (long long)a->global_rows);
    if (blocks > INT_MAX / 9)
        return OST_RAISE(a->ctx, OST_LIMIT_EXCEEDED,
                         "%lld nonzeros on rank %d are more than ML can count (2^31 - 1); use more ranks",
                         9LL * (long long)blocks, ost_rank(a->ctx));
    return OST_SUCCESS;
}

static void set_diagonal(ML *ml, int level, OstMlMatrix *link)
{
    const OstBlockMatrix *a = link->matrix;
    for (OstLocal i = 0; i < a->rows; i++)
        for (int c = 0; c < 3; c++)
            link->vector[3 * i + c] = a->value[9 * (size_t)a->diagonal[i] + 4 * (size_t)c];
    ML_Set_Amatrix_Diag(ml, level, 3 * a->rows, link->vector);
}

OstStatus ost_ml_set_matrix(ML *ml, int level, const OstBlockMatrix *matrix, OstMlMatrix **link)
{
    OstContext *ctx = matrix->ctx;
    OstMlMatrix *made = NULL;
    *link = NULL;
    OstStatus status = check_limits(matrix);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &made, 1);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &made->vector, 3 * (size_t)matrix->columns);
    OST_TRY_DONE(ost_agree(ctx, status));
    made->matrix = matrix;
    const int unknowns = 3 * matrix->rows;
    ML_Init_Amatrix(ml, level, unknowns, unknowns, made);
    ML_Set_Amatrix_Getrow(ml, level, get_rows, exchange, 3 * matrix->columns);
    ML_Set_Amatrix_Matvec(ml, level, multiply);
    set_diagonal(ml, level, made);
    ml->Amat[level].N_nonzeros = 9 * matrix->row_start[matrix->rows];
    ml->Amat[level].num_PDEs = 3;
    OST_TRY_DONE(ost_ml_check(made));
done:
    if (status != OST_SUCCESS)
        ost_ml_matrix_destroy(&made);
    *link = made;
    return status;
}
