/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/mesh_report.h"

#include "core/error.h"
#include "core/json_file.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "element/element.h"
#include "mesh/coincident.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* --- counting --- */

void ost_mesh_report_clear(OstMeshReport *counts)
{
    OST_FREE(counts->region_tets, counts->region_volume, counts->boundary_items, counts->boundary_area);
    ost_components_destroy(&counts->components);
}

static OstStatus make_room(const OstMesh *mesh, OstMeshReport *counts)
{
    OST_TRY(OST_NEW(mesh->ctx, &counts->region_tets, mesh->regions.count));
    OST_TRY(OST_NEW(mesh->ctx, &counts->region_volume, mesh->regions.count));
    OST_TRY(OST_NEW(mesh->ctx, &counts->boundary_items, mesh->boundary_count));
    return OST_NEW(mesh->ctx, &counts->boundary_area, mesh->boundary_count);
}

static void count_edges(const OstMesh *mesh, OstLocal tet, OstMeshReport *counts)
{
    const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
    for (int e = 0; e < 6; e++) {
        const double *a = mesh->coordinates + 3 * (size_t)nodes[ost_tet_edge[e][0]];
        const double *b = mesh->coordinates + 3 * (size_t)nodes[ost_tet_edge[e][1]];
        const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
        counts->shortest = fmin(counts->shortest, ost_norm3(d));
        counts->longest = fmax(counts->longest, ost_norm3(d));
    }
}

/* Edges may be curved. */
static void count_tet(const OstMesh *mesh, OstLocal tet, OstMeshReport *counts)
{
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
    double x[3 * OST_MAX_TET_NODES];
    ost_gather3(element->nodes, nodes, mesh->coordinates, x);
    const double volume = element->volume(x), quality = ost_tet_quality(mesh->coordinates, nodes);
    const int bin = (int)(quality * OST_QUALITY_BINS);
    counts->volume += volume;
    counts->region_tets[mesh->tet_region[tet]]++;
    counts->region_volume[mesh->tet_region[tet]] += volume;
    counts->mean_quality += quality / (double)mesh->global_tets;
    counts->bins[bin < 0 ? 0 : bin >= OST_QUALITY_BINS ? OST_QUALITY_BINS - 1 : bin]++;
    if (quality < counts->least_quality ||
        (quality == counts->least_quality && ost_mesh_tet_number(mesh, tet) < counts->worst_tet)) {
        counts->least_quality = quality;
        counts->worst_tet = ost_mesh_tet_number(mesh, tet);
    }
    count_edges(mesh, tet, counts);
}

/* Of a face of 3 or 6 nodes. */
static double area_of(const OstMesh *mesh, int count, const OstGlobal *nodes)
{
    const OstElement *element = ost_element_of(count == 6 ? 10 : 4);
    double x[3 * OST_MAX_FACE_NODES], area[OST_MAX_FACE_NODES], vectors[3 * OST_MAX_FACE_NODES], sum = 0.0;
    for (int n = 0; n < count; n++)
        memcpy(x + 3 * n, mesh->coordinates + 3 * nodes[n], 3 * sizeof *x);
    element->node_areas(x, area, vectors);
    for (int n = 0; n < count; n++)
        sum += area[n];
    return sum;
}

static void count_boundary(const OstMesh *mesh, int number, OstMeshReport *counts)
{
    const OstBoundary *boundary = &mesh->boundaries[number];
    for (OstLocal i = 0; i < boundary->count; i++) {
        const OstGlobal *nodes = boundary->nodes + (size_t)i * (size_t)boundary->nodes_per_item;
        if (!ost_mesh_owns(mesh, boundary->nodes_per_item, nodes))
            continue;
        counts->boundary_items[number]++;
        if (boundary->dimension == 2)
            counts->boundary_area[number] += area_of(mesh, boundary->nodes_per_item, nodes);
    }
}

static OstStatus add_up(const OstMesh *mesh, OstMeshReport *counts)
{
    OstContext *ctx = mesh->ctx;
    const double mine = counts->least_quality;
    OST_TRY(ost_sum(ctx, 1, &counts->volume));
    OST_TRY(ost_sum(ctx, 1, &counts->mean_quality));
    OST_TRY(ost_min(ctx, 1, &counts->shortest));
    OST_TRY(ost_max(ctx, 1, &counts->longest));
    OST_TRY(ost_min(ctx, 1, &counts->least_quality));
    counts->worst_tet = mine > counts->least_quality ? INT64_MAX : counts->worst_tet;
    OST_TRY(ost_min_numbers(ctx, 1, &counts->worst_tet));
    OST_TRY(ost_sum_numbers(ctx, OST_QUALITY_BINS, counts->bins));
    OST_TRY(ost_sum_numbers(ctx, mesh->regions.count, counts->region_tets));
    OST_TRY(ost_sum(ctx, mesh->regions.count, counts->region_volume));
    OST_TRY(ost_sum_numbers(ctx, mesh->boundary_count, counts->boundary_items));
    return ost_sum(ctx, mesh->boundary_count, counts->boundary_area);
}

