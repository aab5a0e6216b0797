/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_COST_REFERENCE_H
#define ORTHOSTAT_STUDY_COST_REFERENCE_H

/* What an answer tends to as its mesh is refined. */

enum { OST_COST_MOST_QUANTITIES = 24, OST_COST_NOTE_SIZE = 256 };

/* q(h) = limit + C h^rate through three answers. */
typedef struct OstExtrapolation {
    double limit;
    double rate;
} OstExtrapolation;

/* Local. From answers at three element sizes h[0] > h[1] > h[2]. Returns 0 where none of that form goes through them:
 * they do not tend anywhere (the differences do not shrink, or change their sign), or two are the same. */
int ost_extrapolate(const double h[3], const double q[3], OstExtrapolation *found);

typedef enum {
    OST_REFERENCE_NONE,
    OST_REFERENCE_EXTRAPOLATED,
    OST_REFERENCE_FINEST,  /* the finest answer as it is, whose own error is then not known */
    OST_REFERENCE_SETTLED, /* refinement no longer changes the answer by more than the solver leaves */
    OST_REFERENCE_FORMULA  /* no answer: what the case expects */
} OstReferenceKind;

typedef struct OstCostReference {
    OstReferenceKind kind;
    double value;
    double size;        /* errors are shares of this: |value|, or the scale of its kind where the value is nothing */
    double uncertainty; /* relative: how far the reference may be off; infinite where nothing tells */
    double rate;        /* observed; 0: none */
    int order;          /* of the answers it comes from; 0: a formula */
    int finest;         /* their highest refinement */
    char note[OST_COST_NOTE_SIZE];
} OstCostReference;

/* The answers of one order at the tightest tolerance they were solved to, from coarse to fine. */
typedef struct OstAnswers {
    int order;
    int count;
    const int *refinement;
    const double *value;
    double noise; /* relative: what the solver may leave in them */
    double scale;
} OstAnswers;

/* Local. What halving the size of the elements can divide an error by at best. */
double ost_best_rate_factor(int order);

/* Local. The reference that one order's answers give. A rate makes sense from 0.4 (singular edges) to half an order
 * above 2 × order (what energy gains on smooth answers). */
void ost_reference_of(const OstAnswers *answers, OstCostReference *reference);

/* Local. The reference that a formula gives, which is taken to be exact. */
void ost_reference_of_formula(double value, double scale, OstCostReference *reference);

/* Local. "none", "extrapolated", "finest", "settled" or "formula". */
const char *ost_reference_kind_word(OstReferenceKind kind);

/* Local. An order's only answer knows nothing of itself; it is taken to be off by no more than it differs from the best
 * answer of the order below. */
void ost_reference_compare(OstCostReference *lone, double lower);

#endif
