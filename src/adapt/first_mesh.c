/* SPDX-License-Identifier: BSD-3-Clause */
#include "adapt/first_mesh.h"

#include "assembly/loads.h"
#include "case/select.h"
#include "core/error.h"
#include "core/memory.h"

#include <math.h>
#include <string.h>

void ost_first_mesh_clear(OstFirstMesh *first)
{
    OST_FREE(first->watch, first->load, first->constraint, first->spring);
    OST_FREE(first->area);
}

static OstStatus copy_lists(OstCase *c, OstFirstMesh *first)
{
    OST_TRY(OST_NEW(c->ctx, &first->watch, c->watch_count));
    OST_TRY(OST_NEW(c->ctx, &first->load, c->load_count));
    OST_TRY(OST_NEW(c->ctx, &first->constraint, c->constraint_count));
    OST_TRY(OST_NEW(c->ctx, &first->spring, c->spring_count));
    OST_TRY(OST_NEW(c->ctx, &first->area, c->load_count + c->constraint_count + c->spring_count));
    for (int k = 0; k < c->watch_count; k++)
        first->watch[k] = c->watches[k];
    for (int k = 0; k < c->load_count; k++)
        first->load[k] = c->loads[k];
    for (int k = 0; k < c->constraint_count; k++)
        first->constraint[k] = c->constraints[k];
    for (int k = 0; k < c->spring_count; k++)
        first->spring[k] = c->springs[k];
    return OST_SUCCESS;
}

static OstStatus place_all(const OstScene *scene, OstFirstMesh *first)
{
    const OstCase *c = scene->c;
    for (int k = 0; k < c->watch_count; k++)
        OST_TRY(ost_watch_place(scene->mesh, &first->watch[k]));
    for (int k = 0; k < c->load_count; k++)
        if (!ost_load_in_volume(c->loads[k].kind))
            OST_TRY(ost_place_at_vertex(scene->mesh, &first->load[k].on));
    for (int k = 0; k < c->constraint_count; k++)
        OST_TRY(ost_place_at_vertex(scene->mesh, &first->constraint[k].on));
    for (int k = 0; k < c->spring_count; k++)
        OST_TRY(ost_place_at_vertex(scene->mesh, &first->spring[k].on));
    return OST_SUCCESS;
}

/* --- areas --- */

/* Load, constraint or spring number k of all; NULL for a load in the volume. */
static const OstSelection *selection_of(const OstCase *c, int k, const char **what, int *line)
{
    const int constraint = k - c->load_count, spring = constraint - c->constraint_count;
    if (k < c->load_count) {
        *what = "load";
        *line = c->loads[k].line;
        return ost_load_in_volume(c->loads[k].kind) ? NULL : &c->loads[k].on;
    }
    *what = spring < 0 ? "support" : "spring";
    *line = spring < 0 ? c->constraints[constraint].line : c->springs[spring].line;
    return spring < 0 ? &c->constraints[constraint].on : &c->springs[spring].on;
}

static OstStatus find_area(const OstScene *scene, const OstSelection *on, double *area)
{
    OstLocal count = 0, *faces = NULL;
    int nodes_per_face = 0;
    OST_TRY(ost_select_faces(scene->c, scene->mesh, on, &count, &nodes_per_face, &faces));
    const OstStatus status = ost_faces_area(scene->mesh, count, faces, nodes_per_face, area);
    OST_FREE(faces);
    return status;
}

static OstStatus find_first_areas(const OstScene *scene, OstFirstMesh *first)
{
    const OstCase *c = scene->c;
    const char *what;
    int line;
    for (int k = 0; k < c->load_count + c->constraint_count + c->spring_count; k++) {
        const OstSelection *on = selection_of(c, k, &what, &line);
        first->area[k] = NAN;
        if (on && ost_selection_varies(on))
            OST_TRY(find_area(scene, on, &first->area[k]));
    }
    return OST_SUCCESS;
}

OstStatus ost_first_mesh_compare(OstFirstMesh *first, const OstScene *scene, double share)
{
    const OstCase *c = scene->c;
    const char *what;
    int line;
    for (int k = 0; k < c->load_count + c->constraint_count + c->spring_count; k++) {
        const OstSelection *on = selection_of(c, k, &what, &line);
        double area = 0.0;
        if (isnan(first->area[k]))
            continue;
        OST_TRY(find_area(scene, on, &area));
        if (fabs(area - first->area[k]) <= share * fmax(area, first->area[k]))
            continue;
        ost_warn(c->ctx,
                 "%s:%d: the faces that this %s selects cover an area of %.4g on the first mesh and %.4g on a finer "
                 "one: the border of the selection is no line of the mesh, so that each mesh has another %s, which no "
                 "estimate of the error knows of; make these faces a boundary of the mesh, or let the selection end "
                 "at edges of the first mesh",
                 c->path, line, what, first->area[k], area, what);
        first->area[k] = NAN;
    }
    return OST_SUCCESS;
}

OstStatus ost_first_mesh_keep(const OstScene *scene, OstCase *c, OstFirstMesh *first)
{
    OST_TRY(ost_agree(c->ctx, copy_lists(c, first)));
    OST_TRY(place_all(scene, first));
    OST_TRY(find_first_areas(scene, first));
    c->watches = first->watch;
    c->loads = first->load;
    c->constraints = first->constraint;
    c->springs = first->spring;
    return OST_SUCCESS;
}
