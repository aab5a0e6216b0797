/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VTK_LZ4_H
#define ORTHOSTAT_FORMATS_VTK_LZ4_H

#include <stddef.h>

/* Local. Unpacks a block of LZ4 (LZ4 block format description, Y. Collet); returns whether it fills `size` bytes. */
int ost_lz4_unpack(const unsigned char *packed, size_t packed_size, unsigned char *data, size_t size);

#endif
