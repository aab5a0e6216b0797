/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "mesh_support.h"
#include "orthostat/refine.h"
#include "piece_checks.h"

static const OstTubeShape short_tube = {1, {0.5, -1.0, 2.0}, 2.0, {0.9, 1.5}, 9, 2, 3};

/* The tets that reach closer than `radius` to a point. */
static unsigned char *mark_near(const OstMesh *mesh, const double point[3], double radius)
{
    unsigned char *marked = calloc((size_t)mesh->owned_tets + 1, 1);
    for (OstLocal t = 0; t < mesh->owned_tets; t++)
        for (int v = 0; v < 4; v++) {
            const double *x = mesh->coordinates + 3 * tet_of(mesh, t)[v];
            marked[t] |= hypot(hypot(x[0] - point[0], x[1] - point[1]), x[2] - point[2]) < radius;
        }
    return marked;
}

/* Refines in place near a point; `before` receives the old mesh, or it is destroyed. */
static void bisect_near(OstBisection *bisection, OstMesh **mesh, const double point[3], double radius,
                        const OstShapeSurface *shape, OstMesh **before)
{
    OstMesh *fine = NULL;
    unsigned char *marked = mark_near(*mesh, point, radius);
    assert_success(ost_bisection_refine(bisection, marked, shape, &fine));
    assert_int_equal(fine->nodes_per_tet, (*mesh)->nodes_per_tet);
    free(marked);
    if (before)
        *before = *mesh;
    else
        ost_mesh_destroy(mesh);
    *mesh = fine;
}

/* Two bisections of one mesh, on all ranks and on this one alone, generation by generation. */
typedef struct Twins {
    OstContext *alone;
    OstMesh *mesh, *serial;
    OstBisection *bisection, *serially;
} Twins;

static void start_twins(Twins *twins, OstMesh *(*make)(OstContext *))
{
    assert_int_equal(ost_context_create(MPI_COMM_SELF, &twins->alone), OST_SUCCESS);
    twins->mesh = make(ctx);
    twins->serial = make(twins->alone);
    assert_success(ost_bisection_create(twins->mesh, &twins->bisection));
    assert_int_equal(ost_bisection_create(twins->serial, &twins->serially), OST_SUCCESS);
}

static void bisect_twins(Twins *twins, const double point[3], double radius, const OstShapeSurface *shape)
{
    OstMesh *fine = NULL;
    bisect_near(twins->bisection, &twins->mesh, point, radius, shape, NULL);
    unsigned char *marked = mark_near(twins->serial, point, radius);
    assert_int_equal(ost_bisection_refine(twins->serially, marked, shape, &fine), OST_SUCCESS);
    free(marked);
    ost_mesh_destroy(&twins->serial);
    twins->serial = fine;
    check_piece(twins->mesh);
    check_against_serial(twins->mesh, twins->serial);
}

static void end_twins(Twins *twins)
{
    ost_bisection_destroy(&twins->bisection);
    ost_bisection_destroy(&twins->serially);
    ost_mesh_destroy(&twins->mesh);
    ost_mesh_destroy(&twins->serial);
    assert_int_equal(ost_ledger_bytes(twins->alone), 0);
    ost_context_destroy(&twins->alone);
}

static OstMesh *make_block(OstContext *on)
{
    return mesh_of_block(on, 1.0, 2.0, 3.0, 2, 3, 4);
}

static OstMesh *make_tube(OstContext *on)
{
    return mesh_of_tube(on, &short_tube);
}

static OstMesh *make_curved_tube(OstContext *on)
{
    const OstShapeSurface surface = ost_shape_surface_tube(&short_tube);
    OstMesh *linear = mesh_of_tube(on, &short_tube);
    OstMesh *mesh = NULL;
    assert_int_equal(ost_mesh_raise(linear, &surface, &mesh), OST_SUCCESS);
    ost_mesh_destroy(&linear);
    return mesh;
}

