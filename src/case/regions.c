/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/regions.h"

#include <string.h>

int ost_is_every_region(const char *name)
{
    return strcmp(name, "all") == 0;
}

/* Does an entry for the region `stated` count for `region` too? */
static int fits(const char *stated, const char *region)
{
    return ost_is_every_region(stated) || strcmp(stated, region) == 0;
}

const OstCaseMaterial *ost_case_material_of(const OstCase *c, const char *region)
{
    for (int i = c->material_count - 1; i >= 0; i--)
        if (fits(c->materials[i].region, region))
            return &c->materials[i];
    return NULL;
}
