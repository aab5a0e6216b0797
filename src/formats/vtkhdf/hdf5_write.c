/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtkhdf/hdf5.h"

#include "core/error.h"
#include "core/memory.h"

#include <string.h>

/* All elements get written, so HDF5 need not fill the dataset first. Without the time of writing, equal contents make
 * equal files. */
static OstStatus create_dataset(OstHdf5 *h5, const char *name, hid_t type, int components, OstGlobal rows,
                                hid_t *dataset)
{
    const hsize_t extent[2] = {(hsize_t)rows, (hsize_t)components};
    const hid_t space = H5Screate_simple(components > 1 ? 2 : 1, extent, NULL);
    const hid_t layout = H5Pcreate(H5P_DATASET_CREATE);
    *dataset = H5I_INVALID_HID;
    if (space >= 0 && layout >= 0 && H5Pset_fill_time(layout, H5D_FILL_TIME_NEVER) >= 0 &&
        H5Pset_obj_track_times(layout, 0) >= 0)
        *dataset = H5Dcreate2(h5->file, name, type, space, h5->links, layout, H5P_DEFAULT);
    const OstStatus status = *dataset < 0 ? ost_hdf5_raise(h5, "create", name) : OST_SUCCESS;
    ost_hdf5_release(space);
    ost_hdf5_release(layout);
    return status;
}

/* Collective. Writes rows first .. first + count - 1; count may be 0. */
static OstStatus write_block(OstHdf5 *h5, const char *name, hid_t dataset, hid_t type, int components, OstGlobal first,
                             OstGlobal count, const void *values)
{
    const hsize_t start[2] = {(hsize_t)first, 0};
    const hsize_t size[2] = {(hsize_t)count, (hsize_t)components};
    const hid_t file_space = H5Dget_space(dataset);
    const hid_t memory_space = H5Screate_simple(components > 1 ? 2 : 1, size, NULL);
    int good = file_space >= 0 && memory_space >= 0;
    if (good && count > 0)
        good = H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start, NULL, size, NULL) >= 0;
    else if (good)
        good = H5Sselect_none(file_space) >= 0 && H5Sselect_none(memory_space) >= 0;
    OstStatus status = ost_agree(h5->ctx, good ? OST_SUCCESS : ost_hdf5_raise(h5, "select rows of", name));
    if (status == OST_SUCCESS && H5Dwrite(dataset, type, memory_space, file_space, h5->transfer, values) < 0)
        status = ost_hdf5_raise(h5, "write", name);
    ost_hdf5_release(file_space);
    ost_hdf5_release(memory_space);
    return ost_agree(h5->ctx, status);
}

/* The dataset, made with room for all steps unless it is there. */
static OstStatus open_for_step(OstHdf5 *h5, const char *name, hid_t type, int components, OstGlobal rows, int step,
                               hid_t *dataset)
{
    if (step == 0)
        return create_dataset(h5, name, type, components, rows, dataset);
    *dataset = H5Dopen2(h5->file, name, H5P_DEFAULT);
    return *dataset < 0 ? ost_hdf5_raise(h5, "open", name) : OST_SUCCESS;
}

OstStatus ost_hdf5_write_step(OstHdf5 *h5, const char *name, hid_t type, int components, const OstRows *rows, int step,
                              int steps, const void *values)
{
    hid_t dataset = H5I_INVALID_HID;
    const OstGlobal above = step * rows->total + rows->first;
    OstStatus status =
        ost_agree(h5->ctx, open_for_step(h5, name, type, components, steps * rows->total, step, &dataset));
    const size_t row_bytes = H5Tget_size(type) * (size_t)components;
    const OstGlobal block = (OstGlobal)(h5->block_bytes > row_bytes ? h5->block_bytes / row_bytes : 1);
    for (OstGlobal from = 0; status == OST_SUCCESS && from < rows->most; from += block) {
        const OstGlobal left = rows->count > from ? rows->count - from : 0;
        const OstGlobal here = left < block ? left : block;
        const char *start = left > 0 ? (const char *)values + (size_t)from * row_bytes : values;
        status = write_block(h5, name, dataset, type, components, above + (left > 0 ? from : 0), here, start);
    }
    if (dataset >= 0 && H5Dclose(dataset) < 0 && status == OST_SUCCESS)
        status = ost_hdf5_raise(h5, "finish", name);
    return ost_agree(h5->ctx, status);
}

