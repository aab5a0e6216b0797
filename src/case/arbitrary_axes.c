/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/plan.h"
#include "case/sections.h"
#include "case/yaml/message.h"
#include "fields/output_field.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Where one direction alone is stated, nothing says where the two axes across it lie. What is asked for along them is
 * an arbitrary number, though the answer is none. */

/* Numbers of one material that have no meaning, in words. */
typedef struct List {
    char text[OST_YAML_LIST_SIZE];
    size_t used;
} List;

static void add(List *list, const char *before, const char *name, const char *after)
{
    if (list->used < sizeof list->text)
        list->used += (size_t)snprintf(list->text + list->used, sizeof list->text - list->used, "%s%s%.80s%s",
                                       list->used ? ", " : "", before, name, after);
}

/* Axes about a cylinder have the other two of its directions across. */
static int is_arbitrary(const OstCase *c, const OstCaseMaterial *material)
{
    return material->axes.single && material->axes.kind != OST_AXES_CYLINDRICAL &&
           ost_case_material_of(c, material->region) == material;
}

static int is_across(const OstCaseMaterial *material, const OstWatch *watch)
{
    const int along = watch->component - OST_STRESS_MEASURE_11;
    return watch->kind == OST_WATCH_STRESS && along >= 0 && along < 6 && along != material->axes.single - 1;
}

/* In which region a point lies, the mesh tells (ost_warn_arbitrary_point), unless it is one of these in any case. */
static int is_arbitrary_anywhere(const OstCase *c, const OstWatch *watch)
{
    int all = 1;
    for (int i = 0; i < c->material_count; i++)
        all &= is_arbitrary(c, &c->materials[i]) && is_across(&c->materials[i], watch);
    return all;
}

static int is_in(const OstCase *c, const OstCaseMaterial *material, const OstWatch *watch)
{
    if (!watch->region)
        return is_arbitrary_anywhere(c, watch);
    return ost_is_every_region(watch->region) || ost_case_material_of(c, watch->region) == material;
}

static const char *const component_words[] = {" (11)", " (22)", " (33)", " (12)", " (23)", " (31)"};

static void add_watches(const OstCase *c, int first, const OstCaseMaterial *material, List *list)
{
    for (int w = first; w < c->watch_count; w++) {
        const OstWatch *watch = &c->watches[w];
        if (is_across(material, watch) && is_in(c, material, watch))
            add(list, "", watch->name, component_words[watch->component - OST_STRESS_MEASURE_11]);
    }
}

static void list_numbers(const OstCase *c, const OstCaseMaterial *material, List *list)
{
    static const OstOutputFieldBit fields[] = {OST_FIELD_MATERIAL_STRESS, OST_FIELD_MATERIAL_STRAIN, OST_FIELD_E1,
                                               OST_FIELD_E2, OST_FIELD_E3};
    add_watches(c, 0, material, list);
    for (int k = 0; k < c->load_case_count; k++) {
        const OstCase *of = c->load_cases[k].c;
        add_watches(of, c->watch_count, &of->materials[material - c->materials], list);
    }
    if (c->probe_count > 0)
        add(list, "", "the probes' stresses along the material axes", "");
    for (int f = 0; f < OST_COUNT_OF(fields); f++)
        if ((c->output_fields >> fields[f] & 1U) && (int)fields[f] != OST_FIELD_E1 + material->axes.single - 1)
            add(list, "the field ", ost_output_field(fields[f]).word, "");
}

/* Does the envelope of load cases need a criterion, or a watched load factor? */
static int is_watched(const OstCase *c, int criterion)
{
    int any = c->envelope;
    for (int w = 0; w < c->watch_count; w++)
        any |= c->watches[w].kind == OST_WATCH_LOAD_FACTOR &&
               (c->watches[w].component == criterion || c->watches[w].component == OST_CRITERIA);
    return any;
}

/* Strengths are rounded by who writes them: what makes no hundredth of a load factor is no difference. */
static void list_criteria(const OstCase *c, const OstCaseMaterial *material, List *list)
{
    static const double rounded = 0.01;
    const OstStrength *strength = &material->material.strength;
    const int axis = material->axes.single - 1;
    for (int k = 0; strength->known && !material->material.isotropic && k < OST_CRITERIA; k++) {
        const double even = ost_criterion_even_shear(strength, (OstCriterion)k, axis);
        if ((c->output_fields >> (OST_FIELD_TSAI_WU + k) & 1U || is_watched(c, k)) &&
            !(fabs(strength->shear[(axis + 1) % 3] - even) <= rounded * even))
            add(list, "", ost_output_field((OstOutputFieldBit)(OST_FIELD_TSAI_WU + k)).word, "");
    }
}

