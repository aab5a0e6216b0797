/* SPDX-License-Identifier: BSD-3-Clause */
#include "msh_writer.h"

#include "core/memory.h"
#include "core/small.h"
#include "formats/serial/formats.h"

#include <zlib.h>

static OstMeshChunk *chunk;
static OstFileMaterials *materials;

static OstStatus read_mesh(const char *path)
{
    return ost_mesh_file_read(ctx, path, &chunk, &materials);
}

/* All warnings as lines, the last one, and how many there were. */
static char heard[2048], warning[512];
static int warnings;

static void hear(void *listener, const char *text)
{
    (void)listener;
    const size_t length = strlen(heard);
    snprintf(warning, sizeof warning, "%s", text);
    snprintf(heard + length, sizeof heard - length, "%s\n", text);
    warnings++;
}

static OstStatus read_and_listen(const char *path)
{
    warnings = 0;
    warning[0] = heard[0] = '\0';
    ost_log_set_level(ctx, OST_LOG_QUIET);
    ost_warn_listen(ctx, hear, NULL);
    const OstStatus status = read_mesh(path);
    ost_warn_listen(ctx, NULL, NULL);
    ost_log_set_level(ctx, OST_LOG_NORMAL);
    return status;
}

static void drop_mesh(void)
{
    ost_chunk_destroy(&chunk);
    ost_file_materials_destroy(&materials);
}

static const OstBoundary *boundary(const char *name)
{
    for (int b = 0; b < chunk->boundary_count; b++)
        if (strcmp(chunk->boundaries[b].name, name) == 0)
            return &chunk->boundaries[b];
    fail_msg("no boundary '%s'", name);
    return NULL;
}

/* Position in the chunk of the node with this label. */
static OstGlobal position(OstGlobal label)
{
    for (OstLocal i = 0; i < chunk->node_count; i++)
        if (chunk->node_label[i] == label)
            return i;
    fail_msg("no node %d", (int)label);
    return -1;
}

static void assert_nodes(const OstGlobal *nodes, int count, const int *labels)
{
    for (int i = 0; i < count; i++)
        assert_int_equal(nodes[i], position(labels[i]));
}

/* Three tets on five nodes with gaps in the numbers; the last tet is in no physical volume. */
static const MshNode nodes4[] = {{10, {0, 0, 0}}, {20, {1, 0, 0}},    {31, {0, 1, 0}},
                                 {40, {0, 0, 1}}, {55, {1.25, 1, 1}}, {56, {-1, -1, 0.1}}};
static const MshElement elements4[] = {{1, 15, 0, 3, 1, {10}},
                                       {2, 1, 1, 4, 2, {10, 20}},
                                       {3, 2, 2, 5, 3, {10, 31, 20}},
                                       {4, 2, 2, 6, 4, {10, 20, 40}},
                                       {7, 4, 3, 1, 5, {10, 20, 31, 40}},
                                       {9, 4, 3, 2, 6, {20, 31, 40, 55}},
                                       {12, 4, 3, 0, 7, {10, 31, 56, 40}}};
static const MshModel model4 = {"4\n0 3 \"tip\"\n2 5 \"pull side\"\n3 1 \"cortical\"\n3 2 \"spongy\"\n", 6, 7, nodes4,
                                elements4};

/* Version 1 has no names. */
static void check_model4(int version)
{
    const int named = version > 10;
    assert_int_equal(chunk->nodes_per_tet, 4);
    assert_int_equal(chunk->global_nodes, 6);
    assert_int_equal(chunk->node_count, 6);
    assert_int_equal(chunk->global_tets, 3);
    assert_int_equal(chunk->tet_count, 3);
    for (int n = 0; n < 6; n++)
        for (int c = 0; c < 3; c++)
            assert_true(chunk->coordinates[3 * position(nodes4[n].tag) + c] == nodes4[n].x[c]);
    assert_int_equal(chunk->regions.count, 3);
    const char *const regions[] = {named ? "cortical" : "volume-1", named ? "spongy" : "volume-2", "unnamed"};
    for (int t = 0; t < 3; t++) {
        assert_nodes(chunk->tet_nodes + 4 * t, 4, elements4[4 + t].nodes);
        assert_int_equal(chunk->tet_label[t], elements4[4 + t].tag);
        assert_string_equal(chunk->regions.name[chunk->tet_region[t]], regions[t]);
    }
    const char *const names[] = {named ? "tip" : "point-3", "curve-4", named ? "pull side" : "surface-5", "surface-6"};
    assert_int_equal(chunk->boundary_count, 4);
    for (int b = 0; b < 4; b++) {
        const OstBoundary *found = boundary(names[b]);
        assert_int_equal(found->dimension, elements4[b].dimension);
        assert_int_equal(found->nodes_per_item, elements4[b].dimension + 1);
        assert_int_equal(found->count, 1);
        assert_nodes(found->nodes, found->nodes_per_item, elements4[b].nodes);
    }
    assert_int_equal(materials->count, 0);
}

static void every_flavour_gives_the_same_mesh(void **state)
{
    for (int f = 0; f < MSH_FLAVOURS; f++) {
        const char *path = msh_write(&model4, msh_flavours[f], "flavour.msh");
        const OstStatus status = read_mesh(path);
        if (status != OST_SUCCESS)
            fail_msg("%s: %s", msh_flavours[f].name, ost_error_text(ctx));
        check_model4(msh_flavours[f].version);
        drop_mesh();
    }
}

/* XML, JSON and case files hold UTF-8 without control characters. */
static void names_become_plain(void **state)
{
    const MshModel model = {"3\n2 5 \"sp\xc3\xa4t\"\n3 1 \"H\xf6hle\x01x\"\n3 2 \"\xe4\xc4\"\n", 6, 7, nodes4,
                            elements4};
    assert_success(read_mesh(msh_write(&model, msh_flavours[MSH_22_TEXT], "plain.msh")));
    assert_string_equal(chunk->regions.name[0], "H\xc3\xb6hle x");
    assert_string_equal(chunk->regions.name[1], "\xc3\xa4\xc3\x84");
    boundary("sp\xc3\xa4t");
    drop_mesh();
    const MshModel twice = {"2\n3 1 \"a\x01\"\n3 2 \"a\x02\"\n", 6, 7, nodes4, elements4};
    assert_failure(read_mesh(msh_write(&twice, msh_flavours[MSH_22_TEXT], "twice.msh")), OST_INVALID_INPUT,
                   "twice.msh: two regions are called 'a ', but for control characters");
}

