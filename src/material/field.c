/* SPDX-License-Identifier: BSD-3-Clause */
#include "material/field_data.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "material/axes_formula.h"
#include "material/definite.h"
#include "material/directions.h"
#include "material/turn.h"

#include <stdio.h>
#include <string.h>

static const double world[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

void ost_field_stiffness(const OstMaterialField *field, OstLocal tet, double stiffness[36])
{
    const int32_t region = field->tet_region[tet];
    double axes[9];
    if (field->region_varies[region]) {
        ost_field_axes(field, tet, axes);
        ost_material_rotate_stiffness(field->material[region].stiffness, axes, stiffness);
    } else
        memcpy(stiffness, field->region_stiffness + 36 * (size_t)region, 36 * sizeof(double));
    for (int i = 0; i < 36 && field->tet_scale; i++)
        stiffness[i] *= ost_field_scale(field, tet, NULL);
}

OstStatus ost_field_set_scale_by_law(OstMaterialField *field, OstLocal tet_count, int places, const double *numbers,
                                     const double *law)
{
    const size_t count = (size_t)places * (size_t)tet_count, laws = 3 * (size_t)field->region_count;
    OST_FREE(field->tet_scale, field->scale_law);
    field->scale_places = places;
    OST_TRY(OST_NEW(field->ctx, &field->tet_scale, count));
    if (count > 0)
        memcpy(field->tet_scale, numbers, count * sizeof *numbers);
    if (!law)
        return OST_SUCCESS;
    OST_TRY(OST_NEW(field->ctx, &field->scale_law, laws));
    memcpy(field->scale_law, law, laws * sizeof *law);
    return OST_SUCCESS;
}

static OstStatus set_scale(OstMaterialField *field, OstLocal tet_count, int places, const double *factors)
{
    OST_FREE(field->tet_scale, field->scale_law);
    for (size_t n = 0; n < (size_t)places * (size_t)tet_count && factors; n++)
        if (!(factors[n] > 0.0) || !isfinite(factors[n]))
            return OST_RAISE(field->ctx, OST_INVALID_INPUT, "factor %lld of the stiffness is %g, expected one above 0",
                             (long long)n, factors[n]);
    return factors ? ost_field_set_scale_by_law(field, tet_count, places, factors, NULL) : OST_SUCCESS;
}

OstStatus ost_field_set_scale(OstMaterialField *field, OstLocal tet_count, const double *factors)
{
    return set_scale(field, tet_count, 1, factors);
}

OstStatus ost_field_set_vertex_scale(OstMaterialField *field, OstLocal tet_count, const double *factors)
{
    return set_scale(field, tet_count, 4, factors);
}

void ost_field_axes(const OstMaterialField *field, OstLocal tet, double axes[9])
{
    const double *turn = field->tet_turn ? field->tet_turn + 4 * (size_t)tet : NULL;
    if (turn)
        OST_AXES_OF_TURN(turn, axes);
    else
        memcpy(axes, field->region_axes ? field->region_axes + 9 * (size_t)field->tet_region[tet] : world,
               sizeof world);
}

void ost_field_metric(const OstMaterialField *field, OstLocal tet, double metric[6])
{
    const double *modulus = field->material[field->tet_region[tet]].constants.youngs_modulus;
    const double least = fmin(modulus[0], fmin(modulus[1], modulus[2]));
    double axes[9];
    ost_field_axes(field, tet, axes);
    memset(metric, 0, 6 * sizeof *metric);
    for (int k = 0; k < 3; k++) {
        const double *e = axes + 3 * k;
        const double weight = sqrt(least / modulus[k]);
        for (int i = 0; i < 3; i++) {
            metric[i] += weight * e[i] * e[i];
            metric[3 + i] += weight * e[i] * e[(i + 1) % 3];
        }
    }
}

int ost_field_has_formula(const OstMaterialField *field, int32_t region)
{
    return field->region_formula && field->region_formula[region];
}

int ost_field_varies_within(const OstMaterialField *field, int32_t region)
{
    return ost_field_has_formula(field, region) || ost_field_directions_along(field, region);
}

void ost_field_take_directions(OstMaterialField *field, signed char **along, float **directions)
{
    OST_FREE(field->region_along, field->tet_directions);
    field->region_along = *along;
    field->tet_directions = *directions;
    *along = NULL;
    *directions = NULL;
}

void ost_field_axes_at(const OstMaterialField *field, OstLocal tet, const double at[4], const double point[3],
                       double axes[9])
{
    const int32_t region = field->tet_region[tet];
    const signed char *along = ost_field_directions_along(field, region);
    if (along && at &&
        ost_directions_at(field->ctx, field->tet_directions + OST_DIRECTIONS * (size_t)tet, along, at, axes) ==
            OST_SUCCESS)
        return;
    if (ost_field_has_formula(field, region) &&
        ost_axes_formula_at(field->region_formula[region], point, axes) == OST_SUCCESS)
        return;
    ost_field_axes(field, tet, axes);
}

int ost_field_has_strengths(const OstMaterialField *field)
{
    int some = 0;
    for (int r = 0; r < field->region_count; r++)
        some |= field->material[r].strength.known;
    return some;
}

double ost_field_density(const OstMaterialField *field, OstLocal tet)
{
    return field->material[field->tet_region[tet]].density;
}

/* ost_field_create's arguments about the tets. */
typedef struct Tets {
    OstLocal count;
    const int32_t *region;
    const OstGlobal *label;
    const double *centroids;
    const double *given_axes;
} Tets;

static OstStatus check_regions(OstContext *ctx, int region_count, const Tets *tets)
{
    for (OstLocal t = 0; t < tets->count; t++)
        if (tets->region[t] < 0 || tets->region[t] >= region_count)
            return OST_RAISE(ctx, OST_INVALID_INPUT,
                             "tet %lld is of region %d, but there are materials for regions 0 to %d only",
                             (long long)tets->label[t], (int)tets->region[t], region_count - 1);
    return OST_SUCCESS;
}

/* Puts the tet and its material in front of the message. */
static OstStatus raise_for_tet(OstContext *ctx, OstStatus status, const OstMaterial *material, OstGlobal label)
{
    char reason[1024];
    snprintf(reason, sizeof reason, "%s", ost_error_text(ctx));
    return OST_RAISE(ctx, status, "tet %lld (material '%s'): %s", (long long)label, material->name, reason);
}

/* Axes of a region if they are uniform, and its stiffness in world axes. Also checks the axes of isotropic materials.
 */
static OstStatus fill_fixed_region(OstMaterialField *field, int region, const OstAxesSpec *spec)
{
    const OstMaterial *material = &field->material[region];
    double axes[9];
    memcpy(axes, world, sizeof world);
    if (spec && !ost_axes_vary(spec) && spec->kind != OST_AXES_NONE) {
        char what[128];
        snprintf(what, sizeof what, "axes of material '%s'", material->name);
        memcpy(axes, spec->fixed, sizeof axes);
        OST_TRY(ost_axes_check(field->ctx, what, axes));
    }
    if (material->isotropic) {
        memcpy(axes, world, sizeof world);
        memcpy(field->region_stiffness + 36 * region, material->stiffness, sizeof material->stiffness);
    } else if (!field->region_varies[region]) {
        ost_material_rotate_stiffness(material->stiffness, axes, field->region_stiffness + 36 * region);
    }
    if (field->region_axes)
        memcpy(field->region_axes + 9 * region, axes, sizeof axes);
    return OST_SUCCESS;
}

static OstStatus tet_axes_of_region(OstMaterialField *field, int region, const Tets *tets)
{
    const OstAxesFormula *formula = field->region_formula ? field->region_formula[region] : NULL;
    for (OstLocal t = 0; t < tets->count; t++) {
        if (tets->region[t] != region)
            continue;
        double axes[9];
        OstStatus status = OST_SUCCESS;
        if (formula) {
            status = ost_axes_formula_at(formula, tets->centroids + 3 * (size_t)t, axes);
        } else {
            memcpy(axes, tets->given_axes + 9 * (size_t)t, sizeof world);
            status = ost_axes_check(field->ctx, "given axes", axes);
        }
        if (status != OST_SUCCESS)
            return raise_for_tet(field->ctx, status, &field->material[region], tets->label[t]);
        ost_turn_of_axes(axes, field->tet_turn + 4 * (size_t)t);
    }
    return OST_SUCCESS;
}

static OstStatus fill_varying_region(OstMaterialField *field, int region, const OstAxesSpec *spec, const Tets *tets)
{
    if (!ost_axes_have_formula(spec) && !tets->given_axes && tets->count > 0)
        return OST_RAISE(field->ctx, OST_INVALID_INPUT,
                         "material '%s' has axes tet by tet, but the mesh brings none; name a file of them (nine "
                         "numbers a line), or give axes by a formula",
                         field->material[region].name);
    if (ost_axes_have_formula(spec)) {
        if (!field->region_formula)
            OST_TRY(OST_NEW(field->ctx, &field->region_formula, field->region_count));
        OST_TRY(ost_axes_formula_create(field->ctx, spec, &field->region_formula[region]));
    }
    return tet_axes_of_region(field, region, tets);
}

static OstStatus fill_tet_axes(OstMaterialField *field, const OstAxesSpec *specs, const Tets *tets)
{
    OST_TRY(OST_NEW(field->ctx, &field->tet_turn, 4 * (size_t)tets->count));
    for (int r = 0; r < field->region_count; r++)
        if (field->region_varies[r])
            OST_TRY(fill_varying_region(field, r, &specs[r], tets));
    for (OstLocal t = 0; t < tets->count; t++)
        if (!field->region_varies[tets->region[t]])
            ost_turn_of_axes(field->region_axes + 9 * (size_t)tets->region[t], field->tet_turn + 4 * (size_t)t);
    return OST_SUCCESS;
}

/* The regions' arrays are booked to OST_EFFECT_REGIONS if that is known to be on. */
static OstStatus allocate(OstContext *ctx, const OstEffects *effects, int region_count, OstMaterialField *field)
{
    const int several = effects && ost_effect_on(effects, OST_EFFECT_REGIONS);
    field->ctx = ctx;
    field->region_count = region_count;
    if (several)
        ost_ledger_enter(ctx, OST_EFFECT_REGIONS);
    OstStatus status = OST_NEW(ctx, &field->material, region_count);
    OST_THEN(OST_NEW(ctx, &field->region_stiffness, 36 * region_count));
    OST_THEN(OST_NEW(ctx, &field->region_varies, region_count));
    if (several)
        ost_ledger_leave(ctx);
    return status;
}

/* Books each effect's work to its account; never enters the account of an effect that is off. */
static OstStatus fill_axes(OstMaterialField *field, const OstEffects *effects, const OstAxesSpec *specs,
                           const Tets *tets)
{
    const int may_vary = specs && ost_effect_on(effects, OST_EFFECT_VARYING_AXES);
    int orthotropic = 0, varying = 0;
    for (int r = 0; r < field->region_count; r++) {
        orthotropic |= !field->material[r].isotropic;
        field->region_varies[r] = may_vary && !field->material[r].isotropic && ost_axes_vary(&specs[r]);
        varying |= field->region_varies[r];
    }
    OstStatus status = OST_SUCCESS;
    if (orthotropic && ost_effect_on(effects, OST_EFFECT_ORTHOTROPY)) {
        ost_ledger_enter(field->ctx, OST_EFFECT_ORTHOTROPY);
        status = OST_NEW(field->ctx, &field->region_axes, 9 * field->region_count);
        ost_ledger_leave(field->ctx);
    }
    for (int r = 0; r < field->region_count && status == OST_SUCCESS; r++)
        status = fill_fixed_region(field, r, specs ? &specs[r] : NULL);
    if (varying && status == OST_SUCCESS) {
        ost_ledger_enter(field->ctx, OST_EFFECT_VARYING_AXES);
        status = fill_tet_axes(field, specs, tets);
        ost_ledger_leave(field->ctx);
    }
    return status;
}

OstStatus ost_field_create(OstContext *ctx, const OstEffects *effects, int region_count, const OstMaterial *materials,
                           const OstAxesSpec *specs, OstLocal tet_count, const int32_t *tet_region,
                           const OstGlobal *tet_label, const double *centroids, const double *given_axes,
                           OstMaterialField **out)
{
    const Tets tets = {tet_count, tet_region, tet_label, centroids, given_axes};
    OstMaterialField *field = NULL;
    OstStatus status = OST_SUCCESS;
    *out = NULL;
    OST_TRY(check_regions(ctx, region_count, &tets));
    OST_TRY(OST_NEW(ctx, &field, 1));
    OST_TRY_DONE(allocate(ctx, effects, region_count, field));
    memcpy(field->material, materials, sizeof *materials * (size_t)region_count);
    field->tet_region = tet_region;
    OST_TRY_DONE(fill_axes(field, effects, specs, &tets));
    *out = field;
    return OST_SUCCESS;
done:
    ost_field_destroy(&field);
    return status;
}

/* The eigenvalues and eigenvectors of the normalised normal block. */
typedef struct Modes {
    double eigenvalue[3], vector[9];
} Modes;

/* *found: is there one stiff mode? */
static OstStatus find_modes(OstContext *ctx, const OstMaterial *material, double nu_limit, Modes *modes, int *found)
{
    double ratios[3], block[9];
    ost_orthotropic_normalised_ratios(&material->constants, ratios);
    ost_normalised_block(ratios, block);
    OST_TRY(ost_symmetric_eigen(ctx, 3, block, modes->eigenvalue, modes->vector));
    if (material->incompressible)
        modes->eigenvalue[0] = 0.0;
    *found = ost_has_one_stiff_mode(modes->eigenvalue, nu_limit);
    return OST_SUCCESS;
}

/* The normal block is C = E^(1/2) (sum of w w' / e) E^(1/2) over eigenvalues e and eigenvectors w of the normalised
 * block; in the rest, the first mode has only this stiffness. */
static void build_rest(const OstMaterial *material, double resisted_by_first, const Modes *modes, double rest[36])
{
    const double *modulus = material->constants.youngs_modulus;
    const double resisted[3] = {resisted_by_first, 1.0 / modes->eigenvalue[1], 1.0 / modes->eigenvalue[2]};
    memcpy(rest, material->stiffness, 36 * sizeof *rest);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            double sum = 0.0;
            for (int k = 0; k < 3; k++)
                sum += resisted[k] * modes->vector[3 * k + a] * modes->vector[3 * k + b];
            rest[6 * a + b] = sqrt(modulus[a] * modulus[b]) * sum;
        }
}

