/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/forecast/calibrate.h"

#include "core/error.h"
#include "core/json_file.h"
#include "core/memory.h"
#include "core/parallel/gather.h"
#include "orthostat/scene.h"
#include "problem/result_data.h"
#include "problem/scene_data.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

typedef enum { SHOWN, SMALL, LARGE } Part; /* what a body is for: to be foretold alone, or to take a rate from */

#define STEEL "youngs_modulus: 1e6, poissons_ratio: 0.3"
#define ALONG                                                                                                     \
    "youngs_modulus: [1e9, 1e6, 1e6], poissons_ratio: 0.3, axes: {cylindrical: {origin: [0, 0, 0], axis: [0, 1, " \
    "0], order: [axial, radial, tangential]}}"
#define TUBE(around, radial, axial)                                                                    \
    "tube: {axis: y, length: 10, radii: [0.9, 1.5], divisions: {around: " #around ", radial: " #radial \
    ", axial: " #axial "}}",                                                                           \
        "ends"
#define WALL(around, axial)                                                                                           \
    "tube: {axis: y, length: 10, radii: [1.4, 1.5], divisions: {around: " #around ", radial: 1, axial: " #axial "}}", \
        "ends"
#define BLOCK(x, y, z) "block: {size: [" #x ", " #y ", " #z "], divisions: [" #x ", " #y ", " #z "]}", "xmin"

static const struct {
    const char *name, *mesh, *support;
    int order;
    Part part;
    const char *material;
} bodies[OST_CALIBRATION_RUNS] = {
    {"small wall", WALL(32, 32), 1, SMALL, STEEL},
    {"small block", BLOCK(13, 13, 13), 1, SMALL, STEEL},
    {"wall", WALL(110, 110), 1, LARGE, STEEL},
    {"block", BLOCK(28, 28, 28), 1, LARGE, STEEL},
    {"small wall", WALL(20, 20), 2, SMALL, STEEL},
    {"small block", BLOCK(7, 7, 7), 2, SMALL, STEEL},
    {"wall", WALL(50, 50), 2, LARGE, STEEL},
    {"block", BLOCK(15, 15, 15), 2, LARGE, STEEL},
    {"beam", BLOCK(80, 8, 8), 1, SHOWN, STEEL},
    {"beam", BLOCK(50, 5, 5), 2, SHOWN, STEEL},
    {"tube", TUBE(60, 6, 60), 1, SHOWN, STEEL},
    {"tube", TUBE(32, 3, 32), 2, SHOWN, STEEL},
    {"tube, stiff along", TUBE(60, 6, 60), 1, SHOWN, ALONG},
    {"tube, stiff along", TUBE(32, 3, 32), 2, SHOWN, ALONG},
};

/* Short runs are repeated more often: what else the machine does may take as long as they do. Not at all after so many
 * seconds. */
enum { REPEATS = 3, MOST_REPEATS = 12 };
static const double short_in_all = 1.0, long_enough = 2.5;

typedef struct Body {
    OstCase *c;
    OstPlan plan;
} Body;

static OstStatus read_body(OstContext *ctx, int b, OstCase **c)
{
    char text[1024];
    snprintf(text, sizeof text,
             "title: %s\nmesh:\n  %s\nelement: {order: %d}\nmaterials: [{region: all, %s}]\n"
             "constraints: [{on: {boundary: %s}, displacement: [0, 0, 0]}]\nloads: [{body_force: [0, 0, -1]}]\n"
             "large_rotation: off\n",
             bodies[b].name, bodies[b].mesh, bodies[b].order, bodies[b].material, bodies[b].support);
    return ost_case_parse(ctx, "calibration", text, c);
}

/* To a file that goes at once. */
static OstStatus write_fields(const Body *body, OstResult *result)
{
    const char *folder = getenv("TMPDIR");
    OstContext *ctx = body->c->ctx;
    int id = (int)getpid();
    char path[4096];
    OST_TRY(ost_broadcast(ctx, sizeof id, &id));
    snprintf(path, sizeof path, "%s/orthostat-calibration-%d.vtkhdf", folder && folder[0] ? folder : "/tmp", id);
    const OstStatus status = ost_result_write(result, body->c->output_fields, path);
    if (ost_rank(ctx) == 0)
        remove(path);
    return status;
}

static OstStatus run_once(const Body *body, OstCalibrationRun *run)
{
    OstScene *scene = NULL;
    OstResult *result = NULL;
    OstMeter meter;
    OstStatus status = ost_meter_start(body->c->ctx, &meter);
    OST_THEN(ost_scene_create(body->c, &scene));
    OST_THEN(ost_scene_solve(scene, &result));
    OST_THEN(write_fields(body, result));
    OST_THEN(ost_meter_read(body->c->ctx, &meter));
    if (status == OST_SUCCESS) {
        run->unknowns = result->unknowns;
        run->iterations = result->solve.iterations;
        run->bytes = meter.bytes;
        run->seconds = meter.seconds;
        ost_stage_sum(&meter, run->stage);
    }
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    return status;
}

