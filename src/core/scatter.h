/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_SCATTER_H
#define ORTHOSTAT_CORE_SCATTER_H

#include <stdint.h>

/* Pseudorandom bits that depend on the number alone, so that they are the same on any number of ranks: SplitMix64
 * (Steele, Lea, Flood, Fast splittable pseudorandom number generators, OOPSLA 2014). */
static inline uint64_t ost_scatter(uint64_t number)
{
    number = (number + 1) * UINT64_C(0x9e3779b97f4a7c15);
    number = (number ^ (number >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    number = (number ^ (number >> 27)) * UINT64_C(0x94d049bb133111eb);
    return number ^ (number >> 31);
}

#endif
