/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_COST_REFERENCE_H
#define ORTHOSTAT_STUDY_COST_REFERENCE_H

/* Reference values: what a quantity tends to as the mesh is refined. */

enum { OST_COST_MOST_QUANTITIES = 24, OST_COST_NOTE_SIZE = 256 };

/* q(h) = limit + C h^rate through three answers. */
typedef struct OstExtrapolation {
    double limit;
    double rate;
} OstExtrapolation;

/* Local. From values at three element sizes h[0] > h[1] > h[2]. Returns 0 if no such curve goes through them: the
 * differences do not shrink, or change their sign, or are zero. */
int ost_extrapolate(const double h[3], const double q[3], OstExtrapolation *found);

typedef enum {
    OST_REFERENCE_NONE,
    OST_REFERENCE_EXTRAPOLATED,
    OST_REFERENCE_FINEST,   /* the value of the finest mesh, whose own error is not known */
    OST_REFERENCE_SETTLED,  /* refinement changes the value by no more than the solver's tolerance */
    OST_REFERENCE_FORMULA,  /* the value that the case expects */
    OST_REFERENCE_ESTIMATED /* one run's value and what that run estimates to be missing */
} OstReferenceKind;

typedef struct OstCostReference {
    OstReferenceKind kind;
    double value;
    double size; /* errors are relative to this: |value|, or the scale of its kind where the value is negligible */
    double uncertainty; /* relative: how far the reference may be off; infinite where it is not known */
    double rate;        /* observed; 0: none */
    int order;          /* of the elements it comes from; 0: a formula */
    int finest;         /* their highest refinement */
    int run;            /* ESTIMATED: its index */
    char note[OST_COST_NOTE_SIZE];
} OstCostReference;

/* Values by elements of one order, each at its tightest tolerance, from coarse to fine. */
typedef struct OstAnswers {
    int order;
    int count;
    const int *refinement;
    const double *value;
    double noise; /* relative: error that the solver's tolerance may leave */
    double scale;
    int positive; /* can it not be below 0? Then neither can its limit */
} OstAnswers;

/* Local. The factor by which halving the size of the elements reduces an error at best. */
double ost_best_rate_factor(int order);

/* Local. The reference from values of one order. A rate is plausible from 0.4 (singular edges) to 2 × order + 0.5
 * (energy of smooth solutions converges with 2 × order). */
void ost_reference_of(const OstAnswers *answers, OstCostReference *reference);

/* Local. The reference from a formula, whose uncertainty is 0. */
void ost_reference_of_formula(double value, double scale, OstCostReference *reference);

extern const char *const ost_reference_kind_word[]; /* by OstReferenceKind */

/* Local. The reference that one run makes, by its index, from its value and its estimated error; it replaces what is
 * less certain. */
void ost_reference_improve(double value, double error, int run, OstCostReference *reference);

/* Local. Where only one refinement was run, its uncertainty is taken to be its difference from the best value of the
 * order below. */
void ost_reference_compare(OstCostReference *lone, double lower);

#endif
