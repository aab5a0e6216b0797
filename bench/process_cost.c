/* SPDX-License-Identifier: BSD-3-Clause */
#include "process_cost.h"

#include <malloc.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

/* A number of /proc/self/status that is given in kB; 0 where there is none. */
static double status_bytes(const char *key)
{
    char line[256];
    double kilobytes = 0.0;
    FILE *stream = fopen("/proc/self/status", "r");
    if (!stream)
        return 0.0;
    while (fgets(line, sizeof line, stream))
        if (strncmp(line, key, strlen(key)) == 0)
            sscanf(line + strlen(key), ": %lf", &kilobytes);
    fclose(stream);
    return 1024.0 * kilobytes;
}

double resident_bytes(void)
{
    return status_bytes("VmRSS");
}

double peak_resident_bytes(void)
{
    return status_bytes("VmHWM");
}

void restart_peak_resident(void)
{
    malloc_trim(0);
    FILE *stream = fopen("/proc/self/clear_refs", "w");
    if (!stream)
        return;
    fputs("5", stream); /* proc(5): resets the peak resident set size */
    fclose(stream);
}

double processor_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