static void warn(const OstCase *c, const OstCaseMaterial *material, const List *numbers, const List *criteria)
{
    static const char *const kinds[] = {
        [OST_AXES_FIXED] = "fixed", [OST_AXES_GRADIENT] = "gradient", [OST_AXES_FIELD] = "field"};
    static const char *const shear[] = {"S23", "S31", "S12 (plane)"}; /* across each axis */
    const int axis = material->axes.single, one = axis == 1 ? 2 : 1, other = axis == 3 ? 2 : 3;
    const int low = axis < one ? axis : one, high = axis + one - low;
    char stated[160], second[80] = "axes: {curve: {points: ..., up: ..., order: [radial, tangential, axial]}}";
    snprintf(stated, sizeof stated, "region '%.80s' states e%d alone, and e%d and e%d lie anywhere across it",
             material->region, axis, one, other);
    if (material->axes.kind != OST_AXES_CURVE)
        snprintf(second, sizeof second, "axes: {%s: {e%d: ..., e%d: ...}}", kinds[material->axes.kind], low, high);
    if (numbers->used > 0)
        ost_warn(c->ctx,
                 "%s:%d: %s, so that these are arbitrary numbers: %s; state a second axis, as in %s, or ask for %d%d, "
                 "von_mises, pressure or a principal stress",
                 c->path, material->axes_place.line, stated, numbers->text, second, axis, axis);
    if (criteria->used > 0)
        ost_warn(c->ctx,
                 "%s:%d: %s, on which these depend with its strengths: %s; state a second axis, as in %s, or go by "
                 "tsai_wu_load_factor with %s = %.5g",
                 c->path, material->axes_place.line, stated, criteria->text, second, shear[axis - 1],
                 ost_criterion_even_shear(&material->material.strength, OST_TSAI_WU, axis - 1));
}

void ost_warn_arbitrary_axes(const OstCase *c)
{
    for (int i = 0; i < c->material_count; i++) {
        List numbers = {.used = 0}, criteria = {.used = 0};
        if (!is_arbitrary(c, &c->materials[i]))
            continue;
        list_numbers(c, &c->materials[i], &numbers);
        list_criteria(c, &c->materials[i], &criteria);
        warn(c, &c->materials[i], &numbers, &criteria);
    }
}

void ost_warn_arbitrary_point(const OstCase *c, const OstWatch *watch, const char *region)
{
    const OstCaseMaterial *material = ost_case_material_of(c, region);
    List numbers = {.used = 0}, criteria = {.used = 0};
    if (!material || !is_arbitrary(c, material) || !is_across(material, watch) || is_arbitrary_anywhere(c, watch))
        return;
    add(&numbers, "", watch->name, component_words[watch->component - OST_STRESS_MEASURE_11]);
    warn(c, material, &numbers, &criteria);
}

/* A field that the case lists and that its materials have no values for is left out of the file. */

static const struct {
    unsigned fields;
    OstEffect effect;
    const char *needs;
} need[] = {
    {1U << OST_FIELD_AXES | 1U << OST_FIELD_E1 | 1U << OST_FIELD_E2 | 1U << OST_FIELD_E3, OST_EFFECT_ORTHOTROPY,
     "a material that is not isotropic, or that states 'axes'"},
    {OST_LOAD_FACTORS, OST_EFFECT_STRENGTH, "a material with 'strengths'"},
    {1U << OST_FIELD_MIXED_PRESSURE, OST_EFFECT_MIXED,
     "the mixed form, of quadratic tets of nearly incompressible material"},
};

void ost_warn_absent_fields(const OstCase *c, const OstEffects *effects)
{
    for (size_t n = 0; n < sizeof need / sizeof *need; n++)
        for (int f = 0; f < OST_FIELD_COUNT && !ost_effect_on(effects, need[n].effect); f++)
            if (c->named_fields & need[n].fields & 1U << f)
                ost_warn(c->ctx, "%s:%d: the field '%s' is left out of the output: it needs %s; %s", c->path,
                         c->fields_line, ost_output_field((OstOutputFieldBit)f).word, need[n].needs,
                         ost_effect_state(effects, need[n].effect)->reason);
}
