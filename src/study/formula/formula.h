/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_FORMULA_FORMULA_H
#define ORTHOSTAT_STUDY_FORMULA_FORMULA_H

#include "orthostat/exact.h"
#include "orthostat/verify.h"

/* Closed forms against which answers are measured. A formula reads the case's shape and material, so that nothing is
 * said twice, and gives a displacement field and numbers ("values") by name. */

enum { OST_FORMULA_CONSTANTS = 40, OST_MOST_FORMULA_VALUES = 5 };

/* A formula made ready for a case. */
typedef struct OstFormulaData {
    double constant[OST_FORMULA_CONSTANTS]; /* the formula's own */
    double value[OST_MOST_FORMULA_VALUES];  /* as the formula's value_name */
    double length; /* over which the field varies: derivatives by differences take steps of 1/100 of it */
} OstFormulaData;

typedef struct OstFormula {
    const char *name;
    const char *parameter_name[OST_MOST_FORMULA_PARAMETERS]; /* the rest NULL */
    const char *value_name[OST_MOST_FORMULA_VALUES];         /* the rest NULL */

    /* Local. Fills `data`; `parameter` as parameter_name. Raises OST_INVALID_INPUT if the case is not one the formula
     * is for. */
    OstStatus (*prepare)(const OstCase *c, const double *parameter, OstFormulaData *data);

    void (*displacement)(const double *constant, const double x[3], double u[3]);
    void (*gradient)(const double *constant, const double x[3], double gradient[9]); /* NULL: by differences of u */
} OstFormula;

extern const OstFormula ost_formula_flexure, ost_formula_bending, ost_formula_uniform_load, ost_formula_torsion,
    ost_formula_hanging_bar, ost_formula_strip, ost_formula_cylinder, ost_formula_sphere, ost_formula_uniform_stress,
    ost_formula_waves, ost_formula_polynomial;

/* Local. The formula of this name, or NULL; and the names of all, for messages. */
const OstFormula *ost_formula_find(const char *name);
void ost_formula_list(char *text, size_t size);

/* Local. Number of a value by name, or -1. */
int ost_formula_find_value(const OstFormula *formula, const char *name);

/* A case's formula as a field in the case's material: strains from the displacement, stress by the material in its axes
 * at the place, force per volume as minus the divergence of that stress, by differences of eighth order. */
typedef struct OstExact {
    OstExactField field; /* field.data is this object */
    OstContext *ctx;
    const OstFormula *formula;
    OstFormulaData data;
    OstMaterial material;
    OstAxesSpec axes; /* borrowed from the case */
} OstExact;

/* Local. Makes the field of the case's verify section; the case and the object outlive its use, and the object must not
 * move. Raises OST_INVALID_INPUT with the case's line for an unknown formula, parameters that do not fit it, more than
 * one material, or a shape that the formula is not for. */
OstStatus ost_exact_create(const OstCase *c, OstExact *exact);

/* Local. For formulas: refuse a case they are not for. */
OstStatus ost_formula_wants(const OstCase *c, int holds, const char *wanted);

/* Local. Are the case's (first) material's axes the world's, or does it have none? */
int ost_formula_is_aligned(const OstCase *c);

#endif
