/* SPDX-License-Identifier: BSD-3-Clause */
#include "guard/rigid_motion.h"

#include "assembly/batch.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <float.h>
#include <string.h>

enum { MODES = 6 };

static const char *const mode_word[MODES] = {"a move along x",     "a move along y",     "a move along z",
                                             "a turn about the x", "a turn about the y", "a turn about the z"};

/* A combination of all six modes, in which none is a simple fraction of another. */
static const double every_mode[MODES] = {1.0, -0.786151, 0.618034, 0.881374, -0.567143, 0.915966};

/* The largest relative force that a rigid motion meets, and where. */
typedef struct Resistance {
    double ratio;
    OstLocal at; /* tet or row; -1: none */
} Resistance;

static void take_worse(Resistance *worst, double force, double size, OstLocal at)
{
    const double quotient = force / fmax(size, DBL_MIN);
    const double ratio = isnan(quotient) ? HUGE_VAL : quotient;
    if (ratio <= worst->ratio)
        return;
    worst->ratio = ratio;
    worst->at = at;
}

static double limit(void)
{
    return sqrt(DBL_EPSILON);
}

/* --- tets --- */

/* Node coordinates relative to the mean of the tet's vertices, and the largest distance (the tet's size). */
static void centre_tets(const OstSimd *x, int nodes, OstSimd *arm, OstSimd *size)
{
    OstSimd square = {0};
    for (int a = 0; a < nodes; a++) {
        OstSimd length = {0};
        for (int i = 0; i < 3; i++) {
            arm[3 * a + i] = x[3 * a + i] - 0.25 * (x[i] + x[3 + i] + x[6 + i] + x[9 + i]);
            length += arm[3 * a + i] * arm[3 * a + i];
        }
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
            square[slot] = fmax(square[slot], length[slot]);
    }
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
        (*size)[slot] = sqrt(square[slot]);
}

/* Translations by the tet's size and rotations by 1, so that all modes have equal size. */
static void move_tets(const OstSimd *arm, int nodes, const OstSimd *size, const double share[MODES], OstSimd *u)
{
    for (int a = 0; a < nodes; a++)
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3;
            const int k = (i + 2) % 3;
            u[3 * a + i] = share[i] * *size + share[3 + j] * arm[3 * a + k] - share[3 + k] * arm[3 * a + j];
        }
}

static void sum_sizes(const OstSimd *values, int count, OstSimd *sum)
{
    *sum = (OstSimd){0};
    for (int n = 0; n < count; n++)
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
            (*sum)[slot] += fabs(values[n][slot]);
}

static void try_batch(const OstElement *element, const OstBatch *batch, const double share[MODES], Resistance *worst)
{
    OstSimd arm[3 * OST_MAX_TET_NODES];
    OstSimd u[3 * OST_MAX_TET_NODES];
    OstSimd force[3 * OST_MAX_TET_NODES];
    OstSimd magnitude[3 * OST_MAX_TET_NODES];
    OstSimd size, whole_force, whole_magnitude;
    centre_tets(batch->x, element->nodes, arm, &size);
    move_tets(arm, element->nodes, &size, share, u);
    element->force(batch->x, &batch->elasticity, u, force);
    element->magnitude(batch->x, &batch->elasticity, u, magnitude);
    sum_sizes(force, 3 * element->nodes, &whole_force);
    sum_sizes(magnitude, 3 * element->nodes, &whole_magnitude);
    for (int slot = 0; slot < batch->count; slot++)
        take_worse(worst, whole_force[slot], whole_magnitude[slot], batch->tet[slot]);
}

static Resistance try_tets(const OstMesh *mesh, const OstMaterialField *field, const double share[MODES])
{
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    Resistance worst = {0.0, -1};
    OstBatch batch;
    ost_elasticity_clear(&batch.elasticity);
    for (OstLocal first = 0; first < mesh->owned_tets; first += OST_SIMD_WIDTH) {
        ost_batch_gather_from(&batch, element, mesh, field, first, mesh->owned_tets);
        try_batch(element, &batch, share, &worst);
    }
    return worst;
}

/* Tries the modes one by one, and names the worst. */
static OstStatus raise_tet(const OstMesh *mesh, const OstMaterialField *field, Resistance together)
{
    Resistance worst = {0.0, together.at};
    int at = 0;
    for (int m = 0; m < MODES; m++) {
        double share[MODES] = {0.0};
        share[m] = 1.0;
        const Resistance alone = try_tets(mesh, field, share);
        if (alone.ratio <= worst.ratio)
            continue;
        worst = alone;
        at = m;
    }
    return OST_RAISE(mesh->ctx, OST_CHECK_FAILED,
                     "tet %lld resists %s%s: with %.1e of |K| |motion|, where rounding explains %.1e at most; its "
                     "shape is too extreme for double precision, or the stiffness is computed wrongly",
                     (long long)ost_mesh_tet_number(mesh, worst.at), mode_word[at], at < 3 ? "" : " axis", worst.ratio,
                     limit());
}

OstStatus ost_rigid_motion_of_tets(const OstMesh *mesh, const OstMaterialField *field, double *worst)
{
    OstContext *ctx = mesh->ctx;
    ost_ledger_enter(ctx, OST_LEDGER_CHECKS);
    const Resistance found = try_tets(mesh, field, every_mode);
    *worst = found.ratio;
    OstStatus status = ost_max(ctx, 1, worst);
    if (status == OST_SUCCESS && *worst > limit())
        status = ost_agree(ctx, found.ratio > limit() ? raise_tet(mesh, field, found) : OST_SUCCESS);
    ost_ledger_leave(ctx);
    return status;
}

/* --- rows --- */

