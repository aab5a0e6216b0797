/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_SEARCH_H
#define ORTHOSTAT_ACCURACY_SEARCH_H

#include "accuracy/earlier.h"
#include "accuracy/loads.h"
#include "accuracy/steps.h"

/* The conjugate gradients of an estimate, on elements and complement: for accuracy/estimate.c, and for adjoint problems
 * (accuracy/adjoint.c). */

/* When steps end: what the last pair added is below a share of |e|², and so is what is to come if gains go on falling
 * as they did. */
typedef struct Enough {
    double rest, gain;
    int by_left; /* does what is left on the functions tell before? */
} Enough;

enum { OST_MOST_PARTS = 16 };

/* An error that was found, for loads that are sums (accuracy/sum.c): over `size`, as OstSteps has it. */
typedef struct OstKeptError {
    double *rows;
    float *functions, *residual;
    double size, square;    /* |e|² in the case's units, as extrapolated */
    double stretch, longer; /* the same over that of the tets; Search.longer */
    int is_settled, is_known;
} OstKeptError;

typedef struct OstEstimate {
    const OstProblem *problem;
    int is_shared; /* is all but the loads another's? */
    OstComplement complement;
    OstSurplusLoads loads;
    OstOperator stiffness;
    float *factor;       /* of the functions' blocks, once they are known */
    int has_factor;      /* of linear theory */
    int knows_orders;    /* do the orders of u tell what orders above the next add to e? */
    int misses;          /* do stiff directions cross quadratic tets, so that orders above are missed? */
    double per_left;     /* what later steps add to |e|², over what is left of r'B r */
    int is_flat;         /* are the tets flat? */
    int is_stacked;      /* so: have their functions stacks? */
    double of_flat;      /* what orders from the next on add, over what the next does, at least: 1 but in flat tets */
    OstStacks *stacks;   /* in place of `factor`; or NULL */
    OstEarlier *earlier; /* what was found for other loads; or NULL */
    int keeps;           /* is what is found kept, for loads that are sums? */
    OstKeptError kept;
    int part_count; /* the load is the sum of those of other estimates, times factors; 0: of none */
    struct OstEstimate *part[OST_MOST_PARTS];
    double part_factor[OST_MOST_PARTS];
    Enough enough, enough_of_adjoint; /* a quantity's error may be small beside the product of two, as parts cancel */
} OstEstimate;

typedef struct Search {
    OstSteps steps;
    OstEstimate *estimate;
    double longer;  /* by what e is short of in its work on the residual, as extrapolated: a factor */
    double higher;  /* by what orders above the functions' add to |e|²: a factor; 1 where that is not known */
    double stretch; /* |e|² over that of the tets, where it is known before; else 0 */
    double of_tets; /* |e|² as tets have it, in the case's units, once they have been visited */
    double energy;  /* of this rank's tets, under u; NAN: not known */
    int of_adjoint; /* is the error that of an adjoint problem, unlike those of loads? */
} Search;

/* Collective. Takes the stiffness to u. */
OstStatus ost_search_move(OstEstimate *estimate, const double *u);

/* Collective. Close its steps also after a failure. */
OstStatus ost_search_open(OstEstimate *estimate, OstSolver *solver, Search *search);

/* Collective. r = f - A u on the functions; on the rows, where rotations are large, by how much the elements' own
 * quadrature differs. */
OstStatus ost_search_residual(Search *search, double t, const double *u);

/* Collective. r, from forces left on the functions, and those in r.rows. */
OstStatus ost_search_take(Search *search, const double *left);

/* Collective. Steps until what is to come of |e|² is small; `start` is that of the part of e that was found
 * before. Squares are in the steps' units. */
OstStatus ost_search_iterate(Search *search, double start, double *square);

/* Local. A square in the case's units. */
double ost_search_true_square(const Search *search, double square);

/* Collective. steps.u: e at the nodes. */
OstStatus ost_search_displacement(Search *search);

/* Collective. Each tet's share of `square`, of the error whose nodes' part is steps.u. The square is found by the way
 * where its ratio to the tets' is known (search->stretch). */
OstStatus ost_search_share(Search *search, double *square, double *tet_error);

/* Of orders above the next (accuracy/orders.c): known of quadratic tets, but of nearly incompressible ones. */
int ost_orders_are_known(const OstEstimate *estimate);

/* Local. What the second order adds to a displacement's (3 × node_count, ghosts included) energy in each tet.
 * Overwrites steps.u and the functions of steps.p. */
void ost_orders_second(Search *search, const double *u, double *of_second);

/* What order three adds over what the second does: 0.3 at most. */
double ost_orders_share(double of_third, double of_second);

/* Collective. Adds what orders above the third would find to each tet's share of |e|², and to `square`, the sum.
 * Overwrites as above. */
OstStatus ost_orders_add(Search *search, const double *u, double *tet_error, double *square);

/* Of a tet of an adjoint problem: the third order's part of |e|² of z, and its share. */
typedef struct OstOrders {
    float of_third, share;
} OstOrders;

/* Collective. How many times as large the product of the errors of u and of an adjoint problem is with the orders that
 * are higher still: where both have a share of their own, r, that of the product is the root of both, so that the
 * product of an error with itself is its square. tet_error: each tet's share of |e|² of u, with those orders.
 * *unsigned_sum: of the third order's products of all tets, as if all had one sign. Overwrites as above. */
OstStatus ost_orders_of_product(Search *search, const double *u, const double *tet_error, const OstOrders *of_adjoint,
                                double *factor, double *unsigned_sum);

/* The errors of loads add up as the loads do (accuracy/sum.c): they are linear in them, whatever steps found them. */

/* Collective. Keeps the residual of a search before its first step; and then the error found, whose square is |e|² in
 * the case's units. `is_settled`: by ost_steps_settle. Nothing where the estimate is not to keep it. */
OstStatus ost_sum_keep_residual(const Search *search);
OstStatus ost_sum_keep_error(const Search *search, double square, int is_settled);

/* Collective. Takes the sum of what other estimates have kept for the error, where their residuals add up to this one's
 * (*found). Is one that is settled needed? */
OstStatus ost_sum_take(Search *search, int needs_settled, int *found);

void ost_sum_clear(OstKeptError *kept);

/* A displacement (3 × node_count, ghosts included) whose pressure the problem's field has. */
typedef struct OstState {
    const OstProblem *problem;
    const double *u;
    double eigen_share;
    OstFormulation formulation; /* LINEAR: also of a small one about a body that has turned */
    double swelling;            /* of incompressible material, over |m|, that is to be left */
} OstState;

/* Collective, after the steps of a mixed form's estimate. They have found the e of which A e balances
 * what u and p leave; that is the displacement's error and what the pressure's brings with it, A e = A e_u + B'e_p. So
 * e_p, linear in each tet, is what e leaves of the second equation, over what B A^-1 B' is about in a solve too; the
 * displacement that this takes off e is found by steps as e was. (To do both again with what is left gains nothing.)
 * of_tets (4 × tet_count, 0 on entry): e_p at the vertices; the search's e becomes e_u, already lengthened.
 * steps.failed: not known. */
OstStatus ost_pressure_error(Search *search, const OstState *of, double *of_tets);

/* Collective. The work of such a pressure on what a state leaves of the second equation. */
OstStatus ost_pressure_work(const OstEstimate *estimate, const OstState *of, const double *of_tets, double *work);

#endif
