/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/identity.h"

#include "core/error.h"
#include "core/hash.h"
#include "core/memory.h"
#include "core/number_set.h"
#include "core/parallel/gather.h"
#include "core/parallel/reduce.h"
#include "material/directions.h"
#include "material/field_data.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Sums agree if they differ by no more than this share of their terms. */
static const double same = 1e-9;

static uint64_t hash_table(uint64_t hash, const OstTimeTable *table)
{
    hash = ost_hash(hash, (size_t)table->count * sizeof(double), table->time);
    return ost_hash(hash, (size_t)table->count * sizeof(double), table->factor);
}

/* --- bits, as this partition has them --- */

static uint64_t hash_supports(uint64_t hash, const OstSupports *supports)
{
    for (OstLocal s = 0; s < supports->count; s++) {
        const OstSupport *support = &supports->support[s];
        hash = ost_hash(hash, 3 * (size_t)support->constrained * sizeof(double), support->direction);
        hash = ost_hash(hash, (size_t)support->constrained * sizeof(double), support->prescribed);
    }
    if (supports->spring)
        hash = ost_hash(hash, 9 * (size_t)supports->mesh->node_count * sizeof(double), supports->spring);
    return ost_hash(hash, (size_t)supports->mesh->node_count * sizeof(OstLocal), supports->index);
}

static uint64_t hash_follower(uint64_t hash, const OstFollower *follower)
{
    for (; follower; follower = follower->next) {
        const size_t nodes = (size_t)follower->nodes_per_face * (size_t)follower->count;
        hash = ost_hash(hash, nodes * sizeof(OstLocal), follower->faces);
        hash = ost_hash(hash, sizeof follower->pressure, &follower->pressure);
        hash = ost_hash(hash, sizeof follower->function, &follower->function);
    }
    return hash;
}

/* Of a tet. */
static size_t eigenstrain_numbers(const OstMaterialField *field)
{
    return (size_t)field->eigenstrain_places * ost_field_eigenstrain_columns(field);
}

static uint64_t hash_field(uint64_t hash, const OstMaterialField *field, OstLocal tets)
{
    if (field->region_axes)
        hash = ost_hash(hash, 9 * (size_t)field->region_count * sizeof(double), field->region_axes);
    if (field->region_eigenstrain)
        hash = ost_hash(hash, 6 * (size_t)field->region_count * sizeof(double), field->region_eigenstrain);
    if (field->region_per_unit)
        hash = ost_hash(hash, 6 * (size_t)field->region_count * sizeof(double), field->region_per_unit);
    if (field->tet_eigenstrain)
        hash = ost_hash(hash, eigenstrain_numbers(field) * (size_t)tets * sizeof(double), field->tet_eigenstrain);
    if (field->tet_directions)
        hash = ost_hash(hash, OST_DIRECTIONS * (size_t)tets * sizeof(float), field->tet_directions);
    return field->tet_turn ? ost_hash(hash, 4 * (size_t)tets * sizeof(double), field->tet_turn) : hash;
}

/* What this rank knows of the problem. */
static uint64_t hash_here(const OstProblem *problem)
{
    const OstMesh *mesh = problem->mesh;
    const size_t loads = 3 * (size_t)mesh->owned_nodes * sizeof(double);
    const size_t corners = (size_t)mesh->tet_count * (size_t)mesh->nodes_per_tet;
    uint64_t hash = ost_hash(OST_HASH_START, 3 * (size_t)mesh->node_count * sizeof(double), mesh->coordinates);
    hash = ost_hash(hash, (size_t)mesh->node_count * sizeof(OstGlobal), mesh->node_label);
    hash = ost_hash(hash, corners * sizeof(OstLocal), mesh->tet_nodes);
    hash = hash_field(hash, problem->field, mesh->tet_count);
    hash = hash_follower(hash, problem->follower);
    hash = hash_supports(ost_hash(hash, loads, problem->force), problem->supports);
    for (int k = 0; k < problem->timed_count; k++)
        hash = hash_supports(ost_hash(hash, loads, problem->timed[k].force), problem->timed[k].supports);
    return hash;
}

