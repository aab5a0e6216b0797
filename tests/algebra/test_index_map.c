/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/level/index_map.h"
#include "support.h"

static void keys_are_numbered_in_the_order_in_which_they_first_come(void **state)
{
    (void)state;
    OstIndex *index = NULL;
    OstLocal place;
    assert_success(ost_index_create(ctx, &index));
    for (int pass = 0; pass < 2; pass++)
        for (OstGlobal k = 0; k < 10000; k++) {
            assert_success(ost_index_place(index, (k * k) << 20, &place));
            assert_int_equal(place, k);
        }
    assert_int_equal(index->count, 10000);
    assert_int_equal(index->key[9999], (OstGlobal)9999 * 9999 << 20);
    ost_index_destroy(&index);
}

static void sorted_numbers_come_once_and_are_found(void **state)
{
    (void)state;
    OstGlobal number[6] = {(OstGlobal)1 << 40, 7, 3, 7, -1, 3};
    assert_int_equal(ost_numbers_sort(6, number), 4);
    assert_int_equal(number[0], -1);
    assert_int_equal(ost_numbers_find(4, number, 7), 2);
    assert_int_equal(ost_numbers_find(4, number, (OstGlobal)1 << 40), 3);
    assert_int_equal(ost_numbers_sort(0, number), 0);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(keys_are_numbered_in_the_order_in_which_they_first_come),
    cmocka_unit_test(sorted_numbers_come_once_and_are_found),
};

OST_TEST_MAIN(tests)
