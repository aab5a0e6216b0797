/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/saddle/factors.h"

#include "algebra/direct/mumps.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/numbering.h"

#include <limits.h>
#include <math.h>

/* Of the Schur complement, beside C. Soft inclusions in a body 1e9 times stiffer have 1e-9 of it. */
static const double beside_nothing = 1e-13;

struct OstSaddleFactors {
    OstContext *ctx;
    OstMumps *mumps;
    size_t n, m;        /* displacements and pressures of this rank */
    double *scale;      /* n + m */
    double *work;       /* n + m */
    OstGlobal negative; /* eigenvalues, beyond one for each pressure */
};

/* What is needed to list the entries: of all columns, ghosts too. */
typedef struct List {
    const OstDoubleMatrix *matrix;
    const OstCoupling *coupling;
    OstGlobal *u_number, *p_number; /* counted from 1; u's of the first of three */
    double *u_scale, *p_scale;
    OstMumpsEntries entries;
} List;

void ost_saddle_factors_destroy(OstSaddleFactors **factors)
{
    if (!*factors)
        return;
    ost_mumps_destroy(&(*factors)->mumps);
    OST_FREE((*factors)->scale);
    OST_FREE(*factors);
}

static double one_over_root(double diagonal)
{
    return diagonal != 0.0 && isfinite(diagonal) ? 1.0 / sqrt(fabs(diagonal)) : 1.0;
}

static void find_own(List *list, OstGlobal first)
{
    const OstDoubleMatrix *matrix = list->matrix;
    const OstCoupling *coupling = list->coupling;
    double room[OST_BLOCK];
    for (OstLocal i = 0; i < matrix->rows; i++) {
        list->u_number[i] = first + 3 * (OstGlobal)i;
        for (OstLocal k = matrix->row_start[i]; k < matrix->row_start[i + 1]; k++) {
            if (matrix->column[k] != i)
                continue;
            const double *block = ost_double_matrix_block(matrix, 3, i, k, room);
            for (int c = 0; c < 3; c++)
                list->u_scale[3 * (size_t)i + (size_t)c] = one_over_root(block[4 * c]);
        }
    }
    for (OstLocal i = 0; coupling && i < coupling->rows; i++) {
        list->p_number[i] = first + 3 * (OstGlobal)matrix->rows + i;
        list->p_scale[i] = one_over_root(coupling->schur[i] * coupling->diagonal[i]);
    }
}

static OstStatus find_columns(List *list, OstGlobal first)
{
    const OstDoubleMatrix *matrix = list->matrix;
    const OstCoupling *coupling = list->coupling;
    OstContext *ctx = matrix->ctx;
    const OstLocal pressures = coupling ? coupling->columns : 0;
    OstStatus status = OST_NEW(ctx, &list->u_number, matrix->columns);
    OST_THEN(OST_NEW(ctx, &list->u_scale, 3 * (size_t)matrix->columns));
    OST_THEN(OST_NEW(ctx, &list->p_number, pressures));
    OST_THEN(OST_NEW(ctx, &list->p_scale, pressures));
    OST_TRY(ost_agree(ctx, status));
    find_own(list, first);
    OST_TRY(ost_halo_import(matrix->halo, sizeof *list->u_number, list->u_number));
    OST_TRY(ost_halo_import(matrix->halo, 3 * sizeof *list->u_scale, list->u_scale));
    if (!coupling)
        return OST_SUCCESS;
    OST_TRY(ost_halo_import(coupling->halo, sizeof *list->p_number, list->p_number));
    return ost_halo_import(coupling->halo, sizeof *list->p_scale, list->p_scale);
}

static void add(OstMumpsEntries *entries, OstGlobal row, OstGlobal column, double value)
{
    entries->row[entries->count] = (int)row;
    entries->column[entries->count] = (int)column;
    entries->value[entries->count++] = value;
}

static void list_stiffness(List *list)
{
    const OstDoubleMatrix *matrix = list->matrix;
    double room[OST_BLOCK];
    for (OstLocal i = 0; i < matrix->rows; i++)
        for (OstLocal k = matrix->row_start[i]; k < matrix->row_start[i + 1]; k++) {
            const OstLocal j = matrix->column[k];
            const double *si = list->u_scale + 3 * (size_t)i, *sj = list->u_scale + 3 * (size_t)j;
            if (list->u_number[j] < list->u_number[i])
                continue;
            const double *block = ost_double_matrix_block(matrix, 3, i, k, room);
            for (int c = 0; c < 3; c++)
                for (int d = i == j ? c : 0; d < 3; d++)
                    add(&list->entries, list->u_number[i] + c, list->u_number[j] + d, si[c] * sj[d] * block[3 * c + d]);
        }
}

/* Does nothing that can move act on a pressure? Rounding is then all that its equation has. */
static int is_alone(const OstCoupling *coupling, OstLocal i)
{
    for (size_t k = 3 * (size_t)coupling->row_start[i]; k < 3 * (size_t)coupling->row_start[i + 1]; k++)
        if (coupling->value[k] != 0.0)
            return 0;
    return 1;
}