/* Splits C = rest + m m': m is the excess of its one stiff mode over the stiffness that `nu_limit` gives. Zeros if it
 * has no single stiff mode. */
static OstStatus split_material(OstContext *ctx, const OstMaterial *material, double nu_limit, double mode[3],
                                double rest[36], int *found)
{
    const double resisted = 1.0 / (1.0 - 2.0 * nu_limit);
    Modes modes;
    OST_TRY(find_modes(ctx, material, nu_limit, &modes, found));
    if (!*found)
        return OST_SUCCESS;
    const double excess = 1.0 / modes.eigenvalue[0] - resisted;
    for (int a = 0; a < 3; a++)
        mode[a] = modes.vector[a] * sqrt(material->constants.youngs_modulus[a] * excess);
    build_rest(material, resisted, &modes, rest);
    return OST_SUCCESS;
}

/* What is left of the stiff mode in the rest of the mixed form: as much as nu = 0.3 gives it. On a tube at nu = 0.499
 * with 1, 2.5, 5 and 10 the solver takes 34, 28, 27, 31 iterations (isotropic), 27, 23, 23, 27 (stiff along), 137, 116,
 * 95, 91 (through the wall), 62, 57, 62, 75 (around): more makes the pressures' equations easier and the displacement's
 * harder. The error of a thick sphere's displacement grows with it: 3.5, 3.9 and 4.8e-4 with 1, 2.5 and 5. */
