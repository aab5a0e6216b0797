/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/address_space.h"

#include <sys/mman.h>

extern void dpotrf_(const char *uplo, const int *n, double *a, const int *leading, int *info, size_t length);

int ost_address_space_has(size_t mebibytes)
{
    const size_t bytes = mebibytes << 20;
    void *tried = mmap(NULL, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    return tried != MAP_FAILED && munmap(tried, bytes) == 0;
}

int ost_start_blas(void)
{
    enum { BUFFER_MIB = 160 };
    const int n = 1;
    int info = 0;
    double one = 1.0;
    if (!ost_address_space_has(BUFFER_MIB))
        return 0;
    dpotrf_("L", &n, &one, &n, &info, 1);
    return info == 0;
}
