/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/exodus/netcdf.h"

#include "core/error.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <netcdf.h>
#include <netcdf_filter.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Deflate compresses by less than this. */
enum { LARGEST_COMPRESSION = 1100 };

/* A lack of memory ends a dry run: without its limit the real reading would go on. */
static OstStatus raise(const OstNetcdf *nc, const char *what, int error)
{
    return OST_RAISE(nc->ctx, error == NC_ENOMEM ? OST_OUT_OF_MEMORY : OST_FILE_FAILED, "%s: %s could not be read: %s",
                     nc->path, what, nc_strerror(error));
}

OstStatus ost_netcdf_dry_run(OstContext *ctx, const char *path, OstReading *read_file, const char *name)
{
    nc_initialize(); /* here and not there, where it would undo the dry run's handler of HDF5's errors */
    return ost_hdf5_dry_run(ctx, path, read_file, name);
}

/* --- is the whole file there? --- */

static double padded(double bytes)
{
    return 4.0 * ceil(bytes / 4.0);
}

/* Of counts and sizes in the header. */
static double word_of(int format)
{
    return format == NC_FORMAT_CDF5 ? 8.0 : 4.0;
}

static double bytes_of_attributes(int file, int variable, int count, double word)
{
    double bytes = 4.0 + word;
    for (int a = 0; a < count; a++) {
        char name[NC_MAX_NAME + 1];
        nc_type type = NC_NAT;
        size_t length = 0, each = 0;
        if (nc_inq_attname(file, variable, a, name) == NC_NOERR &&
            nc_inq_att(file, variable, name, &type, &length) == NC_NOERR &&
            nc_inq_type(file, type, NULL, &each) == NC_NOERR)
            bytes += word + padded((double)strlen(name)) + 4.0 + word + padded((double)length * (double)each);
    }
    return bytes;
}

/* What a variable takes in the file: its header, and its numbers (of a record, where it has records). */
static double bytes_of_variable(int file, int variable, int format, int records, double *numbers, int *has_records)
{
    char name[NC_MAX_NAME + 1];
    const double word = word_of(format);
    int dimensions = 0, attributes = 0, id[NC_MAX_VAR_DIMS];
    nc_type type = NC_NAT;
    size_t each = 0;
    *numbers = 0.0;
    *has_records = 0;
    if (nc_inq_var(file, variable, name, &type, &dimensions, id, &attributes) != NC_NOERR ||
        nc_inq_type(file, type, NULL, &each) != NC_NOERR)
        return 0.0;
    *numbers = (double)each;
    for (int d = 0; d < dimensions; d++) {
        size_t length = 0;
        if (id[d] == records)
            *has_records = 1;
        else if (nc_inq_dimlen(file, id[d], &length) == NC_NOERR)
            *numbers *= (double)length;
    }
    return word + padded((double)strlen(name)) + word + word * dimensions +
           bytes_of_attributes(file, variable, attributes, word) + 4.0 + word +
           (format == NC_FORMAT_CLASSIC ? 4.0 : 8.0);
}

/* The least size of a classic file of what this one says that it holds (netCDF's classic format specification). Beyond
 * the end of a file the library reads zeros, and says nothing. The padding of records is left out of account. */
static double least_bytes(int file, int format)
{
    const double word = word_of(format);
    int dimensions = 0, variables = 0, attributes = 0, records = -1;
    size_t record_count = 0;
    double fixed = 0.0, record = 0.0;
    if (nc_inq(file, &dimensions, &variables, &attributes, &records) != NC_NOERR)
        return 0.0;
    if (records >= 0)
        nc_inq_dimlen(file, records, &record_count);
    double bytes = 4.0 + word + bytes_of_attributes(file, NC_GLOBAL, attributes, word) + 2.0 * (4.0 + word);
    for (int d = 0; d < dimensions; d++) {
        char name[NC_MAX_NAME + 1];
        if (nc_inq_dimname(file, d, name) == NC_NOERR)
            bytes += 2.0 * word + padded((double)strlen(name));
    }
    for (int v = 0; v < variables; v++) {
        double numbers = 0.0;
        int has_records = 0;
        bytes += bytes_of_variable(file, v, format, records, &numbers, &has_records);
        fixed += has_records ? 0.0 : padded(numbers);
        record += has_records ? numbers : 0.0;
    }
    return bytes + fixed + record * (double)record_count;
}

static OstStatus check_length(const OstNetcdf *nc)
{
    int format = 0;
    const int error = nc_inq_format(nc->file, &format);
    if (error != NC_NOERR)
        return raise(nc, "the file", error);
    if (format == NC_FORMAT_NETCDF4 || format == NC_FORMAT_NETCDF4_CLASSIC)
        return OST_SUCCESS;
    const double least = least_bytes(nc->file, format);
    return least <= nc->bytes
               ? OST_SUCCESS
               : OST_RAISE(nc->ctx, OST_FILE_FAILED,
                           "%s: %.0f bytes found, and what it says that it holds takes %.0f; the file is incomplete or "
                           "damaged, write it again",
                           nc->path, nc->bytes, least);
}

