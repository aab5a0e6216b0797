/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/small.h"
#include "element/biot.h"
#include "element/large_rotation.h"
#include "element_support.h"

enum { MOST_NODES = 10, WIDTH = 3 * MOST_NODES, KINDS = 4 };

static const int ends[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}; /* orthostat/mesh.h */

/* What the tets are: how many nodes, how far the middles of edges are off, is C split? */
typedef struct Kind {
    int nodes;
    double bend;
    int by_mean;
} Kind;
static const Kind kinds[KINDS] = {{4, 0.0, 0}, {10, 0.0, 0}, {10, 0.05, 0}, {10, 0.05, 1}};

/* Principal stretches of the mean F of each of a batch's tets. */
static const double moderate[4][3] = {{1.1, 0.95, 1.2}, {0.7, 1.0, 1.4}, {1.0, 1.02, 0.99}, {0.6, 0.7, 0.5}};
static const double inverted[4][3] = {{1.1, 1.4, -0.4}, {0.9, 1.2, -0.2}, {2.0, 1.1, -0.6}, {1.3, 0.8, -0.3}};
static const double flat[4][3] = {{1.1, 1.3, 1e-7}, {1.2, 0.9, -1e-7}, {1.6, 1.0, 1e-3}, {1.3, 0.8, 0.0}};

/* A batch of tets, each of its own shape. */
typedef struct Case {
    const OstElement *element;
    int width;
    double c[36];
    OstSimd x[WIDTH];
    OstSimd u[WIDTH];
    OstElasticity elasticity;
} Case;

static void set_elasticity(const double c[36], int by_mean, OstElasticity *elasticity)
{
    static const double mode[6] = {300.0, 280.0, 320.0, 10.0, -20.0, 15.0}; /* m m' about as stiff as C */
    uniform_elasticity(c, elasticity);
    elasticity->by_mean = by_mean;
    for (int p = 0; p < 6; p++)
        elasticity->m[0][p] = mode[p] + (OstSimd){0};
}

/* Nodes go to F x, and to random places up to `scatter` off. */
static void make_case(const Kind *kind, const double stretches[4][3], double scatter, Case *test)
{
    unsigned seed = 5u;
    test->element = ost_element_of(kind->nodes);
    test->width = 3 * kind->nodes;
    turned_ply(test->c);
    set_elasticity(test->c, kind->by_mean, &test->elasticity);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        double x[WIDTH], f[9], to[3];
        random_tet((unsigned)slot + 1u, x);
        for (int e = 0; e < 6; e++)
            for (int i = 0; i < 3; i++)
                x[12 + 3 * e + i] =
                    0.5 * (x[3 * ends[e][0] + i] + x[3 * ends[e][1] + i]) + kind->bend * random_number(&seed);
        deformation((unsigned)slot + 12u, stretches[slot % 4], f);
        for (int n = 0; n < test->width; n++) {
            ost_apply3(f, x + n - n % 3, to);
            test->x[n][slot] = x[n];
            test->u[n][slot] = to[n % 3] - x[n] + scatter * random_number(&seed);
        }
    }
}

static void energy_of(const Case *test, OstFormulation formulation, OstSimd *energy)
{
    ost_large_rotation_energy(test->element, formulation, test->x, &test->elasticity, test->u, energy);
}

static void force_of(const Case *test, OstFormulation formulation, OstSimd *force)
{
    ost_large_rotation_force(test->element, formulation, test->x, &test->elasticity, test->u, NULL, force);
}

static void stiffness_of(const Case *test, OstFormulation formulation, int definite, int slot, double *k)
{
    OstSimd blocks[9 * MOST_NODES * (MOST_NODES + 1) / 2];
    ost_large_rotation_stiffness(test->element, formulation, test->x, &test->elasticity, test->u, NULL, definite,
                                 blocks);
    full_matrix(test->element->nodes, blocks, slot, k);
}

static double largest_in(int count, const OstSimd *numbers, int slot)
{
    double size = 0.0;
    for (int n = 0; n < count; n++)
        size = fmax(size, fabs(numbers[n][slot]));
    return size;
}

