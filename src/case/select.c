/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/select.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "mesh/label_ranges.h"
#include "mesh/nearest.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const double relative_tolerance = 1e-6;

OstStatus ost_select_raise(const OstCase *c, const OstSelection *selection, const char *format, ...)
{
    char message[2048];
    char place[32] = "";
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    if (selection->place.line > 0)
        snprintf(place, sizeof place, ":%d:%d", selection->place.line, selection->place.column);
    return OST_RAISE(c->ctx, OST_INVALID_INPUT, "%s%s: %s", c->path, place, message);
}

static OstStatus raise_unknown_boundary(const OstCase *c, const OstMesh *mesh, const OstSelection *selection,
                                        const char *name)
{
    char list[1024];
    if (mesh->boundary_count == 0)
        return ost_select_raise(c, selection,
                                "there is no boundary '%.80s': the mesh has none; select by plane, box, "
                                "sphere, cylinder, vertices or nearest",
                                name);
    const char *nearest = NULL;
    const char **names = NULL;
    OST_TRY(OST_NEW(c->ctx, &names, mesh->boundary_count));
    for (int b = 0; b < mesh->boundary_count; b++)
        names[b] = mesh->boundaries[b].name;
    nearest = ost_nearest_word(name, names, mesh->boundary_count);
    OST_FREE(names);
    ost_mesh_list_boundaries(mesh, list, sizeof list);
    return ost_select_raise(c, selection, "there is no boundary '%.80s'%s%s%s The mesh has: %s", name,
                            nearest ? "; did you mean '" : ".", nearest ? nearest : "", nearest ? "'?" : "", list);
}

OstStatus ost_raise_no_region(const OstCase *c, OstPlace place, const OstNames *regions, const char *name)
{
    char list[1024];
    const char **words = NULL;
    OST_TRY(OST_NEW(c->ctx, &words, (size_t)regions->count + 1));
    for (int r = 0; r < regions->count; r++)
        words[r] = regions->name[r];
    words[regions->count] = "all";
    const char *nearest = ost_nearest_word(name, words, regions->count + 1);
    OST_FREE(words);
    ost_names_list(regions, list, sizeof list);
    return OST_RAISE(c->ctx, OST_INVALID_INPUT,
                     "%s:%d:%d: the mesh has no region '%.80s'%s%s%s It has: %s. 'all' stands for every one", c->path,
                     place.line, place.column, name, nearest ? "; did you mean '" : ".", nearest ? nearest : "",
                     nearest ? "'?" : "", list);
}

OstStatus ost_select_check_names(const OstCase *c, const OstMesh *mesh, const OstSelection *selection)
{
    for (int n = 0; n < selection->boundaries.count; n++)
        if (ost_mesh_find_boundary(mesh, selection->boundaries.name[n]) < 0)
            return raise_unknown_boundary(c, mesh, selection, selection->boundaries.name[n]);
    return OST_SUCCESS;
}

int ost_selection_names(const OstSelection *selection, const char *boundary)
{
    for (int n = 0; n < selection->boundaries.count; n++)
        if (strcmp(selection->boundaries.name[n], boundary) == 0)
            return 1;
    return 0;
}

static OstStatus flag_boundaries(const OstCase *c, const OstMesh *mesh, const OstSelection *selection,
                                 unsigned char *flags)
{
    OST_TRY(ost_select_check_names(c, mesh, selection));
    for (int b = 0; b < mesh->boundary_count; b++) {
        const OstBoundary *boundary = &mesh->boundaries[b];
        if (!ost_selection_names(selection, boundary->name))
            continue;
        const size_t count = (size_t)boundary->count * (size_t)boundary->nodes_per_item;
        for (size_t i = 0; i < count; i++)
            flags[boundary->nodes[i]] = 1;
    }
    return OST_SUCCESS;
}

/* Is a point in the shape? `d` is its position relative to the shape's point. */
static int is_inside(const OstSelection *selection, const double d[3], double tolerance)
{
    const double *direction = selection->direction;
    const double along = ost_dot3(d, direction);
    double distance = 0.0;
    switch (selection->kind) {
    case OST_SELECT_PLANE:
        return fabs(along) <= tolerance;
    case OST_SELECT_BOX:
        for (int i = 0; i < 3; i++)
            if (d[i] < -tolerance || d[i] > direction[i] - selection->point[i] + tolerance)
                return 0;
        return 1;
    case OST_SELECT_SPHERE:
        return ost_norm3(d) <= selection->radii[1] + tolerance;
    case OST_SELECT_CYLINDER:
        distance = ost_norm3(
            (double[]){d[0] - along * direction[0], d[1] - along * direction[1], d[2] - along * direction[2]});
        return distance >= selection->radii[0] - tolerance && distance <= selection->radii[1] + tolerance;
    default:
        return 1;
    }
}

