/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/vtkhdf/hdf5.h"
#include "formats/vtkhdf/vtkhdf.h"
#include "support.h"
#include "vtkhdf_whole.h"

#include <sys/stat.h>
#include <unistd.h>

static char path[256];

static void name_file(const char *what)
{
    int process = (int)getpid();
    MPI_Bcast(&process, 1, MPI_INT, 0, MPI_COMM_WORLD);
    snprintf(path, sizeof path, "vtkhdf-%s-%d.vtkhdf", what, process);
}

static int file_exists(const char *name)
{
    MPI_Barrier(MPI_COMM_WORLD);
    return access(name, F_OK) == 0;
}

static void remove_file(void)
{
    MPI_Barrier(MPI_COMM_WORLD);
    if (ost_rank(ctx) == 0)
        remove(path);
}

/* A tube of 12 × 2 × 8 hexes, whose tets above the middle are a second region "upper". */
static OstMeshChunk *make_tube(OstContext *context)
{
    const OstTubeShape shape = {1, {0.0, 0.0, 0.0}, 10.0, {0.9, 1.5}, 12, 2, 8};
    OstMeshChunk *chunk = NULL;
    assert_success(ost_chunk_create_tube(context, &shape, &chunk));
    assert_success(OST_RESIZE(context, &chunk->regions.name, 2));
    assert_success(ost_copy_string(context, "upper", &chunk->regions.name[1]));
    chunk->regions.count = 2;
    for (OstLocal t = 0; t < chunk->tet_count; t++)
        chunk->tet_region[t] = 2 * (chunk->first_tet + t) >= chunk->global_tets;
    return chunk;
}

static OstMesh *distribute_tube(OstContext *context)
{
    OstMeshChunk *chunk = make_tube(context);
    OstMesh *mesh = NULL;
    assert_success(ost_mesh_distribute(context, &chunk, &mesh));
    return mesh;
}

/* Fields that the reader can check from coordinates and labels alone. */
typedef struct Fields {
    double *displacement; /* 0.8 sin(π y / 10) along x */
    double *stress;       /* label + 0.1 k */
    int32_t *rank;
    OstOutputArray arrays[3];
} Fields;

static void make_fields(const OstMesh *mesh, Fields *fields)
{
    assert_success(OST_NEW(mesh->ctx, &fields->displacement, 3 * mesh->node_count));
    assert_success(OST_NEW(mesh->ctx, &fields->stress, 6 * mesh->owned_tets));
    assert_success(OST_NEW(mesh->ctx, &fields->rank, mesh->owned_tets));
    for (OstLocal i = 0; i < mesh->node_count; i++)
        fields->displacement[3 * i] = 0.8 * sin(M_PI * mesh->coordinates[3 * i + 1] / 10.0);
    for (OstLocal t = 0; t < mesh->owned_tets; t++) {
        fields->rank[t] = ost_rank(mesh->ctx);
        for (int k = 0; k < 6; k++)
            fields->stress[6 * t + k] = (double)mesh->tet_label[t] + 0.1 * k;
    }
    fields->arrays[0] = (OstOutputArray){"displacement", OST_ON_NODES, OST_VALUES_DOUBLE, 3, fields->displacement};
    fields->arrays[1] = (OstOutputArray){"stress", OST_ON_TETS, OST_VALUES_DOUBLE, 6, fields->stress};
    fields->arrays[2] = (OstOutputArray){"rank", OST_ON_TETS, OST_VALUES_INT32, 1, fields->rank};
}

static void free_fields(Fields *fields)
{
    OST_FREE(fields->displacement, fields->stress, fields->rank);
}

/* Writes the tube with a context's ranks. */
static void write_tube(OstContext *context, const char *name)
{
    OstMesh *mesh = distribute_tube(context);
    Fields fields;
    make_fields(mesh, &fields);
    assert_success(ost_vtkhdf_write(context, name, mesh, 3, fields.arrays, NULL));
    free_fields(&fields);
    ost_mesh_destroy(&mesh);
}

