/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/batch.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "guard/guard.h"

#include <math.h>
#include <string.h>

/* Reactions may balance each other or be none: their error is over no less than this share of the loads. So may
 * stresses where springs take the loads at once: theirs is over no less than that of stresses whose forces are so
 * large. */
static const double least_reaction = 1e-3;

/* Where an eigenstrain acts, stress or displacement may be none: their errors are over no less than this share of the
 * stress if nothing gave way, and of the displacement if nothing were held. */
static const double least_of_eigenstrain = 1e-3;

/* Squares, of the answer and of its error. */
enum {
    DISPLACEMENT,
    DISPLACEMENT_ERROR,
    REACTION,
    REACTION_ERROR,
    STRESS,
    STRESS_ERROR,
    FORCE_ERROR, /* of the tets, without springs */
    EIGENSTRESS,
    EIGENSTRAIN,
    LOAD,
    SUMS
};

static void add_stresses(void *sum, const OstBatch *batch, const OstElement *element, const OstSimd *u,
                         const OstMeans *means)
{
    (void)element;
    (void)u;
    OstSimd square;
    ost_batch_squares(means->stress, &square);
    for (int slot = 0; slot < batch->count; slot++)
        *(double *)sum += square[slot];
}

static void add_eigenstrains(void *data, const OstBatch *batch, const OstElement *element, const OstSimd *u,
                             const OstMeans *means)
{
    double *sums = data;
    const OstElasticity *elasticity = &batch->elasticity;
    add_stresses(&sums[EIGENSTRESS], batch, element, u, means);
    for (int point = 0; point < elasticity->points; point++)
        for (int slot = 0; slot < batch->count; slot++)
            for (int p = 0; p < 6; p++) {
                const double strain = elasticity->e0[point][p][slot];
                sums[EIGENSTRAIN] += strain * strain / elasticity->points;
            }
}

static double square_of(const double vector[3])
{
    return ost_dot3(vector, vector);
}

/* `internal` and `of_error` are the internal forces at the node, with those of its springs, of the answer and of its
 * error, whose displacements are `u` and `error`; `straining` is the load with the forces of the eigenstrain. */
static void add_node(const OstProblem *problem, OstLocal node, const double *internal, const double *of_error,
                     const double *u, const double *error, const double *load, const double *straining, double *sums)
{
    double projector[9], free_force[3], free_error[3], free_load[3], force[3], reaction[3] = {0.0}, off[3] = {0.0};
    const double *spring = problem->supports->spring ? problem->supports->spring + 9 * (size_t)node : NULL;
    const int constrained = ost_supports_get(problem->supports, node, projector, NULL);
    for (int i = 0; i < 3; i++)
        force[i] = internal[i] - load[i];
    ost_apply3(projector, straining, free_load);
    sums[LOAD] += square_of(free_load);
    if (spring) {
        ost_apply3(spring, u, reaction);
        ost_apply3(spring, error, off);
    }
    ost_apply3(projector, force, free_force);
    ost_apply3(projector, of_error, free_error);
    for (int i = 0; i < 3; i++) {
        sums[FORCE_ERROR] += (of_error[i] - off[i]) * (of_error[i] - off[i]);
        reaction[i] = (constrained > 0 ? force[i] - free_force[i] : 0.0) - reaction[i];
        off[i] = (constrained > 0 ? of_error[i] - free_error[i] : 0.0) - off[i];
    }
    sums[REACTION] += square_of(reaction);
    sums[REACTION_ERROR] += square_of(off);
}

/* Relative to the root of `square`; zero is relative to zero. */
static double relative(double square_of_error, double square)
{
    return square_of_error > 0.0 ? sqrt(square_of_error) / sqrt(square) : 0.0;
}

/* Sums of what the eigenstrain alone would make, if nothing gave way. */
static OstStatus add_eigen(const OstProblem *problem, double share, double *sums)
{
    double *zero = NULL;
    if (!ost_field_is_eigenstrained(problem->field))
        return OST_SUCCESS;
    OST_TRY(OST_NEW(problem->ctx, &zero, 3 * (size_t)problem->mesh->node_count));
    ost_visit_means(problem->mesh, problem->field, share, zero, add_eigenstrains, sums);
    OST_FREE(zero);
    return OST_SUCCESS;
}

