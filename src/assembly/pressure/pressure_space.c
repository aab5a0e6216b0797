/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/pressure/pressure_space.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/numbering.h"
#include "core/parallel/reduce.h"

#include <math.h>

/* Regions that have a pressure of their own at one vertex; if more meet there, the last ones share one. */
enum { MOST_REGIONS = 6 };

/* What its owner says of a vertex: the global number of its first pressure, and the regions in ascending order. */
typedef struct Vertex {
    OstGlobal first;
    int32_t count, region[MOST_REGIONS];
} Vertex;

void ost_pressure_space_destroy(OstPressureSpace **space)
{
    if (!*space)
        return;
    OST_FREE((*space)->first);
    OST_FREE((*space)->of_tet);
    OST_FREE((*space)->region);
    ost_halo_destroy(&(*space)->halo);
    OST_FREE(*space);
}

static void add_region(Vertex *vertex, int32_t region)
{
    int at = 0;
    while (at < vertex->count && vertex->region[at] < region)
        at++;
    if (at == MOST_REGIONS || (at < vertex->count && vertex->region[at] == region))
        return;
    if (vertex->count < MOST_REGIONS)
        vertex->count++;
    for (int k = vertex->count - 1; k > at; k--)
        vertex->region[k] = vertex->region[k - 1];
    vertex->region[at] = region;
}

static int slot_of(const Vertex *vertex, int32_t region)
{
    int at = 0;
    while (at + 1 < vertex->count && vertex->region[at] < region)
        at++;
    return at;
}

static void find_regions(const OstMesh *mesh, const OstMaterialField *field, Vertex *vertex)
{
    for (OstLocal tet = 0; tet < mesh->tet_count; tet++) {
        const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
        for (int v = 0; v < 4 && ost_field_stiff_mode(field, mesh->tet_region[tet]); v++)
            if (nodes[v] < mesh->owned_nodes)
                add_region(&vertex[nodes[v]], mesh->tet_region[tet]);
    }
}

/* Numbers the pressures in the order of their vertices: this rank's, then ghosts. */
static OstStatus number_locally(OstPressureSpace *space, const Vertex *vertex)
{
    const OstMesh *mesh = space->mesh;
    OST_TRY(OST_NEW(space->ctx, &space->first, mesh->node_count + 1));
    for (OstLocal node = 0; node < mesh->node_count; node++) {
        space->count += vertex[node].count;
        space->first[node + 1] = space->count;
        if (node < mesh->owned_nodes)
            space->owned = space->count;
    }
    OST_TRY(OST_NEW(space->ctx, &space->region, space->count));
    for (OstLocal node = 0; node < mesh->node_count; node++)
        for (int k = 0; k < vertex[node].count; k++)
            space->region[space->first[node] + k] = vertex[node].region[k];
    OST_TRY(OST_NEW(space->ctx, &space->of_tet, 4 * (size_t)mesh->tet_count));
    return OST_SUCCESS;
}

static void number_tets(OstPressureSpace *space, const OstMaterialField *field, const Vertex *vertex)
{
    const OstMesh *mesh = space->mesh;
    for (OstLocal tet = 0; tet < mesh->tet_count; tet++) {
        const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
        const int32_t region = mesh->tet_region[tet];
        const int has = ost_field_stiff_mode(field, region) != NULL;
        for (int v = 0; v < 4; v++)
            space->of_tet[4 * (size_t)tet + (size_t)v] =
                has ? space->first[nodes[v]] + slot_of(&vertex[nodes[v]], region) : -1;
    }
}

/* Owners tell the numbers of their vertices' pressures. */
static OstStatus number_globally(OstPressureSpace *space, Vertex *vertex)
{
    const OstMesh *mesh = space->mesh;
    OstGlobal next = 0, mine = 0;
    for (OstLocal node = 0; node < mesh->owned_nodes; node++)
        mine += vertex[node].count;
    OST_TRY(ost_number_from(space->ctx, mine, &next, &space->global));
    for (OstLocal node = 0; node < mesh->owned_nodes; node++) {
        vertex[node].first = next;
        next += vertex[node].count;
    }
    return ost_agree(space->ctx, ost_halo_import(mesh->halo, sizeof *vertex, vertex));
}

static OstStatus connect(OstPressureSpace *space, const Vertex *vertex, OstGlobal *number)
{
    const OstMesh *mesh = space->mesh;
    const OstGlobal first = mesh->owned_nodes > 0 ? vertex[0].first : 0;
    OstLocal ghosts = 0;
    for (OstLocal node = mesh->owned_nodes; node < mesh->node_count; node++)
        for (int k = 0; k < vertex[node].count; k++)
            number[ghosts++] = vertex[node].first + k;
    return ost_halo_create(space->ctx, space->owned, first, ghosts, number, &space->halo);
}

static OstStatus create(OstPressureSpace *space, const OstMaterialField *field)
{
    OstContext *ctx = space->ctx;
    const OstMesh *mesh = space->mesh;
    Vertex *vertex = NULL;
    OstGlobal *number = NULL;
    double most = 0.0;
    OstStatus status = OST_NEW(ctx, &vertex, mesh->node_count);
    OST_TRY_DONE(ost_agree(ctx, status));
    find_regions(mesh, field, vertex);
    OST_TRY_DONE(number_globally(space, vertex));
    for (OstLocal node = 0; node < mesh->node_count; node++)
        most = fmax(most, vertex[node].count);
    OST_TRY_DONE(ost_max(ctx, 1, &most));
    space->most = (int)most;
    status = number_locally(space, vertex);
    OST_THEN(OST_NEW(ctx, &number, space->count - space->owned));
    OST_TRY_DONE(ost_agree(ctx, status));
    number_tets(space, field, vertex);
    OST_TRY_DONE(ost_agree(ctx, connect(space, vertex, number)));
done:
    OST_FREE(vertex);
    OST_FREE(number);
    return status;
}

OstStatus ost_pressure_space_create(const OstMesh *mesh, const OstMaterialField *field, OstPressureSpace **space)
{
    OstContext *ctx = mesh->ctx;
    OstPressureSpace *made = NULL;
    ost_ledger_enter(ctx, OST_EFFECT_MIXED);
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, &made, 1));
    if (status == OST_SUCCESS) {
        made->ctx = ctx;
        made->mesh = mesh;
        status = create(made, field);
    }
    if (status != OST_SUCCESS)
        ost_pressure_space_destroy(&made);
    ost_ledger_leave(ctx);
    *space = made;
    return status;
}

OstStatus ost_pressure_complete(const OstPressureSpace *space, double *pressure)
{
    return ost_agree(space->ctx, ost_halo_import(space->halo, sizeof *pressure, pressure));
}

void ost_pressure_of_tets(const OstPressureSpace *space, const double *pressure, double *of_tets)
{
    for (size_t i = 0; i < 4 * (size_t)space->mesh->tet_count; i++)
        of_tets[i] = space->of_tet[i] < 0 ? 0.0 : pressure[space->of_tet[i]];
}