/* A hanging node would leave faces with one tet inside the body, and show in the area of the surface. */
static void ten_generations_are_the_same_on_any_number_of_ranks(void **state)
{
    static const double corner[3] = {0.0, 0.7, 3.0};
    const char *names[] = {"xmin", "ymax", "zmin", "zmax"};
    const double areas[] = {6.0, 3.0, 2.0, 2.0};
    Twins twins = {0};
    double vector[3];
    start_twins(&twins, make_block);
    const double first = worst_quality(twins.mesh);
    for (int generation = 0; generation < 10; generation++) {
        const OstGlobal tets = twins.mesh->global_tets;
        bisect_twins(&twins, corner, 1.5 * pow(0.75, generation), NULL);
        assert_true(twins.mesh->global_tets > tets);
        assert_close(total_volume(twins.mesh), 6.0, 1e-12);
        assert_close(surface_area(twins.mesh, vector), 22.0, 1e-12);
        for (int s = 0; s < 4; s++)
            assert_close(boundary_area(twins.mesh, names[s], vector), areas[s], 1e-12);
        assert_true(worst_quality(twins.mesh) > 0.4 * first);
    }
    end_twins(&twins);
}

static void tubes_are_bisected_onto_their_circles(void **state)
{
    static const double point[3] = {2.0, 0.0, 2.0}; /* on the outer side, halfway up */
    const OstShapeSurface surface = ost_shape_surface_tube(&short_tube);
    for (int curved = 0; curved < 2; curved++) {
        Twins twins = {0};
        start_twins(&twins, curved ? make_curved_tube : make_tube);
        for (int generation = 0; generation < 4; generation++) {
            bisect_twins(&twins, point, 0.5, &surface);
            for (int side = 0; side < 2; side++) {
                const OstMesh *mesh = twins.mesh;
                const OstBoundary *boundary =
                    &mesh->boundaries[ost_mesh_find_boundary(mesh, side == 0 ? "inner" : "outer")];
                assert_int_equal(boundary->nodes_per_item, curved ? 6 : 3);
                for (OstLocal i = 0; i < boundary->nodes_per_item * boundary->count; i++) {
                    const double *x = mesh->coordinates + 3 * boundary->nodes[i];
                    assert_close(hypot(x[0] - 0.5, x[2] - 2.0), short_tube.radii[side], 1e-14);
                }
            }
        }
        end_twins(&twins);
    }
}

/* Without a shape, curved tets fill the same space as before, to rounding. */
static void curved_tets_keep_their_space(void **state)
{
    static const double point[3] = {2.0, 0.0, 2.0};
    Twins twins = {0};
    start_twins(&twins, make_curved_tube);
    const double volume = curved_volume(twins.mesh);
    for (int generation = 0; generation < 4; generation++) {
        bisect_twins(&twins, point, 0.6, NULL);
        assert_close(curved_volume(twins.mesh) / volume, 1.0, 1e-12);
    }
    end_twins(&twins);
}

/* Vertices moved about by up to a fifth of a cell, so that no two tets are alike. */
static OstMesh *make_crooked_block(OstContext *on)
{
    const OstBlockShape shape = {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {4, 4, 4}};
    OstMeshChunk *chunk = NULL;
    OstMesh *mesh = NULL;
    assert_int_equal(ost_chunk_create_block(on, &shape, &chunk), OST_SUCCESS);
    for (OstLocal n = 0; n < chunk->node_count; n++)
        for (int d = 0; d < 3; d++) {
            double *x = &chunk->coordinates[3 * n + d];
            const double scatter = sin(12.9898 * (double)(chunk->first_node + n) + 78.233 * d) * 43758.5453;
            if (*x > 0.0 && *x < 1.0)
                *x += 0.05 * (2.0 * (scatter - floor(scatter)) - 1.0);
        }
    assert_int_equal(ost_mesh_distribute(on, &chunk, &mesh), OST_SUCCESS);
    return mesh;
}

/* A ring of few tets: curved so far that straight pieces of some would turn over. */
static OstMesh *make_coarse_ring(OstContext *on)
{
    const OstTubeShape shape = {1, {0.5, -1.0, 2.0}, 2.0, {0.9, 1.5}, 4, 1, 1};
    const OstShapeSurface surface = ost_shape_surface_tube(&shape);
    OstMesh *linear = mesh_of_tube(on, &shape), *mesh = NULL;
    linear->straighten = 1;
    assert_int_equal(ost_mesh_raise(linear, &surface, &mesh), OST_SUCCESS);
    ost_mesh_destroy(&linear);
    return mesh;
}

