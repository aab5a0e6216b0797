/* SPDX-License-Identifier: BSD-3-Clause */
#include "fields/output_field.h"

#include <stdio.h>
#include <string.h>

#define BIT(field) (1U << (field))

static const char vector[] = "x y z", tensor[] = "xx yy zz xy yz zx", own_tensor[] = "11 22 33 12 23 31";
static const char principal[] = "largest middle least";
static const char force[] = "force", force_per_area[] = "force per area", none[] = "none";

enum { STRESS = BIT(OST_FIELD_STRESS), STRAIN = BIT(OST_FIELD_STRAIN) };

static const char *const word_of[OST_FIELD_COUNT] = {
#define OST_FIELD_WORD(name, word) word,
    OST_OUTPUT_FIELD_TABLE(OST_FIELD_WORD)
#undef OST_FIELD_WORD
};

/* A field of doubles on the tets that is made of others. */
#define DERIVED(components, names, unit, needs, text)                                    \
    {                                                                                    \
        NULL, OST_ON_TETS, OST_VALUES_DOUBLE, components, names, unit, text, needs, 0, 1 \
    }
#define LOAD_FACTOR(criterion)                                                                                      \
    DERIVED(1, "", none, STRESS,                                                                                    \
            "by how much the load may grow before the tet's mean stress fails by " criterion "; 1e9: more, or the " \
            "material has no strengths")
#define DIRECTION(which) DERIVED(3, vector, none, STRESS, "unit vector along which the " which " principal stress acts")
#define MATERIAL_AXIS(which) DERIVED(3, vector, none, 0, "unit vector along material axis " which ", at the centroid")

#define BUCKLING_MODE(which)                                                                                         \
    {                                                                                                                \
        NULL, OST_ON_NODES, OST_VALUES_DOUBLE, 3, vector, none,                                                      \
            "the motion of the " which " load factor at which the body buckles, the largest displacement 1", 0, 0, 0 \
    }

static const OstOutputField kind[OST_FIELD_COUNT] = {
    [OST_FIELD_DISPLACEMENT] = {NULL, OST_ON_NODES, OST_VALUES_DOUBLE, 3, vector, "length", "displacement", 0, 0, 0},
    [OST_FIELD_REACTION] = {NULL, OST_ON_NODES, OST_VALUES_DOUBLE, 3, vector, force,
                            "force of supports and springs on the body", 0, 0, 0},
    [OST_FIELD_LOAD] = {NULL, OST_ON_NODES, OST_VALUES_DOUBLE, 3, vector, force,
                        "force of the loads on the node, weight included", 0, 0, 0},
    [OST_FIELD_STRESS] = {NULL, OST_ON_TETS, OST_VALUES_DOUBLE, 6, tensor, force_per_area,
                          "mean Cauchy stress over the tet", STRESS, 1, 0},
    [OST_FIELD_NODE_STRESS] = {NULL, OST_ON_NODES, OST_VALUES_DOUBLE, 6, tensor, force_per_area,
                               "Cauchy stress at the node, averaged over the tets around it",
                               BIT(OST_FIELD_NODE_STRESS), 1, 0},
    [OST_FIELD_STRAIN] = {NULL, OST_ON_TETS, OST_VALUES_DOUBLE, 6, tensor, none,
                          "mean strain over the tet, as a tensor: shear is half the engineering shear", STRAIN, 1, 0},
    [OST_FIELD_ENERGY] = {NULL, OST_ON_TETS, OST_VALUES_DOUBLE, 1, "", "energy per volume",
                          "mean strain energy density over the tet", BIT(OST_FIELD_ENERGY), 1, 0},
    [OST_FIELD_AXES] = {NULL, OST_ON_TETS, OST_VALUES_DOUBLE, 9, "e1x e1y e1z e2x e2y e2z e3x e3y e3z", none,
                        "material axes e1, e2, e3 at the centroid", 0, 0, 0},
    [OST_FIELD_REGION] = {NULL, OST_ON_TETS, OST_VALUES_INT32, 1, "", none, "number of the tet's region, from 0", 0, 0,
                          0},
    [OST_FIELD_RANK] = {NULL, OST_ON_TETS, OST_VALUES_INT32, 1, "", none, "rank that owned the tet", 0, 0, 0},
    [OST_FIELD_ERROR] = {NULL, OST_ON_TETS, OST_VALUES_DOUBLE, 1, "", "square root of energy",
                         "estimated error of the answer, in the norm of the energy", 0, 0, 0},
    [OST_FIELD_TSAI_WU] = LOAD_FACTOR("Tsai and Wu"),
    [OST_FIELD_HILL] = LOAD_FACTOR("Hill"),
    [OST_FIELD_MAXIMUM_STRESS] = LOAD_FACTOR("the largest stress along an axis"),
    [OST_FIELD_MATERIAL_STRESS] =
        DERIVED(6, own_tensor, force_per_area, STRESS, "mean stress over the tet, along its material axes"),
    [OST_FIELD_MATERIAL_STRAIN] = DERIVED(6, own_tensor, none, STRAIN,
                                          "mean strain over the tet, along its material axes, as a tensor: shear is "
                                          "half the engineering shear"),
    [OST_FIELD_VON_MISES] = DERIVED(1, "", force_per_area, STRESS, "von Mises stress of the tet's mean stress"),
    [OST_FIELD_PRESSURE] =
        DERIVED(1, "", force_per_area, STRESS, "minus a third of the trace of the tet's mean stress"),
    [OST_FIELD_PRINCIPAL_STRESS] =
        DERIVED(3, principal, force_per_area, STRESS, "principal stresses of the tet's mean stress"),
    [OST_FIELD_PRINCIPAL_DIRECTION_1] = DIRECTION("largest"),
    [OST_FIELD_PRINCIPAL_DIRECTION_2] = DIRECTION("middle"),
    [OST_FIELD_PRINCIPAL_DIRECTION_3] = DIRECTION("least"),
    [OST_FIELD_PRINCIPAL_STRAIN] = DERIVED(3, principal, none, STRAIN, "principal strains of the tet's mean strain"),
    [OST_FIELD_E1] = MATERIAL_AXIS("e1"),
    [OST_FIELD_E2] = MATERIAL_AXIS("e2"),
    [OST_FIELD_E3] = MATERIAL_AXIS("e3"),
    [OST_FIELD_MIXED_PRESSURE] = DERIVED(1, "", force_per_area, 0,
                                         "the mixed form's own pressure at the centroid: minus a third of the trace of "
                                         "the stress m p of the stiff mode; 0 in regions without one"),
    [OST_FIELD_BUCKLING_MODE_1] = BUCKLING_MODE("lowest"),
    [OST_FIELD_BUCKLING_MODE_2] = BUCKLING_MODE("second"),
    [OST_FIELD_BUCKLING_MODE_3] = BUCKLING_MODE("third"),
};