/* Energy and forces at u and four points on either side of it: differences of fourth order. */
static void assert_derivatives(const Case *given)
{
    static const double weight[5] = {1.0 / 12.0, -8.0 / 12.0, 0.0, 8.0 / 12.0, -1.0 / 12.0};
    const double step = 1e-4;
    Case test = *given;
    OstSimd force[WIDTH];
    double k[OST_SIMD_WIDTH][WIDTH * WIDTH];
    force_of(&test, OST_FORMULATION_CONSISTENT, force);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
        stiffness_of(&test, OST_FORMULATION_CONSISTENT, 0, slot, k[slot]);
    for (int n = 0; n < test.width; n++) {
        const OstSimd kept = test.u[n];
        OstSimd slope = {0};
        OstSimd column[WIDTH] = {{0}};
        for (int s = 0; s < 5; s++) {
            OstSimd energy;
            OstSimd beside[WIDTH];
            test.u[n] = kept + step * (s - 2);
            energy_of(&test, OST_FORMULATION_CONSISTENT, &energy);
            force_of(&test, OST_FORMULATION_CONSISTENT, beside);
            slope += weight[s] / step * energy;
            for (int i = 0; i < test.width; i++)
                column[i] += weight[s] / step * beside[i];
        }
        test.u[n] = kept;
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            const double size = largest_in(test.width, force, slot);
            const double stiff = largest_of(test.width * test.width, k[slot]);
            assert_true(size > 0.0);
            assert_close(slope[slot] / size, force[n][slot] / size, 1e-6);
            for (int i = 0; i < test.width; i++)
                assert_close(column[i][slot] / stiff, k[slot][test.width * i + n] / stiff, 1e-6);
        }
    }
}

static void force_and_stiffness_are_derivatives_of_the_energy(void **state)
{
    for (int kind = 0; kind < KINDS; kind++) {
        Case test;
        make_case(&kinds[kind], moderate, 0.02, &test);
        assert_derivatives(&test);
        make_case(&kinds[kind], inverted, 0.01, &test);
        assert_derivatives(&test);
        make_case(&kinds[kind], flat, 0.0, &test);
        assert_derivatives(&test);
    }
}

/* Of the classical form too, moments only where the material is isotropic. */
static void forces_balance(void **state)
{
    for (int kind = 0; kind < KINDS; kind++) {
        Case test;
        OstSimd force[WIDTH];
        make_case(&kinds[kind], kind % 2 ? moderate : inverted, 0.03, &test);
        force_of(&test, OST_FORMULATION_CONSISTENT, force);
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            double sum[6] = {0.0};
            const double size = largest_in(test.width, force, slot);
            for (int a = 0; a < test.element->nodes; a++)
                for (int i = 0; i < 3; i++) {
                    const int j = (i + 1) % 3, k = (i + 2) % 3;
                    sum[i] += force[3 * a + i][slot];
                    sum[3 + i] += (test.x[3 * a + j][slot] + test.u[3 * a + j][slot]) * force[3 * a + k][slot] -
                                  (test.x[3 * a + k][slot] + test.u[3 * a + k][slot]) * force[3 * a + j][slot];
                }
            for (int i = 0; i < 6; i++)
                assert_close(sum[i] / size, 0.0, 1e-12);
        }
    }
}

static void isotropic(double nu, double c[36])
{
    OstMaterial material;
    const OstOrthotropic constants = {.youngs_modulus = {7.0, 7.0, 7.0},
                                      .poissons_ratio = {nu, nu, nu},
                                      .shear_modulus = {3.5 / (1.0 + nu), 3.5 / (1.0 + nu), 3.5 / (1.0 + nu)}};
    assert_success(ost_material_create(ctx, "rubber", &constants, 1.0, &material));
    memcpy(c, material.stiffness, 36 * sizeof *c);
}

/* Rotates all tets by an angle about an oblique axis, from where they are. */
static void rotate_case(double angle, Case *test)
{
    double axes[9], turn[9], about[9];
    const double q[9] = {cos(angle), -sin(angle), 0.0, sin(angle), cos(angle), 0.0, 0.0, 0.0, 1.0};
    random_axes(3u, axes);
    ost_multiply3(q, axes, about);
    ost_multiply3_transposed_left(axes, about, turn);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
        for (int a = 0; a < test->element->nodes; a++) {
            double place[3], to[3];
            for (int i = 0; i < 3; i++)
                place[i] = test->x[3 * a + i][slot] + test->u[3 * a + i][slot];
            ost_apply3(turn, place, to);
            for (int i = 0; i < 3; i++)
                test->u[3 * a + i][slot] = to[i] - test->x[3 * a + i][slot];
        }
}

