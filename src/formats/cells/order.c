/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "formats/cells/shapes.h"

#include <string.h>

/* The middles of a straight cell's edges and faces, and its own, from its vertices. */
static void straight_places(const OstCellShape *shape, int width, double x[OST_MOST_CELL_NODES][3])
{
    for (int d = 0; d < 3; d++) {
        double sum = 0.0;
        for (int v = 0; v < shape->vertices; v++)
            sum += x[v][d] / shape->vertices;
        for (int e = 0; e < shape->edges; e++)
            x[shape->vertices + e][d] = 0.5 * (x[shape->edge[e][0]][d] + x[shape->edge[e][1]][d]);
        for (int f = 0; f < shape->faces; f++)
            if (shape->middle[f] > 0 && shape->middle[f] < width)
                x[shape->middle[f]][d] = 0.25 * (x[shape->face[f][0]][d] + x[shape->face[f][1]][d] +
                                                 x[shape->face[f][2]][d] + x[shape->face[f][3]][d]);
        if (shape->centre > 0 && shape->centre < width)
            x[shape->centre][d] = sum;
    }
}

/* How far the nodes are from the places, squared, summed over the cells, each by its size. */
static void add_distances(const OstCells *cells, const OstCellShape *shape, int width, const OstGlobal *nodes,
                          double sum[OST_MOST_CELL_NODES][OST_MOST_CELL_NODES])
{
    double x[OST_MOST_CELL_NODES][3] = {{0.0}}, place[OST_MOST_CELL_NODES][3] = {{0.0}}, size = 0.0;
    for (int n = 0; n < width; n++) {
        if (nodes[n] < 1 || nodes[n] > cells->chunk->node_count)
            return; /* refused later */
        memcpy(x[n], cells->chunk->coordinates + 3 * (size_t)(nodes[n] - 1), sizeof x[n]);
    }
    memcpy(place, x, sizeof place);
    straight_places(shape, width, place);
    for (int d = 0; d < 3; d++)
        for (int v = 1; v < shape->vertices; v++)
            size += (x[v][d] - x[0][d]) * (x[v][d] - x[0][d]);
    for (int n = shape->vertices; n < width && size > 0.0; n++)
        for (int p = shape->vertices; p < width; p++)
            for (int d = 0; d < 3; d++)
                sum[n][p] += (x[n][d] - place[p][d]) * (x[n][d] - place[p][d]) / size;
}

OstStatus ost_cells_order_middles(OstCells *cells, OstCellKind kind)
{
    const OstCellShape *shape = ost_cell_shape(kind);
    const OstCellList *list = &cells->list[kind];
    const int width = ost_cell_facts[kind].nodes;
    double sum[OST_MOST_CELL_NODES][OST_MOST_CELL_NODES] = {{0.0}};
    int to[OST_MOST_CELL_NODES], taken[OST_MOST_CELL_NODES] = {0};
    for (OstLocal c = 0; c < list->count; c++)
        add_distances(cells, shape, width, list->nodes + (size_t)c * (size_t)width, sum);
    for (int n = 0; n < width; n++) {
        to[n] = n < shape->vertices ? n : shape->vertices;
        for (int p = shape->vertices; p < width && n >= shape->vertices; p++)
            to[n] = sum[n][p] < sum[n][to[n]] ? p : to[n];
        if (list->count > 0 && taken[to[n]]++)
            return OST_RAISE(cells->ctx, OST_INVALID_INPUT,
                             "%s: nodes %d and others of its %s lie nearest to the middle of the same edge or face, so "
                             "that their order cannot be told; write the mesh as .msh or .vtu",
                             cells->path, n + 1, shape->name[1]);
    }
    for (OstLocal c = 0; c < list->count; c++) {
        OstGlobal *nodes = list->nodes + (size_t)c * (size_t)width, ordered[OST_MOST_CELL_NODES];
        for (int n = 0; n < width; n++)
            ordered[to[n]] = nodes[n];
        memcpy(nodes, ordered, (size_t)width * sizeof *nodes);
    }
    return OST_SUCCESS;
}
