/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/export/export.h"

#include <inttypes.h>
#include <string.h>
#include <strings.h>

/* Abaqus's input: an element set for each region, triangles in a set for each boundary of faces, sets of nodes for
 * those of curves and points. */

enum { NUMBERS_A_LINE = 16 };

static void write_item(FILE *file, const OstMeshChunk *whole, OstGlobal label, int count, const OstGlobal *nodes)
{
    fprintf(file, "%" PRId64, label);
    for (int i = 0; i < count; i++)
        fprintf(file, ", %" PRId64, whole->node_label[nodes[i]]);
    fputc('\n', file);
}

/* Without quotes, names that differ in capitals alone are one. */
static int has_twin(const OstMeshChunk *whole, const char *name)
{
    int twins = 0;
    for (int r = 0; r < whole->regions.count; r++)
        twins += !strcasecmp(whole->regions.name[r], name) && strcmp(whole->regions.name[r], name) != 0;
    for (int b = 0; b < whole->boundary_count; b++)
        twins += !strcasecmp(whole->boundaries[b].name, name) && strcmp(whole->boundaries[b].name, name) != 0;
    return twins > 0;
}

/* Other names than words go in quotes, which keep them to the letter. */
static void write_set(FILE *file, const OstMeshChunk *whole, const char *parameter, const char *name)
{
    static const char plain[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
    const char *quote = name[strspn(name, plain)] || has_twin(whole, name) ? "\"" : "";
    fprintf(file, "%s=%s%s%s\n", parameter, quote, name, quote);
}

static void write_region(FILE *file, const OstMeshChunk *whole, int region)
{
    fprintf(file, "*ELEMENT, TYPE=C3D%d, ", whole->nodes_per_tet);
    write_set(file, whole, "ELSET", whole->regions.name[region]);
    for (OstLocal t = 0; t < whole->tet_count; t++)
        if (whole->tet_region[t] == region)
            write_item(file, whole, whole->tet_label[t], whole->nodes_per_tet,
                       whole->tet_nodes + (size_t)t * (size_t)whole->nodes_per_tet);
}

/* Faces are numbered after `last`. */
static OstGlobal write_boundary(FILE *file, const OstMeshChunk *whole, const OstBoundary *boundary, OstGlobal last)
{
    const size_t width = (size_t)boundary->nodes_per_item, total = width * (size_t)boundary->count;
    if (boundary->dimension == 2) {
        fprintf(file, "*ELEMENT, TYPE=%s, ", width == 3 ? "S3" : "STRI65");
        write_set(file, whole, "ELSET", boundary->name);
        for (OstLocal i = 0; i < boundary->count; i++)
            write_item(file, whole, ++last, (int)width, boundary->nodes + width * (size_t)i);
        return last;
    }
    write_set(file, whole, "*NSET, NSET", boundary->name);
    for (size_t i = 0; i < total; i++)
        fprintf(file, "%" PRId64 "%s", whole->node_label[boundary->nodes[i]],
                i + 1 == total || i % NUMBERS_A_LINE == NUMBERS_A_LINE - 1 ? "\n" : ", ");
    return last;
}

OstStatus ost_abaqus_write(FILE *file, const void *content)
{
    const OstMeshChunk *whole = content;
    OstGlobal last = whole->tet_label[whole->tet_count - 1];
    fputs("*HEADING\nwritten by orthostat mesh\n*NODE\n", file);
    for (OstLocal n = 0; n < whole->node_count; n++) {
        const double *x = whole->coordinates + 3 * (size_t)n;
        fprintf(file, "%" PRId64 ", %.17g, %.17g, %.17g\n", whole->node_label[n], x[0], x[1], x[2]);
    }
    for (int r = 0; r < whole->regions.count; r++)
        write_region(file, whole, r);
    for (int b = 0; b < whole->boundary_count; b++)
        last = write_boundary(file, whole, &whole->boundaries[b], last);
    return OST_SUCCESS;
}
