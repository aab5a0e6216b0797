/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/trilinos/ml.h"

#include "core/error.h"

OstStatus ost_ml_create(OstContext *ctx, int levels, ML **ml)
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