static const double resisted_by_rest = 2.5;

static OstStatus split_mixed(OstContext *ctx, const OstMaterial *material, double nu_limit, double mode[3],
                             double rest[36], double *looseness, int *found)
{
    Modes modes;
    OST_TRY(find_modes(ctx, material, nu_limit, &modes, found));
    if (!*found)
        return OST_SUCCESS;
    const double sign =
        modes.vector[0] + modes.vector[1] + modes.vector[2] < 0.0 ? -1.0 : 1.0; /* tension is positive */
    for (int a = 0; a < 3; a++)
        mode[a] = sign * modes.vector[a] * sqrt(material->constants.youngs_modulus[a]);
    build_rest(material, resisted_by_rest, &modes, rest);
    *looseness = modes.eigenvalue[0] / (1.0 - resisted_by_rest * modes.eigenvalue[0]);
    return OST_SUCCESS;
}

static void forget_split(OstSplit *split)
{
    OST_FREE(split->stiff_mode, split->rest, split->looseness);
}

static OstStatus make_room(OstContext *ctx, int regions, OstSplit *split)
{
    forget_split(split);
    OST_TRY(OST_NEW(ctx, &split->stiff_mode, 3 * regions));
    OST_TRY(OST_NEW(ctx, &split->rest, 36 * regions));
    return OST_NEW(ctx, &split->looseness, regions);
}