#define LABEL(word, centring, text)                                    \
    {                                                                  \
        word, centring, OST_VALUES_INT64, 1, "", "none", text, 0, 0, 0 \
    }
/* A field of the envelope of load cases, and which case governs there. */
#define EXTREME(word, centring, unit, text)                                               \
    {word, centring, OST_VALUES_DOUBLE, 1, "", unit, text " of all load cases", 0, 0, 0}, \
    {                                                                                     \
        word "_case", centring, OST_VALUES_INT32, 1, "", "none",                          \
            "number of the load case, from 1, that has the " text, 0, 0, 0                \
    }

static const OstOutputField label[] = {
    LABEL("vertex", OST_ON_NODES, "number of the vertex in the mesh file"),
    LABEL("tet", OST_ON_TETS, "number of the tet in the mesh file"),
    EXTREME("largest_displacement", OST_ON_NODES, "length", "largest length of the displacement"),
    EXTREME("largest_von_mises", OST_ON_TETS, force_per_area, "largest von Mises stress of the tet's mean stress"),
    EXTREME("largest_principal", OST_ON_TETS, force_per_area, "largest principal stress of the tet's mean stress"),
    EXTREME("least_tsai_wu_load_factor", OST_ON_TETS, none, "least load factor by Tsai and Wu's criterion"),
    EXTREME("least_hill_load_factor", OST_ON_TETS, none, "least load factor by Hill's criterion"),
    EXTREME("least_maximum_stress_load_factor", OST_ON_TETS, none,
            "least load factor by the largest stress along an axis"),
};

OstOutputField ost_output_field(OstOutputFieldBit field)
{
    OstOutputField found = kind[field];
    found.word = word_of[field];
    return found;
}

int ost_output_field_named(const char *word, OstOutputField *field)
{
    for (int f = 0; f < OST_FIELD_COUNT; f++)
        if (strcmp(word_of[f], word) == 0) {
            *field = ost_output_field((OstOutputFieldBit)f);
            return 1;
        }
    for (size_t l = 0; l < sizeof label / sizeof *label; l++)
        if (strcmp(label[l].word, word) == 0) {
            *field = label[l];
            return 1;
        }
    return 0;
}

int ost_output_field_is_of_body(const char *word)
{
    for (int f = 0; f < OST_FIELD_COUNT; f++)
        if (strcmp(word_of[f], word) == 0)
            return OST_FIELDS_OF_BODY >> f & 1;
    return strcmp(word, label[0].word) == 0 || strcmp(word, label[1].word) == 0;
}

unsigned ost_output_fields_needed(unsigned asked)
{
    unsigned needed = asked;
    for (int f = 0; f < OST_FIELD_COUNT; f++)
        if (asked >> f & 1U)
            needed |= kind[f].needs;
    return needed;
}

void ost_output_component(const OstOutputField *field, int number, char name[OST_LONGEST_COMPONENT])
{
    const char *from = field->component_names;
    for (int i = 0; i < number && *from; i++) {
        from += strcspn(from, " ");
        from += *from == ' ';
    }
    snprintf(name, OST_LONGEST_COMPONENT, "%.*s", (int)strcspn(from, " "), from);
}
