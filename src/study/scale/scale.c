/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/scale/scale.h"

#include "case/plan.h"
#include "core/error.h"
#include "core/memory.h"

#include <math.h>
#include <stdlib.h>

const char *const ost_scale_state_word[] = {"waiting", "done", "not run", "failed"};

enum { MOST_RANKS = 1 << 20, MOST_REFINEMENTS = 8 };
static const double most_unknowns = 2147483647.0; /* Epetra numbers them with 31 bits */

OstScaleVariants ost_scale_default_variants(int most)
{
    OstScaleVariants variants = {.weak = 1, .max_seconds = 600.0};
    for (int ranks = 1; ranks <= most && variants.rank_count < OST_SCALE_MOST_VALUES; ranks *= 2)
        variants.ranks[variants.rank_count++] = ranks;
    ost_network_parse("infiniband", &variants.network);
    return variants;
}

static OstStatus check_variants(OstContext *ctx, const OstScaleVariants *v)
{
    if (v->rank_count < 1)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "at least one number of ranks is needed");
    for (int i = 0; i < v->rank_count; i++)
        if (v->ranks[i] < 1 || v->ranks[i] > MOST_RANKS)
            return OST_RAISE(ctx, OST_INVALID_INPUT, "a number of ranks is 1 to %d, not %d", MOST_RANKS, v->ranks[i]);
    for (int i = 0; i < v->size_count; i++)
        if (!(v->size[i] >= 100.0 && v->size[i] <= most_unknowns))
            return OST_RAISE(ctx, OST_INVALID_INPUT, "a size is 100 to %.0f unknowns, not %g", most_unknowns,
                             v->size[i]);
    return OST_SUCCESS;
}

/* --- sizes --- */

double ost_scale_unknowns(const OstCase *c)
{
    OstGlobal nodes = 0, tets = 0;
    ost_plan_shape_size(c, &nodes, &tets);
    return 3.0 * (double)nodes;
}

/* The numbers of cells of a shape. */
static int list_divisions(OstCase *c, OstLocal *divisions[3])
{
    switch (c->mesh_kind) {
    case OST_MESH_TUBE:
        divisions[0] = &c->tube.around, divisions[1] = &c->tube.radial, divisions[2] = &c->tube.axial;
        return 3;
    case OST_MESH_SECTOR:
        divisions[0] = &c->sector.around, divisions[1] = &c->sector.radial, divisions[2] = &c->sector.axial;
        return 3;
    case OST_MESH_BLOCK:
        for (int i = 0; i < 3; i++)
            divisions[i] = &c->block.divisions[i];
        return 3;
    case OST_MESH_OCTANT:
        divisions[0] = &c->octant.around, divisions[1] = &c->octant.radial;
        return 2;
    default:
        return 0;
    }
}

/* Labels belong to the mesh that they were read from: refinement keeps them, other divisions do not. */
static int names_vertices(const OstCase *c)
{
    int found = 0;
    for (int i = 0; i < c->constraint_count; i++)
        found |= c->constraints[i].on.kind == OST_SELECT_VERTICES;
    for (int i = 0; i < c->load_count; i++)
        found |= c->loads[i].on.kind == OST_SELECT_VERTICES;
    for (int i = 0; i < c->spring_count; i++)
        found |= c->springs[i].on.kind == OST_SELECT_VERTICES;
    for (int i = 0; i < c->watch_count; i++)
        found |= c->watches[i].on.kind == OST_SELECT_VERTICES;
    return found;
}

static void divide(OstLocal *const *divisions, int count, const OstLocal *own, double factor)
{
    for (int i = 0; i < count; i++) {
        const double cells = fmin(fmax(round(factor * own[i]), own[i] >= 3 ? 3.0 : 1.0), 1e5);
        *divisions[i] = (OstLocal)cells;
    }
}

void ost_scale_resize(OstCase *c, double own, double unknowns)
{
    OstLocal *divisions[3], before[3];
    const int count = names_vertices(c) ? 0 : list_divisions(c, divisions);
    if (count == 0) {
        const int more = (int)lround(log(unknowns / own) / log(8.0));
        c->refinement = c->refinement + more < 0 ? 0 : c->refinement + more;
        c->refinement = c->refinement > MOST_REFINEMENTS ? MOST_REFINEMENTS : c->refinement;
        return;
    }
    for (int i = 0; i < count; i++)
        before[i] = *divisions[i];
    double low = log(1e-4), high = log(1e4), best = 0.0, miss = INFINITY;
    for (int step = 0; step < 60; step++) {
        const double middle = 0.5 * (low + high);
        divide(divisions, count, before, exp(middle));
        const double found = ost_scale_unknowns(c);
        if (fabs(log(found / unknowns)) < miss) {
            miss = fabs(log(found / unknowns));
            best = middle;
        }
        *(found > unknowns ? &high : &low) = middle;
    }
    divide(divisions, count, before, exp(best));
}

