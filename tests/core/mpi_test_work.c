/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/parallel/halo.h"
#include "core/parallel/numbering.h"
#include "core/parallel/reduce.h"
#include "support.h"

enum { OWNED = 4 };

/* A row of ranks: each owns four numbers, and copies the last one of the rank before and the first one of the rank
 * after. */
static OstHalo *make_row(OstLocal *ghosts)
{
    const int rank = ost_rank(ctx);
    OstGlobal number[2];
    OstHalo *halo = NULL;
    *ghosts = 0;
    if (rank > 0)
        number[(*ghosts)++] = (OstGlobal)OWNED * rank - 1;
    if (rank + 1 < ost_size(ctx))
        number[(*ghosts)++] = (OstGlobal)OWNED * (rank + 1);
    assert_success(ost_halo_create(ctx, OWNED, (OstGlobal)OWNED * rank, *ghosts, number, &halo));
    return halo;
}

static void an_exchange_is_a_message_to_each_neighbour(void **state)
{
    OstLocal ghosts;
    OstHalo *halo = make_row(&ghosts);
    double x[3 * (OWNED + 2)] = {0};
    ost_ledger_forget_work(ctx);
    assert_success(ost_halo_import(halo, 3 * sizeof *x, x));
    assert_success(ost_halo_add_to_owners(halo, 1, x));
    const OstWork work = ost_ledger_entry(ctx, OST_LEDGER_OTHER).work;
    assert_close(work.exchanges, ghosts > 0 ? 2.0 : 0.0, 0.0); /* one rank has nobody to send to */
    assert_close(work.messages, 2.0 * ghosts, 0.0);
    assert_close(work.bytes, (3.0 + 1.0) * sizeof *x * ghosts, 0.0); /* one entry to each neighbour, each way */
    ost_halo_destroy(&halo);
}

static void sums_and_lists_over_all_ranks_are_counted(void **state)
{
    OstGlobal end[64], first, total;
    double sums[2] = {1.0, 2.0};
    ost_ledger_forget_work(ctx);
    assert_success(ost_sum(ctx, 2, sums)); /* one reduction, whatever its length */
    assert_success(ost_number_from(ctx, 3, &first, &total));
    assert_success(ost_number_ends(ctx, first + 3, end));
    const OstWork work = ost_ledger_entry(ctx, OST_LEDGER_OTHER).work;
    assert_close(work.reductions, 2.0, 0.0);
    assert_close(work.gathers, 1.0, 0.0);
    assert_close(work.gathered, 8.0 * ost_size(ctx), 0.0);
}

static void work_is_booked_to_account_and_level(void **state)
{
    ost_ledger_forget_work(ctx);
    ost_ledger_enter(ctx, OST_LEDGER_SOLVE);
    ost_ledger_multiplied(ctx, 5.0);
    ost_ledger_level(ctx, 2);
    ost_ledger_multiplied(ctx, 7.0);
    ost_ledger_visited(ctx);
    ost_ledger_level(ctx, -1);
    ost_ledger_leave(ctx);
    ost_ledger_multiplied(ctx, 11.0);
    assert_close(ost_ledger_entry(ctx, OST_LEDGER_SOLVE).work.multiplied, 12.0, 0.0);
    assert_close(ost_ledger_entry(ctx, OST_LEDGER_OTHER).work.multiplied, 11.0, 0.0);
    assert_close(ost_ledger_level_work(ctx, 2).multiplied, 7.0, 0.0);
    assert_close(ost_ledger_level_work(ctx, 2).visits, 1.0, 0.0);
    assert_close(ost_ledger_level_work(ctx, 0).multiplied, 0.0, 0.0);
    ost_ledger_forget_work(ctx);
    assert_close(ost_ledger_entry(ctx, OST_LEDGER_SOLVE).work.multiplied, 0.0, 0.0);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(an_exchange_is_a_message_to_each_neighbour),
    cmocka_unit_test(sums_and_lists_over_all_ranks_are_counted),
    cmocka_unit_test(work_is_booked_to_account_and_level),
};

OST_TEST_MAIN(tests)