static OstStatus hash_bits(const OstProblem *problem, uint64_t *bits)
{
    const uint64_t here = hash_here(problem);
    uint64_t *all = NULL;
    OstLocal total = 0;
    OST_TRY(ost_gather_items(problem->ctx, sizeof here, &here, 1, "there are too many ranks", (void **)&all, &total));
    *bits = ost_hash(OST_HASH_START, (size_t)total * sizeof *all, all);
    OST_FREE(all);
    return OST_SUCCESS;
}

/* --- what does not depend on the partition --- */

static OstStatus hash_mesh(const OstProblem *problem, uint64_t *hash)
{
    const OstMesh *mesh = problem->mesh;
    *hash = 0;
    for (OstLocal t = 0; t < mesh->owned_tets; t++) {
        OstGlobal labels[12];
        for (int a = 0; a < mesh->nodes_per_tet; a++)
            labels[a] = mesh->node_label[ost_mesh_nodes_of(mesh, t)[a]];
        qsort(labels, (size_t)mesh->nodes_per_tet, sizeof *labels, ost_compare_numbers);
        labels[mesh->nodes_per_tet] = mesh->tet_label[t];
        labels[mesh->nodes_per_tet + 1] = mesh->tet_region[t];
        *hash += ost_hash(OST_HASH_START, (size_t)(mesh->nodes_per_tet + 2) * sizeof *labels, labels);
    }
    OST_TRY(OST_MPI(problem->ctx, MPI_Allreduce(MPI_IN_PLACE, hash, 1, MPI_UINT64_T, MPI_SUM, ost_comm(problem->ctx))));
    for (int k = 0; k < problem->timed_count; k++)
        *hash = hash_table(*hash, &problem->timed[k].table);
    for (int r = 0; r < problem->field->region_count; r++)
        *hash = ost_hash(*hash, sizeof(OstOrthotropic), &problem->field->material[r].constants);
    return OST_SUCCESS;
}

/* A number between -1 and 1 for each component of a node or tet (G. Steele and others, Fast splittable pseudorandom
 * number generators, 2014). */
static double weight_of(OstGlobal label, int component)
{
    uint64_t z = ((uint64_t)label << 6 | (uint64_t)component) * UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return (double)(z >> 11) * 0x1p-52 - 1.0;
}

/* `first` tells several arrays of one mark apart. */
static void add(OstProblemIdentity *identity, OstMark mark, OstGlobal label, int first, int count, const double *values)
{
    for (int i = 0; i < count; i++) {
        identity->mark[mark] += weight_of(label, first + i) * values[i];
        identity->size[mark] += fabs(values[i]);
    }
}

static void add_supports(OstProblemIdentity *identity, const OstSupports *supports, OstLocal node, OstGlobal label,
                         int function)
{
    double projector[9], prescribed[3];
    if (ost_supports_get(supports, node, projector, prescribed) > 0 && function == 0)
        add(identity, OST_MARK_SUPPORT, label, 0, 9, projector);
    add(identity, OST_MARK_SUPPORT, label, 9 + 3 * (function % 16), 3, prescribed);
    if (supports->spring && function == 0)
        add(identity, OST_MARK_SPRING, label, 0, 9, supports->spring + 9 * (size_t)node);
}

static void add_nodes(OstProblemIdentity *identity, const OstProblem *problem)
{
    const OstMesh *mesh = problem->mesh;
    for (OstLocal n = 0; n < mesh->owned_nodes; n++) {
        const OstGlobal label = mesh->node_label[n];
        const size_t at = 3 * (size_t)n;
        add(identity, OST_MARK_PLACES, label, 0, 3, mesh->coordinates + at);
        add(identity, OST_MARK_LOAD, label, 0, 3, problem->force + at);
        add_supports(identity, problem->supports, n, label, 0);
        for (int k = 0; k < problem->timed_count; k++) {
            add(identity, OST_MARK_LOAD, label, 3 + 3 * (k % 16), 3, problem->timed[k].force + at);
            add_supports(identity, problem->timed[k].supports, n, label, k + 1);
        }
    }
}

