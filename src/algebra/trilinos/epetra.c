/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/trilinos/epetra.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"

#include <limits.h>

/* Epetra_ConfigDefs.h is C++ only. The C wrappers only need to know from it that Epetra has MPI. */
#define EPETRA_CONFIGDEFS_H
#define EPETRA_MPI
#include <Epetra_C_wrappers.h>

enum { EPETRA_VIEW = 0 }; /* for the wrappers, 1 copies the values and anything else uses them in place */

struct OstEpetraMap {
    OstContext *ctx;
    EPETRA_OBJECT_PTR communicator;
    EPETRA_OBJECT_PTR map;
};

void ost_epetra_map_destroy(OstEpetraMap **map)
{
    if (!*map)
        return;
    if ((*map)->map)
        epetra_map_destroy((*map)->map);
    if ((*map)->communicator)
        epetra_comm_destroy((*map)->communicator);
    OST_FREE(*map);
}

OstStatus ost_epetra_map_create(OstContext *ctx, OstLocal count, OstEpetraMap **map)
{
    OstEpetraMap *made = NULL;
    MPI_Comm comm = ost_comm(ctx);
    OstGlobal total = count;
    OstStatus status;
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &made, 1)));
    OST_TRY_DONE(ost_sum_numbers(ctx, 1, &total));
    /* The map is a 32-bit one: in Trilinos 13 the C wrapper for a 64-bit map cannot be called, as the library defines
     * it with other argument types than its header, under a C++ name. */
    if (total > INT_MAX)
        OST_TRY_DONE(
            OST_RAISE(ctx, OST_LIMIT_EXCEEDED,
                      "%lld unknowns are more than Epetra's C interface can number (2^31 - 1); use a smaller mesh",
                      (long long)total));
    made->ctx = ctx;
    made->communicator = epetra_mpicomm_create2(&comm);
    if (made->communicator)
        made->map = epetra_map_create2(-1, count, 0, made->communicator);
    if (!made->map || epetra_map_nummyelements(made->map) != count)
        status = OST_RAISE(ctx, OST_LIBRARY_FAILED, "Epetra could not make a map of %d unknowns", count);
    status = ost_agree(ctx, status);
done:
    if (status != OST_SUCCESS)
        ost_epetra_map_destroy(&made);
    *map = made;
    return status;
}

OstStatus ost_epetra_norm(const OstEpetraMap *map, const double *values, double *norm)
{
    /* The wrappers have no const; the norm does not write. */
    EPETRA_OBJECT_PTR vector = epetra_vector_create2(EPETRA_VIEW, map->map, (double *)(uintptr_t)values);
    const int error = vector ? epetra_vector_norm2(vector, norm) : -1;
    if (vector)
        epetra_vector_destroy(vector);
    if (error != 0)
        return OST_RAISE(map->ctx, OST_LIBRARY_FAILED, "Epetra's norm failed with code %d", error);
    return OST_SUCCESS;
}
