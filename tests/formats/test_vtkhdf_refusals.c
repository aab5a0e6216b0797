/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtkhdf/vtkhdf.h"
#include "support.h"

#include <hdf5.h>
#include <unistd.h>

/* One tet of ten nodes made by hand, written, damaged in one place, and read. */

static const char path[] = "vtkhdf-refusals.vtkhdf";

static double coordinates[30] = {0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2, 1, 0, 0,
                                 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1};
static OstGlobal labels[10] = {11, 12, 13, 14, 21, 22, 23, 24, 25, 26};
static OstLocal nodes[10] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
static OstGlobal numbers[10] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
static OstGlobal tet_label[1] = {77};
static int32_t tet_region[1] = {0};
static double tet_axes[9] = {0, 1, 0, 0, 0, 1, 1, 0, 0};
static OstGlobal face[6] = {0, 2, 1, 6, 5, 4};
static OstGlobal edge[3] = {0, 1, 4};
static OstGlobal points[2] = {3, 1};
static char *region_names[1] = {(char *)"bone"};
static OstBoundary boundaries[4] = {{(char *)"base", 2, 6, 1, face},
                                    {(char *)"side", 1, 3, 1, edge},
                                    {(char *)"tips", 0, 1, 2, points},
                                    {(char *)"nothing", 2, 6, 0, face}};

static void write_tet(int nodes_per_tet)
{
    OstMesh mesh = {.ctx = ctx,
                    .nodes_per_tet = nodes_per_tet,
                    .global_nodes = nodes_per_tet,
                    .global_tets = 1,
                    .node_count = nodes_per_tet,
                    .owned_nodes = nodes_per_tet,
                    .tet_count = 1,
                    .owned_tets = 1,
                    .node_number = numbers,
                    .node_label = labels,
                    .tet_label = tet_label,
                    .coordinates = coordinates,
                    .tet_nodes = nodes,
                    .tet_region = tet_region,
                    .tet_axes = tet_axes,
                    .regions = {1, region_names},
                    .boundary_count = nodes_per_tet == 10 ? 4 : 0,
                    .boundaries = boundaries};
    assert_success(ost_vtkhdf_write(ctx, path, &mesh, 0, NULL, NULL));
}

static void a_tet_of_ten_nodes_comes_back_with_its_boundaries_and_axes(void **state)
{
    write_tet(10);
    OstMeshChunk *chunk = NULL;
    assert_success(ost_vtkhdf_read(ctx, path, &chunk));
    assert_int_equal(chunk->nodes_per_tet, 10);
    assert_int_equal(chunk->node_count, 10);
    assert_memory_equal(chunk->coordinates, coordinates, sizeof coordinates);
    assert_memory_equal(chunk->node_label, labels, sizeof labels);
    assert_memory_equal(chunk->tet_nodes, numbers, sizeof numbers);
    assert_memory_equal(chunk->tet_axes, tet_axes, sizeof tet_axes);
    assert_int_equal(chunk->tet_label[0], 77);
    assert_string_equal(chunk->regions.name[0], "bone");
    assert_int_equal(chunk->boundary_count, 4);
    for (int b = 0; b < 4; b++) {
        assert_string_equal(chunk->boundaries[b].name, boundaries[b].name);
        assert_int_equal(chunk->boundaries[b].dimension, boundaries[b].dimension);
        assert_int_equal(chunk->boundaries[b].count, boundaries[b].count);
        assert_memory_equal(chunk->boundaries[b].nodes, boundaries[b].nodes,
                            (size_t)(boundaries[b].count * boundaries[b].nodes_per_item) * sizeof(OstGlobal));
    }
    ost_chunk_destroy(&chunk);
}

static void expect_refusal(OstStatus expected, const char *text)
{
    OstMeshChunk *chunk = NULL;
    assert_failure(ost_vtkhdf_read(ctx, path, &chunk), expected, text);
    assert_null(chunk);
    assert_non_null(strstr(ost_error_text(ctx), path));
}

