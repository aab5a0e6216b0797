/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtkhdf/steps.h"

#include "core/error.h"
#include "core/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char step_names[] = "/Orthostat/StepNames";

static OstStatus add_reasons(OstContext *ctx, OstStepList *list, const char *name, const OstOutputMark *mark)
{
    snprintf(list->status, sizeof list->status, "%s", mark->status);
    OST_TRY(OST_RESIZE(ctx, &list->reason, list->reason_count + mark->reason_count));
    for (int r = 0; r < mark->reason_count; r++) {
        const size_t size = (name ? strlen(name) + 2 : 0) + strlen(mark->reasons[r]) + 1;
        char **reason = &list->reason[list->reason_count];
        OST_TRY(OST_NEW(ctx, reason, size));
        snprintf(*reason, size, "%s%s%s", name ? name : "", name ? ": " : "", mark->reasons[r]);
        list->reason_count++;
    }
    return OST_SUCCESS;
}

/* Readers want the values in order. */
static void sort_last(OstStepList *list)
{
    for (int s = list->count - 1; s > 0 && list->step[s].value < list->step[s - 1].value; s--) {
        const OstStep later = list->step[s - 1];
        list->step[s - 1] = list->step[s];
        list->step[s] = later;
    }
}

OstStatus ost_step_list_add(OstContext *ctx, OstStepList *list, double value, const char *name,
                            const OstOutputMark *mark)
{
    OST_TRY(OST_RESIZE(ctx, &list->step, list->count + 1));
    OstStep *step = &list->step[list->count];
    *step = (OstStep){
        .value = value, .refused = mark != NULL, .unfinished = mark && mark->unfinished, .place = list->count};
    OST_TRY(ost_copy_string(ctx, name ? name : "", &step->name));
    list->count++;
    sort_last(list);
    return mark ? add_reasons(ctx, list, name, mark) : OST_SUCCESS;
}

void ost_step_list_free(OstStepList *list)
{
    for (int s = 0; s < list->count; s++)
        OST_FREE(list->step[s].name);
    OST_FREE_EACH(list->reason_count, list->reason);
    OST_FREE(list->step);
}

/* --- writing --- */

/* Numbers that rank 0 has. */
static OstStatus write_few(OstHdf5 *h5, const char *name, hid_t type, int count, const void *values)
{
    const OstRows rows = {.count = ost_rank(h5->ctx) == 0 ? count : 0, .total = count, .most = count};
    return ost_hdf5_write_rows(h5, name, type, 1, &rows, values);
}

/* What is said of each step: a flag, or its number or the place of its rows, from 0. */
typedef enum { REFUSED, UNFINISHED, NUMBER, PLACE, ONE } What;

static OstGlobal say(const OstStepList *list, int step, What what)
{
    const OstStep *about = &list->step[step];
    const OstGlobal said[] = {[REFUSED] = about->refused,
                              [UNFINISHED] = about->unfinished,
                              [NUMBER] = step,
                              [PLACE] = about->place,
                              [ONE] = 1};
    return said[what];
}

/* That, times a factor. */
static OstStatus write_each(OstHdf5 *h5, const OstStepList *list, const char *name, What what, OstGlobal factor)
{
    OstGlobal *numbers = NULL;
    OstStatus status = ost_agree(h5->ctx, OST_NEW(h5->ctx, &numbers, list->count));
    for (int s = 0; s < list->count && status == OST_SUCCESS; s++)
        numbers[s] = say(list, s, what) * factor;
    OST_THEN(write_few(h5, name, H5T_NATIVE_INT64, list->count, numbers));
    OST_FREE(numbers);
    return status;
}

static int any(const OstStepList *list, What what)
{
    OstGlobal sum = 0;
    for (int s = 0; s < list->count; s++)
        sum += say(list, s, what);
    return sum > 0;
}

OstStatus ost_step_list_write_marks(OstHdf5 *h5, const OstStepList *list)
{
    if (!*list->status)
        return OST_SUCCESS;
    OST_TRY(ost_hdf5_write_text(h5, "/VTKHDF", "Status", list->status));
    OST_TRY(ost_hdf5_write_names(h5, "/Orthostat/Objections", list->reason_count, list->reason));
    if (any(list, UNFINISHED))
        OST_TRY(write_each(h5, list, "/VTKHDF/FieldData/unfinished", UNFINISHED, 1));
    return write_each(h5, list, "/VTKHDF/FieldData/refused", REFUSED, 1);
}