static void expect_tube(OstContext *context, OstMeshChunk **read)
{
    OstMeshChunk *made = make_tube(context);
    Whole expected, found;
    gather_whole(made, &expected);
    gather_whole(*read, &found);
    expect_same(&expected, &found);
    free_whole(&expected);
    free_whole(&found);
    ost_chunk_destroy(&made);
    ost_chunk_destroy(read);
}

static void a_mesh_comes_back_as_it_was(void **state)
{
    name_file("round");
    write_tube(ctx, path);
    OstMeshChunk *read = NULL;
    assert_success(ost_vtkhdf_read(ctx, path, &read));
    expect_tube(ctx, &read);
    remove_file();
}

static void what_was_read_can_be_distributed_and_written_again(void **state)
{
    name_file("again");
    write_tube(ctx, path);
    OstMeshChunk *read = NULL;
    OstMesh *mesh = NULL;
    assert_success(ost_vtkhdf_read(ctx, path, &read));
    assert_success(ost_mesh_distribute(ctx, &read, &mesh));
    assert_success(ost_vtkhdf_write(ctx, path, mesh, 0, NULL, NULL));
    ost_mesh_destroy(&mesh);
    assert_success(ost_vtkhdf_read(ctx, path, &read));
    expect_tube(ctx, &read);
    remove_file();
}

/* A context of this rank alone. */
static OstContext *create_lone_context(void)
{
    OstContext *lone = NULL;
    assert_int_equal(ost_context_create(MPI_COMM_SELF, &lone), OST_SUCCESS);
    return lone;
}

/* Open MPI holds paths in 256 bytes, with letters of its own. */
static void long_paths_are_written(void **state)
{
    OstHdf5 file;
    char letters[200] = "";
    memset(letters, 'n', 190);
    name_file(letters);
    assert_true(strlen(path) > 200);
    assert_success(ost_hdf5_create(ctx, path, &file));
    assert_success(ost_hdf5_close(&file));
    write_tube(ctx, path);
    OstMeshChunk *read = NULL;
    assert_success(ost_vtkhdf_read(ctx, path, &read));
    expect_tube(ctx, &read);
    remove_file();
}

static void one_rank_reads_the_pieces_of_all(void **state)
{
    name_file("pieces");
    write_tube(ctx, path);
    OstContext *lone = create_lone_context();
    OstMeshChunk *read = NULL;
    assert_int_equal(ost_vtkhdf_read(lone, path, &read), OST_SUCCESS);
    expect_tube(lone, &read);
    ost_context_destroy(&lone);
    remove_file();
}

