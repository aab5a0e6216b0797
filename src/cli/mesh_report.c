/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/mesh_report.h"

#include "core/error.h"
#include "core/json_file.h"

#include <stdio.h>

enum { BAR = 40, MOST_PARTS = 20 };

static const char *const items[] = {"points", "curves", "faces"};

static void print_histogram(const OstMeshCounts *counts)
{
    OstGlobal most = 1;
    for (int b = 0; b < OST_QUALITY_BINS; b++)
        most = counts->bins[b] > most ? counts->bins[b] : most;
    puts("\nQuality of the tets (1: regular, 0: flat)");
    for (int b = 0; b < OST_QUALITY_BINS; b++) {
        const int length = counts->bins[b] == 0 ? 0 : 1 + (int)((BAR - 1) * counts->bins[b] / most);
        printf("  %.1f to %.1f %12lld  %.*s\n", 0.1 * b, 0.1 * (b + 1), (long long)counts->bins[b], length,
               "########################################");
    }
    printf("  least %.3g (tet %lld), mean %.3g\n", counts->least_quality, (long long)counts->worst_tet,
           counts->mean_quality);
}

static void print_parts(const OstMeshCounts *counts)
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

void ost_mesh_counts_print(const OstMesh *mesh, const OstMeshCounts *counts, const char *path)
{
    printf("%s: %lld %s tets, %lld nodes, %.0f faces on the surface\n", path, (long long)mesh->global_tets,
           mesh->nodes_per_tet == 10 ? "quadratic" : "linear", (long long)mesh->global_nodes, counts->surface_faces);
    printf("  from (%g, %g, %g) to (%g, %g, %g), volume %g, edges %g to %g\n", counts->low[0], counts->low[1],
           counts->low[2], counts->high[0], counts->high[1], counts->high[2], counts->volume, counts->shortest,
           counts->longest);
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
    print_histogram(counts);
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

static json_t *quality_json(const OstMeshCounts *counts)
{
    json_t *bins = json_array();
    for (int b = 0; b < OST_QUALITY_BINS; b++)
        json_array_append_new(bins, json_integer(counts->bins[b]));
    return json_pack("{s:f, s:f, s:I, s:o}", "least", counts->least_quality, "mean", counts->mean_quality, "worst_tet",
                     (json_int_t)counts->worst_tet, "histogram", bins);
}

OstStatus ost_mesh_counts_json(const OstMesh *mesh, const OstMeshCounts *counts, const char *path, const char *json)
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
        "{s:o, s:I, s:I, s:i, s:f, s:[fff], s:[fff], s:f, s:f, s:f, s:o, s:o, s:o, s:o, s:I, s:f, s:o}", "file",
        ost_json_text(path), "nodes", (json_int_t)mesh->global_nodes, "tets", (json_int_t)mesh->global_tets, "order",
        mesh->nodes_per_tet == 10 ? 2 : 1, "surface_faces", counts->surface_faces, "low", counts->low[0],
        counts->low[1], counts->low[2], "high", counts->high[0], counts->high[1], counts->high[2], "volume",
        counts->volume, "shortest_edge", counts->shortest, "longest_edge", counts->longest, "quality",
        quality_json(counts), "regions", regions, "boundaries", boundaries, "components",
        parts_json(counts->components), "coincident_vertices", (json_int_t)counts->coincident, "coincident_within",
        counts->tolerance, "warnings", ost_json_warnings(mesh->ctx));
    if (!root)
        return OST_RAISE(mesh->ctx, OST_LIBRARY_FAILED,
                         "%s: what was found cannot be written as JSON (are its names UTF-8?)", path);
    return ost_json_write(mesh->ctx, root, json);
}
