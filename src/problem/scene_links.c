/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/scene_links.h"

#include "assembly/links/face_search.h"
#include "assembly/spread.h"
#include "case/select.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "mesh/periods.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double identity[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};

/* Of the body's diagonal: how far a tied vertex may be from its faces. */
static const double tied_within = 1e-3;

/* Of a face: a vertex farther away is the end of a lever, whose weights change as it turns. */
static const double most_gap = 1e-6;

/* A weight below this is rounding. */
static const double no_weight = 1e-12;

static OstStatus raise_at(const OstScene *scene, const OstConstraint *constraint, OstStatus status)
{
    const OstCase *c = scene->c;
    char text[OST_ERROR_TEXT_SIZE];
    if (status == OST_SUCCESS || strncmp(ost_error_text(c->ctx), c->path, strlen(c->path)) == 0)
        return status;
    snprintf(text, sizeof text, "%s", ost_error_text(c->ctx));
    return OST_RAISE(c->ctx, status, "%s:%d: %s", c->path, constraint->line, text);
}

static OstStatus find_diagonal(const OstMesh *mesh, double *diagonal)
{
    double low[3], high[3];
    OST_TRY(ost_mesh_bounds(mesh, low, high));
    const double side[3] = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
    *diagonal = ost_norm3(side);
    return OST_SUCCESS;
}

/* --- rigid faces --- */

/* The two lowest of the selected nodes, over all ranks. */
static OstStatus find_carriers(const OstMesh *mesh, OstLocal count, const OstLocal *nodes, OstGlobal lowest[2])
{
    for (int k = 0; k < 2; k++) {
        lowest[k] = INT64_MAX;
        for (OstLocal i = 0; i < count; i++)
            if (nodes[i] < mesh->owned_nodes && mesh->node_number[nodes[i]] < lowest[k] &&
                (k == 0 || mesh->node_number[nodes[i]] > lowest[0]))
                lowest[k] = mesh->node_number[nodes[i]];
        OST_TRY(ost_min_numbers(mesh->ctx, 1, &lowest[k]));
    }
    return OST_SUCCESS;
}

/* The face's point and a length of the size of the arms about it. Where nothing is given of its displacement, its
 * middle is as good a point, and nodes beside the face move nearly as it does where it turns far in one step. */
static OstStatus find_point(const OstMesh *mesh, OstLocal count, const OstLocal *nodes, OstRigidFace *face)
{
    const int is_given = face->constrained[0] || face->constrained[1] || face->constrained[2];
    double sums[5] = {0.0};
    for (OstLocal i = 0; i < count; i++)
        for (size_t c = 0; c < 3 && nodes[i] < mesh->owned_nodes; c++) {
            const double arm = mesh->coordinates[3 * (size_t)nodes[i] + c] - face->point[c];
            sums[c] += arm;
            sums[3] += arm * arm;
            sums[4] += 1.0 / 3.0;
        }
    OST_TRY(ost_sum(mesh->ctx, 5, sums));
    for (int c = 0; c < 3 && !is_given; c++) {
        face->point[c] += sums[c] / sums[4];
        sums[3] -= sums[c] * sums[c] / sums[4];
    }
    face->length = sums[3] > 0.0 ? sqrt(sums[3] / sums[4]) : 1.0;
    return OST_SUCCESS;
}

/* A selection on one line can turn about it without moving: there would be nothing to resist that. */
static OstStatus check_extent(const OstMesh *mesh, OstLocal count, const OstLocal *nodes)
{
    for (int k = 0; k < 3; k++) {
        OstResultant unit = {.moment = {k == 0, k == 1, k == 2}};
        OstSpread spread;
        if (ost_spread_over_vertices(mesh, count, nodes, &unit, &spread) != OST_SUCCESS)
            return OST_RAISE(mesh->ctx, OST_INVALID_INPUT,
                             "a rigid face needs three vertices that are not on one line; select more");
    }
    return OST_SUCCESS;
}

/* W of one node for the point's displacement, and for its rotation times `length`; what is prescribed goes to the
 * offset. */
