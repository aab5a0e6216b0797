/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_KERNEL_H
#define ORTHOSTAT_CORE_KERNEL_H

/* Before a function that takes much of a run's time. Where the program is built for any x86-64 (ORTHOSTAT_NATIVE=OFF)
 * the compiler makes it three times, and the loader chooses by the processor: SSE2, AVX2, AVX-512. What it calls must
 * be inlined to take part. */
#ifdef ORTHOSTAT_CLONES
#define OST_KERNEL __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define OST_KERNEL
#endif

#endif
