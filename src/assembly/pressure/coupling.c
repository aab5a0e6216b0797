/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/batch.h"
#include "assembly/pressure/link.h"
#include "assembly/pressure/pressure_space.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "element/large_rotation.h"

#include <stdlib.h>
#include <string.h>

enum { VERTICES = 4, NODES = 10 };

/* The tets of each pressure. */
typedef struct PressureTets {
    OstLocal *start; /* count + 1 */
    OstLocal *tet;
} PressureTets;

static OstStatus find_tets(const OstPressureSpace *space, PressureTets *tets)
{
    const size_t corners = VERTICES * (size_t)space->mesh->tet_count;
    OST_TRY(OST_NEW(space->ctx, &tets->start, space->count + 1));
    for (size_t i = 0; i < corners; i++)
        if (space->of_tet[i] >= 0)
            tets->start[space->of_tet[i]]++;
    for (OstLocal r = 0; r < space->count; r++)
        tets->start[r + 1] += tets->start[r];
    OST_TRY(OST_NEW(space->ctx, &tets->tet, tets->start[space->count]));
    for (size_t i = corners; i-- > 0;) /* filled from the back, as in pattern.c */
        if (space->of_tet[i] >= 0)
            tets->tet[--tets->start[space->of_tet[i]]] = (OstLocal)(i / VERTICES);
    return OST_SUCCESS;
}

static int compare(const void *a, const void *b)
{
    const OstLocal x = *(const OstLocal *)a, y = *(const OstLocal *)b;
    return (x > y) - (x < y);
}

/* The columns of B: those of the system's matrix or, where nodes follow others, local nodes at first. */
typedef struct Columns {
    OstLocal count;
    OstLocal *of_node; /* node_count; -1: none, nothing of the node can move */
    int *face;         /* node_count: the rigid face that moves the node, from 1, or 0; NULL: there is none */
    OstRowNumbers rows;
} Columns;

/* What the rows of B, or of M, list of a tet. */
typedef struct Pattern {
    const OstPressureSpace *space;
    const Columns *columns; /* NULL: the rows of M */
    const PressureTets *tets;
    OstLocal *seen; /* the last row that had this column */
} Pattern;

static int columns_of_tet(const Pattern *pattern, OstLocal tet, OstLocal columns[NODES])
{
    const OstLocal *pressures = pattern->space->of_tet + VERTICES * (size_t)tet;
    const OstLocal *nodes = ost_mesh_nodes_of(pattern->space->mesh, tet);
    const int count = pattern->columns ? NODES : VERTICES;
    for (int a = 0; a < count; a++)
        columns[a] = pattern->columns ? pattern->columns->of_node[nodes[a]] : pressures[a];
    return count;
}

/* The columns of a row, ascending; with `columns` NULL only their number. */
static OstLocal list_row(const Pattern *pattern, OstLocal row, OstLocal *columns)
{
    OstLocal count = 0;
    for (OstLocal i = pattern->tets->start[row]; i < pattern->tets->start[row + 1]; i++) {
        OstLocal of_tet[NODES];
        const int width = columns_of_tet(pattern, pattern->tets->tet[i], of_tet);
        for (int a = 0; a < width; a++) {
            if (of_tet[a] < 0 || pattern->seen[of_tet[a]] == row)
                continue;
            pattern->seen[of_tet[a]] = row;
            if (columns)
                columns[count] = of_tet[a];
            count++;
        }
    }
    if (columns)
        qsort(columns, (size_t)count, sizeof *columns, compare);
    return count;
}

