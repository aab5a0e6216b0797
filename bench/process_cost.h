/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_BENCH_PROCESS_COST_H
#define ORTHOSTAT_BENCH_PROCESS_COST_H

/* This process's resident memory, in bytes, as the kernel counts it: now, and at its most. */
double resident_bytes(void);
double peak_resident_bytes(void);

/* Gives free memory back to the kernel and starts the peak anew, so that it tells of the solver and not of the reading
 * of files before it. */
void restart_peak_resident(void);

/* Processor seconds of this process so far: what other work on the machine cannot lengthen, as it does the clock's. */
double processor_seconds(void);

#endif
