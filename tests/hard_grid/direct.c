/* SPDX-License-Identifier: BSD-3-Clause */
#include "hard_grid/direct.h"

#include "core/error.h"
#include "core/memory.h"
#include "problem/boundary_conditions.h"

#include <math.h>
#include <string.h>

enum { STEPS = 200 };

void hard_direct_clear(HardDirect *direct)
{
    ost_mumps_destroy(&direct->factors);
    ost_scaling_destroy(&direct->scaling);
    ost_system_destroy(&direct->system);
    ost_supports_destroy(&direct->supports);
    OST_FREE(direct->force, direct->f, direct->u, direct->r, direct->d, direct->p, direct->q);
}

static OstStatus assemble(const OstScene *scene, HardDirect *direct)
{
    OstContext *ctx = scene->ctx;
    OST_TRY(ost_scene_supports(scene, 0, &direct->supports));
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &direct->force, 3 * (size_t)scene->mesh->node_count)));
    OstFollower *none = NULL; /* no point of the grid has a pressure that follows the surface */
    OST_TRY(ost_scene_loads(scene, 0, NULL, direct->force, &none));
    OST_TRY(ost_system_create(scene->mesh, direct->supports, &direct->system));
    OstStatus status = ost_system_fill(direct->system, scene->field);
    const size_t columns = 3 * (size_t)direct->system->matrix->columns;
    direct->n = 3 * (size_t)direct->system->matrix->rows;
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &direct->f, direct->n);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &direct->u, columns);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &direct->r, direct->n);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &direct->q, direct->n);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &direct->p, columns);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &direct->d, columns);
    if (status == OST_SUCCESS)
        status = ost_system_right_hand_side(direct->system, scene->field, 0.0, direct->force, direct->f);
    return ost_agree(ctx, status);
}

/* Conjugate gradients remove the effect of a shift, or find that K is indefinite. */
static OstStatus factor(HardDirect *direct)
{
    double shift;
    const OstBlockMatrix *matrix = direct->system->matrix;
    OST_TRY(ost_scaling_create(matrix, &direct->scaling));
    return ost_mumps_create_of_rows(matrix, direct->scaling, 0.0, &shift, &direct->factors);
}

OstStatus hard_direct_assemble(const OstScene *scene, HardDirect *direct)
{
    *direct = (HardDirect){.ctx = scene->ctx};
    return assemble(scene, direct);
}

OstStatus hard_direct_create(const OstScene *scene, HardDirect *direct)
{
    OST_TRY(hard_direct_assemble(scene, direct));
    return factor(direct);
}

static OstStatus sum_products(const HardDirect *direct, const double *a, const double *b, double *sum)
{
    *sum = 0.0;
    for (size_t i = 0; i < direct->n; i++)
        *sum += a[i] * b[i];
    return OST_MPI(direct->ctx, MPI_Allreduce(MPI_IN_PLACE, sum, 1, MPI_DOUBLE, MPI_SUM, ost_comm(direct->ctx)));
}

OstStatus hard_direct_norm(const HardDirect *direct, const double *v, double *norm)
{
    double square;
    OST_TRY(sum_products(direct, v, v, &square));
    *norm = sqrt(square);
    return OST_SUCCESS;
}

OstStatus hard_direct_size(HardDirect *direct, double *norm)
{
    double square = 0.0;
    for (size_t i = 0; i < direct->n; i++)
        square += direct->u[i].high * direct->u[i].high;
    OST_TRY(OST_MPI(direct->ctx, MPI_Allreduce(MPI_IN_PLACE, &square, 1, MPI_DOUBLE, MPI_SUM, ost_comm(direct->ctx))));
    *norm = sqrt(square);
    return OST_SUCCESS;
}

OstStatus hard_direct_apply(HardDirect *direct)
{
    ost_scaling_to_scaled(direct->scaling, direct->r, direct->d);
    OST_TRY(ost_mumps_solve(direct->factors, direct->d, direct->d));
    ost_scaling_from_scaled(direct->scaling, direct->d, direct->d);
    return OST_SUCCESS;
}

Twofold hard_direct_row(const HardDirect *direct, OstLocal i, int c, Twofold sum, const Twofold *v)
{
    const OstBlockMatrix *k = direct->system->matrix;
    for (OstLocal b = k->row_start[i]; b < k->row_start[i + 1]; b++) {
        const double *value = k->value + 9 * (size_t)b + 3 * (size_t)c;
        for (int e = 0; e < 3; e++)
            sum = hard_minus_product(sum, value[e], v[3 * (size_t)k->column[b] + (size_t)e]);
    }
    return sum;
}

/* base - K v (NULL: 0), with compensated sums. */
static OstStatus subtract_product(const HardDirect *direct, const double *base, Twofold *v, double *difference)
{
    const OstBlockMatrix *k = direct->system->matrix;
    OST_TRY(ost_halo_import(k->halo, 3 * sizeof *v, v));
    for (OstLocal i = 0; i < k->rows; i++)
        for (int c = 0; c < 3; c++) {
            const size_t at = 3 * (size_t)i + (size_t)c;
            const Twofold sum = hard_direct_row(direct, i, c, (Twofold){base ? base[at] : 0.0, 0.0}, v);
            difference[at] = sum.high + sum.low;
        }
    return OST_SUCCESS;
}

/* p = d, made conjugate to the last p (if not the first); q = K p. `energy`: the last p·q, and then the new one. */
static OstStatus next_direction(HardDirect *direct, int first, double *energy)
{
    double overlap = 0.0;
    if (!first)
        OST_TRY(sum_products(direct, direct->d, direct->q, &overlap));
    for (size_t i = 0; i < direct->n; i++) {
        direct->p[i] = (Twofold){direct->d[i] - (first ? 0.0 : overlap / *energy * direct->p[i].high), 0.0};
        direct->d[i] = direct->p[i].high;
    }
    OST_TRY(subtract_product(direct, NULL, direct->p, direct->q));
    for (size_t i = 0; i < direct->n; i++)
        direct->q[i] = -direct->q[i];
    return sum_products(direct, direct->d, direct->q, energy);
}

OstStatus hard_direct_solve(HardDirect *direct, const double *f, double enough, double *first, int *known)
{
    double energy = 0.0, gain, correction, size;
    *known = 0;
    memset(direct->u, 0, direct->n * sizeof *direct->u);
    for (int k = 0; k < STEPS && !*known; k++) {
        OST_TRY(subtract_product(direct, f, direct->u, direct->r));
        OST_TRY(hard_direct_apply(direct));
        if (k == 0 && first)
            memcpy(first, direct->d, direct->n * sizeof(double));
        OST_TRY(hard_direct_norm(direct, direct->d, &correction));
        OST_TRY(next_direction(direct, k == 0, &energy));
        direct->indefinite |= energy <= 0.0 && correction > 0.0;
        if (!(energy > 0.0 && isfinite(energy)))
            break;
        OST_TRY(sum_products(direct, direct->d, direct->r, &gain));
        for (size_t i = 0; i < direct->n; i++)
            direct->u[i] = hard_plus(direct->u[i], gain / energy * direct->d[i]);
        OST_TRY(hard_direct_size(direct, &size));
        *known = correction <= enough * size;
    }
    return OST_SUCCESS;
}
