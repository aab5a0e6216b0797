/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/scale/network.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/gather.h"

#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SHORT_MESSAGES = 200, LONG_MESSAGES = 8, LONG_BYTES = 1 << 20, PARTNERS = 3, TAG = 7373 };

/* By the makers' figures: HDR InfiniBand and two sockets of 32 cores; 10 Gbit Ethernet; and a laptop's memory, through
 * which its ranks also pass messages. */
static const OstNetwork known[] = {
    {"infiniband", 2e-6, 25e9, 300e9, 64.0},
    {"ethernet", 25e-6, 1.25e9, 300e9, 64.0},
    {"laptop", 0.5e-6, 5e9, 20e9, 4.0},
};
enum { KNOWN = sizeof known / sizeof known[0] };

const char *ost_network_names(void)
{
    return "infiniband, ethernet, laptop";
}

/* One "key=number" of the list. */
static int read_item(const char *item, size_t length, OstNetwork *network)
{
    const struct {
        const char *key;
        double *value;
    } keys[] = {{"latency=", &network->latency},
                {"bandwidth=", &network->bandwidth},
                {"memory=", &network->memory},
                {"ranks=", &network->ranks}};
    for (size_t k = 0; k < sizeof keys / sizeof keys[0]; k++) {
        const size_t width = strlen(keys[k].key);
        char *end = NULL;
        if (strncmp(item, keys[k].key, width) != 0)
            continue;
        *keys[k].value = strtod(item + width, &end);
        return end == item + length && end > item + width && *keys[k].value > 0.0 && *keys[k].value < 1e300;
    }
    return 0;
}

int ost_network_parse(const char *text, OstNetwork *network)
{
    for (int k = 0; k < KNOWN; k++)
        if (strcmp(text, known[k].name) == 0) {
            *network = known[k];
            return 1;
        }
    *network = known[0];
    snprintf(network->name, sizeof network->name, "as given");
    for (const char *item = text;;) {
        const size_t length = strcspn(item, ",");
        if (!read_item(item, length, network))
            return 0;
        if (item[length] == 0)
            return network->ranks >= 1.0;
        item += length + 1;
    }
}

/* Seconds of one message: half of there and back, the least of three tries. */
static OstStatus time_messages(OstContext *ctx, int partner, int count, int bytes, char *room, double *seconds)
{
    const MPI_Comm comm = ost_comm(ctx);
    const int first = ost_rank(ctx) == 0;
    const int other = first ? partner : 0;
    for (int try = 0; try < 3; try++) {
        const double start = ost_seconds();
        for (int m = 0; m < count; m++) {
            if (first)
                OST_TRY(OST_MPI(ctx, MPI_Send(room, bytes, MPI_BYTE, other, TAG, comm)));
            OST_TRY(OST_MPI(ctx, MPI_Recv(room, bytes, MPI_BYTE, other, TAG, comm, MPI_STATUS_IGNORE)));
            if (!first)
                OST_TRY(OST_MPI(ctx, MPI_Send(room, bytes, MPI_BYTE, other, TAG, comm)));
        }
        const double one = (ost_seconds() - start) / (2.0 * count);
        if (try == 0 || one < *seconds)
            *seconds = one;
    }
    return OST_SUCCESS;
}

static OstStatus measure(OstContext *ctx, char *room, OstNetwork *network)
{
    for (int partner = 1; partner <= PARTNERS && partner < ost_size(ctx); partner++) {
        double brief = 0.0, whole = 0.0;
        OST_TRY(OST_MPI(ctx, MPI_Barrier(ost_comm(ctx))));
        if (ost_rank(ctx) != 0 && ost_rank(ctx) != partner)
            continue;
        OST_TRY(time_messages(ctx, partner, SHORT_MESSAGES, 8, room, &brief));
        OST_TRY(time_messages(ctx, partner, LONG_MESSAGES, LONG_BYTES, room, &whole));
        network->latency = brief > network->latency ? brief : network->latency;
        const double bandwidth = whole > brief ? LONG_BYTES / (whole - brief) : 0.0;
        if (network->bandwidth == 0.0 || bandwidth < network->bandwidth)
            network->bandwidth = bandwidth;
    }
    double both[2] = {network->latency, network->bandwidth};
    OST_TRY(ost_broadcast(ctx, sizeof both, both));
    network->latency = both[0];
    network->bandwidth = both[1];
    return OST_SUCCESS;
}

OstStatus ost_network_measure(OstContext *ctx, OstNetwork *network)
{
    char *room = NULL;
    int cores = 1, ranks = 1;
    *network = (OstNetwork){.name = "this machine"};
    OST_TRY(ost_network_cores(ctx, &cores, &ranks));
    network->ranks = ranks;
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, &room, LONG_BYTES));
    OST_THEN(ost_agree(ctx, measure(ctx, room, network)));
    OST_FREE(room);
    network->bandwidth *= ranks; /* as if every rank had it to itself: ranks of one machine copy through its memory */
    return status;
}

static int count_cores(const cpu_set_t *mine, MPI_Comm machine, int *cores)
{
    cpu_set_t all;
    const int result = MPI_Allreduce(mine, &all, (int)sizeof all, MPI_BYTE, MPI_BOR, machine);
    *cores = CPU_COUNT(&all);
    return result;
}

OstStatus ost_network_cores(OstContext *ctx, int *cores, int *ranks)
{
    MPI_Comm machine;
    cpu_set_t mine;
    CPU_ZERO(&mine);
    sched_getaffinity(0, sizeof mine, &mine); /* on failure the set stays empty, and counts as one core */
    OST_TRY(
        OST_MPI(ctx, MPI_Comm_split_type(ost_comm(ctx), MPI_COMM_TYPE_SHARED, ost_rank(ctx), MPI_INFO_NULL, &machine)));
    OstStatus status = OST_MPI(ctx, MPI_Comm_size(machine, ranks));
    OST_THEN(OST_MPI(ctx, count_cores(&mine, machine, cores)));
    MPI_Comm_free(&machine);
    OST_TRY(ost_agree(ctx, status));
    *cores = *cores > 0 ? *cores : 1;
    struct {
        double share;
        int rank;
    } worst = {(double)*ranks / *cores, ost_rank(ctx)};
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE_INT, MPI_MAXLOC, ost_comm(ctx))));
    int both[2] = {*cores, *ranks};
    OST_TRY(OST_MPI(ctx, MPI_Bcast(both, 2, MPI_INT, worst.rank, ost_comm(ctx))));
    *cores = both[0];
    *ranks = both[1];
    return OST_SUCCESS;
}
