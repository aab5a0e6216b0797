/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtkhdf/hdf5.h"

#include "core/error.h"
#include "core/memory.h"

#include <string.h>

/* Deflate compresses by less than this. A dataset that claims to hold more than that in its bytes is refused. */
enum { LARGEST_COMPRESSION = 1100 };

/* Of any array that is read: axes have nine numbers a tet. */
enum { MOST_COMPONENTS = 9 };

int ost_hdf5_has(const OstHdf5 *h5, const char *name)
{
    char path[256] = "";
    size_t length = strlen(name);
    if (length >= sizeof path)
        return 0;
    for (size_t i = 1; i <= length; i++) {
        if (name[i] != '/' && name[i] != '\0')
            continue;
        memcpy(path, name, i);
        path[i] = '\0';
        if (H5Lexists(h5->file, path, H5P_DEFAULT) <= 0)
            return 0;
    }
    return 1;
}

static OstStatus check_stored(const OstHdf5 *h5, const char *name, hid_t dataset, const hsize_t extent[2])
{
    const hid_t type = H5Dget_type(dataset);
    const double size = type < 0 ? 0.0 : (double)H5Tget_size(type);
    ost_hdf5_release(type);
    const double claimed = (double)extent[0] * (double)extent[1] * size;
    const double stored = (double)H5Dget_storage_size(dataset);
    if (claimed > LARGEST_COMPRESSION * stored)
        return OST_RAISE(h5->ctx, OST_FILE_FAILED,
                         "%s: %s claims to hold %.0f bytes but stores only %.0f; the file is damaged or unfinished",
                         h5->path, name, claimed, stored);
    return OST_SUCCESS;
}

/* Opens a dataset of one or two dimensions. */
static OstStatus open_dataset(const OstHdf5 *h5, const char *name, hid_t *dataset, hsize_t extent[2])
{
    *dataset = H5I_INVALID_HID;
    if (!ost_hdf5_has(h5, name))
        return OST_RAISE(h5->ctx, OST_INVALID_INPUT, "%s: there is no dataset %s; expected it in a VTKHDF file",
                         h5->path, name);
    *dataset = H5Dopen2(h5->file, name, H5P_DEFAULT);
    if (*dataset < 0)
        return ost_hdf5_raise(h5, "open", name);
    extent[0] = extent[1] = 1;
    const hid_t space = H5Dget_space(*dataset);
    const int dimensions = space < 0 ? -1 : H5Sget_simple_extent_ndims(space);
    const int good =
        (dimensions == 1 || dimensions == 2) && H5Sget_simple_extent_dims(space, extent, NULL) == dimensions;
    ost_hdf5_release(space);
    if (!good || extent[0] > INT64_MAX || extent[1] > INT32_MAX)
        return OST_RAISE(h5->ctx, OST_INVALID_INPUT, "%s: %s is not an array of one or two dimensions", h5->path, name);
    return check_stored(h5, name, *dataset, extent);
}

OstStatus ost_hdf5_shape(const OstHdf5 *h5, const char *name, OstGlobal *rows, int *components)
{
    hid_t dataset = H5I_INVALID_HID;
    hsize_t extent[2] = {0, 0};
    const OstStatus status = open_dataset(h5, name, &dataset, extent);
    ost_hdf5_release(dataset);
    if (status != OST_SUCCESS)
        return status;
    *rows = (OstGlobal)extent[0];
    *components = (int)extent[1];
    return OST_SUCCESS;
}

/* Integers may be read as reals; strings must be strings; no other conversion is allowed. */
static OstStatus check_class(const OstHdf5 *h5, const char *name, hid_t dataset, hid_t wanted)
{
    const hid_t type = H5Dget_type(dataset);
    const H5T_class_t found = type < 0 ? H5T_NO_CLASS : H5Tget_class(type);
    const H5T_class_t asked = H5Tget_class(wanted);
    const int fixed_string = found == H5T_STRING && H5Tis_variable_str(type) == 0;
    ost_hdf5_release(type);
    if (found == asked && (found != H5T_STRING || fixed_string))
        return OST_SUCCESS;
    if (found == H5T_INTEGER && asked == H5T_FLOAT)
        return OST_SUCCESS;
    return OST_RAISE(h5->ctx, OST_INVALID_INPUT, "%s: %s does not hold %s", h5->path, name,
                     asked == H5T_INTEGER ? "integers"
                     : asked == H5T_FLOAT ? "numbers"
                                          : "strings of one length");
}

