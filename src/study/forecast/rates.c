/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/forecast/rates.h"

#include "core/error.h"
#include "core/json_file.h"
#include "core/parallel/gather.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

OstRates ost_rates_typical(void)
{
    return (OstRates){
        .typical = 1,
        .machine = "an AMD EPYC",
        .cores = 2,
        .start = 0.1,
        .process_bytes = 43.0 * 0x1p20,
        .small_bytes = {1.1e+07, 1.9e+07},
        .large_bytes = {1.1e+08, 1.45e+08},
        .stage =
            {
                {[OST_STAGE_REST] = {1.94e-09, 1.87e-09},
                 [OST_STAGE_MESH] = {3.02e-09, 3.04e-09},
                 [OST_STAGE_ASSEMBLY] = {1.70e-09, 1.94e-09},
                 [OST_STAGE_SETUP] = {1.03e-10, 1.00e-10},
                 [OST_STAGE_SOLVE] = {1.85e-10, 3.95e-10},
                 [OST_STAGE_ESTIMATE] = {2.21e-09, 2.81e-09},
                 [OST_STAGE_OUTPUT] = {1.44e-09, 4.45e-10}},
                {[OST_STAGE_REST] = {1.42e-09, 1.36e-09},
                 [OST_STAGE_MESH] = {2.76e-09, 2.76e-09},
                 [OST_STAGE_ASSEMBLY] = {1.35e-09, 1.60e-09},
                 [OST_STAGE_SETUP] = {1.06e-10, 1.13e-10},
                 [OST_STAGE_SOLVE] = {3.15e-10, 4.17e-10},
                 [OST_STAGE_ESTIMATE] = {2.69e-09, 2.83e-09},
                 [OST_STAGE_OUTPUT] = {2.84e-09, 9.87e-10}},
            },
    };
}

static void fill_day(char *day, size_t size)
{
    const time_t now = time(NULL);
    struct tm calendar;
    if (!localtime_r(&now, &calendar) || strftime(day, size, "%Y-%m-%d", &calendar) == 0)
        day[0] = 0;
}

OstRates ost_rates_of_here(const char *version)
{
    OstRates rates = {.cores = (int)sysconf(_SC_NPROCESSORS_ONLN)};
    if (gethostname(rates.machine, sizeof rates.machine - 1) != 0 || !rates.machine[0])
        snprintf(rates.machine, sizeof rates.machine, "a machine without a name");
    snprintf(rates.version, sizeof rates.version, "%s", version);
    fill_day(rates.day, sizeof rates.day);
    return rates;
}

/* Between the two sizes by their logarithm; beyond them as at the nearer one. */
double ost_rate_at(const OstRates *rates, int order, OstStage stage, double bytes)
{
    const int q = order - 1;
    const OstRate *rate = &rates->stage[q][stage];
    const double small = rates->small_bytes[q], large = rates->large_bytes[q];
    if (!(large > small) || bytes >= large)
        return rate->large;
    const double share = fmax(log(bytes / small) / log(large / small), 0.0);
    return rate->small + share * (rate->large - rate->small);
}

int ost_rates_path(char *path, size_t size)
{
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    int written = -1;
    if (cache && cache[0] == '/') /* a relative one is to be ignored */
        written = snprintf(path, size, "%s/orthostat/rates.json", cache);
    else if (home && home[0])
        written = snprintf(path, size, "%s/.cache/orthostat/rates.json", home);
    return written > 0 && (size_t)written < size;
}

static int unpack_order(json_t *list, int q, OstRates *rates)
{
    json_t *order = json_array_get(list, (size_t)q), *stages = NULL;
    if (json_unpack(order, "{s:F, s:F, s:o}", "small_bytes", &rates->small_bytes[q], "large_bytes",
                    &rates->large_bytes[q], "seconds", &stages) != 0)
        return 0;
    for (int s = 0; s < OST_STAGES; s++) {
        OstRate *rate = &rates->stage[q][s];
        if (json_unpack(stages, "{s:[F, F]}", ost_stage_label[s], &rate->small, &rate->large) != 0 ||
            !(rate->small >= 0.0 && rate->large >= 0.0))
            return 0;
    }
    return 1;
}

