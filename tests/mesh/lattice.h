/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TESTS_MESH_LATTICE_H
#define ORTHOSTAT_TESTS_MESH_LATTICE_H

/* Include after support.h and mesh_support.h: bodies of cubic cells on a lattice. Cells share the vertices they touch
 * in, so neighbours are joined through a face, along an edge, or at a vertex, as they lie. */
enum { LATTICE = 9, LATTICE_CELLS = 16 };

/* The six paths from corner 0 to corner 7 of a cell, as in mesh/grid.c: faces of neighbours fit. */
static const int lattice_tet[6][4] = {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7},
                                      {0, 1, 7, 5}, {0, 4, 7, 6}, {0, 2, 7, 3}};

/* A cell's lowest corner; `apart` tells cells of different copies of the lattice, which share nothing. */
typedef struct Cell {
    int at[3];
    int apart;
} Cell;

/* The body of these cells, `scale` wide each; all of it on rank 0. Labels follow the order of the cells. */
static inline OstMeshChunk *lattice_chunk(int cells, const Cell *cell, double scale)
{
    static OstGlobal number[2][LATTICE][LATTICE][LATTICE];
    double *x = malloc(24 * sizeof *x * (size_t)cells);
    OstGlobal *tets = malloc(24 * sizeof *tets * (size_t)cells);
    OstLocal nodes = 0;
    memset(number, 0, sizeof number);
    for (int c = 0; c < cells; c++) {
        OstGlobal corner[8];
        for (int k = 0; k < 8; k++) {
            const int at[3] = {cell[c].at[0] + (k & 1), cell[c].at[1] + (k >> 1 & 1), cell[c].at[2] + (k >> 2 & 1)};
            OstGlobal *known = &number[cell[c].apart][at[0]][at[1]][at[2]];
            for (int d = 0; d < 3 && *known == 0; d++)
                x[3 * nodes + d] = scale * at[d];
            if (*known == 0)
                *known = ++nodes;
            corner[k] = *known - 1;
        }
        for (int t = 0; t < 6; t++)
            for (int v = 0; v < 4; v++)
                tets[24 * c + 4 * t + v] = corner[lattice_tet[t][v]];
    }
    OstMeshChunk *chunk = hand_chunk(4, nodes, x, 6 * cells, tets);
    free(x);
    free(tets);
    return chunk;
}

static inline OstMesh *lattice_mesh(int cells, const Cell *cell, double scale)
{
    OstMeshChunk *chunk = lattice_chunk(cells, cell, scale);
    OstMesh *mesh = NULL;
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    return mesh;
}

#endif
