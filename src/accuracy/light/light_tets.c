/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/light/light_tets.h"

#include "accuracy/complement/blocks.h"
#include "accuracy/light/light_data.h"
#include "accuracy/light/quadratic.h"
#include "assembly/batch.h"
#include "core/error.h"
#include "core/kernel.h"
#include "core/memory.h"
#include "element/strain_batch.h"

#include <math.h>
#include <string.h>

enum { VERTICES = 4, EDGES = 6 };

/* The softest part of a stress must not drown in what single precision loses of the stiffest. */
static const double most_ratio = 1e5;

void ost_light_tets_destroy(OstLightTets **tets)
{
    if (!*tets)
        return;
    OST_FREE((*tets)->eights);
    OST_FREE((*tets)->elastic);
    OST_FREE((*tets)->bend);
    OST_FREE((*tets)->u);
    OST_FREE((*tets)->force);
    OST_FREE(*tets);
}

/* --- what is kept --- */

/* C in material axes, of a mixed form without the stiff mode. */
static const double *stiffness_of(const OstMaterialField *field, int32_t region)
{
    const double *rest = ost_field_is_mixed(field) ? ost_field_rest(field, region) : NULL;
    return rest ? rest : field->material[region].stiffness;
}

double ost_light_tets_modulus(const OstMaterialField *field)
{
    return stiffness_of(field, 0)[0];
}

/* By C's diagonal. */
static int is_fit(const OstMaterialField *field, int32_t region)
{
    const double *c = stiffness_of(field, region);
    double least = INFINITY, most = 0.0;
    for (int p = 0; p < 6; p++) {
        least = fmin(least, c[7 * p]);
        most = fmax(most, c[7 * p]);
    }
    return most < most_ratio * least;
}

/* A batch of the eight. */
static void gather(const OstLightTets *tets, const OstMaterialField *field, size_t first, OstBatch *batch)
{
    const OstLocal last = tets->mesh->tet_count - 1;
    const int nodes = tets->mesh->nodes_per_tet;
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        const OstLocal next = (OstLocal)first + slot, tet = next < last ? next : last;
        batch->tet[slot] = tet;
        memcpy(batch->node[slot], ost_mesh_nodes_of(tets->mesh, tet), (size_t)nodes * sizeof(OstLocal));
    }
    ost_batch_gather_vectors(batch, nodes, tets->mesh->coordinates, batch->x);
    ost_elasticity_gather(&batch->elasticity, field, batch->tet, 0, NULL, NULL);
    if (batch->elasticity.about_line)
        ost_stretch_about_line(&batch->elasticity, batch->x, batch->elasticity.stretch_tensor);
}

/* C that differs within quadratic tets is kept where the line of its axes tells it, and there is no other region. */
static Keeping find_keeping_of_quadratic(const OstLightTets *tets, const OstMaterialField *field)
{
    OstBatch batch;
    int differs = 0;
    if (ost_field_scales_within(field))
        return KEEP_NOT;
    for (int32_t region = 0; region < field->region_count; region++)
        differs |= field->region_varies[region] && ost_field_varies_within(field, region);
    if (!differs)
        return KEEP_EACH;
    if (field->region_count > 1)
        return KEEP_NOT;
    ost_elasticity_clear(&batch.elasticity);
    batch.elasticity.stretch_suffices = 1;
    gather(tets, field, 0, &batch);
    return batch.elasticity.about_line ? KEEP_OFFSETS : KEEP_NOT;
}

static Keeping find_keeping(const OstLightTets *tets, const OstMaterialField *field)
{
    OstBatch batch;
    if (field->region_count == 1 && !field->region_varies[0] && !field->tet_scale)
        return KEEP_ONE;
    if (tets->mesh->nodes_per_tet == 10)
        return find_keeping_of_quadratic(tets, field);
    ost_elasticity_clear(&batch.elasticity);
    batch.elasticity.stretch_suffices = 1;
    const size_t halves = field->region_count == 1 ? 1 : HALVES * tets->count; /* a batch of one region tells of all */
    for (size_t half = 0; half < halves; half++) {
        gather(tets, field, OST_SIMD_WIDTH * half, &batch);
        if (!batch.elasticity.by_stretch)
            return KEEP_EACH;
    }
    return KEEP_STRETCH;
}

