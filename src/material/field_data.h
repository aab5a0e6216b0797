/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MATERIAL_FIELD_DATA_H
#define ORTHOSTAT_MATERIAL_FIELD_DATA_H

#include "effect/effect.h"
#include "orthostat/field.h"

#include <math.h>

typedef enum { OST_SPLIT_NOT, OST_SPLIT_MEAN, OST_SPLIT_MIXED } OstSplitForm;

/* C = rest + m m' (ost_field_mean_dilatation), or rest + m m' / looseness (ost_field_mixed). NULL: no C is split. */
typedef struct OstSplit {
    double *stiff_mode; /* region_count × 3: m along the material axes, 0 for regions whose C is not split */
    double *rest;       /* region_count × 36: the rest of C in material axes */
    double *looseness;  /* region_count, of the mixed form: 0 if incompressible */
} OstSplit;

/* Elasticity and axes of every tet of a rank, stored only as far as needed: an isotropic body has no axes, a region
 * with uniform axes one rotated C, and only regions whose axes vary have axes by tet. */
struct OstMaterialField {
    OstContext *ctx;
    int region_count;
    OstMaterial *material;        /* region_count */
    double *region_stiffness;     /* region_count × 36, world axes; valid where the region's axes do not vary */
    double *region_axes;          /* region_count × 9; NULL if no material is orthotropic */
    unsigned char *region_varies; /* region_count */
    double *tet_turn;             /* NULL if no orthotropic region's axes vary; else tet_count × 4 (material/turn.h) */
    const int32_t *tet_region;    /* the mesh's; not owned */

    /* region_count, NULL for regions whose axes have no formula; NULL if no region's axes have one. */
    struct OstAxesFormula **region_formula;

    /* Axes that follow directions within each tet (material/directions.h), of regions of two different ones:
     * region_count × 2, the axes that these are; tet_count × 24. NULL: no region's do. */
    signed char *region_along;
    float *tet_directions;

    /* How C of regions with one stiff mode is split: not, as the mean dilatation or the mixed form have it. A field may
     * have both, and a copy of it use the other. */
    OstSplitForm form;
    OstSplit mean, mixed;

    /* The pressure of the state that forces and stresses are asked for: 4 × tet_count, at the tets' vertices, 0 where C
     * is not split; not owned. NULL: 0 everywhere. */
    const double *pressure;

    /* Of each tet, or at each of its four vertices, which are its `places`: C is that of the region times this
     * (ost_field_set_scale); NULL: 1. */
    double *tet_scale;
    int scale_places;
    double *scale_law; /* region_count × 3: C is that times max(factor · scale^power, least); NULL: times the scale */

    double *region_eigenstrain;   /* region_count × 6, in material axes; NULL if no region has one */
    double *tet_eigenstrain;      /* tet_count × places × columns, added to the region's; NULL if none was given */
    int eigenstrain_places;       /* 1 or 4, as of the scale */
    double *region_per_unit;      /* region_count × 6: strains for the one column that there is then; NULL: six */
    int tet_eigenstrain_in_world; /* is that in world axes? */
};

/* Local. The first region that is incompressible (nu = 1/2), or -1. */
int ost_field_incompressible(const OstMaterialField *field);

/* Local. The share of a place in what a tet has at barycentric coordinates `at`; NULL: in its mean. */
static inline double ost_field_share(size_t places, const double at[4], size_t place)
{
    return places == 1 ? 1.0 : at ? at[place] : 0.25;
}

static inline double ost_scale_by_law(const double law[3], double number)
{
    return fmax(law[0] * (law[1] == 1.0 ? number : pow(number, law[1])), law[2]);
}

/* Local. The factor of a tet's stiffness at barycentric coordinates; NULL: that of the mean. */
static inline double ost_field_scale(const OstMaterialField *field, OstLocal tet, const double at[4])
{
    const size_t places = (size_t)field->scale_places;
    double sum = 0.0;
    for (size_t place = 0; place < places && field->tet_scale; place++)
        sum += ost_field_share(places, at, place) * field->tet_scale[places * (size_t)tet + place];
    if (field->tet_scale && field->scale_law)
        return ost_scale_by_law(field->scale_law + 3 * (size_t)field->tet_region[tet], sum);
    return field->tet_scale ? sum : 1.0;
}

/* Local. Numbers of tets, or at their vertices if `places` is 4, that a law for each region makes the factors of: 3 ×
 * region_count, copied. They are not checked. */
OstStatus ost_field_set_scale_by_law(OstMaterialField *field, OstLocal tet_count, int places, const double *numbers,
                                     const double *law);

/* Local. Does C, or the eigenstrain, differ between the vertices of tets? */
static inline int ost_field_scales_within(const OstMaterialField *field)
{
    return field->tet_scale && field->scale_places > 1;
}