static void make_weights(const OstRigidFace *face, const double arm[3], double weights[2][9], double offset[3])
{
    ost_cross3(face->given + 3, arm, offset);
    memset(weights, 0, 2 * sizeof *weights);
    ost_rigid_face_weight(face, arm, weights[1]);
    for (int k = 0; k < 3; k++) {
        offset[k] += face->given[k];
        weights[0][4 * k] = face->constrained[k] ? 0.0 : 1.0;
    }
}

static OstStatus link_face(const OstRigidFace *face, OstLocal count, const OstLocal *nodes, OstLinks *links)
{
    const OstMesh *mesh = links->mesh;
    links->of_face = links->face_count;
    for (OstLocal i = 0; i < count; i++) {
        const double *x = mesh->coordinates + 3 * (size_t)nodes[i];
        const double arm[3] = {x[0] - face->point[0], x[1] - face->point[1], x[2] - face->point[2]};
        double weights[2][9], offset[3];
        OstLeader leader[2];
        int leaders = 0;
        if (nodes[i] >= mesh->owned_nodes)
            continue;
        make_weights(face, arm, weights, offset);
        for (int k = 0; k < 2; k++) {
            if (face->carrier[k] < 0)
                continue;
            leader[leaders].number = face->carrier[k];
            memcpy(leader[leaders++].weight, weights[k], sizeof weights[k]);
        }
        OST_TRY(ost_links_add(links, nodes[i], leaders, leader, x, offset));
    }
    return OST_SUCCESS;
}

static int all_of(const int constrained[3])
{
    return constrained[0] && constrained[1] && constrained[2];
}

static OstStatus add_rigid(const OstScene *scene, const OstConstraint *constraint, double factor, OstLinks *links)
{
    OstRigidFace face = {.carrier = {-1, -1}, .by_vector = ost_constraint_gives_part(constraint)};
    OstGlobal lowest[2];
    OstLocal count = 0;
    OstLocal *nodes = NULL;
    memcpy(face.point, constraint->point, sizeof face.point);
    memcpy(face.constrained, constraint->constrained, sizeof constraint->constrained);
    memcpy(face.constrained + 3, constraint->turn_constrained, sizeof constraint->turn_constrained);
    for (int k = 0; k < 3; k++) {
        face.given[k] = factor * constraint->displacement[k];
        face.given[3 + k] = factor * constraint->rotation[k];
    }
    OST_TRY(ost_select_nodes(scene->c, scene->mesh, &constraint->on, &count, &nodes));
    OstStatus status = check_extent(scene->mesh, count, nodes);
    OST_THEN(find_carriers(scene->mesh, count, nodes, lowest));
    OST_THEN(find_point(scene->mesh, count, nodes, &face));
    if (status == OST_SUCCESS) {
        face.first = lowest[0];
        face.carrier[0] = all_of(constraint->constrained) ? -1 : lowest[0];
        face.carrier[1] = all_of(constraint->turn_constrained) ? -1 : lowest[1];
        status = link_face(&face, count, nodes, links);
        OST_THEN(ost_links_add_face(links, &face));
        links->of_face = -1;
        status = ost_agree(scene->ctx, status);
    }
    OST_FREE(nodes);
    return status;
}

/* --- tied faces --- */

static double largest_of(const double weight[9])
{
    double largest = 0.0;
    for (int i = 0; i < 9; i++)
        largest = fmax(largest, fabs(weight[i]));
    return largest;
}

/* Each vertex of a quadratic face takes half of what the middles of its sides have. */
static void add_corners(const OstFacePoint *found, OstLinks *links)
{
    enum { CORNERS = 3 };
    OstGlobal corner[CORNERS];
    double weight[CORNERS][9];
    int count = 0;
    for (int v = 0; v < CORNERS; v++) {
        for (int i = 0; i < 9; i++)
            weight[count][i] = found->weight[v][i] +
                               0.5 * (found->weight[CORNERS + v][i] + found->weight[CORNERS + (v + 2) % CORNERS][i]);
        if (largest_of(weight[count]) >= no_weight)
            corner[count++] = found->number[v];
    }
    ost_links_add_corners(links, count, corner, (const double(*)[9])weight);
}

