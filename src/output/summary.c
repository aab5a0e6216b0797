/* SPDX-License-Identifier: BSD-3-Clause */
#include "output/summary.h"
#include "core/error.h"

#include "output/probe_files.h"
#include "solve/buckling/buckling.h"

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

/* "4 %", to two digits; 1e-8 where it is less than a thousandth of that. */
static const char *percent(double share, char text[24])
{
    if (share > 1e-5)
        return ost_percent(share, text, 24);
    snprintf(text, 24, "%.0e", share);
    return text;
}

/* Why so few iterations. */
static void print_stop(const OstSolveReport *report, const OstAnswerError *answer)
{
    char equations[24], mesh[24];
    if (!report->stopped || !answer->known)
        return;
    const double relative = report->algebraic_error * answer->relative / answer->energy_norm;
    printf("  stopped          where the equations are %s off in energy norm, and the mesh %s",
           percent(relative, equations), percent(answer->relative, mesh));
    if (report->iterations_saved > 0)
        printf("; about %d iteration%s saved", report->iterations_saved, plural(report->iterations_saved));
    printf("\n");
}

/* After an early stop the residual is no measure of the answer: what is left are forces between neighbouring nodes that
 * cancel a little farther away and hardly move anything. Only those who ask for all are told. */
static int tells_residual(const OstResult *result)
{
    return !result->solve.stopped || ost_log_level(result->ctx) == OST_LOG_VERBOSE;
}

static void print_residual(const OstSolveReport *report)
{
    printf("  residual         %.2e of the loads (true, recomputed)\n", report->relative_residual);
    if (report->stopped)
        printf("                   of forces between neighbouring nodes that hardly move anything: the error above "
               "counts\n");
    if (report->rounding_limited)
        printf("                   above what was asked for: double precision allows about %.2g here\n",
               report->attainable_residual);
}

static void print_solve(const OstResult *result)
{
    const OstSolveReport *report = &result->solve;
    if (report->stopped && report->steps == 0) /* none was tried */
        printf("  solver           the sum of answers to other load cases, each times a factor\n");
    else
        printf("  solver           %s, %d iteration%s, setup %.3f s, solve %.3f s\n", ost_method_name(report->method),
               report->iterations, plural(report->iterations), report->setup_seconds, report->solve_seconds);
    printf("  engine           %s\n", report->engine);
    print_stop(report, &result->answer);
    print_strategies(report);
    print_levels(report);
    if (tells_residual(result))
        print_residual(report);
    if (report->condition_estimate > 0.0)
        printf("  condition        about %.3g after preconditioning\n", report->condition_estimate);
}

/* The error of the answer first: that of the equations is not the whole of it. */
static void print_accuracy(const OstAnswerError *answer, const OstChecks *checks)
{
    char text[24];
    if (!answer->known)
        return;
    if (answer->relative > 0.0)
        printf("  accuracy         answer about %s off in energy norm", percent(answer->relative, text));
    else
        printf("  accuracy         answer exact but for rounding in energy norm");
    if (isfinite(answer->displacement))
        printf(", %s%s in the largest displacement", answer->displacement_is_least ? "at least " : "",
               percent(answer->displacement, text));
    printf("; equations solved to %.0e\n",
           isfinite(checks->displacement_error) ? checks->displacement_error : checks->relative_residual);
}

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

static void print_checks(const OstResult *result)
{
    const OstChecks *checks = &result->checks;
    printf("  checks           ");
    if (tells_residual(result))
        printf("residual summed tet by tet %.2e, ", checks->relative_residual);
    printf("force balance %.1e, moment balance %.1e", checks->force_imbalance, checks->moment_imbalance);
    if (checks->linear)
        printf(", energy %.1e", checks->energy_imbalance);
    printf("\n");
}

/* A larger error of linear theory is warned of, unless the case has said what it accepts: strains of 4 %, or rotations
 * of 0.2 (11 degrees). The mesh rarely has a smaller one. */
static const double small_error = 0.02;

static const double degrees = 57.29577951308232;

/* "by about 12 %" */
static void describe_error(double error, char text[32])
{
    snprintf(text, 32, "by more than 100 %%");
    if (error < 1.0)
        snprintf(text, 32, "by about %.2g %%", 100.0 * error);
}

/* "120 % stiffer" */
static void describe_stiffening(double stiffening, char text[48])
{
    char share[24];
    snprintf(text, 48, "%s %s", ost_percent(fabs(stiffening), share, sizeof share),
             stiffening < 0.0 ? "softer" : "stiffer");
}

