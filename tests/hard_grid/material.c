/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "hard_grid/grid.h"

#include <math.h>

/* Nine constants at a share of the border of stability. The three normalised Poisson's ratios are -0.4, -0.3, -0.2 (off
 * the diagonal of the normalised normal block), whatever the moduli; they are scaled up until the smallest eigenvalue
 * is almost zero. */
static OstStatus border_constants(OstContext *ctx, const double youngs[3], double share, OstOrthotropic *constants)
{
    static const double normalised[3] = {0.4, 0.3, 0.2};
    double eigenvalues[3];
    *constants = ost_orthotropic_family(youngs, 0.3, OST_SHEAR_GEOMETRIC);
    for (int i = 0; i < 3; i++)
        constants->poissons_ratio[i] = normalised[i] * (sqrt(youngs[i]) / sqrt(youngs[(i + 1) % 3]));
    OST_TRY(ost_orthotropic_eigenvalues(ctx, constants, eigenvalues));
    const double scale = share * ost_orthotropic_stable_scale(eigenvalues);
    for (int i = 0; i < 3; i++)
        constants->poissons_ratio[i] *= scale;
    return OST_SUCCESS;
}

static OstStatus constants_of(OstContext *ctx, const HardPoint *point, double modulus, OstOrthotropic *constants)
{
    double youngs[3] = {modulus, modulus, modulus};
    youngs[point->stiff] *= hard_ratio[point->ratio];
    if (point->flaw == HARD_BEYOND_BORDER)
        return border_constants(ctx, youngs, 1.001, constants);
    if (point->poisson >= HARD_FAMILY && point->poisson < HARD_POISSONS)
        return border_constants(ctx, youngs, hard_border[point->poisson - HARD_FAMILY], constants);
    const int half = point->flaw == HARD_NU_HALF || point->poisson == HARD_INCOMPRESSIBLE;
    const double nu = half ? 0.5 : hard_nu[point->poisson];
    *constants = ost_orthotropic_family(youngs, nu, OST_SHEAR_GEOMETRIC);
    return OST_SUCCESS;
}

static void set_axes(const HardPoint *point, OstAxesSpec *axes)
{
    static const OstCylindricalDirection order[3] = {OST_AXIAL, OST_RADIAL, OST_TANGENTIAL};
    static const OstAxesKind kind[HARD_AXES] = {OST_AXES_NONE, OST_AXES_CYLINDRICAL, OST_AXES_CELLS};
    axes->kind = kind[point->axes];
    for (int i = 0; i < 3; i++)
        axes->order[i] = order[i];
    hard_cylinder(point->shape, axes->origin, axes->axis);
}

OstStatus hard_materials(OstContext *ctx, const HardPoint *point, HardCase *hard)
{
    static char all[] = "all", inclusion[] = "inclusion";
    const double contrast = hard_contrast(point->shape);
    hard->c.materials = hard->material;
    hard->c.unmixed = point->poisson != HARD_INCOMPRESSIBLE && !point->usual; /* most judge one matrix's solution */
    hard->c.material_count = contrast == 1.0 ? 1 : 2;
    for (int m = 0; m < hard->c.material_count; m++) {
        hard->material[m].region = m == 0 ? all : inclusion;
        OstOrthotropic constants;
        set_axes(point, &hard->material[m].axes);
        OST_TRY(constants_of(ctx, point, m == 0 ? 1.0 : contrast, &constants));
        OST_TRY(ost_material_create(ctx, hard->material[m].region, &constants, 0.0, &hard->material[m].material));
    }
    return OST_SUCCESS;
}
