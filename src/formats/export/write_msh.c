/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/export/export.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>

/* Gmsh's format 4.1 as text. Each region is a volume and each boundary a surface, curve or point of the same number, in
 * a physical group of that number; all nodes lie in the first volume. */

static const int volume = 3;

/* Gmsh's type of a tet or of a boundary's items. */
static int type_of(int dimension, int nodes)
{
    static const int linear[] = {15, 1, 2, 4}, quadratic[] = {15, 8, 9, 11};
    return nodes == 1 || nodes == dimension + 1 ? linear[dimension] : quadratic[dimension];
}

static void write_names(FILE *file, const OstMeshChunk *whole)
{
    fprintf(file, "$PhysicalNames\n%d\n", whole->regions.count + whole->boundary_count);
    for (int b = 0; b < whole->boundary_count; b++)
        fprintf(file, "%d %d \"%s\"\n", whole->boundaries[b].dimension, whole->regions.count + b + 1,
                whole->boundaries[b].name);
    for (int r = 0; r < whole->regions.count; r++)
        fprintf(file, "%d %d \"%s\"\n", volume, r + 1, whole->regions.name[r]);
    fputs("$EndPhysicalNames\n", file);
}

/* The box of the body stands for that of every entity. */
static void write_box(FILE *file, const OstMeshChunk *whole, int is_point)
{
    double low[3] = {DBL_MAX, DBL_MAX, DBL_MAX}, high[3] = {-DBL_MAX, -DBL_MAX, -DBL_MAX};
    for (size_t i = 0; i < 3 * (size_t)whole->node_count; i++) {
        low[i % 3] = fmin(low[i % 3], whole->coordinates[i]);
        high[i % 3] = fmax(high[i % 3], whole->coordinates[i]);
    }
    fprintf(file, "%.17g %.17g %.17g ", low[0], low[1], low[2]);
    if (!is_point)
        fprintf(file, "%.17g %.17g %.17g ", high[0], high[1], high[2]);
}

static void write_entities(FILE *file, const OstMeshChunk *whole)
{
    int count[3] = {0};
    for (int b = 0; b < whole->boundary_count; b++)
        count[whole->boundaries[b].dimension]++;
    fprintf(file, "$Entities\n%d %d %d %d\n", count[0], count[1], count[2], whole->regions.count);
    for (int dimension = 0; dimension < volume; dimension++)
        for (int b = 0; b < whole->boundary_count; b++) {
            if (whole->boundaries[b].dimension != dimension)
                continue;
            fprintf(file, "%d ", whole->regions.count + b + 1);
            write_box(file, whole, dimension == 0);
            fprintf(file, "1 %d%s\n", whole->regions.count + b + 1, dimension == 0 ? "" : " 0");
        }
    for (int r = 0; r < whole->regions.count; r++) {
        fprintf(file, "%d ", r + 1);
        write_box(file, whole, 0);
        fprintf(file, "1 %d 0\n", r + 1);
    }
    fputs("$EndEntities\n", file);
}

static void write_nodes(FILE *file, const OstMeshChunk *whole)
{
    const OstLocal n = whole->node_count;
    const double *x = whole->coordinates;
    fprintf(file, "$Nodes\n1 %d %" PRId64 " %" PRId64 "\n3 1 0 %d\n", n, whole->node_label[0], whole->node_label[n - 1],
            n);
    for (OstLocal i = 0; i < n; i++)
        fprintf(file, "%" PRId64 "\n", whole->node_label[i]);
    for (OstLocal i = 0; i < n; i++, x += 3)
        fprintf(file, "%.17g %.17g %.17g\n", x[0], x[1], x[2]);
    fputs("$EndNodes\n", file);
}

static void write_item(FILE *file, const OstMeshChunk *whole, OstGlobal tag, int count, const OstGlobal *nodes)
{
    fprintf(file, "%" PRId64, tag);
    for (int i = 0; i < count; i++) {
        /* Gmsh has the last two mid-edge nodes of a tet in the opposite order. */
        const int from = count == 10 && i >= 8 ? 17 - i : i;
        fprintf(file, " %" PRId64, whole->node_label[nodes[from]]);
    }
    fputc('\n', file);
}

static void write_region(FILE *file, const OstMeshChunk *whole, int region)
{
    OstLocal count = 0;
    for (OstLocal t = 0; t < whole->tet_count; t++)
        count += whole->tet_region[t] == region;
    fprintf(file, "3 %d %d %d\n", region + 1, type_of(volume, whole->nodes_per_tet), count);
    for (OstLocal t = 0; t < whole->tet_count; t++)
        if (whole->tet_region[t] == region)
            write_item(file, whole, whole->tet_label[t], whole->nodes_per_tet,
                       whole->tet_nodes + (size_t)t * (size_t)whole->nodes_per_tet);
}

/* Boundaries' items are numbered after the tets. */
static void write_elements(FILE *file, const OstMeshChunk *whole)
{
    const OstGlobal lowest = whole->tet_label[0], highest = whole->tet_label[whole->tet_count - 1];
    OstGlobal items = 0;
    int blocks = whole->regions.count;
    for (int b = 0; b < whole->boundary_count; b++) {
        items += whole->boundaries[b].count;
        blocks += whole->boundaries[b].count > 0;
    }
    fprintf(file, "$Elements\n%d %" PRId64 " %" PRId64 " %" PRId64 "\n", blocks, items + whole->tet_count, lowest,
            highest + items);
    for (int r = 0; r < whole->regions.count; r++)
        write_region(file, whole, r);
    OstGlobal tag = highest;
    for (int b = 0; b < whole->boundary_count; b++) {
        const OstBoundary *boundary = &whole->boundaries[b];
        if (boundary->count == 0)
            continue;
        fprintf(file, "%d %d %d %d\n", boundary->dimension, whole->regions.count + b + 1,
                type_of(boundary->dimension, boundary->nodes_per_item), boundary->count);
        for (OstLocal i = 0; i < boundary->count; i++)
            write_item(file, whole, ++tag, boundary->nodes_per_item,
                       boundary->nodes + (size_t)i * (size_t)boundary->nodes_per_item);
    }
    fputs("$EndElements\n", file);
}

static void write_axes(FILE *file, const OstMeshChunk *whole)
{
    fprintf(file, "$ElementData\n1\n\"axes\"\n1\n0\n3\n0\n9\n%d\n", whole->tet_count);
    for (OstLocal t = 0; t < whole->tet_count; t++) {
        fprintf(file, "%" PRId64, whole->tet_label[t]);
        for (size_t k = 0; k < 9; k++)
            fprintf(file, " %.17g", whole->tet_axes[9 * (size_t)t + k]);
        fputc('\n', file);
    }
    fputs("$EndElementData\n", file);
}

OstStatus ost_msh_write(FILE *file, const void *content)
{
    const OstMeshChunk *whole = content;
    fputs("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n", file);
    write_names(file, whole);
    write_entities(file, whole);
    write_nodes(file, whole);
    write_elements(file, whole);
    if (whole->tet_axes)
        write_axes(file, whole);
    return OST_SUCCESS;
}
