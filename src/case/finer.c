/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/sections.h"
#include "core/error.h"
#include "orthostat/field.h"

/* `by_vertex`: does what acts there act on each vertex? */
static int stays(const OstSelection *on, int by_vertex)
{
    switch (on->kind) {
    case OST_SELECT_VERTICES:
    case OST_SELECT_NEAREST:
        return 1;
    case OST_SELECT_ALL:
    case OST_SELECT_BOUNDARY:
    case OST_SELECT_PLANE:
        return !by_vertex;
    default:
        return 0;
    }
}

static int load_stays(const OstLoad *load)
{
    if (load->kind == OST_LOAD_DISTRIBUTING)
        return 0;
    return ost_load_in_volume(load->kind) ||
           stays(&load->on, load->kind == OST_LOAD_POINT_FORCE || load->share == OST_SHARE_VERTICES);
}

int ost_case_stays(const OstCase *c)
{
    int keeps = 1;
    for (int k = 0; k < c->constraint_count; k++) {
        const OstConstraint *constraint = &c->constraints[k];
        keeps &= constraint->kind == OST_CONSTRAIN_PERIODIC ||
                 (constraint->kind != OST_CONSTRAIN_TIED && stays(&constraint->on, 0));
    }
    for (int k = 0; k < c->spring_count; k++)
        keeps &= stays(&c->springs[k].on, c->springs[k].kind == OST_SPRING_POINT);
    for (int k = 0; k < c->load_count; k++)
        keeps &= load_stays(&c->loads[k]);
    return keeps;
}

static OstStatus raise_each_vertex(const OstCase *c, int line, const char *what, const char *instead, const char *to)
{
    return OST_RAISE(c->ctx, OST_INVALID_INPUT,
                     "%s:%d: %s acts on each vertex that is selected, and a finer mesh has more of them: the answer "
                     "would be that of another load. %s, use %s, or name the vertices (vertices: [...])",
                     c->path, line, what, to, instead);
}

OstStatus ost_case_check_finer(const OstCase *c, const char *to)
{
    for (int k = 0; k < c->load_count; k++)
        if (c->loads[k].kind == OST_LOAD_POINT_FORCE && !stays(&c->loads[k].on, 1))
            return raise_each_vertex(c, c->loads[k].line, "a point_force", "total_force", to);
    for (int k = 0; k < c->spring_count; k++)
        if (c->springs[k].kind == OST_SPRING_POINT && !stays(&c->springs[k].on, 1))
            return raise_each_vertex(c, c->springs[k].line, "a spring", "foundation (stiffness by area)", to);
    return OST_SUCCESS;
}

OstStatus ost_settle_accuracy(OstCase *c)
{
    if (!c->asks_error || c->path_steps > 0)
        return OST_SUCCESS;
    for (int i = 0; i < c->material_count && c->order == 0; i++) {
        double eigenvalues[3];
        if (ost_orthotropic_eigenvalues(c->ctx, &c->materials[i].material.constants, eigenvalues) == OST_SUCCESS &&
            ost_has_one_stiff_mode(eigenvalues, OST_NEARLY_INCOMPRESSIBLE))
            c->order = 2;
    }
    return ost_case_check_finer(c, "To ask for an accuracy");
}
