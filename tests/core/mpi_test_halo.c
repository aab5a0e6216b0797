/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/parallel/halo.h"
#include "support.h"

enum { OWNED = 5 };

/* A ring: every rank owns five numbers and copies the last of the rank before and the first of the rank after. */
static OstHalo *make_ring(OstLocal *ghosts)
{
    const int rank = ost_rank(ctx);
    const int size = ost_size(ctx);
    OstGlobal numbers[2];
    *ghosts = 0;
    if (size > 1) {
        const int before = (rank + size - 1) % size;
        const int after = (rank + 1) % size;
        const OstGlobal low = before < after ? before * OWNED + OWNED - 1 : after * OWNED;
        const OstGlobal high = before < after ? after * OWNED : before * OWNED + OWNED - 1;
        numbers[(*ghosts)++] = before == after ? before * OWNED : low;
        numbers[(*ghosts)++] = before == after ? before * OWNED + OWNED - 1 : high;
    }
    OstHalo *halo = NULL;
    assert_success(ost_halo_create(ctx, OWNED, (OstGlobal)rank * OWNED, *ghosts, numbers, &halo));
    return halo;
}

static void ghosts_receive_their_owners_values(void **state)
{
    OstLocal ghosts;
    OstHalo *halo = make_ring(&ghosts);
    double x[2 * (OWNED + 2)] = {0};
    for (int i = 0; i < OWNED; i++) {
        x[2 * i] = ost_rank(ctx) * OWNED + i;
        x[2 * i + 1] = -x[2 * i];
    }
    assert_success(ost_halo_import(halo, 2 * sizeof(double), x));
    double sum = 0.0;
    for (OstLocal g = 0; g < ghosts; g++) {
        sum += x[2 * (OWNED + g)];
        assert_close(x[2 * (OWNED + g) + 1], -x[2 * (OWNED + g)], 0.0);
    }
    if (ghosts > 0) {
        const int size = ost_size(ctx);
        const int before = (ost_rank(ctx) + size - 1) % size;
        const int after = (ost_rank(ctx) + 1) % size;
        assert_close(sum, before * OWNED + OWNED - 1 + after * OWNED, 0.0);
    }
    ost_halo_destroy(&halo);
}

static void sums_return_to_the_owners(void **state)
{
    OstLocal ghosts;
    OstHalo *halo = make_ring(&ghosts);
    double x[OWNED + 2];
    for (int i = 0; i < OWNED + 2; i++)
        x[i] = 1.0;
    assert_success(ost_halo_add_to_owners(halo, 1, x));
    double total = 0.0;
    for (int i = 0; i < OWNED; i++)
        total += x[i];
    assert_close(total, OWNED + (ost_size(ctx) > 1 ? 2.0 : 0.0), 0.0);
    ost_halo_destroy(&halo);
}

static void a_subset_keeps_the_flagged_entries(void **state)
{
    OstLocal ghosts;
    OstHalo *halo = make_ring(&ghosts);
    OstLocal keep[OWNED + 2]; /* all but each rank's first entry */
    double first[OWNED + 2] = {1.0};
    assert_success(ost_halo_import(halo, sizeof(double), first));
    OstLocal n = 0;
    for (OstLocal i = 0; i < OWNED + ghosts; i++)
        keep[i] = first[i] == 1.0 ? -1 : n++;
    OstHalo *subset = NULL;
    assert_success(ost_halo_subset(halo, keep, &subset));
    assert_int_equal(subset->owned, OWNED - 1);
    assert_int_equal(subset->ghosts, ost_size(ctx) > 1 ? 1 : 0);
    double x[OWNED + 1] = {0};
    for (int i = 0; i < OWNED - 1; i++)
        x[i] = ost_rank(ctx) * 10 + i;
    assert_success(ost_halo_import(subset, sizeof(double), x));
    if (ost_size(ctx) > 1)
        assert_close(x[OWNED - 1], (ost_rank(ctx) + ost_size(ctx) - 1) % ost_size(ctx) * 10 + OWNED - 2, 0.0);
    ost_halo_destroy(&subset);
    ost_halo_destroy(&halo);
}

static void one_ranks_failure_is_everybodys(void **state)
{
    const int last = ost_rank(ctx) == ost_size(ctx) - 1;
    const OstStatus mine = last ? OST_RAISE(ctx, OST_INVALID_INPUT, "tet 17 is flat") : OST_SUCCESS;
    assert_failure(ost_agree(ctx, mine), OST_INVALID_INPUT, "tet 17 is flat");
    assert_success(ost_agree(ctx, OST_SUCCESS));
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(ghosts_receive_their_owners_values),
    cmocka_unit_test(sums_return_to_the_owners),
    cmocka_unit_test(a_subset_keeps_the_flagged_entries),
    cmocka_unit_test(one_ranks_failure_is_everybodys),
};

OST_TEST_MAIN(tests)