static OstStatus make_rows(const OstPressureSpace *space, const Columns *columns, const PressureTets *tets,
                           OstLocal rows, OstLocal **start, OstLocal **column)
{
    OstContext *ctx = space->ctx;
    Pattern pattern = {space, columns, tets, NULL};
    const OstLocal width = columns ? columns->count : space->count;
    OstStatus status = OST_NEW(ctx, &pattern.seen, width);
    OST_THEN(OST_NEW(ctx, start, rows + 1));
    for (int fill = 0; fill < 2 && status == OST_SUCCESS; fill++) {
        for (OstLocal c = 0; c < width; c++)
            pattern.seen[c] = -1;
        OstGlobal entries = 0;
        for (OstLocal row = 0; row < rows && status == OST_SUCCESS; row++) {
            entries += list_row(&pattern, row, fill ? *column + (*start)[row] : NULL);
            status = ost_limit_nonzeros(ctx, entries);
            (*start)[row + 1] = (OstLocal)entries;
        }
        if (!fill)
            OST_THEN(OST_NEW(ctx, column, (*start)[rows]));
    }
    OST_FREE(pattern.seen);
    return status;
}

typedef struct TetCoupling {
    OstSimd columns[VERTICES * 3 * NODES], eigen[VERTICES], mass[10];
} TetCoupling;

static int pair_of(int v, int w)
{
    return v <= w ? ost_pair_index(VERTICES, v, w) : ost_pair_index(VERTICES, w, v);
}

/* Does a tet keep its volume, as none of its nodes can move, or all move with one rigid face? */
static int keeps_volume(const Columns *columns, const OstLocal *nodes)
{
    const int face = columns->face ? columns->face[nodes[0]] : 0;
    int fixed = 1, rigid = face > 0;
    for (int a = 0; a < NODES; a++) {
        fixed &= columns->of_node[nodes[a]] < 0;
        rigid &= columns->face && columns->face[nodes[a]] == face;
    }
    return fixed || rigid;
}

static int any_keeps_volume(const OstPressureSpace *space, const Columns *columns)
{
    const OstMesh *mesh = space->mesh;
    for (OstLocal tet = 0; tet < mesh->tet_count; tet++)
        if (space->of_tet[VERTICES * (size_t)tet] >= 0 && keeps_volume(columns, ost_mesh_nodes_of(mesh, tet)))
            return 1;
    return 0;
}

/* Adds a tet's part of a row of M. Of the Schur complement a tet that keeps its volume has C alone. */
static void add_mass(int slot, const TetCoupling *of_tet, int v, const OstLocal *pressures, int is_fixed,
                     OstCoupling *coupling)
{
    const OstLocal row = pressures[v];
    const double share = is_fixed ? coupling->looseness[row] / coupling->schur[row] : 1.0;
    for (int w = 0; w < VERTICES; w++) {
        const OstLocal k = ost_row_find(coupling->mass_start, coupling->mass_column, row, pressures[w]);
        const double mass = of_tet->mass[pair_of(v, w)][slot];
        coupling->mass[k] += mass;
        if (coupling->estimate != coupling->mass)
            coupling->estimate[k] += share * mass;
    }
}

/* Adds B's part of a tet, and M's. */
static void add_tet(const OstPressureSpace *space, const Columns *columns, const OstBatch *batch, int slot,
                    const TetCoupling *of_tet, int with_mass, OstCoupling *coupling)
{
    const OstLocal *pressures = space->of_tet + VERTICES * (size_t)batch->tet[slot];
    const int held = with_mass && keeps_volume(columns, batch->node[slot]);
    for (int v = 0; v < VERTICES && pressures[v] >= 0; v++) {
        const OstLocal row = pressures[v];
        for (int a = 0; a < NODES && !held; a++) {
            const OstLocal column = columns->of_node[batch->node[slot][a]];
            if (column < 0)
                continue;
            double *value =
                coupling->value + 3 * (size_t)ost_row_find(coupling->row_start, coupling->column, row, column);
            for (int i = 0; i < 3; i++)
                value[i] += of_tet->columns[3 * NODES * v + 3 * a + i][slot];
        }
        if (with_mass && row < coupling->rows)
            add_mass(slot, of_tet, v, pressures, held, coupling);
    }
}

