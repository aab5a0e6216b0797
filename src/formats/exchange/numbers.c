/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/exchange/numbers.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LONGEST = 64 };

/* Copies without blanks at the ends; 0 if nothing is left or it is too long. */
static size_t trim(const char *text, size_t length, char copy[LONGEST])
{
    while (length > 0 && isspace((unsigned char)*text)) {
        text++;
        length--;
    }
    while (length > 0 && isspace((unsigned char)text[length - 1]))
        length--;
    if (length >= LONGEST - 2)
        return 0;
    memcpy(copy, text, length);
    copy[length] = '\0';
    return length;
}

int ost_fortran_real(const char *text, size_t length, double *value)
{
    char copy[LONGEST], *end = NULL;
    length = trim(text, length, copy);
    for (size_t i = 0; i < length; i++) {
        const int digit_before = i > 0 && (isdigit((unsigned char)copy[i - 1]) || copy[i - 1] == '.');
        if (strchr("dDqQ", copy[i])) {
            copy[i] = 'e';
        } else if ((copy[i] == '-' || copy[i] == '+') && digit_before) {
            memmove(copy + i + 1, copy + i, length - i + 1);
            copy[i++] = 'e';
            length++;
        } else if (!strchr("0123456789.+-eE", copy[i])) {
            return 0;
        }
    }
    *value = strtod(copy, &end);
    return length > 0 && *end == '\0' && isfinite(*value);
}

int ost_fortran_integer(const char *text, size_t length, OstGlobal *value)
{
    char copy[LONGEST], *end = NULL;
    length = trim(text, length, copy);
    errno = 0;
    *value = strtoll(copy, &end, 10);
    return length > 0 && *end == '\0' && errno == 0;
}
