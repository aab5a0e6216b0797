/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"
#include "two_cubes.h"

#include "formats/serial/formats.h"

#include <string.h>
#include <unistd.h>

/* One mesh of two cubes, [0, 2] × [0, 1]², as Gmsh, meshio, VTK, TetGen and Abaqus/CAE write it (exchange/README.md).
 * The left cube is one region and the right one another; four faces, or those of TetGen, lie at x = 0. */
static const struct {
    const char *name;
    int nodes, tets, boundaries, warnings;
    const char *left, *right, *clamp;
    int faces;
} files[] = {
    {"gmsh-linear.mesh", 23, 48, 1, 0, "volume-1", "volume-2", "surface-1", 4},
    {"gmsh-quadratic.mesh", 113, 48, 1, 0, "volume-1", "volume-2", "surface-1", 4},
    {"meshio-linear.meshb", 23, 48, 1, 0, "volume-11", "volume-12", "surface-7", 4},
    {"gmsh-linear.inp", 23, 48, 2, 3, "left", "right", "clamp", 4},
    {"gmsh-quadratic.inp", 113, 48, 2, 3, "left", "right", "clamp", 4},
    {"cae-linear.inp", 23, 48, 3, 0, "Left", "Right", "Clamp", 4},
    {"cae-quadratic.inp", 113, 48, 3, 0, "Left", "Right", "Clamp", 4},
    {"gmsh-linear.unv", 23, 48, 1, 0, "left", "right", "clamp", 4},
    {"gmsh-quadratic.unv", 113, 48, 1, 0, "left", "right", "clamp", 4},
    {"gmsh-linear.bdf", 23, 48, 1, 0, "volume-1", "volume-2", "surface-1", 4},
    {"gmsh-quadratic.bdf", 113, 48, 1, 0, "volume-1", "volume-2", "surface-1", 4},
    {"gmsh-linear.vtk", 23, 48, 1, 0, "volume-11", "volume-12", "surface-7", 4},
    {"gmsh-quadratic.vtk", 113, 48, 1, 0, "volume-11", "volume-12", "surface-7", 4},
    {"meshio-linear-ascii.vtk", 23, 48, 1, 0, "volume-11", "volume-12", "surface-7", 4},
    {"meshio-linear-binary.vtk", 23, 48, 1, 0, "volume-11", "volume-12", "surface-7", 4},
    {"meshio-linear-old.vtk", 23, 48, 1, 0, "volume-11", "volume-12", "surface-7", 4},
    {"meshio-quadratic-binary.vtk", 113, 48, 1, 0, "volume-11", "volume-12", "surface-7", 4},
    {"meshio-quadratic-old.vtk", 113, 48, 1, 0, "volume-11", "volume-12", "surface-7", 4},
    {"meshio-linear-ascii.vtu", 23, 48, 1, 0, "volume-11", "volume-12", "surface-7", 4},
    {"meshio-linear-plain.vtu", 23, 48, 1, 0, "volume-11", "volume-12", "surface-7", 4},
    {"meshio-linear-zlib.vtu", 23, 48, 1, 0, "volume-11", "volume-12", "surface-7", 4},
    {"meshio-quadratic-ascii.vtu", 113, 48, 1, 0, "volume-11", "volume-12", "surface-7", 4},
    {"meshio-quadratic-zlib.vtu", 113, 48, 1, 0, "volume-11", "volume-12", "surface-7", 4},
    {"meshio-sets.vtk", 23, 48, 2, 0, "left", "right-hand", "clamp", 4},
    {"meshio-sets.vtu", 23, 48, 2, 0, "left", "right-hand", "clamp", 4},
    {"vtk-appended-raw.vtu", 23, 48, 1, 0, "volume-11", "volume-12", "surface-7", 4},
    {"vtk-appended-base64-zlib.vtu", 23, 48, 1, 0, "volume-11", "volume-12", "surface-7", 4},
    {"solids-linear.bdf", 17, 24, 1, 0, "volume-11", "volume-12", "surface-7", 2},
    {"solids-linear.msh", 17, 24, 1, 0, "left", "right", "clamp", 2},
    {"solids-linear.vtk", 17, 24, 1, 0, "volume-11", "volume-12", "surface-7", 2},
    {"solids-meshio.mesh", 17, 24, 1, 0, "volume-11", "volume-12", "surface-7", 2},
    {"solids-meshio.vtu", 17, 24, 1, 0, "volume-11", "volume-12", "surface-7", 2},
    {"solids-bricks-linear.inp", 16, 18, 2, 3, "left", "right", "clamp", 2},
    {"solids-bricks-linear.unv", 16, 18, 1, 0, "left", "right", "clamp", 2},
    {"solids-serendipity.msh", 71, 24, 1, 0, "left", "right", "clamp", 2},
    {"solids-full.msh", 71, 24, 1, 0, "left", "right", "clamp", 2},
    {"solids-vtk.vtu", 71, 24, 1, 0, "volume-11", "volume-12", "surface-7", 2},
    {"solids-bricks-serendipity.bdf", 63, 18, 1, 0, "volume-11", "volume-12", "surface-7", 2},
    {"solids-bricks-serendipity.inp", 63, 18, 2, 3, "left", "right", "clamp", 2},
    {"solids-bricks-serendipity.unv", 63, 18, 1, 0, "left", "right", "clamp", 2},
    {"solids-bricks-serendipity.vtk", 63, 18, 1, 0, "volume-11", "volume-12", "surface-7", 2},
    {"solids-bricks-full.vtk", 63, 18, 1, 0, "volume-11", "volume-12", "surface-7", 2},
    {"tetgen-linear.ele", 83, 136, 4, 0, "volume-11", "volume-12", "surface-7", 16},
    {"tetgen-quadratic.node", 45, 12, 4, 0, "volume-11", "volume-12", "surface-7", 2},
};
enum { FILES = sizeof files / sizeof *files };

