/* SPDX-License-Identifier: BSD-3-Clause */
#include "system_matrix.h"

#include "core/error.h"
#include "core/memory.h"
#include "problem/problem.h"
#include "problem/row_geometry.h"

#include <string.h>

/* What is between a case and its file. */
typedef struct Writing {
    OstCase *c;
    OstScene *scene;
    OstProblem *problem;
    OstSystem *system; /* the problem's */
    OstRowGeometry rows;
    double *right_side;
    OstGlobal *row_number; /* of every column */
    OstGlobal *label;
} Writing;

static void release(Writing *w)
{
    OST_FREE(w->right_side);
    ost_row_geometry_release(&w->rows);
    OST_FREE(w->row_number, w->label);
    ost_problem_destroy(&w->problem);
    ost_scene_destroy(&w->scene);
    ost_case_destroy(&w->c);
}

static OstStatus assemble(OstContext *ctx, const char *case_path, Writing *w)
{
    OST_TRY(ost_case_read(ctx, case_path, &w->c));
    OST_TRY(ost_scene_create(w->c, &w->scene));
    OST_TRY(ost_scene_problem(w->scene, &w->problem));
    OST_TRY(ost_problem_stiffness(w->problem, 1.0, NULL, NULL));
    w->system = w->problem->system;
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &w->right_side, 3 * (size_t)w->system->matrix->rows)));
    return ost_agree(ctx, ost_problem_right_hand_side(w->problem, 1.0, w->right_side));
}

static OstStatus describe_rows(OstContext *ctx, Writing *w)
{
    const OstBlockMatrix *matrix = w->system->matrix;
    OstStatus status = OST_NEW(ctx, &w->label, (size_t)matrix->rows);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &w->row_number, (size_t)matrix->columns);
    OST_TRY(ost_agree(ctx, status));
    OST_TRY(ost_row_geometry_create(w->system, w->scene->field, w->problem->with_metric, &w->rows));
    for (OstLocal row = 0; row < matrix->rows; row++) {
        w->row_number[row] = matrix->first_row + row;
        w->label[row] = w->scene->mesh->node_label[w->system->node_of_row[row]];
    }
    return ost_halo_import(matrix->halo, sizeof *w->row_number, w->row_number);
}

static OstStatus write_rows(OstContext *ctx, const Writing *w, const char *folder)
{
    const OstBlockMatrix *matrix = w->system->matrix;
    char failure[SYSTEM_FAILURE];
    const SystemFile file = {.rank = ost_rank(ctx),
                             .ranks = ost_size(ctx),
                             .rows = matrix->rows,
                             .ghosts = matrix->columns - matrix->rows,
                             .blocks = matrix->row_start[matrix->rows],
                             .has_metric = w->rows.metric != NULL,
                             .first_row = matrix->first_row,
                             .global_rows = matrix->global_rows,
                             .row_start = matrix->row_start,
                             .column = matrix->column,
                             .ghost_row = w->row_number + matrix->rows,
                             .label = w->label,
                             .value = matrix->value,
                             .right_side = w->right_side,
                             .coordinates = w->rows.coordinates,
                             .modes = w->rows.modes,
                             .metric = w->rows.metric};
    if (system_file_write(&file, folder, failure) != 0)
        return OST_RAISE(ctx, OST_FILE_FAILED, "%s", failure);
    return OST_SUCCESS;
}

OstStatus ost_bench_write_system(OstContext *ctx, const char *case_path, const char *folder)
{
    Writing w = {0};
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(assemble(ctx, case_path, &w));
    OST_TRY_DONE(describe_rows(ctx, &w));
    OST_TRY_DONE(ost_agree(ctx, write_rows(ctx, &w, folder)));
done:
    release(&w);
    return status;
}

static OstStatus copy_rows(OstContext *ctx, const SystemFile *system, OstBlockMatrix *matrix)
{
    const size_t rows = (size_t)system->rows, blocks = (size_t)system->blocks;
    OST_TRY(OST_NEW(ctx, &matrix->label, matrix->columns));
    OST_TRY(OST_NEW(ctx, &matrix->row_start, rows + 1));
    OST_TRY(OST_NEW(ctx, &matrix->column, blocks));
    OST_TRY(OST_NEW(ctx, &matrix->diagonal, rows));
    OST_TRY(OST_NEW(ctx, &matrix->value, 9 * blocks));
    memcpy(matrix->label, system->label, rows * sizeof *system->label);
    memcpy(matrix->row_start, system->row_start, (rows + 1) * sizeof *system->row_start);
    memcpy(matrix->column, system->column, blocks * sizeof *system->column);
    memcpy(matrix->value, system->value, 9 * blocks * sizeof *system->value);
    for (OstLocal row = 0; row < system->rows; row++)
        for (OstLocal b = system->row_start[row]; b < system->row_start[row + 1]; b++)
            if (system->column[b] == row)
                matrix->diagonal[row] = b;
    return OST_SUCCESS;
}

OstStatus ost_bench_matrix(OstContext *ctx, const SystemFile *system, OstBlockMatrix **matrix)
{
    OstBlockMatrix *made = NULL;
    OstStatus status = OST_NEW(ctx, &made, 1);
    if (status == OST_SUCCESS) {
        made->ctx = ctx;
        made->rows = system->rows;
        made->columns = system->rows + system->ghosts;
        made->first_row = system->first_row;
        made->global_rows = system->global_rows;
        status = copy_rows(ctx, system, made);
    }
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_halo_create(ctx, system->rows, system->first_row, system->ghosts, system->ghost_row, &made->halo));
    OST_TRY_DONE(ost_halo_import(made->halo, sizeof *made->label, made->label));
done:
    if (status != OST_SUCCESS)
        ost_block_matrix_destroy(&made);
    *matrix = made;
    return status;
}