static void pieces_that_would_turn_over_are_straight(void **state)
{
    static const double middle[3] = {0.5, 0.5, 0.5};
    Twins twins = {0};
    start_twins(&twins, make_coarse_ring);
    const double volume = curved_volume(twins.mesh);
    for (int generation = 0; generation < 5; generation++) {
        bisect_twins(&twins, middle, 2.0, NULL);
        assert_true(worst_quality(twins.mesh) > 0.02);
        assert_close(curved_volume(twins.mesh) / volume, 1.0, 1e-3);
    }
    end_twins(&twins);
}

static void shapes_of_an_irregular_mesh_stay_bounded(void **state)
{
    static const double inside[3] = {0.3, 0.4, 0.55};
    Twins twins = {0};
    double vector[3];
    start_twins(&twins, make_crooked_block);
    const double first = worst_quality(twins.mesh);
    double worst[10];
    for (int generation = 0; generation < 10; generation++) {
        bisect_twins(&twins, inside, 0.3 * pow(0.75, generation), NULL);
        worst[generation] = worst_quality(twins.mesh);
        assert_close(total_volume(twins.mesh), 1.0, 1e-12);
        assert_close(surface_area(twins.mesh, vector), 6.0, 1e-12);
    }
    assert_true(worst[9] > 0.2 * first);
    assert_true(worst[9] > 0.8 * worst[5]); /* it has come to rest */
    end_twins(&twins);
}

/* --- periodic pairs --- */

static const OstPeriodicPair pairs[] = {{"xmin", "xmax"}, {"ymin", "ymax"}, {"zmin", "zmax"}};
static OstLocal cells[3]; /* of the periodic block */

/* A block whose vertices are moved about, on opposite sides alike: these are not plane, and no two tets are alike but
 * for those at the same place of a period. */
static OstMesh *make_periodic_block(OstContext *on)
{
    const OstBlockShape shape = {{0.0, 0.0, 0.0}, {1.0, 1.2, 0.9}, {cells[0], cells[1], cells[2]}};
    OstMeshChunk *chunk = NULL;
    OstMesh *mesh = NULL;
    assert_int_equal(ost_chunk_create_block(on, &shape, &chunk), OST_SUCCESS);
    for (OstLocal n = 0; n < chunk->node_count; n++) {
        const OstGlobal number = chunk->first_node + n, rows = number / (cells[2] + 1);
        const OstGlobal at[3] = {rows / (cells[1] + 1) % cells[0], rows % (cells[1] + 1) % cells[1],
                                 number % (cells[2] + 1) % cells[2]};
        for (int d = 0; d < 3; d++) {
            const double scatter = sin(12.9898 * (double)(at[0] + 7 * at[1] + 31 * at[2]) + 78.233 * d) * 43758.5453;
            chunk->coordinates[3 * n + d] += 0.1 / (double)cells[d] * (scatter - floor(scatter));
        }
    }
    assert_int_equal(ost_mesh_distribute(on, &chunk, &mesh), OST_SUCCESS);
    return mesh;
}

static OstMesh *make_regular_block(OstContext *on)
{
    return mesh_of_block(on, 1.0, 1.2, 0.9, cells[0], cells[1], cells[2]);
}

static OstMesh *make_quadratic_block(OstContext *on)
{
    OstMesh *linear = make_periodic_block(on), *mesh = NULL;
    assert_int_equal(ost_mesh_raise(linear, NULL, &mesh), OST_SUCCESS);
    ost_mesh_destroy(&linear);
    return mesh;
}

/* How many nodes of a face are those of another, moved by a period. */
static int count_images(const OstMesh *mesh, int width, const OstGlobal *face, const OstGlobal *image,
                        const double period[3])
{
    int found = 0;
    for (int a = 0; a < width; a++)
        for (int b = 0; b < width; b++) {
            const double *x = mesh->coordinates + 3 * face[a], *y = mesh->coordinates + 3 * image[b];
            found +=
                fabs(y[0] - x[0] - period[0]) + fabs(y[1] - x[1] - period[1]) + fabs(y[2] - x[2] - period[2]) < 1e-12;
        }
    return found;
}

/* Does each face of a boundary have its image on the opposite one, in its first `nodes` nodes? The mesh is on one rank.
 */
static void check_pair(const OstMesh *mesh, int nodes, const OstPeriodicPair *pair, const double period[3])
{
    const OstBoundary *from = &mesh->boundaries[ost_mesh_find_boundary(mesh, pair->leads)];
    const OstBoundary *to = &mesh->boundaries[ost_mesh_find_boundary(mesh, pair->follows)];
    const int width = from->nodes_per_item;
    assert_int_equal(from->count, to->count);
    for (OstLocal i = 0; i < from->count; i++) {
        int found = 0;
        for (OstLocal k = 0; k < to->count && !found; k++)
            found = count_images(mesh, nodes, from->nodes + i * width, to->nodes + k * width, period) == nodes;
        assert_true(found);
    }
}

