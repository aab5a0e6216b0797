/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TESTS_ASSEMBLY_BODY_H
#define ORTHOSTAT_TESTS_ASSEMBLY_BODY_H

#include "problem/scene_data.h"
#include "support.h"

#include "assembly/loads.h"
#include "assembly/system.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/small.h"
#include "orthostat/orthostat.h"

/* Bodies, materials and sums over ranks for the tests of assembly/. Everything random is drawn from labels, so that a
 * body is the same on any number of ranks. */

static inline double random_of(OstGlobal label, int salt)
{
    uint64_t z = (uint64_t)label * 0x9E3779B97F4A7C15u + (uint64_t)salt * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return (double)((z ^ (z >> 31)) >> 11) / 4503599627370496.0 - 1.0;
}

enum { NX = 4, NY = 3, NZ = 3 };
static const double size_of_body[3] = {2.0, 1.5, 1.2};

static inline int is_on_surface(const double *x)
{
    for (int i = 0; i < 3; i++)
        if (x[i] < 1e-12 || x[i] > size_of_body[i] - 1e-12)
            return 1;
    return 0;
}

/* A box of irregular tets: inner vertices are moved at random. */
static inline OstMesh *make_body(OstContext *of)
{
    const OstBlockShape shape = {.size = {size_of_body[0], size_of_body[1], size_of_body[2]},
                                 .divisions = {NX, NY, NZ}};
    OstMeshChunk *chunk = NULL;
    OstMesh *mesh = NULL;
    assert_success(ost_chunk_create_block(of, &shape, &chunk));
    assert_success(ost_mesh_distribute(of, &chunk, &mesh));
    for (OstLocal node = 0; node < mesh->node_count; node++) {
        double *x = mesh->coordinates + 3 * node;
        if (!is_on_surface(x))
            for (int i = 0; i < 3; i++)
                x[i] += 0.08 * random_of(mesh->node_label[node], i);
    }
    return mesh;
}

/* The same, or with quadratic tets. */
static inline OstMesh *make_body_of(int order)
{
    OstMesh *linear = make_body(ctx), *quadratic = NULL;
    if (order == 1)
        return linear;
    assert_success(ost_mesh_raise(linear, NULL, &quadratic));
    ost_mesh_destroy(&linear);
    return quadratic;
}

/* A strongly orthotropic material, or an isotropic one that does not know that it is. */
static inline OstMaterial make_material(OstContext *of, int orthotropic)
{
    const OstOrthotropic wood = {
        .youngs_modulus = {1000.0, 10.0, 50.0}, .poissons_ratio = {0.4, 0.1, 0.02}, .shear_modulus = {8.0, 12.0, 60.0}};
    const OstOrthotropic same = ost_orthotropic_isotropic(100.0, 0.3);
    OstMaterial material;
    assert_success(ost_material_create(of, "body", orthotropic ? &wood : &same, 3.0, &material));
    return material;
}

typedef enum { AXES_FIXED, AXES_SAME_BY_TET, AXES_RANDOM_BY_TET } AxesOfBody;

static inline void axes_of(OstGlobal label, double axes[9])
{
    const double q[4] = {random_of(label, 10), random_of(label, 11), random_of(label, 12), random_of(label, 13)};
    assert_success(ost_axes_from_quaternion(ctx, q, axes));
}

static inline OstMaterialField *make_field(const OstMesh *mesh, const OstMaterial *material, AxesOfBody kind)
{
    const size_t tets = (size_t)mesh->tet_count;
    double *axes = calloc(9 * tets + 1, sizeof *axes);
    double *centroids = calloc(3 * tets + 1, sizeof *centroids);
    OstAxesSpec spec = {.kind = kind == AXES_FIXED ? OST_AXES_FIXED : OST_AXES_CELLS};
    OstMaterialField *field = NULL;
    axes_of(7, spec.fixed);
    for (size_t t = 0; t < tets; t++)
        axes_of(kind == AXES_RANDOM_BY_TET ? mesh->tet_label[t] : 7, axes + 9 * t);
    assert_success(ost_field_create(mesh->ctx, NULL, 1, material, &spec, mesh->tet_count, mesh->tet_region,
                                    mesh->tet_label, centroids, kind == AXES_FIXED ? NULL : axes, &field));
    free(axes);
    free(centroids);
    return field;
}