OstStatus ost_step_list_write_offsets(OstHdf5 *h5, const OstStepList *list, const char *group, const char *array,
                                      OstGlobal rows)
{
    char name[256];
    snprintf(name, sizeof name, "/VTKHDF/Steps/%s/%s", group, array);
    return write_each(h5, list, name, PLACE, rows);
}

static const char *const of_mesh[] = {"PartOffsets", "PointOffsets", "CellOffsets", "ConnectivityIdOffsets"};
enum { OF_MESH = sizeof of_mesh / sizeof *of_mesh };

static void name_of_mesh(int which, char name[64])
{
    snprintf(name, 64, "/VTKHDF/Steps/%s", of_mesh[which]);
}

static OstStatus write_values(OstHdf5 *h5, const OstStepList *list)
{
    double *values = NULL;
    char **names = NULL;
    OstStatus status = OST_NEW(h5->ctx, &values, list->count);
    OST_THEN(OST_NEW(h5->ctx, &names, list->count));
    status = ost_agree(h5->ctx, status);
    for (int s = 0; s < list->count && status == OST_SUCCESS; s++) {
        values[s] = list->step[s].value;
        names[s] = list->step[s].name;
    }
    OST_THEN(write_few(h5, "/VTKHDF/Steps/Values", H5T_NATIVE_DOUBLE, list->count, values));
    OST_THEN(ost_hdf5_write_names(h5, step_names, list->count, names));
    OST_FREE(values, names);
    return status;
}

OstStatus ost_step_list_write(OstHdf5 *h5, const OstStepList *list, int pieces)
{
    char name[64];
    OST_TRY(write_values(h5, list));
    OST_TRY(ost_hdf5_write_integers(h5, "/VTKHDF/Steps", "NSteps", 0, &list->count));
    OST_TRY(write_each(h5, list, "/VTKHDF/Steps/NumberOfParts", ONE, pieces));
    for (int i = 0; i < OF_MESH; i++) {
        name_of_mesh(i, name);
        OST_TRY(write_each(h5, list, name, NUMBER, 0));
    }
    if (any(list, UNFINISHED))
        OST_TRY(write_each(h5, list, "/VTKHDF/Steps/FieldDataOffsets/unfinished", NUMBER, 1));
    return *list->status ? write_each(h5, list, "/VTKHDF/Steps/FieldDataOffsets/refused", NUMBER, 1) : OST_SUCCESS;
}

OstStatus ost_step_list_add_names(OstContext *ctx, const OstStepList *list, const char *path)
{
    const char **names = NULL;
    OST_TRY(OST_NEW(ctx, &names, list->count));
    for (int s = 0; s < list->count; s++)
        names[s] = list->step[s].name;
    const OstStatus status = ost_hdf5_add_texts(ctx, path, "/VTKHDF/FieldData/step", list->count, names);
    OST_FREE(names);
    return status;
}

/* --- reading --- */

OstStatus ost_steps_check(const OstHdf5 *h5)
{
    char name[64];
    if (!ost_hdf5_has(h5, "/VTKHDF/Steps"))
        return OST_SUCCESS;
    for (int i = 0; i < OF_MESH; i++) {
        OstGlobal steps = 0, sum = 0, *offset = NULL;
        int components = 0;
        name_of_mesh(i, name);
        OST_TRY(ost_hdf5_shape(h5, name, &steps, &components));
        OST_TRY(OST_NEW(h5->ctx, &offset, steps * components));
        const OstStatus status = ost_hdf5_read_rows(h5, name, H5T_NATIVE_INT64, components, steps, 0, steps, offset);
        for (OstGlobal s = 0; s < steps * components && status == OST_SUCCESS; s++)
            sum |= offset[s];
        OST_FREE(offset);
        OST_TRY(status);
        if (sum != 0)
            return OST_RAISE(h5->ctx, OST_INVALID_INPUT,
                             "%s: holds steps of several meshes; expected those of one mesh, or a single state",
                             h5->path);
    }
    return OST_SUCCESS;
}

static int has_field(const OstHdf5 *h5, const char *field)
{
    static const char *const group[] = {"/VTKHDF/CellData/", "/VTKHDF/PointData/"};
    char name[OST_LONGEST_FIELD + 32];
    int found = 0;
    for (int g = 0; g < 2; g++) {
        snprintf(name, sizeof name, "%s%s", group[g], field);
        found |= ost_hdf5_has(h5, name);
    }
    return found;
}