static void without_physical_volumes_there_is_one_region(void **state)
{
    const MshElement tet = {3, 4, 3, 0, 1, {10, 20, 31, 40}};
    const MshModel model = {NULL, 4, 1, nodes4, &tet};
    for (int f = 0; f < MSH_FLAVOURS; f++) {
        assert_success(read_mesh(msh_write(&model, msh_flavours[f], "one.msh")));
        assert_int_equal(chunk->regions.count, 1);
        assert_string_equal(chunk->regions.name[0], "volume");
        assert_int_equal(chunk->tet_region[0], 0);
        assert_int_equal(chunk->tet_label[0], 3);
        drop_mesh();
    }
}

/* Gmsh's manual: the mid-edge nodes of a Tetrahedron 10 are on the edges 01 12 02 03 23 13, ours on 01 12 02 03 13 23.
 */
static void second_order_tets_come_in_our_order(void **state)
{
    static const double corner[4][3] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
    static const int gmsh_edge[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}};
    static const int our_edge[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
    static const int face_edge[3][2] = {{0, 1}, {1, 2}, {2, 0}};
    MshNode nodes[10];
    for (int n = 0; n < 10; n++) {
        nodes[n].tag = n + 1;
        for (int c = 0; c < 3; c++)
            nodes[n].x[c] =
                n < 4 ? corner[n][c] : (corner[gmsh_edge[n - 4][0]][c] + corner[gmsh_edge[n - 4][1]][c]) / 2;
    }
    const MshElement elements[] = {{1, 8, 1, 8, 1, {1, 2, 5}},
                                   {2, 9, 2, 9, 2, {1, 2, 3, 5, 6, 7}},
                                   {3, 11, 3, 1, 3, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}}};
    const MshModel model = {NULL, 10, 3, nodes, elements};
    for (int f = 0; f < MSH_FLAVOURS; f++) {
        assert_success(read_mesh(msh_write(&model, msh_flavours[f], "second.msh")));
        assert_int_equal(chunk->nodes_per_tet, 10);
        for (int e = 0; e < 6; e++)
            for (int c = 0; c < 3; c++)
                assert_true(chunk->coordinates[3 * chunk->tet_nodes[4 + e] + c] ==
                            (corner[our_edge[e][0]][c] + corner[our_edge[e][1]][c]) / 2);
        const OstBoundary *face = boundary("surface-9");
        assert_int_equal(face->nodes_per_item, 6);
        for (int e = 0; e < 3; e++)
            for (int c = 0; c < 3; c++)
                assert_true(chunk->coordinates[3 * face->nodes[3 + e] + c] ==
                            (corner[face_edge[e][0]][c] + corner[face_edge[e][1]][c]) / 2);
        assert_int_equal(boundary("curve-8")->nodes_per_item, 3);
        assert_string_equal(chunk->regions.name[0], "volume-1");
        drop_mesh();
    }
}

static void tets_come_in_the_order_of_their_tags(void **state)
{
    const MshElement elements[] = {{8, 4, 3, 1, 1, {10, 20, 31, 40}}, {5, 4, 3, 2, 2, {20, 31, 40, 55}}};
    const MshModel model = {NULL, 5, 2, nodes4, elements};
    for (int f = 0; f < MSH_FLAVOURS; f++) {
        assert_success(read_and_listen(msh_write(&model, msh_flavours[f], "order.msh")));
        assert_int_equal(warnings, 1);
        assert_non_null(strstr(warning, "its tets are not in the order of their tags"));
        assert_int_equal(chunk->tet_label[0], 5);
        assert_nodes(chunk->tet_nodes, 4, elements[1].nodes);
        assert_string_equal(chunk->regions.name[chunk->tet_region[0]], "volume-2");
        assert_int_equal(chunk->tet_label[1], 8);
        drop_mesh();
    }
}

/* Other programs write 2.2 with one entity for all elements; the physical tag of each element counts. */
static void elements_of_one_entity_stay_in_their_groups(void **state)
{
    const MshElement elements[] = {{1, 2, 2, 5, 1, {10, 31, 20}},
                                   {2, 2, 2, 6, 1, {10, 20, 40}},
                                   {3, 2, 2, 6, 1, {10, 40, 31}},
                                   {4, 4, 3, 1, 1, {10, 20, 31, 40}},
                                   {5, 4, 3, 2, 1, {20, 31, 40, 55}}};
    const MshModel model = {NULL, 5, 5, nodes4, elements};
    for (int f = 0; msh_flavours[f].version < 40; f++) {
        assert_success(read_mesh(msh_write(&model, msh_flavours[f], "entity.msh")));
        assert_int_equal(boundary("surface-5")->count, 1);
        assert_int_equal(boundary("surface-6")->count, 2);
        assert_int_equal(chunk->regions.count, 2);
        drop_mesh();
    }
}

static void groups_of_one_name_are_one(void **state)
{
    MshModel model = model4;
    model.names = "4\n2 5 \"skin\"\n2 6 \"skin\"\n3 1 \"bone\"\n3 2 \"bone\"\n";
    for (int f = 1; f < MSH_FLAVOURS; f++) {
        assert_success(read_and_listen(msh_write(&model, msh_flavours[f], "skin.msh")));
        assert_int_equal(boundary("skin")->count, 2);
        assert_int_equal(chunk->regions.count, 2);
        assert_int_equal(chunk->tet_region[0], chunk->tet_region[1]);
        assert_int_equal(warnings, 2);
        assert_non_null(
            strstr(warning, "the physical surfaces 5 and 6 have the same name 'skin'; they are taken as one"));
        drop_mesh();
    }
    model.names = "2\n1 4 \"skin\"\n2 6 \"skin\"\n";
    assert_failure(read_mesh(msh_write(&model, msh_flavours[MSH_22_TEXT], "skin.msh")), OST_INVALID_INPUT,
                   "the physical name 'skin' stands for surface 6 and curve 4; give each its own");
}