static OstStatus split_region(const OstMaterialField *field, int region, OstSplitForm form, double nu_limit,
                              OstSplit *split, int *found)
{
    const OstMaterial *material = &field->material[region];
    double *mode = split->stiff_mode + 3 * region, *rest = split->rest + 36 * region;
    if (form == OST_SPLIT_MIXED)
        return split_mixed(field->ctx, material, nu_limit, mode, rest, &split->looseness[region], found);
    if (!material->incompressible)
        return split_material(field->ctx, material, nu_limit, mode, rest, found);
    return OST_RAISE(field->ctx, OST_INVALID_INPUT,
                     "material '%s': nu = 1/2 needs the mixed form of quadratic tets; for the mean dilatation nu must "
                     "be below 1/2",
                     material->name);
}

static OstStatus split_regions(OstMaterialField *field, OstSplitForm form, double nu_limit, int *regions)
{
    OstSplit *split = form == OST_SPLIT_MIXED ? &field->mixed : &field->mean;
    *regions = 0;
    OstStatus status = make_room(field->ctx, field->region_count, split);
    for (int r = 0; r < field->region_count && status == OST_SUCCESS; r++) {
        int found = 0;
        status = split_region(field, r, form, nu_limit, split, &found);
        *regions += found;
    }
    if (status != OST_SUCCESS || *regions == 0)
        forget_split(split);
    field->form = split->stiff_mode ? form : OST_SPLIT_NOT;
    return status;
}

