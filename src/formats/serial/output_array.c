/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/serial/output_array.h"

#include "core/error.h"

#include <math.h>
#include <string.h>
#include <strings.h>

_Static_assert(sizeof(double) == sizeof(OstGlobal), "doubles and 64-bit integers take as many bytes");

size_t ost_output_row_bytes(const OstOutputArray *array)
{
    return (size_t)array->components * (array->type == OST_VALUES_INT32 ? sizeof(int32_t) : sizeof(double));
}

int ost_output_has_array(int count, const OstOutputArray *arrays, OstCentring centring, const char *name)
{
    for (int a = 0; a < count; a++)
        if (arrays[a].centring == centring && strcmp(arrays[a].name, name) == 0)
            return 1;
    return 0;
}

/* --- what may be written --- */

static OstStatus check_names(OstContext *ctx, const char *path, int count, const OstOutputArray *arrays)
{
    for (int a = 0; a < count; a++) {
        const OstOutputArray *array = &arrays[a];
        const char *reserved = array->centring == OST_ON_NODES ? "vertex" : "tet";
        if (!*array->name || strlen(array->name) > 200 || strchr(array->name, '/') || strcmp(array->name, ".") == 0)
            return OST_RAISE(ctx, OST_INVALID_INPUT,
                             "%s: '%.250s' cannot name an array; expected 1 to 200 characters and no '/'", path,
                             array->name);
        if (strcmp(array->name, reserved) == 0 || ost_output_has_array(a, arrays, array->centring, array->name))
            return OST_RAISE(ctx, OST_INVALID_INPUT, "%s: the file has an array '%s' already; choose another name",
                             path, array->name);
        if (array->components < 1)
            return OST_RAISE(ctx, OST_INVALID_INPUT, "%s: array '%s' has %d components", path, array->name,
                             array->components);
    }
    return OST_SUCCESS;
}

static OstStatus raise_not_finite(OstContext *ctx, const char *path, const OstOutputArray *array, size_t at,
                                  const OstMesh *mesh)
{
    const double value = ((const double *)array->values)[at];
    const size_t row = at / (size_t)array->components;
    const int on_nodes = array->centring == OST_ON_NODES;
    return OST_RAISE(ctx, OST_CHECK_FAILED,
                     "%s: '%s' is %g at %s %lld (component %zu of %d); expected finite numbers, so nothing was written",
                     path, array->name, value, on_nodes ? "vertex" : "tet",
                     (long long)(on_nodes ? mesh->node_label : mesh->tet_label)[row],
                     at % (size_t)array->components + 1, array->components);
}

/* x - x is 0 for finite x only; a sum can be vectorised, a loop with an exit cannot. */
static int all_finite(size_t count, const double *values)
{
    enum { SUMS = 8 }; /* side by side: one alone would wait for itself */
    double sum[SUMS] = {0.0}, total = 0.0;
    size_t i = 0;
    for (; i + SUMS <= count; i += SUMS)
        for (size_t k = 0; k < SUMS; k++)
            sum[k] += fabs(values[i + k] - values[i + k]);
    for (; i < count; i++)
        total += fabs(values[i] - values[i]);
    for (size_t k = 0; k < SUMS; k++)
        total += sum[k];
    return total == 0.0;
}

static OstStatus check_finite(const OstMesh *mesh, const char *path, const OstOutputArray *array)
{
    if (array->type != OST_VALUES_DOUBLE)
        return OST_SUCCESS;
    const OstLocal rows = array->centring == OST_ON_NODES ? mesh->node_count : mesh->owned_tets;
    const size_t count = (size_t)rows * (size_t)array->components;
    if (all_finite(count, array->values))
        return OST_SUCCESS;
    size_t at = 0;
    while (isfinite(((const double *)array->values)[at]))
        at++;
    return raise_not_finite(mesh->ctx, path, array, at, mesh);
}

OstStatus ost_output_check_arrays(const OstMesh *mesh, const char *path, int count, const OstOutputArray *arrays)
{
    const OstOutputArray coordinates = {"coordinates", OST_ON_NODES, OST_VALUES_DOUBLE, 3, mesh->coordinates};
    OST_TRY(check_names(mesh->ctx, path, count, arrays));
    OST_TRY(check_finite(mesh, path, &coordinates));
    for (int a = 0; a < count; a++)
        OST_TRY(check_finite(mesh, path, &arrays[a]));
    return OST_SUCCESS;
}

OstResultForm ost_result_form(const char *path, size_t *stem)
{
    static const struct {
        const char *ending;
        OstResultForm form;
    } known[] = {
        {".vtkhdf", OST_RESULT_VTKHDF}, {".hdf", OST_RESULT_HDF}, {".vtu", OST_RESULT_VTU}, {".pvtu", OST_RESULT_PVTU}};
    const size_t length = strlen(path);
    for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
        const size_t ending = strlen(known[k].ending);
        *stem = length > ending ? length - ending : 0;
        if (length >= ending && strcasecmp(path + length - ending, known[k].ending) == 0)
            return known[k].form;
    }
    *stem = length;
    return OST_RESULT_FORMS;
}
