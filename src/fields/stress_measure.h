/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FIELDS_STRESS_MEASURE_H
#define ORTHOSTAT_FIELDS_STRESS_MEASURE_H

/* Numbers that are made of a stress: its components along the world's axes and along the material's, and those that do
 * not depend on axes. Columns: name, its word in the case file. */
#define OST_STRESS_MEASURE_TABLE(X)                              \
    X(OST_STRESS_MEASURE_XX, "xx")                               \
    X(OST_STRESS_MEASURE_YY, "yy")                               \
    X(OST_STRESS_MEASURE_ZZ, "zz")                               \
    X(OST_STRESS_MEASURE_XY, "xy")                               \
    X(OST_STRESS_MEASURE_YZ, "yz")                               \
    X(OST_STRESS_MEASURE_ZX, "zx")                               \
    X(OST_STRESS_MEASURE_11, "11")                               \
    X(OST_STRESS_MEASURE_22, "22")                               \
    X(OST_STRESS_MEASURE_33, "33")                               \
    X(OST_STRESS_MEASURE_12, "12")                               \
    X(OST_STRESS_MEASURE_23, "23")                               \
    X(OST_STRESS_MEASURE_31, "31")                               \
    X(OST_STRESS_MEASURE_VON_MISES, "von_mises")                 \
    X(OST_STRESS_MEASURE_PRESSURE, "pressure")                   \
    X(OST_STRESS_MEASURE_LARGEST_PRINCIPAL, "largest_principal") \
    X(OST_STRESS_MEASURE_MIDDLE_PRINCIPAL, "middle_principal")   \
    X(OST_STRESS_MEASURE_LEAST_PRINCIPAL, "least_principal")
#define OST_STRESS_MEASURE_ENUM(name, word) name,
typedef enum { OST_STRESS_MEASURE_TABLE(OST_STRESS_MEASURE_ENUM) OST_STRESS_MEASURES } OstStressMeasure;
#undef OST_STRESS_MEASURE_ENUM

#endif