static OstStatus flag_shape(const OstMesh *mesh, const OstSelection *selection, unsigned char *flags)
{
    double tolerance = selection->tolerance;
    if (tolerance < 0.0) {
        double low[3], high[3];
        OST_TRY(ost_mesh_bounds(mesh, low, high));
        const double diagonal[3] = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
        tolerance = relative_tolerance * ost_norm3(diagonal);
    }
    for (OstLocal n = 0; n < mesh->owned_nodes; n++) {
        double d[3];
        for (int i = 0; i < 3; i++)
            d[i] = mesh->coordinates[3 * (size_t)n + (size_t)i] - selection->point[i];
        flags[n] = (unsigned char)is_inside(selection, d, tolerance);
    }
    return OST_SUCCESS;
}

OstStatus ost_select_check_place(const OstCase *c, const OstMesh *mesh, const OstSelection *selection)
{
    double shortest = 0.0, longest = 0.0;
    OstNearest vertex;
    if (selection->kind != OST_SELECT_NEAREST)
        return OST_SUCCESS;
    OST_TRY(ost_mesh_nearest(mesh, selection->point, &vertex));
    OST_TRY(ost_mesh_edges_at(mesh, &vertex, &shortest, &longest));
    if (vertex.distance > longest)
        ost_warn(c->ctx,
                 "%s:%d:%d: the vertex nearest to (%g, %g, %g) is at (%g, %g, %g), %g away; the edges there are no "
                 "longer than %g",
                 c->path, selection->place.line, selection->place.column, selection->point[0], selection->point[1],
                 selection->point[2], vertex.at[0], vertex.at[1], vertex.at[2], vertex.distance, longest);
    return OST_SUCCESS;
}

/* Is a label of the range first to last missing, over all ranks? */
static OstStatus is_missing(const OstMesh *mesh, OstGlobal first, OstGlobal last, int *missing)
{
    OstGlobal found = 0;
    for (OstLocal n = 0; n < mesh->owned_nodes; n++)
        found += ost_mesh_node_number(mesh, n) >= first && ost_mesh_node_number(mesh, n) <= last;
    OST_TRY(ost_sum_numbers(mesh->ctx, 1, &found));
    *missing = found < last - first + 1;
    return OST_SUCCESS;
}

/* The first label of a range that no vertex has, if there is one, by bisection. */
static OstStatus first_missing(const OstMesh *mesh, OstLabelRange range, OstGlobal *label)
{
    OstGlobal low = range.first, high = range.last;
    while (low < high) {
        const OstGlobal middle = low + (high - low) / 2;
        int missing = 0;
        OST_TRY(is_missing(mesh, range.first, middle, &missing));
        *(missing ? &high : &low) = missing ? middle : middle + 1;
    }
    *label = low;
    return OST_SUCCESS;
}

/* `found`: vertices in each range, over all ranks. */
static OstStatus check_all_found(const OstCase *c, const OstMesh *mesh, const OstSelection *selection,
                                 const OstGlobal *found)
{
    const OstLabelRange *range = selection->ranges;
    const OstGlobal listed = ost_ranges_total(selection->range_count, range);
    OstGlobal missing = listed, label = 0, first = 0;
    for (OstGlobal i = 0; i < selection->range_count; i++)
        missing -= found[i];
    if (missing == 0)
        return OST_SUCCESS;
    while (found[first] == range[first].last - range[first].first + 1)
        first++;
    OST_TRY(first_missing(mesh, range[first], &label));
    return ost_select_raise(c, selection, "%lld of %lld listed vertices are not in the mesh, the first is %lld",
                            (long long)missing, (long long)listed, (long long)label);
}

static OstStatus flag_labels(const OstCase *c, const OstMesh *mesh, const OstSelection *selection, unsigned char *flags)
{
    OstContext *ctx = mesh->ctx;
    OstGlobal *found = NULL;
    OstStatus status = OST_NEW(ctx, &found, selection->range_count);
    OST_TRY_DONE(ost_agree(ctx, status));
    for (OstLocal n = 0; n < mesh->owned_nodes; n++) {
        const OstGlobal range =
            ost_ranges_find(selection->range_count, selection->ranges, ost_mesh_node_number(mesh, n));
        flags[n] = range >= 0;
        if (range >= 0)
            found[range]++;
    }
    OST_TRY_DONE(ost_sum_numbers(ctx, (int)selection->range_count, found));
    status = check_all_found(c, mesh, selection, found);
done:
    OST_FREE(found);
    return status;
}

