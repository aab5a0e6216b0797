/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/saddle/parts.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/gather.h"
#include "core/parallel/numbering.h"
#include "core/parallel/reduce.h"

#include <stdlib.h>
#include <string.h>

/* What a rank, or all, know of a part. */
typedef struct Part {
    OstGlobal label; /* the smallest number of its pressures */
    double mass, loose, held;
} Part;

typedef struct Finder {
    const OstBlockMatrix *matrix;
    const OstCoupling *coupling;
    OstLocal *set;    /* columns: the first pressure of its set on this rank */
    OstGlobal *label; /* columns */
    OstLocal *order;  /* columns, by sets */
    double *force;    /* 3 × unknowns, 0 between uses */
    Part *part;       /* of this rank's sets */
    OstLocal count;
} Finder;

void ost_pressure_parts_clear(OstPressureParts *parts)
{
    OST_FREE(parts->of_pressure);
    OST_FREE(parts->mass);
    OST_FREE(parts->loose);
    *parts = (OstPressureParts){0};
}

static OstLocal first_of(OstLocal *set, OstLocal i)
{
    while (set[i] != i)
        i = set[i] = set[set[i]];
    return i;
}

static void find_sets(Finder *finder)
{
    const OstCoupling *coupling = finder->coupling;
    for (OstLocal i = 0; i < coupling->columns; i++)
        finder->set[i] = i;
    for (OstLocal i = 0; i < coupling->rows; i++)
        for (OstLocal k = coupling->mass_start[i]; k < coupling->mass_start[i + 1]; k++) {
            const OstLocal a = first_of(finder->set, i), b = first_of(finder->set, coupling->mass_column[k]);
            finder->set[a > b ? a : b] = a > b ? b : a;
        }
    for (OstLocal i = 0; i < coupling->columns; i++)
        finder->set[i] = first_of(finder->set, i);
}

/* Sets that touch on other ranks take the smaller label, until none changes. */
static OstStatus label_sets(Finder *finder)
{
    const OstCoupling *coupling = finder->coupling;
    OstGlobal first, all;
    int changed = 1;
    OST_TRY(ost_number_from(coupling->ctx, coupling->rows, &first, &all));
    for (OstLocal i = 0; i < coupling->rows; i++)
        finder->label[i] = first + i;
    OST_TRY(ost_halo_import(coupling->halo, sizeof *finder->label, finder->label));
    while (changed) {
        changed = 0;
        for (OstLocal i = 0; i < coupling->columns; i++)
            if (finder->label[i] < finder->label[finder->set[i]])
                finder->label[finder->set[i]] = finder->label[i];
        for (OstLocal i = 0; i < coupling->columns; i++) {
            changed |= finder->label[i] != finder->label[finder->set[i]];
            finder->label[i] = finder->label[finder->set[i]];
        }
        OST_TRY(ost_halo_import(coupling->halo, sizeof *finder->label, finder->label));
        OST_TRY(ost_max_ints(coupling->ctx, 1, &changed));
    }
    return OST_SUCCESS;
}

static void add_row(Finder *finder, OstLocal i, Part *part)
{
    const OstCoupling *coupling = finder->coupling;
    for (OstLocal k = coupling->row_start[i]; k < coupling->row_start[i + 1]; k++)
        for (int c = 0; c < 3 && coupling->column[k] < coupling->unknowns; c++)
            finder->force[3 * (size_t)coupling->column[k] + (size_t)c] += coupling->value[3 * (size_t)k + (size_t)c];
    for (OstLocal k = i < coupling->rows ? coupling->mass_start[i] : 0;
         i < coupling->rows && k < coupling->mass_start[i + 1]; k++) {
        part->mass += coupling->schur[i] * coupling->estimate[k];
        part->loose += coupling->looseness[i] * coupling->mass[k];
    }
}

/* Adds what the diagonal of A makes of the force, which is then 0 again. */
static void take_force(Finder *finder, OstLocal i, Part *part)
{
    const OstCoupling *coupling = finder->coupling;
    for (OstLocal k = coupling->row_start[i]; k < coupling->row_start[i + 1]; k++) {
        if (coupling->column[k] >= coupling->unknowns)
            continue;
        const double *block = ost_block_matrix_diagonal(finder->matrix, coupling->column[k]);
        double *force = finder->force + 3 * (size_t)coupling->column[k];
        for (int c = 0; c < 3; c++) {
            if (block[4 * c] > 0.0)
                part->held += force[c] * force[c] / block[4 * c];
            force[c] = 0.0;
        }
    }
}