OstStatus ost_netcdf_open(OstContext *ctx, const char *path, int dry, OstNetcdf *nc)
{
    struct stat facts;
    *nc = (OstNetcdf){.ctx = ctx, .path = path, .dry = dry};
    /* The operating system's message says best why a file cannot be opened. */
    const int descriptor = open(path, O_RDONLY | O_CLOEXEC);
    if (descriptor < 0 || fstat(descriptor, &facts) != 0) {
        const OstStatus status = OST_RAISE(ctx, OST_FILE_FAILED, "%s: could not be opened: %s", path, strerror(errno));
        if (descriptor >= 0)
            close(descriptor);
        return status;
    }
    close(descriptor);
    nc->bytes = (double)facts.st_size;
    const int error = nc_open(path, NC_NOWRITE, &nc->file);
    if (error != NC_NOERR)
        return raise(nc, "the file, expected in Exodus II,", error);
    nc->opened = 1;
    return check_length(nc);
}

void ost_netcdf_close(OstNetcdf *nc)
{
    if (nc->opened)
        nc_close(nc->file);
    nc->opened = 0;
}

/* --- names and texts --- */

OstStatus ost_netcdf_dimension(const OstNetcdf *nc, const char *name, OstLocal *size)
{
    int id = 0;
    size_t length = 0;
    *size = 0;
    if (nc_inq_dimid(nc->file, name, &id) != NC_NOERR || nc_inq_dimlen(nc->file, id, &length) != NC_NOERR)
        return OST_SUCCESS;
    if (length > INT_MAX)
        return OST_RAISE(nc->ctx, OST_LIMIT_EXCEEDED, "%s: %s is %zu, more than %d, too many for a serial file",
                         nc->path, name, length, INT_MAX);
    *size = (OstLocal)length;
    return OST_SUCCESS;
}

/* Texts end with zeros or blanks. */
static void end_text(char text[OST_NETCDF_NAME], size_t length)
{
    text[length] = '\0';
    length = strlen(text);
    while (length > 0 && text[length - 1] == ' ')
        text[--length] = '\0';
}

void ost_netcdf_attribute(const OstNetcdf *nc, const char *variable, const char *name, char text[OST_NETCDF_NAME])
{
    int id = 0;
    nc_type type = NC_NAT;
    size_t length = 0;
    text[0] = '\0';
    if (nc_inq_varid(nc->file, variable, &id) == NC_NOERR &&
        nc_inq_att(nc->file, id, name, &type, &length) == NC_NOERR && type == NC_CHAR && length < OST_NETCDF_NAME &&
        nc_get_att_text(nc->file, id, name, text) == NC_NOERR)
        end_text(text, length);
    else
        text[0] = '\0';
}

OstStatus ost_netcdf_text(const OstNetcdf *nc, const char *variable, OstLocal row, char text[OST_NETCDF_NAME])
{
    int id = 0, dimensions = 0, dimension[NC_MAX_VAR_DIMS];
    nc_type type = NC_NAT;
    size_t extent[2] = {0, 0};
    text[0] = '\0';
    if (nc_inq_varid(nc->file, variable, &id) != NC_NOERR ||
        nc_inq_var(nc->file, id, NULL, &type, &dimensions, dimension, NULL) != NC_NOERR || type != NC_CHAR ||
        dimensions != 2 || nc_inq_dimlen(nc->file, dimension[0], &extent[0]) != NC_NOERR ||
        nc_inq_dimlen(nc->file, dimension[1], &extent[1]) != NC_NOERR || (size_t)row >= extent[0])
        return OST_SUCCESS;
    const size_t first[2] = {(size_t)row, 0};
    const size_t size[2] = {1, extent[1] < OST_NETCDF_NAME ? extent[1] : OST_NETCDF_NAME - 1};
    const int error = nc_get_vara_text(nc->file, id, first, size, text);
    if (error != NC_NOERR)
        return raise(nc, variable, error);
    end_text(text, size[1]);
    return OST_SUCCESS;
}

/* --- arrays --- */

/* No array of more than its file can hold; unless it is packed, and whoever packed it. */
static OstStatus check_claimed(OstNetcdfRows *rows, nc_type type, const size_t extent[3])
{
    const OstNetcdf *nc = rows->nc;
    int storage = NC_CONTIGUOUS, shuffle = 0, deflate = 0, level = 0;
    size_t filters = 0, each = 0;
    double bytes = nc_inq_type(nc->file, type, NULL, &each) == NC_NOERR ? (double)each : 0.0;
    for (int d = 0; d < rows->dimensions; d++)
        bytes *= (double)extent[d];
    if (nc_inq_var_chunking(nc->file, rows->id, &storage, NULL) != NC_NOERR)
        storage = NC_CONTIGUOUS;
    const int packed = nc_inq_var_deflate(nc->file, rows->id, &shuffle, &deflate, &level) == NC_NOERR && deflate;
    const int filtered = nc_inq_var_filter_ids(nc->file, rows->id, &filters, NULL) == NC_NOERR && filters > 0;
    rows->contiguous = storage != NC_CHUNKED;
    const double most = nc->bytes * (packed || filtered ? LARGEST_COMPRESSION : 1);
    return bytes <= most ? OST_SUCCESS
                         : OST_RAISE(nc->ctx, OST_FILE_FAILED,
                                     "%s: %s claims to hold %.0f bytes, in a file of %.0f; the file is damaged or "
                                     "unfinished",
                                     nc->path, rows->name, bytes, nc->bytes);
}