static inline void put(const OstSimd *number, double unit, int half, Kept *kept)
{
    const Part over_unit = __builtin_convertvector(*number * (1.0 / unit), Part);
    memcpy((float *)kept + OST_SIMD_WIDTH * half, &over_unit, sizeof over_unit);
}

/* How far the vertices are from the line. */
static void keep_offsets(const OstLightTets *tets, const OstBatch *batch, int half, Kept *kept)
{
    const OstElasticity *elasticity = &batch->elasticity;
    for (int v = 0; v < VERTICES; v++) {
        OstSimd d[3], height = {0};
        for (int i = 0; i < 3; i++) {
            d[i] = batch->x[3 * v + i] - 0.25 * elasticity->origin[i];
            height += d[i] * elasticity->axis[i];
        }
        for (int i = 0; i < 3; i++) {
            d[i] -= height * elasticity->axis[i];
            put(&d[i], tets->length, half, &kept[3 * v + i]);
        }
    }
}

static void keep_elasticity(const OstLightTets *tets, const OstBatch *batch, int half, Kept *kept)
{
    const OstElasticity *elasticity = &batch->elasticity;
    const OstSimd shear = (OstSimd){0} + elasticity->shear;
    if (tets->keeping == KEEP_OFFSETS) {
        keep_offsets(tets, batch, half, kept);
        return;
    }
    if (tets->keeping == KEEP_STRETCH) {
        for (int p = 0; p < 6; p++)
            put(&elasticity->stretch_tensor[p], sqrt(tets->modulus), half, &kept[p]);
        put(&shear, 1.0, half, &kept[6]);
        return;
    }
    for (int n = 0; n < OST_ELASTICITY_COUNT; n++)
        put(&elasticity->c[0][n], tets->modulus, half, &kept[n]);
}

static void keep_bend(const OstLightTets *tets, const OstSimd *x, int half, Kept *kept)
{
    for (int e = 0; e < EDGES; e++)
        for (int i = 0; i < 3; i++) {
            const OstSimd bend =
                x[3 * (4 + e) + i] - 0.5 * (x[3 * ost_tet_edge[e][0] + i] + x[3 * ost_tet_edge[e][1] + i]);
            put(&bend, tets->length, half, &kept[3 * e + i]);
        }
}

static void keep_line(OstLightTets *tets, const OstElasticity *elasticity)
{
    const double unit = sqrt(tets->modulus);
    for (int p = 0; p < 6; p++)
        tets->line.about_axis[p] = (float)(elasticity->about_axis[p][0] / unit);
    tets->line.radial = (float)(elasticity->radial[0] / unit);
    tets->line.shear = (float)elasticity->shear;
}

static void keep(OstLightTets *tets, const OstMaterialField *field)
{
    const double unit_of_volume = tets->length * tets->length * tets->length;
    OstBatch batch;
    ost_elasticity_clear(&batch.elasticity);
    batch.elasticity.stretch_suffices = tets->keeping == KEEP_STRETCH || tets->keeping == KEEP_OFFSETS;
    for (size_t half = 0; half < HALVES * tets->count; half++) {
        const size_t first = OST_SIMD_WIDTH * half, k = half / HALVES;
        const int place = (int)(half % HALVES);
        Eights *eights = &tets->eights[k];
        OstPoint point;
        gather(tets, field, first, &batch);
        ost_element_of(VERTICES)->evaluate(batch.x, &ost_tet_degree1.point[0], &point);
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            eights->tet[OST_SIMD_WIDTH * place + slot] = batch.tet[slot];
            if (first + (size_t)slot >= (size_t)tets->mesh->tet_count)
                point.volume[slot] = 0.0;
        }
        for (int n = 0; n < 9; n++)
            put(&point.gradient[1 + n / 3][n % 3], 1.0 / tets->length, place, &eights->gradient[n / 3][n % 3]);
        put(&point.volume, unit_of_volume, place, &eights->volume);
        if (tets->keeping != KEEP_ONE || k == 0)
            keep_elasticity(tets, &batch, place, tets->elastic + numbers_kept[tets->keeping] * k);
        if (tets->bend)
            keep_bend(tets, batch.x, place, tets->bend + BENDS * k);
    }
    if (tets->keeping == KEEP_OFFSETS)
        keep_line(tets, &batch.elasticity);
}