OstStatus ost_hdf5_write_rows(OstHdf5 *h5, const char *name, hid_t type, int components, const OstRows *rows,
                              const void *values)
{
    return ost_hdf5_write_step(h5, name, type, components, rows, 0, 1, values);
}

static OstStatus write_attribute(OstHdf5 *h5, const char *group, const char *name, hid_t file_type, hid_t memory_type,
                                 hid_t space, const void *values)
{
    const hid_t attribute =
        H5Acreate_by_name(h5->file, group, name, file_type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    OstStatus status = OST_SUCCESS;
    if (attribute < 0 || H5Awrite(attribute, memory_type, values) < 0)
        status = ost_hdf5_raise(h5, "write the attribute", name);
    ost_hdf5_release(attribute);
    return ost_agree(h5->ctx, status);
}

OstStatus ost_hdf5_write_integers(OstHdf5 *h5, const char *group, const char *name, int count, const int *values)
{
    const hsize_t extent = (hsize_t)count;
    const hid_t space = count > 0 ? H5Screate_simple(1, &extent, NULL) : H5Screate(H5S_SCALAR);
    const OstStatus status = write_attribute(h5, group, name, H5T_STD_I64LE, H5T_NATIVE_INT, space, values);
    ost_hdf5_release(space);
    return status;
}

/* A type for strings of `length` bytes without a terminator. */
static hid_t string_type(size_t length, H5T_cset_t characters)
{
    const hid_t type = H5Tcopy(H5T_C_S1);
    if (type >= 0 && (H5Tset_size(type, length) < 0 || H5Tset_strpad(type, H5T_STR_NULLPAD) < 0 ||
                      H5Tset_cset(type, characters) < 0)) {
        H5Tclose(type);
        return H5I_INVALID_HID;
    }
    return type;
}

OstStatus ost_hdf5_write_text(OstHdf5 *h5, const char *group, const char *name, const char *text)
{
    const hid_t type = string_type(strlen(text), H5T_CSET_ASCII);
    const hid_t space = H5Screate(H5S_SCALAR);
    const OstStatus status = write_attribute(h5, group, name, type, type, space, text);
    ost_hdf5_release(type);
    ost_hdf5_release(space);
    return status;
}

OstStatus ost_hdf5_write_names(OstHdf5 *h5, const char *name, int count, char *const *names)
{
    size_t length = 1;
    for (int i = 0; i < count; i++)
        length = strlen(names[i]) > length ? strlen(names[i]) : length;
    const OstGlobal mine = ost_rank(h5->ctx) == 0 ? count : 0;
    const OstRows rows = {.first = 0, .count = mine, .total = count, .most = count};
    char *text = NULL;
    const hid_t type = string_type(length, H5T_CSET_UTF8);
    OstStatus status = OST_NEW(h5->ctx, &text, (size_t)count * length);
    if (status == OST_SUCCESS && type < 0)
        status = ost_hdf5_raise(h5, "make a string type for", name);
    OST_TRY_DONE(ost_agree(h5->ctx, status));
    for (int i = 0; i < count; i++)
        memcpy(text + (size_t)i * length, names[i], strlen(names[i]));
    status = ost_hdf5_write_rows(h5, name, type, 1, &rows, text);
done:
    ost_hdf5_release(type);
    OST_FREE(text);
    return status;
}

OstStatus ost_hdf5_add_texts(OstContext *ctx, const char *path, const char *name, int count, const char *const *texts)
{
    const hsize_t extent = (hsize_t)count;
    OstHdf5 h5;
    OstStatus status = ost_hdf5_reopen(ctx, path, &h5);
    const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate_simple(1, &extent, NULL);
    hid_t dataset = H5I_INVALID_HID;
    if (status == OST_SUCCESS && H5Tset_size(type, H5T_VARIABLE) >= 0)
        dataset = H5Dcreate2(h5.file, name, type, space, h5.links, H5P_DEFAULT, H5P_DEFAULT);
    if (status == OST_SUCCESS &&
        (dataset < 0 || H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, (const void *)texts) < 0))
        status = ost_hdf5_raise(&h5, "write", name);
    ost_hdf5_release(dataset);
    ost_hdf5_release(type);
    ost_hdf5_release(space);
    const OstStatus closed = ost_hdf5_close(&h5);
    return status == OST_SUCCESS ? closed : status;
}