/* Pressures in the order of their sets, and what is known of each set. */
static OstStatus measure(Finder *finder)
{
    const OstCoupling *coupling = finder->coupling;
    const OstLocal columns = coupling->columns;
    OstLocal *start = NULL;
    OST_TRY(OST_NEW(coupling->ctx, &start, columns + 1));
    for (OstLocal i = 0; i < columns; i++)
        start[finder->set[i] + 1]++;
    for (OstLocal i = 0; i < columns; i++) {
        finder->count += start[i + 1] > 0;
        start[i + 1] += start[i];
    }
    for (OstLocal i = columns; i-- > 0;) /* filled from the back: a set begins at start[set + 1] in the end */
        finder->order[--start[finder->set[i] + 1]] = i;
    const OstStatus status = OST_NEW(coupling->ctx, &finder->part, finder->count);
    OST_FREE(start);
    OST_TRY(status);
    Part *part = finder->part - 1;
    for (OstLocal begin = 0, end = 0; begin < columns; begin = end) {
        const OstLocal set = finder->set[finder->order[begin]];
        *++part = (Part){.label = finder->label[set]};
        for (end = begin; end < columns && finder->set[finder->order[end]] == set; end++)
            add_row(finder, finder->order[end], part);
        for (OstLocal k = begin; k < end; k++)
            take_force(finder, finder->order[k], part);
    }
    return OST_SUCCESS;
}

static int by_label(const void *a, const void *b)
{
    const Part *x = a, *y = b;
    return (x->label > y->label) - (x->label < y->label);
}

static double share_of(const Part *part)
{
    return (part->held + part->loose) / part->mass;
}

static int by_share(const void *a, const void *b)
{
    const double x = share_of(a), y = share_of(b);
    return x != y ? (x > y) - (x < y) : by_label(a, b);
}

/* All ranks' parts, each once; then the soft ones alone, by labels. Returns how many. */
static OstLocal choose(Part *part, OstLocal total, double soft, int most)
{
    OstLocal count = 0, chosen = 0;
    qsort(part, (size_t)total, sizeof *part, by_label);
    for (OstLocal i = 0; i < total; i++)
        if (count > 0 && part[count - 1].label == part[i].label) {
            part[count - 1].mass += part[i].mass;
            part[count - 1].loose += part[i].loose;
            part[count - 1].held += part[i].held;
        } else
            part[count++] = part[i];
    qsort(part, (size_t)count, sizeof *part, by_share);
    while (chosen < count && chosen < most && share_of(&part[chosen]) < soft)
        chosen++;
    qsort(part, (size_t)chosen, sizeof *part, by_label);
    return chosen;
}

static OstStatus take(const Finder *finder, const Part *chosen, OstLocal count, OstPressureParts *parts)
{
    const OstCoupling *coupling = finder->coupling;
    OstStatus status = OST_NEW(coupling->ctx, &parts->of_pressure, coupling->columns);
    OST_THEN(OST_NEW(coupling->ctx, &parts->mass, count));
    OST_THEN(OST_NEW(coupling->ctx, &parts->loose, count));
    OST_TRY(ost_agree(coupling->ctx, status));
    parts->count = (int)count;
    for (OstLocal c = 0; c < count; c++) {
        parts->mass[c] = chosen[c].mass;
        parts->loose[c] = chosen[c].loose;
    }
    for (OstLocal i = 0; i < coupling->columns; i++) {
        const Part wanted = {.label = finder->label[i]};
        const Part *found = bsearch(&wanted, chosen, (size_t)count, sizeof *chosen, by_label);
        parts->of_pressure[i] = found ? (int)(found - chosen) : -1;
    }
    return OST_SUCCESS;
}

OstStatus ost_pressure_parts_create(const OstBlockMatrix *matrix, const OstCoupling *coupling, double soft, int most,
                                    OstPressureParts *parts)
{
    OstContext *ctx = coupling->ctx;
    Finder finder = {.matrix = matrix, .coupling = coupling};
    void *all = NULL;
    OstLocal total = 0;
    *parts = (OstPressureParts){0};
    OstStatus status = OST_NEW(ctx, &finder.set, coupling->columns);
    OST_THEN(OST_NEW(ctx, &finder.label, coupling->columns));
    OST_THEN(OST_NEW(ctx, &finder.order, coupling->columns));
    OST_THEN(OST_NEW(ctx, &finder.force, 3 * (size_t)coupling->unknowns));
    OST_TRY_DONE(ost_agree(ctx, status));
    find_sets(&finder);
    OST_TRY_DONE(label_sets(&finder));
    OST_TRY_DONE(ost_agree(ctx, measure(&finder)));
    OST_TRY_DONE(ost_gather_items(ctx, sizeof(Part), finder.part, finder.count,
                                  "there are too many parts of incompressible material", &all, &total));
    total = choose(all, total, soft, most);
    if (total > 0)
        status = take(&finder, all, total, parts);
done:
    OST_FREE(finder.set);
    OST_FREE(finder.label);
    OST_FREE(finder.order);
    OST_FREE(finder.force);
    OST_FREE(finder.part);
    OST_FREE(all);
    if (status != OST_SUCCESS)
        ost_pressure_parts_clear(parts);
    return status;
}