/* Reads the counts of a mesh file. */
static OstStatus count_file(const OstCase *c, double *unknowns)
{
    OstMeshChunk *chunk = NULL;
    OstFileMaterials *materials = NULL;
    OST_TRY(ost_case_located(c, c->mesh_place, ost_mesh_file_read(c->ctx, c->mesh_file, &chunk, &materials)));
    OstGlobal nodes = chunk->global_nodes, tets = chunk->global_tets;
    double surface = 0.0;
    const OstStatus status = ost_chunk_surface_faces(chunk, &surface);
    ost_plan_file_size(c, chunk->nodes_per_tet, &nodes, &tets, &surface);
    *unknowns = 3.0 * (double)nodes;
    ost_chunk_destroy(&chunk);
    ost_file_materials_destroy(&materials);
    return status;
}

/* --- the list of runs --- */

/* Few ranks first: many take long where cores are few. */
static int compare_runs(const void *a, const void *b)
{
    const OstScaleRun *x = a, *y = b;
    if (x->ranks != y->ranks)
        return x->ranks - y->ranks;
    return (x->target > y->target) - (x->target < y->target);
}

/* A size on so many ranks is run once, be it for strong or for weak scaling. */
static void add_run(OstScale *scale, double target, int ranks, int weak)
{
    int i = 0;
    while (i < scale->run_count && (scale->run[i].target != target || scale->run[i].ranks != ranks))
        i++;
    if (i == scale->run_count)
        scale->run[scale->run_count++] = (OstScaleRun){.ranks = ranks, .target = target};
    scale->run[i].is_weak |= weak;
    scale->run[i].is_strong |= !weak;
}

static OstStatus list_runs(OstScale *scale)
{
    const OstScaleVariants *v = &scale->variants;
    const int sizes = v->size_count > 0 ? v->size_count : 1;
    OST_TRY(OST_NEW(scale->ctx, &scale->run, (sizes + 1) * v->rank_count));
    for (int r = 0; r < v->rank_count; r++) {
        for (int s = 0; s < sizes; s++)
            add_run(scale, v->size_count > 0 ? v->size[s] : 0.0, v->ranks[r], 0);
        const double first = v->size_count > 0 ? v->size[0] : scale->own_unknowns;
        const double grown = first * v->ranks[r] / v->ranks[0];
        if (v->weak && grown <= most_unknowns)
            add_run(scale, r == 0 && v->size_count == 0 ? 0.0 : grown, v->ranks[r], 1);
    }
    qsort(scale->run, (size_t)scale->run_count, sizeof *scale->run, compare_runs);
    return OST_SUCCESS;
}

static int compare_ranks(const void *a, const void *b)
{
    return *(const int *)a - *(const int *)b;
}

static OstStatus create(const OstCase *c, OstScale *scale)
{
    OST_TRY(ost_copy_string(scale->ctx, c->path, &scale->path));
    OST_TRY(ost_copy_string(scale->ctx, c->title ? c->title : "", &scale->title));
    return list_runs(scale);
}

OstStatus ost_scale_create(const OstCase *c, OstScaleRead read, const void *from, const OstScaleVariants *variants,
                           OstScale **scale)
{
    OstContext *ctx = c->ctx;
    double own = ost_scale_unknowns(c);
    *scale = NULL;
    OST_TRY(check_variants(ctx, variants));
    if (own == 0.0)
        OST_TRY(ost_agree(ctx, count_file(c, &own)));
    OstStatus status = OST_NEW(ctx, scale, 1);
    if (status == OST_SUCCESS) {
        **scale = (OstScale){.ctx = ctx, .read = read, .from = from, .variants = *variants, .own_unknowns = own};
        qsort((*scale)->variants.ranks, (size_t)variants->rank_count, sizeof(int), compare_ranks);
        status = create(c, *scale);
    }
    status = ost_agree(ctx, status);
    if (status != OST_SUCCESS)
        ost_scale_destroy(scale);
    return status;
}

void ost_scale_destroy(OstScale **scale)
{
    if (!*scale)
        return;
    OST_FREE((*scale)->path, (*scale)->title, (*scale)->run);
    OST_FREE(*scale);
}

/* Runs of the same size, or, for weak scaling, the first of the weak ones. */
const OstScaleRun *ost_scale_reference(const OstScale *scale, const OstScaleRun *run, int weak)
{
    const OstScaleRun *found = NULL;
    for (int i = 0; i < scale->run_count; i++) {
        const OstScaleRun *other = &scale->run[i];
        if (other->state != OST_SCALE_DONE || other->crowded || (weak ? !other->is_weak : other->target != run->target))
            continue;
        if (!found || other->ranks < found->ranks)
            found = other;
    }
    return found;
}