OstStatus ost_mesh_report_make(const OstMesh *mesh, OstMeshReport *counts)
{
    *counts = (OstMeshReport){.shortest = DBL_MAX, .least_quality = DBL_MAX, .worst_tet = INT64_MAX};
    OST_TRY(ost_agree(mesh->ctx, make_room(mesh, counts)));
    for (OstLocal t = 0; t < mesh->owned_tets; t++)
        count_tet(mesh, t, counts);
    for (int b = 0; b < mesh->boundary_count; b++)
        count_boundary(mesh, b, counts);
    OST_TRY(add_up(mesh, counts));
    OST_TRY(ost_mesh_bounds(mesh, counts->low, counts->high));
    OST_TRY(ost_mesh_surface_faces(mesh, &counts->surface_faces));
    OST_TRY(ost_mesh_cut_off(mesh, &counts->cut_off));
    OST_TRY(ost_mesh_find_misfits(mesh, NULL, &counts->misfits));
    OST_TRY(ost_mesh_count_coincident(mesh, NULL, &counts->coincident, &counts->tolerance));
    return ost_components_create(mesh, &counts->components);
}

/* --- telling --- */

enum { BAR = 40, MOST_PARTS = 20 };

static const char *const items[] = {"points", "curves", "faces"};

static void print_histogram(const OstMesh *mesh, const OstMeshReport *counts)
{
    char cell[64] = "";
    OstGlobal most = 1;
    for (int b = 0; b < OST_QUALITY_BINS; b++)
        most = counts->bins[b] > most ? counts->bins[b] : most;
    puts("\nQuality of the tets (1: regular, 0: flat)");
    for (int b = 0; b < OST_QUALITY_BINS; b++) {
        const int length = counts->bins[b] == 0 ? 0 : 1 + (int)((BAR - 1) * counts->bins[b] / most);
        printf("  %.1f to %.1f %12lld  %.*s\n", 0.1 * b, 0.1 * (b + 1), (long long)counts->bins[b], length,
               "########################################");
    }
    if (mesh->of_cells)
        snprintf(cell, sizeof cell, " of element %lld", (long long)ost_cell_label(1, counts->worst_tet));
    printf("  least %.3g (tet %lld%s), mean %.3g\n", counts->least_quality, (long long)counts->worst_tet, cell,
           counts->mean_quality);
}

static void print_parts(const OstMeshReport *counts)
{
    const OstComponents *parts = counts->components;
    if (parts->count > 1)
        printf("\nConnected components: %d, which hold each other at most by edges and vertices\n", parts->count);
    for (OstLocal c = 0; c < parts->count && parts->count > 1 && c < MOST_PARTS; c++) {
        const OstComponent *part = &parts->component[c];
        printf("  %12lld tets from (%g, %g, %g) to (%g, %g, %g)\n", (long long)part->tets, part->low[0], part->low[1],
               part->low[2], part->high[0], part->high[1], part->high[2]);
    }
    if (parts->count > MOST_PARTS)
        printf("  and %d more\n", parts->count - MOST_PARTS);
    if (counts->coincident > 0)
        printf("\n%lld vertices lie where others are; --merge %g joins them\n", (long long)counts->coincident,
               counts->tolerance);
}

static void print_misfits(const OstMesh *mesh, const OstMisfits *misfits)
{
    char cells[2][OST_CELL_WORDS];
    if (misfits->faces > 0)
        printf("\n%lld faces lie on faces of others without fitting them, from (%g, %g, %g) to (%g, %g, %g), as of\n"
               "  tet %lld%s on tet %lld%s\n",
               (long long)misfits->faces, misfits->low[0], misfits->low[1], misfits->low[2], misfits->high[0],
               misfits->high[1], misfits->high[2], (long long)misfits->tet,
               ost_cell_words(mesh, misfits->tet, cells[0]), (long long)misfits->neighbour,
               ost_cell_words(mesh, misfits->neighbour, cells[1]));
}

static void print_cut_off(const OstMeshReport *counts)
{
    static const double least = 5e-4;
    const OstCutOff *cut_off = &counts->cut_off;
    if (fmax(cut_off->lacking, cut_off->filled) > least)
        printf("  its faces cut off %.2g %% of the volume, and add %.2g %% in hollows, if the surface is meant to be "
               "curved where they meet at less than 40 degrees\n",
               100.0 * cut_off->lacking, 100.0 * cut_off->filled);
}

