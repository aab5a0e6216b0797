/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_ESTIMATE_H
#define ORTHOSTAT_ACCURACY_ESTIMATE_H

#include "algebra/solver.h"
#include "problem/problem.h"

/* A quantity of interest as a linear function of the displacement about u: what its adjoint problem is made of. */
typedef struct OstInterest {
    double *load; /* 3 × owned_nodes: by how much a displacement grows with each node's; of a moment's arms, where
                     rotations are large, and of springs on linked nodes, by how much less it does; or NULL */
    double
        *moved; /* of a reaction: 3 × node_count, a displacement that is 1 along the reaction at its nodes; or NULL */
    double *strain; /* of a mean stress: 6 × tet_count, the eigenstrain whose forces are by how much it grows with each
                       displacement, and with a mixed form's pressures; or NULL */
    int strain_in_world; /* is it in world axes, not along material ones? */
    double direction[3]; /* of a reaction: along it, or along the axis of its moment */
    double value;
    double doubt; /* of a reaction: the part that other supports of the same nodes may bear as well */
    double size;  /* of a reaction: the sum of the lengths of the nodes' forces, or moments */
    int stopped;  /* the caller's, of a displacement: what the equations leave of it is a part of its error */
} OstInterest;

/* Collective. Makes that of a watched displacement or reaction, or of the mean over a region of a measure that is
 * linear in the stress (whose value is not found). A length is taken along the vector as it is, or along x if that is
 * zero. Clear it also after a failure. */
OstStatus ost_interest_create(const OstProblem *problem, const OstWatch *watch, double t, const double *u,
                              OstInterest *interest);
void ost_interest_clear(OstInterest *interest);

/* An estimate of the discretisation error of a displacement u, by the surplus of the next order of elements: e is the
 * solution of A e = f - A u in the elements' space V and its complement W in that order (quadratic functions of the
 * edges of linear tets; cubic ones of the edges and faces of quadratic tets). A few conjugate gradient steps find e,
 * with the solver's preconditioner on V and 3×3 diagonal blocks on W. So the error is seen that the whole body makes
 * (a block of linear tets in bending is far too stiff everywhere), and material axes and jumps as they are (R. E. Bank
 * and R. K. Smith, A posteriori error estimates based on hierarchical bases, 1993).
 *
 * Of a mixed form the problem's field has the pressure of u (ost_problem_at_pressure), A is the stiffness without the
 * stiff mode, and e the displacement whose forces would balance what u and p leave: its energy is that of the error of
 * both (R. E. Bank and B. D. Welfert, A posteriori error estimates for the Stokes problem, 1991). */
typedef struct OstEstimate OstEstimate;

/* Collective. What is kept between calls for one problem. */
OstStatus ost_estimate_create(const OstProblem *problem, OstEstimate **estimate);

/* Collective. The problem has got another loading (problem/cases/load_case.h). */
OstStatus ost_estimate_take_loading(OstEstimate *estimate);

/* Collective. Other loadings follow: what is found for one starts the search for the next. For linear theory alone. */
OstStatus ost_estimate_remember(OstEstimate *estimate);

/* What is asked of an error e beside its size; each may be NULL. e is lengthened by what the steps that were not taken
 * would add. */
typedef struct OstSurplus {
    double *tet_error;    /* owned_tets: each tet's share of the squared error in the norm of the energy */
    double *displacement; /* 3 × node_count: e at the nodes, ghosts included */
    double *stress;       /* 6 × owned_tets: what it adds to the mean stress of the tet */
    double *along_axes;   /* 6 × owned_tets: what it adds to the same along material axes, as these vary in the tet,
                             beside that along the tet's own */
    float *node_stress;   /* 6 numbers for each node of each tet, ghosts included: what it adds to the stress there */
} OstSurplus;