static void add_tets(const OstPressureSpace *space, const Columns *columns, const OstMaterialField *field,
                     const double *u, int with_mass, OstCoupling *coupling)
{
    const OstMesh *mesh = space->mesh;
    const OstElement *element = ost_element_of(NODES);
    OstBatch batch;
    TetCoupling of_tets;
    OstSimd displacement[3 * NODES], volume[VERTICES];
    ost_elasticity_clear(&batch.elasticity);
    for (OstLocal first = 0; first < mesh->tet_count; first += batch.count) {
        ost_batch_gather_from(&batch, element, mesh, field, first, mesh->tet_count);
        if (!batch.elasticity.mixed)
            continue;
        if (u) {
            ost_batch_keep_alike(&batch, element, mesh, field);
            ost_batch_gather_vectors(&batch, NODES, u, displacement);
            ost_large_rotation_coupling(element, batch.x, &batch.elasticity, displacement, of_tets.columns, volume);
        } else
            element->coupling(batch.x, &batch.elasticity, of_tets.columns, of_tets.eigen, of_tets.mass);
        for (int slot = 0; slot < batch.count; slot++)
            add_tet(space, columns, &batch, slot, &of_tets, with_mass, coupling);
    }
}

/* B P. */
static void project(const OstSystem *system, OstCoupling *coupling)
{
    for (OstLocal k = 0; k < coupling->row_start[coupling->columns]; k++) {
        double projector[9], whole[3];
        const OstLocal node = system->node_of_row[coupling->column[k]];
        if (ost_supports_get(system->supports, node, projector, NULL) == 0)
            continue;
        memcpy(whole, coupling->value + 3 * (size_t)k, sizeof whole);
        ost_apply3(projector, whole, coupling->value + 3 * (size_t)k);
    }
}

/* What the mass is multiplied by. */
static void find_scales(const OstPressureSpace *space, const OstMaterialField *field, OstCoupling *coupling)
{
    for (OstLocal row = 0; row < coupling->rows; row++) {
        coupling->looseness[row] = field->mixed.looseness[space->region[row]];
        coupling->schur[row] = ost_field_giving_way(field, space->region[row]);
    }
}

/* A pressure that nothing depends on is alone. */
static void find_diagonal(OstCoupling *coupling)
{
    for (OstLocal row = 0; row < coupling->rows; row++) {
        const OstLocal k = ost_row_find(coupling->mass_start, coupling->mass_column, row, row);
        if (coupling->estimate[k] == 0.0)
            coupling->estimate[k] = coupling->mass[k];
        coupling->diagonal[row] = coupling->estimate[k];
    }
}

/* Nodes that something moves keep their place; those of a rigid face are told apart by its carriers. */
static OstStatus number_nodes(const OstSystem *system, Columns *columns)
{
    const OstLinks *links = system->supports->links;
    const OstMesh *mesh = system->mesh;
    columns->count = mesh->node_count;
    OST_TRY(OST_NEW(system->ctx, &columns->of_node, mesh->node_count));
    OST_TRY(OST_NEW(system->ctx, &columns->face, mesh->node_count));
    for (OstLocal n = 0; n < mesh->node_count; n++) {
        const OstLink *link = ost_link_of(links, n);
        OstRowParts parts;
        ost_row_parts(&columns->rows, n, &parts);
        columns->of_node[n] = -1;
        for (int k = 0; k < parts.count; k++)
            if (parts.row[k] >= 0)
                columns->of_node[n] = n;
        for (int f = 0; f < links->face_count && link && link->count > 0; f++)
            for (int k = 0; k < 2; k++)
                if (link->leader[0].number == links->face[f].carrier[k])
                    columns->face[n] = f + 1;
    }
    return OST_SUCCESS;
}

/* Collective. */
static OstStatus find_columns(const OstSystem *system, Columns *columns)
{
    if (!system->supports->links) {
        *columns = (Columns){.count = system->matrix->columns, .of_node = system->row_of_node};
        return OST_SUCCESS;
    }
    OST_TRY(ost_row_numbers_create(system->supports->links, system->row_of_node, system->matrix->first_row,
                                   &columns->rows));
    return ost_agree(system->ctx, number_nodes(system, columns));
}

