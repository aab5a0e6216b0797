/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/scene_data.h"

#include "case/case_data.h"
#include "case/select.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/free_memory.h"
#include "core/small.h"
#include "fields/output_field.h"
#include "formats/serial/formats.h"
#include "material/directions.h"
#include "orthostat/problem.h"
#include "orthostat/refine.h"
#include "problem/scene_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int wants(const OstSceneMaterials *materials, int region, OstAxesKind kind)
{
    return !materials->material[region].isotropic && materials->axes[region].kind == kind;
}

static OstStatus check_mesh_axes(const OstCase *c, const OstMesh *mesh, const OstSceneMaterials *materials)
{
    const char *reason = c->mesh_kind == OST_MESH_FILE
                             ? "the mesh file has no cell field 'axes' of nine components"
                             : "built-in shapes have no axes; a mesh file may have them as a cell field 'axes'";
    int r = 0;
    while (r < mesh->regions.count && !wants(materials, r, OST_AXES_CELLS))
        r++;
    if (mesh->tet_axes || mesh->tet_count == 0 || r == mesh->regions.count)
        return OST_SUCCESS;
    return ost_case_located(
        c, ost_case_material_of(c, mesh->regions.name[r])->axes_place,
        OST_RAISE(c->ctx, OST_INVALID_INPUT,
                  "region '%.80s' takes its axes from the mesh, but %s; give a table instead (axes: "
                  "{cells: file.txt}), or a formula",
                  mesh->regions.name[r], reason));
}

/* Axes from gradients, in place of those that came with the mesh. Potentials are of the order of the displacement:
 * linear ones made fibres turn from one quadratic tet to the next, and a reaction 7 % too small where it is 1.5 %. */
static OstStatus solve_gradient_axes(const OstScene *scene, const OstSceneMaterials *materials, OstTetAxes *axes)
{
    const OstMesh *mesh = scene->mesh;
    OstStatus status = OST_SUCCESS;
    ost_ledger_enter(scene->ctx, OST_EFFECT_GRADIENT_AXES);
    for (int r = 0; r < mesh->regions.count && status == OST_SUCCESS; r++)
        if (wants(materials, r, OST_AXES_GRADIENT))
            status = ost_scene_gradient_axes(scene, r, &materials->axes[r], axes);
    ost_ledger_leave(scene->ctx);
    return status;
}

static int wants_any(const OstScene *scene, const OstSceneMaterials *materials, OstAxesKind kind)
{
    for (int r = 0; r < scene->mesh->regions.count; r++)
        if (wants(materials, r, kind))
            return 1;
    return 0;
}

/* Do a region's axes follow directions within each tet? Only in quadratic tets. */
static int follows_directions(const OstScene *scene, const OstSceneMaterials *materials, int region)
{
    return scene->mesh->nodes_per_tet == 10 && !materials->material[region].isotropic &&
           (materials->axes[region].kind == OST_AXES_GRADIENT ||
            ost_scene_field_varies(scene, &materials->axes[region]));
}

static OstStatus make_room_for_directions(const OstScene *scene, const OstSceneMaterials *materials, OstTetAxes *axes)
{
    const int regions = scene->mesh->regions.count;
    int any = 0;
    for (int r = 0; r < regions; r++)
        any |= follows_directions(scene, materials, r);
    if (!any)
        return OST_SUCCESS;
    OST_TRY(OST_NEW(scene->ctx, &axes->directions, OST_DIRECTIONS * (size_t)scene->mesh->tet_count));
    OST_TRY(OST_NEW(scene->ctx, &axes->along, 2 * regions));
    for (int r = 0; r < regions; r++) {
        const OstAxesSpec *spec = &materials->axes[r];
        int along[2] = {0};
        if (follows_directions(scene, materials, r))
            ost_directions_along(spec->along, spec->from[1] || spec->field[1], along);
        axes->along[2 * r] = (signed char)along[0];
        axes->along[2 * r + 1] = (signed char)along[1];
    }
    return OST_SUCCESS;
}

