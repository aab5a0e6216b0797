/* SPDX-License-Identifier: BSD-3-Clause */
#include "hard_grid/exact.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "hard_grid/exact_tet.h"

#include <math.h>
#include <string.h>

/* Refinement ends when a step changes the solution by this, and counts if it came below the second. */
static const double last_digit = 1e-17, settled = 1e-10;

enum { MOST_STEPS = 400 };

typedef struct Exact {
    const OstScene *scene;
    HardDirect *direct;
    const OstMesh *mesh;
    Twofold *u;      /* of all local nodes */
    Twofold *turned; /* the step, likewise */
    Long *internal;  /* of owned nodes, with those of their springs */
    double *step;    /* of all local nodes */
    double *rows;    /* the residual, of the rows */
    double *before;  /* that of the step before */
    double *turn;    /* the step, of the rows */
    double weight;   /* K^-1 residual · residual, of the step before */
} Exact;

static Twofold sum_of(Twofold a, double b)
{
    const double sum = a.high + b, part = sum - a.high;
    const double low = (a.high - (sum - part)) + (b - part) + a.low;
    return (Twofold){sum + low, low - ((sum + low) - sum)};
}

/* Displacements less that of the first node, which makes no force. */
static void gather(const OstBatch *batch, int slot, int nodes, const Twofold *u, Long *relative)
{
    const Twofold *first = u + 3 * (size_t)batch->node[slot][0];
    for (int a = 0; a < nodes; a++)
        for (int i = 0; i < 3; i++) {
            const Twofold here = u[3 * (size_t)batch->node[slot][a] + (size_t)i];
            relative[3 * a + i] = ((Long)here.high - (Long)first[i].high) + ((Long)here.low - (Long)first[i].low);
        }
}

static void find_internal(Exact *exact, const Twofold *displacement)
{
    const OstMesh *mesh = exact->mesh;
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    OstBatch batch;
    ost_elasticity_clear(&batch.elasticity);
    for (size_t i = 0; i < 3 * (size_t)mesh->owned_nodes; i++)
        exact->internal[i] = hard_spring_force(exact->direct->supports, i / 3, i % 3, displacement);
    for (OstLocal first = 0; first < mesh->tet_count; first += OST_SIMD_WIDTH) {
        ost_batch_gather_from(&batch, element, mesh, exact->scene->field, first, mesh->tet_count);
        for (int slot = 0; slot < batch.count; slot++) {
            Long u[3 * OST_MAX_TET_NODES], force[3 * OST_MAX_TET_NODES];
            gather(&batch, slot, element->nodes, displacement, u);
            hard_exact_tet(&batch, slot, element->nodes, u, NULL, force, NULL, NULL);
            for (int n = 0; n < 3 * element->nodes; n++)
                if (batch.node[slot][n / 3] < mesh->owned_nodes)
                    exact->internal[3 * (size_t)batch.node[slot][n / 3] + (size_t)(n % 3)] += force[n];
        }
    }
}

/* P (f - K u), with P applied in long double too: constrained parts may be far larger than the rest. */
static void find_residual(Exact *exact)
{
    const OstSystem *system = exact->direct->system;
    find_internal(exact, exact->u);
    for (OstLocal row = 0; row < system->matrix->rows; row++) {
        const size_t node = (size_t)system->node_of_row[row];
        double projector[9];
        ost_supports_get(exact->direct->supports, (OstLocal)node, projector, NULL);
        for (size_t i = 0; i < 3; i++) {
            Long sum = 0.0L;
            for (size_t j = 0; j < 3; j++)
                sum += (Long)projector[3 * i + j] *
                       ((Long)exact->direct->force[3 * node + j] - exact->internal[3 * node + j]);
            exact->rows[3 * (size_t)row + i] = (double)sum;
        }
    }
}

/* turn = K^-1 residual + beta turn, by the factors of the rounded K; and the same of all nodes. */
static OstStatus turn(Exact *exact, int is_first)
{
    HardDirect *direct = exact->direct;
    double sums[2] = {0.0};
    memcpy(direct->r, exact->rows, direct->n * sizeof *direct->r);
    OST_TRY(hard_direct_apply(direct));
    for (size_t i = 0; i < direct->n; i++) {
        sums[0] += direct->d[i] * exact->rows[i];
        sums[1] += direct->d[i] * exact->before[i];
    }
    OST_TRY(ost_sum(direct->ctx, 2, sums));
    const double beta = is_first ? 0.0 : (sums[0] - sums[1]) / exact->weight;
    exact->weight = sums[0];
    for (size_t i = 0; i < direct->n; i++) {
        exact->turn[i] = direct->d[i] + beta * exact->turn[i];
        exact->before[i] = exact->rows[i];
    }
    OST_TRY(ost_system_displacement(direct->system, 0.0, exact->turn, exact->step));
    for (size_t i = 0; i < 3 * (size_t)exact->mesh->node_count; i++)
        exact->turned[i] = (Twofold){exact->step[i], 0.0};
    return OST_SUCCESS;
}

