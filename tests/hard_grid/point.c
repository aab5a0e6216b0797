/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "hard_grid/grid.h"

#include <stdio.h>
#include <string.h>

/* --quick takes every 47th point, of the mixed form every 7th: primes that divide no count of values, so that every
 * value occurs. */
enum { QUICK_STRIDE = 47, QUICK_MIXED = 7 };

const char *const hard_outcome_name[HARD_OUTCOMES] = {"solved", "solved to rounding", "refused rightly", "given up",
                                                      "FALSE SUCCESS"};
const double hard_ratio[HARD_RATIOS] = {1.0, 1e3, 1e6};
const double hard_nu[HARD_FAMILY] = {-0.5, 0.3, 0.45, 0.49, 0.499};
const double hard_border[HARD_POISSONS - HARD_FAMILY] = {0.99, 0.999};

static const char *const axes_name[HARD_AXES] = {"aligned", "cylindrical", "smooth"};

void hard_describe_poisson(int poisson, char *text, size_t size)
{
    if (poisson == HARD_INCOMPRESSIBLE)
        snprintf(text, size, "nu 0.5, mixed");
    else if (poisson < HARD_FAMILY)
        snprintf(text, size, "nu %g", hard_nu[poisson]);
    else
        snprintf(text, size, "%g of border", hard_border[poisson - HARD_FAMILY]);
}

int hard_column(const HardPoint *point)
{
    const int stiffness = point->ratio == 0 ? 0 : 1 + 3 * (point->ratio - 1) + point->stiff;
    return HARD_AXES * stiffness + point->axes;
}

void hard_describe_column(int column, char *text, size_t size)
{
    const int stiffness = column / HARD_AXES;
    if (stiffness == 0)
        snprintf(text, size, "E alike, %s", axes_name[column % HARD_AXES]);
    else
        snprintf(text, size, "E%d x %g, %s", (stiffness - 1) % 3 + 1, hard_ratio[1 + (stiffness - 1) / 3],
                 axes_name[column % HARD_AXES]);
}

void hard_describe(const HardPoint *point, char *text, size_t size)
{
    static const char *const flaws[HARD_FLAWS] = {
        "", ", 1.001 of the border", ", nu 0.5", ", held at one vertex", ", inverted", ", a load that is no number"};
    char column[64], poisson[32];
    hard_describe_column(hard_column(point), column, sizeof column);
    hard_describe_poisson(point->poisson, poisson, sizeof poisson);
    snprintf(text, size, "%s, order %d, %s, %s%s", hard_shape_name(point->shape), point->order, poisson, column,
             flaws[point->flaw]);
}

/* --- lists of points --- */

typedef struct PointList {
    HardPoint *point; /* NULL: only count them */
    int count;
    const int *wanted;
    int stride;
    int seen;
    int mixed, iterated, usual, iterations;
    OstGlobal size;
    const char *like;
    int spread; /* only the spread of each shape and order? */
} PointList;

/* The spread of a shape and order at size: an easy body, and every Poisson's ratio but two, ratio, stiff direction and
 * kind of axes among five hard ones. */
static int is_in_spread(const HardPoint *point)
{
    static const HardPoint spread[] = {{.poisson = 1},
                                       {.poisson = 1, .ratio = 1, .stiff = 0, .axes = 1},
                                       {.poisson = 2, .ratio = 1, .stiff = 2, .axes = 0},
                                       {.poisson = 4, .ratio = 1, .stiff = 1, .axes = 2},
                                       {.poisson = 0, .ratio = 2, .stiff = 0, .axes = 2},
                                       {.poisson = 6, .ratio = 2, .stiff = 2, .axes = 1}};
    for (size_t i = 0; i < sizeof spread / sizeof *spread; i++)
        if (point->poisson == spread[i].poisson && point->ratio == spread[i].ratio && point->stiff == spread[i].stiff &&
            point->axes == spread[i].axes)
            return 1;
    return 0;
}

static int is_like(const PointList *list, const HardPoint *point)
{
    char text[160];
    hard_describe(point, text, sizeof text);
    return !list->like || strstr(text, list->like);
}