/* The extents of a variable of at most three dimensions. */
static OstStatus read_shape(OstNetcdfRows *rows, nc_type *type, size_t extent[3])
{
    const OstNetcdf *nc = rows->nc;
    int dimension[NC_MAX_VAR_DIMS];
    int error = nc_inq_var(nc->file, rows->id, NULL, type, &rows->dimensions, dimension, NULL);
    if (error == NC_NOERR && rows->dimensions > 3)
        return OST_RAISE(nc->ctx, OST_INVALID_INPUT, "%s: %s has %d dimensions, expected at most 3", nc->path,
                         rows->name, rows->dimensions);
    for (int d = 0; d < rows->dimensions && error == NC_NOERR; d++)
        error = nc_inq_dimlen(nc->file, dimension[d], &extent[d]);
    return error == NC_NOERR ? OST_SUCCESS : raise(nc, rows->name, error);
}

static OstStatus set_rows(OstNetcdfRows *rows, OstGlobal index, const size_t extent[3])
{
    const OstNetcdf *nc = rows->nc;
    const int left = rows->dimensions - rows->leading;
    if (left != 1 && left != 2)
        return OST_RAISE(nc->ctx, OST_INVALID_INPUT, "%s: %s has %d dimensions, expected %d or %d", nc->path,
                         rows->name, rows->dimensions, rows->leading + 1, rows->leading + 2);
    const size_t steps = rows->leading ? extent[0] : 1;
    const size_t total = extent[rows->leading], width = left == 2 ? extent[rows->leading + 1] : 1;
    if (steps == 0 || index >= (OstGlobal)steps)
        return OST_SUCCESS; /* nothing was written to it */
    if (total > INT_MAX || width > OST_NETCDF_PIECE)
        return OST_RAISE(nc->ctx, OST_LIMIT_EXCEEDED,
                         "%s: %s has %zu rows of %zu numbers, at most %d of %d can be read", nc->path, rows->name,
                         total, width, INT_MAX, OST_NETCDF_PIECE);
    rows->at[0] = rows->leading ? (index < 0 ? steps - 1 : (size_t)index) : 0;
    rows->size[0] = 1;
    rows->size[rows->leading + 1] = width;
    rows->total = width > 0 ? (OstLocal)total : 0;
    rows->width = (OstLocal)width;
    return OST_SUCCESS;
}

OstStatus ost_netcdf_rows(const OstNetcdf *nc, const char *variable, int leading, OstGlobal index, OstNetcdfRows *rows)
{
    nc_type type = NC_NAT;
    size_t extent[3] = {0, 0, 0};
    rows->nc = nc;
    rows->leading = leading;
    rows->found = rows->dimensions = rows->contiguous = 0;
    rows->total = rows->width = rows->first = rows->count = 0;
    memset(rows->at, 0, sizeof rows->at);
    memset(rows->size, 0, sizeof rows->size);
    snprintf(rows->name, sizeof rows->name, "%s", variable);
    if (nc_inq_varid(nc->file, variable, &rows->id) != NC_NOERR)
        return OST_SUCCESS;
    rows->found = 1;
    OST_TRY(read_shape(rows, &type, extent));
    OST_TRY(check_claimed(rows, type, extent));
    return set_rows(rows, index, extent);
}

/* How many rows come next. */
static OstLocal advance(OstNetcdfRows *rows)
{
    const OstLocal most = rows->width > 0 ? OST_NETCDF_PIECE / rows->width : 0;
    rows->first += rows->count;
    if (rows->nc->dry && rows->contiguous && rows->first > 0)
        rows->first = rows->total;
    rows->count = rows->total - rows->first < most ? rows->total - rows->first : most;
    rows->at[rows->leading] = (size_t)rows->first;
    rows->size[rows->leading] = (size_t)rows->count;
    return rows->count;
}

OstStatus ost_netcdf_integers(OstNetcdfRows *rows)
{
    const int error = advance(rows) > 0
                          ? nc_get_vara_longlong(rows->nc->file, rows->id, rows->at, rows->size, rows->integer)
                          : NC_NOERR;
    return error == NC_NOERR ? OST_SUCCESS : raise(rows->nc, rows->name, error);
}

OstStatus ost_netcdf_reals(OstNetcdfRows *rows)
{
    const int error =
        advance(rows) > 0 ? nc_get_vara_double(rows->nc->file, rows->id, rows->at, rows->size, rows->real) : NC_NOERR;
    return error == NC_NOERR ? OST_SUCCESS : raise(rows->nc, rows->name, error);
}