/* Writes a tet and replaces entry `at` of one of its datasets. */
static void damage(const char *name, hsize_t at, long long value)
{
    write_tet(10);
    const hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT);
    const hid_t space = H5Dget_space(dataset);
    hsize_t extent[2];
    const int dimensions = H5Sget_simple_extent_dims(space, extent, NULL);
    const hsize_t entry[2] = {dimensions == 2 ? at / extent[1] : at, dimensions == 2 ? at % extent[1] : 0};
    const hid_t one = H5Screate(H5S_SCALAR);
    assert_true(H5Sselect_elements(space, H5S_SELECT_SET, 1, entry) >= 0);
    assert_true(H5Dwrite(dataset, H5T_NATIVE_LLONG, one, space, H5P_DEFAULT, &value) >= 0);
    H5Sclose(one);
    H5Sclose(space);
    H5Dclose(dataset);
    assert_true(H5Fclose(file) >= 0);
}

/* Writes a tet and removes a dataset; in its place, if `rows` is not 0, comes one that claims that many rows. */
static void replace(const char *name, hid_t type, hsize_t rows)
{
    write_tet(10);
    const hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    assert_true(H5Ldelete(file, name, H5P_DEFAULT) >= 0);
    if (rows > 0) {
        const hid_t space = H5Screate_simple(1, &rows, NULL);
        const hid_t dataset = H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        assert_true(dataset >= 0);
        H5Dclose(dataset);
        H5Sclose(space);
    }
    assert_true(H5Fclose(file) >= 0);
}

static void set_type(const char *text)
{
    write_tet(10);
    const hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t type = H5Tcopy(H5T_C_S1);
    const hid_t space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, H5T_VARIABLE);
    assert_true(H5Adelete_by_name(file, "/VTKHDF", "Type", H5P_DEFAULT) >= 0);
    const hid_t attribute =
        H5Acreate_by_name(file, "/VTKHDF", "Type", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(H5Awrite(attribute, type, &text) >= 0);
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
    assert_true(H5Fclose(file) >= 0);
}

static void other_kinds_of_files_are_refused(void **state)
{
    OstMeshChunk *chunk = NULL;
    assert_failure(ost_vtkhdf_read(ctx, "no-such.vtkhdf", &chunk), OST_FILE_FAILED,
                   "no-such.vtkhdf: could not be opened: No such file or directory");
    FILE *text = fopen(path, "w");
    fputs("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", text);
    fclose(text);
    expect_refusal(OST_FILE_FAILED, "not an HDF5 file");
    set_type("PolyData");
    expect_refusal(OST_INVALID_INPUT, "type 'PolyData'; expected UnstructuredGrid");
    replace("/VTKHDF", 0, 0);
    expect_refusal(OST_INVALID_INPUT, "no group VTKHDF");
}

static void strings_of_variable_length_are_understood(void **state)
{
    set_type("UnstructuredGrid");
    OstMeshChunk *chunk = NULL;
    assert_success(ost_vtkhdf_read(ctx, path, &chunk));
    ost_chunk_destroy(&chunk);
}

/* Cut anywhere, a file is refused and nothing crashes. */
static void truncated_files_are_refused(void **state)
{
    write_tet(4);
    FILE *file = fopen(path, "rb");
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    const long size = ftell(file);
    fclose(file);
    for (long cut = size - 1; cut >= 0; cut -= size / 23) {
        assert_int_equal(truncate(path, cut), 0);
        OstMeshChunk *chunk = NULL;
        assert_int_equal(ost_vtkhdf_read(ctx, path, &chunk), OST_FILE_FAILED);
        assert_null(chunk);
    }
}

static void cells_other_than_tets_are_refused_by_their_number(void **state)
{
    damage("/VTKHDF/Types", 0, 12);
    expect_refusal(OST_INVALID_INPUT, "cell 0 has VTK's type 12; expected tets only, type 10 (4 nodes) or 24");
}

