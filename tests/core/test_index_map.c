/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/index_map.h"
#include "core/number_set.h"
#include "support.h"

static void keys_are_numbered_in_the_order_in_which_they_first_come(void **state)
{
    OstIndex *index = NULL;
    OstLocal place;
    assert_success(ost_index_create(ctx, 1, &index));
    for (int pass = 0; pass < 2; pass++)
        for (OstGlobal k = 0; k < 10000; k++) {
            const OstGlobal key = (k * k) << 20;
            assert_int_equal(ost_index_find(index, &key), pass == 0 ? -1 : k);
            assert_success(ost_index_place(index, &key, &place));
            assert_int_equal(place, k);
        }
    assert_int_equal(index->count, 10000);
    assert_int_equal(index->key[9999], (OstGlobal)9999 * 9999 << 20);
    ost_index_destroy(&index);
}

static void keys_may_have_several_words(void **state)
{
    OstIndex *index = NULL;
    OstLocal place;
    assert_success(ost_index_create(ctx, 3, &index));
    for (int pass = 0; pass < 2; pass++)
        for (OstGlobal k = 0; k < 1000; k++) {
            const OstGlobal key[3] = {k % 10, k / 10 % 10, k / 100};
            assert_success(ost_index_place(index, key, &place));
            assert_int_equal(place, k);
        }
    assert_int_equal(index->count, 1000);
    assert_int_equal(ost_index_find(index, (OstGlobal[3]){0, 0, 10}), -1);
    assert_int_equal(ost_index_find(index, (OstGlobal[3]){1, 0, 0}), 1);
    ost_index_destroy(&index);
}

static void a_set_keeps_each_number_once(void **state)
{
    OstNumberSet set = {0};
    for (OstGlobal i = 0; i < 100000; i++)
        assert_success(ost_number_set_add(ctx, &set, (i * 7919) % 5003));
    ost_number_set_close(&set);
    assert_int_equal(set.count, 5003);
    assert_true(set.capacity < 20000); /* it does not grow with what it has already */
    for (OstLocal i = 0; i < set.count; i++)
        assert_int_equal(set.number[i], i);
    ost_number_set_clear(&set);
}

static void sorted_numbers_come_once_and_are_found(void **state)
{
    OstGlobal number[6] = {(OstGlobal)1 << 40, 7, 3, 7, -1, 3};
    assert_int_equal(ost_numbers_sort(6, number), 4);
    assert_int_equal(number[0], -1);
    assert_int_equal(ost_numbers_find(4, number, 7), 2);
    assert_int_equal(ost_numbers_find(4, number, (OstGlobal)1 << 40), 3);
    assert_int_equal(ost_numbers_find(4, number, 4), -1);
    assert_int_equal(ost_numbers_below(4, number, 4), 2);
    assert_int_equal(ost_numbers_below(4, number, 7), 2);
    assert_int_equal(ost_numbers_below(4, number, INT64_MAX), 4);
    assert_int_equal(ost_numbers_sort(0, number), 0);
    assert_int_equal(ost_numbers_find(0, NULL, 4), -1);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(keys_are_numbered_in_the_order_in_which_they_first_come),
    cmocka_unit_test(keys_may_have_several_words),
    cmocka_unit_test(a_set_keeps_each_number_once),
    cmocka_unit_test(sorted_numbers_come_once_and_are_found),
};

OST_TEST_MAIN(tests)
