/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_EXODUS_NETCDF_H
#define ORTHOSTAT_FORMATS_EXODUS_NETCDF_H

#include "formats/vtkhdf/dry_run.h"

/* netCDF with our statuses: classic files (CDF-1, 2, 5) and those of netCDF-4, which are HDF5. */

enum { OST_NETCDF_NAME = 256, OST_NETCDF_PIECE = 4096 };

/* Local. Tries a reading in a process of its own, as ost_hdf5_dry_run does: both libraries trust what a file says. */
OstStatus ost_netcdf_dry_run(OstContext *ctx, const char *path, OstReading *read, const char *name);

/* An open file. A dry run reads of contiguous arrays the first piece alone. */
typedef struct OstNetcdf {
    OstContext *ctx;
    const char *path; /* for messages; not owned */
    int file, opened; /* `opened` tells whether there is one */
    int dry;
    double bytes; /* size of the file */
} OstNetcdf;

/* Local. Raises OST_FILE_FAILED for a file that is not of netCDF, or shorter than it says. Close it even after a
 * failure. */
OstStatus ost_netcdf_open(OstContext *ctx, const char *path, int dry, OstNetcdf *nc);
void ost_netcdf_close(OstNetcdf *nc);

/* Local. The size of a dimension; 0 if there is none. */
OstStatus ost_netcdf_dimension(const OstNetcdf *nc, const char *name, OstLocal *size);

/* Local. An attribute of a variable, and row `row` of an array of texts; "" if there is none. */
void ost_netcdf_attribute(const OstNetcdf *nc, const char *variable, const char *name, char text[OST_NETCDF_NAME]);
OstStatus ost_netcdf_text(const OstNetcdf *nc, const char *variable, OstLocal row, char text[OST_NETCDF_NAME]);

/* The rows of an array, which are read piece by piece. */
typedef struct OstNetcdfRows {
    const OstNetcdf *nc;
    char name[OST_NETCDF_NAME];
    int found; /* is there such a variable? */
    int id, dimensions, leading, contiguous;
    OstLocal total, width; /* rows, and numbers in each */
    OstLocal first, count; /* of the piece that was read: rows `first` .. `first + count - 1` */
    size_t at[3], size[3];
    union {
        long long integer[OST_NETCDF_PIECE];
        double real[OST_NETCDF_PIECE];
    };
} OstNetcdfRows;

/* Local. Rows of the variable with its first `leading` indices (0 or 1) fixed: `index`, or the last if it is -1. One or
 * two dimensions must be left, of rows and the numbers in each. No rows if there is no such variable. */
OstStatus ost_netcdf_rows(const OstNetcdf *nc, const char *variable, int leading, OstGlobal index, OstNetcdfRows *rows);

/* Local. The next piece, as integers or reals; a count of 0 after the last. */
OstStatus ost_netcdf_integers(OstNetcdfRows *rows);
OstStatus ost_netcdf_reals(OstNetcdfRows *rows);

#endif