int ost_linearity_warning(const OstChecks *checks, int linear_alone, char text[OST_LONGEST_WARNING])
{
    const double error = ost_linear_error(checks);
    char off[32], stiffened[48];
    text[0] = '\0';
    if (!checks->linear || !checks->finite || !(error > small_error))
        return 0;
    describe_error(error, off);
    describe_stiffening(checks->stiffening, stiffened);
    if (fabs(checks->stiffening) >= error)
        snprintf(
            text, OST_LONGEST_WARNING,
            "stress makes the body %s as it turns, by up to %.3g degrees: linear theory, which leaves that out, is "
            "off %s; %sscale the loads down",
            stiffened, checks->largest_rotation * degrees, off, linear_alone ? "" : "take large_rotation: on, or ");
    else
        snprintf(
            text, OST_LONGEST_WARNING,
            "rotations are up to %.3g degrees and strains up to %.3g %%: linear theory, which takes both as small, "
            "is off %s there; scale the loads down, or read the result as a direction",
            checks->largest_rotation * degrees, 100.0 * checks->largest_strain, off);
    return 1;
}

static int warn_of_linear_theory(const OstResult *result, char text[OST_LONGEST_WARNING])
{
    const int accepted = result->newton.judged && result->newton.linear_error <= result->newton.accuracy;
    return !accepted && ost_linearity_warning(&result->checks, result->linear_alone, text);
}

static int warn_of_inverted(const OstResult *result, char text[OST_LONGEST_WARNING])
{
    const OstWorstTet *worst = &result->worst;
    if (!result->newton.used || worst->inverted == 0)
        return 0;
    snprintf(text, OST_LONGEST_WARNING,
             "%lld tet%s turned inside out, the worst of them tet %lld of region '%.60s' at (%.4g, %.4g, %.4g): the "
             "result means nothing there; refine the mesh, or spread the load",
             (long long)worst->inverted, worst->inverted == 1 ? " is" : "s are", (long long)worst->tet,
             result->mesh->regions.name[worst->region], worst->place[0], worst->place[1], worst->place[2]);
    return 1;
}

static int warn_of_jump(const OstResult *result, char text[OST_LONGEST_WARNING])
{
    const OstNewtonReport *newton = &result->newton;
    if (newton->jumps == 0)
        return 0;
    snprintf(text, OST_LONGEST_WARNING,
             "on the way to load factor %.6g the body jumps to another state at rest (it buckles, or snaps through)%s: "
             "%swhich one is reached may depend on what is not in the scene",
             newton->jump_at, newton->jumps > 1 ? ", as it has done before" : "",
             newton->stability_unknown ? "" : "the state beyond is stable, but ");
    return 1;
}

static int warn_of_stability(const OstResult *result, char text[OST_LONGEST_WARNING])
{
    if (!result->newton.stability_unknown)
        return 0;
    if (result->newton.stability_unknown == 2)
        snprintf(text, OST_LONGEST_WARNING,
                 "it is not known whether the state at rest is stable: the pressure follows a surface with a free rim, "
                 "so that no energy tells, and the symmetric part of the stiffness is indefinite there, as it is near "
                 "a limit load and beyond one: the body may rest elsewhere");
    else if (result->newton.stability_unknown == 3)
        snprintf(text, OST_LONGEST_WARNING,
                 "it is not known whether the state at rest is stable: without the moved distributing coupling it is "
                 "not, and factors that would tell take more memory than there is; the body may rest elsewhere");
    else
        snprintf(
            text, OST_LONGEST_WARNING,
            "it is not known whether the state at rest is stable: without its pressures the stiffness is indefinite "
            "there, as it is near a buckling load and beyond one, and factors that would tell take more memory than "
            "there is; element: {mixed: off} with nu below 1/2 tells");
    return 1;
}

/* Near buckling what is not in the scene, as a column's own curvature, may matter more than what is. */
static int warn_of_buckling(const OstResult *result, char text[OST_LONGEST_WARNING])
{
    const OstBuckling *buckling = &result->buckling;
    if (!buckling->known || !(buckling->factor[0] < ost_near_buckling(result->mesh)) || result->newton.jumps > 0)
        return 0;
    if (buckling->factor[0] < 1.0)
        snprintf(text, OST_LONGEST_WARNING, "by linear theory the body buckles at %.4g times this load: %s",
                 buckling->factor[0],
                 result->newton.used ? "what it does beyond depends on what is not in the scene, as its imperfections"
                                     : "the state at rest that is found is not stable");
    else if (result->mesh->nodes_per_tet == 4)
        snprintf(text, OST_LONGEST_WARNING,
                 "by linear theory the body buckles at %.4g times this load, and that of linear tets, which bend too "
                 "little: it may buckle far below; set element: {order: 2}",
                 buckling->factor[0]);
    else
        snprintf(text, OST_LONGEST_WARNING,
                 "by linear theory the body buckles at %.4g times this load: what is not in the scene, as a small "
                 "curvature of its own, grows to about %.2g times as much",
                 buckling->factor[0], buckling->factor[0] / (buckling->factor[0] - 1.0));
    return 1;
}