static inline int ost_field_strains_within(const OstMaterialField *field)
{
    return field->tet_eigenstrain && field->eigenstrain_places > 1;
}

/* Local. Does any tet have an eigenstrain? */
int ost_field_is_eigenstrained(const OstMaterialField *field);

static inline size_t ost_field_eigenstrain_columns(const OstMaterialField *field)
{
    return field->region_per_unit ? 1 : 6;
}

/* Local. As ost_field_set_eigenstrain, with strains at the vertices if `places` is 4, or with one number in place of
 * each six, times its region's `per_unit` (6 × regions; or NULL). */
OstStatus ost_field_set_eigenstrain_at(OstMaterialField *field, const double *of_regions, OstLocal tet_count,
                                       int places, const double *of_tets, const double *per_unit);

/* Local. A symmetric tensor 11 22 33 12 23 31 along axes (rows). */
void ost_tensor_along(const double tensor[6], const double axes[9], double own[6]);

/* Local. Adds `share` of a tet's eigenstrain at barycentric coordinates (NULL: its mean) to `strain`, in the world axes
 * that the material's `axes` are given in. */
void ost_field_add_eigenstrain(const OstMaterialField *field, OstLocal tet, const double at[4], double share,
                               const double axes[9], double strain[6]);

/* Local. C of a tet in world axes. */
void ost_field_stiffness(const OstMaterialField *field, OstLocal tet, double stiffness[36]);

/* Local. The material metric of a tet, R' diag(√(E_min / E_k)) R with R the axes, as 11 22 33 12 23 31: lengths along
 * stiff directions are short, along the softest direction Euclidean. */
void ost_field_metric(const OstMaterialField *field, OstLocal tet, double metric[6]);

/* Local. Do a region's axes come from a formula, which can be evaluated at any point? */
int ost_field_has_formula(const OstMaterialField *field, int32_t region);

/* Local. Which axes directions are that a region's axes follow within each tet; NULL if they follow none. */
static inline const signed char *ost_field_directions_along(const OstMaterialField *field, int32_t region)
{
    const signed char *along = field->region_along ? field->region_along + 2 * (size_t)region : NULL;
    return along && along[0] != along[1] ? along : NULL;
}

/* Local. Do a region's axes vary within a tet? */
int ost_field_varies_within(const OstMaterialField *field, int32_t region);

/* Local. Axes at a point of a tet, at barycentric coordinates `at`, by directions, or by the formula; the tet's own
 * axes if there is neither, or where they are not defined (on a cylinder's axis). */
void ost_field_axes_at(const OstMaterialField *field, OstLocal tet, const double at[4], const double point[3],
                       double axes[9]);

/* Local. Has the axes of some regions follow directions: region_count × 2 axes, twice the same of those that do not,
 * and tet_count × OST_DIRECTIONS numbers. Both from the context's memory, and the field's from now on. */
void ost_field_take_directions(OstMaterialField *field, signed char **along, float **directions);

/* Local. Does any material have strengths? */
int ost_field_has_strengths(const OstMaterialField *field);

/* Local. Density of a tet. */
double ost_field_density(const OstMaterialField *field, OstLocal tet);

/* Local. A field of `region_count` materials (copied), with the regions' axes by `specs` (NULL: none), evaluated at the
 * `tet_count` centroids. Regions of kind OST_AXES_CELLS and OST_AXES_GRADIENT have the axes `given_axes` (tet_count ×
 * 9, NULL if there are none). `effects` are the scene's (NULL: all count as on): OST_EFFECT_REGIONS,
 * OST_EFFECT_ORTHOTROPY and OST_EFFECT_VARYING_AXES. Raises OST_INVALID_INPUT, with the tet's label, if axes are
 * left-handed or skew. */
OstStatus ost_field_create(OstContext *ctx, const OstEffects *effects, int region_count, const OstMaterial *materials,
                           const OstAxesSpec *specs, OstLocal tet_count, const int32_t *tet_region,
                           const OstGlobal *tet_label, const double *centroids, const double *given_axes,
                           OstMaterialField **field);

/* Local. m of a region along its axes (three numbers), or NULL if its C is not split. */
const double *ost_field_stiff_mode(const OstMaterialField *field, int32_t region);

/* Local. C - m m' of such a region in material axes (36 numbers), or NULL. It is not computed as a difference: near nu
 * = 1/2 both are so large that rounding errors would be all that is left. */
const double *ost_field_rest(const OstMaterialField *field, int32_t region);

/* Local. Is C of some region split for the mixed form? */
static inline int ost_field_is_mixed(const OstMaterialField *field)
{
    return field->form == OST_SPLIT_MIXED;
}

/* Local. What the rest and the stiff mode of a mixed region give way by under its pressure, for each volume: m'rest^-1
 * m
 * + looseness. The Schur complement of the displacement is about this times the pressure's mass. */
double ost_field_giving_way(const OstMaterialField *field, int32_t region);

#endif