typedef struct Rows {
    const OstSystem *system;
    const double *modes;
    unsigned char *supported; /* nodes with a spring, leaders, and nodes of tets with a constrained node or follower */
    double *motion;           /* 3 × columns */
    double span;              /* longest arm of a rotation, over all ranks */
} Rows;

static void mark_supported(const OstSystem *system, unsigned char *supported)
{
    const OstMesh *mesh = system->mesh;
    const size_t n = (size_t)mesh->nodes_per_tet;
    for (OstLocal tet = 0; tet < mesh->tet_count; tet++) {
        const OstLocal *nodes = mesh->tet_nodes + n * (size_t)tet;
        int touched = 0;
        for (size_t a = 0; a < n; a++)
            touched |= system->supports->index[nodes[a]] >= 0 || ost_link_of(system->supports->links, nodes[a]);
        for (size_t a = 0; a < n && touched; a++)
            supported[nodes[a]] = 1;
    }
    for (OstLocal node = 0; node < mesh->owned_nodes && system->supports->links; node++)
        supported[node] |= system->supports->links->leads[node];
    for (OstLocal node = 0; node < mesh->owned_nodes && system->supports->spring; node++)
        for (size_t i = 0; i < 9; i++)
            supported[node] |= system->supports->spring[9 * (size_t)node + i] != 0.0;
}

static OstStatus find_span(Rows *rows)
{
    OstContext *ctx = rows->system->ctx;
    const size_t length = 3 * (size_t)rows->system->matrix->rows;
    rows->span = 0.0;
    for (size_t i = 3 * length; i < MODES * length; i++)
        rows->span = fmax(rows->span, fabs(rows->modes[i]));
    return ost_max(ctx, 1, &rows->span);
}

/* A row's force, and the sum of the sizes of its terms. */
static void add_row(const OstBlockMatrix *matrix, OstLocal row, const double *motion, Resistance *worst)
{
    double force[3] = {0.0};
    double size[3] = {0.0}, room[9];
    for (OstLocal k = matrix->row_start[row]; k < matrix->row_start[row + 1]; k++) {
        const double *block = ost_block_matrix_block(matrix, row, k, room);
        const double *u = motion + 3 * (size_t)matrix->column[k];
        for (int n = 0; n < 9; n++) {
            const double term = block[n] * u[n % 3];
            force[n / 3] += term;
            size[n / 3] += fabs(term);
        }
    }
    take_worse(worst, ost_norm3(force), ost_norm3(size), row);
}

/* Rotations are divided by their span, so that all modes have equal size. */
static OstStatus try_rows(const Rows *rows, const double share[MODES], Resistance *worst)
{
    const OstBlockMatrix *matrix = rows->system->matrix;
    const size_t length = 3 * (size_t)matrix->rows;
    const double turns = 1.0 / fmax(rows->span, DBL_MIN);
    memset(rows->motion, 0, length * sizeof(double));
    for (size_t m = 0; m < MODES; m++)
        for (size_t i = 0; i < length; i++)
            rows->motion[i] += share[m] * (m < 3 ? 1.0 : turns) * rows->modes[m * length + i];
    OST_TRY(ost_halo_import(matrix->halo, 3 * sizeof(double), rows->motion));
    *worst = (Resistance){0.0, -1};
    for (OstLocal row = 0; row < matrix->rows; row++)
        if (!rows->supported[rows->system->node_of_row[row]])
            add_row(matrix, row, rows->motion, worst);
    return OST_SUCCESS;
}

/* Collective. As raise_tet; the worst row may be another rank's. */
static OstStatus raise_row(const Rows *rows, Resistance together)
{
    const OstMesh *mesh = rows->system->mesh;
    Resistance worst = {0.0, together.at};
    int at = 0;
    for (int m = 0; m < MODES; m++) {
        double share[MODES] = {0.0};
        Resistance alone;
        share[m] = 1.0;
        OST_TRY(try_rows(rows, share, &alone));
        if (alone.ratio <= worst.ratio)
            continue;
        worst = alone;
        at = m;
    }
    if (together.ratio <= limit())
        return OST_SUCCESS;
    return OST_RAISE(mesh->ctx, OST_CHECK_FAILED,
                     "the assembled stiffness resists %s%s at vertex %lld: with %.1e of |K| |motion|, where rounding "
                     "explains %.1e at most; multigrid cannot rely on it, and the stiffness, or the rigid modes, are "
                     "computed wrongly",
                     mode_word[at], at < 3 ? "" : " axis",
                     (long long)ost_mesh_node_number(mesh, rows->system->node_of_row[worst.at]), worst.ratio, limit());
}

static OstStatus examine_rows(Rows *rows, double *worst)
{
    OstContext *ctx = rows->system->ctx;
    Resistance found;
    mark_supported(rows->system, rows->supported);
    OST_TRY(find_span(rows));
    OST_TRY(try_rows(rows, every_mode, &found));
    *worst = found.ratio;
    OST_TRY(ost_max(ctx, 1, worst));
    return *worst > limit() ? ost_agree(ctx, raise_row(rows, found)) : OST_SUCCESS;
}

OstStatus ost_rigid_motion_of_rows(const OstSystem *system, const double *modes, double *worst)
{
    OstContext *ctx = system->ctx;
    Rows rows = {.system = system, .modes = modes};
    ost_ledger_enter(ctx, OST_LEDGER_CHECKS);
    OstStatus status = OST_NEW(ctx, &rows.supported, system->mesh->node_count);
    OST_THEN(OST_NEW(ctx, &rows.motion, 3 * (size_t)system->matrix->columns));
    status = ost_agree(ctx, status);
    OST_THEN(examine_rows(&rows, worst));
    OST_FREE(rows.supported);
    OST_FREE(rows.motion);
    ost_ledger_leave(ctx);
    return status;
}
