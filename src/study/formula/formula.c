/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/formula/formula.h"

#include "core/error.h"
#include "core/small.h"

#include <stdio.h>
#include <string.h>

static const OstFormula *const formulas[] = {
    &ost_formula_flexure,        &ost_formula_bending, &ost_formula_uniform_load, &ost_formula_torsion,
    &ost_formula_hanging_bar,    &ost_formula_strip,   &ost_formula_cylinder,     &ost_formula_sphere,
    &ost_formula_uniform_stress, &ost_formula_waves,   &ost_formula_polynomial,
};
enum { FORMULA_COUNT = sizeof formulas / sizeof *formulas };

static void list_names(const char *const *names, int count, char *text, size_t size)
{
    size_t length = 0;
    text[0] = 0;
    for (int i = 0; i < count && names[i] && length < size; i++)
        length += (size_t)snprintf(text + length, size - length, "%s%s", i > 0 ? ", " : "", names[i]);
}

int ost_formula_find_value(const OstFormula *formula, const char *name)
{
    for (int v = 0; v < OST_MOST_FORMULA_VALUES && formula->value_name[v]; v++)
        if (strcmp(formula->value_name[v], name) == 0)
            return v;
    return -1;
}

OstStatus ost_formula_wants(const OstCase *c, int holds, const char *wanted)
{
    if (holds)
        return OST_SUCCESS;
    return OST_RAISE(c->ctx, OST_INVALID_INPUT, "%s:%d: the formula '%s' is for %s", c->path, c->verify->line,
                     c->verify->formula, wanted);
}

OstStatus ost_formula_wants_bar(const OstCase *c, int along, const char *wanted)
{
    const OstBlockShape *block = &c->block;
    int placed = c->mesh_kind == OST_MESH_BLOCK && block->origin[along] == 0.0;
    for (int i = 0; i < 3; i++)
        placed &= i == along || fabs(block->origin[i] + 0.5 * block->size[i]) <= 1e-12 * block->size[i];
    OST_TRY(ost_formula_wants(c, placed, wanted));
    return ost_formula_wants(c, c->materials[0].axes.kind == OST_AXES_NONE, "a material without axes of its own");
}

/* --- the closed-form field --- */

static OstStatus exact_displacement(const void *data, const double point[3], double u[3])
{
    const OstExact *exact = data;
    exact->formula->displacement(exact->data.constant, point, u);
    return OST_SUCCESS;
}

/* Central differences of eighth order: f' h = sum of weight k (f(kh) - f(-kh)). */
enum { DIFFERENCES = 4 };
static const double difference[DIFFERENCES] = {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};

static double step_of(const OstExact *exact)
{
    return 0.01 * exact->data.length;
}

static OstStatus exact_gradient(const void *data, const double point[3], double gradient[9])
{
    const OstExact *exact = data;
    const double step = step_of(exact);
    if (exact->formula->gradient) {
        exact->formula->gradient(exact->data.constant, point, gradient);
        return OST_SUCCESS;
    }
    memset(gradient, 0, 9 * sizeof *gradient);
    for (int j = 0; j < 3; j++)
        for (int k = 1; k <= DIFFERENCES; k++) {
            double x[3] = {point[0], point[1], point[2]}, ahead[3], behind[3];
            x[j] = point[j] + k * step;
            exact->formula->displacement(exact->data.constant, x, ahead);
            x[j] = point[j] - k * step;
            exact->formula->displacement(exact->data.constant, x, behind);
            for (int i = 0; i < 3; i++)
                gradient[3 * i + j] += difference[k - 1] * (ahead[i] - behind[i]) / step;
        }
    return OST_SUCCESS;
}

