/* SPDX-License-Identifier: BSD-3-Clause */
#include "hard_grid/singular.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Monomials of degree up to 3 in three coordinates for each component of a displacement: with them plates and beams
 * bend, and their cross sections turn and stretch. */
enum { DEGREE = 3, MONOMIALS = 20, FIELDS = 3 * MONOMIALS };

typedef struct Motions {
    HardDirect *direct;
    double *position;                    /* of the rows' nodes, from -1 to 1 */
    double *force;                       /* K times each field, FIELDS × n */
    double *field;                       /* one of them, with ghosts */
    double energy[FIELDS * FIELDS];      /* of their pairs; then the motions as its columns */
    double value[FIELDS], scale[FIELDS]; /* the motions' energies; what the fields are scaled by */
} Motions;

extern void dsyev_(const char *job, const char *triangle, const int *n, double *a, const int *leading, double *value,
                   double *work, const int *length, int *info, size_t job_length, size_t triangle_length);

static OstStatus place_nodes(const OstScene *scene, Motions *motions)
{
    const OstMesh *mesh = scene->mesh;
    double most[6];
    for (int d = 0; d < 6; d++)
        most[d] = -INFINITY;
    for (size_t i = 0; i < 3 * (size_t)mesh->node_count; i++) {
        most[i % 3] = fmax(most[i % 3], -mesh->coordinates[i]);
        most[3 + i % 3] = fmax(most[3 + i % 3], mesh->coordinates[i]);
    }
    OST_TRY(OST_MPI(scene->ctx, MPI_Allreduce(MPI_IN_PLACE, most, 6, MPI_DOUBLE, MPI_MAX, ost_comm(scene->ctx))));
    for (size_t i = 0; i < motions->direct->n; i++) {
        const double low = -most[i % 3], high = most[3 + i % 3];
        const size_t node = (size_t)motions->direct->system->node_of_row[i / 3];
        motions->position[i] = (2.0 * mesh->coordinates[3 * node + i % 3] - low - high) / (high - low);
    }
    return OST_SUCCESS;
}

static void find_powers(int monomial, int power[3])
{
    for (power[0] = 0; power[0] <= DEGREE; power[0]++)
        for (power[1] = 0; power[0] + power[1] <= DEGREE; power[1]++)
            for (power[2] = 0; power[0] + power[1] + power[2] <= DEGREE; power[2]++)
                if (monomial-- == 0)
                    return;
}

/* field += share × monomial `which` in one component. */
static void add_field(const Motions *motions, int which, double share, double *field)
{
    const size_t component = (size_t)(which % 3);
    int power[3];
    find_powers(which / 3, power);
    for (size_t i = 0; i < motions->direct->n; i += 3) {
        double value = share;
        for (size_t d = 0; d < 3; d++)
            for (int p = 0; p < power[d]; p++)
                value *= motions->position[i + d];
        field[i + component] += value;
    }
}

/* force = K field, summed in twice the precision. */
static OstStatus apply(const Motions *motions, double *field, double *force)
{
    const size_t n = motions->direct->n;
    memset(force, 0, n * sizeof *force);
    OST_TRY(ost_compensated_residual(motions->direct->system->matrix, force, field, force));
    for (size_t i = 0; i < n; i++)
        force[i] = -force[i];
    return OST_SUCCESS;
}

static OstStatus find_energies(Motions *motions)
{
    const size_t n = motions->direct->n;
    for (int a = 0; a < FIELDS; a++) {
        memset(motions->field, 0, n * sizeof *motions->field);
        add_field(motions, a, 1.0, motions->field);
        OST_TRY(apply(motions, motions->field, motions->force + (size_t)a * n));
    }
    for (int a = 0; a < FIELDS; a++) {
        memset(motions->field, 0, n * sizeof *motions->field);
        add_field(motions, a, 1.0, motions->field);
        for (int b = 0; b < FIELDS; b++) {
            double sum = 0.0;
            for (size_t i = 0; i < n; i++)
                sum += motions->field[i] * motions->force[(size_t)b * n + i];
            motions->energy[FIELDS * a + b] = sum;
        }
    }
    return ost_sum(motions->direct->ctx, FIELDS * FIELDS, motions->energy);
}

