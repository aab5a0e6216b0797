/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_FORMULA_FORMULA_H
#define ORTHOSTAT_STUDY_FORMULA_FORMULA_H

#include "assembly/closed_form.h"
#include "case/verify.h"

/* Closed-form solutions with which answers are compared. A formula takes shape and material from the case, and gives a
 * displacement field and named numbers ("values"). */

enum { OST_FORMULA_CONSTANTS = 40, OST_MOST_FORMULA_VALUES = 5 };

/* A formula's numbers for one case. */
typedef struct OstFormulaData {
    double constant[OST_FORMULA_CONSTANTS]; /* the formula's own */
    double value[OST_MOST_FORMULA_VALUES];  /* as the formula's value_name */
    double length; /* over which the field varies; finite differences take steps of 1/100 of it */
} OstFormulaData;

typedef struct OstFormula {
    const char *name;
    const char *parameter_name[OST_MOST_FORMULA_PARAMETERS]; /* the rest NULL */
    const char *value_name[OST_MOST_FORMULA_VALUES];         /* the rest NULL */

    /* Local. Fills `data`; `parameter` is in the order of parameter_name. Raises OST_INVALID_INPUT if the formula does
     * not hold for the case. */
    OstStatus (*prepare)(const OstCase *c, const double *parameter, OstFormulaData *data);

    void (*displacement)(const double *constant, const double x[3], double u[3]);
    void (*gradient)(const double *constant, const double x[3], double gradient[9]); /* NULL: by finite differences */
    void (*stress)(const double *constant, const double x[3], double stress[6]); /* NULL: by the material from strain */
} OstFormula;

extern const OstFormula ost_formula_flexure, ost_formula_bending, ost_formula_uniform_load, ost_formula_torsion,
    ost_formula_hanging_bar, ost_formula_strip, ost_formula_cylinder, ost_formula_sphere, ost_formula_uniform_stress,
    ost_formula_waves, ost_formula_polynomial;

/* Local. Number of a value by name, or -1. */
int ost_formula_find_value(const OstFormula *formula, const char *name);

/* The closed-form solution of a case: strain from the formula's displacement, stress by the formula or by the material
 * in its axes at the point, and body force as minus the divergence of that stress, by finite differences of eighth
 * order. */
typedef struct OstExact {
    OstClosedForm field; /* field.data is this object */
    OstContext *ctx;
    const OstFormula *formula;
    OstFormulaData data;
    OstMaterial material;
    double eigenstrain[6]; /* in material axes */
    OstAxesSpec axes;      /* borrowed from the case */
} OstExact;

/* Local. Makes the closed-form solution of the case's verify section. It refers to the case and to itself: the case
 * must outlive it, and it must not move. Raises OST_INVALID_INPUT with the case's line for an unknown formula,
 * parameters that do not fit it, more than one material, or a shape that it does not hold for. */
OstStatus ost_exact_create(const OstCase *c, OstExact *exact);

/* Local. For formulas: raises OST_INVALID_INPUT unless the condition `holds`; `wanted` names it. */
OstStatus ost_formula_wants(const OstCase *c, int holds, const char *wanted);

/* Local. For formulas of bars: raises OST_INVALID_INPUT unless the body is a block from 0 along one axis and centred on
 * the others (`wanted` says so), of a material whose axes are the world's. */
OstStatus ost_formula_wants_bar(const OstCase *c, int along, const char *wanted);

#endif
