/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/supports.h"
#include "core/error.h"
#include "core/memory.h"
#include "orthostat/orthostat.h"
#include "problem/problem.h"
#include "problem/scene_data.h"

#include <stdio.h>
#include <string.h>

/* Writes a case as CalculiX reads it: the same linear tets, the same stiffness along the same axes (CalculiX takes
 * cylindrical axes at the middle of a linear tet, as we do), the same forces at the nodes. One region, nodes held
 * wholly at zero: what the tubes need; more is refused. Arguments: case, CalculiX's solver, file to write, and
 * "large-rotation" where it is to solve for that. One rank. */

static OstStatus check_scene(const OstScene *scene)
{
    const OstAxesKind kind = scene->c->materials[0].axes.kind;
    if (scene->mesh->nodes_per_tet != 4 || scene->field->region_count != 1 || scene->c->material_count != 1)
        return OST_RAISE(scene->ctx, OST_INVALID_INPUT, "%s: only linear tets of one material are written for CalculiX",
                         scene->c->path);
    if (!scene->field->material[0].isotropic && kind != OST_AXES_CYLINDRICAL)
        return OST_RAISE(scene->ctx, OST_INVALID_INPUT, "%s: only cylindrical axes are written for CalculiX",
                         scene->c->path);
    return OST_SUCCESS;
}

static void write_mesh(const OstMesh *mesh, FILE *out)
{
    fputs("*NODE, NSET=ALL\n", out);
    for (OstLocal n = 0; n < mesh->owned_nodes; n++) {
        const double *x = mesh->coordinates + 3 * (size_t)n;
        fprintf(out, "%lld, %.13e, %.13e, %.13e\n", (long long)mesh->node_label[n], x[0], x[1], x[2]);
    }
    fputs("*ELEMENT, TYPE=C3D4, ELSET=BODY\n", out);
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        const OstLocal *node = mesh->tet_nodes + 4 * (size_t)t;
        fprintf(out, "%lld, %lld, %lld, %lld, %lld\n", (long long)mesh->tet_label[t],
                (long long)mesh->node_label[node[0]], (long long)mesh->node_label[node[1]],
                (long long)mesh->node_label[node[2]], (long long)mesh->node_label[node[3]]);
    }
}

/* CalculiX's local axes are radial, tangential, axial: the stiffness is turned from the material's order to that one.
 */
static void write_orthotropic(const OstMaterial *material, const OstAxesSpec *axes, FILE *out)
{
    double frame[9] = {0.0}, c[36];
    for (int k = 0; k < 3; k++)
        frame[3 * k + (axes->order[k] == OST_RADIAL ? 0 : axes->order[k] == OST_TANGENTIAL ? 1 : 2)] = 1.0;
    ost_material_rotate_stiffness(material->stiffness, frame, c);
    fprintf(out, "*ELASTIC, TYPE=ORTHO\n%.13e, %.13e, %.13e, %.13e, %.13e, %.13e, %.13e, %.13e,\n%.13e\n", c[0], c[1],
            c[7], c[2], c[8], c[14], c[21], c[35], c[28]);
    fprintf(out, "*ORIENTATION, NAME=AXES, SYSTEM=CYLINDRICAL\n%.13e, %.13e, %.13e, %.13e, %.13e, %.13e\n",
            axes->origin[0], axes->origin[1], axes->origin[2], axes->origin[0] + axes->axis[0],
            axes->origin[1] + axes->axis[1], axes->origin[2] + axes->axis[2]);
}

static void write_material(const OstScene *scene, FILE *out)
{
    const OstMaterial *material = &scene->field->material[0];
    fputs("*MATERIAL, NAME=SOLID\n", out);
    if (material->isotropic)
        fprintf(out, "*ELASTIC\n%.13e, %.13e\n", material->constants.youngs_modulus[0],
                material->constants.poissons_ratio[0]);
    else
        write_orthotropic(material, &scene->c->materials[0].axes, out);
    fprintf(out, "*SOLID SECTION, ELSET=BODY, MATERIAL=SOLID%s\n", material->isotropic ? "" : ", ORIENTATION=AXES");
}