OstStatus ost_select_flags(const OstCase *c, const OstMesh *mesh, const OstSelection *selection, unsigned char **flags)
{
    OstContext *ctx = mesh->ctx;
    OstStatus status = OST_SUCCESS;
    OstNearest vertex;
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, flags, mesh->node_count)));
    switch (selection->kind) {
    case OST_SELECT_BOUNDARY:
        status = flag_boundaries(c, mesh, selection, *flags);
        break;
    case OST_SELECT_VERTICES:
        status = flag_labels(c, mesh, selection, *flags);
        break;
    case OST_SELECT_NEAREST:
        status = ost_mesh_nearest(mesh, selection->point, &vertex);
        if (status == OST_SUCCESS && vertex.node >= 0)
            (*flags)[vertex.node] = 1;
        break;
    default:
        status = flag_shape(mesh, selection, *flags);
        break;
    }
    OST_TRY_DONE(ost_agree(ctx, status));
    status = ost_agree(ctx, ost_halo_import(mesh->halo, sizeof **flags, *flags));
done:
    if (status != OST_SUCCESS)
        OST_FREE(*flags);
    return status;
}

static OstStatus raise_nothing(const OstCase *c, const OstMesh *mesh, const OstSelection *selection)
{
    double low[3], high[3];
    if (selection->kind == OST_SELECT_BOUNDARY)
        return ost_select_raise(c, selection,
                                "boundary '%.80s' holds no vertex of the body: what the mesh file puts into it lies "
                                "on no tet; `orthostat mesh FILE` lists all boundaries with their areas",
                                selection->boundaries.name[0]);
    OST_TRY(ost_mesh_bounds(mesh, low, high));
    return ost_select_raise(c, selection,
                            "the selection holds no vertex; the body reaches from (%g, %g, %g) to (%g, %g, "
                            "%g)",
                            low[0], low[1], low[2], high[0], high[1], high[2]);
}

static OstStatus list_nodes(const OstMesh *mesh, const unsigned char *flags, OstLocal *count, OstLocal **nodes)
{
    *count = 0;
    for (OstLocal n = 0; n < mesh->node_count; n++)
        *count += flags[n];
    OST_TRY(OST_NEW(mesh->ctx, nodes, *count));
    for (OstLocal n = 0, k = 0; n < mesh->node_count; n++)
        if (flags[n])
            (*nodes)[k++] = n;
    return OST_SUCCESS;
}

OstStatus ost_select_nodes(const OstCase *c, const OstMesh *mesh, const OstSelection *selection, OstLocal *count,
                           OstLocal **nodes)
{
    OstContext *ctx = mesh->ctx;
    unsigned char *flags = NULL;
    OstGlobal selected = 0;
    *count = 0;
    *nodes = NULL;
    ost_ledger_enter(ctx, OST_LEDGER_SELECTION);
    OstStatus status = ost_select_flags(c, mesh, selection, &flags);
    if (status != OST_SUCCESS)
        goto done;
    for (OstLocal n = 0; n < mesh->owned_nodes; n++)
        selected += flags[n];
    OST_TRY_DONE(ost_sum_numbers(ctx, 1, &selected));
    if (selected == 0)
        OST_TRY_DONE(raise_nothing(c, mesh, selection));
    OST_TRY_DONE(ost_agree(ctx, list_nodes(mesh, flags, count, nodes)));
done:
    OST_FREE(flags);
    if (status != OST_SUCCESS)
        OST_FREE(*nodes);
    ost_ledger_leave(ctx);
    return status;
}

/* --- on finer meshes --- */

/* A vertex further from the stated point than this share of an edge is worth a warning. */
static const double near_enough = 0.1;

int ost_selection_varies(const OstSelection *on)
{
    return on->kind == OST_SELECT_BOX || on->kind == OST_SELECT_SPHERE || on->kind == OST_SELECT_CYLINDER;
}

OstStatus ost_place_at_vertex(const OstMesh *mesh, OstSelection *on)
{
    OstNearest vertex;
    if (on->kind != OST_SELECT_NEAREST)
        return OST_SUCCESS;
    OST_TRY(ost_mesh_nearest(mesh, on->point, &vertex));
    memcpy(on->point, vertex.at, sizeof vertex.at);
    return OST_SUCCESS;
}

OstStatus ost_watch_place(const OstMesh *mesh, OstWatch *watch)
{
    if (watch->kind != OST_WATCH_DISPLACEMENT)
        return OST_SUCCESS;
    double *place = watch->on.point;
    double edge = 0.0, longest = 0.0;
    OstNearest vertex;
    OST_TRY(ost_mesh_nearest(mesh, place, &vertex));
    OST_TRY(ost_mesh_edges_at(mesh, &vertex, &edge, &longest));
    if (vertex.distance > near_enough * edge)
        ost_warn(mesh->ctx,
                 "'%s' is taken at (%g, %g, %g), the vertex nearest to (%g, %g, %g); the edges there are %g "
                 "long",
                 watch->name, vertex.at[0], vertex.at[1], vertex.at[2], place[0], place[1], place[2], edge);
    memcpy(place, vertex.at, sizeof vertex.at);
    return OST_SUCCESS;
}
