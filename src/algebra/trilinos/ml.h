/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_TRILINOS_ML_H
#define ORTHOSTAT_ALGEBRA_TRILINOS_ML_H

#include "orthostat/context.h"

#include <ml_include.h>

/* Local. An ML object over the context's communicator, silent, with room for `levels` levels; ML_Destroy frees it. */
OstStatus ost_ml_create(OstContext *ctx, int levels, ML **ml);

#endif