/* The eigenvectors of the energies, each field scaled to one of 1. */
static OstStatus find_motions(Motions *motions)
{
    const int n = FIELDS, length = 8 * FIELDS;
    double work[8 * FIELDS];
    int info = 0;
    for (int a = 0; a < FIELDS; a++)
        motions->scale[a] = 1.0 / sqrt(motions->energy[(FIELDS + 1) * a]);
    for (int a = 0; a < FIELDS; a++)
        for (int b = 0; b < FIELDS; b++)
            motions->energy[FIELDS * a + b] *= motions->scale[a] * motions->scale[b];
    dsyev_("V", "U", &n, motions->energy, &n, motions->value, work, &length, &info, 1, 1);
    if (info != 0)
        return OST_RAISE(motions->direct->ctx, OST_LIBRARY_FAILED, "LAPACK's dsyev returned %d", info);
    return OST_SUCCESS;
}

/* The variance of x·Kx as K is rounded; x with its ghosts. */
static double find_variance(const OstBlockMatrix *k, const double *x)
{
    double sum = 0.0, room[9];
    for (OstLocal i = 0; i < k->rows; i++)
        for (OstLocal b = k->row_start[i]; b < k->row_start[i + 1]; b++) {
            const double *block = ost_block_matrix_block(k, i, b, room);
            const double *left = x + 3 * (size_t)i, *right = x + 3 * (size_t)k->column[b];
            for (int r = 0; r < 3; r++)
                for (int c = 0; c < 3; c++) {
                    const double term = 0.5 * DBL_EPSILON * left[r] * block[3 * r + c] * right[c];
                    const int once = k->column[b] == i && r == c; /* others come twice, with one sign */
                    sum += (once ? 1.0 : 2.0) * term * term;
                }
        }
    return sum;
}

/* The energy of a sum of motions, and what rounding changes of it. */
static OstStatus measure(const Motions *motions, const double *share, double *energy, double *rounding)
{
    const size_t n = motions->direct->n;
    double *x = motions->field, *force = motions->force, sums[2] = {0.0};
    memset(x, 0, n * sizeof *x);
    for (int a = 0; a < FIELDS; a++) {
        double whole = 0.0;
        for (int k = 0; k < FIELDS; k++)
            whole += share[k] * motions->energy[FIELDS * k + a];
        add_field(motions, a, motions->scale[a] * whole, x);
    }
    OST_TRY(apply(motions, x, force));
    for (size_t i = 0; i < n; i++)
        sums[0] += x[i] * force[i];
    sums[1] = find_variance(motions->direct->system->matrix, x);
    OST_TRY(ost_sum(motions->direct->ctx, 2, sums));
    *energy = sums[0];
    *rounding = sqrt(sums[1]);
    return OST_SUCCESS;
}

/* The best answer among the polynomials: the motions have no energy in common. */
static OstStatus find_answer(const Motions *motions, double *share)
{
    const size_t n = motions->direct->n;
    double work[FIELDS] = {0.0};
    for (int a = 0; a < FIELDS; a++) {
        memset(motions->field, 0, n * sizeof *motions->field);
        add_field(motions, a, motions->scale[a], motions->field);
        for (size_t i = 0; i < n; i++)
            work[a] += motions->field[i] * motions->direct->f[i];
    }
    OST_TRY(ost_sum(motions->direct->ctx, FIELDS, work));
    for (int k = 0; k < FIELDS; k++) {
        share[k] = 0.0;
        for (int a = 0; a < FIELDS; a++)
            share[k] += motions->energy[FIELDS * k + a] * work[a] / motions->value[k];
    }
    return OST_SUCCESS;
}

static OstStatus find_all(const OstScene *scene, Motions *motions, HardTruth *truth)
{
    double share[FIELDS] = {1.0}, energy, rounding;
    OST_TRY(place_nodes(scene, motions));
    OST_TRY(find_energies(motions));
    OST_TRY(ost_agree(scene->ctx, find_motions(motions)));
    OST_TRY(measure(motions, share, &energy, &rounding));
    truth->indefinite = energy <= 0.0;
    if (truth->indefinite)
        return OST_SUCCESS;
    OST_TRY(find_answer(motions, share));
    OST_TRY(measure(motions, share, &energy, &rounding));
    truth->rounded = rounding / energy;
    return OST_SUCCESS;
}

OstStatus hard_find_softest(const OstScene *scene, HardDirect *direct, HardTruth *truth)
{
    Motions motions = {.direct = direct};
    const size_t n = direct->n;
    OstStatus status = OST_NEW(scene->ctx, &motions.position, n);
    OST_THEN(OST_NEW(scene->ctx, &motions.force, FIELDS * n));
    OST_THEN(OST_NEW(scene->ctx, &motions.field, 3 * (size_t)direct->system->matrix->columns));
    status = ost_agree(scene->ctx, status);
    OST_THEN(find_all(scene, &motions, truth));
    OST_FREE(motions.position, motions.force, motions.field);
    return status;
}
