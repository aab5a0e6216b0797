/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VTKHDF_HDF5_H
#define ORTHOSTAT_FORMATS_VTKHDF_HDF5_H

#include "orthostat/context.h"

#include <hdf5.h>

/* HDF5 with our statuses: its error stack becomes our message, and it prints nothing while a file is open here. */

/* An open file, written by all ranks together or read by each on its own. */
typedef struct OstHdf5 {
    OstContext *ctx;
    const char *path; /* for messages; not owned */
    hid_t file;
    int opened;         /* descriptor of a file with a long path, or -1 */
    hid_t transfer;     /* transfer mode: collective, or each rank alone */
    hid_t links;        /* creates the groups in a dataset's path */
    size_t block_bytes; /* largest transfer of a rank at once: MPI counts bytes in 32 bits */
    H5E_auto2_t printer;
    void *printer_data;
} OstHdf5;

/* This rank's rows of an array, in which those of rank 0 come first, then those of rank 1, ... */
typedef struct OstRows {
    OstGlobal first, count;
    OstGlobal total; /* of all ranks */
    OstGlobal most;  /* of any rank */
} OstRows;

/* Collective. The rows of an array of which this rank has `count`. */
OstStatus ost_rows_create(OstContext *ctx, OstGlobal count, OstRows *rows);

/* Collective. Creates or empties a file that all ranks write. Close it even after a failure. */
OstStatus ost_hdf5_create(OstContext *ctx, const char *path, OstHdf5 *h5);

/* Local. Opens a file for reading by this rank alone, so that a damaged file fails here and no rank waits for another.
 * Close it even after a failure. */
OstStatus ost_hdf5_open(OstContext *ctx, const char *path, OstHdf5 *h5);

/* Local. Opens a file that is there and closed, to add to it by this rank alone. Close it even after a failure. */
OstStatus ost_hdf5_reopen(OstContext *ctx, const char *path, OstHdf5 *h5);

/* Collective for a file that was created, else local. Raises OST_FILE_FAILED if not all was written. */
OstStatus ost_hdf5_close(OstHdf5 *h5);

/* Local. Closes a dataset, type, space, ... unless it could not be opened. */
static inline void ost_hdf5_release(hid_t object)
{
    if (object >= 0)
        H5Idec_ref(object);
}

/* Local. Raises OST_FILE_FAILED as "path: could not <action>: <HDF5's innermost reason>". */
OstStatus ost_hdf5_raise(const OstHdf5 *h5, const char *action, const char *name);

/* Collective. Writes a new dataset of rows with `components` numbers each (one-dimensional if 1), and creates the
 * groups in its name. */
OstStatus ost_hdf5_write_rows(OstHdf5 *h5, const char *name, hid_t type, int components, const OstRows *rows,
                              const void *values);

/* Collective. Writes step `step` of `steps`: a dataset has the rows of all of them, one after the other, and step 0
 * creates it. */
OstStatus ost_hdf5_write_step(OstHdf5 *h5, const char *name, hid_t type, int components, const OstRows *rows, int step,
                              int steps, const void *values);

/* Collective. Attributes of a group: a few integers (a scalar if `count` is 0), a string of fixed length. */
OstStatus ost_hdf5_write_integers(OstHdf5 *h5, const char *group, const char *name, int count, const int *values);
OstStatus ost_hdf5_write_text(OstHdf5 *h5, const char *group, const char *name, const char *text);

/* Local. Is there a link of this name, and a group for each part of its path? */
int ost_hdf5_has(const OstHdf5 *h5, const char *name);

/* Local. The shape of a dataset; raises OST_INVALID_INPUT unless it exists and has one or two dimensions. */
OstStatus ost_hdf5_shape(const OstHdf5 *h5, const char *name, OstGlobal *rows, int *components);

/* Local. Rows first .. first + count - 1 of a dataset that must have `total` rows of `components` numbers (integers if
 * `type` is one). Raises OST_INVALID_INPUT if the dataset has another shape or type, OST_FILE_FAILED if it cannot be
 * read. */
OstStatus ost_hdf5_read_rows(const OstHdf5 *h5, const char *name, hid_t type, int components, OstGlobal total,
                             OstGlobal first, OstGlobal count, void *values);

/* Local. For a dry run: makes HDF5 read enough of a dataset, if there is one, to meet any fault in it. Contiguous rows
 * are read in order or refused whatever their number, so one is read; of chunked or external rows, which HDF5 must find
 * and decompress, this rank's share. */
OstStatus ost_hdf5_try_rows(const OstHdf5 *h5, const char *name, hid_t type);

/* Local. Attributes; raise OST_INVALID_INPUT if missing or of another kind. */
OstStatus ost_hdf5_read_integers(const OstHdf5 *h5, const char *group, const char *name, int count, int *values);
OstStatus ost_hdf5_read_text(const OstHdf5 *h5, const char *group, const char *name, char *text, size_t size);

/* Collective / local. A list of names as strings of one length. */
OstStatus ost_hdf5_write_names(OstHdf5 *h5, const char *name, int count, char *const *names);
OstStatus ost_hdf5_read_names(const OstHdf5 *h5, const char *name, int *count, char ***names);

/* Local. Adds a new dataset of strings of any length to a file that is closed: VTK reads no others, and HDF5 writes
 * them on one rank alone. */
OstStatus ost_hdf5_add_texts(OstContext *ctx, const char *path, const char *name, int count, const char *const *texts);

#endif