void ost_mesh_report_print(const OstMesh *mesh, const OstMeshReport *counts, const char *path)
{
    printf("%s: %lld %s tets, %lld nodes, %.0f faces on the surface\n", path, (long long)mesh->global_tets,
           mesh->nodes_per_tet == 10 ? "quadratic" : "linear", (long long)mesh->global_nodes, counts->surface_faces);
    printf("  from (%g, %g, %g) to (%g, %g, %g), volume %g, edges %g to %g\n", counts->low[0], counts->low[1],
           counts->low[2], counts->high[0], counts->high[1], counts->high[2], counts->volume, counts->shortest,
           counts->longest);
    print_cut_off(counts);
    puts("\nRegions");
    for (int r = 0; r < mesh->regions.count; r++)
        printf("  %-24s %12lld tets    volume %g\n", mesh->regions.name[r], (long long)counts->region_tets[r],
               counts->region_volume[r]);
    puts(mesh->boundary_count > 0 ? "\nBoundaries" : "\nNo boundaries");
    for (int b = 0; b < mesh->boundary_count; b++) {
        const int dimension = mesh->boundaries[b].dimension;
        printf("  %-24s %12lld %s", mesh->boundaries[b].name, (long long)counts->boundary_items[b], items[dimension]);
        if (dimension == 2)
            printf("   area %g", counts->boundary_area[b]);
        putchar('\n');
    }
    print_parts(counts);
    print_misfits(mesh, &counts->misfits);
    print_histogram(mesh, counts);
}

static json_t *parts_json(const OstComponents *parts)
{
    json_t *list = json_array();
    for (OstLocal c = 0; c < parts->count; c++) {
        const OstComponent *part = &parts->component[c];
        json_array_append_new(list,
                              json_pack("{s:I, s:I, s:[fff], s:[fff]}", "tets", (json_int_t)part->tets, "first_tet",
                                        (json_int_t)part->first_tet, "low", part->low[0], part->low[1], part->low[2],
                                        "high", part->high[0], part->high[1], part->high[2]));
    }
    return list;
}

static json_t *quality_json(const OstMeshReport *counts)
{
    json_t *bins = json_array();
    for (int b = 0; b < OST_QUALITY_BINS; b++)
        json_array_append_new(bins, json_integer(counts->bins[b]));
    return json_pack("{s:f, s:f, s:I, s:o}", "least", counts->least_quality, "mean", counts->mean_quality, "worst_tet",
                     (json_int_t)counts->worst_tet, "histogram", bins);
}

OstStatus ost_mesh_report_json(const OstMesh *mesh, const OstMeshReport *counts, const char *path, const char *json)
{
    json_t *regions = json_array(), *boundaries = json_array();
    for (int r = 0; r < mesh->regions.count; r++)
        json_array_append_new(regions,
                              json_pack("{s:o, s:I, s:f}", "name", ost_json_text(mesh->regions.name[r]), "tets",
                                        (json_int_t)counts->region_tets[r], "volume", counts->region_volume[r]));
    for (int b = 0; b < mesh->boundary_count; b++)
        json_array_append_new(boundaries,
                              json_pack("{s:o, s:s, s:I, s:f}", "name", ost_json_text(mesh->boundaries[b].name), "of",
                                        items[mesh->boundaries[b].dimension], "count",
                                        (json_int_t)counts->boundary_items[b], "area", counts->boundary_area[b]));
    json_t *root = json_pack(
        "{s:o, s:I, s:I, s:i, s:f, s:[fff], s:[fff], s:f, s:f, s:f, s:o, s:o, s:o, s:o, s:I, s:f, s:I, s:I, s:f, s:f, "
        "s:o}",
        "file", ost_json_text(path), "nodes", (json_int_t)mesh->global_nodes, "tets", (json_int_t)mesh->global_tets,
        "order", mesh->nodes_per_tet == 10 ? 2 : 1, "surface_faces", counts->surface_faces, "low", counts->low[0],
        counts->low[1], counts->low[2], "high", counts->high[0], counts->high[1], counts->high[2], "volume",
        counts->volume, "shortest_edge", counts->shortest, "longest_edge", counts->longest, "quality",
        quality_json(counts), "regions", regions, "boundaries", boundaries, "components",
        parts_json(counts->components), "coincident_vertices", (json_int_t)counts->coincident, "coincident_within",
        counts->tolerance, "cracked_faces", (json_int_t)counts->misfits.cracked, "misfit_faces",
        (json_int_t)counts->misfits.faces, "cut_off", counts->cut_off.lacking, "filled_in", counts->cut_off.filled,
        "warnings", ost_json_warnings(mesh->ctx));
    if (!root)
        return OST_RAISE(mesh->ctx, OST_LIBRARY_FAILED,
                         "%s: what was found cannot be written as JSON (are its names UTF-8?)", path);
    return ost_json_write(mesh->ctx, root, json);
}
