/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/forecast/show.h"

#include "core/error.h"
#include "core/progress.h"
#include "study/forecast/forecast.h"

/* One that is solved with others takes about this share of what it takes alone: 0.28 of linear tets, 0.3 of quadratic
 * ones (six cases of a beam of 265,000 unknowns). */
static const double share_in_company = 0.3;

OstStatus ost_forecast_show(const OstScene *scene)
{
    const int cases = scene->c->load_case_count;
    OstRates rates;
    OstForecast forecast;
    OST_TRY(ost_rates_load(scene->ctx, &rates));
    ost_forecast_make(scene->c, &scene->plan, &rates, ost_size(scene->ctx), &forecast);
    const double *seconds = forecast.seconds;
    if (cases == 0) {
        ost_progress_expect(scene->ctx, forecast.in_all);
        return OST_SUCCESS;
    }
    const double alone = (seconds[OST_STAGE_SOLVE] + seconds[OST_STAGE_ESTIMATE] + seconds[OST_STAGE_REST]) / cases;
    ost_progress_expect_batch(scene->ctx,
                              seconds[OST_STAGE_ASSEMBLY] + seconds[OST_STAGE_SETUP] + (1.0 - share_in_company) * alone,
                              share_in_company * alone);
    return OST_SUCCESS;
}