/* Counts the node in *follows where it follows a face. */
static OstStatus tie_node(const OstScene *scene, const OstFaceSearch *search, double within, OstLocal node,
                          OstLinks *links, OstGlobal *follows)
{
    static const double nothing[3] = {0.0};
    const double *x = scene->mesh->coordinates + 3 * (size_t)node;
    OstFacePoint found;
    OstLeader leader[OST_MOST_LEADERS];
    OstLever lever = {.node = node};
    int leaders = 0;
    ost_face_search_nearest(search, x, &found);
    if (!(found.distance <= within))
        return OST_RAISE(scene->ctx, OST_INVALID_INPUT,
                         "vertex %lld at (%g, %g, %g) is %.3g away from the faces that it is tied to; allow for that, "
                         "as in tolerance: %.2g, or select fewer vertices",
                         (long long)ost_mesh_node_number(scene->mesh, node), x[0], x[1], x[2], found.distance,
                         1.1 * found.distance);
    for (int k = 0; k < found.count; k++) {
        if (found.number[k] == scene->mesh->node_number[node]) /* on both sides already */
            return OST_SUCCESS;
        if (largest_of(found.weight[k]) < no_weight)
            continue;
        leader[leaders].number = found.number[k];
        lever.share[leaders] = found.share[k];
        memcpy(lever.slope[leaders], found.slope[k], sizeof found.slope[k]);
        memcpy(leader[leaders++].weight, found.weight[k], sizeof found.weight[k]);
    }
    (*follows)++;
    lever.across = found.across;
    OST_TRY(ost_links_add(links, node, leaders, leader, x, nothing));
    if (found.gap > most_gap)
        return ost_links_add_lever(links, &lever);
    if (found.count == OST_MOST_LEADERS)
        add_corners(&found, links);
    return OST_SUCCESS;
}

static OstStatus add_tie(const OstScene *scene, const OstConstraint *constraint, OstLinks *links)
{
    OstFaceSearch *search = NULL;
    OstLocal count = 0, face_count = 0;
    OstLocal *nodes = NULL, *faces = NULL;
    OstGlobal follows = 0;
    int nodes_per_face = 3;
    double within = constraint->tolerance, diagonal = 0.0;
    OstStatus status = find_diagonal(scene->mesh, &diagonal);
    within = within < 0.0 ? tied_within * diagonal : within;
    OST_THEN(ost_select_nodes(scene->c, scene->mesh, &constraint->on, &count, &nodes));
    OST_THEN(ost_select_faces(scene->c, scene->mesh, &constraint->to, &face_count, &nodes_per_face, &faces));
    OST_THEN(ost_face_search_create(scene->mesh, face_count, faces, nodes_per_face, &search));
    for (OstLocal i = 0; i < count && status == OST_SUCCESS; i++)
        if (nodes[i] < scene->mesh->owned_nodes)
            status = tie_node(scene, search, within, nodes[i], links, &follows);
    status = ost_agree(scene->ctx, status);
    OST_THEN(ost_sum_numbers(scene->ctx, 1, &follows));
    if (status == OST_SUCCESS && follows == 0)
        ost_warn(scene->ctx,
                 "%s:%d: this tie joins nothing: each selected vertex is one of the faces of tied_to; leave it out, or "
                 "name the faces of the other part",
                 scene->c->path, constraint->line);
    ost_face_search_destroy(&search);
    OST_FREE(nodes, faces);
    return status;
}

/* --- periodic pairs --- */

static OstStatus find_periods(const OstScene *scene, const OstConstraint *constraint, OstPeriods **periods)
{
    OstPeriodicPair pair[3];
    for (int p = 0; p < constraint->pair_count; p++) {
        const OstSelection on = {.kind = OST_SELECT_BOUNDARY,
                                 .boundaries = {2, (char **)constraint->pair[p]},
                                 .place = {constraint->line, 1}};
        OST_TRY(ost_select_check_names(scene->c, scene->mesh, &on));
        pair[p] = (OstPeriodicPair){constraint->pair[p][0], constraint->pair[p][1]};
    }
    return ost_periods_create(scene->mesh, constraint->pair_count, pair, periods);
}

