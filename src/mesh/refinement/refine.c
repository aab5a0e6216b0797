/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "mesh/check/check.h"
#include "mesh/refinement/divide.h"

/* Bey's red refinement (J. Bey, Tetrahedral grid refinement, Computing 55 (1995) 355-378): four tets at the vertices,
 * and four around the inner octahedron's diagonal between the middles of edges 02 and 13. With his order of the
 * children's vertices, repeated refinement makes tets of at most three shapes, but the sixth and the eighth child are
 * inverted. Here their first and third vertices are swapped, which changes neither the edges 02 and 13 nor the shapes.
 */
static const int bey_tet[8][4] = {{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3},
                                  {4, 6, 7, 8}, {5, 6, 4, 8}, {6, 7, 8, 9}, {8, 5, 6, 9}};
static const int halves[2][2] = {{0, 2}, {2, 1}};
static const int quarters[4][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
static const int point[1] = {0};
static const Division refining = {{8, 4, bey_tet[0]}, {{1, 1, point}, {2, 2, halves[0]}, {4, 3, quarters[0]}}};

/* The shortest diagonal is taken instead if Bey's is longer by more than this factor, as in meshes whose tets list
 * their vertices in an arbitrary order. The built-in shapes list them in the order that Bey's rule needs. */
static const double much_longer = 1.5;

static unsigned char choose_turn(const MidNodes *mid, OstLocal tet)
{
    double length[3];
    int shortest = 0;
    for (int turn = 0; turn < 3; turn++) {
        const double *x[2];
        for (int end = 0; end < 2; end++) { /* the middles of 02 and 13 are nodes 6 and 8 */
            const int edge = ost_tet_turn[turn][end == 0 ? 6 : 8] - 4;
            const OstLocal node = mid->mesh->node_count + mid->edges.of_tet[6 * (size_t)tet + (size_t)edge];
            x[end] = mid->coordinates + 3 * (size_t)node;
        }
        const double diagonal[3] = {x[1][0] - x[0][0], x[1][1] - x[0][1], x[1][2] - x[0][2]};
        length[turn] = ost_norm3(diagonal);
        if (length[turn] < length[shortest])
            shortest = turn;
    }
    return (unsigned char)(length[0] > much_longer * length[shortest] ? shortest : 0);
}

/* A refinement, under way. A quadratic mesh is refined by way of its linear mesh. */
typedef struct Refinement {
    const OstMesh *linear;
    const OstMesh *quadratic; /* or NULL */
    const OstShapeSurface *shape;
    unsigned char *turn;
    OstMesh *fine;
    OstLocal *origin; /* of the fine tets: parent × 8 + child */
} Refinement;

static int has_shape(const Refinement *refinement)
{
    return refinement->shape && refinement->shape->kind != OST_SURFACE_NONE;
}

/* Mid-edge nodes of the coarse quadratic mesh become vertices of the fine mesh, with their positions. */
static void take_middles(const Refinement *refinement, MidNodes *mid)
{
    const OstMesh *quadratic = refinement->quadratic;
    double *middle = mid->coordinates + 3 * (size_t)mid->mesh->node_count;
    for (OstLocal t = 0; t < quadratic->tet_count; t++) {
        for (size_t e = 0; e < 6; e++) {
            const size_t edge = (size_t)mid->edges.of_tet[6 * (size_t)t + e];
            const size_t node = (size_t)quadratic->tet_nodes[10 * (size_t)t + 4 + e];
            for (size_t d = 0; d < 3; d++)
                middle[3 * edge + d] = quadratic->coordinates[3 * node + d];
        }
    }
}

static OstStatus refine_linear(Refinement *refinement)
{
    const OstMesh *linear = refinement->linear;
    MidNodes mid = {0};
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_mid_nodes_create(linear, refinement->shape, &mid));
    if (refinement->quadratic && !has_shape(refinement))
        take_middles(refinement, &mid);
    OST_TRY_DONE(ost_agree(linear->ctx, OST_NEW(linear->ctx, &refinement->turn, linear->tet_count)));
    for (OstLocal t = 0; t < linear->tet_count; t++)
        refinement->turn[t] = choose_turn(&mid, t);
    OST_TRY_DONE(ost_mesh_divide(&mid, &refining, refinement->turn, &refinement->fine, &refinement->origin));
    if (refinement->quadratic || has_shape(refinement))
        OST_TRY_DONE(ost_check_mesh(refinement->fine, 1));
done:
    ost_mid_nodes_clear(&mid);
    return status;
}