/* A larger error of the answer is warned of. */
static const double coarse = 0.05;

static int warn_of_coarse_mesh(const OstResult *result, char text[OST_LONGEST_WARNING])
{
    const OstAnswerError *answer = &result->answer;
    const OstMesh *mesh = result->mesh;
    char off[24], share[24], where[160] = "";
    if (!answer->known || !(answer->relative > coarse))
        return 0;
    if (mesh->regions.count > 1)
        snprintf(where, sizeof where, " in region '%.60s' (%s of it), most", mesh->regions.name[answer->region],
                 percent(answer->region_share, share));
    snprintf(text, OST_LONGEST_WARNING,
             "the mesh is coarse: the answer is about %s off in energy norm; %s the mesh%s near (%.4g, %.4g, %.4g)",
             percent(answer->relative, off), mesh->nodes_per_tet == 4 ? "set element: {order: 2}, or refine" : "refine",
             where, answer->place[0], answer->place[1], answer->place[2]);
    return 1;
}

static int warn_of_no_error(const OstResult *result, char text[OST_LONGEST_WARNING])
{
    if (result->answer.known || !result->answer.is_indefinite)
        return 0;
    snprintf(text, OST_LONGEST_WARNING,
             "the error of the answer is not known: the stiffness that its estimate takes there is not positive "
             "definite%s",
             result->mesh->nodes_per_tet == 4 ? "; that of quadratic tets may be: set element: {order: 2}" : "");
    return 1;
}

/* A curved surface of plane faces makes an error that no estimate on the same mesh sees. Bending changes by two to four
 * times the share of the volume. */
static const double small_cut = 0.01;

static int warn_of_cut_off(const OstResult *result, char text[OST_LONGEST_WARNING])
{
    const OstAnswerError *answer = &result->answer;
    char lacking[24], filled[24];
    if (!(fmax(answer->cut_off, answer->filled_in) > small_cut))
        return 0;
    snprintf(text, OST_LONGEST_WARNING,
             "faces of the surface meet at small angles: if it is meant to be curved there, they cut off about %s of "
             "the volume and add %s in hollows, beside the error of the answer, also in finer meshes made of this one; "
             "take quadratic tets whose mid-edge nodes lie on the surface (of a built-in shape: element: {order: 2})",
             percent(answer->cut_off, lacking), percent(answer->filled_in, filled));
    return 1;
}

/* So is one of the equations, where they were solved to a large residual that was asked for. */
static int warn_of_large_residual(const OstResult *result, char text[OST_LONGEST_WARNING])
{
    const OstSolveReport *report = &result->solve;
    const double residual = 1e-4, error = fmax(result->checks.displacement_error, result->checks.force_error);
    char off[24];
    if (!(error > coarse && report->relative_residual > residual) || report->stopped || report->rounding_limited)
        return 0;
    snprintf(
        text, OST_LONGEST_WARNING,
        "the residual asked for leaves displacement or stresses about %s off, beside the error of the mesh; ask for "
        "a smaller accuracy: {relative_residual: ...}",
        percent(error, off));
    return 1;
}

int ost_result_warning(const OstResult *result, int number, char text[OST_LONGEST_WARNING])
{
    int (*const warn[OST_WARNINGS])(const OstResult *, char *) = {
        warn_of_linear_theory, warn_of_cut_off,        warn_of_inverted, warn_of_jump,    warn_of_stability,
        warn_of_coarse_mesh,   warn_of_large_residual, warn_of_buckling, warn_of_no_error};
    text[0] = '\0';
    return warn[number](result, text);
}