static void refuse(const MshElement *elements, int count, const char *text)
{
    const MshModel model = {NULL, 6, count, nodes4, elements};
    for (int f = 0; f < MSH_FLAVOURS; f++) {
        assert_failure(read_mesh(msh_write(&model, msh_flavours[f], "refused.msh")), OST_INVALID_INPUT, text);
        assert_non_null(strstr(ost_error_text(ctx), "refused.msh"));
        assert_null(chunk);
        assert_null(materials);
    }
}

static const MshElement tet_a = {7, 4, 3, 1, 5, {10, 20, 31, 40}};
static const MshElement tet_b = {8, 4, 3, 1, 5, {20, 31, 40, 55}};
static const MshElement tet_c = {9, 4, 3, 1, 5, {10, 31, 56, 40}};

static double volume_of_tet(OstLocal t)
{
    double edge[9];
    const OstGlobal *nodes = chunk->tet_nodes + 4 * (size_t)t;
    for (int e = 0; e < 9; e++)
        edge[e] = chunk->coordinates[3 * nodes[e / 3 + 1] + e % 3] - chunk->coordinates[3 * nodes[0] + e % 3];
    return ost_determinant3(edge) / 6.0;
}

/* A cube, and a pyramid on top of it: the pieces of element 12 are 121 to 126. */
static void hexahedra_and_pyramids_become_tets(void **state)
{
    static const MshNode nodes[] = {{10, {0, 0, 0}}, {20, {1, 0, 0}}, {31, {1, 1, 0}},
                                    {40, {0, 1, 0}}, {5, {0, 0, 1}},  {56, {1, 0, 1}},
                                    {57, {1, 1, 1}}, {58, {0, 1, 1}}, {3, {0.5, 0.5, 2}}};
    static const MshElement elements[] = {{1, 3, 2, 5, 3, {10, 20, 56, 5}},
                                          {12, 5, 3, 1, 5, {10, 20, 31, 40, 5, 56, 57, 58}},
                                          {13, 7, 3, 2, 6, {5, 56, 57, 58, 3}}};
    const MshModel model = {NULL, 9, 3, nodes, elements};
    for (int f = 0; f < MSH_FLAVOURS; f++) {
        double volume[2] = {0.0, 0.0};
        assert_success(read_and_listen(msh_write(&model, msh_flavours[f], "solids.msh")));
        assert_int_equal(warnings, 0);
        assert_int_equal(boundary("surface-5")->count, 2);
        for (OstLocal t = 0; t < chunk->tet_count; t++) {
            const int top = chunk->tet_label[t] / 10 == 13;
            assert_int_equal(chunk->tet_label[t], top ? 131 + t - (chunk->tet_count - 2) : 121 + t);
            assert_string_equal(chunk->regions.name[chunk->tet_region[t]], top ? "volume-2" : "volume-1");
            assert_true(volume_of_tet(t) > 0.1);
            volume[top] += volume_of_tet(t);
        }
        assert_close(volume[0], 1.0, 1e-15);
        assert_close(volume[1], 1.0 / 3.0, 1e-15);
        drop_mesh();
    }
}

static void a_mesh_without_tets_is_refused(void **state)
{
    const MshElement faces[] = {{1, 2, 2, 5, 1, {10, 20, 31}}, {2, 2, 2, 5, 1, {40, 55, 56}}};
    const MshModel model = {NULL, 6, 2, nodes4, faces};
    for (int f = 0; f < MSH_FLAVOURS; f++) {
        assert_failure(read_mesh(msh_write(&model, msh_flavours[f], "shell.msh")), OST_INVALID_INPUT,
                       "shell.msh: holds no tets among its 2 elements; mesh the volume (gmsh -3 MODEL.geo -o NEW.msh)");
    }
}

static void quadrilaterals_in_a_boundary_are_refused(void **state)
{
    const MshElement quad = {1, 3, 2, 5, 3, {10, 20, 55, 31}};
    refuse((MshElement[]){quad, tet_a, tet_b, tet_c}, 4,
           "boundary 'surface-5' holds elements of Gmsh's type 'Quadrilateral 4', expected 'Triangle 3'");
}

/* Version 2 has such a tet once for each volume, version 4 says it of the entity. Volumes of one tet, and of all. */
static void a_tet_in_several_volumes_is_in_the_smallest(void **state)
{
    MshElement again = tet_a, all = tet_a;
    again.tag = 20;
    again.physical = 2;
    again.entity = 6;
    const MshModel model = {NULL, 6, 4, nodes4, (MshElement[]){tet_a, tet_b, tet_c, again}};
    for (int f = 0; f < MSH_FLAVOURS; f++) {
        assert_success(read_and_listen(msh_write(&model, msh_flavours[f], "shared.msh")));
        assert_int_equal(warnings, 1);
        assert_non_null(strstr(warning, "shared.msh: tets in several physical volumes: 1; each is put into the "
                                        "smallest of these only"));
        assert_int_equal(chunk->tet_count, 3);
        assert_int_equal(chunk->global_tets, 3);
        assert_int_equal(chunk->tet_label[0], 7);
        assert_string_equal(chunk->regions.name[chunk->tet_region[0]], "volume-2");
        assert_string_equal(chunk->regions.name[chunk->tet_region[1]], "volume-1");
        drop_mesh();
    }
    static const char all_and_parts[] = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n3 1 \"all\"\n"
                                        "3 3 \"low\"\n3 4 \"high\"\n$EndPhysicalNames\n$Entities\n0 0 0 2\n"
                                        "1 0 0 0 1 1 1 2 1 3 0\n2 0 0 0 1 1 1 2 -4 1 0\n$EndEntities\n"
                                        "$Nodes\n1 5 1 5\n3 1 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
                                        "1.25 1 1\n$EndNodes\n$Elements\n2 2 1 2\n3 1 4 1\n1 1 2 3 4\n"
                                        "3 2 4 1\n2 2 3 4 5\n$EndElements\n";
    assert_success(read_and_listen(write_text("all.msh", all_and_parts)));
    assert_int_equal(warnings, 2);
    assert_non_null(strstr(warning, "region 'all' has no tets that are in no smaller region, and is left out"));
    assert_int_equal(chunk->tet_count, 2);
    assert_int_equal(chunk->regions.count, 2);
    assert_string_equal(chunk->regions.name[chunk->tet_region[0]], "low");
    assert_string_equal(chunk->regions.name[chunk->tet_region[1]], "high");
    drop_mesh();
    all.tag = 20;
    refuse((MshElement[]){tet_a, tet_b, tet_c, all}, 4, "tets 7 and 20 of region 'volume-1' have the same vertices");
}

