/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_TRILINOS_ML_H
#define ORTHOSTAT_ALGEBRA_TRILINOS_ML_H

#include "core/error.h"

#include <ml_include.h>

/* Local. An ML object over the context's communicator, silent, with room for `levels` levels; ML_Destroy frees it. */
static inline OstStatus ost_ml_create(OstContext *ctx, int levels, ML **ml)
{
    *ml = NULL;
    ML_Set_PrintLevel(0);
    if (ML_Create(ml, levels) != 0 || !*ml)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "ML_Create failed for %d levels", levels);
    ML_Comm_Set_UsrComm((*ml)->comm, ost_comm(ctx));
    ML_Comm_Set_Mypid((*ml)->comm, ost_rank(ctx));
    ML_Comm_Set_Nprocs((*ml)->comm, ost_size(ctx));
    return OST_SUCCESS;
}

#endif