static void all_ranks_share_the_piece_of_one(void **state)
{
    name_file("piece");
    if (ost_rank(ctx) == 0) {
        OstContext *lone = create_lone_context();
        write_tube(lone, path);
        ost_context_destroy(&lone);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    OstMeshChunk *read = NULL;
    assert_success(ost_vtkhdf_read(ctx, path, &read));
    expect_tube(ctx, &read);
    remove_file();
}

static void without_labels_equal_places_are_one_node(void **state)
{
    name_file("places");
    write_tube(ctx, path);
    if (ost_rank(ctx) == 0) {
        const hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
        assert_true(H5Ldelete(file, "/VTKHDF/PointData/vertex", H5P_DEFAULT) >= 0);
        assert_true(H5Ldelete(file, "/VTKHDF/CellData/tet", H5P_DEFAULT) >= 0);
        assert_true(H5Ldelete(file, "/Orthostat", H5P_DEFAULT) >= 0);
        assert_true(H5Fclose(file) >= 0);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    OstMeshChunk *read = NULL;
    assert_success(ost_vtkhdf_read(ctx, path, &read));
    assert_int_equal(read->global_nodes, 12 * 3 * 9);
    assert_int_equal(read->global_tets, 12 * 2 * 8 * 6);
    assert_null(read->node_label);
    assert_null(read->tet_label);
    assert_int_equal(read->boundary_count, 0);
    assert_int_equal(read->regions.count, 1);
    assert_string_equal(read->regions.name[0], "volume");
    Whole whole;
    gather_whole(read, &whole);
    /* twelve-sided prism: ½ n sin(2π/n) (R² - r²) h */
    assert_close(whole_volume(&whole), 6.0 * sin(M_PI / 6.0) * (1.5 * 1.5 - 0.9 * 0.9) * 10.0, 1e-12);
    free_whole(&whole);
    ost_chunk_destroy(&read);
    remove_file();
}

/* Moves the second point of a vertex that two pieces share; returns the vertex's label, or 0 if there is none. */
static OstGlobal tear_a_vertex_apart(void)
{
    enum { MANY = 4 * 12 * 3 * 9 };
    static OstGlobal label[MANY];
    static double place[MANY][3];
    OstGlobal torn = 0;
    const hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t labels = H5Dopen2(file, "/VTKHDF/PointData/vertex", H5P_DEFAULT);
    const hid_t places = H5Dopen2(file, "/VTKHDF/Points", H5P_DEFAULT);
    assert_true(H5Dget_storage_size(labels) <= sizeof label);
    const size_t count = H5Dget_storage_size(labels) / sizeof *label;
    assert_true(H5Dread(labels, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, label) >= 0);
    assert_true(H5Dread(places, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, place) >= 0);
    for (size_t i = 0; i < count && torn == 0; i++)
        for (size_t j = 0; j < i && torn == 0; j++)
            if (label[i] == label[j]) {
                torn = label[i];
                place[i][1] += 1e-9;
            }
    assert_true(H5Dwrite(places, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, place) >= 0);
    H5Dclose(labels);
    H5Dclose(places);
    assert_true(H5Fclose(file) >= 0);
    return torn;
}

static void a_label_at_two_places_is_refused(void **state)
{
    name_file("torn");
    write_tube(ctx, path);
    OstGlobal torn = 0;
    char text[128];
    MPI_Barrier(MPI_COMM_WORLD);
    if (ost_rank(ctx) == 0)
        torn = tear_a_vertex_apart();
    MPI_Bcast(&torn, 1, MPI_INT64_T, 0, MPI_COMM_WORLD);
    assert_int_equal(torn > 0, ost_size(ctx) > 1);
    OstMeshChunk *read = NULL;
    snprintf(text, sizeof text, "are both vertex %lld but lie at different places", (long long)torn);
    if (torn > 0)
        assert_failure(ost_vtkhdf_read(ctx, path, &read), OST_INVALID_INPUT, text);
    remove_file();
}

static void an_infinite_value_leaves_the_old_file_alone(void **state)
{
    name_file("finite");
    write_tube(ctx, path);
    OstMesh *mesh = distribute_tube(ctx);
    Fields fields;
    make_fields(mesh, &fields);
    if (ost_rank(ctx) == ost_size(ctx) - 1)
        fields.stress[6 * (mesh->owned_tets - 1) + 2] = NAN;
    char tet[64];
    OstGlobal label = mesh->tet_label[mesh->owned_tets - 1];
    MPI_Bcast(&label, 1, MPI_INT64_T, ost_size(ctx) - 1, MPI_COMM_WORLD);
    snprintf(tet, sizeof tet, "nan at tet %lld (component 3 of 6)", (long long)label);
    assert_failure(ost_vtkhdf_write(ctx, path, mesh, 3, fields.arrays, NULL), OST_CHECK_FAILED, tet);
    assert_non_null(strstr(ost_error_text(ctx), "'stress'"));
    free_fields(&fields);
    ost_mesh_destroy(&mesh);
    OstMeshChunk *read = NULL;
    assert_success(ost_vtkhdf_read(ctx, path, &read));
    expect_tube(ctx, &read);
    remove_file();
}

static void a_folder_that_is_not_there_is_named(void **state)
{
    OstMesh *mesh = distribute_tube(ctx);
    assert_failure(ost_vtkhdf_write(ctx, "no-such-folder/tube.vtkhdf", mesh, 0, NULL, NULL), OST_FILE_FAILED,
                   "cannot write 'no-such-folder/tube.vtkhdf': No such file or directory");
    ost_mesh_destroy(&mesh);
}

static void a_folder_is_not_replaced(void **state)
{
    name_file("folder");
    if (ost_rank(ctx) == 0)
        mkdir(path, 0777);
    OstMesh *mesh = distribute_tube(ctx);
    assert_failure(ost_vtkhdf_write(ctx, path, mesh, 0, NULL, NULL), OST_FILE_FAILED, "not a regular file");
    ost_mesh_destroy(&mesh);
    remove_file();
}

static void rows_are_written_in_blocks_where_mpi_cannot_count_them(void **state)
{
    enum { COUNT = 23 };
    name_file("blocks");
    OstHdf5 h5;
    OstRows rows;
    OstGlobal values[2 * (COUNT + 4)];
    const OstGlobal count = COUNT + ost_rank(ctx); /* unequal: some ranks are done before others */
    assert_success(ost_rows_create(ctx, count, &rows));
    for (OstGlobal i = 0; i < 2 * count; i++)
        values[i] = 2 * rows.first + i;
    assert_success(ost_hdf5_create(ctx, path, &h5));
    h5.block_bytes = 5 * 2 * sizeof(OstGlobal);
    assert_success(ost_hdf5_write_rows(&h5, "/group/numbers", H5T_NATIVE_INT64, 2, &rows, values));
    assert_success(ost_hdf5_close(&h5));
    memset(values, 0, sizeof values);
    assert_success(ost_hdf5_open(ctx, path, &h5));
    assert_success(
        ost_hdf5_read_rows(&h5, "/group/numbers", H5T_NATIVE_INT64, 2, rows.total, rows.first, count, values));
    for (OstGlobal i = 0; i < 2 * count; i++)
        assert_int_equal(values[i], 2 * rows.first + i);
    assert_success(ost_hdf5_close(&h5));
    remove_file();
}

static void names_that_the_file_uses_itself_are_refused(void **state)
{
    OstMesh *mesh = distribute_tube(ctx);
    const OstOutputArray vertex = {"vertex", OST_ON_NODES, OST_VALUES_DOUBLE, 3, mesh->coordinates};
    const OstOutputArray slash = {"a/b", OST_ON_NODES, OST_VALUES_DOUBLE, 3, mesh->coordinates};
    assert_failure(ost_vtkhdf_write(ctx, "names.vtkhdf", mesh, 1, &vertex, NULL), OST_INVALID_INPUT,
                   "'vertex' already");
    assert_failure(ost_vtkhdf_write(ctx, "names.vtkhdf", mesh, 1, &slash, NULL), OST_INVALID_INPUT,
                   "'a/b' cannot name");
    assert_false(file_exists("names.vtkhdf"));
    ost_mesh_destroy(&mesh);
}

/* For test_vtkhdf_reader.py, which asks for the file to be left somewhere. */
static void a_file_can_be_left_for_vtk(void **state)
{
    const char *target = getenv("ORTHOSTAT_WRITE_TO");
    name_file("finished");
    write_tube(ctx, target ? target : path);
    assert_true(file_exists(target ? target : path));
    remove_file();
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_mesh_comes_back_as_it_was),
    cmocka_unit_test(what_was_read_can_be_distributed_and_written_again),
    cmocka_unit_test(long_paths_are_written),
    cmocka_unit_test(one_rank_reads_the_pieces_of_all),
    cmocka_unit_test(all_ranks_share_the_piece_of_one),
    cmocka_unit_test(without_labels_equal_places_are_one_node),
    cmocka_unit_test(a_label_at_two_places_is_refused),
    cmocka_unit_test(an_infinite_value_leaves_the_old_file_alone),
    cmocka_unit_test(a_folder_that_is_not_there_is_named),
    cmocka_unit_test(a_folder_is_not_replaced),
    cmocka_unit_test(rows_are_written_in_blocks_where_mpi_cannot_count_them),
    cmocka_unit_test(names_that_the_file_uses_itself_are_refused),
    cmocka_unit_test(a_file_can_be_left_for_vtk),
};

OST_TEST_MAIN(tests)
