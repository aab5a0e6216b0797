/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "core/index_map.h"
#include "core/small.h"
#include "formats/cells/shapes.h"
#include "formats/serial/formats.h"
#include "mesh/mesh_data.h"

#include <string.h>
#include <unistd.h>

/* Hexahedra, wedges and pyramids become tets. */

enum { SIDE = 3, QUARTERS = 4, LINEAR = 0, SERENDIPITY, FULL };

/* A cube of SIDE boxes a side. Nodes are keyed by their places in quarters of a box, so that neighbours share them. */
typedef struct Body {
    OstCells cells;
    OstIndex *places;
    int order; /* LINEAR, SERENDIPITY, FULL */
    void (*bend)(const double from[3], double x[3]);
    OstGlobal cell_count;
} Body;

/* Labels in no order, each once. */
static OstGlobal label_of(OstLocal node, OstGlobal seed)
{
    return (7919 * seed + 7919 * seed * (OstGlobal)node) % 1000003;
}

static OstGlobal seed = 1;

static OstGlobal node_at(Body *body, const OstGlobal quarters[3])
{
    OstLocal place = 0;
    const OstLocal before = body->places->count;
    assert_success(ost_index_place(body->places, quarters, &place));
    if (place == before) {
        double from[3], x[3];
        for (int d = 0; d < 3; d++)
            from[d] = (double)quarters[d] / QUARTERS;
        body->bend(from, x);
        assert_success(ost_cells_add_node(&body->cells, label_of(place, seed), x));
    }
    return label_of(place, seed);
}

static OstGlobal middle_of(Body *body, int count, const int *which, OstGlobal corner[][3])
{
    OstGlobal sum[3] = {0};
    for (int i = 0; i < count; i++)
        for (int d = 0; d < 3; d++)
            sum[d] += corner[which[i]][d];
    for (int d = 0; d < 3; d++) {
        assert_true(sum[d] % count == 0);
        sum[d] /= count;
    }
    return node_at(body, sum);
}

