/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VTK_XML_H
#define ORTHOSTAT_FORMATS_VTK_XML_H

#include "formats/vtk/grid.h"

/* The little of XML that VTK's files use: tags with attributes, one after the other. */

enum { OST_XML_ATTRIBUTES = 24, OST_XML_VALUE = OST_VTK_NAME };

typedef struct OstXmlTag {
    int closes; /* </Name>, or Name/ at its end (2) */
    char name[OST_XML_VALUE];
    int count;
    char attribute[OST_XML_ATTRIBUTES][OST_XML_VALUE];
    char value[OST_XML_ATTRIBUTES][OST_XML_VALUE];
} OstXmlTag;

/* Local. Goes past the next tag; *found is 0 where there is none. Comments and declarations are skipped. */
OstStatus ost_xml_next(OstMshCursor *cursor, OstXmlTag *tag, int *found);

/* Local. The value of an attribute, or NULL; a whole number of 0 or more, `missing` where it is not there. */
const char *ost_xml_value(const OstXmlTag *tag, const char *attribute);
OstStatus ost_xml_number(OstMshCursor *cursor, const OstXmlTag *tag, const char *attribute, OstGlobal missing,
                         OstGlobal *number);

/* What packs the numbers that are no text. */
typedef enum { OST_VTU_PLAIN, OST_VTU_ZLIB, OST_VTU_LZ4, OST_VTU_OTHER } OstVtuPacker;

/* How the numbers of a file are stored. */
typedef struct OstVtuStore {
    OstMshCursor *cursor;
    int swapped;      /* byte order differs from this machine's */
    int header_bytes; /* of the numbers before data: 4 or 8 */
    OstVtuPacker packer;
    int base64;           /* appended data */
    const char *appended; /* where they begin; NULL: there are none */
} OstVtuStore;

/* Local. The numbers of a DataArray whose tag has just been read, `count` of them, or as many as there are (-1); in
 * memory from the context. */
OstStatus ost_vtu_numbers(const OstVtuStore *store, const OstXmlTag *tag, OstGlobal *count, double **values);

#endif
