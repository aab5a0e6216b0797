/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/system.h"
#include "support.h"

static void unknowns_fit_in_32_bits(void **state)
{
    assert_success(ost_limit_unknowns(ctx, 715827882)); /* (2^31 - 1) / 3 = 715,827,882.33 */
    assert_failure(ost_limit_unknowns(ctx, 715827883), OST_LIMIT_EXCEEDED, "2147483649 unknowns; Epetra and ML");
}

static void nonzeros_of_a_rank_fit_in_32_bits(void **state)
{
    assert_success(ost_limit_nonzeros(ctx, 238609294)); /* (2^31 - 1) / 9 = 238,609,294.11 */
    assert_failure(ost_limit_nonzeros(ctx, 238609295), OST_LIMIT_EXCEEDED, "use more ranks");
}

static void nodes_of_tets_fit_in_32_bits(void **state)
{
    assert_success(ost_limit_incidences(ctx, 536870911, 4));
    assert_failure(ost_limit_incidences(ctx, 536870912, 4), OST_LIMIT_EXCEEDED, "536870912 tets of 4 nodes");
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(unknowns_fit_in_32_bits),
    cmocka_unit_test(nonzeros_of_a_rank_fit_in_32_bits),
    cmocka_unit_test(nodes_of_tets_fit_in_32_bits),
};

OST_TEST_MAIN(tests)
