/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/verify_view.h"

#include "core/error.h"
#include "core/parallel/reduce.h"
#include "element/quadrature.h"
#include "element/shape_functions.h"

#include <string.h>

void ost_view_gather(const OstLocal *nodes, int count, const double *values, double *rows)
{
    for (int a = 0; a < count; a++)
        memcpy(rows + 3 * a, values + 3 * (size_t)nodes[a], 3 * sizeof *rows);
}

void ost_view_gather_tet(const OstVerifyView *view, OstLocal tet, OstViewTet *gathered)
{
    const int n = view->mesh->nodes_per_tet;
    const OstLocal *nodes = view->mesh->tet_nodes + (size_t)n * (size_t)tet;
    gathered->nodes = n;
    gathered->number = tet;
    ost_view_gather(nodes, n, view->mesh->coordinates, gathered->x);
    ost_view_gather(nodes, n, view->result->displacement, gathered->u);
}

void ost_view_strain_of_gradient(const double g[9], double strain[6])
{
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3;
        strain[i] = g[4 * i];
        strain[3 + i] = g[3 * i + next] + g[3 * next + i];
    }
}

void ost_view_strain(const OstViewTet *tet, const double at[4], double strain[6])
{
    double gradients[3 * OST_MAX_TET_NODES];
    double g[9] = {0.0};
    ost_shape_gradients(tet->nodes, at, tet->x, gradients);
    for (int a = 0; a < tet->nodes; a++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                g[3 * i + j] += tet->u[3 * a + i] * gradients[3 * a + j];
    ost_view_strain_of_gradient(g, strain);
}

void ost_view_mode(const OstVerifyView *view, OstLocal tet, const double place[3], OstViewMode *mode)
{
    const OstMaterialField *field = view->result->field;
    const double *along = ost_field_stiff_mode(field, field->tet_region[tet]);
    double axes[9];
    *mode = (OstViewMode){.split = along != NULL && view->mesh->nodes_per_tet > 4};
    if (!mode->split)
        return;
    ost_field_axes_at(field, tet, place, axes);
    for (int a = 0; a < 3; a++)
        for (int i = 0; i < 3; i++) {
            mode->m[i] += along[a] * axes[3 * a + i] * axes[3 * a + i];
            mode->m[3 + i] += along[a] * axes[3 * a + i] * axes[3 * a + (i + 1) % 3];
        }
}

double ost_view_mean_of_mode(const OstVerifyView *view, const OstViewTet *tet)
{
    double sum = 0.0, volume = 0.0;
    for (int q = 0; q < ost_tet_degree5.count; q++) {
        const OstQuadraturePoint *point = &ost_tet_degree5.point[q];
        double values[OST_MAX_TET_NODES], gradients[3 * OST_MAX_TET_NODES], place[3], strain[6];
        OstViewMode mode;
        ost_shape_values(tet->nodes, point->at, values);
        ost_shape_place(tet->nodes, values, tet->x, place);
        ost_view_mode(view, tet->number, place, &mode);
        if (!mode.split)
            return 0.0;
        const double weight = point->weight * ost_shape_gradients(tet->nodes, point->at, tet->x, gradients);
        ost_view_strain(tet, point->at, strain);
        sum += weight * ost_view_dot6(mode.m, strain);
        volume += weight;
    }
    return sum / volume;
}

double ost_view_dot6(const double a[6], const double b[6])
{
    double sum = 0.0;
    for (int i = 0; i < 6; i++)
        sum += a[i] * b[i];
    return sum;
}

void ost_view_stress(const double c[36], const double strain[6], double stress[6])
{
    for (int i = 0; i < 6; i++)
        stress[i] = ost_view_dot6(c + 6 * i, strain);
}

OstStatus ost_view_reduce(OstContext *ctx, int count, double *sums)
{
    return ost_sum(ctx, count, sums);
}
