/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_EXCHANGE_ABAQUS_H
#define ORTHOSTAT_FORMATS_EXCHANGE_ABAQUS_H

#include "formats/cells/cells.h"
#include "formats/serial/line_reader.h"

/* What the data lines after a keyword hold. */
typedef enum {
    OST_INP_NOTHING,
    OST_INP_NODES,
    OST_INP_ELEMENTS,
    OST_INP_SKIPPED,
    OST_INP_SET,
    OST_INP_SURFACE,
    OST_INP_INSTANCE,
    OST_INP_SYSTEM
} OstInpBlock;

enum { OST_INP_WORD = 128, OST_INP_PARAMETERS = 16 };

/* A line such as *ELEMENT, TYPE=C3D4, ELSET=BONE: words in capitals, values as they are. */
typedef struct OstInpKeyword {
    char name[OST_INP_WORD];
    int count;
    char parameter[OST_INP_PARAMETERS][OST_INP_WORD];
    char value[OST_INP_PARAMETERS][OST_INP_WORD];
    int quoted[OST_INP_PARAMETERS]; /* had the value quotes? */
} OstInpKeyword;

/* An .inp file while it is read. */
typedef struct OstInp {
    OstContext *ctx;
    OstCells cells;
    OstLineReader *lines; /* of the file that is read now: the first, or one that it includes */
    OstInpBlock block;
    int set;      /* the set that data lines fill, or -1 */
    int generate; /* do they state ranges? */
    OstCellKind kind;
    int filled; /* numbers of the present element that have been read: its own, then its nodes' */
    OstGlobal element[28];
    OstGlobal last_element;
    const char *shape; /* of elements that are skipped */
    char type[OST_INP_WORD];
    int dimension;
    int parts, instances, instance_lines;
    double shift[3]; /* of the instance */
    int sections;    /* *SOLID SECTION found? */
    OstGlobal left_out;
} OstInp;

/* Local. Parses the keyword at the reader's line, with the lines that it goes on in. */
OstStatus ost_inp_keyword(OstInp *inp, OstInpKeyword *keyword);
/* The value of a parameter: "" for one without; NULL if it is not there. */
const char *ost_inp_value(const OstInpKeyword *keyword, const char *parameter);

/* Local. The name of a set or surface, as a parameter or as the line's next word: with a quote before it if it is in
 * quotes, "" at the line's end. Returns `name`, or NULL if the parameter is not there. */
const char *ost_inp_set_name(const OstInpKeyword *keyword, const char *parameter, char name[OST_INP_WORD]);
void ost_inp_word(OstLineReader *lines, char word[OST_INP_WORD]);

/* Local. Begin the blocks of sets and surfaces; read one data line of them. */
OstStatus ost_inp_begin_set(OstInp *inp, const OstInpKeyword *keyword, OstSetKind kind);
OstStatus ost_inp_begin_surface(OstInp *inp, const OstInpKeyword *keyword);
OstStatus ost_inp_set_line(OstInp *inp);
OstStatus ost_inp_surface_line(OstInp *inp);

#endif
