/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/number_set.h"
#include "formats/cells/cells.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Groups and sets of tets become regions. A set is often a part of another ("all"), so the one with the fewest tets
 * says most. */

enum { MOST_REGIONS = 10000 };

/* A group (set -1) or a set of cells, and how many tets it has. */
typedef struct Candidate {
    int set;
    OstGlobal group;
    OstLocal tets;
    int order; /* as the file has them */
} Candidate;

/* The most tets first; of as many, what the file has last comes last, and so counts: sets that the user made follow
 * those of the program. */
static int compare_candidates(const void *a, const void *b)
{
    const Candidate *x = a, *y = b;
    if (x->tets != y->tets)
        return x->tets > y->tets ? -1 : 1;
    return (x->order > y->order) - (x->order < y->order);
}

static OstStatus add_candidate(const OstCells *cells, int *count, Candidate **list, Candidate one)
{
    if (*count == MOST_REGIONS)
        return OST_RAISE(
            cells->ctx, OST_LIMIT_EXCEEDED,
            "%s: its tets are in more than %d groups, too many for regions; a number of each tet is a field "
            "(youngs_modulus: {field: NAME}), not a region",
            cells->path, MOST_REGIONS);
    OST_TRY(OST_RESIZE(cells->ctx, list, *count + 1));
    one.order = *count;
    (*list)[(*count)++] = one;
    return OST_SUCCESS;
}

static OstStatus list_groups(const OstCells *cells, OstCellKind tets, int *count, Candidate **list)
{
    const OstCellList *all = &cells->list[tets];
    OstGlobal *group = NULL;
    OST_TRY(OST_NEW(cells->ctx, &group, all->count));
    memcpy(group, all->group, (size_t)all->count * sizeof *group);
    qsort(group, (size_t)all->count, sizeof *group, ost_compare_numbers);
    OstStatus status = OST_SUCCESS;
    for (OstLocal i = 0, next; i < all->count && status == OST_SUCCESS; i = next) {
        for (next = i + 1; next < all->count && group[next] == group[i];)
            next++;
        if (group[i] != OST_NO_GROUP)
            status = add_candidate(cells, count, list, (Candidate){.set = -1, .group = group[i], .tets = next - i});
    }
    OST_FREE(group);
    return status;
}

static OstLocal count_tets(const OstCells *cells, OstCellKind tets, const OstCellSet *set)
{
    OstLocal count = 0, position;
    for (OstLocal i = 0; i < set->count; i++)
        count += ost_cells_find(cells, set->item[i], &position) == tets;
    return count;
}

static OstStatus list_sets(const OstCells *cells, OstCellKind tets, int *count, Candidate **list)
{
    for (int s = 0; s < cells->set_count; s++) {
        const OstCellSet *set = &cells->set[s];
        if (set->kind != OST_SET_OF_CELLS || !set->is_region)
            continue;
        const OstLocal found = count_tets(cells, tets, set);
        if (found > 0)
            OST_TRY(add_candidate(cells, count, list, (Candidate){.set = s, .tets = found}));
    }
    return OST_SUCCESS;
}

/* Marks each tet with the last of its candidates; counts the tets that are in several. */
static void mark_tets(OstCells *cells, OstCellKind tets, int count, const Candidate *list, int32_t *region,
                      unsigned char *several)
{
    const OstCellList *all = &cells->list[tets];
    for (OstLocal t = 0; t < all->count; t++)
        region[t] = -1;
    for (int c = 0; c < count; c++) {
        OstLocal t = 0;
        const OstCellSet *set = list[c].set < 0 ? NULL : &cells->set[list[c].set];
        for (OstLocal i = 0; set && i < set->count; i++)
            if (ost_cells_find(cells, set->item[i], &t) == tets) {
                several[t] |= region[t] >= 0 && region[t] != c;
                region[t] = c;
            }
    }
}

/* All candidates; those of groups came first, in the order of their numbers. */
typedef struct Candidates {
    int count, groups;
    Candidate *list; /* as compare_candidates has them */
    int *place;      /* in the list, of each in the order of the file */
} Candidates;

static int find_group(const Candidates *all, OstGlobal group)
{
    int low = 0, high = all->groups - 1;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (all->list[all->place[middle]].group < group)
            low = middle + 1;
        else
            high = middle;
    }
    return all->place[low];
}

static void mark_groups(const OstCells *cells, OstCellKind tets, const Candidates *all, int32_t *region,
                        unsigned char *several)
{
    const OstCellList *list = &cells->list[tets];
    for (OstLocal t = 0; t < list->count; t++) {
        if (list->group[t] == OST_NO_GROUP)
            continue;
        const int group = find_group(all, list->group[t]);
        several[t] |= region[t] >= 0;
        region[t] = region[t] < group ? group : region[t];
    }
}

