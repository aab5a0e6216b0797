/* SPDX-License-Identifier: BSD-3-Clause */
#include "hard_grid/mixed_exact.h"

#include "algebra/saddle/norm.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "hard_grid/exact_tet.h"

#include <math.h>
#include <string.h>

enum { MOST_PASSES = 400, MOST_STALLS = 12, VERTICES = 4 };

/* Corrections end when one changes the solution by the first, and it counts if one came below the second. */
static const double last_digit = 1e-15, settled = 1e-10;

typedef struct Exact {
    const OstScene *scene;
    const HardMixed *mixed;
    const OstMesh *mesh;
    size_t rows, pressures; /* of this rank */
    Twofold *u, *p;         /* of all local nodes, and of all pressures: the solution */
    Twofold *off_u, *off_p; /* the answer less these */
    Long *internal;         /* of owned nodes, with those of their springs */
    Long *volume;           /* of owned pressures */
    double *ru, *rp, *du, *dp;
    double *step; /* du, of all local nodes */
} Exact;

/* Displacements less that of the first node, which makes no force, and pressures of a tet. */
static void gather(const Exact *exact, const OstBatch *batch, int slot, const Twofold *u, const Twofold *p,
                   Long *relative, Long *pressure)
{
    const Twofold *first = u + 3 * (size_t)batch->node[slot][0];
    for (int n = 0; n < 3 * exact->mesh->nodes_per_tet; n++) {
        const Twofold here = u[3 * (size_t)batch->node[slot][n / 3] + (size_t)(n % 3)];
        relative[n] = ((Long)here.high - (Long)first[n % 3].high) + ((Long)here.low - (Long)first[n % 3].low);
    }
    for (int v = 0; v < VERTICES; v++) {
        const OstLocal k = exact->mixed->space->of_tet[VERTICES * (size_t)batch->tet[slot] + (size_t)v];
        pressure[v] = k < 0 ? 0.0L : (Long)p[k].high + (Long)p[k].low;
    }
}

/* Internal forces and the second equation, and, unless NULL, the sum of the squared mean stresses of owned tets. */
static void visit(Exact *exact, const Twofold *u, const Twofold *p, double *square)
{
    const OstMesh *mesh = exact->mesh;
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    OstBatch batch;
    ost_elasticity_clear(&batch.elasticity);
    for (size_t i = 0; i < 3 * (size_t)mesh->owned_nodes; i++)
        exact->internal[i] = hard_spring_force(exact->mixed->direct->supports, i / 3, i % 3, u);
    for (size_t i = 0; i < exact->pressures; i++)
        exact->volume[i] = 0.0L;
    for (OstLocal first = 0; first < mesh->tet_count; first += OST_SIMD_WIDTH) {
        ost_batch_gather_from(&batch, element, mesh, exact->scene->field, first, mesh->tet_count);
        for (int slot = 0; slot < batch.count; slot++) {
            Long relative[3 * OST_MAX_TET_NODES], force[3 * OST_MAX_TET_NODES], of_tet[VERTICES], stress[6], left[4];
            gather(exact, &batch, slot, u, p, relative, of_tet);
            hard_exact_tet(&batch, slot, element->nodes, relative, of_tet, force, stress, left);
            for (int n = 0; n < 3 * element->nodes; n++)
                if (batch.node[slot][n / 3] < mesh->owned_nodes)
                    exact->internal[3 * (size_t)batch.node[slot][n / 3] + (size_t)(n % 3)] += force[n];
            for (int v = 0; v < VERTICES; v++) {
                const OstLocal k = exact->mixed->space->of_tet[VERTICES * (size_t)batch.tet[slot] + (size_t)v];
                if (k >= 0 && k < (OstLocal)exact->pressures)
                    exact->volume[k] += left[v];
            }
            for (int s = 0; s < 6 && square && batch.tet[slot] < mesh->owned_tets; s++)
                *square += (double)(stress[s] * stress[s]);
        }
    }
}

/* P (f - internal forces), and minus the second equation. */
static void find_residual(Exact *exact)
{
    const HardDirect *direct = exact->mixed->direct;
    visit(exact, exact->u, exact->p, NULL);
    for (OstLocal row = 0; row < direct->system->matrix->rows; row++) {
        const size_t node = (size_t)direct->system->node_of_row[row];
        double projector[9];
        ost_supports_get(direct->supports, (OstLocal)node, projector, NULL);
        for (size_t i = 0; i < 3; i++) {
            Long sum = 0.0L;
            for (size_t j = 0; j < 3; j++)
                sum += (Long)projector[3 * i + j] * ((Long)direct->force[3 * node + j] - exact->internal[3 * node + j]);
            exact->ru[3 * (size_t)row + i] = (double)sum;
        }
    }
    for (size_t i = 0; i < exact->pressures; i++)
        exact->rp[i] = -(double)exact->volume[i];
}