static void clear_columns(const OstSystem *system, Columns *columns)
{
    if (columns->of_node != system->row_of_node)
        OST_FREE(columns->of_node);
    OST_FREE(columns->face);
    ost_row_numbers_clear(&columns->rows);
}

static OstStatus assemble(const OstPressureSpace *space, const OstSystem *system, const Columns *columns,
                          const OstMaterialField *field, const double *u, OstCoupling *coupling)
{
    OstContext *ctx = space->ctx;
    PressureTets tets = {0};
    OstStatus status;
    *coupling = (OstCoupling){.ctx = ctx,
                              .rows = space->owned,
                              .columns = space->count,
                              .unknowns = system->matrix->rows,
                              .global_rows = space->global,
                              .halo = space->halo};
    OST_TRY_DONE(find_tets(space, &tets));
    OST_TRY_DONE(make_rows(space, columns, &tets, space->count, &coupling->row_start, &coupling->column));
    OST_TRY_DONE(make_rows(space, NULL, &tets, space->owned, &coupling->mass_start, &coupling->mass_column));
    OST_TRY_DONE(OST_NEW(ctx, &coupling->value, 3 * (size_t)coupling->row_start[space->count]));
    OST_TRY_DONE(OST_NEW(ctx, &coupling->mass, coupling->mass_start[space->owned]));
    OST_TRY_DONE(OST_NEW(ctx, &coupling->diagonal, space->owned));
    OST_TRY_DONE(OST_NEW(ctx, &coupling->looseness, space->owned));
    OST_TRY_DONE(OST_NEW(ctx, &coupling->schur, space->owned));
    coupling->estimate = coupling->mass;
    if (any_keeps_volume(space, columns))
        OST_TRY_DONE(OST_NEW(ctx, &coupling->estimate, coupling->mass_start[space->owned]));
    find_scales(space, field, coupling);
    add_tets(space, columns, field, NULL, 1, coupling);
    if (u) {
        memset(coupling->value, 0, 3 * (size_t)coupling->row_start[coupling->columns] * sizeof *coupling->value);
        add_tets(space, columns, field, u, 0, coupling);
    }
    if (!system->supports->links)
        project(system, coupling);
    find_diagonal(coupling);
done:
    OST_FREE(tets.start);
    OST_FREE(tets.tet);
    return status;
}

static OstStatus create(const OstPressureSpace *space, const OstSystem *system, const OstMaterialField *field,
                        const double *u, OstCoupling **coupling)
{
    OstContext *ctx = space->ctx;
    Columns columns = {0};
    *coupling = NULL;
    ost_ledger_enter(ctx, OST_EFFECT_MIXED);
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, coupling, 1));
    OST_THEN(find_columns(system, &columns));
    OST_THEN(ost_agree(ctx, assemble(space, system, &columns, field, u, *coupling)));
    if (system->supports->links)
        OST_THEN(ost_coupling_link(space, system, &columns.rows, *coupling));
    clear_columns(system, &columns);
    if (status != OST_SUCCESS)
        ost_coupling_destroy(coupling);
    ost_ledger_leave(ctx);
    return status;
}

OstStatus ost_pressure_coupling(const OstPressureSpace *space, const OstSystem *system, const OstMaterialField *field,
                                OstCoupling **coupling)
{
    return create(space, system, field, NULL, coupling);
}

/* Made anew, with the same columns. */
static OstStatus refill_linked(const OstPressureSpace *space, const OstSystem *system, const OstMaterialField *field,
                               const double *u, OstCoupling *coupling)
{
    OstCoupling *fresh;
    OST_TRY(create(space, system, field, u, &fresh));
    memcpy(coupling->value, fresh->value, 3 * (size_t)coupling->row_start[coupling->columns] * sizeof *coupling->value);
    ost_coupling_destroy(&fresh);
    return OST_SUCCESS;
}