static OstStatus write_supports(const OstScene *scene, const OstSupports *supports, FILE *out)
{
    fputs("*BOUNDARY\n", out);
    for (OstLocal n = 0; n < scene->mesh->owned_nodes; n++) {
        double projector[9], given[3];
        const int held = ost_supports_get(supports, n, projector, given);
        if (held == 0)
            continue;
        if (held < 3 || given[0] != 0.0 || given[1] != 0.0 || given[2] != 0.0)
            return OST_RAISE(scene->ctx, OST_INVALID_INPUT,
                             "%s: only nodes that are held wholly, at zero, are written for CalculiX", scene->c->path);
        fprintf(out, "%lld, 1, 3\n", (long long)scene->mesh->node_label[n]);
    }
    return OST_SUCCESS;
}

/* Large rotations: CalculiX begins with a tenth of the load, and cuts or lengthens its steps by itself. */
static void write_step(const OstMesh *mesh, const double *force, const char *solver, int large_rotation, FILE *out)
{
    fprintf(out, "*STEP%s\n*STATIC, SOLVER=%s\n%s*CLOAD\n", large_rotation ? ", NLGEOM, INC=1000" : "", solver,
            large_rotation ? "0.1, 1.\n" : "");
    for (OstLocal n = 0; n < mesh->owned_nodes; n++)
        for (int i = 0; i < 3; i++)
            if (force[3 * (size_t)n + (size_t)i] != 0.0)
                fprintf(out, "%lld, %d, %.13e\n", (long long)mesh->node_label[n], i + 1,
                        force[3 * (size_t)n + (size_t)i]);
    fputs("*NODE PRINT, NSET=ALL, FREQUENCY=1000\nU\n*END STEP\n", out);
}

static OstStatus write_scene(const OstScene *scene, const char *solver, int large_rotation, FILE *out)
{
    OstProblem *problem = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(check_scene(scene));
    OST_TRY_DONE(ost_scene_problem(scene, &problem));
    write_mesh(scene->mesh, out);
    write_material(scene, out);
    OST_TRY_DONE(write_supports(scene, problem->supports, out));
    write_step(scene->mesh, problem->force, solver, large_rotation, out);
done:
    ost_problem_destroy(&problem);
    return status;
}

static OstStatus write_case(OstContext *ctx, const char *case_path, const char *solver, const char *path,
                            int large_rotation)
{
    OstCase *c = NULL;
    OstScene *scene = NULL;
    FILE *out = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_case_read(ctx, case_path, &c));
    OST_TRY_DONE(ost_scene_create(c, &scene));
    out = fopen(path, "w");
    if (!out)
        status = OST_RAISE(ctx, OST_FILE_FAILED, "%s cannot be made", path);
    else
        status = write_scene(scene, solver, large_rotation, out);
    if (out && fclose(out) != 0 && status == OST_SUCCESS)
        status = OST_RAISE(ctx, OST_FILE_FAILED, "%s could not be written in full", path);
done:
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
    return status;
}

int main(int argc, char **argv)
{
    OstContext *ctx = NULL;
    MPI_Init(&argc, &argv);
    const int large_rotation = argc == 5 && strcmp(argv[4], "large-rotation") == 0;
    if ((argc != 4 && !large_rotation) || ost_context_create(MPI_COMM_WORLD, &ctx) != OST_SUCCESS ||
        ost_size(ctx) != 1) {
        fputs("usage: bench_write_calculix CASE SOLVER FILE.inp [large-rotation] (on one rank)\n", stderr);
        return 2;
    }
    const OstStatus status = write_case(ctx, argv[1], argv[2], argv[3], large_rotation);
    if (status != OST_SUCCESS)
        fprintf(stderr, "%s\n", ost_error_text(ctx));
    ost_context_destroy(&ctx);
    MPI_Finalize();
    return ost_status_exit_code(status);
}
