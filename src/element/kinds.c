/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/element.h"

#include "element/tets.h"

#include <stddef.h>

const OstElement *ost_element_of(int nodes_per_tet)
{
    static const OstElement *const kinds[] = {&ost_tet4, &ost_tet10};
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        if (kinds[i]->nodes == nodes_per_tet)
            return kinds[i];
    return NULL;
}