static OstStatus read_selected(const OstHdf5 *h5, const char *name, hid_t dataset, hid_t type, OstGlobal first,
                               OstGlobal count, int components, void *values)
{
    const hsize_t start[2] = {(hsize_t)first, 0};
    const hsize_t size[2] = {(hsize_t)count, (hsize_t)components};
    const hid_t file_space = H5Dget_space(dataset);
    const hid_t memory_space = H5Screate_simple(2, size, NULL);
    OstStatus status = OST_SUCCESS;
    if (file_space < 0 || memory_space < 0 ||
        H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start, NULL, size, NULL) < 0 ||
        H5Dread(dataset, type, memory_space, file_space, H5P_DEFAULT, values) < 0)
        status = ost_hdf5_raise(h5, "read", name);
    ost_hdf5_release(file_space);
    ost_hdf5_release(memory_space);
    return status;
}

OstStatus ost_hdf5_read_rows(const OstHdf5 *h5, const char *name, hid_t type, int components, OstGlobal total,
                             OstGlobal first, OstGlobal count, void *values)
{
    hid_t dataset = H5I_INVALID_HID;
    hsize_t extent[2] = {0, 0};
    OstStatus status = open_dataset(h5, name, &dataset, extent);
    if (status == OST_SUCCESS && (extent[0] != (hsize_t)total || extent[1] != (hsize_t)components))
        status = OST_RAISE(
            h5->ctx, OST_INVALID_INPUT, "%s: %s has %llu rows of %llu; expected %lld of %d by the counts in the file",
            h5->path, name, (unsigned long long)extent[0], (unsigned long long)extent[1], (long long)total, components);
    OST_THEN(check_class(h5, name, dataset, type));
    if (status == OST_SUCCESS && count > 0)
        status = read_selected(h5, name, dataset, type, first, count, components, values);
    ost_hdf5_release(dataset);
    return status;
}

/* How many rows to read at once: a chunk of them. Sets the end to one row if they are contiguous (see
 * ost_hdf5_try_rows). */
static hsize_t rows_at_once(hid_t dataset, const hsize_t extent[2], hsize_t *end)
{
    hsize_t chunk[2] = {1, 1};
    const hid_t made = H5Dget_create_plist(dataset);
    const H5D_layout_t layout = made < 0 ? H5D_LAYOUT_ERROR : H5Pget_layout(made);
    if (layout == H5D_CHUNKED)
        H5Pget_chunk(made, 2, chunk);
    else if (layout == H5D_CONTIGUOUS || layout == H5D_COMPACT)
        *end = extent[0] < 1 ? extent[0] : 1;
    ost_hdf5_release(made);
    return chunk[0] < extent[0] ? chunk[0] : extent[0];
}

static OstStatus try_rows(const OstHdf5 *h5, const char *name, hid_t dataset, hid_t type, const hsize_t extent[2])
{
    const hsize_t share = extent[0] / (hsize_t)ost_size(h5->ctx) + 1;
    const hsize_t first = share * (hsize_t)ost_rank(h5->ctx);
    hsize_t end = first + share < extent[0] ? first + share : extent[0];
    const hsize_t step = rows_at_once(dataset, extent, &end);
    void *values = NULL;
    OST_TRY(ost_allocate(h5->ctx, step * extent[1], H5Tget_size(type), &values));
    OstStatus status = OST_SUCCESS;
    for (hsize_t row = first; row < end && status == OST_SUCCESS; row += step)
        status = read_selected(h5, name, dataset, type, (OstGlobal)row,
                               (OstGlobal)(end - row < step ? end - row : step), (int)extent[1], values);
    OST_FREE(values);
    return status;
}

OstStatus ost_hdf5_try_rows(const OstHdf5 *h5, const char *name, hid_t type)
{
    hid_t dataset = H5I_INVALID_HID;
    hsize_t extent[2] = {0, 0};
    if (!ost_hdf5_has(h5, name))
        return OST_SUCCESS;
    OstStatus status = open_dataset(h5, name, &dataset, extent);
    OST_THEN(check_class(h5, name, dataset, type));
    if (status == OST_SUCCESS && extent[1] <= MOST_COMPONENTS)
        status = try_rows(h5, name, dataset, type, extent);
    ost_hdf5_release(dataset);
    return status;
}