static int unpack(json_t *root, OstRates *rates)
{
    const char *machine = NULL, *version = NULL, *day = NULL;
    json_t *orders = NULL;
    if (json_unpack(root, "{s:s, s:s, s:s, s:i, s:F, s:F, s:o}", "machine", &machine, "version", &version, "day", &day,
                    "cores", &rates->cores, "start", &rates->start, "process_bytes", &rates->process_bytes, "orders",
                    &orders) != 0)
        return 0;
    snprintf(rates->machine, sizeof rates->machine, "%s", machine);
    snprintf(rates->version, sizeof rates->version, "%s", version);
    snprintf(rates->day, sizeof rates->day, "%s", day);
    return unpack_order(orders, 0, rates) && unpack_order(orders, 1, rates);
}

static void load(OstContext *ctx, OstRates *rates)
{
    char path[4096];
    json_error_t mistake;
    if (!ost_rates_path(path, sizeof path) || access(path, F_OK) != 0)
        return;
    json_t *root = json_load_file(path, 0, &mistake);
    OstRates found = {0};
    if (root && unpack(root, &found))
        *rates = found;
    else
        ost_warn(ctx, "%s: these rates cannot be read%s%s; `orthostat cost --calibrate` makes the file anew", path,
                 root ? "" : ": ", root ? "" : mistake.text);
    json_decref(root);
}

OstStatus ost_rates_load(OstContext *ctx, OstRates *rates)
{
    *rates = ost_rates_typical();
    if (ost_rank(ctx) == 0)
        load(ctx, rates);
    return ost_broadcast(ctx, sizeof *rates, rates);
}

static json_t *order_json(const OstRates *rates, int q)
{
    json_t *stages = json_object();
    for (int s = 0; s < OST_STAGES; s++)
        json_object_set_new(stages, ost_stage_label[s],
                            json_pack("[f, f]", rates->stage[q][s].small, rates->stage[q][s].large));
    return json_pack("{s:f, s:f, s:o}", "small_bytes", rates->small_bytes[q], "large_bytes", rates->large_bytes[q],
                     "seconds", stages);
}

/* Each folder above the file, from the root down. */
static OstStatus make_folders(OstContext *ctx, const char *path)
{
    char folder[4096];
    snprintf(folder, sizeof folder, "%s", path);
    for (char *slash = strchr(folder + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = 0;
        if (mkdir(folder, 0777) != 0 && errno != EEXIST)
            return OST_RAISE(ctx, OST_FILE_FAILED, "cannot make the folder '%s' for the rates of this machine: %s",
                             folder, strerror(errno));
        *slash = '/';
    }
    return OST_SUCCESS;
}

OstStatus ost_rates_save(OstContext *ctx, const OstRates *rates)
{
    char path[4096];
    if (ost_rank(ctx) != 0)
        return OST_SUCCESS;
    if (!ost_rates_path(path, sizeof path))
        return OST_RAISE(ctx, OST_FILE_FAILED,
                         "there is no place for the rates of this machine: set HOME or XDG_CACHE_HOME");
    OST_TRY(make_folders(ctx, path));
    json_t *root =
        json_pack("{s:s, s:s, s:s, s:i, s:f, s:f, s:[o, o]}", "machine", rates->machine, "version", rates->version,
                  "day", rates->day, "cores", rates->cores, "start", rates->start, "process_bytes",
                  rates->process_bytes, "orders", order_json(rates, 0), order_json(rates, 1));
    if (!root)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "the rates of '%s' cannot be written as JSON", rates->machine);
    return ost_json_write(ctx, root, path);
}

void ost_rates_words(const OstRates *rates, const char *version, char *text, size_t size)
{
    const OstRates here = ost_rates_of_here(version);
    if (rates->typical)
        snprintf(text, size, "typical of %s; `orthostat cost --calibrate` measures this machine", rates->machine);
    else if (strcmp(rates->machine, here.machine) != 0 || rates->cores != here.cores)
        snprintf(text, size, "of another machine (%s, %d cores); `orthostat cost --calibrate` measures this one",
                 rates->machine, rates->cores);
    else if (strcmp(rates->version, version) != 0)
        snprintf(text, size, "of version %s of the program; `orthostat cost --calibrate` measures this one",
                 rates->version);
    else
        snprintf(text, size, "measured on this machine on %s", rates->day);
}