static OstStatus make_room(const OstScene *scene, const OstSceneMaterials *materials, OstTetAxes *axes)
{
    const int gradients = ost_effect_on(&scene->plan.effects, OST_EFFECT_GRADIENT_AXES);
    ost_ledger_enter(scene->ctx, gradients ? OST_EFFECT_GRADIENT_AXES : OST_EFFECT_VARYING_AXES);
    OstStatus status = OST_NEW(scene->ctx, &axes->of_tet, 9 * (size_t)scene->mesh->tet_count);
    ost_ledger_leave(scene->ctx);
    ost_ledger_enter(scene->ctx, OST_EFFECT_VARYING_AXES);
    OST_THEN(make_room_for_directions(scene, materials, axes));
    ost_ledger_leave(scene->ctx);
    return ost_agree(scene->ctx, status);
}

/* The axes of the mesh, with those of gradients and of fields in their place; none if there are none of these. */
static OstStatus make_axes(const OstScene *scene, const OstSceneMaterials *materials, OstTetAxes *axes)
{
    const OstMesh *mesh = scene->mesh;
    const int gradients = ost_effect_on(&scene->plan.effects, OST_EFFECT_GRADIENT_AXES);
    const int fields = wants_any(scene, materials, OST_AXES_FIELD);
    if (!gradients && !fields)
        return OST_SUCCESS;
    OstStatus status = make_room(scene, materials, axes);
    if (status == OST_SUCCESS && mesh->tet_axes && mesh->tet_count > 0)
        memcpy(axes->of_tet, mesh->tet_axes, 9 * sizeof(double) * (size_t)mesh->tet_count);
    if (gradients)
        OST_THEN(solve_gradient_axes(scene, materials, axes));
    if (fields)
        OST_THEN(ost_agree(scene->ctx, ost_scene_field_axes(scene, materials, axes)));
    return status;
}

static int needs_centroids(const OstMesh *mesh, const OstMaterial *materials, const OstAxesSpec *axes)
{
    for (int r = 0; axes && r < mesh->regions.count; r++)
        if (!materials[r].isotropic && ost_axes_vary(&axes[r]))
            return 1;
    return 0;
}

static OstStatus create_field(const OstMesh *mesh, const OstEffects *effects, const OstMaterial *materials,
                              const OstAxesSpec *axes, const double *tet_axes, OstMaterialField **field)
{
    OstContext *ctx = mesh->ctx;
    double *centroids = NULL;
    OstStatus status = OST_SUCCESS;
    if (ost_effect_on(effects, OST_EFFECT_VARYING_AXES) && needs_centroids(mesh, materials, axes)) {
        ost_ledger_enter(ctx, OST_EFFECT_VARYING_AXES);
        status = OST_NEW(ctx, &centroids, (size_t)mesh->tet_count * 3);
        OST_THEN(ost_mesh_tet_centroids(mesh, centroids));
        ost_ledger_leave(ctx);
    }
    OST_THEN(ost_field_create(ctx, effects, mesh->regions.count, materials, axes, mesh->tet_count, mesh->tet_region,
                              mesh->tet_label, centroids, tet_axes, field));
    OST_FREE(centroids);
    return status;
}

OstStatus ost_field_create_on(const OstMesh *mesh, const OstMaterial *materials, const OstAxesSpec *axes,
                              const double *tet_axes, OstMaterialField **field)
{
    return ost_agree(mesh->ctx, create_field(mesh, NULL, materials, axes, tet_axes, field));
}

