/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_EXCHANGE_NUMBERS_H
#define ORTHOSTAT_FORMATS_EXCHANGE_NUMBERS_H

#include "orthostat/context.h"

/* Local. Numbers as Fortran writes them, 1.5D-3 or 1.5-3, from a text of `length`. Return 0 if it is none, or not
 * finite; blanks around it do not matter. */
int ost_fortran_real(const char *text, size_t length, double *value);
int ost_fortran_integer(const char *text, size_t length, OstGlobal *value);

#endif
