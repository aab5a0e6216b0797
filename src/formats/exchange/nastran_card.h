/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_EXCHANGE_NASTRAN_CARD_H
#define ORTHOSTAT_FORMATS_EXCHANGE_NASTRAN_CARD_H

#include "formats/msh/cursor.h"

enum { OST_NASTRAN_FIELD = 33, OST_NASTRAN_NAME = 9 };

/* A card of Nastran's bulk data: a name and fields, in columns of 8 (small), of 16 (large: the name ends with *), or
 * between commas (free). It goes on in lines that begin with +, * or blanks. Start from {0}; the caller opens and
 * closes `cursor`, and frees `field` at last. */
typedef struct OstNastranCard {
    OstMshCursor cursor;
    char name[OST_NASTRAN_NAME]; /* in capitals; "" before the first card */
    int fields;
    char (*field)[OST_NASTRAN_FIELD];
    const char *line; /* where the card begins */
} OstNastranCard;

/* Local. Takes the name from its first line; then the fields of this and each further line. */
void ost_nastran_begin_card(OstNastranCard *card, const char *line, const char *end);
OstStatus ost_nastran_take_line(OstNastranCard *card, const char *line, const char *end);

/* Local. A field, "" beyond the last; `number` counts from 0. */
const char *ost_nastran_field(const OstNastranCard *card, int number);

/* Local. Fields as numbers; what is no number is an error that says that `what` was expected. A blank field leaves its
 * real as it is. */
OstStatus ost_nastran_integer(OstNastranCard *card, const char *what, int number, OstGlobal *value);
OstStatus ost_nastran_reals(OstNastranCard *card, const char *what, int first, int count, double *values);

#endif