static OstStatus make_field(OstScene *scene, const OstSceneMaterials *materials)
{
    OstContext *ctx = scene->ctx;
    const OstEffects *effects = &scene->plan.effects;
    const OstMesh *mesh = scene->mesh;
    OstTetAxes axes = {0};
    OstStatus status = ost_agree(ctx, check_mesh_axes(scene->c, mesh, materials));
    OST_THEN(ost_scene_check_gradients(scene));
    OST_THEN(make_axes(scene, materials, &axes));
    if (status == OST_SUCCESS)
        status =
            ost_scene_locate_axes(scene->c, create_field(mesh, effects, materials->material, materials->axes,
                                                         axes.of_tet ? axes.of_tet : mesh->tet_axes, &scene->field));
    status = ost_agree(ctx, status);
    if (status == OST_SUCCESS && axes.directions)
        ost_field_take_directions(scene->field, &axes.along, &axes.directions);
    OST_FREE(axes.of_tet, axes.directions, axes.along);
    if (status == OST_SUCCESS && ost_effect_on(effects, OST_EFFECT_REGIONS))
        status = ost_agree(ctx, ost_scene_set_modulus(scene));
    if (status == OST_SUCCESS && ost_effect_on(effects, OST_EFFECT_EIGENSTRAIN))
        status = ost_agree(ctx, ost_scene_set_eigenstrain(scene));
    return status;
}

/* What the case may say so that the mixed form is on. */
static void find_way_to_mixed(const OstScene *scene, char *text, size_t size)
{
    const OstCase *c = scene->c;
    const int is_linear = scene->mesh->nodes_per_tet == 4;
    const int is_classical = c->formulation == OST_FORMULATION_CLASSICAL && c->large_rotation == OST_LARGE_ROTATION_ON;
    snprintf(text, size, "%s%s%s%s", is_linear || c->unmixed ? "element: {" : "",
             is_linear ? c->unmixed ? "order: 2, " : "order: 2}" : "", c->unmixed ? "mixed: auto}" : "",
             !is_classical             ? ""
             : is_linear || c->unmixed ? " and formulation: consistent"
                                       : "formulation: consistent");
    if (text[0])
        strncat(text, ", or ", size - strlen(text) - 1);
}

static OstStatus refuse_incompressible(const OstScene *scene, int region)
{
    char way_out[96];
    find_way_to_mixed(scene, way_out, sizeof way_out);
    return OST_RAISE(scene->ctx, OST_INVALID_INPUT,
                     "%s: region '%.80s' has nu = 1/2, an incompressible material, which only the mixed form of "
                     "quadratic tets can compute, and it is off: %s. Set %snu = 0.4999",
                     scene->c->path, scene->mesh->regions.name[region],
                     ost_effect_state(&scene->plan.effects, OST_EFFECT_MIXED)->reason, way_out);
}

/* Linear tets cannot bend at constant volume: near incompressibility they lock, and a warning says so. Quadratic ones
 * have a mixed form, or use the mean dilatation of each tet, which prevents it. */