/* A step of conjugate gradients, preconditioned by the rounded stiffness. */
static OstStatus take_step(Exact *exact, int is_first, double *change)
{
    HardDirect *direct = exact->direct;
    enum { ENERGY, WORK, SQUARE, SIZE, SUMS };
    double sums[SUMS] = {0.0};
    find_residual(exact);
    OST_TRY(turn(exact, is_first));
    find_internal(exact, exact->turned);
    for (size_t i = 0; i < direct->n; i++)
        sums[WORK] += exact->turn[i] * exact->rows[i];
    for (size_t i = 0; i < 3 * (size_t)exact->mesh->owned_nodes; i++) {
        sums[ENERGY] += exact->step[i] * (double)exact->internal[i];
        sums[SQUARE] += exact->step[i] * exact->step[i];
        sums[SIZE] += exact->u[i].high * exact->u[i].high;
    }
    OST_TRY(ost_sum(direct->ctx, SUMS, sums));
    const double length = sums[ENERGY] > 0.0 ? sums[WORK] / sums[ENERGY] : 0.0;
    for (size_t i = 0; i < 3 * (size_t)exact->mesh->node_count; i++)
        exact->u[i] = sum_of(exact->u[i], length * exact->step[i]);
    *change = sums[ENERGY] > 0.0 ? fabs(length) * sqrt(sums[SQUARE] / sums[SIZE]) : NAN;
    return OST_SUCCESS;
}

static OstStatus solve(Exact *exact, int *known)
{
    double change = INFINITY, least = INFINITY;
    int stalls = 0;
    for (int k = 0; k < MOST_STEPS && stalls < 12 && change > last_digit; k++) {
        OST_TRY(take_step(exact, k == 0, &change));
        stalls = change < 0.9 * least ? 0 : stalls + 1;
        least = fmin(least, change);
        if (isnan(change))
            break;
    }
    *known = change <= settled;
    return OST_SUCCESS;
}

enum { DISPLACEMENT, DISPLACEMENT_ERROR, REACTION, REACTION_ERROR, LOAD, STRESS, STRESS_ERROR, SUMS };

static void add_stresses(const Exact *exact, const Twofold *off, double *sums)
{
    const OstMesh *mesh = exact->mesh;
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    OstBatch batch;
    ost_elasticity_clear(&batch.elasticity);
    for (OstLocal first = 0; first < mesh->owned_tets; first += OST_SIMD_WIDTH) {
        ost_batch_gather_from(&batch, element, mesh, exact->scene->field, first, mesh->owned_tets);
        for (int slot = 0; slot < batch.count; slot++) {
            Long u[3 * OST_MAX_TET_NODES], stress[6];
            gather(&batch, slot, element->nodes, exact->u, u);
            hard_exact_tet(&batch, slot, element->nodes, u, NULL, NULL, stress, NULL);
            for (int p = 0; p < 6; p++)
                sums[STRESS] += (double)(stress[p] * stress[p]);
            gather(&batch, slot, element->nodes, off, u);
            hard_exact_tet(&batch, slot, element->nodes, u, NULL, NULL, stress, NULL);
            for (int p = 0; p < 6; p++)
                sums[STRESS_ERROR] += (double)(stress[p] * stress[p]);
        }
    }
}

static void add_reactions(const Exact *exact, const OstResult *result, double *sums)
{
    for (OstLocal node = 0; node < exact->mesh->owned_nodes; node++) {
        double projector[9];
        const size_t n = 3 * (size_t)node;
        const int constrained = ost_supports_get(exact->direct->supports, node, projector, NULL);
        if (constrained == 0 && !exact->direct->supports->spring)
            continue;
        for (size_t i = 0; i < 3; i++) {
            Long reaction = -hard_spring_force(exact->direct->supports, (size_t)node, i, exact->u);
            for (size_t j = 0; j < 3; j++)
                reaction += ((i == j) - (Long)projector[3 * i + j]) *
                            (exact->internal[n + j] - (Long)exact->direct->force[n + j]);
            const double off = result->reaction[n + i] - (double)reaction;
            sums[REACTION] += (double)(reaction * reaction);
            sums[REACTION_ERROR] += off * off;
        }
    }
}

