/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/parallel/gather.h"
#include "study/scale/model.h"
#include "study/scale/scale.h"

#include <math.h>
#include <stdio.h>
#include <time.h>

/* Bytes of our own arrays for an unknown, where no run has told yet; and memory of processes with libraries over it. */
static const double usual_bytes = 1400.0, memory_beside = 1.5;

/* A size that is farther than this from what was asked for is not run as one of weak scaling. */
static const double nearest_size = 1.5;

/* The run that foretells another's seconds and bytes: the largest done, with the most ranks up to its own. */
static const OstScaleRun *find_model(const OstScale *scale, const OstScaleRun *run)
{
    const OstScaleRun *best = NULL;
    for (int i = 0; i < scale->run_count; i++) {
        const OstScaleRun *other = &scale->run[i];
        if (other->state == OST_SCALE_DONE && other->ranks <= run->ranks &&
            (!best || other->unknowns > best->unknowns ||
             (other->unknowns == best->unknowns && other->ranks > best->ranks)))
            best = other;
    }
    return best;
}

/* Does the run fit into the study's time and memory? Rank 0 decides, by its clock. */
static int fits(const OstScale *scale, double start, OstScaleRun *run)
{
    const OstScaleVariants *v = &scale->variants;
    const OstScaleRun *model = find_model(scale, run);
    const double unknowns = run->target > 0.0 ? run->target : scale->own_unknowns;
    const double bytes = memory_beside * unknowns * (model ? model->bytes / (double)model->unknowns : usual_bytes);
    const double grown = model ? unknowns / (double)model->unknowns : 0.0;
    const double seconds =
        model ? model->seconds * grown * (run->crowded ? 1.0 : (double)model->ranks / run->ranks) : 0.0;
    if (ost_seconds() - start + seconds > v->max_seconds)
        snprintf(run->reason, sizeof run->reason, "about %.2g s, of %.3g s there are", seconds, v->max_seconds);
    else if (v->max_bytes > 0.0 && bytes > v->max_bytes)
        snprintf(run->reason, sizeof run->reason, "about %.2g GiB of memory, of %.2g GiB there are", bytes / 0x1p30,
                 v->max_bytes / 0x1p30);
    return run->reason[0] == 0;
}

/* Only the linear equations are of interest here, to the residual that the case asks for: nothing is recovered. */
static void simplify(OstCase *c)
{
    c->output_fields = 0;
    c->asks_error = 0;
    c->solver.algebraic_fraction = 0.0;
}

static OstStatus resize(const OstScale *scale, OstCase *c, OstScaleRun *run, int *usable)
{
    *usable = 1;
    if (run->target <= 0.0)
        return OST_SUCCESS;
    const int before = c->refinement;
    ost_scale_resize(c, scale->own_unknowns, run->target);
    const double shape = ost_scale_unknowns(c);
    const double found = shape > 0.0 ? shape : scale->own_unknowns * pow(8.0, c->refinement - before);
    const double miss = found > run->target ? found / run->target : run->target / found;
    if (miss <= nearest_size)
        return OST_SUCCESS;
    *usable = 0;
    snprintf(run->reason, sizeof run->reason,
             "the mesh can be had with about %.3g unknowns, not with %.3g: it is only refined by eights", found,
             run->target);
    return OST_SUCCESS;
}

/* On the ranks that take part. */
static void run_here(const OstScale *scale, OstContext *ctx, OstScaleRun *run)
{
    OstCase *c = NULL;
    int usable = 0;
    ost_log_set_level(ctx, OST_LOG_QUIET);
    OstStatus status = scale->read(ctx, scale->from, &c);
    if (status == OST_SUCCESS) {
        simplify(c);
        status = resize(scale, c, run, &usable);
    }
    if (status == OST_SUCCESS && usable)
        status = ost_scale_measure(c, run);
    run->status = status;
    run->state = status != OST_SUCCESS ? OST_SCALE_FAILED : usable ? OST_SCALE_DONE : OST_SCALE_NOT_RUN;
    if (status != OST_SUCCESS)
        snprintf(run->reason, sizeof run->reason, "%s", ost_error_text(ctx));
    ost_case_destroy(&c);
}