/* A follower of several pairs, on an edge or a corner of the cell, is as many periods away from its leader. */
static OstStatus link_periodic(const OstPeriods *periods, const OstConstraint *constraint, OstLocal node, double factor,
                               OstLinks *links)
{
    static const int place[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
    const OstMesh *mesh = periods->mesh;
    const double *x = periods->place + 3 * (size_t)node;
    double target[3], strain[9], offset[3];
    ost_periods_back(periods, periods->follows[node], x, target);
    const double away[3] = {x[0] - target[0], x[1] - target[1], x[2] - target[2]};
    const OstPeriodicNode *leads = ost_periods_find(periods, target);
    if (!leads || leads->follows)
        return OST_RAISE(
            mesh->ctx, OST_INVALID_INPUT,
            "vertex %lld at (%g, %g, %g) has no counterpart at (%g, %g, %g): both boundaries of a periodic "
            "pair need the same mesh",
            (long long)ost_mesh_node_number(mesh, node), x[0], x[1], x[2], target[0], target[1], target[2]);
    for (int i = 0; i < 9; i++)
        strain[i] = factor * constraint->strain[place[i]];
    ost_apply3(strain, away, offset);
    OstLeader leader = {.number = leads->number};
    memcpy(leader.weight, identity, sizeof identity);
    OST_TRY(ost_links_add(links, node, 1, &leader, leads->at, offset));
    if (mesh->nodes_per_tet == 10)
        ost_links_add_corners(links, 1, &leader.number, (const double(*)[9]) & leader.weight);
    return OST_SUCCESS;
}

static OstStatus add_periodic(const OstScene *scene, const OstConstraint *constraint, double factor, OstLinks *links)
{
    OstPeriods *periods = NULL;
    links->periodic = 1;
    OstStatus status = find_periods(scene, constraint, &periods);
    for (OstLocal n = 0; status == OST_SUCCESS && n < scene->mesh->owned_nodes; n++)
        if (periods->follows[n])
            status = link_periodic(periods, constraint, n, factor, links);
    ost_periods_destroy(&periods);
    return ost_agree(scene->ctx, status);
}

/* --- all of them --- */

static OstStatus add(const OstScene *scene, const OstConstraint *constraint, int table, OstLinks *links)
{
    const OstEffect effect = constraint->kind == OST_CONSTRAIN_RIGID  ? OST_EFFECT_RIGID_FACE
                             : constraint->kind == OST_CONSTRAIN_TIED ? OST_EFFECT_TIE
                                                                      : OST_EFFECT_PERIODIC;
    const double factor = constraint->table == table ? 1.0 : 0.0;
    OstStatus status;
    ost_ledger_enter(scene->ctx, effect);
    if (constraint->kind == OST_CONSTRAIN_RIGID)
        status = add_rigid(scene, constraint, factor, links);
    else if (constraint->kind == OST_CONSTRAIN_TIED)
        status = add_tie(scene, constraint, links);
    else
        status = add_periodic(scene, constraint, factor, links);
    ost_ledger_leave(scene->ctx);
    return raise_at(scene, constraint, status);
}

OstStatus ost_scene_links(const OstScene *scene, int table, OstSupports *supports)
{
    const OstCase *c = scene->c;
    int any = 0;
    for (int i = 0; i < c->constraint_count; i++)
        any |= ost_constraint_links(&c->constraints[i]);
    if (!any)
        return OST_SUCCESS;
    OST_TRY(ost_agree(scene->ctx, ost_links_create(scene->mesh, &supports->links)));
    supports->links->path = c->path;
    for (int i = 0; i < c->constraint_count; i++) {
        supports->links->line = c->constraints[i].line;
        supports->links->between_meshes = c->constraints[i].kind == OST_CONSTRAIN_TIED;
        if (ost_constraint_links(&c->constraints[i]))
            OST_TRY(add(scene, &c->constraints[i], table, supports->links));
    }
    return OST_SUCCESS;
}