static OstStatus region_name(const OstCells *cells, const Candidate *one, char **name)
{
    char text[64];
    if (one->set >= 0)
        return ost_copy_string(cells->ctx, cells->set[one->set].name, name);
    for (int n = 0; n < cells->name_count; n++)
        if (cells->name[n].group == one->group && (cells->name[n].dimension == 3 || cells->name[n].dimension < 0))
            return ost_copy_string(cells->ctx, cells->name[n].name, name);
    snprintf(text, sizeof text, "volume-%" PRId64, one->group);
    return ost_copy_string(cells->ctx, text, name);
}

/* Two candidates of one name are one region. */
static OstStatus name_region(OstCells *cells, const Candidate *one, int *number)
{
    OstNames *regions = &cells->chunk->regions;
    char *name = NULL;
    OST_TRY(region_name(cells, one, &name));
    OstStatus status = OST_SUCCESS;
    *number = ost_names_find(regions, name);
    if (*number < 0) {
        *number = regions->count;
        status = ost_names_add(cells->ctx, regions, name);
    }
    OST_FREE(name);
    return status;
}

/* Numbers the candidates that have tets left, in the order of the file. */
static OstStatus number_candidates(OstCells *cells, const Candidates *all, OstLocal tet_count, const int32_t *region,
                                   int *number)
{
    for (int c = 0; c < all->count; c++)
        number[c] = -1;
    for (OstLocal t = 0; t < tet_count; t++)
        if (region[t] >= 0)
            number[region[t]] = 0;
    for (int p = 0; p < all->count; p++) {
        const Candidate *one = &all->list[all->place[p]];
        if (number[all->place[p]] == 0)
            OST_TRY(name_region(cells, one, &number[all->place[p]]));
        else if (one->set >= 0)
            ost_warn(cells->ctx, "%s: the tets of set '%s' are all in smaller sets, and it is no region", cells->path,
                     cells->set[one->set].name);
    }
    return OST_SUCCESS;
}

/* Tets in no group or set form a region of their own, the last. */
static OstStatus name_regions(OstCells *cells, const Candidates *all, OstLocal tet_count, int32_t *region)
{
    OstNames *regions = &cells->chunk->regions;
    int *number = NULL, unnamed = -1;
    OST_TRY(OST_NEW(cells->ctx, &number, all->count));
    OstStatus status = number_candidates(cells, all, tet_count, region, number);
    for (OstLocal t = 0; t < tet_count && status == OST_SUCCESS; t++) {
        if (region[t] < 0 && unnamed < 0) {
            unnamed = regions->count;
            status = ost_names_add_unique(cells->ctx, regions, unnamed > 0 ? "unnamed" : "volume");
        }
        region[t] = region[t] < 0 ? unnamed : number[region[t]];
    }
    OST_FREE(number);
    return status;
}

static OstStatus list_candidates(const OstCells *cells, OstCellKind tets, Candidates *all)
{
    OST_TRY(list_groups(cells, tets, &all->count, &all->list));
    all->groups = all->count;
    OST_TRY(list_sets(cells, tets, &all->count, &all->list));
    OST_TRY(OST_NEW(cells->ctx, &all->place, all->count));
    if (all->count > 0)
        qsort(all->list, (size_t)all->count, sizeof *all->list, compare_candidates);
    for (int c = 0; c < all->count; c++)
        all->place[all->list[c].order] = c;
    return OST_SUCCESS;
}

OstStatus ost_cells_make_regions(OstCells *cells, OstCellKind tets)
{
    const OstLocal tet_count = cells->list[tets].count;
    Candidates all = {0};
    unsigned char *several = NULL;
    OstGlobal shared = 0;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(list_candidates(cells, tets, &all));
    OST_TRY_DONE(OST_NEW(cells->ctx, &cells->chunk->tet_region, tet_count));
    OST_TRY_DONE(OST_NEW(cells->ctx, &several, tet_count));
    mark_tets(cells, tets, all.count, all.list, cells->chunk->tet_region, several);
    if (all.groups > 0)
        mark_groups(cells, tets, &all, cells->chunk->tet_region, several);
    for (OstLocal t = 0; t < tet_count; t++)
        shared += several[t];
    if (shared > 0)
        ost_warn(cells->ctx, "%s: tets in several sets: %" PRId64 "; each is put into the smallest of these only",
                 cells->path, shared);
    OST_TRY_DONE(name_regions(cells, &all, tet_count, cells->chunk->tet_region));
done:
    OST_FREE(all.list, all.place, several);
    return status;
}
