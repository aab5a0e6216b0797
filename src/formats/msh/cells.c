/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/msh/msh.h"

/* By Gmsh's manual (section "Node ordering"), and VTK's order of formats/cells. */
static const OstMshCell cells[] = {
    {3, OST_CELL_QUAD4, {0, 1, 2, 3}},
    {16, OST_CELL_QUAD8, {0, 1, 2, 3, 4, 5, 6, 7}},
    {10, OST_CELL_QUAD9, {0, 1, 2, 3, 4, 5, 6, 7, 8}},
    {5, OST_CELL_HEX8, {0, 1, 2, 3, 4, 5, 6, 7}},
    {17, OST_CELL_HEX20, {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15}},
    {12, OST_CELL_HEX27, {0,  1,  2,  3,  4,  5,  6,  7,  8,  11, 13, 9,  16, 18,
                          19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26}},
    {6, OST_CELL_WEDGE6, {0, 1, 2, 3, 4, 5}},
    {18, OST_CELL_WEDGE15, {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11}},
    {13, OST_CELL_WEDGE18, {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11, 15, 17, 16}},
    {7, OST_CELL_PYRAMID5, {0, 1, 2, 3, 4}},
    {19, OST_CELL_PYRAMID13, {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12}},
    {14, OST_CELL_PYRAMID14, {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12, 13}}};

const OstMshCell *ost_msh_cell(int type)
{
    for (size_t c = 0; c < sizeof cells / sizeof *cells; c++)
        if (cells[c].type == type)
            return &cells[c];
    return NULL;
}
