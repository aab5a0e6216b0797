/* SPDX-License-Identifier: BSD-3-Clause */
#include "output/summary.h"

#include <math.h>
#include <stdio.h>

static const char *plural(OstGlobal count)
{
    return count == 1 ? "" : "s";
}

static void print_levels(const OstSolveReport *report)
{
    if (report->levels < 2)
        return;
    printf("  levels           ");
    for (int l = 0; l < report->levels; l++)
        printf("%s%lld", l ? " > " : "", (long long)report->level_unknowns[l]);
    printf(" unknowns, operator complexity %.2f\n", report->operator_complexity);
}

/* Why the solver began with its first strategy, and each strategy it tried. */
static void print_strategies(const OstSolveReport *report)
{
    for (int r = 0; r < report->plan.reasons; r++)
        printf("  %-16s %s\n", r == 0 ? "plan" : "", report->plan.reason[r]);
    for (int s = 0; report->steps > 1 && s < report->steps; s++)
        printf("  %-16s %s, %d iteration%s in %.3f s: %s\n", s == 0 ? "strategies" : "",
               ost_method_name(report->step[s].method), report->step[s].iterations, plural(report->step[s].iterations),
               report->step[s].seconds, report->step[s].outcome);
}

static void print_solve(const OstResult *result)
{
    const OstSolveReport *report = &result->solve;
    printf("  solver           %s, %d iteration%s, setup %.3f s, solve %.3f s\n", ost_method_name(report->method),
           report->iterations, plural(report->iterations), report->setup_seconds, report->solve_seconds);
    printf("  engine           %s\n", report->engine);
    print_strategies(report);
    print_levels(report);
    printf("  residual         %.2e of the loads (true, recomputed)\n", report->relative_residual);
    if (report->rounding_limited)
        printf("                   above what was asked for: double precision allows about %.2g here\n",
               report->attainable_residual);
    if (report->condition_estimate > 0.0)
        printf("  condition        about %.3g after preconditioning\n", report->condition_estimate);
}

/* The discretisation error is not in this: the line says "equations", so that nobody takes it for the whole error. */
static void print_errors(const OstChecks *checks)
{
    if (!isfinite(checks->displacement_error))
        return;
    printf("  equations        solved to a relative error of about %.1e in the displacement",
           checks->displacement_error);
    if (isfinite(checks->force_error))
        printf(", %.1e in reactions and stresses", checks->force_error);
    printf("\n");
}

/* A larger error of linear theory is warned of: strains of 4 %, or rotations of 0.2 (11 degrees). The mesh rarely has a
 * smaller one. */
static const double small_error = 0.02;

int ost_linearity_warning(const OstChecks *checks, char text[OST_LONGEST_WARNING])
{
    const double error = ost_linear_error(checks);
    char off[32] = "by more than 100 %";
    text[0] = '\0';
    if (!checks->linear || !checks->finite || !(error > small_error))
        return 0;
    if (error < 1.0)
        snprintf(off, sizeof off, "by about %.0f %%", 100.0 * error);
    snprintf(text, OST_LONGEST_WARNING,
             "rotations are up to %.3g degrees and strains up to %.3g %%: linear theory, which takes both as small, "
             "is off %s there; scale the loads down, or read the result as a direction",
             checks->largest_rotation * 57.29577951308232, 100.0 * checks->largest_strain, off);
    return 1;
}

void ost_summary_print(const OstScene *scene, const OstResult *result, const char *file)
{
    if (ost_rank(scene->ctx) != 0)
        return;
    const OstMesh *mesh = result->mesh;
    const double *at = result->largest_at;
    const OstChecks *checks = &result->checks;
    char warning[OST_LONGEST_WARNING];
    printf("%s\n", scene->c->title ? scene->c->title : scene->c->path);
    printf("  mesh             %lld vertices, %lld tet%s, %d rank%s\n", (long long)mesh->global_nodes,
           (long long)mesh->global_tets, plural(mesh->global_tets), ost_size(scene->ctx), plural(ost_size(scene->ctx)));
    printf("  unknowns         %lld\n", (long long)result->unknowns);
    print_solve(result);
    printf("  checks           residual summed tet by tet %.2e, force balance %.1e, moment balance %.1e, energy %.1e\n",
           checks->relative_residual, checks->force_imbalance, checks->moment_imbalance, checks->energy_imbalance);
    print_errors(checks);
    printf("  strain energy    %.10g\n", checks->strain_energy);
    printf("  largest |u|      %.10g at (%.6g, %.6g, %.6g)\n", result->largest_displacement, at[0], at[1], at[2]);
    if (ost_linearity_warning(checks, warning))
        printf("  %-16s %s\n", "WARNING", warning);
    for (int i = 0; i < result->verdict.count; i++)
        printf("  %-16s %s\n", i == 0 ? "NO ANSWER" : "", result->verdict.text[i]);
    if (file)
        printf("  written to       %s%s%s\n", file, result->verdict.count > 0 ? ", marked as " : "",
               result->verdict.count > 0 ? ost_result_status(result) : "");
}
