/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/bisection/tag.h"

#include "mesh/mesh_data.h"

static int edge_between(int a, int b)
{
    return ost_tet_mid_node(a, b) - 4;
}

static int has(int edge, int vertex)
{
    return ost_tet_edge[edge][0] == vertex || ost_tet_edge[edge][1] == vertex;
}

OstTag ost_tag_first(const int rank[6])
{
    OstTag tag = {0};
    for (int e = 1; e < 6; e++)
        if (rank[e] < rank[tag.edge])
            tag.edge = (unsigned char)e;
    for (int v = 0; v < 4; v++) {
        int longest = -1;
        for (int e = 0; e < 6; e++)
            if (!has(e, v) && (longest < 0 || rank[e] < rank[longest]))
                longest = e;
        tag.face[v] = (unsigned char)longest;
    }
    return tag;
}

/* The vertex in which the marked edges of the two faces without the cut edge meet, where all three lie in one face. */
static int plane_vertex(const OstTag *tag)
{
    const int p = ost_tet_edge[tag->edge][0], q = ost_tet_edge[tag->edge][1];
    for (int v = 0; v < 4; v++)
        if (v != p && v != q && tag->face[p] == edge_between(q, v) && tag->face[q] == edge_between(p, v))
            return v;
    return -1;
}

void ost_tag_children(const OstTag *parent, OstTag child[2])
{
    const int plane = plane_vertex(parent);
    for (int c = 0; c < 2; c++) {
        const int kept = ost_tet_edge[parent->edge][c], fresh = ost_tet_edge[parent->edge][1 - c];
        int other[2], found = 0;
        for (int v = 0; v < 4; v++)
            if (v != kept && v != fresh)
                other[found++] = v;
        /* the inherited face keeps its mark, which is cut next; the halves of cut faces are cut opposite the new vertex
         */
        child[c].edge = child[c].face[fresh] = parent->face[fresh];
        child[c].face[other[0]] = (unsigned char)edge_between(kept, other[1]);
        child[c].face[other[1]] = (unsigned char)edge_between(kept, other[0]);
        child[c].face[kept] =
            (unsigned char)(parent->flag && plane >= 0 ? edge_between(fresh, plane) : edge_between(other[0], other[1]));
        child[c].flag = (unsigned char)(!parent->flag && plane >= 0);
    }
}