OstStatus ost_field_mean_dilatation(OstMaterialField *field, double nu_limit, int *regions)
{
    ost_ledger_enter(field->ctx, OST_EFFECT_MEAN_DILATATION);
    const OstStatus status = split_regions(field, OST_SPLIT_MEAN, nu_limit, regions);
    ost_ledger_leave(field->ctx);
    return status;
}

int ost_field_incompressible(const OstMaterialField *field)
{
    int r = 0;
    while (r < field->region_count && !field->material[r].incompressible)
        r++;
    return r < field->region_count ? r : -1;
}

OstStatus ost_field_mixed(OstMaterialField *field, double nu_limit, int *regions)
{
    OstStatus status = OST_SUCCESS;
    ost_ledger_enter(field->ctx, OST_EFFECT_MIXED);
    if (ost_field_incompressible(field) < 0)
        status = split_regions(field, OST_SPLIT_MEAN, nu_limit, regions);
    OST_THEN(split_regions(field, OST_SPLIT_MIXED, nu_limit, regions));
    ost_ledger_leave(field->ctx);
    return status;
}

double ost_field_giving_way(const OstMaterialField *field, int32_t region)
{
    return 1.0 / resisted_by_rest + field->mixed.looseness[region];
}

static const OstSplit *split_of(const OstMaterialField *field)
{
    return field->form == OST_SPLIT_MIXED ? &field->mixed : &field->mean;
}

const double *ost_field_stiff_mode(const OstMaterialField *field, int32_t region)
{
    const double *mode = field->form == OST_SPLIT_NOT ? NULL : split_of(field)->stiff_mode + 3 * (size_t)region;
    return mode && (mode[0] != 0.0 || mode[1] != 0.0 || mode[2] != 0.0) ? mode : NULL;
}

const double *ost_field_rest(const OstMaterialField *field, int32_t region)
{
    return ost_field_stiff_mode(field, region) ? split_of(field)->rest + 36 * (size_t)region : NULL;
}

static void destroy_formulas(OstMaterialField *field)
{
    for (int r = 0; field->region_formula && r < field->region_count; r++)
        ost_axes_formula_destroy(&field->region_formula[r]);
    OST_FREE(field->region_formula);
}

void ost_field_destroy(OstMaterialField **field)
{
    if (!*field)
        return;
    destroy_formulas(*field);
    forget_split(&(*field)->mean);
    forget_split(&(*field)->mixed);
    OST_FREE((*field)->tet_scale, (*field)->region_eigenstrain, (*field)->tet_eigenstrain, (*field)->material,
             (*field)->region_stiffness, (*field)->region_axes, (*field)->region_varies, (*field)->tet_turn);
    OST_FREE((*field)->scale_law, (*field)->region_per_unit, (*field)->region_along, (*field)->tet_directions);
    OST_FREE(*field);
}