/* How large the correction is beside the solution. */
static OstStatus measure(const Exact *exact, double *change)
{
    double sums[4] = {0.0};
    for (size_t i = 0; i < exact->rows; i++)
        sums[0] += exact->du[i] * exact->du[i];
    for (size_t i = 0; i < 3 * (size_t)exact->mesh->owned_nodes; i++)
        sums[1] += exact->u[i].high * exact->u[i].high;
    for (size_t i = 0; i < exact->pressures; i++) {
        sums[2] += exact->dp[i] * exact->dp[i];
        sums[3] += exact->p[i].high * exact->p[i].high;
    }
    OST_TRY(ost_sum(exact->scene->ctx, 4, sums));
    *change = sqrt(fmax(sums[0] / sums[1], sums[2] / sums[3]));
    return OST_SUCCESS;
}

static OstStatus solve(Exact *exact, int *known)
{
    const HardMixed *mixed = exact->mixed;
    double change = INFINITY, least = INFINITY;
    int stalls = 0;
    for (int pass = 0; pass < MOST_PASSES && stalls < MOST_STALLS && change > last_digit; pass++) {
        find_residual(exact);
        OST_TRY(ost_saddle_factors_solve(mixed->factors, exact->ru, exact->rp, exact->du, exact->dp));
        OST_TRY(ost_system_displacement(mixed->direct->system, 0.0, exact->du, exact->step));
        for (size_t i = 0; i < 3 * (size_t)exact->mesh->node_count; i++)
            exact->u[i] = hard_plus(exact->u[i], exact->step[i]);
        for (size_t i = 0; i < exact->pressures; i++)
            exact->p[i] = hard_plus(exact->p[i], exact->dp[i]);
        OST_TRY(ost_halo_import(mixed->coupling->halo, sizeof *exact->p, exact->p));
        OST_TRY(measure(exact, &change));
        if (!isfinite(change))
            break;
        stalls = change < 0.9 * least ? 0 : stalls + 1;
        least = fmin(least, change);
    }
    *known = change <= settled;
    return OST_SUCCESS;
}

enum { DISPLACEMENT, DISPLACEMENT_ERROR, REACTION, REACTION_ERROR, LOAD, STRESS, STRESS_ERROR, SUMS };

static void add_reactions(const Exact *exact, const OstResult *result, double *sums)
{
    const HardDirect *direct = exact->mixed->direct;
    for (OstLocal node = 0; node < exact->mesh->owned_nodes; node++) {
        double projector[9];
        const size_t n = 3 * (size_t)node;
        const int constrained = ost_supports_get(direct->supports, node, projector, NULL);
        for (size_t i = 0; i < 3; i++) {
            Long reaction = -hard_spring_force(direct->supports, (size_t)node, i, exact->u);
            for (size_t j = 0; j < 3 && constrained > 0; j++)
                reaction +=
                    ((i == j) - (Long)projector[3 * i + j]) * (exact->internal[n + j] - (Long)direct->force[n + j]);
            const double off = result->reaction[n + i] - (double)reaction;
            sums[REACTION] += (double)(reaction * reaction);
            sums[REACTION_ERROR] += off * off;
            sums[LOAD] += direct->force[n + i] * direct->force[n + i];
        }
    }
}

static OstStatus compare(Exact *exact, const OstResult *result, HardErrors *errors)
{
    double sums[SUMS] = {0.0};
    for (size_t i = 0; i < 3 * (size_t)exact->mesh->node_count; i++)
        exact->off_u[i] = hard_plus((Twofold){-exact->u[i].high, -exact->u[i].low}, result->displacement[i]);
    for (size_t i = 0; i < VERTICES * (size_t)exact->mesh->tet_count; i++) {
        const OstLocal k = exact->mixed->space->of_tet[i];
        if (k >= 0)
            exact->off_p[k] = hard_plus((Twofold){-exact->p[k].high, -exact->p[k].low}, result->pressure[i]);
    }
    for (size_t i = 0; i < 3 * (size_t)exact->mesh->owned_nodes; i++) {
        sums[DISPLACEMENT_ERROR] += exact->off_u[i].high * exact->off_u[i].high;
        sums[DISPLACEMENT] += exact->u[i].high * exact->u[i].high;
    }
    visit(exact, exact->off_u, exact->off_p, &sums[STRESS_ERROR]);
    visit(exact, exact->u, exact->p, &sums[STRESS]);
    add_reactions(exact, result, sums);
    OST_TRY(ost_sum(exact->scene->ctx, SUMS, sums));
    errors->displacement = sqrt(sums[DISPLACEMENT_ERROR] / sums[DISPLACEMENT]);
    errors->reaction =
        sqrt(sums[REACTION_ERROR] / fmax(sums[REACTION], hard_least_reaction * hard_least_reaction * sums[LOAD]));
    errors->stress = sqrt(sums[STRESS_ERROR] / sums[STRESS]);
    return OST_SUCCESS;
}