/* Opens an attribute of `count` items, or of a string if count is 0. */
static OstStatus open_attribute(const OstHdf5 *h5, const char *group, const char *name, int count, hid_t *attribute)
{
    *attribute = H5I_INVALID_HID;
    if (H5Aexists_by_name(h5->file, group, name, H5P_DEFAULT) <= 0)
        return OST_RAISE(h5->ctx, OST_INVALID_INPUT, "%s: the group %s has no attribute %s; expected a VTKHDF file",
                         h5->path, group, name);
    *attribute = H5Aopen_by_name(h5->file, group, name, H5P_DEFAULT, H5P_DEFAULT);
    if (*attribute < 0)
        return ost_hdf5_raise(h5, "open the attribute", name);
    const hid_t space = H5Aget_space(*attribute);
    const hid_t type = H5Aget_type(*attribute);
    const H5T_class_t wanted = count > 0 ? H5T_INTEGER : H5T_STRING;
    const int good = space >= 0 && type >= 0 && H5Tget_class(type) == wanted &&
                     H5Sget_simple_extent_npoints(space) == (count > 0 ? count : 1);
    ost_hdf5_release(space);
    ost_hdf5_release(type);
    return good ? OST_SUCCESS
                : OST_RAISE(h5->ctx, OST_INVALID_INPUT, "%s: the attribute %s of %s is not %s", h5->path, name, group,
                            count > 0 ? "made of two integers" : "one string");
}

OstStatus ost_hdf5_read_integers(const OstHdf5 *h5, const char *group, const char *name, int count, int *values)
{
    hid_t attribute = H5I_INVALID_HID;
    OstStatus status = open_attribute(h5, group, name, count, &attribute);
    if (status == OST_SUCCESS && H5Aread(attribute, H5T_NATIVE_INT, values) < 0)
        status = ost_hdf5_raise(h5, "read the attribute", name);
    ost_hdf5_release(attribute);
    return status;
}

/* Other programs also write strings of variable length. */
static herr_t read_string(hid_t attribute, hid_t type, char *text, size_t size)
{
    if (H5Tis_variable_str(type) > 0) {
        char *found = NULL;
        if (H5Aread(attribute, type, (void *)&found) < 0)
            return -1;
        snprintf(text, size, "%s", found ? found : "");
        H5free_memory(found);
        return 0;
    }
    if (H5Tget_size(type) >= size)
        return snprintf(text, size, "a string of %zu characters", H5Tget_size(type)) < 0 ? -1 : 0;
    memset(text, 0, size);
    return H5Aread(attribute, type, text);
}

OstStatus ost_hdf5_read_text(const OstHdf5 *h5, const char *group, const char *name, char *text, size_t size)
{
    hid_t attribute = H5I_INVALID_HID;
    OstStatus status = open_attribute(h5, group, name, 0, &attribute);
    const hid_t type = attribute < 0 ? H5I_INVALID_HID : H5Aget_type(attribute);
    if (status == OST_SUCCESS && (type < 0 || read_string(attribute, type, text, size) < 0))
        status = ost_hdf5_raise(h5, "read the attribute", name);
    ost_hdf5_release(type);
    ost_hdf5_release(attribute);
    return status;
}

/* The longest string of a dataset of names. */
static OstStatus name_length(const OstHdf5 *h5, const char *name, size_t *length)
{
    const hid_t dataset = H5Dopen2(h5->file, name, H5P_DEFAULT);
    const hid_t type = dataset < 0 ? H5I_INVALID_HID : H5Dget_type(dataset);
    *length = type < 0 ? 0 : H5Tget_size(type);
    ost_hdf5_release(type);
    ost_hdf5_release(dataset);
    return *length == 0 ? ost_hdf5_raise(h5, "read", name) : OST_SUCCESS;
}

OstStatus ost_hdf5_read_names(const OstHdf5 *h5, const char *name, int *count, char ***names)
{
    OstGlobal rows = 0;
    int components = 0;
    size_t length = 0;
    char *text = NULL;
    OstStatus status = OST_SUCCESS;
    *count = 0;
    OST_TRY(ost_hdf5_shape(h5, name, &rows, &components));
    OST_TRY(name_length(h5, name, &length));
    if (components != 1 || rows > INT32_MAX)
        return OST_RAISE(h5->ctx, OST_INVALID_INPUT, "%s: %s is not a list of names", h5->path, name);
    const hid_t type = H5Tcopy(H5T_C_S1);
    OST_TRY_DONE(OST_NEW(h5->ctx, names, rows));
    OST_TRY_DONE(OST_NEW(h5->ctx, &text, (size_t)(rows + 1) * (length + 1)));
    if (type < 0 || H5Tset_size(type, length + 1) < 0 || H5Tset_cset(type, H5T_CSET_UTF8) < 0)
        OST_TRY_DONE(ost_hdf5_raise(h5, "make a string type for", name));
    OST_TRY_DONE(ost_hdf5_read_rows(h5, name, type, 1, rows, 0, rows, text));
    for (; *count < rows; (*count)++)
        OST_TRY_DONE(ost_copy_string(h5->ctx, text + (size_t)*count * (length + 1), &(*names)[*count]));
done:
    ost_hdf5_release(type);
    OST_FREE(text);
    return status;
}