/* Keeps the least that each stage took: other work on the machine makes stages slower only. */
static void keep_least(const OstCalibrationRun *again, OstCalibrationRun *run)
{
    run->seconds = 0.0;
    for (int s = 0; s < OST_STAGES; s++) {
        run->stage[s] = fmin(run->stage[s], again->stage[s]);
        run->seconds += run->stage[s];
    }
}

static OstStatus run_body(int b, Body *body, OstCalibrationRun *run)
{
    OstContext *ctx = body->c->ctx;
    OstPlanMesh mesh = {.quadratic = bodies[b].order == 2};
    double spent = 0.0;
    ost_plan_shape_size(body->c, &mesh.nodes, &mesh.tets);
    ost_plan_make(body->c, &mesh, ost_size(ctx), &body->plan);
    *run = (OstCalibrationRun){.name = bodies[b].name, .order = bodies[b].order, .counts = bodies[b].part != SHOWN};
    for (int i = 0; spent < (i < REPEATS ? long_enough : short_in_all) && i < MOST_REPEATS; i++) {
        OstCalibrationRun again = *run;
        OST_TRY(run_once(body, &again));
        OST_TRY(ost_broadcast(ctx, sizeof again.seconds, &again.seconds));
        spent += again.seconds;
        if (i == 0)
            *run = again;
        keep_least(&again, run);
    }
    return OST_SUCCESS;
}

/* The seconds of a unit of work: the geometric mean of the runs of this order and size, a thin body and a solid one. */
static double rate_of(const OstCalibration *calibration, const Body *body, int order, Part part, OstStage stage,
                      int ranks)
{
    double sum = 0.0;
    int count = 0;
    for (int b = 0; b < OST_CALIBRATION_RUNS; b++) {
        double work[OST_STAGES];
        const OstCalibrationRun *run = &calibration->run[b];
        if (bodies[b].order != order || bodies[b].part != part)
            continue;
        ost_forecast_work(body[b].c, &body[b].plan, run->iterations, work);
        if (!(work[stage] > 0.0 && run->stage[stage] > 0.0))
            return 0.0;
        sum += log(run->stage[stage] * ranks / work[stage]);
        count++;
    }
    return exp(sum / count);
}

static double bytes_of(const Body *body, int order, Part part, int ranks)
{
    double sum = 0.0;
    int count = 0;
    for (int b = 0; b < OST_CALIBRATION_RUNS; b++)
        if (bodies[b].order == order && bodies[b].part == part) {
            sum += log(body[b].plan.bytes_in_all / ranks);
            count++;
        }
    return exp(sum / count);
}

static void fit(const Body *body, int ranks, OstCalibration *calibration)
{
    OstRates *rates = &calibration->rates;
    for (int q = 0; q < 2; q++) {
        rates->small_bytes[q] = bytes_of(body, q + 1, SMALL, ranks);
        rates->large_bytes[q] = bytes_of(body, q + 1, LARGE, ranks);
        for (int s = 0; s < OST_STAGES; s++)
            rates->stage[q][s] = (OstRate){.small = rate_of(calibration, body, q + 1, SMALL, (OstStage)s, ranks),
                                           .large = rate_of(calibration, body, q + 1, LARGE, (OstStage)s, ranks)};
    }
}

/* Since the process began, less what the ledger has seen. */
static double start_seconds(OstContext *ctx)
{
    FILE *file = fopen("/proc/self/stat", "r");
    struct timespec now;
    double age = 0.0, booked = 0.0;
    unsigned long long ticks = 0;
    if (file &&
        fscanf(file, "%*d (%*[^)]) %*c %*d %*d %*d %*d %*d %*u %*u %*u %*u %*u %*u %*u %*d %*d %*d %*d %*d %*d %llu",
               &ticks) == 1 &&
        clock_gettime(CLOCK_BOOTTIME, &now) == 0)
        age = (double)now.tv_sec + 1e-9 * (double)now.tv_nsec - (double)ticks / (double)sysconf(_SC_CLK_TCK);
    if (file)
        fclose(file);
    for (int a = 0; a < OST_EFFECT_END; a++)
        booked += ost_ledger_entry(ctx, a).seconds;
    return fmin(fmax(age - booked, 0.0), 60.0);
}

/* What the first run leaves of the process beside its arrays: the program and its libraries. */
static double process_bytes(OstContext *ctx)
{
    struct rusage usage;
    const double peak = getrusage(RUSAGE_SELF, &usage) == 0 ? 1024.0 * (double)usage.ru_maxrss : 0.0;
    return fmax(peak - (double)ost_ledger_peak_bytes(ctx), 0.0);
}