/* Waits for all ranks without taking a core from those that work. */
static OstStatus meet(OstContext *ctx)
{
    MPI_Request request;
    int all = 0;
    OST_TRY(OST_MPI(ctx, MPI_Ibarrier(ost_comm(ctx), &request)));
    while (!all) {
        OST_TRY(OST_MPI(ctx, MPI_Test(&request, &all, MPI_STATUS_IGNORE)));
        if (!all)
            nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
    }
    return OST_SUCCESS;
}

/* The first `run->ranks` ranks run, in a context of their own; all get what they found. */
static OstStatus run_one(OstScale *scale, OstScaleRun *run)
{
    OstContext *ctx = scale->ctx, *own = NULL;
    const int works = ost_rank(ctx) < run->ranks;
    MPI_Comm comm = MPI_COMM_NULL;
    OST_TRY(OST_MPI(ctx, MPI_Comm_split(ost_comm(ctx), works ? 0 : MPI_UNDEFINED, ost_rank(ctx), &comm)));
    OstStatus status = OST_SUCCESS;
    if (works) {
        status = ost_context_create(comm, &own);
        MPI_Comm_free(&comm);
    }
    OST_TRY(ost_agree(ctx, status == OST_SUCCESS ? status : OST_RAISE(ctx, status, "no room for another run")));
    if (works) {
        int cores = 1, ranks = 1;
        status = ost_network_cores(own, &cores, &ranks);
        run->crowded = ranks > cores;
        run_here(scale, own, run);
        ost_context_destroy(&own);
    }
    OST_TRY(meet(ctx));
    OST_TRY(ost_agree(ctx, status));
    return ost_broadcast(ctx, sizeof *run, run);
}

static void announce(const OstScale *scale, const OstScaleRun *run, int number)
{
    char line[160];
    snprintf(line, sizeof line, "run %d of %d: %d ranks, %.3g unknowns", number + 1, scale->run_count, run->ranks,
             run->target > 0.0 ? run->target : scale->own_unknowns);
    ost_log(scale->ctx, OST_LOG_VERBOSE, "%s", line);
    ost_progress_task(scale->ctx, line, number, scale->run_count);
}

static OstStatus decide(OstScale *scale, double start, OstScaleRun *run, int *yes)
{
    OstContext *ctx = scale->ctx;
    if (run->ranks > ost_size(ctx))
        snprintf(run->reason, sizeof run->reason, "the program has %d rank%s: start it with mpirun -n %d",
                 ost_size(ctx), ost_size(ctx) == 1 ? "" : "s", run->ranks);
    *yes = run->reason[0] == 0 && fits(scale, start, run);
    OST_TRY(ost_broadcast(ctx, sizeof *run, run));
    *yes = run->reason[0] == 0;
    if (!*yes)
        run->state = OST_SCALE_NOT_RUN;
    return OST_SUCCESS;
}

OstStatus ost_scale_run(OstScale *scale)
{
    OstContext *ctx = scale->ctx;
    const double start = ost_seconds();
    OstStatus last_failure = OST_SUCCESS;
    int done = 0;
    OST_TRY(ost_network_cores(ctx, &scale->cores, &scale->ranks));
    OST_TRY(ost_network_measure(ctx, &scale->here));
    for (int i = 0; i < scale->run_count; i++) {
        OstScaleRun *run = &scale->run[i];
        int yes = 0;
        OST_TRY(decide(scale, start, run, &yes));
        if (!yes)
            continue;
        announce(scale, run, i);
        OST_TRY(run_one(scale, run));
        if (run->state == OST_SCALE_FAILED)
            last_failure = OST_RAISE(ctx, run->status, "%s", run->reason);
        done += run->state == OST_SCALE_DONE;
    }
    ost_progress_task(ctx, "", 0, 0);
    scale->here.memory = ost_scale_memory_rate(scale);
    scale->seconds = ost_seconds() - start;
    if (done == 0 && last_failure == OST_SUCCESS && scale->run_count > 0)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "no run was made: %s", scale->run[0].reason);
    return done > 0 ? OST_SUCCESS : last_failure;
}