static OstStatus create(const OstResult *result, Exact *exact)
{
    OstContext *ctx = exact->scene->ctx;
    const OstMesh *mesh = exact->mesh;
    const size_t nodes = 3 * (size_t)mesh->node_count, owned = 3 * (size_t)mesh->owned_nodes;
    const size_t pressures = (size_t)exact->mixed->space->count;
    OstStatus status = OST_NEW(ctx, &exact->u, 2 * (nodes + pressures));
    OST_THEN(OST_NEW(ctx, &exact->internal, owned + exact->pressures));
    OST_THEN(OST_NEW(ctx, &exact->ru, 2 * (exact->rows + pressures) + nodes));
    OST_TRY(ost_agree(ctx, status));
    exact->off_u = exact->u + nodes;
    exact->p = exact->off_u + nodes;
    exact->off_p = exact->p + pressures;
    exact->volume = exact->internal + owned;
    exact->du = exact->ru + exact->rows;
    exact->rp = exact->du + exact->rows;
    exact->dp = exact->rp + pressures;
    exact->step = exact->dp + pressures;
    for (size_t i = 0; i < nodes; i++)
        exact->u[i] = (Twofold){result->displacement[i], 0.0};
    for (size_t i = 0; i < VERTICES * (size_t)mesh->tet_count; i++)
        if (exact->mixed->space->of_tet[i] >= 0)
            exact->p[exact->mixed->space->of_tet[i]] = (Twofold){result->pressure[i], 0.0};
    return OST_SUCCESS;
}

static Exact exact_of(const OstScene *scene, const HardMixed *mixed)
{
    return (Exact){.scene = scene,
                   .mixed = mixed,
                   .mesh = scene->mesh,
                   .rows = mixed->direct->n,
                   .pressures = (size_t)mixed->coupling->rows};
}

/* Of the first equation, and of the pressures that would close the second. `room`: of displacements and of three
 * pressures. */
static OstStatus find_relative(Exact *exact, double *room, double *relative)
{
    const HardMixed *mixed = exact->mixed;
    const OstSaddle saddle = {mixed->coupling, exact->rp, exact->dp};
    double *work = room + exact->rows, squares[OST_SADDLE_SQUARES], size;
    OST_TRY(ost_coupling_schur_solve(mixed->coupling, NULL, exact->rp, exact->dp, work));
    OST_TRY(ost_saddle_squares(mixed->coupling, exact->ru, exact->rp, exact->dp, room, squares));
    memset(exact->rp, 0, exact->pressures * sizeof *exact->rp);
    OST_TRY(ost_saddle_size(mixed->direct->system->matrix, &saddle, mixed->direct->f, &size));
    *relative = sqrt(squares[OST_SADDLE_FORCE]) / size;
    return OST_SUCCESS;
}

OstStatus hard_find_mixed_exact_residual(const OstScene *scene, const HardMixed *mixed, const OstResult *result,
                                         double *relative)
{
    Exact exact = exact_of(scene, mixed);
    double *room = NULL;
    OstStatus status = create(result, &exact);
    OST_THEN(ost_agree(scene->ctx, OST_NEW(scene->ctx, &room, exact.rows + 3 * exact.pressures)));
    if (status == OST_SUCCESS) {
        find_residual(&exact);
        status = find_relative(&exact, room, relative);
    }
    OST_FREE(exact.u, exact.internal, exact.ru, room);
    return status;
}

OstStatus hard_find_mixed_exact(const OstScene *scene, const HardMixed *mixed, const OstResult *result,
                                HardErrors *errors)
{
    Exact exact = exact_of(scene, mixed);
    *errors = (HardErrors){0, NAN, NAN, NAN};
    OstStatus status = create(result, &exact);
    OST_THEN(solve(&exact, &errors->known));
    if (errors->known)
        OST_THEN(compare(&exact, result, errors));
    OST_FREE(exact.u, exact.internal, exact.ru);
    return status;
}