static void list_coupling(List *list)
{
    const OstCoupling *coupling = list->coupling;
    for (OstLocal i = 0; i < coupling->rows; i++) {
        const double s = list->p_scale[i], loose = coupling->looseness[i] + beside_nothing * coupling->schur[i];
        const double own = loose + (is_alone(coupling, i) ? coupling->schur[i] : 0.0);
        for (OstLocal k = coupling->row_start[i]; k < coupling->row_start[i + 1]; k++)
            for (int c = 0; c < 3; c++) {
                const size_t j = 3 * (size_t)coupling->column[k] + (size_t)c;
                add(&list->entries, list->p_number[i], list->u_number[coupling->column[k]] + c,
                    s * list->u_scale[j] * coupling->value[3 * (size_t)k + (size_t)c]);
            }
        for (OstLocal k = coupling->mass_start[i]; k < coupling->mass_start[i + 1]; k++) {
            const OstLocal j = coupling->mass_column[k];
            if (list->p_number[j] >= list->p_number[i])
                add(&list->entries, list->p_number[i], list->p_number[j],
                    -s * list->p_scale[j] * (j == i ? own : loose) * coupling->mass[k]);
        }
    }
}

static OstStatus list_entries(List *list)
{
    const OstCoupling *coupling = list->coupling;
    OstContext *ctx = list->matrix->ctx;
    size_t most = 9 * (size_t)list->matrix->row_start[list->matrix->rows];
    if (coupling)
        most += 3 * (size_t)coupling->row_start[coupling->rows] + (size_t)coupling->mass_start[coupling->rows];
    OstStatus status = OST_NEW(ctx, &list->entries.row, most);
    OST_THEN(OST_NEW(ctx, &list->entries.column, most));
    OST_THEN(OST_NEW(ctx, &list->entries.value, most));
    OST_TRY(ost_agree(ctx, status));
    list_stiffness(list);
    if (coupling)
        list_coupling(list);
    return OST_SUCCESS;
}

static OstStatus keep_scale(const List *list, OstSaddleFactors *factors)
{
    OST_TRY(ost_agree(factors->ctx, OST_NEW(factors->ctx, &factors->scale, 2 * (factors->n + factors->m))));
    factors->work = factors->scale + factors->n + factors->m;
    for (size_t i = 0; i < factors->n; i++)
        factors->scale[i] = list->u_scale[i];
    for (size_t i = 0; i < factors->m; i++)
        factors->scale[factors->n + i] = list->p_scale[i];
    return OST_SUCCESS;
}

static OstStatus create(List *list, double memory, OstSaddleFactors *factors)
{
    const OstGlobal own = (OstGlobal)(factors->n + factors->m);
    OstGlobal first, all;
    OST_TRY(ost_number_from(factors->ctx, own, &first, &all));
    if (all >= INT_MAX)
        return OST_RAISE(factors->ctx, OST_LIMIT_EXCEEDED,
                         "%lld unknowns are more than MUMPS can number (2^31 - 1); use an iterative method",
                         (long long)all);
    OST_TRY(find_columns(list, first + 1));
    OST_TRY(list_entries(list));
    OST_TRY(keep_scale(list, factors));
    OST_TRY(ost_mumps_create_symmetric(factors->ctx, (OstLocal)own, &list->entries, memory, &factors->negative,
                                       &factors->mumps));
    factors->negative -= list->coupling ? list->coupling->global_rows : 0;
    return OST_SUCCESS;
}

OstStatus ost_saddle_factors_create(const OstBlockMatrix *matrix, const OstCoupling *coupling, double memory,
                                    OstSaddleFactors **factors)
{
    OstContext *ctx = matrix->ctx;
    OstSaddleFactors *made = NULL;
    OstDoubleMatrix *view = NULL;
    List list = {.coupling = coupling};
    OstStatus status = OST_NEW(ctx, &made, 1);
    OST_THEN(ost_double_matrix_borrow(matrix, NULL, &view));
    OST_TRY_DONE(ost_agree(ctx, status));
    *made = (OstSaddleFactors){.ctx = ctx, .n = 3 * (size_t)matrix->rows, .m = coupling ? (size_t)coupling->rows : 0};
    list.matrix = view;
    OST_TRY_DONE(create(&list, memory, made));
done:
    ost_double_matrix_destroy(&view);
    OST_FREE(list.u_number);
    OST_FREE(list.p_number);
    OST_FREE(list.u_scale);
    OST_FREE(list.p_scale);
    OST_FREE(list.entries.row);
    OST_FREE(list.entries.column);
    OST_FREE(list.entries.value);
    if (status != OST_SUCCESS)
        ost_saddle_factors_destroy(&made);
    *factors = made;
    return status;
}

OstGlobal ost_saddle_factors_negative(const OstSaddleFactors *factors)
{
    return factors->negative;
}

OstStatus ost_saddle_factors_solve(const OstSaddleFactors *factors, const double *f, const double *g, double *u,
                                   double *p)
{
    const size_t n = factors->n, m = factors->m;
    double *work = factors->work;
    const double *of_u = factors->scale, *of_p = factors->scale + n;
    for (size_t i = 0; i < n; i++)
        work[i] = of_u[i] * f[i];
    for (size_t i = 0; i < m; i++)
        work[n + i] = of_p[i] * g[i];
    OST_TRY(ost_mumps_solve(factors->mumps, work, work));
    for (size_t i = 0; i < n; i++)
        u[i] = of_u[i] * work[i];
    for (size_t i = 0; i < m; i++)
        p[i] = of_p[i] * work[n + i];
    return OST_SUCCESS;
}