static void a_rigid_rotation_costs_nothing(void **state)
{
    static const double angles[] = {1e-6, 0.3, 1.5707963267948966, 2.5, 3.141592653589793};
    for (int kind = 0; kind < KINDS; kind++)
        for (size_t n = 0; n < sizeof angles / sizeof angles[0]; n++)
            for (int f = OST_FORMULATION_CONSISTENT; f <= OST_FORMULATION_CLASSICAL; f++) {
                Case test;
                OstSimd energy, force[WIDTH];
                make_case(&kinds[kind], moderate, 0.0, &test);
                memset(test.u, 0, sizeof test.u);
                rotate_case(angles[n], &test);
                energy_of(&test, (OstFormulation)f, &energy);
                force_of(&test, (OstFormulation)f, force);
                for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
                    assert_true(energy[slot] < 1e-24 * test.c[0]);
                    assert_true(largest_in(test.width, force, slot) < 1e-12 * test.c[0]);
                }
            }
}

/* The linear force up to second order, and without cancellation where u is tiny. */
/* Largest of K (w × x) over the size of K, x the places at u, w a rotation, with the stress linear between `from` and
 * u.
 */
static double resistance_to_turning(const Case *test, const OstSimd *from, int slot)
{
    OstSimd blocks[9 * MOST_NODES * (MOST_NODES + 1) / 2];
    double k[WIDTH * WIDTH], most = 0.0;
    const OstLastStep last = {from, test->u};
    ost_large_rotation_stiffness(test->element, OST_FORMULATION_CONSISTENT, test->x, &test->elasticity, test->u,
                                 from ? &last : NULL, 0, blocks);
    full_matrix(test->element->nodes, blocks, slot, k);
    for (int i = 0; i < test->width; i++) {
        double sum = 0.0;
        for (int n = 0; n < test->width; n += 3) {
            const double x = test->x[n][slot] + test->u[n][slot], y = test->x[n + 1][slot] + test->u[n + 1][slot];
            sum += k[test->width * i + n + 1] * x - k[test->width * i + n] * y; /* about z */
        }
        most = fmax(most, fabs(sum));
    }
    return most / largest_of(test->width * test->width, k);
}

/* Turned by a displacement that is linear in the angle, tets are stretched. By the stress that is linear between the
 * two shapes they are not, and do not resist being turned on. */
static void the_linear_stress_knows_no_stretch_by_rotation(void **state)
{
    for (int kind = 0; kind < KINDS; kind++) {
        Case test;
        OstSimd none[WIDTH] = {{0}};
        make_case(&kinds[kind], moderate, 0.0, &test);
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            for (int n = 0; n < test.width; n += 3) {
                test.u[n][slot] = -0.4 * test.x[n + 1][slot];
                test.u[n + 1][slot] = 0.4 * test.x[n][slot];
                test.u[n + 2][slot] = 0.0;
            }
        }
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            assert_true(resistance_to_turning(&test, NULL, slot) > 1e-3);
            assert_true(resistance_to_turning(&test, none, slot) < 1e-13);
            const double same = resistance_to_turning(&test, test.u, slot),
                         at_u = resistance_to_turning(&test, NULL, slot);
            assert_close(same / at_u, 1.0, 1e-12);
        }
    }
}

