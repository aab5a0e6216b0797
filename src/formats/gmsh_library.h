/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_GMSH_LIBRARY_H
#define ORTHOSTAT_FORMATS_GMSH_LIBRARY_H

#include "orthostat/context.h"

#include <gmshc.h>

/* The functions of Gmsh's C interface in use: field of the table, name. The library is loaded when a .msh file is read
 * and not before; linking it would cost every other run 40 ms and 22 MiB. */
#define OST_GMSH_FUNCTIONS(X)                                      \
    X(initialize, gmshInitialize)                                  \
    X(finalize, gmshFinalize)                                      \
    X(free, gmshFree)                                              \
    X(set_number, gmshOptionSetNumber)                             \
    X(last_error, gmshLoggerGetLastError)                          \
    X(add_model, gmshModelAdd)                                     \
    X(merge, gmshMerge)                                            \
    X(get_entities, gmshModelGetEntities)                          \
    X(get_groups, gmshModelGetPhysicalGroups)                      \
    X(get_group_name, gmshModelGetPhysicalName)                    \
    X(get_entities_of_group, gmshModelGetEntitiesForPhysicalGroup) \
    X(get_groups_of_entity, gmshModelGetPhysicalGroupsForEntity)   \
    X(get_nodes, gmshModelMeshGetNodes)                            \
    X(get_element_types, gmshModelMeshGetElementTypes)             \
    X(get_element_properties, gmshModelMeshGetElementProperties)   \
    X(get_elements, gmshModelMeshGetElementsByType)

typedef struct OstGmsh {
    OstContext *ctx;
    const char *path; /* of the file that is read, for messages */
#define OST_GMSH_FIELD(field, name) __typeof__(name) *field;
    OST_GMSH_FUNCTIONS(OST_GMSH_FIELD)
#undef OST_GMSH_FIELD
} OstGmsh;

/* Local. Loads the library and starts it, silent and without the user's settings; raises OST_LIBRARY_FAILED. It stays
 * loaded: its C++ parts do not bear being unloaded. */
OstStatus ost_gmsh_open(OstContext *ctx, const char *path, OstGmsh *gmsh);
void ost_gmsh_close(OstGmsh *gmsh);

/* Local. Turns what a call wrote into its last argument into a status, with Gmsh's own words. */
OstStatus ost_gmsh_check(const OstGmsh *gmsh, int error, const char *action);

#endif