static void path_of(const char *name, char path[512])
{
    snprintf(path, 512, "%s/tests/formats/exchange/%s", getenv("ORTHOSTAT_SOURCE"), name);
}

static void check_clamp(const OstMeshChunk *chunk, int f)
{
    const OstBoundary *clamp = NULL;
    for (int b = 0; b < chunk->boundary_count; b++)
        if (strcmp(chunk->boundaries[b].name, files[f].clamp) == 0)
            clamp = &chunk->boundaries[b];
    assert_non_null(clamp);
    assert_int_equal(clamp->dimension, 2);
    assert_int_equal(clamp->nodes_per_item, chunk->nodes_per_tet == 10 ? 6 : 3);
    assert_int_equal(clamp->count, files[f].faces);
    for (int i = 0; i < clamp->count * clamp->nodes_per_item; i++)
        assert_true(chunk->coordinates[3 * clamp->nodes[i]] == 0.0);
}

static void stored_files_hold_two_cubes(void **state)
{
    ost_log_set_level(ctx, OST_LOG_QUIET);
    for (int f = 0; f < FILES; f++) {
        char path[512];
        path_of(files[f].name, path);
        OstMeshChunk *chunk = read_cubes(path, files[f].warnings, files[f].nodes, files[f].tets);
        assert_int_equal(chunk->boundary_count, files[f].boundaries);
        assert_int_equal(chunk->regions.count, 2);
        check_cubes(chunk, files[f].left, files[f].right);
        check_clamp(chunk, f);
        ost_chunk_destroy(&chunk);
    }
}

/* Curved faces have their mid-edge nodes where the tets behind have them. */
static void quadratic_meshes_pass_the_checks_of_the_body(void **state)
{
    for (int f = 0; f < FILES; f++) {
        char path[512];
        OstMeshChunk *chunk = NULL;
        OstMesh *mesh = NULL;
        path_of(files[f].name, path);
        assert_success(ost_chunk_read(ctx, path, &chunk));
        if (ost_mesh_distribute(ctx, &chunk, &mesh) != OST_SUCCESS)
            fail_msg("%s: %s", files[f].name, ost_error_text(ctx));
        if (strncmp(files[f].name, "solids-", 7) == 0) { /* no inner face is bare */
            double faces = 0.0;
            assert_success(ost_mesh_surface_faces(mesh, &faces));
            assert_close(faces, 28.0, 0.0);
        }
        ost_mesh_destroy(&mesh);
    }
}