static void counts_are_not_trusted(void **state)
{
    damage("/VTKHDF/NumberOfPoints", 0, -10);
    expect_refusal(OST_INVALID_INPUT, "NumberOfPoints of piece 0 is -10");
    damage("/VTKHDF/NumberOfPoints", 0, INT64_MAX);
    expect_refusal(OST_INVALID_INPUT, "NumberOfPoints of piece 0 is 9223372036854775807");
    damage("/VTKHDF/NumberOfPoints", 0, 100000000000);
    expect_refusal(OST_LIMIT_EXCEEDED, "100000000000 points");
    damage("/VTKHDF/NumberOfPoints", 0, 1000000000);
    expect_refusal(OST_INVALID_INPUT, "Points has 10 rows of 3; the pieces count 1000000000 of 3");
    damage("/VTKHDF/NumberOfCells", 0, 2);
    expect_refusal(OST_INVALID_INPUT, "Types has 1 rows; the pieces count 2 cells");
    damage("/VTKHDF/NumberOfCells", 0, 0);
    expect_refusal(OST_INVALID_INPUT, "holds no cells");
    damage("/VTKHDF/Types", 0, 10);
    expect_refusal(OST_INVALID_INPUT, "Offsets of cell 0 are 0 and 10; expected 0 and 4");
    damage("/VTKHDF/Offsets", 1, 1000);
    expect_refusal(OST_INVALID_INPUT, "Offsets of cell 0 are 0 and 1000; expected 0 and 10");
    damage("/VTKHDF/Connectivity", 3, 10);
    expect_refusal(OST_INVALID_INPUT, "cell 0 uses point 10 of its piece, which has 10");
    damage("/VTKHDF/Connectivity", 3, -1);
    expect_refusal(OST_INVALID_INPUT, "cell 0 uses point -1");
    replace("/VTKHDF/NumberOfPoints", H5T_NATIVE_INT64, (hsize_t)1 << 50);
    expect_refusal(OST_FILE_FAILED, "NumberOfPoints claims to hold");
}

static void missing_or_odd_datasets_are_named(void **state)
{
    replace("/VTKHDF/Connectivity", 0, 0);
    expect_refusal(OST_INVALID_INPUT, "there is no dataset /VTKHDF/Connectivity");
    replace("/VTKHDF/PointData/vertex", H5T_NATIVE_INT64, 9);
    expect_refusal(OST_FILE_FAILED, "/VTKHDF/PointData/vertex claims to hold");
    damage("/VTKHDF/PointData/vertex", 1, 11);
    expect_refusal(OST_INVALID_INPUT, "points 0 and 1 of piece 0 both have the label 11");
}

static void names_of_parts_are_checked(void **state)
{
    damage("/VTKHDF/CellData/region", 0, 5);
    expect_refusal(OST_INVALID_INPUT, "cell 0 is of region 5; the file names 1 regions");
    damage("/Orthostat/BoundaryKinds", 0, 3);
    expect_refusal(OST_INVALID_INPUT, "boundary 'base' has dimension 3");
    damage("/Orthostat/BoundaryItems", 0, 4);
    expect_refusal(OST_INVALID_INPUT, "is of boundary 4; there are 4");
    damage("/Orthostat/BoundaryItems", 1, 99);
    expect_refusal(OST_INVALID_INPUT, "boundary 'base' names vertex 99, which the file does not have");
}

static int remove_file(void **state)
{
    remove(path);
    return 0;
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test_teardown(a_tet_of_ten_nodes_comes_back_with_its_boundaries_and_axes, remove_file),
    cmocka_unit_test_teardown(other_kinds_of_files_are_refused, remove_file),
    cmocka_unit_test_teardown(strings_of_variable_length_are_understood, remove_file),
    cmocka_unit_test_teardown(truncated_files_are_refused, remove_file),
    cmocka_unit_test_teardown(cells_other_than_tets_are_refused_by_their_number, remove_file),
    cmocka_unit_test_teardown(counts_are_not_trusted, remove_file),
    cmocka_unit_test_teardown(missing_or_odd_datasets_are_named, remove_file),
    cmocka_unit_test_teardown(names_of_parts_are_checked, remove_file),
};

OST_TEST_MAIN(tests)