static OstStatus treat_nearly_incompressible(OstScene *scene)
{
    int regions = 0;
    if (ost_effect_on(&scene->plan.effects, OST_EFFECT_MIXED)) {
        ost_log(scene->ctx, OST_LOG_VERBOSE,
                "nearly incompressible (nu above %g): the pressure is an unknown of its own",
                OST_NEARLY_INCOMPRESSIBLE);
        return ost_field_mixed(scene->field, OST_NEARLY_INCOMPRESSIBLE, &regions);
    }
    if (ost_field_incompressible(scene->field) >= 0)
        return refuse_incompressible(scene, ost_field_incompressible(scene->field));
    for (int r = 0; r < scene->field->region_count; r++) {
        double eigenvalues[3] = {1.0, 1.0, 1.0};
        if (ost_orthotropic_eigenvalues(scene->ctx, &scene->field->material[r].constants, eigenvalues) == OST_SUCCESS)
            regions += ost_has_one_stiff_mode(eigenvalues, OST_NEARLY_INCOMPRESSIBLE);
    }
    if (ost_effect_on(&scene->plan.effects, OST_EFFECT_MEAN_DILATATION)) {
        ost_log(scene->ctx, OST_LOG_VERBOSE, "nearly incompressible (nu above %g): each tet uses its mean dilatation",
                OST_NEARLY_INCOMPRESSIBLE);
        return ost_field_mean_dilatation(scene->field, OST_NEARLY_INCOMPRESSIBLE, &regions);
    }
    if (regions == 0)
        return OST_SUCCESS;
    /* Measured on sectors of a thick cylinder under pressure, 20 hexes of linear tets through the wall and 6 to 20
     * along 30 to 90 degrees; cases/verify/cylinder-nu-499 and -4999 test these numbers. */
    ost_warn(
        scene->ctx,
        "nu is above %g in %d region%s: linear tets lock there and move too little: on a thick cylinder with 20 of "
        "them through its wall by 5 %% at nu = 0.49, by 10 to 25 %% at 0.499, by 10 to 50 %% at 0.4999. Quadratic "
        "ones are right to 0.1 %%: set element: {order: 2}; `orthostat cost` says how much they differ here",
        OST_NEARLY_INCOMPRESSIBLE, regions, regions == 1 ? "" : "s");
    return OST_SUCCESS;
}

/* The share of the eigenstrain in what a nearly incompressible material hardly changes; 0 of one that swells alike in
 * all directions, or that is given tet by tet. */
static double eigenstrain_of_mode(const OstCaseMaterial *stated, const double *mode)
{
    const double *e = stated->eigenstrain, trace = e[0] + e[1] + e[2];
    const int is_swelling = e[0] == e[1] && e[1] == e[2];
    const double along = fabs(ost_dot3(mode, e)) / fmax(fabs(mode[0]), fmax(fabs(mode[1]), fabs(mode[2])));
    return is_swelling ? 0.0 : fmin(fabs(trace), along);
}

/* It follows its eigenstrain, whose trace is then a change of volume that a user may not expect. */
static void warn_of_changing_volume(const OstScene *scene)
{
    static const double little = 0.01;
    const OstNames *regions = &scene->mesh->regions;
    for (int r = 0; r < regions->count; r++) {
        const OstCaseMaterial *stated = ost_case_material_of(scene->c, regions->name[r]);
        const double *mode = ost_field_stiff_mode(scene->field, r);
        if (!stated || !mode || eigenstrain_of_mode(stated, mode) <= little)
            continue;
        const double *e = stated->eigenstrain, trace = e[0] + e[1] + e[2];
        ost_warn(scene->ctx,
                 "region '%.80s' is nearly incompressible, and its eigenstrain changes the volume: unless something "
                 "prevents it, by about %.3g %%. One whose parts along e1, e2 and e3 add up to 0 keeps it, as "
                 "[0.1, 0.1, -0.2]",
                 regions->name[r], 100.0 * trace);
    }
}

static OstStatus make_drive(OstScene *scene)
{
    const OstCase *c = scene->c;
    OstStatus status = OST_SUCCESS;
    for (int i = 0; i < c->load_count && !scene->drive && status == OST_SUCCESS; i++)
        if (c->loads[i].kind == OST_LOAD_DISTRIBUTING)
            status = OST_NEW(c->ctx, &scene->drive, (size_t)c->load_count * (size_t)(1 + c->table_count));
    return ost_agree(c->ctx, status);
}

/* The mesh is there already. What is foretold may be off by a tenth or so: a run that may not fit is told of, not
 * refused. */