static OstStatus run_all(OstContext *ctx, Body *body, OstCalibration *calibration)
{
    const int ranks = ost_size(ctx);
    for (int b = 0; b < OST_CALIBRATION_RUNS; b++) {
        ost_progress_task(ctx, bodies[b].name, b, OST_CALIBRATION_RUNS);
        OST_TRY(read_body(ctx, b, &body[b].c));
        OST_TRY(run_body(b, &body[b], &calibration->run[b]));
        calibration->count = b + 1;
        if (b == 0)
            calibration->rates.process_bytes = process_bytes(ctx);
    }
    fit(body, ranks, calibration);
    for (int b = 0; b < OST_CALIBRATION_RUNS; b++)
        ost_forecast_make(body[b].c, &body[b].plan, &calibration->rates, ranks, &calibration->run[b].foretold);
    return ost_broadcast(ctx, sizeof calibration->rates, &calibration->rates);
}

OstStatus ost_calibrate(OstContext *ctx, const char *version, OstCalibration *calibration)
{
    const OstLogLevel level = ost_log_level(ctx);
    Body *body = NULL;
    memset(calibration, 0, sizeof *calibration);
    calibration->rates = ost_rates_of_here(version);
    calibration->rates.start = start_seconds(ctx);
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &body, OST_CALIBRATION_RUNS)));
    if (level == OST_LOG_NORMAL) /* the bodies' warnings are of no interest */
        ost_log_set_level(ctx, OST_LOG_QUIET);
    const OstStatus status = run_all(ctx, body, calibration);
    ost_log_set_level(ctx, level);
    ost_progress_task(ctx, "", 0, 0);
    for (int b = 0; b < OST_CALIBRATION_RUNS; b++)
        ost_case_destroy(&body[b].c);
    OST_FREE(body);
    return status;
}

void ost_calibration_print(const OstContext *ctx, const OstCalibration *calibration)
{
    if (ost_rank(ctx) != 0)
        return;
    printf("%-18s %5s %10s %17s %17s %26s\n%-18s %5s %10s %17s %17s %26s\n", "", "", "", "iterations", "MiB", "seconds",
           "body", "order", "unknowns", "foretold, taken", "foretold, taken", "foretold, taken, ratio");
    for (int b = 0; b < calibration->count; b++) {
        const OstCalibrationRun *run = &calibration->run[b];
        const double foretold = run->foretold.in_all - run->foretold.start;
        printf("%-18s %5d %10lld %8.0f %8.0f %8.1f %8.1f %9.3f %8.3f %7.2f%s\n", run->name, run->order,
               (long long)run->unknowns, run->foretold.iterations, run->iterations, run->foretold.bytes / 0x1p20,
               run->bytes / 0x1p20, foretold, run->seconds, foretold / run->seconds, run->counts ? "" : "  not fitted");
    }
    printf("start of the program: %.2f s and %.0f MiB a process\n", calibration->rates.start,
           calibration->rates.process_bytes / 0x1p20);
}

OstStatus ost_calibration_write_json(OstContext *ctx, const OstCalibration *calibration, const char *path)
{
    if (ost_rank(ctx) != 0)
        return OST_SUCCESS;
    json_t *runs = json_array();
    for (int b = 0; b < calibration->count; b++) {
        const OstCalibrationRun *run = &calibration->run[b];
        json_t *stages = json_object();
        for (int s = 0; s < OST_STAGES; s++)
            json_object_set_new(stages, ost_stage_label[s],
                                json_pack("{s:f, s:f}", "foretold", run->foretold.seconds[s], "taken", run->stage[s]));
        json_array_append_new(
            runs, json_pack("{s:s, s:i, s:b, s:I, s:{s:f, s:f}, s:{s:f, s:f}, s:{s:f, s:f}, s:o}", "body", run->name,
                            "order", run->order, "fitted", run->counts, "unknowns", (json_int_t)run->unknowns,
                            "iterations", "foretold", run->foretold.iterations, "taken", run->iterations, "bytes",
                            "foretold", run->foretold.bytes, "taken", run->bytes, "seconds", "foretold",
                            run->foretold.in_all - run->foretold.start, "taken", run->seconds, "stages", stages));
    }
    json_t *root = json_pack("{s:s, s:s, s:s, s:i, s:i, s:f, s:f, s:o}", "machine", calibration->rates.machine,
                             "version", calibration->rates.version, "day", calibration->rates.day, "cores",
                             calibration->rates.cores, "ranks", ost_size(ctx), "start", calibration->rates.start,
                             "process_bytes", calibration->rates.process_bytes, "runs", runs);
    if (!root)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "the calibration cannot be written as JSON");
    return ost_json_write(ctx, root, path);
}
