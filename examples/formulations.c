/* SPDX-License-Identifier: BSD-3-Clause */
/* What large rotations cost in Li and Barbič's classical form, f = R K (R'x - X), beside the consistent one, whose
 * forces are the gradient of an energy. A beam, 8 × 1 × 1, is 1 to 1000 times as stiff along its fibres, which run at
 * 30 degrees to it, as across. A table has, for both formulations, moment: of the internal forces of the beam bent into
 * a quarter of a circle, over its energy, and loop: their work while the beam is stretched, sheared and put back, over
 * the largest energy on the way; and by how much the poses under a force at the beam's end differ, over the largest
 * displacement.
 *
 *     mpirun -n 2 ./formulations
 */
#include <orthostat/orthostat.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define TRY(call)        \
    do {                 \
        status = (call); \
        if (status)      \
            goto done;   \
    } while (0)

enum { CONSISTENT, CLASSICAL, FORMS, POINTS = 64 };
static const OstFormulation formulations[FORMS] = {OST_FORMULATION_CONSISTENT, OST_FORMULATION_CLASSICAL};
static const double pi = 3.14159265358979323846;

/* The numbers of one row. */
typedef struct Costs {
    double moment[FORMS], loop[FORMS];
    double pose;
} Costs;

/* To be filled in: E1 and the force. */
static const char beam[] = "mesh: {block: {size: [8, 1, 1], divisions: [24, 3, 3]}}\n"
                           "materials:\n"
                           "  - region: all\n"
                           "    youngs_modulus: [%.17g, 1, 1]\n"
                           "    poissons_ratio: 0.3\n"
                           "    axes: {euler: {degrees: [30, 0, 0], sequence: zxz}}\n"
                           "large_rotation: on\n"
                           "constraints:\n"
                           "  - {on: {boundary: [xmin]}, displacement: [0, 0, 0]}\n"
                           "loads:\n"
                           "  - {on: {boundary: [xmax]}, total_force: [0, -%.17g, 0]}\n";

/* A force F with F length² = E I. Along the beam, the stable family has 1/E = (cos² / sqrt E1 + sin² / sqrt E2)². */
static void write_case(double ratio, char *text, size_t size)
{
    const double root = 0.75 / sqrt(ratio) + 0.25;
    snprintf(text, size, beam, ratio, 1.0 / (root * root) / 12.0 / 64.0);
}

static double sum_over_ranks(double value)
{
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return value;
}

/* u takes the beam to a quarter of a circle. */
static OstStatus find_moment(const OstProblem *problem, double *u, double *force, double *moment)
{
    const OstMesh *mesh = ost_problem_mesh(problem);
    const double *x = ost_mesh_coordinates(mesh);
    const double radius = 8.0 / (0.5 * pi);
    double sum[3] = {0.0, 0.0, 0.0};
    double energy = 0.0;
    for (OstLocal n = 0; n < ost_mesh_node_count(mesh); n++) {
        const double angle = x[3 * n] / radius;
        const double from_centre = radius + x[3 * n + 1] - 0.5;
        u[3 * n] = from_centre * sin(angle) - x[3 * n];
        u[3 * n + 1] = from_centre * cos(angle) - radius - x[3 * n + 1];
        u[3 * n + 2] = 0.0;
    }
    OstStatus status = ost_problem_force(problem, 1.0, u, force);
    if (status == OST_SUCCESS)
        status = ost_problem_energy(problem, 1.0, u, &energy);
    for (OstLocal n = 0; n < ost_mesh_owned_nodes(mesh); n++)
        for (int i = 0; i < 3; i++) {
            const OstLocal j = 3 * n + (i + 1) % 3, k = 3 * n + (i + 2) % 3;
            sum[i] += (x[j] + u[j]) * force[k] - (x[k] + u[k]) * force[j];
        }
    for (int i = 0; i < 3; i++)
        sum[i] = sum_over_ranks(sum[i]);
    *moment = hypot(hypot(sum[0], sum[1]), sum[2]) / energy;
    return status;
}

/* u goes round a circle through 0: stretched by up to 20 %, and sheared by up to 0.1 one way and the other. On a
 * circle, sums over equally spaced points are integrals to rounding. */
