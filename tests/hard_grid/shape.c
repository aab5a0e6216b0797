/* SPDX-License-Identifier: BSD-3-Clause */
#include "hard_grid/grid.h"

#include <math.h>
#include <string.h>

/* A body: a tube, or a box from the origin, whose cells may be moved and marked (hard_mesh.c). */
typedef struct HardShape {
    const char *name;
    double size[3];
    OstLocal divisions[HARD_ORDERS][3]; /* of linear and of quadratic tets; the tube's are axial, around, radial */
    char *constrained, *pulled;         /* boundaries */
    double contrast;                    /* Young's modulus of the inclusions over that of the rest */
    double cylinder[3];                 /* a point of the line about which cylindrical axes turn */
    int cylinder_axis;
} HardShape;

static char ends[] = "ends", xmin[] = "xmin", xmax[] = "xmax";

/* Little more than the size up to which every case is factored (3000 unknowns). */
static const HardShape shapes[HARD_SHAPES] = {
    {"tube", {0.0}, {{18, 20, 3}, {8, 12, 1}}, ends, NULL, 1.0, {0.0, 0.0, 0.0}, 1},
    {"beam", {100.0, 1.0, 1.0}, {{100, 3, 3}, {70, 1, 1}}, xmin, xmax, 1.0, {50.0, -20.0, 0.5}, 2},
    {"plate", {1000.0, 1000.0, 1.0}, {{22, 22, 2}, {11, 11, 1}}, xmin, xmax, 1.0, {-300.0, 500.0, 0.0}, 2},
    {"slivers", {1.0, 1.0, 1.0}, {{12, 12, 9}, {6, 6, 5}}, xmin, xmax, 1.0, {-0.3, 0.5, 0.0}, 2},
    {"layers", {1.0, 1.0, 1.0}, {{11, 11, 10}, {6, 6, 4}}, xmin, xmax, 1.0, {-0.3, 0.5, 0.0}, 2},
    {"soft", {1.0, 1.0, 1.0}, {{12, 12, 8}, {8, 4, 4}}, xmin, xmax, 1e-9, {-0.3, 0.5, 0.0}, 2},
    {"stiff", {1.0, 1.0, 1.0}, {{12, 12, 8}, {8, 4, 4}}, xmin, xmax, 1e9, {-0.3, 0.5, 0.0}, 2},
    {"checker", {1.0, 1.0, 1.0}, {{12, 10, 10}, {6, 6, 4}}, xmin, xmax, 1e-9, {-0.3, 0.5, 0.0}, 2},
};

const char *hard_shape_name(int shape)
{
    return shapes[shape].name;
}

int hard_find_shape(const char *name)
{
    for (int s = 0; s < HARD_SHAPES; s++)
        if (strcmp(shapes[s].name, name) == 0)
            return s;
    return -1;
}

double hard_contrast(int shape)
{
    return shapes[shape].contrast;
}

void hard_cylinder(int shape, double origin[3], double axis[3])
{
    memcpy(origin, shapes[shape].cylinder, 3 * sizeof *origin);
    memset(axis, 0, 3 * sizeof *axis);
    axis[shapes[shape].cylinder_axis] = 1.0;
}

/* The divisions for about point->size unknowns, in the proportions of the small body. */
static void divide(const HardPoint *point, OstLocal divisions[3])
{
    const OstLocal *small = shapes[point->shape].divisions[point->order - 1];
    const int tube = point->shape == 0;
    double nodes = 1.0, factor = 1.0;
    for (int d = 0; d < 3; d++) /* a tube closes around */
        nodes *= point->order * small[d] + (tube && d == 1 ? 0 : 1);
    if (point->size > 0)
        factor = cbrt((double)point->size / (3.0 * nodes));
    for (int d = 0; d < 3; d++)
        divisions[d] = (OstLocal)fmax(1.0, round(factor * small[d]));
}

/* The tube of Li and Barbič's Fig. 6, coarser, pulled as theirs. */
static void place_tube(const OstLocal *n, HardCase *hard)
{
    hard->c.mesh_kind = OST_MESH_TUBE;
    hard->c.tube =
        (OstTubeShape){.axis = 1, .length = 10.0, .radii = {0.9, 1.5}, .axial = n[0], .around = n[1], .radial = n[2]};
    hard->load.on = (OstSelection){.kind = OST_SELECT_NEAREST, .point = {1.5, 5.0, 0.0}, .tolerance = -1.0};
    hard->load.share = OST_SHARE_VERTICES;
    hard->load.vector[0] = 1.0;
}

static void place_block(const HardShape *shape, const OstLocal *n, HardCase *hard)
{
    hard->c.mesh_kind = OST_MESH_BLOCK;
    for (int d = 0; d < 3; d++) {
        hard->c.block.size[d] = shape->size[d];
        hard->c.block.divisions[d] = n[d];
        hard->load.vector[d] = d == 2 ? 1.0 : 0.3;
    }
    hard->pulled = shape->pulled;
    hard->load.on = (OstSelection){.kind = OST_SELECT_BOUNDARY, .boundaries = {1, &hard->pulled}, .tolerance = -1.0};
}

void hard_place(const HardPoint *point, HardCase *hard)
{
    const HardShape *shape = &shapes[point->shape];
    OstLocal n[3];
    divide(point, n);
    hard->load.kind = OST_LOAD_TOTAL_FORCE;
    if (point->shape == 0)
        place_tube(n, hard);
    else
        place_block(shape, n, hard);
    hard->constrained = shape->constrained;
    hard->constraint.kind = OST_CONSTRAIN_DISPLACEMENT;
    hard->constraint.on =
        (OstSelection){.kind = OST_SELECT_BOUNDARY, .boundaries = {1, &hard->constrained}, .tolerance = -1.0};
    if (point->flaw == HARD_LOOSE)
        hard->constraint.on.kind = OST_SELECT_NEAREST;
    if (point->flaw == HARD_NOT_A_NUMBER)
        hard->load.vector[1] = NAN;
    for (int d = 0; d < 3; d++)
        hard->constraint.constrained[d] = 1;
}

OstStatus hard_make_case(OstContext *ctx, const HardPoint *point, HardCase *hard)
{
    static char path[] = "hard grid";
    *hard = (HardCase){.c = {.ctx = ctx, .path = path, .title = path, .order = point->order}};
    hard->c.solver = ost_solver_default_options();
    hard->c.solver.accept_attainable = 1;
    if (!point->usual &&
        (point->size > 0 || point->iterated)) { /* a byte: nothing is factored but multigrid's coarsest level */
        hard->c.solver.factor_memory = 1.0;
        if (point->iterations > 0)
            hard->c.solver.max_iterations = point->iterations;
    }
    hard->c.constraint_count = hard->c.load_count = 1;
    hard->c.constraints = &hard->constraint;
    hard->c.loads = &hard->load;
    hard_place(point, hard);
    return hard_materials(ctx, point, hard);
}