/* A modulus by tet and a density by point, and directions by point, of which every second one is turned. */
static void fields_are_read_tet_by_tet(void **state)
{
    static const char *const with_fields[] = {"meshio-linear-ascii.vtk", "meshio-linear-binary.vtk",
                                              "meshio-linear-ascii.vtu", "meshio-linear-zlib.vtu",
                                              "vtk-appended-raw.vtu",    "vtk-appended-base64-zlib.vtu"};
    for (size_t f = 0; f < sizeof with_fields / sizeof *with_fields; f++) {
        char path[512];
        OstMeshChunk *chunk = NULL;
        path_of(with_fields[f], path);
        assert_success(ost_chunk_read(ctx, path, &chunk));
        assert_success(ost_mesh_file_read_field(ctx, path, "modulus", OST_FIELD_OF_NUMBERS, chunk));
        assert_success(ost_mesh_file_read_field(ctx, path, "density", OST_FIELD_OF_NUMBERS, chunk));
        assert_success(ost_mesh_file_read_field(ctx, path, "direction", OST_FIELD_OF_DIRECTIONS, chunk));
        assert_int_equal(ost_mesh_file_read_field(ctx, path, "modulos", OST_FIELD_OF_NUMBERS, chunk),
                         OST_INVALID_INPUT);
        assert_non_null(strstr(ost_error_text(ctx), "'modulus'"));
        assert_non_null(strstr(ost_error_text(ctx), "'density'"));
        assert_int_equal(chunk->fields.count, 3);
        assert_int_equal(ost_tet_fields_width(&chunk->fields), 5);
        for (OstLocal t = 0; t < chunk->tet_count; t++) {
            const double *field = chunk->tet_field + 5 * (size_t)t;
            assert_close(field[0], 1000.0 + 1000.0 * centre_x(chunk, t), 1e-6);
            assert_close(field[1], 1.0 + centre_x(chunk, t), 1e-12);
            assert_close(fabs(field[2]), 0.6, 1e-12);
            assert_close(field[3] / field[2], 4.0 / 3.0, 1e-12);
        }
        ost_chunk_destroy(&chunk);
    }
}

/* 1000 + 1000 x at the mean of the element's vertices, which its tets have all. */
static void check_modulus(const OstMeshChunk *chunk)
{
    for (OstLocal t = 0, next; t < chunk->tet_count; t = next) {
        char seen[17] = {0};
        double sum = 0.0, count = 0.0;
        for (next = t; next < chunk->tet_count && chunk->tet_label[next] / 10 == chunk->tet_label[t] / 10; next++)
            for (int v = 0; v < 4; v++)
                seen[chunk->tet_nodes[4 * (size_t)next + (size_t)v]] = 1;
        for (int n = 0; n < 17; n++) {
            sum += seen[n] ? chunk->coordinates[3 * n] : 0.0;
            count += seen[n];
        }
        for (OstLocal piece = t; piece < next; piece++)
            assert_close(chunk->tet_field[2 * (size_t)piece], 1000.0 + 1000.0 * sum / count, 1e-9);
    }
}

/* The tets of an element have its number, and of points the mean of their own. */
static void fields_of_elements_are_read_for_their_tets(void **state)
{
    char path[512];
    OstMeshChunk *chunk = NULL;
    path_of("solids-meshio.vtu", path);
    assert_success(ost_chunk_read(ctx, path, &chunk));
    assert_success(ost_mesh_file_read_field(ctx, path, "modulus", OST_FIELD_OF_NUMBERS, chunk));
    assert_success(ost_mesh_file_read_field(ctx, path, "density", OST_FIELD_OF_NUMBERS, chunk));
    for (OstLocal t = 0; t < chunk->tet_count; t++)
        assert_close(chunk->tet_field[2 * (size_t)t + 1], 1.0 + centre_x(chunk, t), 1e-12);
    check_modulus(chunk);
    ost_chunk_destroy(&chunk);
}

/* --- what is refused --- */

static void expect_refusal(const char *name, const char *content, size_t length, const char *words)
{
    char path[512];
    OstMeshChunk *chunk = NULL;
    snprintf(path, sizeof path, "/tmp/orthostat-exchange-%d-%s", (int)getpid(), name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(content, 1, length, file), length);
    fclose(file);
    const OstStatus status = ost_chunk_read(ctx, path, &chunk);
    remove(path);
    ost_chunk_destroy(&chunk);
    assert_int_not_equal(status, OST_SUCCESS);
    if (!strstr(ost_error_text(ctx), words))
        fail_msg("'%s' has no '%s'", ost_error_text(ctx), words);
}

