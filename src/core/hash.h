/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_HASH_H
#define ORTHOSTAT_CORE_HASH_H

#include <stddef.h>
#include <stdint.h>

#define OST_HASH_START UINT64_C(0xcbf29ce484222325)

/* The hash of what was hashed before, then `size` bytes: FNV-1a. It tells files and arrays apart that differ by
 * accident, not by intent. */
static inline uint64_t ost_hash(uint64_t hash, size_t size, const void *bytes)
{
    const unsigned char *at = bytes;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ at[i]) * UINT64_C(0x100000001b3);
    return hash;
}

#endif
