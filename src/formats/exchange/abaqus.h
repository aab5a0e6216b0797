/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_EXCHANGE_ABAQUS_H
#define ORTHOSTAT_FORMATS_EXCHANGE_ABAQUS_H

#include "formats/cells/cells.h"
#include "formats/exchange/passed.h"
#include "formats/serial/line_reader.h"

/* What the data lines after a keyword hold. */
typedef enum {
    OST_INP_NOTHING,
    OST_INP_NODES,
    OST_INP_ELEMENTS,
    OST_INP_SKIPPED,
    OST_INP_SET,
    OST_INP_SURFACE,
    OST_INP_UNION,
    OST_INP_INSTANCE,
    OST_INP_SYSTEM,
    OST_INP_TIE,
    OST_INP_KINEMATIC,
    OST_INP_KINEMATIC_NODES,
    OST_INP_ORIENTATION
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

/* A part, and an instance of one: its translation, and the line and degrees of its turn (abaqus_parts.c). */
typedef struct OstInpPart {
    char name[OST_INP_WORD];
    OstCells cells;
} OstInpPart;
typedef struct OstInpInstance {
    char name[OST_INP_WORD];
    int lines;
    double line[2][7];
} OstInpInstance;

/* What holds a surface: one that it is tied to, or a point. */
typedef enum { OST_INP_TIED, OST_INP_RIGID, OST_INP_DISTRIBUTED } OstInpJoinKind;
typedef struct OstInpJoin {
    OstInpJoinKind kind;
    char on[OST_INP_WORD], to[OST_INP_WORD];
    double tolerance;
    char directions[8]; /* digits of those that *KINEMATIC names; "" for all */
} OstInpJoin;

/* Material axes: two or three points of a system, and the turn about one of its axes; and the section that has them. */
typedef struct OstInpOrientation {
    char name[OST_INP_WORD];
    int lines, is_plain, is_cylinder; /* is_plain: of a kind that is told */
    double point[9], degrees;
    int about;
} OstInpOrientation;
typedef struct OstInpSection {
    char set[OST_INP_WORD], orientation[OST_INP_WORD];
} OstInpSection;
enum { OST_INP_OUTSIDE, OST_INP_PART, OST_INP_INSTANCE_OF };

/* An .inp file while it is read. */
typedef struct OstInp {
    OstContext *ctx;
    OstCells cells;       /* of what is read now */
    OstCells outer;       /* of the assembly, while a part or an instance is read */
    int inside;           /* one of OST_INP_OUTSIDE, ... */
    OstLineReader *lines; /* of the file that is read now: the first, or one that it includes */
    OstInpBlock block;
    int set;      /* the set that data lines fill, or -1 */
    int generate; /* do they state ranges? */
    int by_line;  /* does a number follow each of its words? */
    OstCellKind kind;
    int filled; /* numbers of the present element that have been read: its own, then its nodes' */
    OstGlobal element[28];
    const char *shape; /* of elements that are skipped */
    char type[OST_INP_WORD];
    int dimension;
    int part_count, instance_count;
    OstInpPart *part;
    OstInpInstance *instance;
    int first_sets; /* sets of the first instance */
    int of;         /* instance of the set that is read, or -1 */
    int own_nodes;  /* has the assembly nodes of its own, such as reference points? */
    int sections;   /* *SOLID SECTION found? */
    OstGlobal left_out;
    OstPassed passed;
    int join_count;
    OstInpJoin *join;
    double tolerance; /* of the present *TIE */
    int orientation_count, section_count;
    OstInpOrientation *orientation;
    OstInpSection *section;
} OstInp;

/* The value of a parameter: "" for one without; NULL if it is not there. */
const char *ost_inp_value(const OstInpKeyword *keyword, const char *parameter);

/* Local. The name of a set or surface, as a parameter or as the line's next word: with a quote before it if it is in
 * quotes, "" at the line's end. Returns `name`, or NULL if the parameter is not there. */
const char *ost_inp_set_name(const OstInpKeyword *keyword, const char *parameter, char name[OST_INP_WORD]);
void ost_inp_word(OstLineReader *lines, char word[OST_INP_WORD]);

/* Local. Parts and instances: begin and end one, read a data line of an instance; end and close them all. */
OstStatus ost_inp_begin_part(OstInp *inp, const OstInpKeyword *keyword);
OstStatus ost_inp_end_part(OstInp *inp);
OstStatus ost_inp_begin_instance(OstInp *inp, const OstInpKeyword *keyword);
OstStatus ost_inp_instance_line(OstInp *inp);
OstStatus ost_inp_end_instance(OstInp *inp);
OstStatus ost_inp_end_parts(OstInp *inp);
void ost_inp_close_parts(OstInp *inp);

/* Local. Takes the INSTANCE of a set. The label of a node, or of something else, by its number in an instance, whose
 * name may stand before it in `word` (ARM-1.17); the set of a name, likewise (ARM-1.TOP), or -1. */
OstStatus ost_inp_set_instance(OstInp *inp, const OstInpKeyword *keyword);
OstGlobal ost_inp_number(const OstInp *inp, OstSetKind kind, const char *word, OstGlobal label);
int ost_inp_find_set(const OstInp *inp, OstSetKind kind, const char *word);

/* Local. Begin the blocks of sets and surfaces; read one data line of them. */
OstStatus ost_inp_begin_set(OstInp *inp, const OstInpKeyword *keyword, OstSetKind kind);
OstStatus ost_inp_begin_surface(OstInp *inp, const OstInpKeyword *keyword);
OstStatus ost_inp_set_line(OstInp *inp);
OstStatus ost_inp_surface_line(OstInp *inp);
OstStatus ost_inp_union_line(OstInp *inp);

/* Local. What is passed over: counts a keyword that changes how the body moves; *TIE and its lines, *COUPLING and the
 * *DISTRIBUTING after it, *ORIENTATION and the sections that name one; warns of all of them, once everything is read.
 */
OstStatus ost_inp_pass(OstInp *inp, const OstInpKeyword *keyword);
OstStatus ost_inp_begin_tie(OstInp *inp, const OstInpKeyword *keyword);
OstStatus ost_inp_tie_line(OstInp *inp);
OstStatus ost_inp_coupling(OstInp *inp, const OstInpKeyword *keyword);
void ost_inp_kinematic_line(OstInp *inp);
void ost_inp_distribute(OstInp *inp);
OstStatus ost_inp_begin_orientation(OstInp *inp, const OstInpKeyword *keyword);
void ost_inp_orientation_line(OstInp *inp);
OstStatus ost_inp_oriented(OstInp *inp, const OstInpKeyword *keyword);
void ost_inp_warn_passed(OstInp *inp);

#endif
