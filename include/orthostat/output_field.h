/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_OUTPUT_FIELD_H
#define ORTHOSTAT_OUTPUT_FIELD_H

#include "orthostat/context.h"

OST_API_BEGIN

/* The fields of a result. Columns: name, its word in the case file and in the file of fields (docs/output.md). */
#define OST_OUTPUT_FIELD_TABLE(X)                               \
    X(OST_FIELD_DISPLACEMENT, "displacement")                   \
    X(OST_FIELD_REACTION, "reaction")                           \
    X(OST_FIELD_LOAD, "load")                                   \
    X(OST_FIELD_STRESS, "stress")                               \
    X(OST_FIELD_NODE_STRESS, "node_stress")                     \
    X(OST_FIELD_STRAIN, "strain_tensor")                        \
    X(OST_FIELD_ENERGY, "strain_energy_density")                \
    X(OST_FIELD_AXES, "axes")                                   \
    X(OST_FIELD_REGION, "region")                               \
    X(OST_FIELD_RANK, "rank")                                   \
    X(OST_FIELD_ERROR, "error")                                 \
    X(OST_FIELD_TSAI_WU, "tsai_wu_load_factor")                 \
    X(OST_FIELD_HILL, "hill_load_factor")                       \
    X(OST_FIELD_MAXIMUM_STRESS, "maximum_stress_load_factor")   \
    X(OST_FIELD_MATERIAL_STRESS, "material_stress")             \
    X(OST_FIELD_MATERIAL_STRAIN, "material_strain_tensor")      \
    X(OST_FIELD_VON_MISES, "von_mises")                         \
    X(OST_FIELD_PRESSURE, "pressure")                           \
    X(OST_FIELD_PRINCIPAL_STRESS, "principal_stress")           \
    X(OST_FIELD_PRINCIPAL_DIRECTION_1, "principal_direction_1") \
    X(OST_FIELD_PRINCIPAL_DIRECTION_2, "principal_direction_2") \
    X(OST_FIELD_PRINCIPAL_DIRECTION_3, "principal_direction_3") \
    X(OST_FIELD_PRINCIPAL_STRAIN, "principal_strain")           \
    X(OST_FIELD_E1, "e1")                                       \
    X(OST_FIELD_E2, "e2")                                       \
    X(OST_FIELD_E3, "e3")                                       \
    X(OST_FIELD_MIXED_PRESSURE, "mixed_pressure")               \
    X(OST_FIELD_BUCKLING_MODE_1, "buckling_mode_1")             \
    X(OST_FIELD_BUCKLING_MODE_2, "buckling_mode_2")             \
    X(OST_FIELD_BUCKLING_MODE_3, "buckling_mode_3")
#define OST_OUTPUT_FIELD_ENUM(name, word) name,
typedef enum { OST_OUTPUT_FIELD_TABLE(OST_OUTPUT_FIELD_ENUM) OST_FIELD_COUNT } OstOutputFieldBit;
#undef OST_OUTPUT_FIELD_ENUM

enum { OST_MOST_BUCKLING_MODES = 1 + OST_FIELD_BUCKLING_MODE_3 - OST_FIELD_BUCKLING_MODE_1 };

/* Bits of those that are written unless a case says which: up to the load factors, which are there where a material
 * states strengths. The others follow from them, and are made if asked for. */
enum { OST_FIELDS_BY_DEFAULT = (1 << OST_FIELD_MATERIAL_STRESS) - 1 };

OST_API_END

#endif
