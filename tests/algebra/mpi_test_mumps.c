/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "elastic_block.h"

#include "algebra/direct/mumps.h"

#include <float.h>

/* Ones on the diagonal, and one pair of unknowns that are coupled by this much. */
static ElasticProblem coupled(double coupling)
{
    ElasticProblem problem = diagonal_bar((const double[3]){1.0, 1.0, 1.0});
    if (problem.matrix->first_row == 0 && problem.matrix->rows > 0) {
        double *block = problem.matrix->value + 9 * (size_t)problem.matrix->diagonal[0];
        block[1] = block[3] = coupling;
    }
    return problem;
}

/* The shift that factors of it take. */
static double shift_of(double coupling)
{
    ElasticProblem problem = coupled(coupling);
    OstMumps *factors = NULL;
    double shift = NAN;
    assert_success(ost_mumps_create_of_rows(problem.matrix, NULL, 0.0, &shift, &factors));
    ost_mumps_destroy(&factors);
    elastic_destroy(&problem);
    return shift;
}

static void what_is_definite_is_factored_as_it_is(void **state)
{
    assert_true(shift_of(0.0) == 0.0);
    assert_true(shift_of(1.0 - 1e-13) == 0.0);
}

static void what_rounding_made_singular_or_indefinite_is_shifted_by_little(void **state)
{
    const double beyond[] = {0.0, DBL_EPSILON, 1e-14, 1e-13};
    for (int k = 0; k < 4; k++) {
        const double shift = shift_of(1.0 + beyond[k]);
        assert_true(shift > beyond[k] && shift <= 10.0 * fmax(beyond[k], DBL_EPSILON));
    }
}

/* The factors are of the shifted matrix: (1 + s) u0 - u1 = 1, (1 + s) u1 - u0 = 1. */
static void the_factors_are_those_of_the_shifted_matrix(void **state)
{
    ElasticProblem problem = coupled(-1.0);
    OstMumps *factors = NULL;
    double shift, *u = NULL;
    assert_success(OST_NEW(ctx, &u, 3 * (size_t)problem.matrix->rows + 1));
    assert_success(ost_mumps_create_of_rows(problem.matrix, NULL, 0.0, &shift, &factors));
    assert_success(ost_mumps_solve(factors, problem.force, u));
    for (OstLocal i = 0; i < 3 * problem.matrix->rows; i++) {
        const int paired = problem.matrix->first_row == 0 && i < 2;
        assert_close(u[i], paired ? 1.0 / shift : 1.0, paired ? 1e-3 / shift : 1e-14);
    }
    ost_mumps_destroy(&factors);
    OST_FREE(u);
    elastic_destroy(&problem);
}

static void nothing_is_shifted_unasked(void **state)
{
    ElasticProblem problem = coupled(1.0 + DBL_EPSILON);
    OstMumps *factors = NULL;
    assert_failure(ost_mumps_create_of_rows(problem.matrix, NULL, 0.0, NULL, &factors), OST_NOT_CONVERGED,
                   "rounding leaves the displacement less than one digit");
    elastic_destroy(&problem);
}

static void what_no_rounding_explains_is_refused(void **state)
{
    const double beyond[] = {1e-11, 1.0};
    for (int k = 0; k < 2; k++) {
        ElasticProblem problem = coupled(1.0 + beyond[k]);
        OstMumps *factors = NULL;
        double shift;
        assert_failure(ost_mumps_create_of_rows(problem.matrix, NULL, 0.0, &shift, &factors), OST_NOT_CONVERGED,
                       "not positive definite");
        assert_null(factors);
        elastic_destroy(&problem);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(what_is_definite_is_factored_as_it_is),
    cmocka_unit_test(what_rounding_made_singular_or_indefinite_is_shifted_by_little),
    cmocka_unit_test(the_factors_are_those_of_the_shifted_matrix),
    cmocka_unit_test(nothing_is_shifted_unasked),
    cmocka_unit_test(what_no_rounding_explains_is_refused),
};

OST_TEST_MAIN(tests)
