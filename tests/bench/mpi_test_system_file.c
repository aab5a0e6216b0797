/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/solver.h"
#include "core/memory.h"
#include "support.h"
#include "system_matrix.h"

#include <unistd.h>

/* A block of 3 × 2 × 2 hexes, held at one end and pulled at the other. */
static const char case_text[] = "mesh:\n  block: {size: [3, 1, 1], divisions: [3, 2, 2]}\n"
                                "materials:\n  - {region: all, youngs_modulus: [5, 1, 2], poissons_ratio: 0.3, "
                                "axes: {fixed: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}}\n"
                                "constraints:\n  - {on: {boundary: xmin}, displacement: [0, 0, 0]}\n"
                                "loads:\n  - {on: {boundary: xmax}, total_force: [0.1, 0.02, 0]}\n";

enum { NODES = 4 * 3 * 3, FREE = 3 * 3 * 3 };

static char folder[] = "/tmp/orthostat-system-XXXXXX";
static const char pattern[] = "XXXXXX";

static void make_folder(void)
{
    char path[64];
    if (ost_rank(ctx) == 0) {
        memcpy(folder + sizeof folder - sizeof pattern, pattern, sizeof pattern);
        assert_non_null(mkdtemp(folder));
        snprintf(path, sizeof path, "%s/block.yaml", folder);
        FILE *stream = fopen(path, "w");
        assert_non_null(stream);
        fputs(case_text, stream);
        assert_int_equal(fclose(stream), 0);
    }
    MPI_Bcast(folder, sizeof folder, MPI_CHAR, 0, MPI_COMM_WORLD);
}

static void remove_file(const char *name)
{
    char path[96];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    assert_int_equal(remove(path), 0);
}

static void remove_folder(void)
{
    char name[32];
    snprintf(name, sizeof name, "system.%d", ost_rank(ctx));
    remove_file(name);
    MPI_Barrier(MPI_COMM_WORLD);
    if (ost_rank(ctx) > 0)
        return;
    remove_file("block.yaml");
    assert_int_equal(rmdir(folder), 0);
}

static void read_back(SystemFile *system)
{
    char path[64], failure[SYSTEM_FAILURE];
    make_folder();
    snprintf(path, sizeof path, "%s/block.yaml", folder);
    assert_success(ost_bench_write_system(ctx, path, folder));
    assert_int_equal(system_file_read(folder, ost_rank(ctx), system, failure), 0);
    assert_int_equal(system->ranks, ost_size(ctx));
    assert_int_equal(system->global_rows, FREE);
}

static double sum_over_ranks(double value)
{
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return value;
}

/* The loads sum up to the total force, and every node that is free is there once, at its place in the block. */
static void the_file_holds_the_loads_and_the_nodes(void **state)
{
    SystemFile system;
    double force[3] = {0.0}, rows = 0.0, labels = 0.0;
    read_back(&system);
    for (OstLocal row = 0; row < system.rows; row++, rows++) {
        const OstLocal place = (OstLocal)system.label[row] - 1;
        const double at[3] = {place / 9, place % 9 / 3 * 0.5, place % 3 * 0.5};
        labels += (double)system.label[row];
        for (int i = 0; i < 3; i++) {
            assert_close(system.coordinates[3 * row + i], at[i], 1e-14);
            force[i] += system.right_side[3 * row + i];
        }
    }
    assert_close(sum_over_ranks(rows), FREE, 0.0);
    assert_close(sum_over_ranks(labels), (10 + NODES) * FREE / 2, 0.0);
    assert_close(sum_over_ranks(force[0]), 0.1, 1e-14);
    assert_close(sum_over_ranks(force[1]), 0.02, 1e-14);
    assert_close(sum_over_ranks(force[2]), 0.0, 1e-14);
    system_file_release(&system);
    remove_folder();
}

static void solve(const SystemFile *system, double **u)
{
    SystemFile file = *system;
    OstBlockMatrix *matrix = NULL;
    OstSolver *solver = NULL;
    OstSolverOptions options = ost_solver_default_options();
    OstSolveReport report;
    options.method = OST_METHOD_DIRECT;
    options.relative_residual = 1e-12;
    assert_success(ost_bench_matrix(ctx, &file, &matrix));
    assert_success(OST_NEW(ctx, u, 3 * (size_t)matrix->columns));
    assert_success(ost_solver_create(ctx, matrix, &(OstSolverGeometry){.coordinates = NULL}, &options, &solver));
    assert_success(ost_solver_solve(solver, system->right_side, *u, &report));
    ost_solver_destroy(&solver);
    ost_block_matrix_destroy(&matrix);
}

/* A u of the file's own arrays, by global rows gathered from all ranks: f comes out. */
static void the_file_holds_the_equations(void **state)
{
    SystemFile system;
    double all[3 * FREE] = {0.0}, *u = NULL, residual = 0.0, size = 0.0;
    read_back(&system);
    solve(&system, &u);
    memcpy(all + 3 * system.first_row, u, 3 * (size_t)system.rows * sizeof *u);
    MPI_Allreduce(MPI_IN_PLACE, all, 3 * FREE, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    for (int row = 0; row < system.rows; row++)
        for (int i = 0; i < 3; i++) {
            double r = system.right_side[3 * row + i];
            size += r * r;
            for (int b = system.row_start[row]; b < system.row_start[row + 1]; b++) {
                const int c = system.column[b];
                const int64_t global = c < system.rows ? system.first_row + c : system.ghost_row[c - system.rows];
                for (int j = 0; j < 3; j++)
                    r -= system.value[9 * b + 3 * i + j] * all[3 * global + j];
            }
            residual += r * r;
        }
    size = sum_over_ranks(size);
    assert_true(size > 0.0);
    assert_true(sum_over_ranks(residual) <= 1e-24 * 4.0 * size); /* the tolerance, twice */
    OST_FREE(u);
    system_file_release(&system);
    remove_folder();
}

/* What is not a whole file is refused. */
static void a_cut_file_is_refused(void **state)
{
    SystemFile system;
    char path[96], failure[SYSTEM_FAILURE];
    read_back(&system);
    system_file_release(&system);
    snprintf(path, sizeof path, "%s/system.%d", folder, ost_rank(ctx));
    assert_int_equal(truncate(path, 1000), 0);
    assert_int_equal(system_file_read(folder, ost_rank(ctx), &system, failure), -1);
    assert_non_null(strstr(failure, "is not a whole file"));
    assert_int_equal(system_file_read(folder, 77, &system, failure), -1);
    assert_non_null(strstr(failure, "cannot be opened"));
    remove_folder();
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_file_holds_the_loads_and_the_nodes),
    cmocka_unit_test(the_file_holds_the_equations),
    cmocka_unit_test(a_cut_file_is_refused),
};
OST_TEST_MAIN(tests)