/* Collective. About the squared displacement of all nodes under this sum of squared eigenstrains of the tets. */
static OstStatus free_displacement(const OstMesh *mesh, double squares, double *displacement)
{
    double low[3], high[3], size[3];
    *displacement = 0.0;
    if (squares == 0.0)
        return OST_SUCCESS;
    OST_TRY(ost_mesh_bounds(mesh, low, high));
    for (int i = 0; i < 3; i++)
        size[i] = high[i] - low[i];
    *displacement = squares / (double)mesh->global_tets * square_of(size) * (double)mesh->global_nodes;
    return OST_SUCCESS;
}

/* Incompressible parts may bear all loads by their pressure and not move: the displacement's error is over no less than
 * this share of that of the same energy. Squared, with 2-norms as if the internal forces did that work. */
static OstStatus of_pressure(const OstProblem *problem, size_t n, const double *internal, double *square)
{
    static const double least_of_pressure = 1e-6;
    const OstMesh *mesh = problem->mesh;
    double sums[2] = {0.0};
    *square = 0.0;
    if (!problem->pressures || !problem->field->pressure)
        return OST_SUCCESS;
    for (size_t i = 0; i < 4 * (size_t)mesh->owned_tets; i++) {
        const OstLocal tet = (OstLocal)(i / 4);
        const double p = problem->pressures->of_tet[i] >= 0 ? problem->field->pressure[i] : 0.0;
        if (p != 0.0)
            sums[0] += 0.25 * fabs(ost_tet_volume(mesh->coordinates, ost_mesh_nodes_of(mesh, tet))) * p * p *
                       ost_field_giving_way(problem->field, mesh->tet_region[tet]);
    }
    for (size_t i = 0; i < n; i++)
        sums[1] += internal[i] * internal[i];
    OST_TRY(ost_sum(problem->ctx, 2, sums));
    const double size = least_of_pressure * sums[0];
    *square = sums[1] > 0.0 ? size * size / sums[1] : 0.0;
    return OST_SUCCESS;
}

/* `swollen`: the squared displacement that the eigenstrain would make of a body that nothing holds. */
static void take_relative(const OstProblem *problem, const double *sums, double swollen, OstErrors *errors)
{
    const double least = least_of_eigenstrain * least_of_eigenstrain;
    const double reaction = fmax(sums[REACTION], least_reaction * least_reaction * sums[LOAD]);
    const double moved = fmax(sums[DISPLACEMENT], least * swollen);
    double stress = relative(sums[STRESS_ERROR], fmax(sums[STRESS], least * sums[EIGENSTRESS]));
    if (problem->supports->spring && sums[LOAD] > 0.0)
        stress = fmin(stress, relative(sums[FORCE_ERROR], least_reaction * least_reaction * sums[LOAD]));
    *errors = (OstErrors){.known = 1,
                          .displacement = relative(sums[DISPLACEMENT_ERROR], moved),
                          .reaction = problem->free_body ? 0.0 : relative(sums[REACTION_ERROR], reaction),
                          .stress = stress};
}

/* Stresses of all own tets: of the answer, then of it with its error added. */
typedef struct Turned {
    double *stress; /* 6 × owned_tets */
    int with_error;
    double sums[SUMS];
} Turned;

static void compare_stresses(void *data, const OstBatch *batch, const OstElement *element, const OstSimd *u,
                             const OstMeans *means)
{
    Turned *turned = data;
    (void)element;
    (void)u;
    for (int slot = 0; slot < batch->count; slot++)
        for (int p = 0; p < 6; p++) {
            double *kept = &turned->stress[6 * (size_t)batch->tet[slot] + (size_t)p];
            const double stress = means->stress[p][slot], more = stress - *kept;
            if (turned->with_error) {
                turned->sums[STRESS_ERROR] += more * more;
                continue;
            }
            *kept = stress;
            turned->sums[STRESS] += stress * stress;
        }
}

/* The load with the forces of the eigenstrain; in memory from the context. */
static OstStatus find_straining(const OstProblem *problem, double share, const double *load, double **straining)
{
    const size_t n = 3 * (size_t)problem->mesh->owned_nodes;
    OST_TRY(OST_NEW(problem->ctx, straining, n));
    memcpy(*straining, load, n * sizeof *load);
    return ost_field_is_eigenstrained(problem->field)
               ? ost_eigenstrain_force(problem->mesh, problem->field, share, *straining)
               : OST_SUCCESS;
}

