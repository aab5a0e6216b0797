/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/quadrature.h"

/* Orbits: all points whose coordinates are a permutation of one point's. */
#define FOUR(a, b, w) /* three coordinates a, one b */       \
    {{b, a, a, a}, w}, {{a, b, a, a}, w}, {{a, a, b, a}, w}, \
    {                                                        \
        {a, a, a, b}, w                                      \
    }
#define SIX(a, b, w) /* two coordinates a, two b */                                                \
    {{b, b, a, a}, w}, {{b, a, b, a}, w}, {{b, a, a, b}, w}, {{a, b, b, a}, w}, {{a, b, a, b}, w}, \
    {                                                                                              \
        {a, a, b, b}, w                                                                            \
    }
#define THREE(a, b, w) /* of a triangle: two coordinates a, one b */ \
    {{b, a, a, 0.0}, w}, {{a, b, a, 0.0}, w},                        \
    {                                                                \
        {a, a, b, 0.0}, w                                            \
    }

static const OstQuadraturePoint tet_degree1[] = {{{0.25, 0.25, 0.25, 0.25}, 1.0}};

/* a = (5 - sqrt 5) / 20, b = 1 - 3a */
static const OstQuadraturePoint tet_degree2[] = {FOUR(0.138196601125010515, 0.585410196624968454, 0.25)};

/* The constants of degree 3 and 5 solve the rules' moment equations, computed to 30 digits. */
static const OstQuadraturePoint tet_degree3[] = {
    FOUR(0.32816330251638168506, 0.01551009245085494481, 0.13621784253708739193),
    FOUR(0.10804724989842858783, 0.67585825030471423652, 0.11378215746291260807),
};

static const OstQuadraturePoint tet_degree5[] = {
    FOUR(0.31088591926330060980, 0.06734224221009817061, 0.11268792571801585080),
    FOUR(0.09273525031089122640, 0.72179424906732632079, 0.07349304311636194954),
    SIX(0.04550370412564964949, 0.45449629587435035051, 0.04254602077708146644),
};

static const OstQuadraturePoint tet_nodes[] = {
    {{1, 0, 0, 0}, 0},     {{0, 1, 0, 0}, 0},     {{0, 0, 1, 0}, 0},     {{0, 0, 0, 1}, 0},     {{0.5, 0.5, 0, 0}, 0},
    {{0, 0.5, 0.5, 0}, 0}, {{0.5, 0, 0.5, 0}, 0}, {{0.5, 0, 0, 0.5}, 0}, {{0, 0.5, 0, 0.5}, 0}, {{0, 0, 0.5, 0.5}, 0},
};

/* a = (6 ± sqrt 15) / 21, w = (155 ± sqrt 15) / 1200 */
static const OstQuadraturePoint triangle_degree5[] = {
    {{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 0.0}, 9.0 / 40.0},
    THREE(0.101286507323456339, 0.797426985353087322, 0.125939180544827153),
    THREE(0.470142064105115090, 0.059715871789769820, 0.132394152788506181),
};

#define RULE(points)                                    \
    {                                                   \
        (int)(sizeof points / sizeof points[0]), points \
    }
const OstQuadrature ost_tet_degree1 = RULE(tet_degree1);
const OstQuadrature ost_tet_degree2 = RULE(tet_degree2);
const OstQuadrature ost_tet_degree3 = RULE(tet_degree3);
const OstQuadrature ost_tet_degree5 = RULE(tet_degree5);
const OstQuadrature ost_tet_nodes = RULE(tet_nodes);
const OstQuadrature ost_triangle_degree5 = RULE(triangle_degree5);