static void repeated_tags_of_tets_are_replaced(void **state)
{
    MshElement again = tet_b;
    again.tag = tet_a.tag;
    const MshModel twice = {NULL, 6, 3, nodes4, (MshElement[]){tet_a, again, tet_c}};
    for (int f = 0; f < MSH_FLAVOURS; f++) {
        assert_success(read_and_listen(msh_write(&twice, msh_flavours[f], "repeated.msh")));
        assert_int_equal(warnings, 1);
        assert_non_null(strstr(warning, "repeated.msh: element tag 7 is given to several tets; tets are numbered from "
                                        "1 as they come"));
        for (int t = 0; t < 3; t++)
            assert_int_equal(chunk->tet_label[t], t + 1);
        assert_nodes(chunk->tet_nodes + 4, 4, tet_b.nodes);
        drop_mesh();
    }
}

static void repeated_tags_of_nodes_are_refused(void **state)
{
    MshNode nodes[6];
    memcpy(nodes, nodes4, sizeof nodes);
    nodes[5].tag = 55;
    const MshModel model = {NULL, 6, 2, nodes, (MshElement[]){tet_a, tet_b}};
    for (int f = 0; f < MSH_FLAVOURS; f++)
        assert_failure(read_mesh(msh_write(&model, msh_flavours[f], "repeated.msh")), OST_INVALID_INPUT,
                       "node tag 55 is given to two nodes");
}

/* Gmsh writes the centres of arcs, and faces that a volume does not have. */
static void nodes_of_no_tet_are_left_out(void **state)
{
    const MshElement elements[] = {{1, 15, 0, 3, 1, {56}},
                                   {2, 2, 2, 5, 3, {10, 31, 20}},
                                   {3, 2, 2, 5, 3, {10, 31, 56}},
                                   {4, 4, 3, 1, 5, {10, 20, 31, 40}}};
    const MshNode nodes[] = {{56, {9, 9, 9}}, {10, {0, 0, 0}}, {20, {1, 0, 0}},
                             {55, {5, 5, 5}}, {31, {0, 1, 0}}, {40, {0, 0, 1}}};
    const MshModel model = {NULL, 6, 4, nodes, elements};
    for (int f = 0; f < MSH_FLAVOURS; f++) {
        assert_success(read_and_listen(msh_write(&model, msh_flavours[f], "unused.msh")));
        assert_int_equal(warnings, 1);
        assert_non_null(strstr(warning, "unused.msh: 2 vertices are used by no tet and left out, and 2 points, "
                                        "curves and faces of boundaries with them"));
        assert_int_equal(chunk->node_count, 4);
        assert_int_equal(chunk->global_nodes, 4);
        for (int n = 0; n < 4; n++) {
            assert_int_equal(chunk->tet_nodes[n], n);
            assert_int_equal(chunk->node_label[n], elements[3].nodes[n]);
        }
        assert_true(chunk->coordinates[3 * 2 + 1] == 1.0);
        assert_int_equal(boundary("point-3")->count, 0);
        assert_int_equal(boundary("surface-5")->count, 1);
        assert_nodes(boundary("surface-5")->nodes, 3, elements[1].nodes);
        drop_mesh();
    }
}

static double first_volume(void)
{
    double edge[3][3];
    for (int e = 0; e < 3; e++)
        for (int d = 0; d < 3; d++)
            edge[e][d] =
                chunk->coordinates[3 * chunk->tet_nodes[e + 1] + d] - chunk->coordinates[3 * chunk->tet_nodes[0] + d];
    return edge[0][0] * (edge[1][1] * edge[2][2] - edge[1][2] * edge[2][1]) -
           edge[0][1] * (edge[1][0] * edge[2][2] - edge[1][2] * edge[2][0]) +
           edge[0][2] * (edge[1][0] * edge[2][1] - edge[1][1] * edge[2][0]);
}

static void tets_the_other_way_round_are_turned(void **state)
{
    MshElement elements[] = {{7, 4, 3, 1, 5, {20, 10, 31, 40}}, {9, 4, 3, 1, 5, {31, 20, 40, 55}}};
    const MshModel model = {NULL, 5, 2, nodes4, elements};
    assert_success(read_and_listen(msh_write(&model, msh_flavours[MSH_41_TEXT], "turned.msh")));
    assert_int_equal(warnings, 1);
    assert_non_null(strstr(warning, "turned.msh: all tets are inverted; their vertices were reordered"));
    assert_true(first_volume() > 0.0);
    drop_mesh();
    memcpy(elements[0].nodes, (int[]){10, 20, 31, 40}, 4 * sizeof(int));
    assert_success(read_and_listen(msh_write(&model, msh_flavours[MSH_41_TEXT], "mixed.msh")));
    assert_int_equal(warnings, 0);
    OstMesh *mesh = NULL;
    assert_failure(ost_mesh_distribute(ctx, &chunk, &mesh), OST_INVALID_INPUT, "tet 9 is inverted");
    drop_mesh();
}