/* The material's axes at a point: the world's if it has none. */
static OstStatus exact_axes(const OstExact *exact, const double point[3], double axes[9])
{
    static const double world[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    memcpy(axes, world, sizeof world);
    if (exact->material.isotropic || exact->axes.kind == OST_AXES_NONE)
        return OST_SUCCESS;
    return ost_axes_at(exact->ctx, &exact->axes, point, axes);
}

static OstStatus exact_stiffness(const void *data, const double point[3], double c[36])
{
    const OstExact *exact = data;
    double axes[9];
    OST_TRY(exact_axes(exact, point, axes));
    ost_material_rotate_stiffness(exact->material.stiffness, axes, c);
    return OST_SUCCESS;
}

static OstStatus exact_stress(const void *data, const double point[3], double stress[6])
{
    const OstExact *exact = data;
    double g[9], c[36], axes[9], eigenstrain[6];
    if (exact->formula->stress) {
        exact->formula->stress(exact->data.constant, point, stress);
        return OST_SUCCESS;
    }
    OST_TRY(exact_gradient(data, point, g));
    OST_TRY(exact_axes(exact, point, axes));
    ost_material_rotate_stiffness(exact->material.stiffness, axes, c);
    ost_strain_to_world(exact->eigenstrain, axes, eigenstrain);
    double strain[6] = {g[0], g[4], g[8], g[1] + g[3], g[5] + g[7], g[6] + g[2]};
    for (int p = 0; p < 6; p++)
        strain[p] -= eigenstrain[p];
    ost_apply6(c, strain, stress);
    return OST_SUCCESS;
}

static OstStatus exact_body_force(const void *data, const double point[3], double force[3])
{
    static const int component[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    const double step = step_of(data);
    memset(force, 0, 3 * sizeof *force);
    for (int j = 0; j < 3; j++)
        for (int k = 1; k <= DIFFERENCES; k++) {
            double x[3] = {point[0], point[1], point[2]}, ahead[6], behind[6];
            x[j] = point[j] + k * step;
            OST_TRY(exact_stress(data, x, ahead));
            x[j] = point[j] - k * step;
            OST_TRY(exact_stress(data, x, behind));
            for (int i = 0; i < 3; i++)
                force[i] -= difference[k - 1] * (ahead[component[i][j]] - behind[component[i][j]]) / step;
        }
    return OST_SUCCESS;
}

/* --- that of a case --- */

static OstStatus take_parameters(const OstCase *c, const OstFormula *formula, double *parameter)
{
    const OstVerify *verify = c->verify;
    char names[256];
    int used = 0;
    list_names(formula->parameter_name, OST_MOST_FORMULA_PARAMETERS, names, sizeof names);
    for (int p = 0; p < OST_MOST_FORMULA_PARAMETERS && formula->parameter_name[p]; p++) {
        int found = -1;
        for (int i = 0; i < verify->parameter_count; i++)
            if (strcmp(verify->parameter_name[i], formula->parameter_name[p]) == 0)
                found = i;
        if (found < 0)
            return OST_RAISE(c->ctx, OST_INVALID_INPUT,
                             "%s:%d: the formula '%s' wants the parameter '%s'; all it wants: %s", c->path,
                             verify->line, formula->name, formula->parameter_name[p], names);
        parameter[p] = verify->parameter[found];
        used++;
    }
    if (used == verify->parameter_count)
        return OST_SUCCESS;
    return OST_RAISE(c->ctx, OST_INVALID_INPUT, "%s:%d: found %d parameters, but the formula '%s' wants these: %s",
                     c->path, verify->line, verify->parameter_count, formula->name, names[0] ? names : "none");
}

static OstStatus find_formula(const OstCase *c, const OstFormula **formula)
{
    const char *names[FORMULA_COUNT];
    char list[512];
    if (!c->verify)
        return OST_RAISE(c->ctx, OST_INVALID_INPUT,
                         "%s: the case has no verify section, so there is no formula to compare it with", c->path);
    for (int f = 0; f < FORMULA_COUNT; f++) {
        *formula = formulas[f];
        names[f] = formulas[f]->name;
        if (strcmp(names[f], c->verify->formula) == 0)
            return OST_SUCCESS;
    }
    list_names(names, FORMULA_COUNT, list, sizeof list);
    return OST_RAISE(c->ctx, OST_INVALID_INPUT, "%s:%d: there is no formula '%s'; there are: %s", c->path,
                     c->verify->line, c->verify->formula, list);
}

OstStatus ost_exact_create(const OstCase *c, OstExact *exact)
{
    double parameter[OST_MOST_FORMULA_PARAMETERS] = {0.0};
    memset(exact, 0, sizeof *exact);
    OST_TRY(find_formula(c, &exact->formula));
    OST_TRY(take_parameters(c, exact->formula, parameter));
    OST_TRY(ost_formula_wants(c, c->material_count == 1, "a body of one material"));
    const OstCaseMaterial *stated = &c->materials[0];
    const OstAxesKind kind = stated->axes.kind;
    OST_TRY(ost_formula_wants(c, kind != OST_AXES_CELLS && kind != OST_AXES_GRADIENT,
                              "axes that are given by a formula too"));
    exact->material = stated->material;
    memcpy(exact->eigenstrain, stated->eigenstrain, sizeof stated->eigenstrain);
    exact->ctx = c->ctx;
    exact->axes = stated->axes;
    exact->field =
        (OstClosedForm){exact, exact_displacement, exact_gradient, exact_stiffness, exact_stress, exact_body_force};
    return exact->formula->prepare(c, parameter, &exact->data);
}