/* What was found out about large rotations, and what was done about them. */
static void print_large_rotation(const OstScene *scene, const OstResult *result)
{
    const OstNewtonReport *newton = &result->newton;
    char off[32], stiffened[48];
    if (!newton->judged)
        return;
    describe_error(newton->linear_error, off);
    describe_stiffening(newton->linear_stiffening, stiffened);
    printf("  large rotation   rotations up to %.3g degrees, strains up to %.3g %% by linear theory, which ",
           degrees * newton->linear_rotation, 100.0 * newton->linear_strain);
    if (fabs(newton->linear_stiffening) >= newton->linear_error)
        printf("leaves out that stress makes the body %s as it turns, and ", stiffened);
    else if (result->buckling.known && 1.0 / result->buckling.factor[0] == newton->linear_error)
        printf("leaves out that the body buckles, and ");
    else if (newton->linear_change >= newton->linear_error && newton->linear_error > newton->accuracy)
        printf("leaves out that the loads act on the body as it has moved, and to first order ");
    printf("is off %s: ", off);
    if (!newton->used && newton->linear_error <= newton->accuracy)
        printf("no more than the %.2g %% allowed, solved linearly\n", 100.0 * newton->accuracy);
    else
        printf("%s\n", newton->used ? "solved by Newton's method" : "not solved on");
    if (!newton->used)
        return;
    printf(
        "  newton           %d load step%s, %d iteration%s, %d of them with the definite stiffness; %d setup%s of the "
        "solver; %.3f s\n",
        newton->load_steps, plural(newton->load_steps), newton->iterations, plural(newton->iterations),
        newton->definite, newton->setups, plural(newton->setups), newton->seconds);
    printf("                   the body's volume is %.6g times that of the undeformed one\n",
           result->checks.volume_ratio);
    if (newton->cut_backs > 0)
        printf("                   %d load step%s given up and cut back\n", newton->cut_backs,
               plural(newton->cut_backs));
    if (result->unfinished && scene->c->path_steps > 0)
        printf("                   the path is followed up to t = %.6g\n", newton->reached);
    else if (result->unfinished)
        printf("                   %.6g of the load is reached\n", newton->reached);
}

static void print_buckling(const OstResult *result)
{
    const OstBuckling *buckling = &result->buckling;
    if (!buckling->known)
        return;
    printf("  buckling         ");
    for (int m = 0; m < buckling->count && (m == 0 || isfinite(buckling->factor[m])); m++)
        if (isfinite(buckling->factor[m]))
            printf("%sat %.5g", m > 0 ? ", " : "", buckling->factor[m]);
        else
            printf("never");
    printf(" times the load, by linear theory%s\n", buckling->converged ? "" : " (or below: not converged)");
}

static const char *const criterion_word[OST_CRITERIA] = {
    [OST_TSAI_WU] = "Tsai-Wu", [OST_HILL] = "Hill", [OST_MAXIMUM_STRESS] = "maximum stress"};

/* How much the load may grow, and where the body then fails. */
static void print_failure(const OstResult *result)
{
    const OstFailure *failure = &result->failure;
    for (int c = 0; failure->known && c < OST_CRITERIA; c++) {
        const OstLeastFactor *least = &failure->least[c];
        printf("  %-16s %s: ", c == 0 ? "strength" : "", criterion_word[c]);
        if (least->factor < OST_MOST_LOAD_FACTOR)
            printf("fails at %.5g times the load, in tet %lld of region '%s' at (%.6g, %.6g, %.6g)\n", least->factor,
                   (long long)least->tet, result->mesh->regions.name[least->region], least->place[0], least->place[1],
                   least->place[2]);
        else
            printf("fails nowhere, however much the load grows\n");
    }
}

static void print_probes(const OstScene *scene, const char *fields)
{
    char name[4096];
    for (int p = 0; p < scene->c->probe_count; p++) {
        ost_probe_file_name(fields, &scene->c->probes[p], sizeof name, name);
        printf("  %-16s %s\n", p == 0 ? "probes" : "", name);
    }
}

void ost_summary_print(const OstScene *scene, const OstResult *result, const char *file, const char *probes)
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
    print_accuracy(&result->answer, checks);
    print_solve(result);
    print_buckling(result);
    print_large_rotation(scene, result);
    print_checks(result);
    print_errors(checks);
    printf("  strain energy    %.10g\n", checks->strain_energy);
    printf("  largest |u|      %.10g at (%.6g, %.6g, %.6g)\n", result->largest_displacement, at[0], at[1], at[2]);
    print_failure(result);
    for (int w = 0; w < OST_WARNINGS; w++)
        if (ost_result_warning(result, w, warning))
            printf("  %-16s %s\n", "WARNING", warning);
    for (int i = 0; i < result->verdict.count; i++)
        printf("  %-16s %s\n", i == 0 ? "NO ANSWER" : "", result->verdict.text[i]);
    if (file)
        print_probes(scene, probes);
    if (file)
        printf("  written to       %s%s%s\n", file, result->verdict.count > 0 ? ", marked as " : "",
               result->verdict.count > 0 ? ost_result_status(result) : "");
}
