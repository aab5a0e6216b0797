/* SPDX-License-Identifier: BSD-3-Clause */
#include <orthostat/orthostat.h>

#include <stdio.h>

/* The library from outside: reads a case, solves it, prints the largest displacement. */
static OstStatus solve(OstContext *ctx, const char *path)
{
    OstCase *c = NULL;
    OstScene *scene = NULL;
    OstResult *result = NULL;
    OstStatus status = ost_case_read(ctx, path, &c);
    if (status == OST_SUCCESS)
        status = ost_scene_create(c, &scene);
    if (status == OST_SUCCESS)
        status = ost_scene_solve(scene, &result);
    if (status == OST_SUCCESS)
        printf("%.9g\n", result->largest_displacement);
    else
        fprintf(stderr, "%s\n", ost_error_text(ctx));
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
    return status;
}

int main(int argc, char **argv)
{
    OstContext *ctx = NULL;
    MPI_Init(&argc, &argv);
    if (argc != 2 || ost_context_create(MPI_COMM_WORLD, &ctx) != OST_SUCCESS)
        return 2;
    const OstStatus status = solve(ctx, argv[1]);
    ost_context_destroy(&ctx);
    MPI_Finalize();
    return ost_status_exit_code(status);
}
