/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/exchange/nastran_card.h"

#include "core/error.h"
#include "core/memory.h"
#include "formats/exchange/numbers.h"

#include <ctype.h>
#include <string.h>

enum { SMALL = 8, LARGE = 16 };

static OstStatus add_field(OstNastranCard *card, const char *text, size_t length)
{
    while (length > 0 && isspace((unsigned char)*text)) {
        text++;
        length--;
    }
    while (length > 0 && isspace((unsigned char)text[length - 1]))
        length--;
    if (length >= OST_NASTRAN_FIELD) { /* no number that is read; titles have such fields */
        text = "(too long)";
        length = strlen(text);
    }
    OST_TRY(OST_GROW(card->cursor.ctx, &card->field, card->fields + 1));
    memcpy(card->field[card->fields], text, length);
    card->field[card->fields++][length] = '\0';
    return OST_SUCCESS;
}

/* Fields between commas, eight of a line, or four large ones; the one after them only names the continuation, and those
 * left out are blank. */
static OstStatus free_fields(OstNastranCard *card, const char *text, const char *end, int count)
{
    for (int f = 0; f < count; f++) {
        const char *comma = memchr(text, ',', (size_t)(end - text));
        const char *stop = comma ? comma : end;
        OST_TRY(add_field(card, text, (size_t)(stop - text)));
        text = comma ? comma + 1 : end;
    }
    return OST_SUCCESS;
}

/* Blank fields at the end of a line count: the next line begins with the ninth. */
static OstStatus fixed_fields(OstNastranCard *card, const char *text, const char *end, int width)
{
    for (int f = 0; f < 64 / width; f++) {
        const ptrdiff_t left = end - text;
        const ptrdiff_t length = left < 0 ? 0 : left < width ? left : width;
        OST_TRY(add_field(card, text, (size_t)length));
        text += length;
    }
    return OST_SUCCESS;
}

/* Columns count as if a tab went on to the next multiple of eight. */
static OstStatus fields_after_tabs(OstNastranCard *card, const char *line, const char *end)
{
    char text[9 * SMALL];
    int length = 0;
    for (; line < end && length < (int)sizeof text; line++)
        do
            text[length++] = *line == '\t' ? ' ' : *line;
        while (*line == '\t' && length % SMALL != 0);
    const int name = length < SMALL ? length : SMALL;
    return fixed_fields(card, text + name, text + length, memchr(text, '*', (size_t)name) ? LARGE : SMALL);
}

OstStatus ost_nastran_take_line(OstNastranCard *card, const char *line, const char *end)
{
    const char *comma = memchr(line, ',', (size_t)(end - line));
    const ptrdiff_t name = end - line < SMALL ? end - line : SMALL;
    if (comma)
        return free_fields(card, comma + 1, end, memchr(line, '*', (size_t)(comma - line)) ? 4 : 8);
    if (memchr(line, '\t', (size_t)(end - line)))
        return fields_after_tabs(card, line, end);
    return fixed_fields(card, line + name, end, memchr(line, '*', (size_t)name) ? LARGE : SMALL);
}

const char *ost_nastran_field(const OstNastranCard *card, int number)
{
    return number < card->fields ? card->field[number] : "";
}

OstStatus ost_nastran_integer(OstNastranCard *card, const char *what, int number, OstGlobal *value)
{
    const char *text = ost_nastran_field(card, number);
    card->cursor.place = card->line;
    return ost_fortran_integer(text, strlen(text), value)
               ? OST_SUCCESS
               : OST_RAISE_MSH(&card->cursor, "field %d of %s is '%s', expected %s", number + 1, card->name, text,
                               what);
}

OstStatus ost_nastran_reals(OstNastranCard *card, const char *what, int first, int count, double *values)
{
    for (int i = 0; i < count; i++) {
        const char *text = ost_nastran_field(card, first + i);
        card->cursor.place = card->line;
        if (text[0] && !ost_fortran_real(text, strlen(text), &values[i]))
            return OST_RAISE_MSH(&card->cursor, "field %d of %s is '%s', expected %s", first + i + 1, card->name, text,
                                 what);
    }
    return OST_SUCCESS;
}

void ost_nastran_begin_card(OstNastranCard *card, const char *line, const char *end)
{
    int length = 0;
    for (; line + length < end && length < OST_NASTRAN_NAME - 1 && !strchr(" ,*\t", line[length]); length++)
        card->name[length] = (char)toupper((unsigned char)line[length]);
    length -= length > 0 && card->name[length - 1] == '_'; /* meshio's, of quadratic elements: CTETRA_ */
    card->name[length] = '\0';
    card->fields = 0;
    card->line = line;
}