static OstStatus fill(OstLightTets *tets, const OstMaterialField *field)
{
    const OstMesh *mesh = tets->mesh;
    OstContext *ctx = mesh->ctx;
    const size_t numbers = tets->keeping == KEEP_ONE ? OST_ELASTICITY_COUNT : numbers_kept[tets->keeping] * tets->count;
    OST_TRY(OST_NEW(ctx, &tets->eights, tets->count));
    OST_TRY(OST_NEW(ctx, &tets->elastic, numbers));
    if (mesh->nodes_per_tet == 10)
        OST_TRY(OST_NEW(ctx, &tets->bend, BENDS * tets->count));
    OST_TRY(OST_NEW(ctx, &tets->u, 4 * (size_t)mesh->node_count));
    OST_TRY(OST_NEW(ctx, &tets->force, 4 * (size_t)mesh->node_count));
    keep(tets, field);
    return OST_SUCCESS;
}

OstStatus ost_light_tets_create(const OstProblem *problem, const OstComplement *complement, double unit,
                                OstLightTets **tets)
{
    const OstMesh *mesh = problem->mesh;
    *tets = NULL;
    if (!ost_problem_is_linear(problem) || (mesh->nodes_per_tet == 10 && problem->field->form == OST_SPLIT_MEAN))
        return OST_SUCCESS;
    for (int32_t region = 0; region < problem->field->region_count; region++)
        if (!is_fit(problem->field, region))
            return OST_SUCCESS;
    OST_TRY(OST_NEW(problem->ctx, tets, 1));
    (*tets)->mesh = mesh;
    (*tets)->complement = complement;
    (*tets)->modulus = ost_light_tets_modulus(problem->field);
    (*tets)->length = unit / (*tets)->modulus;
    (*tets)->count = ((size_t)mesh->tet_count + WIDTH - 1) / WIDTH;
    (*tets)->keeping = find_keeping(*tets, problem->field);
    const OstStatus status = (*tets)->keeping == KEEP_NOT ? OST_SUCCESS : fill(*tets, problem->field);
    if (status != OST_SUCCESS || (*tets)->keeping == KEEP_NOT)
        ost_light_tets_destroy(tets);
    return status;
}

/* --- reading and adding --- */

/* Of vertices 1 to 3 how they move from vertex 0. (In double precision: a rotation of the whole body is large.) */
static inline void read_nodes(const OstLightTets *tets, const Eights *eights, Eight moved[VERTICES - 1][3])
{
    Four row[VERTICES - 1][WIDTH];
    for (int slot = 0; slot < WIDTH; slot++) {
        const OstLocal *nodes = ost_mesh_nodes_of(tets->mesh, eights->tet[slot]);
        const Wide base = *(const Wide *)(tets->u + 4 * (size_t)nodes[0]);
        for (int v = 1; v < VERTICES; v++) {
            const Wide there = *(const Wide *)(tets->u + 4 * (size_t)nodes[v]);
            row[v - 1][slot] = __builtin_convertvector(there - base, Four);
        }
    }
    for (int v = 0; v < VERTICES - 1; v++)
        transpose(row[v], moved[v]);
}

