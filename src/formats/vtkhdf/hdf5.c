/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtkhdf/hdf5.h"

#include "core/error.h"
#include "core/parallel/numbering.h"
#include "core/parallel/reduce.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Half of what MPI can count, so that HDF5 need not split a transfer itself. */
static const size_t default_block_bytes = (size_t)1 << 30;

OstStatus ost_rows_create(OstContext *ctx, OstGlobal count, OstRows *rows)
{
    *rows = (OstRows){.count = count};
    rows->most = count;
    OST_TRY(ost_number_from(ctx, count, &rows->first, &rows->total));
    return ost_max_numbers(ctx, 1, &rows->most);
}

/* Walking upward, HDF5 gives the innermost function's error first. */
static herr_t keep_innermost(unsigned n, const H5E_error2_t *error, void *reason)
{
    if (n == 0)
        snprintf(reason, 256, "%s", error->desc ? error->desc : "no reason given");
    return 0;
}

OstStatus ost_hdf5_raise(const OstHdf5 *h5, const char *action, const char *name)
{
    char reason[256] = "HDF5 gives no reason";
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_innermost, reason);
    H5Eclear2(H5E_DEFAULT);
    return OST_RAISE(h5->ctx, OST_FILE_FAILED, "%s: could not %s%s%s: %s", h5->path, action, *name ? " " : "", name,
                     reason);
}

/* Open MPI 4.1 copies the path and some twenty letters of its own into 256 bytes, and does not check that they fit. */
enum { LONGEST_MPI_PATH = 192 };

/* Initialises h5 with nothing open, and stops HDF5 from printing errors. */
static void begin(OstContext *ctx, const char *path, OstHdf5 *h5)
{
    *h5 = (OstHdf5){.ctx = ctx,
                    .path = path,
                    .file = H5I_INVALID_HID,
                    .opened = -1,
                    .transfer = H5P_DEFAULT,
                    .links = H5P_DEFAULT,
                    .block_bytes = default_block_bytes};
    H5Eget_auto2(H5E_DEFAULT, &h5->printer, &h5->printer_data);
    if (!h5->printer_data) /* a dry run has a handler of its own */
        H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
}

/* The operating system's message says best why a file cannot be opened. Rank 0 tries first; if it fails, no other rank
 * need. */
static OstStatus try_file(OstContext *ctx, const char *path, int flags)
{
    const int descriptor = open(path, flags, 0666);
    if (descriptor < 0)
        return OST_RAISE(ctx, OST_FILE_FAILED, "%s: could not be %s: %s", path, flags & O_CREAT ? "created" : "opened",
                         strerror(errno));
    close(descriptor);
    return OST_SUCCESS;
}

static OstStatus prepare_transfers(OstHdf5 *h5)
{
    h5->transfer = H5Pcreate(H5P_DATASET_XFER);
    h5->links = H5Pcreate(H5P_LINK_CREATE);
    if (h5->transfer < 0 || h5->links < 0 || H5Pset_create_intermediate_group(h5->links, 1) < 0 ||
        H5Pset_dxpl_mpio(h5->transfer, H5FD_MPIO_COLLECTIVE) < 0)
        return ost_hdf5_raise(h5, "prepare parallel writing", "");
    return OST_SUCCESS;
}

/* The path for MPI: a file with a long one, which exists, is opened and named by its descriptor. */
static OstStatus shorten_path(OstHdf5 *h5, char path[LONGEST_MPI_PATH + 1])
{
    if (strlen(h5->path) <= LONGEST_MPI_PATH) {
        strcpy(path, h5->path);
        return OST_SUCCESS;
    }
    h5->opened = open(h5->path, O_PATH | O_CLOEXEC);
    if (h5->opened < 0)
        return OST_RAISE(h5->ctx, OST_FILE_FAILED, "%s: could not be opened: %s", h5->path, strerror(errno));
    snprintf(path, LONGEST_MPI_PATH + 1, "/proc/self/fd/%d", h5->opened);
    return OST_SUCCESS;
}

static OstStatus create_together(OstHdf5 *h5)
{
    char path[LONGEST_MPI_PATH + 1];
    OstStatus status = shorten_path(h5, path);
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    if (status == OST_SUCCESS && (access < 0 || H5Pset_fapl_mpio(access, ost_comm(h5->ctx), MPI_INFO_NULL) < 0 ||
                                  H5Pset_coll_metadata_write(access, 1) < 0))
        status = ost_hdf5_raise(h5, "prepare parallel access", "");
    status = ost_agree(h5->ctx, status);
    if (status == OST_SUCCESS) {
        h5->file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, access);
        status = ost_agree(h5->ctx, h5->file < 0 ? ost_hdf5_raise(h5, "create the file", "") : OST_SUCCESS);
    }
    ost_hdf5_release(access);
    return status;
}

OstStatus ost_hdf5_create(OstContext *ctx, const char *path, OstHdf5 *h5)
{
    begin(ctx, path, h5);
    OST_TRY(ost_agree(ctx, ost_rank(ctx) == 0 ? try_file(ctx, path, O_WRONLY | O_CREAT | O_TRUNC) : OST_SUCCESS));
    OST_TRY(ost_agree(ctx, prepare_transfers(h5)));
    return create_together(h5);
}

OstStatus ost_hdf5_open(OstContext *ctx, const char *path, OstHdf5 *h5)
{
    begin(ctx, path, h5);
    OST_TRY(try_file(ctx, path, O_RDONLY));
    if (H5Fis_hdf5(path) <= 0)
        return OST_RAISE(ctx, OST_FILE_FAILED,
                         "%s: not an HDF5 file (its first bytes are not HDF5's); expected a VTKHDF file", path);
    h5->file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    return h5->file < 0 ? ost_hdf5_raise(h5, "open the file", "") : OST_SUCCESS;
}

OstStatus ost_hdf5_reopen(OstContext *ctx, const char *path, OstHdf5 *h5)
{
    begin(ctx, path, h5);
    h5->links = H5Pcreate(H5P_LINK_CREATE);
    if (h5->links >= 0 && H5Pset_create_intermediate_group(h5->links, 1) >= 0)
        h5->file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    return h5->file < 0 ? ost_hdf5_raise(h5, "open the file again", "") : OST_SUCCESS;
}

OstStatus ost_hdf5_close(OstHdf5 *h5)
{
    OstStatus status = OST_SUCCESS;
    if (h5->transfer != H5P_DEFAULT && h5->transfer >= 0)
        H5Pclose(h5->transfer);
    if (h5->links != H5P_DEFAULT && h5->links >= 0)
        H5Pclose(h5->links);
    if (h5->file >= 0 && H5Fclose(h5->file) < 0)
        status = ost_hdf5_raise(h5, "finish the file", "");
    if (h5->opened >= 0)
        close(h5->opened);
    h5->file = H5I_INVALID_HID;
    h5->opened = -1;
    H5Eset_auto2(H5E_DEFAULT, h5->printer, h5->printer_data);
    return status;
}