static OstStatus find_loop(const OstProblem *problem, double *u, double *force, double *loop)
{
    const OstMesh *mesh = ost_problem_mesh(problem);
    const double *x = ost_mesh_coordinates(mesh);
    double work = 0.0, largest = 0.0;
    OstStatus status = OST_SUCCESS;
    for (int point = 0; point < POINTS && status == OST_SUCCESS; point++) {
        const double angle = 2.0 * pi * point / POINTS;
        double energy = 0.0;
        for (OstLocal n = 0; n < ost_mesh_node_count(mesh); n++) {
            u[3 * n] = 0.1 * ((1.0 - cos(angle)) * x[3 * n] + sin(angle) * x[3 * n + 1]);
            u[3 * n + 1] = u[3 * n + 2] = 0.0;
        }
        status = ost_problem_force(problem, 1.0, u, force);
        if (status == OST_SUCCESS)
            status = ost_problem_energy(problem, 1.0, u, &energy);
        for (OstLocal n = 0; n < ost_mesh_owned_nodes(mesh); n++)
            work += 2.0 * pi / POINTS * force[3 * n] * 0.1 * (sin(angle) * x[3 * n] + cos(angle) * x[3 * n + 1]);
        largest = fmax(largest, energy);
    }
    *loop = fabs(sum_over_ranks(work)) / largest;
    return status;
}

/* The largest difference of two results' displacements, over the largest displacement. */
static double difference(const OstMesh *mesh, OstResult *const result[FORMS])
{
    const double *u = ost_result_displacement(result[CONSISTENT]);
    const double *v = ost_result_displacement(result[CLASSICAL]);
    double largest = 0.0;
    for (OstLocal n = 0; n < ost_mesh_owned_nodes(mesh); n++)
        largest =
            fmax(largest, hypot(hypot(u[3 * n] - v[3 * n], u[3 * n + 1] - v[3 * n + 1]), u[3 * n + 2] - v[3 * n + 2]));
    MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    return largest / ost_result_largest_displacement(result[CONSISTENT], NULL);
}

static OstStatus find_costs(OstContext *ctx, double ratio, Costs *costs)
{
    OstStatus status = OST_SUCCESS;
    OstCase *c = NULL;
    OstScene *scene = NULL;
    OstProblem *problem = NULL;
    OstResult *result[FORMS] = {NULL, NULL};
    double *u = NULL, *force = NULL;
    char text[1024];

    write_case(ratio, text, sizeof text);
    TRY(ost_case_parse(ctx, "beam", text, &c));
    TRY(ost_scene_create(c, &scene));
    TRY(ost_scene_problem(scene, &problem));

    const OstMesh *mesh = ost_scene_mesh(scene);
    u = calloc(3 * (size_t)ost_mesh_node_count(mesh) + 1, sizeof *u);
    force = calloc(3 * (size_t)ost_mesh_owned_nodes(mesh) + 1, sizeof *force);
    for (int form = 0; form < FORMS; form++) {
        ost_problem_set_formulation(problem, formulations[form]);
        TRY(find_moment(problem, u, force, &costs->moment[form]));
        TRY(find_loop(problem, u, force, &costs->loop[form]));
        TRY(ost_problem_solve(problem, ost_case_solver_options(c), 0, &result[form]));
    }
    costs->pose = difference(mesh, result);
done:
    free(u);
    free(force);
    for (int form = 0; form < FORMS; form++)
        ost_result_destroy(&result[form]);
    ost_problem_destroy(&problem);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
    return status;
}

int main(int argc, char **argv)
{
    OstContext *ctx = NULL;
    MPI_Init(&argc, &argv);
    OstStatus status = ost_context_create(MPI_COMM_WORLD, &ctx);
    const int speaks = ctx && ost_rank(ctx) == 0;
    if (speaks)
        printf("| E1/E2 | moment, consistent | moment, classical | loop, consistent | loop, classical | poses differ "
               "by |\n"
               "|---|---|---|---|---|---|\n");
    for (int power = 0; power <= 3 && status == OST_SUCCESS; power++) {
        const double ratio = pow(10.0, power);
        Costs costs;
        status = find_costs(ctx, ratio, &costs);
        if (speaks && status == OST_SUCCESS)
            printf("| %g | %.2g | %.3g | %.2g | %.3g | %.3g |\n", ratio, costs.moment[CONSISTENT],
                   costs.moment[CLASSICAL], costs.loop[CONSISTENT], costs.loop[CLASSICAL], costs.pose);
    }
    if (speaks && status)
        fprintf(stderr, "%s\n", ost_error_text(ctx));
    ost_context_destroy(&ctx);
    MPI_Finalize();
    return ost_status_exit_code(status);
}