/* A cell by its corners, with the nodes that its order has. */
static void add_cell(Body *body, OstCellKind linear, OstGlobal group, OstGlobal corner[][3])
{
    static const int all[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    const OstCellKind kind = (OstCellKind)((int)linear + body->order);
    const OstCellShape *shape = ost_cell_shape(kind);
    const int count = ost_cell_facts[kind].nodes;
    OstGlobal nodes[OST_MOST_CELL_NODES];
    for (int v = 0; v < shape->vertices; v++)
        nodes[v] = node_at(body, corner[v]);
    for (int e = 0; e < shape->edges && body->order != LINEAR; e++)
        nodes[shape->vertices + e] = middle_of(body, 2, shape->edge[e], corner);
    for (int f = 0; f < shape->faces; f++)
        if (shape->middle[f] > 0 && shape->middle[f] < count)
            nodes[shape->middle[f]] = middle_of(body, 4, shape->face[f], corner);
    if (shape->centre > 0 && shape->centre < count)
        nodes[shape->centre] = middle_of(body, 8, all, corner);
    assert_success(ost_cells_add(&body->cells, kind, ++body->cell_count, group, nodes));
}

static void take(OstGlobal box[8][3], int count, const int *which, OstGlobal corner[8][3])
{
    for (int i = 0; i < count; i++)
        memcpy(corner[i], box[which[i]], sizeof corner[i]);
}

/* A box of two wedges, of six pyramids, or whole; groups 1, 2 and 3. */
static void add_box(Body *body, int i, int j, int k, int what)
{
    static const int at[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                 {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    static const int wedge[2][6] = {{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}};
    OstGlobal box[8][3], corner[8][3];
    for (int v = 0; v < 8; v++) {
        box[v][0] = QUARTERS * (i + at[v][0]);
        box[v][1] = QUARTERS * (j + at[v][1]);
        box[v][2] = QUARTERS * (k + at[v][2]);
    }
    for (int w = 0; w < 2 && what == 0; w++) {
        take(box, 6, wedge[w], corner);
        add_cell(body, OST_CELL_WEDGE6, 1, corner);
    }
    for (int f = 0; f < 6 && what == 1; f++) {
        take(box, 4, ost_cell_shape(OST_CELL_HEX8)->face[f], corner);
        memcpy(corner[4], (OstGlobal[]){box[0][0] + 2, box[0][1] + 2, box[0][2] + 2}, sizeof corner[4]);
        add_cell(body, OST_CELL_PYRAMID5, 2, corner);
    }
    if (what == 2)
        add_cell(body, OST_CELL_HEX8, 3, box);
    if (i == 0) {
        take(box, 4, (const int[]){0, 4, 7, 3}, corner);
        add_cell(body, OST_CELL_QUAD4, 7, corner);
    }
}

/* Wedges in columns, as their triangles face up and down. */
static void build(int order, void (*bend)(const double from[3], double x[3]), OstMeshChunk **chunk)
{
    Body body = {.order = order, .bend = bend};
    assert_success(ost_cells_open(ctx, "body", &body.cells));
    assert_success(ost_index_create(ctx, 3, &body.places));
    for (int i = 0; i < SIDE; i++)
        for (int j = 0; j < SIDE; j++)
            for (int k = 0; k < SIDE; k++)
                add_box(&body, i, j, k, (i + j) % 3 == 0 ? 0 : 1 + (i + k) % 2);
    assert_success(ost_cells_finish(&body.cells, chunk));
    ost_index_destroy(&body.places);
    ost_cells_close(&body.cells);
}

/* --- volumes --- */

/* The determinant of the map from the reference tet, at a place by its weights of the vertices. */
static double jacobian(const OstMeshChunk *chunk, const OstGlobal *nodes, const double weight[4])
{
    double slope[4][3] = {{0.0}}, tangent[9];
    for (int v = 0; v < 4; v++)
        for (int d = 0; d < 3; d++)
            slope[v][d] =
                (chunk->nodes_per_tet == 4 ? 1.0 : 4.0 * weight[v] - 1.0) * chunk->coordinates[3 * nodes[v] + d];
    for (int e = 0; e < 6 && chunk->nodes_per_tet == 10; e++)
        for (int d = 0; d < 3; d++) {
            const double x = chunk->coordinates[3 * nodes[4 + e] + d];
            slope[ost_tet_edge[e][0]][d] += 4.0 * weight[ost_tet_edge[e][1]] * x;
            slope[ost_tet_edge[e][1]][d] += 4.0 * weight[ost_tet_edge[e][0]] * x;
        }
    for (int k = 0; k < 3; k++)
        for (int d = 0; d < 3; d++)
            tangent[3 * k + d] = slope[k + 1][d] - slope[0][d];
    return ost_determinant3(tangent);
}

/* By five points, exact for the cubic determinant of a quadratic map (P. Keast, 1986). */
static double volume_of(const OstMeshChunk *chunk, OstLocal tet)
{
    const OstGlobal *nodes = chunk->tet_nodes + (size_t)tet * (size_t)chunk->nodes_per_tet;
    double volume = -0.8 * jacobian(chunk, nodes, (const double[]){0.25, 0.25, 0.25, 0.25});
    for (int v = 0; v < 4; v++) {
        double weight[4] = {1.0 / 6.0, 1.0 / 6.0, 1.0 / 6.0, 1.0 / 6.0};
        weight[v] = 0.5;
        volume += 0.45 * jacobian(chunk, nodes, weight);
    }
    return volume / 6.0;
}

static double whole_volume(const OstMeshChunk *chunk, const char *region)
{
    double volume = 0.0;
    for (OstLocal t = 0; t < chunk->tet_count; t++)
        if (!region || strcmp(chunk->regions.name[chunk->tet_region[t]], region) == 0)
            volume += volume_of(chunk, t);
    return volume;
}

/* Takes the chunk. No inner face is bare or has three tets, none is flat, and boundaries are faces. */
static void check_body(OstMeshChunk *chunk, double surface_faces)
{
    OstMesh *mesh = NULL;
    double faces = 0.0;
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    assert_success(ost_mesh_surface_faces(mesh, &faces));
    assert_close(faces, surface_faces, 0.0);
    ost_mesh_destroy(&mesh);
}

static const double a = 0.03, b = 0.04, c = -0.05;

static void stay(const double from[3], double x[3])
{
    memcpy(x, from, 3 * sizeof *x);
}

static void bend(const double from[3], double x[3])
{
    x[0] = from[0] + a * from[1] * from[2];
    x[1] = from[1] + b * from[0] * from[0];
    x[2] = from[2] + c * from[0] * from[1];
}

/* Of the bent cube of side n: the integral of 1 - 2ab xz + 2abc x²y - ac y². */
static double bent_volume(double n)
{
    return n * n * n * (1.0 - a * b * n * n / 2.0 + a * b * c * n * n * n / 3.0 - a * c * n * n / 3.0);
}

/* Inner vertices are moved, so that faces are not plane. */
static void shake(const double from[3], double x[3])
{
    for (int d = 0; d < 3; d++) {
        const int inside =
            from[0] > 0 && from[0] < SIDE && from[1] > 0 && from[1] < SIDE && from[2] > 0 && from[2] < SIDE;
        x[d] = from[d] + (inside ? 0.1 * sin(12.9 * from[0] + 78.2 * from[1] + 37.7 * from[2] + 5.0 * d) : 0.0);
    }
}

/* Two triangles on each of the 54 outer squares: those of wedges, above and below, are triangles themselves. */
static const double outer_faces = 2.0 * 6.0 * SIDE * SIDE;

static void cells_of_all_kinds_become_tets_that_fit(void **state)
{
    ost_log_set_level(ctx, OST_LOG_QUIET);
    for (seed = 1; seed <= 8; seed++)
        for (int order = LINEAR; order <= FULL; order++) {
            OstMeshChunk *chunk = NULL;
            build(order, stay, &chunk);
            assert_int_equal(chunk->nodes_per_tet, order == LINEAR ? 4 : 10);
            assert_close(whole_volume(chunk, NULL), SIDE * SIDE * SIDE, 1e-12 * SIDE * SIDE * SIDE);
            assert_close(whole_volume(chunk, "volume-1"), 9.0, 1e-12); /* three columns */
            assert_int_equal(chunk->boundary_count, 1);
            assert_string_equal(chunk->boundaries[0].name, "surface-7");
            assert_int_equal(chunk->boundaries[0].count, 2 * SIDE * SIDE);
            assert_int_equal(chunk->of_cells, 1);
            check_body(chunk, outer_faces);
        }
}

static void twisted_faces_fit_too(void **state)
{
    for (seed = 1; seed <= 8; seed++) {
        OstMeshChunk *chunk = NULL;
        build(LINEAR, shake, &chunk);
        assert_close(whole_volume(chunk, NULL), SIDE * SIDE * SIDE, 1e-12 * SIDE * SIDE * SIDE);
        check_body(chunk, outer_faces);
    }
}

/* Serendipity and full cells have a quadratic map, and so have their tets. */
static void curved_cells_keep_their_volume(void **state)
{
    for (seed = 1; seed <= 4; seed++)
        for (int order = SERENDIPITY; order <= FULL; order++) {
            OstMeshChunk *chunk = NULL;
            build(order, bend, &chunk);
            assert_close(whole_volume(chunk, NULL), bent_volume(SIDE), 1e-12 * SIDE * SIDE * SIDE);
            check_body(chunk, outer_faces);
        }
}

/* A tapered box with straight edges: none of its tets is curved. */
static void straight_cells_stay_straight(void **state)
{
    static const double place[8][3] = {{0, 0, 0}, {2, 0, 0}, {1.5, 1, 0},  {0, 1, 0},
                                       {0, 0, 1}, {1, 0, 1}, {.75, .5, 1}, {0, .5, 1}};
    const OstCellShape *shape = ost_cell_shape(OST_CELL_HEX20);
    OstCells cells;
    OstMeshChunk *chunk = NULL;
    OstGlobal nodes[20];
    double x[20][3];
    memcpy(x, place, sizeof place);
    for (int e = 0; e < 12; e++)
        for (int d = 0; d < 3; d++)
            x[8 + e][d] = 0.5 * (place[shape->edge[e][0]][d] + place[shape->edge[e][1]][d]);
    assert_success(ost_cells_open(ctx, "taper", &cells));
    for (int n = 0; n < 20; n++) {
        nodes[n] = n + 1;
        assert_success(ost_cells_add_node(&cells, n + 1, x[n]));
    }
    assert_success(ost_cells_add(&cells, OST_CELL_HEX20, 1, OST_NO_GROUP, nodes));
    assert_success(ost_cells_finish(&cells, &chunk));
    ost_cells_close(&cells);
    for (OstLocal t = 0; t < chunk->tet_count; t++)
        for (int e = 0; e < 6; e++)
            for (int d = 0; d < 3; d++) {
                const OstGlobal *own = chunk->tet_nodes + 10 * (size_t)t;
                assert_close(chunk->coordinates[3 * own[4 + e] + d],
                             0.5 * (chunk->coordinates[3 * own[ost_tet_edge[e][0]] + d] +
                                    chunk->coordinates[3 * own[ost_tet_edge[e][1]] + d]),
                             1e-15);
            }
    check_body(chunk, 12.0);
}

/* --- cells in which nodes repeat --- */

/* A unit hexahedron of these corners, and a whole one before or below it, whichever numbers their nodes have. */
static void collapsed_hexahedra_lose_their_flat_tets(void **state)
{
    static const struct {
        int corner[8], beside[8];
        double volume, faces; /* of the surface of both */
        int tets;
    } shapes[] = {{{0, 1, 2, 2, 4, 5, 6, 6}, {8, 9, 1, 0, 10, 11, 5, 4}, 0.5, 16.0, 3},
                  {{0, 1, 2, 3, 4, 4, 4, 4}, {12, 13, 14, 15, 0, 1, 2, 3}, 1.0 / 3.0, 14.0, 2},
                  {{0, 1, 2, 2, 4, 4, 4, 4}, {8, 9, 1, 0, 10, 11, 5, 4}, 1.0 / 6.0, 0.0, 1},
                  {{0, 1, 2, 3, 0, 5, 6, 3}, {12, 13, 14, 15, 0, 1, 2, 3}, 0.5, 16.0, 3}};
    static const double place[16][3] = {{0, 0, 0},  {1, 0, 0},  {1, 1, 0},  {0, 1, 0},  {0, 0, 1},  {1, 0, 1},
                                        {1, 1, 1},  {0, 1, 1},  {0, -1, 0}, {1, -1, 0}, {0, -1, 1}, {1, -1, 1},
                                        {0, 0, -1}, {1, 0, -1}, {1, 1, -1}, {0, 1, -1}};
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++)
        for (seed = 1; seed <= 40; seed++) {
            OstCells cells;
            OstMeshChunk *chunk = NULL;
            OstGlobal nodes[2][8];
            OstLocal collapsed = 0;
            assert_success(ost_cells_open(ctx, "collapsed", &cells));
            for (int n = 0; n < 16; n++)
                assert_success(ost_cells_add_node(&cells, label_of(n, seed), place[n]));
            for (int v = 0; v < 8; v++) {
                nodes[0][v] = label_of(shapes[s].corner[v], seed);
                nodes[1][v] = label_of(shapes[s].beside[v], seed);
            }
            for (int n = 0; n < 2; n++)
                assert_success(ost_cells_add(&cells, OST_CELL_HEX8, 1 + n, 1 + n, nodes[n]));
            assert_success(ost_cells_finish(&cells, &chunk));
            ost_cells_close(&cells);
            assert_close(whole_volume(chunk, "volume-1"), shapes[s].volume, 1e-15);
            assert_close(whole_volume(chunk, "volume-2"), 1.0, 1e-15);
            for (OstLocal t = 0; t < chunk->tet_count; t++) {
                assert_true(volume_of(chunk, t) > 0.01);
                collapsed += chunk->tet_label[t] / 10 == 1;
            }
            assert_int_equal(collapsed, shapes[s].tets);
            if (shapes[s].faces > 0.0) /* a tet does not fit beside a hexahedron */
                check_body(chunk, shapes[s].faces);
            else
                ost_chunk_destroy(&chunk);
        }
}

/* --- files --- */

#define UNIT_NODES "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"

static OstStatus read_text(const char *name, const char *text, OstMeshChunk **chunk)
{
    char path[512];
    snprintf(path, sizeof path, "/tmp/orthostat-split-%d-%s", (int)getpid(), name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    const OstStatus status = ost_chunk_read(ctx, path, chunk);
    remove(path);
    return status;
}

static const OstBoundary *boundary(const OstMeshChunk *chunk, const char *name)
{
    for (int i = 0; i < chunk->boundary_count; i++)
        if (strcmp(chunk->boundaries[i].name, name) == 0)
            return &chunk->boundaries[i];
    fail_msg("there is no boundary '%s'", name);
    return NULL;
}

/* All nodes of a boundary of so many triangles have this coordinate. */
static void expect_plane(const OstMeshChunk *chunk, const char *name, int triangles, int axis, double value)
{
    const OstBoundary *faces = boundary(chunk, name);
    assert_int_equal(faces->count, triangles);
    assert_int_equal(faces->nodes_per_item, 3);
    for (int i = 0; i < 3 * faces->count; i++)
        assert_close(chunk->coordinates[3 * faces->nodes[i] + axis], value, 0.0);
}

static void surfaces_of_abaqus_are_faces_of_its_cells(void **state)
{
    static const char text[] = UNIT_NODES
        "9,2,0,0\n10,2,0,1\n*ELEMENT,TYPE=C3D8R,ELSET=BRICK\n5,1,2,3,4,5,6,7,8\n"
        "*ELEMENT,TYPE=C3D6,ELSET=WEDGE\n6,2,9,3,6,10,7\n"
        "*SURFACE,NAME=A1\nBRICK,S1\n*SURFACE,NAME=A2\nBRICK,S2\n*SURFACE,NAME=A3\n5,S3\n"
        "*SURFACE,NAME=A5\n5,S5\n*SURFACE,NAME=A6\n5,S6\n"
        "*SURFACE,NAME=B1\nWEDGE,S1\n*SURFACE,NAME=B2\n6,S2\n*SURFACE,NAME=B3\n6,S3\n*SURFACE,NAME=B4\n6,S4\n"
        "*NSET,NSET=PINS\n1,9\n";
    OstMeshChunk *chunk = NULL;
    assert_success(read_text("a.inp", text, &chunk));
    assert_int_equal(chunk->tet_count, 9);
    assert_int_equal(chunk->regions.count, 2);
    assert_close(whole_volume(chunk, "BRICK"), 1.0, 1e-15);
    assert_close(whole_volume(chunk, "WEDGE"), 0.5, 1e-15);
    expect_plane(chunk, "A1", 2, 2, 0.0);
    expect_plane(chunk, "A2", 2, 2, 1.0);
    expect_plane(chunk, "A3", 2, 1, 0.0);
    expect_plane(chunk, "A5", 2, 1, 1.0);
    expect_plane(chunk, "A6", 2, 0, 0.0);
    expect_plane(chunk, "B1", 1, 2, 0.0);
    expect_plane(chunk, "B2", 1, 2, 1.0);
    expect_plane(chunk, "B3", 2, 1, 0.0);
    assert_int_equal(boundary(chunk, "B4")->count, 2);
    assert_int_equal(boundary(chunk, "PINS")->count, 2);
    for (OstLocal t = 0; t < chunk->tet_count; t++) /* of element 5, then of 6 */
        assert_int_equal(chunk->tet_label[t], t < 6 ? 51 + t : 61 + t - 6);
    check_body(chunk, 16.0);
}

/* Nodes in the middle of faces come in the order of S1 to S6, behind that of the body. */
static void full_hexahedra_of_abaqus_are_read(void **state)
{
    static const char text[] =
        "*NODE\n"
        "1,0,0,0\n2,2,0,0\n3,2,2,0\n4,0,2,0\n5,0,0,2\n6,2,0,2\n7,2,2,2\n8,0,2,2\n9,1,0,0\n"
        "10,2,1,0\n11,1,2,0\n12,0,1,0\n13,1,0,2\n14,2,1,2\n15,1,2,2\n16,0,1,2\n17,0,0,1\n18,2,0,1\n"
        "19,2,2,1\n20,0,2,1\n21,1,1,1\n22,1,1,0\n23,1,1,2\n24,1,0,1\n25,2,1,1\n26,1,2,1\n27,0,1,1\n"
        "*ELEMENT,TYPE=C3D27\n1,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,\n16,17,18,19,20,21,22,23,24,25,26,27\n";
    OstMeshChunk *chunk = NULL;
    assert_success(read_text("full.inp", text, &chunk));
    assert_int_equal(chunk->node_count, 27);
    assert_close(whole_volume(chunk, NULL), 8.0, 1e-14);
    check_body(chunk, 12.0);
}

#define VTK_HEAD "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n"

static void voxels_of_vtk_go_row_by_row(void **state)
{
    static const char text[] = VTK_HEAD "POINTS 8 float\n0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1\n"
                                        "CELLS 2 14\n8 0 1 2 3 4 5 6 7\n4 0 1 2 3\nCELL_TYPES 2\n11\n8\n"
                                        "CELL_DATA 2\nSCALARS region int 1\nLOOKUP_TABLE default\n4\n9\n";
    OstMeshChunk *chunk = NULL;
    assert_success(read_text("voxel.vtk", text, &chunk));
    assert_close(whole_volume(chunk, "volume-4"), 1.0, 1e-15);
    expect_plane(chunk, "surface-9", 2, 2, 0.0);
    check_body(chunk, 12.0);
}

/* Two programs' orders of the last two edges of a Lagrange hexahedron: 26 and 37, or 37 and 26. */
static void lagrange_hexahedra_are_read_in_both_orders(void **state)
{
    static const char edge[] = "1 0 0 2 1 0 1 2 0 0 1 0 1 0 2 2 1 2 1 2 2 0 1 2 0 0 1 2 0 1 ";
    static const char *const last[2] = {"2 2 1 0 2 1 ", "0 2 1 2 2 1 "};
    for (int i = 0; i < 2; i++) {
        char text[2048];
        OstMeshChunk *chunk = NULL;
        snprintf(text, sizeof text,
                 VTK_HEAD
                 "POINTS 27 float\n0 0 0 2 0 0 2 2 0 0 2 0 0 0 2 2 0 2 2 2 2 0 2 2 %s%s"
                 "0 1 1 2 1 1 1 0 1 1 2 1 1 1 0 1 1 2 1 1 1\nCELLS 1 28\n27 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 "
                 "16 17 18 19 20 21 22 23 24 25 26\nCELL_TYPES 1\n72\n",
                 edge, last[i]);
        assert_success(read_text("lagrange.vtk", text, &chunk));
        assert_int_equal(chunk->node_count, 27);
        assert_close(whole_volume(chunk, NULL), 8.0, 1e-14);
        check_body(chunk, 12.0);
    }
}

/* A field of Gmsh's on elements: all tets of an element have its number. */
static void fields_of_elements_are_those_of_their_tets(void **state)
{
    static const char text[] =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n"
        "6 1 0 1\n7 1 1 1\n8 0 1 1\n9 2 0 0\n10 2 0 1\n$EndNodes\n$Elements\n2\n"
        "31 5 2 1 1 1 2 3 4 5 6 7 8\n40 6 2 2 2 2 9 3 6 10 7\n$EndElements\n"
        "$ElementData\n1\n\"modulus\"\n1\n0\n3\n0\n1\n2\n31 5\n40 7\n$EndElementData\n"
        "$NodeData\n1\n\"height\"\n1\n0\n3\n0\n1\n10\n1 0\n2 0\n3 0\n4 0\n5 1\n6 1\n7 1\n8 1\n9 0\n10 1\n"
        "$EndNodeData\n";
    char path[512];
    OstMeshChunk *chunk = NULL;
    snprintf(path, sizeof path, "/tmp/orthostat-split-%d.msh", (int)getpid());
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    assert_success(ost_chunk_read(ctx, path, &chunk));
    assert_success(ost_mesh_file_read_field(ctx, path, "modulus", OST_FIELD_OF_NUMBERS, chunk));
    assert_success(ost_mesh_file_read_field(ctx, path, "height", OST_FIELD_OF_NUMBERS, chunk));
    remove(path);
    assert_int_equal(chunk->tet_count, 9);
    for (OstLocal t = 0; t < 9; t++) {
        double height = 0.0;
        for (int v = 0; v < 4; v++)
            height += chunk->coordinates[3 * chunk->tet_nodes[4 * (size_t)t + (size_t)v] + 2] / 4.0;
        assert_int_equal(chunk->tet_label[t], t < 6 ? 311 + t : 401 + t - 6);
        assert_close(chunk->tet_field[2 * (size_t)t], t < 6 ? 5.0 : 7.0, 0.0);
        assert_close(chunk->tet_field[2 * (size_t)t + 1], height, 1e-15);
    }
    ost_chunk_destroy(&chunk);
}

static void mistakes_name_the_element_of_the_file(void **state)
{
    static const struct {
        const char *name, *text, *words;
    } wrong[] = {
        {"a.inp", UNIT_NODES "*ELEMENT,TYPE=C3D8\n7,1,2,3,4,5,6,7\n*NSET,NSET=A\n",
         "element 7 has 7 nodes, expected 8"},
        {"a.inp", UNIT_NODES "*ELEMENT,TYPE=C3D8\n7,1,2,3,4,5,6,7,9\n",
         "element 7 uses node 9, which the file does not"},
        {"a.inp", UNIT_NODES "*ELEMENT,TYPE=C3D8\n7,1,2,2,1,1,2,2,1\n",
         "element 7 is a hexahedron with too few different"},
        {"a.inp", UNIT_NODES "*ELEMENT,TYPE=C3D8\n1,1,2,3,4,5,6,7,8\n*ELEMENT,TYPE=C3D10\n2,1,2,3,4,5,6,7,8,1,2\n",
         "holds 1 linear and 1 quadratic solid elements"},
        {"a.inp", UNIT_NODES "*ELEMENT,TYPE=C3D8\n900000000000000000,1,2,3,4,5,6,7,8\n",
         "element number 900000000000000000 is too large"},
        {"a.bdf", "CHEXA,3,1,1,2,3,4,5,6\n,7,8,9,10\n", "element 3 has 2 of 12 mid-edge nodes"},
        {"a.bdf", "CPENTA,3,1,1,2,3,4,5,6\n,7,8,9,10,11,12,13,14\n,15,16\n",
         "element 3 has more nodes than the 15 of a CPENTA"},
        {"a.vtk", VTK_HEAD "POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n12\n",
         "cell 0 of VTK's type 12 has 4 points, expected 8"},
        {"a.vtk", VTK_HEAD "POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n42\n",
         "no linear or quadratic tets, hexahedra, wedges or pyramids, the first of them of VTK's type 42"},
        {"a.inp", UNIT_NODES "*ELEMENT,TYPE=C3D15V\n1,1,2,3\n", "the first of them C3D15V"},
    };
    static const char twisted[] = UNIT_NODES
        "9,2,0,0\n10,2,1,0\n11,2,0,1\n12,2,1,1\n*ELEMENT,TYPE=C3D8\n7,1,2,3,4,5,6,7,8\n8,2,9,10,3,7,11,12,6\n";
    OstMeshChunk *chunk = NULL;
    OstMesh *mesh = NULL;
    for (size_t w = 0; w < sizeof wrong / sizeof *wrong; w++)
        assert_failure(read_text(wrong[w].name, wrong[w].text, &chunk),
                       strstr(wrong[w].words, "too large") ? OST_LIMIT_EXCEEDED : OST_INVALID_INPUT, wrong[w].words);
    assert_success(read_text("twisted.inp", twisted, &chunk));
    assert_failure(ost_mesh_distribute(ctx, &chunk, &mesh), OST_INVALID_INPUT, "(of element 8 of the file) is ");
}

/* Quadrilaterals bound no tets: those of a file without other solids are left out. */
static void quadrilaterals_beside_tets_are_left_out(void **state)
{
    static const char text[] = UNIT_NODES "*ELEMENT,TYPE=C3D4\n1,1,2,4,5\n*ELEMENT,TYPE=S4,ELSET=SHELL\n2,1,2,3,4\n";
    OstMeshChunk *chunk = NULL;
    assert_success(read_text("shell.inp", text, &chunk));
    assert_int_equal(chunk->tet_count, 1);
    assert_int_equal(chunk->tet_label[0], 1);
    assert_int_equal(chunk->of_cells, 0);
    assert_int_equal(chunk->boundary_count, 0);
    ost_chunk_destroy(&chunk);
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(cells_of_all_kinds_become_tets_that_fit),
                                          cmocka_unit_test(twisted_faces_fit_too),
                                          cmocka_unit_test(curved_cells_keep_their_volume),
                                          cmocka_unit_test(straight_cells_stay_straight),
                                          cmocka_unit_test(collapsed_hexahedra_lose_their_flat_tets),
                                          cmocka_unit_test(surfaces_of_abaqus_are_faces_of_its_cells),
                                          cmocka_unit_test(full_hexahedra_of_abaqus_are_read),
                                          cmocka_unit_test(voxels_of_vtk_go_row_by_row),
                                          cmocka_unit_test(lagrange_hexahedra_are_read_in_both_orders),
                                          cmocka_unit_test(fields_of_elements_are_those_of_their_tets),
                                          cmocka_unit_test(mistakes_name_the_element_of_the_file),
                                          cmocka_unit_test(quadrilaterals_beside_tets_are_left_out)};
OST_TEST_MAIN(tests)