static void small_displacements_give_the_linear_force(void **state)
{
    for (int kind = 0; kind < KINDS; kind++) {
        Case test;
        OstSimd u[WIDTH], linear[WIDTH], force[WIDTH];
        double error[2][OST_SIMD_WIDTH] = {{0.0}};
        unsigned seed = 2u;
        make_case(&kinds[kind], moderate, 0.0, &test);
        for (int n = 0; n < test.width; n++)
            for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
                u[n][slot] = random_number(&seed);
        test.element->force(test.x, &test.elasticity, u, linear);
        for (int n = 0; n < test.width; n++)
            test.u[n] = 1e-9 * u[n];
        force_of(&test, OST_FORMULATION_CONSISTENT, force);
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
            for (int n = 0; n < test.width; n++)
                assert_close(1e9 * force[n][slot] / largest_in(test.width, linear, slot),
                             linear[n][slot] / largest_in(test.width, linear, slot), 5e-8);
        for (int f = OST_FORMULATION_CONSISTENT; f <= OST_FORMULATION_CLASSICAL; f++) {
            for (int s = 0; s < 2; s++) {
                const double scale = s == 0 ? 1e-4 : 1e-5;
                for (int n = 0; n < test.width; n++)
                    test.u[n] = scale * u[n];
                force_of(&test, (OstFormulation)f, force);
                for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
                    error[s][slot] = 0.0;
                    for (int n = 0; n < test.width; n++)
                        error[s][slot] = fmax(error[s][slot], fabs(force[n][slot] - scale * linear[n][slot]));
                }
            }
            for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
                assert_close(error[0][slot] / error[1][slot], 100.0, 1.0);
        }
    }
}

static void assert_no_negative_eigenvalue(int n, const double *k, double tolerance)
{
    double value[12];
    assert_true(n <= 12);
    assert_success(ost_symmetric_eigen(ctx, n, k, value, NULL));
    assert_true(value[0] >= -tolerance * value[n - 1]);
}

/* The second derivative at a point: 9 × 9 of each tet. */
static void hessian_of(const Case *test, int definite, double h[OST_SIMD_WIDTH][81])
{
    OstSimd slope[9] = {{0}}, strain[6], stress[6] = {{0}}, hessian[81];
    OstPolar polar;
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        double x[12], u[12], gradient[9];
        for (int n = 0; n < 12; n++) {
            x[n] = test->x[n][slot];
            u[n] = test->u[n][slot];
        }
        test->element->gradient(x, u, gradient);
        for (int n = 0; n < 9; n++)
            slope[n][slot] = gradient[n];
    }
    ost_polar(slope, &polar);
    ost_biot_strain(&polar, strain);
    for (int p = 0; p < 6; p++)
        for (int q = 0; q < 6; q++)
            stress[p] += test->c[6 * p + q] * strain[q];
    ost_biot_hessian(&polar, test->elasticity.c[0], stress, definite, hessian);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
        for (int n = 0; n < 81; n++)
            h[slot][n] = hessian[n][slot];
}

/* The definite one has no negative eigenvalue, has the other eigenvalues of the exact one, and is the exact one where
 * that has none. */
static void a_definite_stiffness_is_changed_only_where_it_must_be(void **state)
{
    static const double pulled[4][3] = {{1.1, 1.2, 1.3}, {1.01, 1.02, 1.03}, {1.5, 1.4, 1.6}, {1.0, 1.0, 1.0}};
    const double(*stretches[4])[3] = {moderate, inverted, flat, pulled};
    int changed = 0, kept = 0;
    for (int s = 0; s < 4; s++)
        for (int soft = 0; soft < 2; soft++) {
            Case test;
            double exact[OST_SIMD_WIDTH][81], definite[OST_SIMD_WIDTH][81];
            make_case(&kinds[0], stretches[s], 0.0, &test);
            if (soft) {
                isotropic(0.3, test.c);
                set_elasticity(test.c, 0, &test.elasticity);
            }
            hessian_of(&test, 0, exact);
            hessian_of(&test, 1, definite);
            for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
                double before[9], after[9];
                const double size = largest_of(81, exact[slot]);
                assert_success(ost_symmetric_eigen(ctx, 9, exact[slot], before, NULL));
                assert_success(ost_symmetric_eigen(ctx, 9, definite[slot], after, NULL));
                for (int n = 0; n < 9; n++)
                    assert_close(after[n] / size, fmax(before[n], 0.0) / size, 1e-12);
                for (int n = 0; n < 81 && before[0] > -1e-14 * size; n++)
                    assert_close(definite[slot][n] / size, exact[slot][n] / size, 1e-12);
                changed += before[0] < -1e-9 * size;
                kept += before[0] > -1e-14 * size;
            }
        }
    assert_true(changed >= 10 && kept >= 4);
}