OstStatus ost_pressure_coupling_at(const OstPressureSpace *space, const OstSystem *system,
                                   const OstMaterialField *field, const double *u, OstCoupling *coupling)
{
    const Columns columns = {.count = system->matrix->columns, .of_node = system->row_of_node};
    if (system->supports->links)
        return refill_linked(space, system, field, u, coupling);
    ost_ledger_enter(space->ctx, OST_EFFECT_MIXED);
    memset(coupling->value, 0, 3 * (size_t)coupling->row_start[coupling->columns] * sizeof *coupling->value);
    add_tets(space, &columns, field, u, 0, coupling);
    project(system, coupling);
    ost_ledger_leave(space->ctx);
    return OST_SUCCESS;
}

/* The second equation of a batch by linear theory, of each vertex's share. */
static void find_linear(const OstBatch *batch, const TetCoupling *of_tets, const OstSimd *u, OstSimd volume[VERTICES])
{
    for (int v = 0; v < VERTICES; v++) {
        const OstSimd *columns = of_tets->columns + 3 * NODES * v;
        volume[v] = -of_tets->eigen[v];
        for (int n = 3; n < 3 * NODES; n++)
            volume[v] += columns[n] * (u[n] - u[n % 3]);
        for (int w = 0; w < VERTICES; w++)
            volume[v] -= batch->elasticity.looseness * of_tets->mass[pair_of(v, w)] * batch->elasticity.pressure[w];
    }
}

static void add_volume(const OstPressureSpace *space, const OstBatch *batch, const TetCoupling *of_tets,
                       const OstSimd of_batch[VERTICES], double *volume, double *mass)
{
    for (int slot = 0; slot < batch->count; slot++)
        for (int v = 0; v < VERTICES; v++) {
            const OstLocal row = space->of_tet[VERTICES * (size_t)batch->tet[slot] + (size_t)v];
            if (row < 0 || row >= space->owned)
                continue;
            volume[row] += of_batch[v][slot];
            for (int w = 0; w < VERTICES && mass; w++)
                mass[row] += of_tets->mass[pair_of(v, w)][slot];
        }
}

OstStatus ost_pressure_volume(const OstPressureSpace *space, const OstMaterialField *field, OstFormulation formulation,
                              double share, const double *u, double *volume, double *mass)
{
    const OstMesh *mesh = space->mesh;
    const OstElement *element = ost_element_of(NODES);
    OstBatch batch;
    TetCoupling of_tets;
    OstSimd displacement[3 * NODES], of_batch[VERTICES];
    memset(volume, 0, (size_t)space->owned * sizeof *volume);
    if (mass)
        memset(mass, 0, (size_t)space->owned * sizeof *mass);
    ost_elasticity_clear(&batch.elasticity);
    batch.elasticity.eigen_share = share;
    for (OstLocal first = 0; first < mesh->tet_count; first += batch.count) {
        ost_batch_gather_from(&batch, element, mesh, field, first, mesh->tet_count);
        if (!batch.elasticity.mixed)
            continue;
        if (formulation != OST_FORMULATION_LINEAR)
            ost_batch_keep_alike(&batch, element, mesh, field);
        ost_batch_gather_vectors(&batch, NODES, u, displacement);
        if (formulation == OST_FORMULATION_LINEAR || mass)
            element->coupling(batch.x, &batch.elasticity, of_tets.columns, of_tets.eigen, of_tets.mass);
        if (formulation == OST_FORMULATION_LINEAR)
            find_linear(&batch, &of_tets, displacement, of_batch);
        else
            ost_large_rotation_coupling(element, batch.x, &batch.elasticity, displacement, of_tets.columns, of_batch);
        add_volume(space, &batch, &of_tets, of_batch, volume, mass);
    }
    return OST_SUCCESS;
}