/* A turned tet of ten nodes has each mid-edge node on its edge. */
static void turned_tets_keep_their_middles(void **state)
{
    static const int corner[10][2] = {{0, 0}, {2, 2}, {1, 1}, {3, 3}, {0, 2}, {2, 1}, {0, 1}, {0, 3}, {1, 3}, {2, 3}};
    static const double x[4][3] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
    static const int edge[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
    MshNode nodes[10];
    MshElement tet = {3, 11, 3, 1, 3, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}};
    for (int n = 0; n < 10; n++) {
        nodes[n].tag = n + 1;
        for (int c = 0; c < 3; c++)
            nodes[n].x[c] = (x[corner[n][0]][c] + x[corner[n][1]][c]) / 2;
    }
    const MshModel model = {NULL, 10, 1, nodes, &tet};
    assert_success(read_and_listen(msh_write(&model, msh_flavours[MSH_22_BINARY], "turned10.msh")));
    assert_int_equal(warnings, 1);
    assert_true(first_volume() > 0.0);
    for (int e = 0; e < 6; e++)
        for (int c = 0; c < 3; c++)
            assert_true(2 * chunk->coordinates[3 * chunk->tet_nodes[4 + e] + c] ==
                        chunk->coordinates[3 * chunk->tet_nodes[edge[e][0]] + c] +
                            chunk->coordinates[3 * chunk->tet_nodes[edge[e][1]] + c]);
    drop_mesh();
}

/* What follows the end mark of the elements may be cut; everything else is missed. */
static void every_cut_file_is_refused(void **state)
{
    static MshFile file;
    for (int f = 0; f < MSH_FLAVOURS; f++) {
        msh_make(&model4, msh_flavours[f], &file);
        const char *path = write_bytes("cut.msh", file.bytes, file.length);
        for (size_t length = file.length - 1; length-- > 0;) {
            assert_int_equal(truncate(path, (off_t)length), 0);
            const OstStatus status = read_mesh(path);
            if (status != OST_INVALID_INPUT || !strstr(ost_error_text(ctx), "cut.msh"))
                fail_msg("%s cut at %zu of %zu: %s '%s'", msh_flavours[f].name, length, file.length,
                         ost_status_name(status), ost_error_text(ctx));
        }
    }
}

static void put_byte(const char *path, size_t place, char byte)
{
    FILE *file = fopen(path, "r+b");
    assert_non_null(file);
    assert_int_equal(fseek(file, (long)place, SEEK_SET), 0);
    assert_int_equal(fputc(byte, file), (unsigned char)byte);
    assert_int_equal(fclose(file), 0);
}

/* One byte is changed at a time. Some changes give another mesh; none may crash, hang or leave anything behind. */
static void damaged_files_do_no_harm(void **state)
{
    static MshFile file;
    unsigned random = 12345;
    int refused = 0;
    ost_log_set_level(ctx, OST_LOG_QUIET);
    for (int f = 0; f < MSH_FLAVOURS; f++) {
        msh_make(&model4, msh_flavours[f], &file);
        const char *path = write_bytes("damaged.msh", file.bytes, file.length);
        for (size_t place = 0; place < file.length; place += 3) {
            random = random * 1103515245u + 12345u;
            put_byte(path, place, (char)(random >> 16));
            const OstStatus status = read_mesh(path);
            assert_true(status == OST_SUCCESS || strstr(ost_error_text(ctx), "damaged.msh"));
            refused += status != OST_SUCCESS;
            drop_mesh();
            put_byte(path, place, file.bytes[place]);
        }
    }
    ost_log_set_level(ctx, OST_LOG_NORMAL);
    assert_true(refused > 100);
}

static void refuse_text(const char *contents, const char *text)
{
    assert_failure(read_mesh(write_text("text.msh", contents)), OST_INVALID_INPUT, text);
    assert_non_null(strstr(ost_error_text(ctx), "text.msh"));
}

#define HEAD22 "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
#define NODES "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
#define NODES22 HEAD22 NODES
#define TET22 "$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n"
#define HEAD41 "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
#define ENTITIES41 "$Entities\n0 0 0 1\n1 0 0 0 1 1 1 1 7 0\n$EndEntities\n"
#define NODES41 "$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n"
#define ELEMENTS41 "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n"
#define MESH41 HEAD41 ENTITIES41 NODES41 ELEMENTS41
#define OTHERS                                                                                                  \
    "$Surface\n3\n1 2 3\n$EndSurface\n$Periodic\n1\n2 1 2\n0\n1\n1 2\n$EndPeriodic\n"                           \
    "$NodeData\n1\n\"$EndNodes\"\n1\n0.0\n3\n0\n1\n4\n1 0\n2 0\n3 0\n4 0\n$EndNodeData\n"                       \
    "$ElementData\n1\n\"x\"\n1\n0.0\n3\n0\n1\n1\n1 5\n$EndElementData\n$ElementNodeData\n$EndElementNodeData\n" \
    "$Parametrizations\n0 0\n$EndParametrizations\n$InterpolationScheme\n$EndInterpolationScheme\n"

static void what_is_no_mesh_is_refused(void **state)
{
    refuse_text("Point(1) = {0, 0, 0};\n", "text.msh:1: 'Point(1) = {0, 0, 0};' found, expected $MeshFormat: not a");
    refuse_text("$Nodes\n1\n", "text.msh:1: '$Nodes' found, expected $MeshFormat: not a Gmsh mesh");
    refuse_text("", "is empty");
    refuse_text("\n", "not a Gmsh mesh");
}