static void a_definite_tet_has_no_negative_eigenvalue(void **state)
{
    Case test;
    double k[144];
    make_case(&kinds[0], inverted, 0.02, &test);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        double value[12];
        stiffness_of(&test, OST_FORMULATION_CONSISTENT, 0, slot, k);
        assert_success(ost_symmetric_eigen(ctx, 12, k, value, NULL));
        assert_true(value[0] < -1e-3 * value[11]);
        stiffness_of(&test, OST_FORMULATION_CONSISTENT, 1, slot, k);
        assert_no_negative_eigenvalue(12, k, 1e-13);
        stiffness_of(&test, OST_FORMULATION_CLASSICAL, 0, slot, k);
        assert_no_negative_eigenvalue(12, k, 1e-13);
    }
}

static void an_isotropic_linear_tet_has_the_classical_force(void **state)
{
    for (int s = 0; s < 2; s++) {
        Case test;
        OstSimd consistent[WIDTH], classical[WIDTH], energy[2];
        make_case(&kinds[0], s ? inverted : moderate, 0.02, &test);
        isotropic(0.4, test.c);
        set_elasticity(test.c, 0, &test.elasticity);
        force_of(&test, OST_FORMULATION_CONSISTENT, consistent);
        force_of(&test, OST_FORMULATION_CLASSICAL, classical);
        energy_of(&test, OST_FORMULATION_CONSISTENT, &energy[0]);
        energy_of(&test, OST_FORMULATION_CLASSICAL, &energy[1]);
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            assert_close(energy[0][slot] / energy[1][slot], 1.0, 1e-12);
            for (int n = 0; n < 12; n++)
                assert_close(consistent[n][slot], classical[n][slot], 1e-12 * largest_in(12, classical, slot));
        }
    }
}

/* In an orthotropic material the classical forces have a moment: that is why the consistent form is the default. */
static void classical_forces_of_an_orthotropic_tet_have_a_moment(void **state)
{
    Case test;
    OstSimd force[WIDTH];
    make_case(&kinds[0], moderate, 0.0, &test);
    force_of(&test, OST_FORMULATION_CLASSICAL, force);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        double moment[3] = {0.0}, net[3] = {0.0};
        for (int n = 0; n < 12; n++) {
            const int i = n % 3, j = n - i + (i + 1) % 3, k = n - i + (i + 2) % 3;
            net[i] += force[n][slot];
            moment[i] += (test.x[j][slot] + test.u[j][slot]) * force[k][slot] -
                         (test.x[k][slot] + test.u[k][slot]) * force[j][slot];
        }
        assert_close(ost_norm3(net) / largest_in(12, force, slot), 0.0, 1e-12);
        assert_true(slot % 4 == 2 || ost_norm3(moment) > 1e-3 * largest_in(12, force, slot));
    }
}

/* R K R' with the R of a known rotation. */
static void the_classical_stiffness_is_the_turned_linear_one(void **state)
{
    for (int kind = 0; kind < KINDS; kind++) {
        Case test;
        OstSimd blocks[9 * MOST_NODES * (MOST_NODES + 1) / 2];
        double linear[WIDTH * WIDTH], turned[WIDTH * WIDTH];
        static const double none[4][3] = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
        make_case(&kinds[kind], none, 0.0, &test);
        test.element->stiffness(test.x, &test.elasticity, blocks);
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            double r[9];
            deformation((unsigned)slot + 12u, none[slot % 4], r);
            full_matrix(test.element->nodes, blocks, slot, linear);
            stiffness_of(&test, OST_FORMULATION_CLASSICAL, 0, slot, turned);
            const double size = largest_of(test.width * test.width, linear);
            for (int i = 0; i < test.width; i++)
                for (int j = 0; j < test.width; j++) {
                    double expected = 0.0;
                    for (int k = 0; k < 9; k++)
                        expected += r[3 * (i % 3) + k / 3] * r[3 * (j % 3) + k % 3] *
                                    linear[test.width * (i - i % 3 + k / 3) + j - j % 3 + k % 3];
                    assert_close(turned[test.width * i + j] / size, expected / size, 1e-12);
                }
        }
    }
}