/* Near places on all sides, by turns; where there is one cell, a tet has edges on both. */
static void periodic_pairs_stay_the_same(void **state)
{
    static const double point[4][3] = {{0.0, 0.4, 0.3}, {1.0, 1.2, 0.9}, {0.6, 1.2, 0.3}, {0.5, 0.1, 0.0}};
    static const double period[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.2, 0.0}, {0.0, 0.0, 0.9}};
    static const OstLocal divisions[3][3] = {{1, 1, 1}, {1, 2, 3}, {4, 3, 4}};
    OstMesh *(*const make[3])(OstContext *) = {make_periodic_block, make_regular_block, make_quadratic_block};
    for (int m = 0; m < 9; m++) {
        Twins twins = {0};
        memcpy(cells, divisions[m % 3], sizeof cells);
        start_twins(&twins, make[m / 3]);
        assert_success(ost_bisection_pair(twins.bisection, 3, pairs));
        assert_int_equal(ost_bisection_pair(twins.serially, 3, pairs), OST_SUCCESS);
        const double volume = total_volume(twins.mesh);
        for (int generation = 0; generation < 5; generation++) {
            const OstGlobal tets = twins.mesh->global_tets;
            bisect_twins(&twins, point[generation % 4], 0.9 * pow(0.8, generation), NULL);
            assert_true(twins.mesh->global_tets > tets);
            assert_close(total_volume(twins.mesh) / volume, 1.0, 1e-12);
            for (int p = 0; p < 3; p++)
                check_pair(twins.serial, m < 6 ? 3 : 6, &pairs[p], period[p]);
        }
        end_twins(&twins);
    }
}

/* Edges within one side are curved, and straight on the opposite one. Coordinates are sums of powers of 2. */
static OstMesh *make_uneven_block(OstContext *on)
{
    OstMesh *linear = mesh_of_block(on, 1.0, 1.0, 1.0, 2, 2, 2), *mesh = NULL;
    assert_int_equal(ost_mesh_raise(linear, NULL, &mesh), OST_SUCCESS);
    ost_mesh_destroy(&linear);
    for (OstLocal n = 0; n < mesh->node_count; n++) {
        double *x = mesh->coordinates + 3 * n;
        const int is_middle = fmod(4.0 * x[0], 2.0) != 0.0 || fmod(4.0 * x[2], 2.0) != 0.0;
        if (x[1] == 1.0 && is_middle && x[0] > 0.0 && x[0] < 1.0 && x[2] > 0.0 && x[2] < 1.0)
            x[0] += 0.03125;
    }
    return mesh;
}

/* New vertices of the side that follows are where those are that lead. */
static void sides_that_are_curved_otherwise_keep_the_same_vertices(void **state)
{
    static const double point[3] = {0.5, 1.0, 0.5}, period[3] = {0.0, 1.0, 0.0};
    Twins twins = {0};
    start_twins(&twins, make_uneven_block);
    assert_success(ost_bisection_pair(twins.bisection, 3, pairs));
    assert_int_equal(ost_bisection_pair(twins.serially, 3, pairs), OST_SUCCESS);
    for (int generation = 0; generation < 4; generation++) {
        bisect_twins(&twins, point, 0.6, NULL);
        check_pair(twins.serial, 3, &pairs[1], period);
    }
    end_twins(&twins);
}

static void pairs_are_told_once_and_by_name(void **state)
{
    static const OstPeriodicPair wrong = {"xmin", "xmas"};
    static const double corner[3] = {0.0, 0.0, 0.0};
    OstMesh *mesh = make_block(ctx);
    OstBisection *bisection = NULL;
    assert_success(ost_bisection_create(mesh, &bisection));
    assert_int_equal(ost_bisection_pair(bisection, 1, &wrong), OST_INVALID_INPUT);
    assert_success(ost_bisection_pair(bisection, 1, pairs));
    assert_int_equal(ost_bisection_pair(bisection, 1, pairs), OST_INVALID_INPUT);
    bisect_near(bisection, &mesh, corner, 0.5, NULL, NULL);
    assert_int_equal(ost_bisection_pair(bisection, 1, pairs), OST_INVALID_INPUT);
    ost_bisection_destroy(&bisection);
    ost_mesh_destroy(&mesh);
}