static inline OstSystem *make_system(const OstMesh *mesh, const OstSupports *supports, const OstMaterialField *field)
{
    OstSystem *system = NULL;
    assert_success(ost_system_create(mesh, supports, &system));
    assert_success(ost_system_fill(system, field));
    return system;
}

static inline double sum_over_ranks(OstContext *of, double value)
{
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, ost_comm(of));
    return value;
}

static inline double dot(OstContext *of, OstLocal count, const double *a, const double *b)
{
    double sum = 0.0;
    for (OstLocal i = 0; i < count; i++)
        sum += a[i] * b[i];
    return sum_over_ranks(of, sum);
}

static inline double largest(OstContext *of, OstLocal count, const double *a)
{
    double size = 0.0;
    for (OstLocal i = 0; i < count; i++)
        size = fmax(size, fabs(a[i]));
    MPI_Allreduce(MPI_IN_PLACE, &size, 1, MPI_DOUBLE, MPI_MAX, ost_comm(of));
    return size;
}

/* Sum of force, and of moment about the origin, over owned nodes of all ranks. */
static inline void resultant(const OstMesh *mesh, const double *force, double sum[6])
{
    memset(sum, 0, 6 * sizeof *sum);
    for (OstLocal node = 0; node < mesh->owned_nodes; node++) {
        double moment[3];
        ost_cross3(mesh->coordinates + 3 * node, force + 3 * node, moment);
        for (int i = 0; i < 3; i++) {
            sum[i] += force[3 * node + i];
            sum[3 + i] += moment[i];
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, sum, 6, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
}

static inline double *numbers(size_t count)
{
    return calloc(count + 1, sizeof(double));
}

/* Three numbers of each owned node, gathered by label on every rank. */
static inline double *by_label(const OstMesh *mesh, const double *values)
{
    const size_t count = 3 * (size_t)mesh->global_nodes;
    double *all = numbers(count);
    for (OstLocal node = 0; node < mesh->owned_nodes; node++)
        for (int i = 0; i < 3; i++)
            all[3 * (mesh->node_label[node] - 1) + i] = values[3 * node + i];
    MPI_Allreduce(MPI_IN_PLACE, all, (int)count, MPI_DOUBLE, MPI_SUM, ost_comm(mesh->ctx));
    return all;
}

/* Plain conjugate gradients on the system, to rounding. */
static inline void solve(OstContext *of, const OstBlockMatrix *matrix, const double *rhs, double *v)
{
    const OstLocal n = 3 * matrix->rows;
    double *r = numbers((size_t)n);
    double *p = numbers(3 * (size_t)matrix->columns);
    double *ap = numbers((size_t)n);
    memset(v, 0, (size_t)n * sizeof *v);
    memcpy(r, rhs, (size_t)n * sizeof *r);
    memcpy(p, rhs, (size_t)n * sizeof *p);
    const double start = dot(of, n, r, r);
    double rr = start;
    for (int k = 0; k < 1000 && rr > 1e-30 * start; k++) {
        assert_success(ost_block_matrix_apply(matrix, p, ap));
        const double alpha = rr / dot(of, n, p, ap);
        for (OstLocal i = 0; i < n; i++) {
            v[i] += alpha * p[i];
            r[i] -= alpha * ap[i];
        }
        const double next = dot(of, n, r, r);
        for (OstLocal i = 0; i < n; i++)
            p[i] = r[i] + next / rr * p[i];
        rr = next;
    }
    assert_true(rr <= 1e-30 * start);
    free(r);
    free(p);
    free(ap);
}

#endif