/* A rotation of what is deformed turns the forces and leaves the energy. */
static void energy_and_forces_are_objective(void **state)
{
    for (int kind = 0; kind < KINDS; kind++)
        for (int f = OST_FORMULATION_CONSISTENT; f <= OST_FORMULATION_CLASSICAL; f++) {
            Case test;
            OstSimd energy[2], force[2][WIDTH];
            make_case(&kinds[kind], kind % 2 ? inverted : moderate, 0.02, &test);
            for (int turned = 0; turned < 2; turned++) {
                energy_of(&test, (OstFormulation)f, &energy[turned]);
                force_of(&test, (OstFormulation)f, force[turned]);
                if (!turned)
                    rotate_case(2.2, &test);
            }
            for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
                const double size = largest_in(test.width, force[0], slot);
                assert_close(energy[1][slot] / energy[0][slot], 1.0, 1e-12);
                for (int a = 0; a < test.element->nodes; a++) {
                    double before = 0.0, after = 0.0;
                    for (int i = 0; i < 3; i++) {
                        before += force[0][3 * a + i][slot] * force[0][i][slot];
                        after += force[1][3 * a + i][slot] * force[1][i][slot];
                    }
                    assert_close(before / (size * size), after / (size * size), 1e-12);
                }
            }
        }
}

/* Other orders of a linear tet's nodes give the same numbers in that order. */
static void the_order_of_nodes_does_not_matter(void **state)
{
    static const int order[4] = {2, 0, 3, 1}; /* odd: the tet's orientation changes */
    Case test, turned;
    OstSimd force[2][WIDTH];
    make_case(&kinds[0], moderate, 0.03, &test);
    turned = test;
    for (int n = 0; n < 12; n++) {
        turned.x[n] = test.x[3 * order[n / 3] + n % 3];
        turned.u[n] = test.u[3 * order[n / 3] + n % 3];
    }
    force_of(&test, OST_FORMULATION_CONSISTENT, force[0]);
    force_of(&turned, OST_FORMULATION_CONSISTENT, force[1]);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
        for (int n = 0; n < 12; n++)
            assert_close(force[1][n][slot], force[0][3 * order[n / 3] + n % 3][slot],
                         1e-12 * largest_in(12, force[0], slot));
}

/* Where strain is uniform, the stiff mode's mean is its value. */
static void the_mean_of_a_uniform_strain_is_that_strain(void **state)
{
    Case test;
    OstSimd split[WIDTH], whole[WIDTH];
    make_case(&kinds[3], moderate, 0.0, &test);
    force_of(&test, OST_FORMULATION_CONSISTENT, split);
    for (int p = 0, n = 0; p < 6; p++)
        for (int q = p; q < 6; q++, n++)
            test.elasticity.c[0][n] += test.elasticity.m[0][p] * test.elasticity.m[0][q];
    test.elasticity.by_mean = 0;
    force_of(&test, OST_FORMULATION_CONSISTENT, whole);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
        for (int n = 0; n < WIDTH; n++)
            assert_close(split[n][slot], whole[n][slot], 1e-12 * largest_in(WIDTH, whole, slot));
}

static void the_force_is_continuous_through_inversion(void **state)
{
    static const double before[4][3] = {{1.1, 1.3, 1e-8}, {1.2, 0.9, 1e-9}, {1.6, 1.0, 1e-8}, {1.3, 0.8, 1e-9}};
    double after[4][3];
    memcpy(after, before, sizeof after);
    for (int slot = 0; slot < 4; slot++)
        after[slot][2] = -before[slot][2];
    for (int kind = 0; kind < KINDS; kind++) {
        Case test;
        OstSimd force[2][WIDTH], least;
        for (int side = 0; side < 2; side++) {
            make_case(&kinds[kind], side ? after : before, 0.0, &test);
            force_of(&test, OST_FORMULATION_CONSISTENT, force[side]);
            ost_large_rotation_least_stretch(test.element, test.x, &test.elasticity, test.u, &least);
            for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
                assert_close(least[slot], (side ? after : before)[slot % 4][2], 1e-14);
        }
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
            for (int n = 0; n < test.width; n++)
                assert_close(force[0][n][slot], force[1][n][slot], 1e-6 * largest_in(test.width, force[0], slot));
    }
}