/* The point of a quadratic tet at barycentric coordinates b. */
static void map_point(const OstMesh *quadratic, OstLocal tet, const double b[4], double x[3])
{
    for (int d = 0; d < 3; d++)
        x[d] = 0.0;
    for (int n = 0; n < 10; n++) {
        const double *node = quadratic->coordinates + 3 * (size_t)quadratic->tet_nodes[10 * (size_t)tet + (size_t)n];
        const double weight =
            n < 4 ? b[n] * (2.0 * b[n] - 1.0) : 4.0 * b[ost_tet_edge[n - 4][0]] * b[ost_tet_edge[n - 4][1]];
        for (int d = 0; d < 3; d++)
            x[d] += weight * node[d];
    }
}

/* Puts the fine mid-edge nodes on the curved coarse tets; each is computed from the tet that gave it its label. */
static void map_middles(const Refinement *refinement, MidNodes *mid)
{
    double *middle = mid->coordinates + 3 * (size_t)mid->mesh->node_count;
    for (OstLocal t = 0; t < mid->mesh->tet_count; t++) {
        const OstLocal parent = refinement->origin[t] / 8;
        const int *child = bey_tet[refinement->origin[t] % 8];
        const int *turn = ost_tet_turn[refinement->turn[parent]];
        for (int e = 0; e < 6; e++) {
            double b[2][4];
            const OstLocal edge = mid->edges.of_tet[6 * (size_t)t + (size_t)e];
            if (mid->label[mid->mesh->node_count + edge] != ost_mid_nodes_label(mid, t, e))
                continue;
            ost_tet_node_place(turn[child[ost_tet_edge[e][0]]], b[0]);
            ost_tet_node_place(turn[child[ost_tet_edge[e][1]]], b[1]);
            for (int v = 0; v < 4; v++)
                b[0][v] = 0.5 * (b[0][v] + b[1][v]);
            map_point(refinement->quadratic, parent, b[0], middle + 3 * (size_t)edge);
        }
    }
}

static OstStatus raise_fine(Refinement *refinement)
{
    MidNodes mid = {0};
    OstMesh *raised = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_mid_nodes_create(refinement->fine, refinement->shape, &mid));
    if (!has_shape(refinement))
        map_middles(refinement, &mid);
    OST_TRY_DONE(ost_mesh_raise_over(&mid, &raised));
    ost_mesh_destroy(&refinement->fine);
    refinement->fine = raised;
    OST_TRY_DONE(ost_check_folds(raised));
done:
    ost_mid_nodes_clear(&mid);
    return status;
}

OstStatus ost_mesh_refine(const OstMesh *coarse, const OstShapeSurface *shape, OstMesh **fine)
{
    Refinement refinement = {coarse, NULL, shape, NULL, NULL, NULL};
    OstMesh *skeleton = NULL;
    OstStatus status = OST_SUCCESS;
    const int is_shaped = shape && shape->kind != OST_SURFACE_NONE;
    *fine = NULL;
    ost_ledger_enter(coarse->ctx, OST_LEDGER_MESH);
    if (!is_shaped) /* which the finer mesh no longer shows */
        OST_TRY_DONE(ost_mesh_cut_off(coarse, &(OstCutOff){0}));
    if (coarse->nodes_per_tet == 10) {
        OST_TRY_DONE(ost_mesh_linear(coarse, &skeleton, NULL));
        refinement.linear = skeleton;
        refinement.quadratic = coarse;
    }
    OST_TRY_DONE(refine_linear(&refinement));
    if (refinement.quadratic)
        OST_TRY_DONE(raise_fine(&refinement));
    *fine = refinement.fine;
    if (is_shaped)
        (*fine)->cut_off = (OstCutOff){0};
    refinement.fine = NULL;
done:
    OST_FREE(refinement.turn, refinement.origin);
    ost_mesh_destroy(&refinement.fine);
    ost_mesh_destroy(&skeleton);
    ost_ledger_leave(coarse->ctx);
    return status;
}