/* Collective. The discretisation error of u (3 × node_count, ghosts included) at t; `solver` is of the problem's
 * stiffness at u. u need not solve the problem's equations well: what is missing there does not count. found->known is
 * 0 where the loads are not known as functions of place (a problem made of nodal forces), and where the solver has no
 * preconditioner that is positive definite. */
OstStatus ost_estimate_find(OstEstimate *estimate, OstSolver *solver, double t, const double *u, OstAnswerError *found,
                            const OstSurplus *surplus);

/* Local. Adds what the error of the equations, a displacement (3 × node_count, ghosts included), adds to displacements
 * and stresses; of a mixed form, to displacements. Linear theory. */
void ost_estimate_add(const OstEstimate *estimate, const double *error, const OstSurplus *surplus);

/* Collective. By how much the exact value of a quantity of interest is larger than that of u, by the adjoint problem: z
 * is the displacement whose load (or given motion) is that of the quantity, e_z its surplus, and the error is the work
 * of u's residual on e_z (R. Becker and R. Rannacher, An optimal control approach to a posteriori error estimation,
 * 2001). u solves the problem's equations well; those of z are solved to an error of `share` of it in the norm of the
 * energy, or, if that is 0, to the solver's residual. `tet_share`: owned_tets numbers, on entry each tet's share of the
 * squared error of u in the norm of the energy, as ost_estimate_find has it; then of the quantity's error, where a mesh
 * should be refined for it. They add up to |error|, or to a tenth of what all tets could add to if their errors had one
 * sign, if that is more. NAN: not known. Where rotations are large, the adjoint problem is that of the stiffness at u.
 */
OstStatus ost_estimate_interest(OstEstimate *estimate, OstSolver *solver, double t, const double *u,
                                const OstInterest *interest, double share, double *error, double *tet_share);

/* Local. Do stiff directions cross quadratic tets, so that what the next order misses is in the errors of reactions, of
 * unknown sign? */
int ost_estimate_misses(const OstEstimate *estimate);

/* The adjoint problem of a reaction, or of a mixed form's mean stress by linear theory, solved once for all loads on
 * the same supports; where rotations are large, that of the stiffness at u. */
typedef struct OstAdjoint OstAdjoint;

/* Collective. *adjoint is NULL where none can be found. Its equations are solved to an error of this share of z in the
 * norm of the energy; 0: to the solver's residual. */
OstStatus ost_adjoint_create(OstEstimate *estimate, OstSolver *solver, double t, const double *u,
                             const OstInterest *interest, double share, OstAdjoint **adjoint);
void ost_adjoint_destroy(OstAdjoint **adjoint);

/* Collective. By how much the exact reaction is larger than that of u, taken by its adjoint problem; by how much a mean
 * stress is smaller. `tet_error`: owned_tets, of u, as ost_estimate_find has it. */
OstStatus ost_adjoint_error(const OstAdjoint *adjoint, OstEstimate *estimate, double t, const double *u,
                            const double *tet_error, double *error);

/* Local. What z has beside the given motion, 3 × owned_nodes; 0 where that is. */
const double *ost_adjoint_displacement(const OstAdjoint *adjoint);

/* Local. The owned pressures of z, of a mixed form; else NULL. */
const double *ost_adjoint_pressure(const OstAdjoint *adjoint);

/* Collective. An estimate for another loading, which uses what this one keeps and is destroyed before it. Of linear
 * theory. */
OstStatus ost_estimate_share(OstEstimate *estimate, const OstProblem *problem, OstEstimate **shared);

/* Local. Keeps what ost_estimate_find finds last, for loads of which this is a part. Of linear theory. */
void ost_estimate_keep(OstEstimate *estimate);

/* Local. The load is the sum of those of other estimates, which keep what they found until this one is destroyed, each
 * times a factor. Where their residuals add up to this one's, so do their errors, and no steps are taken. */
void ost_estimate_add_up(OstEstimate *estimate, int count, OstEstimate *const *part, const double *factor);

void ost_estimate_destroy(OstEstimate **estimate);

#endif