/* Means and strains at points of a uniform deformation: U - I, and C times it. */
static void means_are_of_the_strain_u_minus_i(void **state)
{
    static const OstQuadraturePoint corner = {{0.1, 0.2, 0.3, 0.4}, 1.0};
    for (int kind = 0; kind < 3; kind++) {
        Case test;
        OstMeans means;
        OstSimd strain[6], energy;
        make_case(&kinds[kind], moderate, 0.0, &test);
        ost_large_rotation_means(test.element, OST_FORMULATION_CONSISTENT, test.x, &test.elasticity, test.u, &means);
        ost_large_rotation_strains(test.element, test.x, test.u, 1, &corner, strain);
        energy_of(&test, OST_FORMULATION_CONSISTENT, &energy);
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            double before[9], density = 0.0;
            random_axes((unsigned)slot + 12u, before);
            for (int p = 0; p < 6; p++) {
                const int i = p % 3, j = p < 3 ? i : (i + 1) % 3;
                double expected = 0.0, stress = 0.0;
                for (int k = 0; k < 3; k++)
                    expected +=
                        (p < 3 ? 1.0 : 2.0) * (moderate[slot % 4][k] - 1.0) * before[3 * k + i] * before[3 * k + j];
                assert_close(means.strain[p][slot], expected, 1e-13);
                assert_close(strain[p][slot], expected, 1e-13);
                for (int q = 0; q < 6; q++)
                    stress += test.c[6 * p + q] * means.strain[q][slot];
                assert_close(means.stress[p][slot], stress, 1e-9);
                density += 0.5 * stress * means.strain[p][slot];
            }
            assert_close(means.energy[slot] / density, 1.0, 1e-12);
            assert_close(means.energy[slot] * means.volume[slot] / energy[slot], 1.0, 1e-12);
        }
    }
}

static void derivatives_hold_with_an_eigenstrain(void **state)
{
    for (int kind = 0; kind < KINDS; kind++) {
        Case test;
        make_case(&kinds[kind], moderate, 0.02, &test);
        swell_elasticity(&test.elasticity);
        assert_derivatives(&test);
    }
}

/* Swollen freely by e0 and turned: x -> Q (I + e0) x, in both forms. */
static void free_swelling_costs_nothing(void **state)
{
    for (int kind = 0; kind < KINDS; kind++)
        for (int f = OST_FORMULATION_CONSISTENT; f <= OST_FORMULATION_CLASSICAL; f++) {
            Case test;
            OstSimd energy, force[WIDTH];
            OstMeans means;
            make_case(&kinds[kind], moderate, 0.0, &test);
            swell_elasticity(&test.elasticity);
            swell_freely(test.element->nodes, test.x, &test.elasticity, test.u);
            rotate_case(1.2, &test);
            energy_of(&test, (OstFormulation)f, &energy);
            force_of(&test, (OstFormulation)f, force);
            ost_large_rotation_means(test.element, (OstFormulation)f, test.x, &test.elasticity, test.u, &means);
            for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
                assert_true(energy[slot] < 1e-24 * test.c[0]);
                assert_true(largest_in(test.width, force, slot) < 1e-12 * test.c[0]);
                for (int p = 0; p < 6; p++)
                    assert_close(means.strain[p][slot], test.elasticity.e0[0][p][slot], 1e-13);
            }
        }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(derivatives_hold_with_an_eigenstrain),
    cmocka_unit_test(free_swelling_costs_nothing),
    cmocka_unit_test(force_and_stiffness_are_derivatives_of_the_energy),
    cmocka_unit_test(forces_balance),
    cmocka_unit_test(a_rigid_rotation_costs_nothing),
    cmocka_unit_test(the_linear_stress_knows_no_stretch_by_rotation),
    cmocka_unit_test(small_displacements_give_the_linear_force),
    cmocka_unit_test(a_definite_stiffness_is_changed_only_where_it_must_be),
    cmocka_unit_test(a_definite_tet_has_no_negative_eigenvalue),
    cmocka_unit_test(an_isotropic_linear_tet_has_the_classical_force),
    cmocka_unit_test(classical_forces_of_an_orthotropic_tet_have_a_moment),
    cmocka_unit_test(the_classical_stiffness_is_the_turned_linear_one),
    cmocka_unit_test(energy_and_forces_are_objective),
    cmocka_unit_test(the_order_of_nodes_does_not_matter),
    cmocka_unit_test(the_mean_of_a_uniform_strain_is_that_strain),
    cmocka_unit_test(the_force_is_continuous_through_inversion),
    cmocka_unit_test(means_are_of_the_strain_u_minus_i),
};

OST_TEST_MAIN(tests)
