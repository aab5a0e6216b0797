/* SPDX-License-Identifier: BSD-3-Clause */
/* Solves a case file, says how far the body moves, and writes the fields for ParaView.
 *
 *     mpirun -n 2 ./solve_case tube.yaml tube.vtkhdf
 */
#include <orthostat/orthostat.h>

#include <stdio.h>

/* Every function that can fail returns a status, the same on all ranks. The first failure ends the story. */
#define TRY(call)        \
    do {                 \
        status = (call); \
        if (status)      \
            goto done;   \
    } while (0)

static OstStatus solve(OstContext *ctx, const char *case_file, const char *output_file)
{
    OstStatus status = OST_SUCCESS;
    OstCase *c = NULL;
    OstScene *scene = NULL;
    OstResult *result = NULL;
    double at[3];

    TRY(ost_case_read(ctx, case_file, &c)); /* the physics: shape, materials, supports, loads */
    TRY(ost_scene_create(c, &scene));       /* the mesh, spread over the ranks, and its materials */
    TRY(ost_scene_solve(scene, &result));   /* assembled, solved, checked */

    const double largest = ost_result_largest_displacement(result, at);
    if (ost_rank(ctx) == 0)
        printf("%s: moves by %.6g at most, at (%g, %g, %g)\n", ost_case_title(c), largest, at[0], at[1], at[2]);

    TRY(ost_result_write(result, ost_case_output_fields(c), output_file));
done: /* whatever was made is freed, last things first; NULL is fine */
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
    return status;
}

int main(int argc, char **argv)
{
    OstContext *ctx = NULL;
    MPI_Init(&argc, &argv);
    if (argc != 3) {
        fprintf(stderr, "Usage: solve_case CASE.yaml OUTPUT.vtkhdf\n");
        MPI_Finalize();
        return 2;
    }
    OstStatus status = ost_context_create(MPI_COMM_WORLD, &ctx);
    if (status == OST_SUCCESS) {
        status = solve(ctx, argv[1], argv[2]);
        if (status && ost_rank(ctx) == 0)
            fprintf(stderr, "%s\n", ost_error_text(ctx)); /* names the file, the line and what to do */
    }
    ost_context_destroy(&ctx);
    MPI_Finalize();
    return ost_status_exit_code(status);
}
