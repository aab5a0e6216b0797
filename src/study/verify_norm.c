/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/verify_view.h"

#include "core/error.h"
#include "element/quadrature.h"
#include "element/shape_functions.h"

#include <math.h>

/* Squares of the formula's field and of the answer's distance from it, integrated over the body. */
enum { OF_FORMULA, OF_DIFFERENCE, SQUARES };

/* One quadrature point of a tet. */
typedef struct Point {
    const double *at;
    double values[OST_MAX_TET_NODES];
    double place[3];
    double weight; /* in volume */
} Point;

static OstStatus add_displacement(const OstVerifyView *view, const OstViewTet *tet, const Point *point,
                                  double squares[SQUARES])
{
    double exact[3], moved[3];
    OST_TRY(view->exact->displacement(view->exact->data, point->place, exact));
    ost_shape_place(tet->nodes, point->values, tet->u, moved);
    for (int i = 0; i < 3; i++) {
        squares[OF_FORMULA] += point->weight * exact[i] * exact[i];
        squares[OF_DIFFERENCE] += point->weight * (moved[i] - exact[i]) * (moved[i] - exact[i]);
    }
    return OST_SUCCESS;
}

/* Integrals of m'strain over a tet, m being the stiff mode. */
typedef struct Modes {
    double of[SQUARES];
} Modes;

/* The element's energy: with mean dilatation, the stiff mode is left out here and its integral goes to `modes`. */
static OstStatus add_energy(const OstVerifyView *view, const OstViewTet *tet, const Point *point,
                            double squares[SQUARES], Modes *modes)
{
    double g[9], c[36], strain[SQUARES][6], stress[6];
    OstViewMode mode;
    OST_TRY(view->exact->gradient(view->exact->data, point->place, g));
    OST_TRY(view->exact->stiffness(view->exact->data, point->place, c));
    ost_view_strain_of_gradient(g, strain[OF_FORMULA]);
    ost_view_strain(tet, point->at, strain[OF_DIFFERENCE]);
    ost_view_mode(view, tet->number, point->place, &mode);
    for (int p = 0; p < 6; p++)
        strain[OF_DIFFERENCE][p] -= strain[OF_FORMULA][p];
    for (int s = 0; s < SQUARES; s++) {
        const double part = ost_view_dot6(mode.m, strain[s]);
        ost_view_stress(c, strain[s], stress);
        squares[s] += point->weight * (ost_view_dot6(stress, strain[s]) - part * part);
        modes->of[s] += point->weight * part;
    }
    return OST_SUCCESS;
}

static OstStatus add_tet(const OstVerifyView *view, OstLocal number, double squares[SQUARES])
{
    OstViewTet tet;
    Modes modes = {{0.0}};
    double gradients[3 * OST_MAX_TET_NODES], volume = 0.0;
    ost_view_gather_tet(view, number, &tet);
    for (int q = 0; q < ost_tet_degree5.count; q++) {
        Point point = {.at = ost_tet_degree5.point[q].at};
        ost_shape_values(tet.nodes, point.at, point.values);
        ost_shape_place(tet.nodes, point.values, tet.x, point.place);
        point.weight =
            ost_tet_degree5.point[q].weight * ost_shape_gradients(tet.nodes, point.at, tet.x, gradients) / 6.0;
        volume += point.weight;
        OST_TRY(view->quantity->norm == OST_NORM_DISPLACEMENT ? add_displacement(view, &tet, &point, squares)
                                                              : add_energy(view, &tet, &point, squares, &modes));
    }
    for (int s = 0; s < SQUARES; s++)
        squares[s] += modes.of[s] * modes.of[s] / volume;
    return OST_SUCCESS;
}

OstStatus ost_view_measure_field(const OstVerifyView *view, OstVerifyReading *reading)
{
    OstContext *ctx = view->mesh->ctx;
    double squares[SQUARES] = {0.0};
    OstStatus status = OST_SUCCESS;
    for (OstLocal tet = 0; tet < view->mesh->owned_tets && status == OST_SUCCESS; tet++)
        status = add_tet(view, tet, squares);
    OST_TRY(ost_agree(ctx, status));
    OST_TRY(ost_view_reduce(ctx, SQUARES, squares));
    reading->expected = sqrt(squares[OF_FORMULA]);
    reading->obtained = sqrt(fmax(squares[OF_DIFFERENCE], 0.0));
    reading->error = reading->obtained / reading->expected;
    return OST_SUCCESS;
}