static void mistakes_are_named_with_file_and_line(void **state)
{
    static const struct {
        const char *name, *content, *words;
    } wrong[] = {
        {"a.inp", "*NODE\n1, 0, 0\n2, x, 0, 0\n", "a.inp:3: a coordinate is 'x', expected a number"},
        {"a.inp", "*ELEMENT, TYPE=COH3D8\n1, 1,2,3,4,5,6,7,8\n",
         "1 solid elements that are no linear or quadratic tets"},
        {"a.inp", "*NODE\n1,0,0,0\n*ELEMENT, TYPE=C3D4\n7, 1, 2, 3\n*NSET, NSET=A\n",
         "element 7 has 3 nodes, expected 4"},
        {"a.inp", "*NODE\n1,0,0,0\n*ELEMENT, TYPE=C3D4\n7, 1, 2, 3, 4\n",
         "element 7 uses node 2, which the file does not"},
        {"a.inp", "*ELEMENT\n1, 2\n", "*ELEMENT without TYPE"},
        {"a.inp", "[TITLE]\nwater\n", "holds no nodes as its ending would have them"},
        {"a.inp", "8 6 0 0 0\n1 0 0 0\n", "file_format='avsucd'"},
        {"a.msh", "*NODE, NSET=Nall\n1, 0, 0, 0\n", "Name it .inp"},
        {"a.msh", "MESH dimension 3 ElemType Tetrahedra Nnode 4\n", "GiD"},
        {"a.mesh", "MFEM mesh v1.0\n", "PrintVTU"},
        {"a.mesh", "5\n0 0 0\n", "Gmsh2"},
        {"a.mesh", "BEGIN POINTS LIST\n", "export_to_vtu"},
        {"a.msh", "8 6 0\n0 0 0\n", "savemesh"},
        {"a.msh", "(0 \"grid written by GAMBIT\")\n", "meshio.ansys.read"},
        {"a.inp", "*NSET, NSET=A\nB\n", "'B' found, expected a number or the name of a set before"},
        {"a.inp", "*INCLUDE, INPUT=none.inp\n", "a.inp:1: names a file that is to be read here: "},
        {"a.mesh", "MeshVersionFormatted 2\nDimension 2\n", "a.mesh:2: dimension 2 found, expected 3"},
        {"a.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 3\n0 0 0 1\n", "a.mesh:5: the file ends"},
        {"a.mesh", "solid\n", "expected MeshVersionFormatted"},
        {"a.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n", "'POLYDATA', expected UNSTRUCTURED_GRID"},
        {"a.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 1 float\n0 0 z\n",
         "a.vtk:6: 'z' found"},
        {"a.vtu", "<VTKFile type=\"PolyData\">", "'PolyData', expected UnstructuredGrid"},
        {"a.vtu",
         "<VTKFile type=\"UnstructuredGrid\" compressor=\"vtkLZMADataCompressor\"><Piece "
         "NumberOfPoints=\"1\" NumberOfCells=\"0\"><Points><DataArray type=\"Float64\" format=\"binary\">AAAA",
         "neither zlib nor LZ4"},
        {"a.bdf", "GRID,1,,0.,0.,zero\n", "field 5 of GRID is 'zero'"},
        {"a.bdf", "GRID           1              0.      0.    1234.5\n",
         "field 6 of GRID is '.5', expected a coordinate system"},
        {"a.bdf", "GRID,1,3,0.,0.,0.\n", "coordinate system 3 is used, and no CORD2R"},
        {"a.bdf", "GRID,1,3,0.,0.,0.\nCORD2R,3,4,,,,,,1.\n,1.\nCORD2R,4,3,,,,,,1.\n,1.\n", "is based on itself"},
        {"a.bdf", "GRID,1,3,0.,0.,0.\nCORD2R,3,,,,,,,1.\n,,,2.\n", "system 3 lie on a line"},
        {"a.bdf", "CTETRA,1,1,1,2,3,4,5,6\n,7\n", "element 1 has 3 of 6 mid-edge nodes"},
        {"a.unv", "    -1\n  2411\n 1 1 1 1\n 0.D0 0.D0 zero\n    -1\n", "a.unv:4: 'zero' found"},
        {"a.stl", "solid\n", "tetgen -pq"},
        {"a.med", "", "python3-h5py"},
        {"a.exo", "", "Exodus"},
        {"a.cgns", "", "ParaView"},
        {"a.tec", "",
         "a.vtu')\" (Debian: python3-meshio), or, where that fails, open it in ParaView and save it as .vtu"},
        {"a.plt", "", "in ParaView, and save it as"},
        {"a.xdmf", "", "a.xdmf').write('"},
        {"a.inp.gz", "", "gunzip -k"},
        {"a.vol", "", "m.cell_data['netgen:index']; m.write('"},
        {"a.ucd", "", "file_format='avsucd'"},
        {"a.rmed", "", "file_format='med'"},
        {"a.obj", "", "a.stl'"},
        {"a.cub5", "", "a.e (Exodus)"},
        {"mesh.nodes", "", "ElmerGrid 2 4"},
        {"a.qqq", "", "the ending '.qqq' is not that of a mesh file"},
    };
    for (size_t w = 0; w < sizeof wrong / sizeof *wrong; w++)
        expect_refusal(wrong[w].name, wrong[w].content, strlen(wrong[w].content), wrong[w].words);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(stored_files_hold_two_cubes), cmocka_unit_test(quadratic_meshes_pass_the_checks_of_the_body),
    cmocka_unit_test(fields_are_read_tet_by_tet), cmocka_unit_test(fields_of_elements_are_read_for_their_tets),
    cmocka_unit_test(mistakes_are_named_with_file_and_line)};
OST_TEST_MAIN(tests)