static void wrong_files_are_refused_where_they_are_wrong(void **state)
{
    refuse_text("$MeshFormat\n5.0 0 8\n$EndMeshFormat\n",
                "text.msh:2: version 5 of the format found, expected 1 to 4.1; convert the file with gmsh -save "
                "FILE.msh -format msh41 -o NEW.msh");
    refuse_text("$MeshFormat\nx 0 8\n$EndMeshFormat\n", "text.msh:2: 'x' found, expected the version");
    refuse_text("$MeshFormat\n4.1 1 4\n$EndMeshFormat\n", "text.msh:2: numbers of 4 bytes");
    refuse_text("$MeshFormat\n4.1 1 8\nabcde\n$EndMeshFormat\n", "byte 20: 1684234849 found where the number one");
    refuse_text(HEAD22, "the file ends without a section $Nodes");
    refuse_text(NODES22, "the file ends without a section $Elements");
    refuse_text(NODES22 "$Nodes\n1\n1 0 0 0\n$EndNodes\n", "text.msh:11: a section $Nodes found, expected");
    refuse_text(NODES22 TET22 "$Elements\n1\n2 4 2 1 1 1 2 3 4\n$EndElements\n",
                "text.msh:15: a section $Elements found, expected");
    refuse_text(HEAD22 TET22 NODES, "text.msh:4: a section $Elements found, expected $Entities, one $Nodes");
    refuse_text(HEAD22 "$Nodes\n999999999\n", "text.msh:5: 999999999 nodes stated, which do not fit");
    refuse_text(HEAD22 "$Nodes\n-1\n", "text.msh:5: '-1' found");
    refuse_text(HEAD22 "$Nodes\n\n1\n", "text.msh:5: '' found, expected the number of nodes");
    refuse_text(HEAD22 "$Nodes\n1\n1 0 nan 0\n", "text.msh:6: nan found, expected a coordinate that is finite");
    refuse_text(HEAD22 "$Nodes\n1\n1 0 1e999 0\n", "text.msh:6: inf found");
    refuse_text(HEAD22 "$Nodes\n1\n1 0 0,5 0\n", "text.msh:6: '0,5' found, expected a coordinate");
    refuse_text(HEAD22 "$Nodes\n1\n-1 0 0 0\n", "node tag -1 found");
    refuse_text(HEAD22 "$Nodes\n1\n1 0 0 0\n2 0 0 0\n$EndNodes\n", "text.msh:7: '2 0 0 0' found, expected $EndNodes");
    refuse_text(HEAD22 "$NodeData\n1\n", "text.msh:4: the section $NodeData has no end $EndNodeData");
    refuse_text(NODES22 "$Elements\n1\n1 4 2 1 1 1 2 3 5\n$EndElements\n", "text.msh:13: an element uses node 5");
    refuse_text(NODES22 "$Elements\n1\n1 29 2 1 1 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20\n$EndElements\n",
                "holds 1 elements of Gmsh's type 'Tetrahedron 20', expected linear or quadratic ones");
    refuse_text(NODES22 "$Elements\n2\n1 7 2 1 1 1 2 3 4 4\n2 11 2 1 1 1 2 3 4 1 2 3 4 1 2\n$EndElements\n",
                "holds 1 linear and 1 quadratic solid elements");
    refuse_text(NODES22 "$Elements\n1\n1 4 -4 1 1 1 2 3 4\n$EndElements\n", "an element has -4 tags");
    refuse_text(NODES22 "$Elements\n1\n1 92 2 1 1 1 2 3 4\n$EndElements\n", "text.msh:13: element of type 92 found");
    refuse_text(NODES22 "$Elements\n2\n1 4 2 1 1 1 2 3 4\n$EndElements\n", "'$EndElements' found, expected");
    refuse_text(HEAD22 "$PhysicalNames\n1\n7 1 \"x\"\n$EndPhysicalNames\n",
                "text.msh:6: a physical name of dimension 7");
    refuse_text(HEAD22 "$PhysicalNames\n1\n3 1 \"x\n$EndPhysicalNames\n",
                "text.msh:6: '\"x' found, expected a physical name");
    refuse_text("$NOD\n1\n1 0 0 0\n$ENDNOD\n$ELM\n1\n1 4 1 1 3 1 1 1\n$ENDELM\n",
                "text.msh:7: an element of type 4 with 3 nodes found, expected 4");
    refuse_text(HEAD41 "$Nodes\n1 4 1 4\n3 1 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n",
                "a block of 5 nodes found where 4 are left");
    refuse_text(HEAD41 "$Nodes\n1 1 1 1\n3 1 0 0\n$EndNodes\n\n", "the blocks hold 1 nodes fewer than the head");
    refuse_text(HEAD41 "$Nodes\n1 1 1 1\n4 1 0 1\n1\n0 0 0\n", "nodes of an entity of dimension 4");
    refuse_text(HEAD41 "$Nodes\n0 1000000000000 1 1\n", "1000000000000 nodes stated");
    refuse_text(HEAD41 "$Entities\n0 0 0 1\n1 0 0 0 1 1 1 99999999999\n", "99999999999 physical groups");
    refuse_text(MESH41 "$Entities\n0 0 0 0\n$EndEntities\n", "a section $Entities found, expected");
}

/* Sections that tell nothing of the mesh, as PyMesh, meshio, TetWild and Gmsh write them; words where Gmsh does not
 * look. */
static void other_sections_and_words_are_skipped(void **state)
{
    static const char *const files[] = {
        NODES22 "\n$Comments\nmade by hand\n$EndComments\n$Elements\r\n1\n1 4 2 1 1 1 2 3 4\n$EndElements",
        "$Comments\nat the top\n$EndComments\n" HEAD22 OTHERS NODES OTHERS TET22 OTHERS,
        HEAD41 OTHERS ENTITIES41 OTHERS NODES41 OTHERS ELEMENTS41 OTHERS,
        "$MeshFormat now\n2.2 0 8 with words\n$EndMeshFormat and\nwords between\n$Nodes behind\n4 nodes\n"
        "1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes //\n" TET22 "words at the end\n",
        HEAD41 NODES41 "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4 five\n$EndElements\n"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        assert_success(read_mesh(write_text("words.msh", files[i])));
        assert_int_equal(chunk->tet_count, 1);
        assert_int_equal(chunk->node_count, 4);
        drop_mesh();
    }
}

/* In binary files a section may hold anything. */
static void other_binary_sections_are_skipped(void **state)
{
    static MshFile file;
    static const char data[] = "$NodeData\n1\n\"$Nodes\"\n1\n0\n3\n0\n1\n1\n\0\0$Elements\n\1\xff$EndNodeData\n";
    for (int f = 0; f < MSH_FLAVOURS; f++) {
        if (!msh_flavours[f].binary)
            continue;
        msh_make(&model4, msh_flavours[f], &file);
        const char *mark = memmem(file.bytes, file.length, "$Nodes", 6);
        const size_t before = (size_t)(mark - file.bytes), added = sizeof data - 1;
        memmove(file.bytes + before + added, mark, file.length - before);
        memcpy(file.bytes + before, data, added);
        assert_success(read_mesh(write_bytes("data.msh", file.bytes, file.length + added)));
        check_model4(msh_flavours[f].version);
        drop_mesh();
    }
}

