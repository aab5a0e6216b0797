/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/veg/veg.h"

#include <search.h>
#include <string.h>

/* Names are kept in a search tree: a file may define a material for each element. */

typedef struct Entry {
    int number;
    char *name;
} Entry;

static int compare_entries(const void *a, const void *b)
{
    return strcmp(((const Entry *)a)->name, ((const Entry *)b)->name);
}

static void free_entry(void *entry)
{
    OST_FREE(((Entry *)entry)->name, entry);
}

OstStatus ost_veg_names_add(OstVeg *veg, OstVegNames *names, const char *what, const char *name)
{
    OstContext *ctx = veg->ctx;
    Entry *entry = NULL;
    OstStatus status = OST_SUCCESS;
    if (ost_veg_names_find(names, name) >= 0)
        return OST_RAISE_LINE(ost_veg_reader(veg), "a second %s '%s'; give each its own name", what, name);
    OST_TRY(OST_NEW(ctx, &entry, 1));
    entry->number = names->count;
    status = ost_copy_string(ctx, name, &entry->name);
    if (status == OST_SUCCESS && !tsearch(entry, &names->tree, compare_entries))
        status = OST_RAISE(ctx, OST_OUT_OF_MEMORY, "out of memory for the name of %s '%s'", what, name);
    if (status == OST_SUCCESS)
        names->count++;
    else
        free_entry(entry);
    return status;
}

int ost_veg_names_find(const OstVegNames *names, const char *name)
{
    const Entry wanted = {.name = (char *)(uintptr_t)name};
    Entry *const *found = tfind(&wanted, &names->tree, compare_entries);
    return found ? (*found)->number : -1;
}

void ost_veg_names_clear(OstVegNames *names)
{
    tdestroy(names->tree, free_entry);
    *names = (OstVegNames){0};
}
