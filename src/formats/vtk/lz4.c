/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtk/lz4.h"

#include <string.h>

/* A block is a row of sequences: a token of two lengths, literals, and (but in the last) a match with what was unpacked
 * before. A length of 15 goes on in the bytes that follow, up to one below 255. */
enum { LONG = 15, GOES_ON = 255, LEAST_MATCH = 4 };

static int read_length(const unsigned char **at, const unsigned char *end, size_t *length)
{
    unsigned char more = GOES_ON;
    if (*length < LONG)
        return 1;
    while (more == GOES_ON) {
        if (*at == end)
            return 0;
        more = *(*at)++;
        *length += more;
    }
    return 1;
}

int ost_lz4_unpack(const unsigned char *packed, size_t packed_size, unsigned char *data, size_t size)
{
    const unsigned char *at = packed, *end = packed + packed_size;
    size_t done = 0;
    while (at < end) {
        const unsigned token = *at++;
        size_t literals = token >> 4, match = token & 15;
        if (!read_length(&at, end, &literals) || literals > (size_t)(end - at) || literals > size - done)
            return 0;
        memcpy(data + done, at, literals);
        at += literals;
        done += literals;
        if (at == end)
            break;
        if (end - at < 2)
            return 0;
        const size_t back = at[0] | (size_t)at[1] << 8;
        at += 2;
        if (!read_length(&at, end, &match) || back == 0 || back > done || match + LEAST_MATCH > size - done)
            return 0;
        for (match += LEAST_MATCH; match > 0; match--, done++) /* it may overlap itself */
            data[done] = data[done - back];
    }
    return done == size;
}