/* PyMesh and TetWild write the end of a section right behind its bytes. */
static void ends_may_follow_bytes_at_once(void **state)
{
    static MshFile file;
    static const char *const ends[] = {"\n$EndMeshFormat", "\n$EndNodes", "\n$EndElements"};
    for (int f = 0; f < MSH_FLAVOURS; f++) {
        if (!msh_flavours[f].binary)
            continue;
        msh_make(&model4, msh_flavours[f], &file);
        for (int e = 0; e < 3; e++) {
            char *end = memmem(file.bytes, file.length, ends[e], strlen(ends[e]));
            file.length--;
            memmove(end, end + 1, file.length - (size_t)(end - file.bytes));
        }
        assert_success(read_mesh(write_bytes("ends.msh", file.bytes, file.length)));
        check_model4(msh_flavours[f].version);
        drop_mesh();
    }
}

#define LARGE_FIELD "$ElementData\n1\n\"x\"\n1\n0.0\n3\n0\n1\n1\n5000000000 5\n$EndElementData\n"

static void tags_may_be_zero_sparse_and_many(void **state)
{
    assert_success(read_mesh(
        write_text("tags.msh", HEAD22
                   "$PhysicalNames\n2\n3 4 bone\n2 -3 \"skin\" outside\n$EndPhysicalNames\n"
                   "$Nodes\n4\n2000000000 0 0 0\n0 1 0 0\n77 0 1 0\n5 0 0 1\n$EndNodes\n$Elements\n3\n"
                   "0 4 6 4 1 3 1 -2 -3 2000000000 0 77 5\n0 2 4 -3 1 1 1 0 77 5\n0 2 0 0 77 5\n$EndElements\n")));
    assert_int_equal(chunk->tet_label[0], 0);
    assert_string_equal(chunk->regions.name[0], "bone");
    assert_nodes(chunk->tet_nodes, 4, (int[]){2000000000, 0, 77, 5});
    assert_int_equal(chunk->boundary_count, 1);
    assert_nodes(boundary("skin")->nodes, 3, (int[]){0, 77, 5});
    drop_mesh();
}

/* Beyond 32 bits, in every version whose text has no type for tags; fields find them too. */
static void tags_of_texts_may_be_large(void **state)
{
    static const char *const files[] = {
        HEAD22 "$Nodes\n4\n3000000000 0 0 0\n2 1 0 0\n3 0 1 0\n100000000000 0 0 1\n$EndNodes\n"
               "$Elements\n1\n5000000000 4 2 1 1 3000000000 2 3 100000000000\n$EndElements\n" LARGE_FIELD,
        "$MeshFormat\n3 0 8\n$EndMeshFormat\n"
        "$Nodes\n4\n3000000000 0 0 0 0\n2 1 0 0 0\n3 0 1 0 0\n100000000000 0 0 1 0\n$EndNodes\n"
        "$Elements\n1\n5000000000 4 1 4 3000000000 2 3 100000000000\n$EndElements\n" LARGE_FIELD};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        OstFileField field = {0};
        assert_success(read_mesh(write_text("large.msh", files[i])));
        assert_true(chunk->tet_label[0] == 5000000000);
        assert_true(chunk->node_label[position(3000000000)] == 3000000000);
        for (int n = 0; n < 4; n++)
            assert_int_equal(chunk->tet_nodes[n], position((OstGlobal[]){3000000000, 2, 3, 100000000000}[n]));
        assert_success(ost_msh_read_field(ctx, scratch("large.msh"), "x", chunk, &field));
        assert_true(field.values[0] == 5.0);
        OST_FREE(field.values);
        drop_mesh();
    }
}

/* Nodes with their parameters on curves, surfaces and in volumes. */
static void parametric_nodes_are_read(void **state)
{
    static const char *const files[] = {
        HEAD22 "$ParametricNodes\n4\n1 0 0 0 0 1\n2 1 0 0 1 1 0.5\n3 0 1 0 2 1 0.5 0.5\n4 0 0 1 3 1\n"
               "$EndParametricNodes\n" TET22,
        HEAD41 ENTITIES41 "$Nodes\n3 4 1 4\n1 1 1 1\n1\n0 0 0 0.5\n2 1 1 2\n2\n3\n1 0 0 0.5 0.5\n0 1 0 0.5 0.5\n"
                          "3 1 1 1\n4\n0 0 1 7 7 7\n$EndNodes\n" ELEMENTS41};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        assert_success(read_mesh(write_text("parametric.msh", files[i])));
        for (int n = 0; n < 4; n++) {
            assert_int_equal(chunk->node_label[n], n + 1);
            for (int d = 0; d < 3; d++)
                assert_true(chunk->coordinates[3 * n + d] == (n == d + 1 ? 1.0 : 0.0));
        }
        drop_mesh();
    }
}

/* Two volumes made of one, the face between them, and a volume that holds an element again for another partition. The
 * face is given the group of the volume, which is no surface's. */
static void partitioned_files_are_one_body(void **state)
{
    assert_success(read_and_listen(write_text(
        "parts.msh",
        HEAD41 "$PhysicalNames\n2\n2 7 \"skin\"\n3 7 \"bone\"\n$EndPhysicalNames\n"
               "$Entities\n0 0 1 1\n1 0 0 0 1 1 1 1 7 0\n1 0 0 0 1 1 1 1 7 0\n$EndEntities\n"
               "$PartitionedEntities\n2\n1\n9 2\n0 0 2 2\n2 2 1 1 1 0 0 0 1 1 1 1 7 0\n3 3 1 2 1 2 0 0 0 1 1 1 1 7 0\n"
               "4 3 1 1 1 0 0 0 1 1 1 1 7 1 3\n5 3 1 1 2 0 0 0 1 1 1 1 7 1 -3\n$EndPartitionedEntities\n"
               "$Nodes\n1 5 1 5\n3 4 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1.25 1 1\n$EndNodes\n"
               "$Elements\n5 5 1 5\n2 2 2 1\n1 1 3 2\n2 3 2 1\n2 2 3 4\n3 4 4 1\n3 1 2 3 4\n3 5 4 1\n4 2 3 4 5\n"
               "3 9 4 1\n4 2 3 4 5\n$EndElements\n$GhostElements\n1\n4 2 1 1\n$EndGhostElements\n")));
    assert_int_equal(chunk->tet_count, 2);
    assert_int_equal(chunk->regions.count, 1);
    assert_string_equal(chunk->regions.name[0], "bone");
    assert_int_equal(chunk->boundary_count, 1);
    assert_int_equal(boundary("skin")->count, 1);
    assert_int_equal(warnings, 2);
    assert_non_null(strstr(heard, "parts.msh: ghost elements, which other partitions have too, are left out: 1\n"));
    assert_non_null(strstr(heard, "parts.msh: the faces, curves and points between partitions are left out of "
                                  "boundaries\n"));
    drop_mesh();
}

