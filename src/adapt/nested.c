/* SPDX-License-Identifier: BSD-3-Clause */
#include "adapt/nested.h"

/* `by_vertex`: does what acts there act on each vertex? */
static int stays(const OstSelection *on, int by_vertex)
{
    switch (on->kind) {
    case OST_SELECT_VERTICES:
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

int ost_is_same_on_finer(const OstCase *c, const OstMaterialField *field)
{
    int keeps = field->form == OST_SPLIT_NOT;
    for (int r = 0; r < field->region_count; r++)
        keeps &= !field->region_varies[r];
    for (int k = 0; k < c->constraint_count; k++) {
        const OstConstraint *constraint = &c->constraints[k];
        keeps &= constraint->kind != OST_CONSTRAIN_TIED && constraint->kind != OST_CONSTRAIN_PERIODIC &&
                 stays(&constraint->on, 0);
    }
    for (int k = 0; k < c->spring_count; k++)
        keeps &= stays(&c->springs[k].on, c->springs[k].kind == OST_SPRING_POINT);
    for (int k = 0; k < c->load_count; k++)
        keeps &= load_stays(&c->loads[k]);
    return keeps;
}