void ost_steps_split(const OstHdf5 *h5, const char *word, char field[OST_LONGEST_FIELD], char step[OST_LONGEST_FIELD])
{
    const char *colon = strrchr(word, ':');
    snprintf(field, OST_LONGEST_FIELD, "%s", word);
    *step = '\0';
    if (!colon || (size_t)(colon - word) >= OST_LONGEST_FIELD || has_field(h5, field) ||
        !ost_hdf5_has(h5, "/VTKHDF/Steps"))
        return;
    field[colon - word] = '\0';
    snprintf(step, OST_LONGEST_FIELD, "%s", colon + 1);
}

/* The step of this name, or of this number from 1; -1: there is none. `list` gets the names, for a message. */
static OstStatus find_step(const OstHdf5 *h5, const char *step, OstGlobal count, OstGlobal *found, char list[240])
{
    char **names = NULL, *end = NULL;
    int named = 0;
    size_t used = 0;
    *list = '\0';
    *found = strtoll(step, &end, 10) - 1;
    if (!*step || *end || *found < 0 || *found >= count)
        *found = -1;
    OstStatus status = ost_hdf5_has(h5, step_names) ? ost_hdf5_read_names(h5, step_names, &named, &names) : OST_SUCCESS;
    for (int s = 0; s < named && s < count && status == OST_SUCCESS; s++) {
        if (strcmp(names[s], step) == 0)
            *found = s;
        if (used < 200)
            used += (size_t)snprintf(list + used, 240 - used, "%s%.30s", s > 0 ? ", " : "", names[s]);
    }
    if (named == 0)
        snprintf(list, 240, "1 to %lld", (long long)count);
    OST_FREE_EACH(named, names);
    return status;
}

static void name_offsets(const char *group, const char *field, char name[OST_LONGEST_FIELD + 64])
{
    snprintf(name, OST_LONGEST_FIELD + 64, "/VTKHDF/Steps/%sOffsets/%s", group, field);
}

OstStatus ost_steps_find(const OstHdf5 *h5, const char *group, const char *field, const char *step, OstGlobal count,
                         OstGlobal *rows, OstGlobal *first)
{
    char name[OST_LONGEST_FIELD + 64], list[240];
    OstGlobal steps = 0, found = 0;
    int components = 0;
    name_offsets(group, field, name);
    if (!ost_hdf5_has(h5, name) || *rows == count) {
        *rows = count;
        return OST_SUCCESS;
    }
    OST_TRY(ost_hdf5_shape(h5, name, &steps, &components));
    OST_TRY(find_step(h5, step, steps, &found, list));
    if (found < 0)
        return OST_RAISE(h5->ctx, OST_INVALID_INPUT, "%s: '%s' has %s%s%s; write %s:STEP with one of these: %s",
                         h5->path, field, *step ? "no step '" : "several steps", step, *step ? "'" : "", field, list);
    OST_TRY(ost_hdf5_read_rows(h5, name, H5T_NATIVE_INT64, 1, steps, found, 1, first));
    if (*first < 0 || *first > *rows - count)
        return OST_RAISE(h5->ctx, OST_INVALID_INPUT, "%s: the offset of '%s' in step %lld is %lld; the file is damaged",
                         h5->path, field, (long long)found + 1, (long long)*first);
    return OST_SUCCESS;
}

OstStatus ost_steps_try(const OstHdf5 *h5, const char *group, const char *field)
{
    char name[OST_LONGEST_FIELD + 64];
    for (int i = 0; i < OF_MESH; i++) {
        name_of_mesh(i, name);
        if (ost_hdf5_try_rows(h5, name, H5T_NATIVE_INT64) == OST_OUT_OF_MEMORY)
            return OST_OUT_OF_MEMORY;
    }
    if (!group)
        return OST_SUCCESS;
    name_offsets(group, field, name);
    if (ost_hdf5_has(h5, step_names)) {
        char list[240];
        OstGlobal found;
        if (find_step(h5, "", 1, &found, list) == OST_OUT_OF_MEMORY)
            return OST_OUT_OF_MEMORY;
    }
    return ost_hdf5_try_rows(h5, name, H5T_NATIVE_INT64);
}
