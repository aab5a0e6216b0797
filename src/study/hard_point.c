/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "study/hard.h"

#include <stdio.h>

/* --quick takes every so manyth point: prime, and no divisor of any count of values, so that all occur. */
enum { QUICK_STRIDE = 47 };

const char *const ost_hard_outcome_name[OST_HARD_OUTCOMES] = {"solved", "solved to rounding", "refused rightly",
                                                              "given up", "FALSE SUCCESS"};
const double ost_hard_ratio[OST_HARD_RATIOS] = {1.0, 1e3, 1e6};
const double ost_hard_nu[OST_HARD_FAMILY] = {-0.5, 0.3, 0.45, 0.49, 0.499};
const double ost_hard_border[OST_HARD_POISSONS - OST_HARD_FAMILY] = {0.99, 0.999};

static const char *const axes_name[OST_HARD_AXES] = {"aligned", "cylindrical", "smooth"};

void ost_hard_describe_poisson(int poisson, char *text, size_t size)
{
    if (poisson < OST_HARD_FAMILY)
        snprintf(text, size, "nu %g", ost_hard_nu[poisson]);
    else
        snprintf(text, size, "%g of border", ost_hard_border[poisson - OST_HARD_FAMILY]);
}

int ost_hard_column(const OstHardPoint *point)
{
    const int stiffness = point->ratio == 0 ? 0 : 1 + 3 * (point->ratio - 1) + point->stiff;
    return OST_HARD_AXES * stiffness + point->axes;
}

void ost_hard_describe_column(int column, char *text, size_t size)
{
    const int stiffness = column / OST_HARD_AXES;
    if (stiffness == 0)
        snprintf(text, size, "E alike, %s", axes_name[column % OST_HARD_AXES]);
    else
        snprintf(text, size, "E%d x %g, %s", (stiffness - 1) % 3 + 1, ost_hard_ratio[1 + (stiffness - 1) / 3],
                 axes_name[column % OST_HARD_AXES]);
}

void ost_hard_describe(const OstHardPoint *point, char *text, size_t size)
{
    static const char *const flaws[OST_HARD_FLAWS] = {
        "", ", 1.001 of the border", ", nu 0.5", ", held at one vertex", ", inverted", ", a load that is no number"};
    char column[64], poisson[32];
    ost_hard_describe_column(ost_hard_column(point), column, sizeof column);
    ost_hard_describe_poisson(point->poisson, poisson, sizeof poisson);
    snprintf(text, size, "%s, order %d, %s, %s%s", ost_hard_shape_name(point->shape), point->order, poisson, column,
             flaws[point->flaw]);
}

/* --- lists of points --- */

typedef struct PointList {
    OstHardPoint *point; /* NULL: only count them */
    int count;
    const int *wanted;
    int stride;
    int seen;
} PointList;

/* Flawed points cost next to nothing, so that none is left out. */
static void add(PointList *list, OstHardPoint point)
{
    const int taken = point.flaw != OST_HARD_SOUND || list->seen++ % list->stride == 0;
    if (!taken || !list->wanted[point.shape])
        return;
    if (list->point)
        list->point[list->count] = point;
    list->count++;
}

/* Axes are nothing to an isotropic body; beyond the family, constants differ even where Young's moduli do not. */
static void add_stiffnesses(PointList *list, OstHardPoint point)
{
    for (point.ratio = 0; point.ratio < OST_HARD_RATIOS; point.ratio++)
        for (point.stiff = 0; point.stiff < (point.ratio == 0 ? 1 : 3); point.stiff++) {
            const int isotropic = point.ratio == 0 && point.poisson < OST_HARD_FAMILY;
            for (point.axes = 0; point.axes < (isotropic ? 1 : OST_HARD_AXES); point.axes++)
                add(list, point);
        }
}

static void add_flawed(PointList *list, OstHardPoint point)
{
    const int slivers = ost_hard_find_shape("slivers");
    point.poisson = 1;
    for (int f = OST_HARD_SOUND + 1; f < OST_HARD_FLAWS; f++) {
        point.flaw = (OstHardFlaw)f;
        if (point.flaw == OST_HARD_INVERTED && point.shape != slivers)
            continue;
        for (point.ratio = 0; point.ratio < OST_HARD_RATIOS; point.ratio++) {
            point.stiff = point.axes = point.ratio;
            add(list, point);
        }
    }
}

static void add_all(PointList *list)
{
    for (int shape = 0; shape < OST_HARD_SHAPES; shape++)
        for (int order = 1; order <= OST_HARD_ORDERS; order++) {
            OstHardPoint point = {.shape = shape, .order = order};
            for (point.poisson = 0; point.poisson < OST_HARD_POISSONS; point.poisson++)
                add_stiffnesses(list, point);
            add_flawed(list, point);
        }
}

OstStatus ost_hard_points(OstContext *ctx, const int wanted[OST_HARD_SHAPES], int quick, int *count,
                          OstHardPoint **points)
{
    PointList list = {.wanted = wanted, .stride = quick ? QUICK_STRIDE : 1};
    add_all(&list);
    *count = list.count;
    OST_TRY(OST_NEW(ctx, points, list.count));
    list = (PointList){.point = *points, .wanted = wanted, .stride = quick ? QUICK_STRIDE : 1};
    add_all(&list);
    return OST_SUCCESS;
}
