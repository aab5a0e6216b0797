/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/forecast/stage.h"

#include <string.h>

#define STAGE_LABEL(name, label) [name] = label,
const char *const ost_stage_label[] = {OST_STAGE_TABLE(STAGE_LABEL)};
#undef STAGE_LABEL

/* What an effect calls for is part of the assembly, but for the linear space, which is a level of multigrid, and what
 * comes after the solve. */
static OstStage stage_of(OstAccount account)
{
    switch (account) {
    case OST_LEDGER_MESH:
    case OST_LEDGER_PARTITION:
        return OST_STAGE_MESH;
    case OST_LEDGER_SELECTION:
    case OST_LEDGER_PATTERN:
    case OST_LEDGER_STIFFNESS:
    case OST_LEDGER_SUPPORTS:
        return OST_STAGE_ASSEMBLY;
    case OST_LEDGER_HIERARCHY:
    case OST_EFFECT_LINEAR_SPACE:
        return OST_STAGE_SETUP;
    case OST_LEDGER_SOLVE:
        return OST_STAGE_SOLVE;
    case OST_EFFECT_ERROR_ESTIMATE:
        return OST_STAGE_ESTIMATE;
    case OST_LEDGER_OUTPUT:
        return OST_STAGE_OUTPUT;
    case OST_EFFECT_RECOVERY:
        return OST_STAGE_REST;
    default:
        return account < OST_LEDGER_PHASES ? OST_STAGE_REST : OST_STAGE_ASSEMBLY;
    }
}

void ost_stage_sum(const OstMeter *meter, double seconds[OST_STAGES])
{
    memset(seconds, 0, OST_STAGES * sizeof *seconds);
    for (int a = 0; a < OST_EFFECT_END; a++)
        seconds[stage_of(a)] += meter->account[a];
}