static inline void read_functions(const OstLightTets *tets, const Eights *eights, const float *values,
                                  Eight w[EDGES][3])
{
    for (int e = 0; e < EDGES; e++) {
        Four row[WIDTH];
        for (int slot = 0; slot < WIDTH; slot++)
            row[slot] = *(const Four *)(values + OST_PER_FUNCTION * (size_t)function_of(tets, eights, slot, e));
        transpose(row, w[e]);
    }
}

static inline void add_to_nodes(OstLightTets *tets, const Eights *eights, Eight at_nodes[VERTICES - 1][3])
{
    Four row[VERTICES - 1][WIDTH];
    for (int v = 0; v < VERTICES - 1; v++)
        transpose_back(at_nodes[v], row[v]);
    for (int slot = 0; slot < WIDTH; slot++) {
        const OstLocal *nodes = ost_mesh_nodes_of(tets->mesh, eights->tet[slot]);
        Wide sum = {0.0};
        for (int v = 1; v < VERTICES; v++) {
            const Wide force = __builtin_convertvector(row[v - 1][slot], Wide);
            *(Wide *)(tets->force + 4 * (size_t)nodes[v]) += force;
            sum += force;
        }
        *(Wide *)(tets->force + 4 * (size_t)nodes[0]) -= sum;
    }
}

static inline void add_to_functions(const OstLightTets *tets, const Eights *eights, Eight at_functions[EDGES][3],
                                    float *of_functions)
{
    for (int e = 0; e < EDGES; e++) {
        Four row[WIDTH];
        transpose_back(at_functions[e], row);
        for (int slot = 0; slot < WIDTH; slot++)
            *(Four *)(of_functions + OST_PER_FUNCTION * (size_t)function_of(tets, eights, slot, e)) += row[slot];
    }
}

/* --- forces of eight tets --- */