static OstStatus compare(Exact *exact, const OstResult *result, HardErrors *errors)
{
    double sums[SUMS] = {0.0};
    Twofold *off = NULL;
    OstStatus status;
    OST_TRY_DONE(ost_agree(exact->direct->ctx, OST_NEW(exact->direct->ctx, &off, 3 * (size_t)exact->mesh->node_count)));
    for (size_t i = 0; i < 3 * (size_t)exact->mesh->node_count; i++)
        off[i] = (Twofold){(result->displacement[i] - exact->u[i].high) - exact->u[i].low, 0.0};
    for (size_t i = 0; i < 3 * (size_t)exact->mesh->owned_nodes; i++) {
        sums[DISPLACEMENT] += exact->u[i].high * exact->u[i].high;
        sums[DISPLACEMENT_ERROR] += off[i].high * off[i].high;
        sums[LOAD] += exact->direct->force[i] * exact->direct->force[i];
    }
    find_internal(exact, exact->u);
    add_reactions(exact, result, sums);
    add_stresses(exact, off, sums);
    OST_TRY_DONE(ost_sum(exact->direct->ctx, SUMS, sums));
    errors->displacement = sqrt(sums[DISPLACEMENT_ERROR] / sums[DISPLACEMENT]);
    errors->reaction =
        sqrt(sums[REACTION_ERROR] / fmax(sums[REACTION], hard_least_reaction * hard_least_reaction * sums[LOAD]));
    errors->stress = sqrt(sums[STRESS_ERROR] / sums[STRESS]);
done:
    OST_FREE(off);
    return status;
}

static OstStatus create_exact(const OstScene *scene, HardDirect *direct, const OstResult *result, Exact *exact)
{
    const OstMesh *mesh = scene->mesh;
    OstContext *ctx = scene->ctx;
    *exact = (Exact){.scene = scene, .direct = direct, .mesh = mesh};
    OstStatus status = OST_NEW(ctx, &exact->u, 3 * (size_t)mesh->node_count);
    OST_THEN(OST_NEW(ctx, &exact->internal, 3 * (size_t)mesh->owned_nodes));
    OST_THEN(OST_NEW(ctx, &exact->step, 3 * (size_t)mesh->node_count));
    OST_THEN(OST_NEW(ctx, &exact->turned, 3 * (size_t)mesh->node_count));
    OST_THEN(OST_NEW(ctx, &exact->rows, direct->n));
    OST_THEN(OST_NEW(ctx, &exact->before, direct->n));
    OST_THEN(OST_NEW(ctx, &exact->turn, direct->n));
    for (size_t i = 0; i < 3 * (size_t)mesh->node_count && status == OST_SUCCESS; i++)
        exact->u[i] = (Twofold){result->displacement[i], 0.0};
    return ost_agree(ctx, status);
}

static void destroy_exact(Exact *exact)
{
    OST_FREE(exact->u, exact->internal, exact->step, exact->rows, exact->turned, exact->before, exact->turn);
}

OstStatus hard_find_exact(const OstScene *scene, HardDirect *direct, const OstResult *result, HardErrors *errors)
{
    Exact exact;
    *errors = (HardErrors){0, NAN, NAN, NAN};
    OstStatus status = create_exact(scene, direct, result, &exact);
    if (status == OST_SUCCESS)
        status = solve(&exact, &errors->known);
    if (status == OST_SUCCESS && errors->known)
        status = compare(&exact, result, errors);
    destroy_exact(&exact);
    return status;
}

OstStatus hard_find_exact_residual(const OstScene *scene, HardDirect *direct, const OstResult *result, double *relative)
{
    Exact exact;
    double residual, load;
    OstStatus status = create_exact(scene, direct, result, &exact);
    if (status == OST_SUCCESS) {
        find_residual(&exact);
        status = hard_direct_norm(direct, exact.rows, &residual);
    }
    if (status == OST_SUCCESS)
        status = hard_direct_norm(direct, direct->f, &load);
    if (status == OST_SUCCESS)
        *relative = residual / load;
    destroy_exact(&exact);
    return status;
}