/* Flawed points cost almost nothing: --quick takes them all. They are refused whatever their size. */
static void add(PointList *list, HardPoint point)
{
    if (list->spread && !is_in_spread(&point))
        return;
    const int taken = point.flaw != HARD_SOUND ? list->size == 0 : list->seen++ % list->stride == 0;
    if (!taken || !list->wanted[point.shape] || !is_like(list, &point))
        return;
    point.size = list->size;
    point.iterated = list->iterated;
    point.usual = list->usual;
    point.iterations = list->iterations;
    if (list->point)
        list->point[list->count] = point;
    list->count++;
}

/* Axes do not matter to an isotropic body; beyond the family, constants differ even if Young's moduli do not. */
static void add_stiffnesses(PointList *list, HardPoint point)
{
    for (point.ratio = 0; point.ratio < HARD_RATIOS; point.ratio++)
        for (point.stiff = 0; point.stiff < (point.ratio == 0 ? 1 : 3); point.stiff++) {
            const int family = point.poisson < HARD_FAMILY || point.poisson == HARD_INCOMPRESSIBLE;
            const int isotropic = point.ratio == 0 && family;
            for (point.axes = 0; point.axes < (isotropic ? 1 : HARD_AXES); point.axes++)
                add(list, point);
        }
}

static void add_flawed(PointList *list, HardPoint point)
{
    const int slivers = hard_find_shape("slivers");
    point.poisson = 1;
    for (int f = HARD_SOUND + 1; f < HARD_FLAWS; f++) {
        point.flaw = (HardFlaw)f;
        if (point.flaw == HARD_INVERTED && point.shape != slivers)
            continue;
        for (point.ratio = 0; point.ratio < HARD_RATIOS; point.ratio++) {
            point.stiff = point.axes = point.ratio;
            add(list, point);
        }
    }
}

static void add_all(PointList *list)
{
    for (int shape = 0; shape < HARD_SHAPES && list->mixed; shape++)
        add_stiffnesses(list, (HardPoint){.shape = shape, .order = 2, .poisson = HARD_INCOMPRESSIBLE});
    for (int shape = 0; shape < HARD_SHAPES && !list->mixed; shape++)
        for (int order = 1; order <= HARD_ORDERS; order++) {
            HardPoint point = {.shape = shape, .order = order};
            for (point.poisson = 0; point.poisson < HARD_POISSONS; point.poisson++)
                add_stiffnesses(list, point);
            add_flawed(list, point);
        }
}

static unsigned draw(unsigned *state)
{
    *state = *state * 1664525U + 1013904223U; /* Numerical Recipes' generator, its upper bits */
    return *state >> 16;
}

/* Keeps `most` points of each shape, which come one after another, in their order (Knuth's algorithm S). */
static void keep_sample(int most, int *count, HardPoint *point)
{
    unsigned state = 1;
    int kept = 0;
    for (int first = 0, end; first < *count; first = end) {
        int wanted = most;
        for (end = first; end < *count && point[end].shape == point[first].shape;)
            end++;
        for (int i = first; i < end; i++)
            if ((int)(draw(&state) % (unsigned)(end - i)) < wanted) {
                point[kept++] = point[i];
                wanted--;
            }
    }
    *count = kept;
}

OstStatus hard_points(OstContext *ctx, const HardRun *run, int *count, HardPoint **points)
{
    PointList list = {.wanted = run->wanted,
                      .stride = !run->quick  ? 1
                                : run->mixed ? QUICK_MIXED
                                             : QUICK_STRIDE,
                      .mixed = run->mixed,
                      .iterated = run->iterated,
                      .usual = run->usual,
                      .iterations = run->iterations,
                      .size = run->size,
                      .like = run->like,
                      .spread = run->size > 0 && !run->all};
    add_all(&list);
    *count = list.count;
    OST_TRY(OST_NEW(ctx, points, list.count));
    list.point = *points;
    list.count = list.seen = 0;
    add_all(&list);
    if (run->sample > 0)
        keep_sample(run->sample, count, *points);
    return OST_SUCCESS;
}
