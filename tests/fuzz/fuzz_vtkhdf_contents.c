/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtkhdf/dry_run.h"
#include "fuzz.h"
#include "hdf5_from_text.h"
#include "read_mesh.h"

/* Sound HDF5 files with any contents: what is fuzzed is our reader rather than HDF5, so there is no dry run. */
OstStatus ost_hdf5_dry_run(OstContext *ctx, const char *path, OstReading *read_file, const char *name)
{
    (void)ctx;
    (void)path;
    (void)read_file;
    (void)name;
    return OST_SUCCESS;
}

const FuzzTarget fuzz_target = {
    .file = "mesh.vtkhdf", .read = read_mesh, .write = write_hdf5_from_text, .constant = 32 << 20, .library_caches = 1};