static void regions_axes_points_and_curves_are_inherited(void **state)
{
    static const double point[3] = {0.0, 0.0, 0.0};
    OstMeshChunk *chunk = marked_column();
    assert_success(OST_NEW(ctx, &chunk->tet_axes, 9 * (size_t)chunk->tet_count));
    for (OstLocal i = 0; i < 9 * chunk->tet_count; i++)
        chunk->tet_axes[i] = i;
    OstMesh *mesh = NULL, *fine = NULL;
    OstBisection *bisection = NULL;
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    assert_success(ost_bisection_create(mesh, &bisection));
    for (int generation = 0; generation < 6; generation++) {
        unsigned char *marked = mark_near(mesh, point, 0.4);
        assert_success(ost_bisection_refine(bisection, marked, NULL, &fine));
        free(marked);
        check_piece(fine);
        double length = 0.0;
        for (OstLocal i = 0; i < fine->boundaries[0].count; i++) {
            const OstGlobal *nodes = fine->boundaries[0].nodes + 2 * i;
            const double *a = fine->coordinates + 3 * nodes[0], *b = fine->coordinates + 3 * nodes[1];
            assert_close(fabs(a[0]) + fabs(a[1]) + fabs(b[0]) + fabs(b[1]), 0.0, 0.0);
            assert_true(b[2] > a[2]);
            length += ost_mesh_owns(fine, 2, nodes) ? b[2] - a[2] : 0.0;
        }
        MPI_Allreduce(MPI_IN_PLACE, &length, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        assert_close(length, 1.0, 1e-14);
        assert_int_equal(sum_over_ranks(fine->boundaries[1].count), 2);
        for (OstLocal t = 0; t < fine->tet_count; t++)
            for (int i = 1; i < 9; i++)
                assert_close(fine->tet_axes[9 * t + i] - fine->tet_axes[9 * t], i, 0.0);
        assert_string_equal(fine->regions.name[0], "all");
        ost_mesh_destroy(&mesh);
        mesh = fine;
    }
    ost_bisection_destroy(&bisection);
    ost_mesh_destroy(&mesh);
}

static double curve_at(const double x[3], int quadratic)
{
    return 1.0 + 2.0 * x[0] - x[1] + 0.5 * x[2] + quadratic * (x[0] * x[1] - 3.0 * x[2] * x[2] + x[1] * x[2]);
}

/* What a tet can hold is carried without error. */
static void fields_are_carried(void **state)
{
    static const double point[3] = {0.5, 1.0, 0.0};
    for (int quadratic = 0; quadratic < 2; quadratic++) {
        OstMesh *mesh = make_block(ctx), *before = NULL;
        OstBisection *bisection = NULL;
        if (quadratic) {
            assert_success(ost_mesh_raise(mesh, NULL, &before));
            ost_mesh_destroy(&mesh);
            mesh = before;
        }
        assert_success(ost_bisection_create(mesh, &bisection));
        double *field = calloc((size_t)mesh->node_count, 2 * sizeof *field);
        for (OstLocal n = 0; n < mesh->node_count; n++) {
            field[2 * n] = curve_at(mesh->coordinates + 3 * n, quadratic);
            field[2 * n + 1] = -field[2 * n];
        }
        for (int generation = 0; generation < 3; generation++) {
            bisect_near(bisection, &mesh, point, 0.8, NULL, &before);
            double *carried = calloc((size_t)mesh->node_count, 2 * sizeof *carried);
            assert_success(ost_bisection_carry(bisection, 2, field, carried));
            for (OstLocal n = 0; n < mesh->node_count; n++) {
                assert_close(carried[2 * n], curve_at(mesh->coordinates + 3 * n, quadratic), 1e-13);
                assert_close(carried[2 * n + 1], -carried[2 * n], 0.0);
            }
            free(field);
            field = carried;
            ost_mesh_destroy(&before);
        }
        free(field);
        ost_bisection_destroy(&bisection);
        ost_mesh_destroy(&mesh);
    }
}

/* A tet that is cut n times becomes tets of 2^-n of its volume, which know it by its label. */
static void tets_are_cut_as_often_as_asked_and_know_their_parents(void **state)
{
    OstMesh *mesh = make_block(ctx), *fine = NULL;
    OstBisection *bisection = NULL;
    unsigned char *times = calloc((size_t)mesh->owned_tets + 1, 1);
    double *of_parent = calloc((size_t)mesh->owned_tets + 1, 3 * sizeof *of_parent);
    for (OstLocal t = 0; t < mesh->owned_tets; t++) {
        times[t] = mesh->tet_label[t] % 10 == 0 ? 4 : 0;
        of_parent[3 * t] = (double)mesh->tet_label[t];
        of_parent[3 * t + 1] = ost_tet_volume(mesh->coordinates, tet_of(mesh, t));
        of_parent[3 * t + 2] = times[t];
    }
    assert_success(ost_bisection_create(mesh, &bisection));
    assert_success(ost_bisection_refine(bisection, times, NULL, &fine));
    double *carried = calloc((size_t)fine->owned_tets + 1, 3 * sizeof *carried);
    int *cuts = calloc((size_t)fine->owned_tets + 1, sizeof *cuts);
    assert_success(ost_bisection_carry_tets(bisection, 3, of_parent, carried, cuts));
    double *label = calloc((size_t)fine->global_tets, sizeof *label); /* the parent's, by the tet's own */
    for (OstLocal t = 0; t < fine->owned_tets; t++) {
        const double volume = ost_tet_volume(fine->coordinates, tet_of(fine, t));
        assert_close(ldexp(volume, cuts[t]) / carried[3 * t + 1], 1.0, 1e-13);
        assert_true(cuts[t] >= (int)carried[3 * t + 2]);
        label[fine->tet_label[t] - 1] = carried[3 * t];
    }
    MPI_Allreduce(MPI_IN_PLACE, label, (int)fine->global_tets, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    for (OstGlobal t = 1; t < fine->global_tets; t++)
        assert_true(label[t] >= label[t - 1]);
    free(label);
    free(cuts);
    free(carried);
    free(of_parent);
    free(times);
    ost_bisection_destroy(&bisection);
    ost_mesh_destroy(&fine);
    ost_mesh_destroy(&mesh);
}

static void nothing_marked_leaves_the_mesh_as_it_is(void **state)
{
    OstMesh *mesh = make_block(ctx), *fine = NULL;
    OstBisection *bisection = NULL;
    unsigned char *marked = calloc((size_t)mesh->owned_tets + 1, 1);
    assert_success(ost_bisection_create(mesh, &bisection));
    assert_success(ost_bisection_refine(bisection, marked, NULL, &fine));
    assert_int_equal(fine->global_tets, mesh->global_tets);
    assert_int_equal(fine->global_nodes, mesh->global_nodes);
    free(marked);
    ost_bisection_destroy(&bisection);
    ost_mesh_destroy(&fine);
    ost_mesh_destroy(&mesh);
}

static void steps_out_of_order_are_refused(void **state)
{
    OstMesh *mesh = make_block(ctx);
    OstBisection *bisection = NULL;
    assert_success(ost_bisection_create(mesh, &bisection));
    assert_int_equal(ost_bisection_settle(bisection, mesh), OST_INVALID_INPUT);
    assert_int_equal(ost_bisection_carry(bisection, 3, mesh->coordinates, mesh->coordinates), OST_INVALID_INPUT);
    ost_bisection_destroy(&bisection);
    ost_mesh_destroy(&mesh);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(ten_generations_are_the_same_on_any_number_of_ranks),
    cmocka_unit_test(tubes_are_bisected_onto_their_circles),
    cmocka_unit_test(curved_tets_keep_their_space),
    cmocka_unit_test(pieces_that_would_turn_over_are_straight),
    cmocka_unit_test(shapes_of_an_irregular_mesh_stay_bounded),
    cmocka_unit_test(periodic_pairs_stay_the_same),
    cmocka_unit_test(sides_that_are_curved_otherwise_keep_the_same_vertices),
    cmocka_unit_test(pairs_are_told_once_and_by_name),
    cmocka_unit_test(regions_axes_points_and_curves_are_inherited),
    cmocka_unit_test(fields_are_carried),
    cmocka_unit_test(tets_are_cut_as_often_as_asked_and_know_their_parents),
    cmocka_unit_test(nothing_marked_leaves_the_mesh_as_it_is),
    cmocka_unit_test(steps_out_of_order_are_refused),
};

OST_TEST_MAIN(tests)