/* A face in two groups is in both boundaries. */
static void faces_may_be_in_several_groups(void **state)
{
    assert_success(read_mesh(write_text(
        "groups.msh", HEAD41 "$Entities\n0 0 1 1\n8 0 0 0 1 1 1 2 5 -6 0\n1 0 0 0 1 1 1 0 0\n$EndEntities\n" NODES41
                             "$Elements\n2 2 1 2\n2 8 2 1\n1 1 3 2\n3 1 4 1\n2 1 2 3 4\n$EndElements\n")));
    assert_int_equal(boundary("surface-5")->count, 1);
    assert_int_equal(boundary("surface-6")->count, 1);
    drop_mesh();
}

static const char *write_packed(const char *name, const void *bytes, size_t length)
{
    const char *path = scratch(name);
    gzFile file = gzopen(path, "wb9");
    assert_non_null(file);
    assert_int_equal(gzwrite(file, bytes, (unsigned)length), length);
    assert_int_equal(gzclose(file), Z_OK);
    return path;
}

static void packed_files_are_read(void **state)
{
    static MshFile file;
    for (int f = 0; f < MSH_FLAVOURS; f++) {
        msh_make(&model4, msh_flavours[f], &file);
        assert_success(read_mesh(write_packed("packed.msh.gz", file.bytes, file.length)));
        check_model4(msh_flavours[f].version);
        drop_mesh();
    }
    assert_failure(read_mesh(write_packed("line.msh.gz", NODES22, strlen(NODES22))), OST_INVALID_INPUT,
                   "line.msh.gz:11: the file ends without a section $Elements");
}

static void damaged_packed_files_are_refused(void **state)
{
    static MshFile file;
    static char packed[MSH_SIZE], zeros[1 << 22];
    msh_make(&model4, msh_flavours[MSH_41_BINARY], &file);
    FILE *stored = fopen(write_packed("whole.msh.gz", file.bytes, file.length), "rb");
    const size_t length = fread(packed, 1, sizeof packed, stored);
    fclose(stored);
    for (size_t cut = 2; cut < length; cut += 7)
        assert_failure(read_mesh(write_bytes("cut.msh.gz", packed, cut)), OST_INVALID_INPUT, "cut.msh.gz");
    packed[length / 2] ^= 0x55;
    assert_failure(read_mesh(write_bytes("flipped.msh.gz", packed, length)), OST_INVALID_INPUT,
                   "flipped.msh.gz: could not be read to its end");
    assert_failure(read_mesh(write_packed("bomb.msh.gz", zeros, sizeof zeros)), OST_INVALID_INPUT,
                   "bomb.msh.gz: unpacks to more than 50 times its size");
}

static void missing_files_and_unknown_endings_are_named(void **state)
{
    assert_failure(read_mesh(scratch("missing.msh")), OST_FILE_FAILED, "missing.msh: cannot be read: No such file");
    assert_failure(read_mesh(scratch("missing.stl")), OST_INVALID_INPUT, "files of STL are not read");
    assert_failure(read_mesh("folder.msh/mesh"), OST_INVALID_INPUT, "the ending ''");
    mkdir(scratch("folder.msh"), 0700);
    assert_failure(read_mesh(scratch("folder.msh")), OST_FILE_FAILED, "is a folder, expected a file");
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(every_flavour_gives_the_same_mesh),
    cmocka_unit_test(names_become_plain),
    cmocka_unit_test(without_physical_volumes_there_is_one_region),
    cmocka_unit_test(second_order_tets_come_in_our_order),
    cmocka_unit_test(tets_come_in_the_order_of_their_tags),
    cmocka_unit_test(elements_of_one_entity_stay_in_their_groups),
    cmocka_unit_test(groups_of_one_name_are_one),
    cmocka_unit_test(hexahedra_and_pyramids_become_tets),
    cmocka_unit_test(a_mesh_without_tets_is_refused),
    cmocka_unit_test(quadrilaterals_in_a_boundary_are_refused),
    cmocka_unit_test(a_tet_in_several_volumes_is_in_the_smallest),
    cmocka_unit_test(repeated_tags_of_tets_are_replaced),
    cmocka_unit_test(repeated_tags_of_nodes_are_refused),
    cmocka_unit_test(nodes_of_no_tet_are_left_out),
    cmocka_unit_test(tets_the_other_way_round_are_turned),
    cmocka_unit_test(turned_tets_keep_their_middles),
    cmocka_unit_test(every_cut_file_is_refused),
    cmocka_unit_test(damaged_files_do_no_harm),
    cmocka_unit_test(what_is_no_mesh_is_refused),
    cmocka_unit_test(wrong_files_are_refused_where_they_are_wrong),
    cmocka_unit_test(other_sections_and_words_are_skipped),
    cmocka_unit_test(other_binary_sections_are_skipped),
    cmocka_unit_test(ends_may_follow_bytes_at_once),
    cmocka_unit_test(tags_may_be_zero_sparse_and_many),
    cmocka_unit_test(tags_of_texts_may_be_large),
    cmocka_unit_test(parametric_nodes_are_read),
    cmocka_unit_test(partitioned_files_are_one_body),
    cmocka_unit_test(faces_may_be_in_several_groups),
    cmocka_unit_test(packed_files_are_read),
    cmocka_unit_test(damaged_packed_files_are_refused),
    cmocka_unit_test(missing_files_and_unknown_endings_are_named),
};
OST_TEST_MAIN(tests)