/* slope += v g' */
static inline void add_slope(const Eight v[3], const Eight g[3], Eight slope[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            slope[3 * i + j] += v[i] * g[j];
}

static inline void find_stress(const Linear *tet, const Eight slope[9], Eight stress[6])
{
    static const int place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    const Kept *a = tet->elastic;
    if (!tet->by_stretch) {
        Eight strain[6];
        for (int i = 0; i < 3; i++) {
            const int next = (i + 1) % 3;
            strain[i] = slope[4 * i];
            strain[3 + i] = slope[3 * i + next] + slope[3 * next + i];
        }
        for (int p = 0; p < 6; p++) {
            stress[p] = a[ost_upper[p][0]] * strain[0];
            for (int q = 1; q < 6; q++)
                stress[p] += a[ost_upper[p][q]] * strain[q];
        }
        return;
    }
    Eight half[9];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            half[3 * i + j] = a[place[i][0]] * slope[j] + a[place[i][1]] * slope[3 + j] + a[place[i][2]] * slope[6 + j];
    const Eight shear = a[6], bulk = (1.0F - 2.0F * shear) * (slope[0] + slope[4] + slope[8]);
    for (int p = 0; p < 6; p++) {
        const int i = p % 3, j = p < 3 ? i : (i + 1) % 3;
        stress[p] = bulk * a[p] + shear * (half[3 * i + j] + half[3 * j + i]);
    }
}

/* force += stress g */
static inline void add_force(const Eight g[3], const Eight stress[6], Eight force[3])
{
    force[0] += g[0] * stress[0] + g[1] * stress[3] + g[2] * stress[5];
    force[1] += g[0] * stress[3] + g[1] * stress[1] + g[2] * stress[4];
    force[2] += g[0] * stress[5] + g[1] * stress[4] + g[2] * stress[2];
}

/* The stress is linear. With a quarter of the slopes, as a function is 4 L_a L_b; products of two coordinates have the
 * mean 1/10 or 1/20. */
static inline void find_forces(const Linear *tet, Eight moved[VERTICES - 1][3], Eight w[EDGES][3],
                               Eight at_nodes[VERTICES - 1][3], Eight at_functions[EDGES][3])
{
    Eight at_vertex[VERTICES][9], stress[VERTICES][6], sum[6], slope[9] = {{0.0F}};
    for (int v = 1; v < VERTICES; v++)
        add_slope(moved[v - 1], tet->along[v], slope);
    for (int v = 0; v < VERTICES; v++)
        for (int n = 0; n < 9; n++)
            at_vertex[v][n] = 0.25F * slope[n];
    for (int e = 0; e < EDGES; e++) {
        const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
        add_slope(w[e], tet->along[b], at_vertex[a]);
        add_slope(w[e], tet->along[a], at_vertex[b]);
    }
    const Eight weight = 0.8F * tet->volume; /* 4 × 4 / 20 */
    for (int v = 0; v < VERTICES; v++)
        find_stress(tet, at_vertex[v], stress[v]);
    for (int p = 0; p < 6; p++) {
        for (int v = 0; v < VERTICES; v++)
            stress[v][p] *= weight;
        sum[p] = stress[0][p] + stress[1][p] + stress[2][p] + stress[3][p];
        for (int v = 0; v < VERTICES; v++)
            stress[v][p] += sum[p];
        sum[p] *= 1.25F;
    }
    memset(at_nodes, 0, (VERTICES - 1) * sizeof *at_nodes);
    memset(at_functions, 0, EDGES * sizeof *at_functions);
    for (int v = 1; v < VERTICES; v++)
        add_force(tet->gradient[v], sum, at_nodes[v - 1]);
    for (int e = 0; e < EDGES; e++) {
        const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
        add_force(tet->gradient[b], stress[a], at_functions[e]);
        add_force(tet->gradient[a], stress[b], at_functions[e]);
    }
}

/* --- all tets --- */

static void take(OstLightTets *tets, const double *u)
{
    for (size_t n = 0; n < (size_t)tets->mesh->node_count; n++)
        for (size_t i = 0; i < 3; i++)
            tets->u[4 * n + i] = u[3 * n + i];
}

static inline void find_eight(const OstLightTets *tets, size_t k, const float *functions, int by_stretch,
                              Eight moved[VERTICES - 1][3], Eight w[EDGES][3], Eight at_nodes[VERTICES - 1][3],
                              Eight at_functions[EDGES][3])
{
    const Eights *eights = &tets->eights[k];
    Linear tet;
    open_linear(eights, tets->elastic + numbers_kept[tets->keeping] * k, by_stretch, &tet);
    read_nodes(tets, eights, moved);
    read_functions(tets, eights, functions, w);
    find_forces(&tet, moved, w, at_nodes, at_functions);
}

OST_KERNEL static void apply_eights(OstLightTets *tets, const float *functions, float *of_functions)
{
    Eight moved[VERTICES - 1][3], w[EDGES][3], at_nodes[VERTICES - 1][3], at_functions[EDGES][3];
    for (size_t k = 0; k < tets->count; k++) {
        if (tets->keeping == KEEP_STRETCH)
            find_eight(tets, k, functions, 1, moved, w, at_nodes, at_functions);
        else
            find_eight(tets, k, functions, 0, moved, w, at_nodes, at_functions);
        add_to_nodes(tets, &tets->eights[k], at_nodes);
        add_to_functions(tets, &tets->eights[k], at_functions, of_functions);
    }
}

void ost_light_tets_apply(OstLightTets *tets, const double *u, const float *w, double *force, float *of_functions)
{
    take(tets, u);
    memset(tets->force, 0, 4 * (size_t)tets->mesh->node_count * sizeof *tets->force);
    memset(of_functions, 0, OST_PER_FUNCTION * (size_t)tets->complement->count * sizeof *of_functions);
    if (tets->mesh->nodes_per_tet == 10)
        ost_quadratic_eights_apply(tets, w, of_functions);
    else
        apply_eights(tets, w, of_functions);
    for (size_t n = 0; n < (size_t)tets->mesh->owned_nodes; n++)
        for (size_t i = 0; i < 3; i++)
            force[3 * n + i] = tets->force[4 * n + i];
}

OST_KERNEL static void find_energies(const OstLightTets *tets, const float *functions, double *energy)
{
    Eight moved[VERTICES - 1][3], w[EDGES][3], at_nodes[VERTICES - 1][3], at_functions[EDGES][3];
    const OstLocal owned = tets->mesh->owned_tets;
    for (size_t k = 0; k < tets->count; k++) {
        const Eights *eights = &tets->eights[k];
        Eight sum = {0.0F};
        find_eight(tets, k, functions, tets->keeping == KEEP_STRETCH, moved, w, at_nodes, at_functions);
        for (int n = 0; n < 3 * (VERTICES - 1); n++)
            sum += moved[n / 3][n % 3] * at_nodes[n / 3][n % 3];
        for (int n = 0; n < 3 * EDGES; n++)
            sum += w[n / 3][n % 3] * at_functions[n / 3][n % 3];
        for (int slot = 0; slot < WIDTH; slot++)
            if (eights->volume[slot] != 0.0F && eights->tet[slot] < owned)
                energy[eights->tet[slot]] = (double)sum[slot];
    }
}

void ost_light_tets_energy(OstLightTets *tets, const double *u, const float *w, double *energy)
{
    take(tets, u);
    if (tets->mesh->nodes_per_tet == 10)
        ost_quadratic_eights_energy(tets, w, energy);
    else
        find_energies(tets, w, energy);
}

/* --- the functions' own blocks --- */

/* Entry ij of B'C B for a gradient g is the sum of factor[ij][kl] g_k g_l, with ij and kl as 11 22 33 12 23 31. */
typedef struct Squares {
    Eight factor[6][6];
} Squares;

static inline void find_squares(const Kept *c, Squares *squares)
{
    static const int voigt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    for (int ij = 0; ij < 6; ij++)
        for (int kl = 0; kl < 6; kl++) {
            const int i = ij % 3, j = ij < 3 ? i : (i + 1) % 3, k = kl % 3, l = kl < 3 ? k : (k + 1) % 3;
            squares->factor[ij][kl] = c[ost_upper[voigt[i][k]][voigt[j][l]]];
            if (k != l)
                squares->factor[ij][kl] += c[ost_upper[voigt[i][l]][voigt[j][k]]];
        }
}

/* B'C B for the gradient g (11 22 33 12 23 31). */
static inline void find_block(const Linear *tet, const Squares *squares, const Eight g[3], const Eight along[3],
                              Eight block[6])
{
    const Kept *a = tet->elastic;
    Eight product[6];
    for (int p = 0; p < 6; p++)
        product[p] = g[p % 3] * g[p < 3 ? p : (p + 1) % 3];
    if (tet->by_stretch) {
        const Eight shear = a[6], size = shear * (g[0] * along[0] + g[1] * along[1] + g[2] * along[2]);
        for (int p = 0; p < 6; p++)
            block[p] = (1.0F - shear) * along[p % 3] * along[p < 3 ? p : (p + 1) % 3] + size * a[p];
        return;
    }
    for (int p = 0; p < 6; p++) {
        block[p] = squares->factor[p][0] * product[0];
        for (int q = 1; q < 6; q++)
            block[p] += squares->factor[p][q] * product[q];
    }
}

/* Adds a block to that of function k. */
static inline void add_to_block(const OstLightTets *tets, const Eights *eights, int k, Eight block[6], float *blocks)
{
    for (int half = 0; half < 2; half++) {
        Four row[WIDTH];
        transpose_back(block + 3 * half, row);
        for (int slot = 0; slot < WIDTH; slot++)
            *(Four *)(blocks + OST_PER_BLOCK * (size_t)function_of(tets, eights, slot, k) + 4 * half) += row[slot];
    }
}

/* The block of a function of an edge is volume × `own` times the sum of those of L_a and L_b and `both` times that of
 * L_a + L_b; the last is that of the opposite edge, too, as all gradients add up to zero. That of a face, therefore, is
 * the same on all four: volume × `face` times the sum of all vertices'. */
typedef struct Parts {
    float own, both, face;
} Parts;
static const Parts parts_of_linear = {0.8F, 1.0F, 0.0F},
                   parts_of_quadratic = {768.0F / 840.0F, 1.0F / 3.0F, 1458.0F / 840.0F};

static inline void add_blocks(const OstLightTets *tets, const Eights *eights, const Linear *tet, const Squares *squares,
                              const Parts *parts, float *blocks)
{
    Eight own[VERTICES][6], of_sum[3][6];
    for (int v = 0; v < VERTICES; v++)
        find_block(tet, squares, tet->gradient[v], tet->along[v], own[v]);
    for (int v = 1; v < VERTICES; v++) {
        Eight g[3], along[3];
        for (int i = 0; i < 3; i++) {
            g[i] = tet->gradient[0][i] + tet->gradient[v][i];
            along[i] = tet->along[0][i] + tet->along[v][i];
        }
        find_block(tet, squares, g, along, of_sum[v - 1]);
    }
    const Eight weight = parts->own * tet->volume;
    for (int e = 0; e < EDGES; e++) {
        const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
        const int with0 = a == 0 ? b : b == 0 ? a : 6 - a - b; /* the pair with vertex 0: this one, or its opposite */
        Eight block[6];
        for (int p = 0; p < 6; p++)
            block[p] = weight * (own[a][p] + own[b][p] + parts->both * of_sum[with0 - 1][p]);
        add_to_block(tets, eights, e, block, blocks);
    }
    if (parts->face == 0.0F)
        return;
    for (int p = 0; p < 6; p++)
        own[0][p] = parts->face * tet->volume * (own[0][p] + own[1][p] + own[2][p] + own[3][p]);
    for (int f = 0; f < 4; f++)
        add_to_block(tets, eights, EDGES + f, own[0], blocks);
}

/* About a line, C is that at the centroid: this only preconditions. */
static inline void find_stretch(const OstLightTets *tets, const Kept *offset, Kept stretch[7])
{
    Eight tensor[6];
    find_stretch_at(&tets->line, offset, ost_tet_degree1.point[0].at, tensor);
    for (int p = 0; p < 6; p++)
        stretch[p] = tensor[p];
    stretch[6] = (Eight){0.0F} + tets->line.shear;
}

OST_KERNEL static void add_all_blocks(const OstLightTets *tets, float *blocks)
{
    const Parts *parts = tets->mesh->nodes_per_tet == 10 ? &parts_of_quadratic : &parts_of_linear;
    const int by_stretch = tets->keeping == KEEP_STRETCH || tets->keeping == KEEP_OFFSETS;
    Squares squares = {{{{0.0F}}}};
    if (tets->keeping == KEEP_ONE)
        find_squares(tets->elastic, &squares);
    for (size_t k = 0; k < tets->count; k++) {
        const Kept *elastic = tets->elastic + numbers_kept[tets->keeping] * k;
        Kept stretch[7];
        Linear tet;
        if (tets->keeping == KEEP_EACH)
            find_squares(elastic, &squares);
        if (tets->keeping == KEEP_OFFSETS)
            find_stretch(tets, elastic, stretch);
        open_linear(&tets->eights[k], tets->keeping == KEEP_OFFSETS ? stretch : elastic, by_stretch, &tet);
        add_blocks(tets, &tets->eights[k], &tet, &squares, parts, blocks);
    }
}

void ost_light_tets_blocks(const OstLightTets *tets, float *factor)
{
    memset(factor, 0, OST_PER_BLOCK * (size_t)tets->complement->count * sizeof *factor);
    add_all_blocks(tets, factor);
    ost_blocks_factor(tets->complement, factor);
}
