/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtkhdf/piece.h"

#include "core/error.h"
#include "core/memory.h"

#include <string.h>

enum { VTK_TETRA = 10, VTK_QUADRATIC_TETRA = 24 };

void ost_piece_free(OstPiece *piece)
{
    OST_FREE(piece->point, piece->node, piece->gathered);
}

/* Points in the order of the local nodes. */
static void number_points(OstPiece *piece)
{
    const OstMesh *mesh = piece->mesh;
    const size_t used = (size_t)mesh->owned_tets * (size_t)mesh->nodes_per_tet;
    for (OstLocal i = 0; i < mesh->node_count; i++)
        piece->point[i] = -1;
    for (size_t i = 0; i < used; i++)
        piece->point[mesh->tet_nodes[i]] = 0;
    for (OstLocal i = 0; i < mesh->node_count; i++) {
        if (piece->point[i] < 0)
            continue;
        piece->node[piece->point_count] = i;
        piece->point[i] = piece->point_count++;
    }
    piece->is_whole = piece->point_count == mesh->node_count;
}

static OstStatus allocate_piece(OstContext *ctx, size_t row_bytes, OstPiece *piece)
{
    OST_TRY(OST_NEW(ctx, &piece->point, piece->mesh->node_count));
    OST_TRY(OST_NEW(ctx, &piece->node, piece->mesh->node_count));
    number_points(piece);
    return ost_allocate(ctx, piece->is_whole ? 0 : (size_t)piece->point_count, row_bytes, &piece->gathered);
}

OstStatus ost_piece_create(const OstMesh *mesh, size_t row_bytes, OstPiece *piece)
{
    OstContext *ctx = mesh->ctx;
    *piece = (OstPiece){.mesh = mesh};
    OST_TRY(ost_agree(ctx, allocate_piece(ctx, row_bytes, piece)));
    const OstGlobal tets = mesh->owned_tets;
    OST_TRY(ost_rows_create(ctx, 1, &piece->one));
    OST_TRY(ost_rows_create(ctx, piece->point_count, &piece->points));
    OST_TRY(ost_rows_create(ctx, tets, &piece->tets));
    OST_TRY(ost_rows_create(ctx, tets + 1, &piece->offsets));
    return ost_rows_create(ctx, tets * mesh->nodes_per_tet, &piece->connectivity);
}

const void *ost_piece_gather(OstPiece *piece, size_t row_bytes, const void *values)
{
    if (piece->is_whole)
        return values;
    char *row = piece->gathered;
    for (OstLocal i = 0; i < piece->point_count; i++, row += row_bytes)
        memcpy(row, (const char *)values + (size_t)piece->node[i] * row_bytes, row_bytes);
    return piece->gathered;
}

OstStatus ost_piece_write_shape(OstHdf5 *h5, OstPiece *piece)
{
    const OstMesh *mesh = piece->mesh;
    const OstGlobal ids = piece->connectivity.count, offsets = piece->offsets.count;
    OstGlobal *numbers = NULL;
    unsigned char *types = NULL;
    OST_TRY(ost_hdf5_write_rows(h5, "/VTKHDF/NumberOfPoints", H5T_NATIVE_INT64, 1, &piece->one, &piece->points.count));
    OST_TRY(ost_hdf5_write_rows(h5, "/VTKHDF/NumberOfCells", H5T_NATIVE_INT64, 1, &piece->one, &piece->tets.count));
    OST_TRY(ost_hdf5_write_rows(h5, "/VTKHDF/NumberOfConnectivityIds", H5T_NATIVE_INT64, 1, &piece->one, &ids));
    OST_TRY(ost_hdf5_write_rows(h5, "/VTKHDF/Points", H5T_NATIVE_DOUBLE, 3, &piece->points,
                                ost_piece_gather(piece, 3 * sizeof(double), mesh->coordinates)));
    OstStatus status = OST_NEW(h5->ctx, &numbers, ids > offsets ? ids : offsets);
    OST_THEN(OST_NEW(h5->ctx, &types, piece->tets.count));
    OST_TRY_DONE(ost_agree(h5->ctx, status));
    for (OstGlobal i = 0; i < ids; i++)
        numbers[i] = piece->point[mesh->tet_nodes[i]];
    OST_TRY_DONE(ost_hdf5_write_rows(h5, "/VTKHDF/Connectivity", H5T_NATIVE_INT64, 1, &piece->connectivity, numbers));
    for (OstGlobal i = 0; i < offsets; i++)
        numbers[i] = i * mesh->nodes_per_tet;
    OST_TRY_DONE(ost_hdf5_write_rows(h5, "/VTKHDF/Offsets", H5T_NATIVE_INT64, 1, &piece->offsets, numbers));
    memset(types, mesh->nodes_per_tet == 4 ? VTK_TETRA : VTK_QUADRATIC_TETRA, (size_t)piece->tets.count);
    status = ost_hdf5_write_rows(h5, "/VTKHDF/Types", H5T_NATIVE_UCHAR, 1, &piece->tets, types);
done:
    OST_FREE(numbers, types);
    return status;
}