/* By the nodes of the faces, each on its owner. */
static void add_followers(OstProblemIdentity *identity, const OstProblem *problem)
{
    for (const OstFollower *follower = problem->follower; follower; follower = follower->next)
        for (OstLocal i = 0; i < follower->count * follower->nodes_per_face; i++)
            if (follower->faces[i] < problem->mesh->owned_nodes)
                add(identity, OST_MARK_PRESSURE, problem->mesh->node_label[follower->faces[i]], follower->function % 64,
                    1, &follower->pressure);
}

static void add_tets(OstProblemIdentity *identity, const OstProblem *problem)
{
    const OstMaterialField *field = problem->field;
    for (OstLocal t = 0; t < problem->mesh->owned_tets; t++) {
        const OstGlobal label = problem->mesh->tet_label[t];
        const size_t region = (size_t)problem->mesh->tet_region[t];
        double axes[9];
        ost_field_axes(field, t, axes);
        add(identity, OST_MARK_MATERIAL, label, 0, 9, axes);
        if (field->region_eigenstrain)
            add(identity, OST_MARK_MATERIAL, label, 9, 6, field->region_eigenstrain + 6 * region);
        if (field->region_per_unit)
            add(identity, OST_MARK_MATERIAL, label, 15, 6, field->region_per_unit + 6 * region);
        if (field->tet_eigenstrain)
            add(identity, OST_MARK_MATERIAL, label, 21, (int)eigenstrain_numbers(field),
                field->tet_eigenstrain + eigenstrain_numbers(field) * (size_t)t);
    }
}

OstStatus ost_problem_identify(const OstProblem *problem, OstProblemIdentity *identity)
{
    *identity = (OstProblemIdentity){.text = problem->c ? problem->c->text_hash : 0,
                                     .accuracy = problem->accuracy,
                                     .ranks = ost_size(problem->ctx),
                                     .formulation = problem->beyond_linear,
                                     .automatic = problem->automatic};
    OST_TRY(hash_bits(problem, &identity->bits));
    OST_TRY(hash_mesh(problem, &identity->mesh));
    add_nodes(identity, problem);
    add_followers(identity, problem);
    add_tets(identity, problem);
    OST_TRY(ost_sum(problem->ctx, OST_MARKS, identity->mark));
    return ost_sum(problem->ctx, OST_MARKS, identity->size);
}

static const char *formulation_words(const OstProblemIdentity *identity)
{
    static const char *const words[] = {"large_rotation: off", "formulation: consistent", "formulation: classical"};
    return words[identity->formulation];
}

/* Of what does not depend on the partition, the first that differs. */
static const char *what_differs(const OstProblemIdentity *found, const OstProblemIdentity *expected)
{
    static const char *const words[] = {
#define OST_MARK_TEXT(name, text) text,
        OST_MARK_TABLE(OST_MARK_TEXT)
#undef OST_MARK_TEXT
    };
    if (found->mesh != expected->mesh)
        return "mesh, materials or time tables have";
    for (int m = 0; m < OST_MARKS; m++)
        if (!(fabs(found->mark[m] - expected->mark[m]) <= same * expected->size[m]) ||
            !(fabs(found->size[m] - expected->size[m]) <= same * expected->size[m]))
            return words[m];
    return found->ranks == expected->ranks && found->bits != expected->bits ? "numbers or the partition have" : NULL;
}

int ost_problem_differs(const OstProblemIdentity *found, const OstProblemIdentity *expected,
                        char text[OST_LONGEST_DIFFERENCE])
{
    const char *differs = NULL;
    text[0] = 0;
    if (found->formulation != expected->formulation)
        snprintf(text, OST_LONGEST_DIFFERENCE, "it was made with %s, and this run has %s", formulation_words(found),
                 formulation_words(expected));
    else if (found->automatic != expected->automatic || found->accuracy != expected->accuracy)
        snprintf(text, OST_LONGEST_DIFFERENCE, "large_rotation or the accuracy asked for have changed since");
    else if (found->text != expected->text)
        snprintf(text, OST_LONGEST_DIFFERENCE, "it is that of another case, or the case file has changed since");
    else
        differs = what_differs(found, expected);
    if (differs)
        snprintf(text, OST_LONGEST_DIFFERENCE, "%s changed since", differs);
    return text[0] != 0;
}
