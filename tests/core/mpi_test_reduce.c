/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/parallel/free_memory.h"
#include "core/parallel/gather.h"
#include "core/parallel/numbering.h"
#include "core/parallel/reduce.h"
#include "support.h"

static void sums_and_extremes_are_of_all_ranks(void **state)
{
    const int ranks = ost_size(ctx);
    const int rank = ost_rank(ctx);
    double sum[2] = {1.0, rank}, most[2] = {rank, -rank}, least[2] = {rank, -rank};
    OstGlobal numbers[3] = {(OstGlobal)1 << 40, 0, rank};
    int any = rank == ranks - 1;
    assert_success(ost_sum(ctx, 2, sum));
    assert_success(ost_max(ctx, 2, most));
    assert_success(ost_min(ctx, 2, least));
    assert_success(ost_sum_numbers(ctx, 1, &numbers[0]));
    assert_success(ost_min_numbers(ctx, 1, &numbers[1]));
    assert_success(ost_max_numbers(ctx, 1, &numbers[2]));
    assert_success(ost_max_ints(ctx, 1, &any));
    assert_true(sum[0] == ranks && sum[1] == 0.5 * ranks * (ranks - 1));
    assert_true(most[0] == ranks - 1 && most[1] == 0.0);
    assert_true(least[0] == 0.0 && least[1] == 1 - ranks);
    assert_true(numbers[0] == (OstGlobal)ranks << 40 && numbers[1] == 0 && numbers[2] == ranks - 1);
    assert_true(any);
}

static void numbers_go_on_from_rank_to_rank(void **state)
{
    const OstGlobal rank = ost_rank(ctx);
    OstGlobal first = -1, total = -1;
    assert_success(ost_number_from(ctx, rank + 1, &first, &total));
    assert_true(first == rank * (rank + 1) / 2);
    assert_true(total == (OstGlobal)ost_size(ctx) * (ost_size(ctx) + 1) / 2);
}

static void items_are_gathered_in_the_order_of_ranks(void **state)
{
    const int rank = ost_rank(ctx), ranks = ost_size(ctx);
    const double mine[2] = {rank, rank + 0.5};
    const OstLocal count = rank % 3; /* some ranks have none, or one */
    void *all = NULL;
    OstLocal total = -1, at = 0;
    assert_success(ost_gather(ctx, sizeof *mine, mine, count, &all, &total));
    for (int r = 0; r < ranks; r++)
        for (int i = 0; i < r % 3; i++)
            assert_true(((double *)all)[at++] == r + 0.5 * i);
    assert_int_equal(at, total);
    ost_free_memory(all);
}

static void rank_0_tells_the_others(void **state)
{
    double told[3] = {ost_rank(ctx), ost_rank(ctx) + 0.5, ost_rank(ctx)};
    assert_success(ost_broadcast(ctx, 2 * sizeof *told, told));
    assert_true(told[0] == 0.0 && told[1] == 0.5 && told[2] == ost_rank(ctx));
}

static void contexts_are_made_by_a_number_and_on_all(void **state)
{
    OstContext *numbered = NULL, *all = NULL;
    int runs = 0;
    assert_int_equal(ost_context_create_by_number(MPI_Comm_c2f(MPI_COMM_SELF), &numbered), OST_SUCCESS);
    assert_int_equal(ost_context_create_on_all(&all), OST_SUCCESS);
    assert_int_equal(ost_size(numbered), 1);
    assert_int_equal(ost_size(all), ost_size(ctx));
    assert_int_equal(ost_rank(all), ost_rank(ctx));
    ost_context_destroy(&all);
    ost_context_destroy(&numbered);
    ost_end_mpi(); /* which somebody else started */
    assert_int_equal(MPI_Finalized(&runs), MPI_SUCCESS);
    assert_false(runs);
}

static void a_machine_has_more_than_is_free(void **state)
{
    double installed = 0.0, available = 0.0;
    assert_success(ost_memory_installed(ctx, &installed));
    assert_success(ost_memory_free(ctx, &available));
    assert_true(installed > 1e8 && installed < 1e15);
    assert_true(available > 0.0 && available <= installed);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(sums_and_extremes_are_of_all_ranks),       cmocka_unit_test(numbers_go_on_from_rank_to_rank),
    cmocka_unit_test(items_are_gathered_in_the_order_of_ranks), cmocka_unit_test(rank_0_tells_the_others),
    cmocka_unit_test(contexts_are_made_by_a_number_and_on_all), cmocka_unit_test(a_machine_has_more_than_is_free),
};

OST_TEST_MAIN(tests)