OstStatus ost_guard_turned_errors(const OstProblem *problem, double t, const double *displacement,
                                  const double *internal, const double *load, const double *error, OstErrors *errors)
{
    const OstMesh *mesh = problem->mesh;
    const size_t n = 3 * (size_t)mesh->owned_nodes, all = 3 * (size_t)mesh->node_count;
    const double share = ost_problem_eigen_share(problem, t);
    double *moved = NULL, *wrong = NULL, *straining = NULL;
    Turned turned = {.stress = NULL};
    double *sums = turned.sums, swollen = 0.0;
    OstStatus status = OST_NEW(problem->ctx, &moved, all);
    OST_THEN(OST_NEW(problem->ctx, &wrong, n));
    OST_THEN(OST_NEW(problem->ctx, &turned.stress, 6 * (size_t)mesh->owned_tets));
    for (size_t i = 0; i < all && status == OST_SUCCESS; i++)
        moved[i] = displacement[i] + error[i];
    OST_THEN(ost_problem_force(problem, t, moved, wrong));
    OST_THEN(add_eigen(problem, share, sums));
    OST_THEN(find_straining(problem, share, load, &straining));
    OST_TRY_DONE(ost_agree(problem->ctx, status));
    ost_visit_means_of(mesh, problem->field, problem->formulation, share, displacement, compare_stresses, &turned);
    turned.with_error = 1;
    ost_visit_means_of(mesh, problem->field, problem->formulation, share, moved, compare_stresses, &turned);
    for (size_t i = 0; i < n; i++) {
        wrong[i] -= internal[i];
        sums[DISPLACEMENT] += displacement[i] * displacement[i];
        sums[DISPLACEMENT_ERROR] += error[i] * error[i];
    }
    for (size_t k = 0; k < n; k += 3)
        add_node(problem, (OstLocal)(k / 3), internal + k, wrong + k, displacement + k, error + k, load + k,
                 straining + k, sums);
    OST_TRY_DONE(ost_sum(problem->ctx, SUMS, sums));
    OST_TRY_DONE(free_displacement(mesh, sums[EIGENSTRAIN], &swollen));
    take_relative(problem, sums, swollen, errors);
done:
    OST_FREE(moved, wrong, straining, turned.stress);
    return status;
}

OstStatus ost_guard_errors(const OstProblem *problem, const OstProblem *of_error, const double *displacement,
                           const double *internal, double stress, const double *error, OstErrors *errors)
{
    OstContext *ctx = problem->ctx;
    const size_t n = 3 * (size_t)problem->mesh->owned_nodes;
    const double share = ost_problem_eigen_share(problem, 1.0);
    double *wrong = NULL, *load = NULL, *straining = NULL;
    double sums[SUMS] = {[STRESS] = stress}, swollen = 0.0, pressed = 0.0;
    OstStatus status = OST_NEW_UNCLEARED(ctx, &wrong, n);
    OST_THEN(OST_NEW_UNCLEARED(ctx, &load, n));
    OST_THEN(ost_problem_force_and_stress(of_error, 0.0, error, wrong, &sums[STRESS_ERROR]));
    OST_THEN(add_eigen(problem, share, sums));
    if (status == OST_SUCCESS) {
        ost_problem_load(problem, 1.0, NULL, load);
        status = find_straining(problem, share, load, &straining);
    }
    OST_TRY_DONE(ost_agree(ctx, status));
    for (size_t i = 0; i < n; i++) {
        sums[DISPLACEMENT] += displacement[i] * displacement[i];
        sums[DISPLACEMENT_ERROR] += error[i] * error[i];
    }
    for (size_t k = 0; k < n; k += 3)
        add_node(problem, (OstLocal)(k / 3), internal + k, wrong + k, displacement + k, error + k, load + k,
                 straining + k, sums);
    OST_TRY_DONE(ost_sum(ctx, SUMS, sums));
    OST_TRY_DONE(free_displacement(problem->mesh, sums[EIGENSTRAIN], &swollen));
    OST_TRY_DONE(of_pressure(problem, n, internal, &pressed));
    sums[DISPLACEMENT] = fmax(sums[DISPLACEMENT], pressed);
    take_relative(problem, sums, swollen, errors);
done:
    OST_FREE(wrong);
    OST_FREE(load);
    OST_FREE(straining);
    return status;
}
