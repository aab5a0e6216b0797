/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VEG_VEG_H
#define ORTHOSTAT_FORMATS_VEG_VEG_H

#include "formats/serial/formats.h"
#include "formats/serial/label_index.h"
#include "formats/serial/line_reader.h"

enum { OST_VEG_DEPTH = 16, OST_VEG_NAME_SIZE = 256 };

/* Names, numbered from 0, and the tree that finds them. */
typedef struct OstVegNames {
    int count;
    void *tree;
} OstVegNames;

/* The elements of a *SET, and the last *REGION that uses it. */
typedef struct OstVegSet {
    char *name;
    OstLocal first, count; /* in set_elements; not used by allElements, set 0 */
    int region;            /* number of the *REGION, from 0; -1 if none */
    int material;
} OstVegSet;

/* A .veg file while it is read. */
typedef struct OstVeg {
    OstContext *ctx;
    int depth; /* open files: the first, the one that it includes, ... */
    int included;
    OstLineReader reader[OST_VEG_DEPTH];
    const char *sought; /* a path, or NULL */
    int met;            /* was one of the opened files this one? */

    OstGlobal vertex_count;
    double *coordinates;
    OstGlobal *vertex_id;
    OstLabelIndex vertices;

    OstGlobal element_count;
    OstGlobal *element_vertices; /* 4 positions each */
    OstGlobal *element_id;
    OstLabelIndex elements;

    OstVegNames material_names;
    OstMaterial *material;
    double *axes; /* 9 each */

    OstVegNames set_names;
    OstVegSet *set;
    OstLocal *set_elements;
    OstLocal set_used;

    int region_count;
} OstVeg;

/* Local. Opens and closes; follows *INCLUDE from line to line. */
OstStatus ost_veg_open(OstContext *ctx, const char *path, OstVeg *veg);
void ost_veg_close(OstVeg *veg);
OstStatus ost_veg_next(OstVeg *veg, int *found);
OstLineReader *ost_veg_reader(OstVeg *veg);

/* Local. The next line; raises if there is none or if it is a keyword. */
OstStatus ost_veg_expect(OstVeg *veg, const char *what);

/* Local. The rest of the line, without blanks at its ends, as a name; `what` has this name. */
OstStatus ost_veg_name(OstVeg *veg, const char *what, char name[OST_VEG_NAME_SIZE]);

/* Local. Adds a name (refused if known) and looks one up (-1 if unknown). */
OstStatus ost_veg_names_add(OstVeg *veg, OstVegNames *names, const char *what, const char *name);
int ost_veg_names_find(const OstVegNames *names, const char *name);
void ost_veg_names_clear(OstVegNames *names);

/* Local. The sections, called when their keyword has been read. */
OstStatus ost_veg_vertices(OstVeg *veg);
OstStatus ost_veg_elements(OstVeg *veg);
OstStatus ost_veg_material(OstVeg *veg);
OstStatus ost_veg_set(OstVeg *veg);
OstStatus ost_veg_region(OstVeg *veg);

/* Local. The mesh and materials of a file once all of it is read. Moves arrays out of `veg`. */
OstStatus ost_veg_chunk(OstVeg *veg, OstMeshChunk **chunk, OstFileMaterials **materials);

/* Local. Adds the default material of files without one: ENU, 1000, 1e9, 0.45. */
OstStatus ost_veg_default_material(OstVeg *veg);

#endif
