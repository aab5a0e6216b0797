/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/light/light_tets.h"

#include "accuracy/complement/blocks.h"
#include "accuracy/light/light_data.h"
#include "accuracy/light/pairs.h"
#include "accuracy/light/quadratic.h"
#include "assembly/batch.h"
#include "core/error.h"
#include "core/kernel.h"
#include "core/memory.h"
#include "core/together/together.h"
#include "element/strain_batch.h"

#include <math.h>
#include <string.h>

typedef Eight Number;
#define FROM(kept) (kept)
#include "accuracy/light/linear_kernel.h"

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
    OST_FREE((*tets)->second);
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

/* --- all tets --- */

/* Four numbers at a time, of which the last is the next node's, or is written again. */
typedef double AnyWide __attribute__((vector_size(4 * sizeof(double)), aligned(sizeof(double)), may_alias));

static void pad(const OstLightTets *tets, const double *u, double *padded)
{
    const size_t nodes = (size_t)tets->mesh->node_count;
    if (!u)
        memset(padded, 0, 4 * nodes * sizeof *padded);
    for (size_t n = 0; u && n + 1 < nodes; n++)
        *(AnyWide *)(padded + 4 * n) = *(const AnyWide *)(u + 3 * n);
    if (u && nodes > 0)
        memcpy(padded + 4 * (nodes - 1), u + 3 * (nodes - 1), 3 * sizeof *u);
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

/* As ost_light_tets_apply, or, with an energy, as ost_light_tets_energy. */
typedef struct Product {
    const double *u;
    const float *w;
    double *force;
    float *of_functions;
    double *energy;
} Product;

static void open_product(const OstLightTets *tets, const Product *product, double *force)
{
    if (product->energy)
        return;
    memset(force, 0, 4 * (size_t)tets->mesh->node_count * sizeof *force);
    memset(product->of_functions, 0,
           OST_PER_FUNCTION * (size_t)tets->complement->count * sizeof *product->of_functions);
}

static void close_product(const OstLightTets *tets, const double *force, const Product *product)
{
    const size_t nodes = product->energy ? 0 : (size_t)tets->mesh->owned_nodes;
    for (size_t n = 0; n + 1 < nodes; n++)
        *(AnyWide *)(product->force + 3 * n) = *(const AnyWide *)(force + 4 * n);
    if (nodes > 0)
        memcpy(product->force + 3 * (nodes - 1), force + 4 * (nodes - 1), 3 * sizeof *force);
}

static void find_one(OstLightTets *tets, const Product *product)
{
    const int is_quadratic = tets->mesh->nodes_per_tet == 10;
    pad(tets, product->u, tets->u);
    open_product(tets, product, tets->force);
    if (product->energy)
        (is_quadratic ? ost_quadratic_eights_energy : find_energies)(tets, product->w, product->energy);
    else
        (is_quadratic ? ost_quadratic_eights_apply : apply_eights)(tets, product->w, product->of_functions);
    close_product(tets, tets->force, product);
}

static void find_pair(OstLightTets *tets, void *const *product)
{
    const int is_quadratic = tets->mesh->nodes_per_tet == 10;
    const size_t numbers = 4 * (size_t)tets->mesh->node_count;
    double *const u[PAIR] = {tets->u, tets->second}, *const force[PAIR] = {tets->force, tets->second + numbers};
    Pair pair = {.at_rest = 1};
    for (int k = 0; k < PAIR; k++)
        pair.at_rest &= !((const Product *)product[k])->u;
    for (int k = 0; k < PAIR; k++) {
        const Product *one = product[k];
        if (!pair.at_rest)
            pad(tets, one->u, u[k]);
        open_product(tets, one, force[k]);
        pair.u[k] = u[k];
        pair.w[k] = one->w;
        pair.force[k] = force[k];
        pair.of_functions[k] = one->of_functions;
        pair.energy[k] = one->energy;
    }
    if (pair.energy[0])
        (is_quadratic ? ost_quadratic_pairs_energy : ost_linear_pairs_energy)(tets, &pair);
    else
        (is_quadratic ? ost_quadratic_pairs_apply : ost_linear_pairs_apply)(tets, &pair);
    for (int k = 0; k < PAIR; k++)
        close_product(tets, force[k], product[k]);
}

/* Two by two where that pays, and where there is room for it. */
static OstStatus find_all(OstLightTets *tets, int count, void *const *product)
{
    if (BY_PAIRS && count > 1 && !tets->second)
        (void)OST_NEW(tets->mesh->ctx, &tets->second, 8 * (size_t)tets->mesh->node_count);
    int k = 0;
    for (; k + PAIR <= count && tets->second; k += PAIR)
        find_pair(tets, product + k);
    for (; k < count; k++)
        find_one(tets, product[k]);
    return OST_SUCCESS;
}

/* OstServe. */
static OstStatus apply_all(void *tets, int count, void *const *product)
{
    return find_all(tets, count, product);
}

static OstStatus find_all_energies(void *tets, int count, void *const *product)
{
    return find_all(tets, count, product);
}

void ost_light_tets_apply(OstLightTets *tets, const double *u, const float *w, double *force, float *of_functions)
{
    Product product = {.u = u, .w = w, .force = force, .of_functions = of_functions};
    (void)ost_together(tets->mesh->ctx, apply_all, OST_MOST_TOGETHER, tets, &product);
}

void ost_light_tets_energy(OstLightTets *tets, const double *u, const float *w, double *energy)
{
    Product product = {.u = u, .w = w, .energy = energy};
    (void)ost_together(tets->mesh->ctx, find_all_energies, OST_MOST_TOGETHER, tets, &product);
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