static OstStatus fit_memory(OstScene *scene)
{
    const OstCase *c = scene->c;
    OstPlan *plan = &scene->plan;
    const int was_on = ost_effect_on(&plan->effects, OST_EFFECT_ERROR_ESTIMATE);
    double room = 0.0;
    OST_TRY(ost_memory_free(c->ctx, &room));
    room += plan->bytes_mesh;
    ost_plan_fit(c, ost_size(c->ctx), room, plan);
    const OstEffectState *estimate = ost_effect_state(&plan->effects, OST_EFFECT_ERROR_ESTIMATE);
    if (was_on && !estimate->on)
        ost_warn(c->ctx, "%s: the error of the answer is not estimated: %s; use more machines, or a coarser mesh",
                 c->path, estimate->reason);
    else if (plan->bytes_in_all > room)
        ost_warn(
            c->ctx,
            "%s: the run may need about %.3g GiB, and %.3g GiB are free: the system may end it; use more machines, "
            "or a coarser mesh",
            c->path, plan->bytes_in_all / 1073741824.0, room / 1073741824.0);
    return OST_SUCCESS;
}

static OstStatus make_plan(OstScene *scene, const OstFileMaterials *from_file)
{
    const OstMesh *mesh = scene->mesh;
    const OstCase *c = scene->c;
    OST_TRY(ost_agree(c->ctx, OST_NEW(c->ctx, &scene->load_effect, (size_t)c->load_count)));
    OST_TRY(ost_load_effects(c, mesh, scene->load_effect));
    OST_TRY(make_drive(scene));
    OstPlanMesh facts = {.nodes = mesh->global_nodes,
                         .tets = mesh->global_tets,
                         .quadratic = mesh->nodes_per_tet == 10,
                         .regions = &mesh->regions,
                         .materials = from_file,
                         .load = scene->load_effect,
                         .welded = mesh->welded};
    if (facts.quadratic && !(ost_plan_shape_surface(c) > 0.0))
        OST_TRY(ost_mesh_surface_faces(mesh, &facts.surface));
    ost_plan_make(c, &facts, ost_size(c->ctx), &scene->plan);
    return fit_memory(scene);
}

static OstStatus copy_file_materials(OstContext *ctx, const OstFileMaterials *from, OstFileMaterials **to)
{
    if (!from)
        return OST_SUCCESS;
    OST_TRY(OST_NEW(ctx, to, 1));
    OST_TRY(OST_NEW(ctx, &(*to)->material, from->count));
    OST_TRY(OST_NEW(ctx, &(*to)->axes, 9 * (size_t)from->count));
    (*to)->count = from->count;
    for (int r = 0; r < from->count; r++)
        (*to)->material[r] = from->material[r];
    for (int i = 0; i < 9 * from->count; i++)
        (*to)->axes[i] = from->axes[i];
    return OST_SUCCESS;
}

static OstStatus check_places(const OstScene *scene)
{
    const OstCase *c = scene->c;
    for (int i = 0; i < c->constraint_count; i++)
        OST_TRY(ost_select_check_place(c, scene->mesh, &c->constraints[i].on));
    for (int i = 0; i < c->load_count; i++)
        OST_TRY(ost_select_check_place(c, scene->mesh, &c->loads[i].on));
    for (int i = 0; i < c->spring_count; i++)
        OST_TRY(ost_select_check_place(c, scene->mesh, &c->springs[i].on));
    return OST_SUCCESS;
}

static OstStatus fill(OstScene *made, OstMeshChunk **chunk)
{
    OstContext *ctx = made->ctx;
    const OstCase *c = made->c;
    OstSceneMaterials materials = {0};
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(chunk ? ost_scene_distribute(c, made->from_file, chunk, &made->mesh, &materials)
                       : ost_scene_make_mesh(c, &made->mesh, &made->from_file, &materials));
    ost_log(ctx, OST_LOG_VERBOSE, "mesh: %lld vertices, %lld tets", (long long)made->mesh->global_nodes,
            (long long)made->mesh->global_tets);
    OST_TRY_DONE(make_plan(made, made->from_file));
    OST_TRY_DONE(check_places(made));
    OST_TRY_DONE(make_field(made, &materials));
    OST_TRY_DONE(ost_agree(ctx, treat_nearly_incompressible(made)));
    warn_of_changing_volume(made);
done:
    ost_scene_materials_release(&materials);
    return status;
}

