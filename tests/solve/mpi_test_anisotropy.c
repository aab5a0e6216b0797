/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/scene_data.h"
#include "support.h"

#include <stdlib.h>

/* The paper's tube of 129,600 tets, and how many iterations it may take on one rank to a true residual of 1e-8: what
 * the project promises, and a fifth more on several ranks. */
typedef struct Bound {
    const char *scene;
    int most;
} Bound;

static OstCase *read_tube(const char *scene)
{
    const char *source = getenv("ORTHOSTAT_SOURCE");
    char path[1024];
    OstCase *c = NULL;
    assert_non_null(source);
    snprintf(path, sizeof path, "%s/cases/tube/%s.yaml", source, scene);
    assert_success(ost_case_read(ctx, path, &c));
    c->solver.algebraic_fraction = 0.0;
    return c;
}

static int iterations(const OstCase *c)
{
    OstScene *scene = NULL;
    OstResult *result = NULL;
    assert_success(ost_scene_create(c, &scene));
    assert_success(ost_scene_solve(scene, &result));
    const int count = result->solve.iterations;
    assert_int_equal(result->solve.method, OST_METHOD_METRIC);
    assert_true(result->solve.relative_residual <= 1e-8);
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    return count;
}

static void a_thousand_times_stiffer_in_any_direction(void **state)
{
    static const Bound bounds[] = {{"isotropic", 16}, {"longitudinal", 20}, {"tangential", 35}, {"radial", 25}};
    for (size_t b = 0; b < sizeof bounds / sizeof *bounds; b++) {
        OstCase *c = read_tube(bounds[b].scene);
        const int count = iterations(c);
        assert_true(count <= (ost_size(ctx) == 1 ? 1.0 : 1.2) * bounds[b].most);
        ost_case_destroy(&c);
    }
}

/* Around costs as much again as the other two together: on one rank it is enough. */
static void a_million_times_stiffer_in_any_direction(void **state)
{
    static const char *const scenes[] = {"longitudinal", "radial", "tangential"};
    for (int s = 0; s < (ost_size(ctx) == 1 ? 3 : 2); s++) {
        OstCase *c = read_tube(scenes[s]);
        double modulus[3];
        for (int k = 0; k < 3; k++) {
            const double given = c->materials[0].material.constants.youngs_modulus[k];
            modulus[k] = given > 1e6 ? 1e12 : given;
        }
        const OstOrthotropic stiffer = ost_orthotropic_family(modulus, 0.3, OST_SHEAR_GEOMETRIC);
        assert_success(ost_material_create(ctx, "stiffer", &stiffer, 0.0, &c->materials[0].material));
        assert_true(iterations(c) <= 60);
        ost_case_destroy(&c);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_thousand_times_stiffer_in_any_direction),
    cmocka_unit_test(a_million_times_stiffer_in_any_direction),
};

OST_TEST_MAIN(tests)
