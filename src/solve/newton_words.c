/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "solve/newton_data.h"

#include <stdio.h>
#include <string.h>

/* Where the last correction is largest, in words: the place in the undeformed body, and a tet there. */
static OstStatus describe_place(const OstNewton *newton, char *text, size_t size)
{
    OstContext *ctx = newton->ctx;
    const OstMesh *mesh = newton->problem->mesh;
    struct {
        double value;
        int rank;
    } largest = {-1.0, ost_rank(ctx)};
    OstLocal found = 0;
    double at[3] = {0.0};
    int region = 0;
    OstGlobal label = 0;
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet++)
        for (int a = 0; a < mesh->nodes_per_tet; a++) {
            const double length = ost_norm3(newton->direction + 3 * (size_t)ost_mesh_nodes_of(mesh, tet)[a]);
            if (!(length > largest.value))
                continue;
            largest.value = length;
            found = ost_mesh_nodes_of(mesh, tet)[a];
            label = mesh->tet_label[tet];
            region = mesh->tet_region[tet];
        }
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE_INT, MPI_MAXLOC, ost_comm(ctx))));
    memcpy(at, mesh->coordinates + 3 * (size_t)found, sizeof at);
    OST_TRY(OST_MPI(ctx, MPI_Bcast(at, 3, MPI_DOUBLE, largest.rank, ost_comm(ctx))));
    OST_TRY(OST_MPI(ctx, MPI_Bcast(&label, 1, MPI_INT64_T, largest.rank, ost_comm(ctx))));
    OST_TRY(OST_MPI(ctx, MPI_Bcast(&region, 1, MPI_INT, largest.rank, ost_comm(ctx))));
    snprintf(text, size, "tet %lld of region '%.60s', at (%.4g, %.4g, %.4g) of the undeformed body", (long long)label,
             mesh->regions.name[region], at[0], at[1], at[2]);
    return OST_SUCCESS;
}

OstStatus ost_newton_give_up(OstNewton *newton, const OstNewtonState *state, double t, OstRest rest)
{
    char place[200], reason[400];
    const OstMesh *mesh = newton->problem->mesh;
    const OstCase *c = newton->problem->c;
    const int on_path = c && c->path_steps > 0;
    OstWorstTet worst;
    OST_TRY(describe_place(newton, place, sizeof place));
    OST_TRY(ost_problem_worst_tet(newton->problem, newton->displacement, &worst));
    if (rest == OST_REST_CREEPS)
        snprintf(reason, sizeof reason,
                 "by the classical formulation only load steps as short as %.2g come to rest, and the end is out of "
                 "sight; leave out 'formulation' (the consistent one)",
                 t - state->t);
    else if (worst.inverted > 0)
        snprintf(reason, sizeof reason,
                 "%lld tets are turned inside out there, the worst of them tet %lld of region '%.60s' at (%.4g, %.4g, "
                 "%.4g): refine the mesh there, spread the load, or use stiffer or less compressible material",
                 (long long)worst.inverted, (long long)worst.tet, mesh->regions.name[worst.region], worst.place[0],
                 worst.place[1], worst.place[2]);
    else if (newton->couplings && rest == OST_REST_UNSTABLE)
        snprintf(reason, sizeof reason,
                 "the state at rest there is not stable: the body buckles, and where a distributing coupling moves it "
                 "no other state is looked for; move it by less, or make the face 'rigid', which is followed there");
    else if ((newton->indefinite && !newton->couplings) || rest == OST_REST_UNSTABLE)
        snprintf(reason, sizeof reason,
                 "the stiffness is indefinite there (negative curvature of the energy): the body buckles, or the load "
                 "passes a limit point beyond which nothing at rest was found near by; lower the load, or prescribe "
                 "displacements in its place");
    else if (rest == OST_REST_ROUNDING)
        snprintf(reason, sizeof reason,
                 "rounding allows no smaller residual than %.2g of loads and reactions, and %.2g was asked for",
                 newton->norm / newton->size, newton->options.relative_residual);
    else
        snprintf(reason, sizeof reason, "%s",
                 rest == OST_REST_SLOW      ? "Newton's method does not converge there"
                 : rest == OST_REST_STALLED ? "no step along the correction lowers the energy"
                                            : "the linear solver finds no correction");
    /* Tets turned inside out say themselves where it is. */
    const int has_place = worst.inverted > 0 || rest == OST_REST_CREEPS;
    return OST_RAISE(newton->ctx, OST_NOT_CONVERGED, "%s %.6g%s and not to %.6g: %s%s%s",
                     on_path ? "the path is followed up to t =" : "the load is followed up to", state->t,
                     on_path ? "" : " of it", t, reason, has_place ? "" : ". The last correction is largest in ",
                     has_place ? "" : place);
}