/* Without a chunk the mesh is the case's. */
static OstStatus create(const OstCase *c, const OstScene *coarse, OstMeshChunk **chunk, OstScene **scene)
{
    OstContext *ctx = c->ctx;
    OstScene *made = NULL;
    OstStatus status = OST_NEW(ctx, &made, 1);
    if (status == OST_SUCCESS && coarse)
        status = copy_file_materials(ctx, coarse->from_file, &made->from_file);
    status = ost_agree(ctx, status);
    if (status == OST_SUCCESS) {
        made->ctx = ctx;
        made->c = c;
        made->exact = coarse ? coarse->exact : NULL;
        status = fill(made, chunk);
        OST_THEN(coarse ? OST_SUCCESS : ost_scene_check_fit(c, made->mesh));
    }
    if (status != OST_SUCCESS)
        ost_scene_destroy(&made);
    *scene = made;
    return status;
}

OstStatus ost_scene_create(const OstCase *c, OstScene **scene)
{
    return create(c, NULL, NULL, scene);
}

OstStatus ost_scene_create_on(const OstCase *c, OstMeshChunk **chunk, OstScene **scene)
{
    const OstStatus status = create(c, NULL, chunk, scene);
    ost_chunk_destroy(chunk);
    return status;
}

OstStatus ost_scene_create_finer(const OstScene *coarse, const OstCase *c, OstMeshChunk **chunk, OstScene **scene)
{
    const OstStatus status = create(c, coarse, chunk, scene);
    ost_chunk_destroy(chunk);
    return status;
}

OstStatus ost_scene_load_case(const OstScene *scene, int number, OstScene **of_case)
{
    OstContext *ctx = scene->ctx;
    OstScene *made = NULL;
    *of_case = NULL;
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &made, 1)));
    *made = *scene;
    made->c = scene->c->load_cases[number].c;
    made->load_effect = NULL;
    made->drive = NULL;
    made->borrows = 1;
    OstStatus status = make_plan(made, scene->from_file);
    OST_THEN(check_places(made));
    if (status != OST_SUCCESS)
        ost_scene_destroy(&made);
    *of_case = made;
    return status;
}

void ost_scene_destroy(OstScene **scene)
{
    if (!*scene)
        return;
    OST_FREE((*scene)->load_effect, (*scene)->drive);
    if ((*scene)->borrows) {
        OST_FREE(*scene);
        return;
    }
    ost_file_materials_destroy(&(*scene)->from_file);
    ost_field_destroy(&(*scene)->field);
    ost_mesh_destroy(&(*scene)->mesh);
    OST_FREE(*scene);
}

const OstMesh *ost_scene_mesh(const OstScene *scene)
{
    return scene->mesh;
}

OstFormulation ost_scene_formulation(const OstScene *scene)
{
    const int is_on = scene->c->large_rotation == OST_LARGE_ROTATION_ON;
    return is_on && ost_effect_on(&scene->plan.effects, OST_EFFECT_LARGE_ROTATION) ? scene->c->formulation
                                                                                   : OST_FORMULATION_LINEAR;
}

const OstMaterialField *ost_scene_field(const OstScene *scene)
{
    return scene->field;
}

unsigned ost_scene_result_fields(const OstScene *scene)
{
    const unsigned error = 1U << OST_FIELD_ERROR, asked = ost_case_recovers(scene->c);
    const unsigned factors = OST_LOAD_FACTORS;
    const OstEffects *effects = &scene->plan.effects;
    return (ost_effect_on(effects, OST_EFFECT_RECOVERY) ? asked & ~(error | factors) : 0U) |
           (ost_effect_on(effects, OST_EFFECT_STRENGTH) ? factors : 0U) |
           (ost_effect_on(effects, OST_EFFECT_ERROR_ESTIMATE) ? asked & error : 0U);
}
