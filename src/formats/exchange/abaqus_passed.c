/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "formats/exchange/abaqus.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* What Abaqus's and CalculiX's models state beside their mesh, and what a case says in its place. */

static const OstPassedWay ways[] = {
    {"*TIE", ""},
    {"*COUPLING", ""},
    {"*RIGID BODY", "a rigid body is a boundary with rigid, or a region of a far larger modulus"},
    {"*KINEMATIC COUPLING", ost_way_joined},
    {"*DISTRIBUTING COUPLING", "a force or motion of a point is a total_force with at, or distributing, under loads"},
    {"*MPC", ost_way_joined},
    {"*EQUATION", ost_way_joined},
    {"*EMBEDDED ELEMENT", ost_way_joined},
    {"*SHELL TO SOLID COUPLING", ost_way_joined},
    {"*CYCLIC SYMMETRY MODEL", ost_way_joined},
    {"*CONTACT PAIR", ost_way_contact},
    {"*CONTACT", ost_way_contact},
    {"*CONTACT INCLUSIONS", ost_way_contact},
    {"*GAP", ost_way_contact},
    {"*SHELL SECTION", ost_way_thin},
    {"*SHELL GENERAL SECTION", ost_way_thin},
    {"*MEMBRANE SECTION", ost_way_thin},
    {"*BEAM SECTION", ost_way_thin},
    {"*BEAM GENERAL SECTION", ost_way_thin},
    {"*REBAR LAYER", ost_way_thin},
    {"*SPRING", ost_way_spring},
    {"*FOUNDATION", ost_way_spring},
    {"*CONNECTOR SECTION", ost_way_spring},
    {"*ORIENTATION", ost_way_axes},
    {"*PRE-TENSION SECTION", "a bolt's tension is an eigenstrain of its region"},
    {"*INITIAL CONDITIONS", "what strains by itself is an eigenstrain"},
    {"*TEMPERATURE", "what strains by itself is an eigenstrain"},
};

OstStatus ost_inp_pass(OstInp *inp, const OstInpKeyword *keyword)
{
    char name[OST_INP_WORD + 1];
    snprintf(name, sizeof name, "*%s", keyword->name);
    return ost_passed_take(inp->ctx, ways, sizeof ways / sizeof *ways, name, &inp->passed);
}

static OstStatus add_join(OstInp *inp, OstInpJoinKind kind, OstInpJoin **join)
{
    OST_TRY(OST_RESIZE(inp->ctx, &inp->join, inp->join_count + 1));
    *join = &inp->join[inp->join_count++];
    **join = (OstInpJoin){.kind = kind};
    return OST_SUCCESS;
}

OstStatus ost_inp_begin_tie(OstInp *inp, const OstInpKeyword *keyword)
{
    const char *tolerance = ost_inp_value(keyword, "POSITIONTOLERANCE");
    inp->tolerance = tolerance ? strtod(tolerance, NULL) : 0.0;
    inp->block = OST_INP_TIE;
    return ost_inp_pass(inp, keyword);
}

/* The surface that follows, and the one that it follows. */
OstStatus ost_inp_tie_line(OstInp *inp)
{
    OstInpJoin *join = NULL;
    OST_TRY(add_join(inp, OST_INP_TIED, &join));
    ost_inp_word(inp->lines, join->on);
    ost_inp_word(inp->lines, join->to);
    join->tolerance = inp->tolerance;
    return OST_SUCCESS;
}

OstStatus ost_inp_coupling(OstInp *inp, const OstInpKeyword *keyword)
{
    OstInpJoin *join = NULL;
    OST_TRY(add_join(inp, OST_INP_RIGID, &join));
    if (!ost_inp_set_name(keyword, "SURFACE", join->on) && !ost_inp_set_name(keyword, "NSET", join->on) &&
        !ost_inp_set_name(keyword, "TIENSET", join->on))
        ost_inp_set_name(keyword, "PINNSET", join->on);
    ost_inp_set_name(keyword, "REFNODE", join->to);
    if (strcmp(keyword->name, "RIGIDBODY") == 0 && !join->on[0]) /* one of elements is left to words */
        inp->join_count--;
    return ost_inp_pass(inp, keyword);
}

/* *KINEMATIC and *DISTRIBUTING follow their *COUPLING. */
void ost_inp_distribute(OstInp *inp)
{
    if (inp->join_count > 0 && inp->join[inp->join_count - 1].kind == OST_INP_RIGID)
        inp->join[inp->join_count - 1].kind = OST_INP_DISTRIBUTED;
}

/* The first of some directions, and the last; before them, in *KINEMATIC COUPLING, which nodes. */
void ost_inp_kinematic_line(OstInp *inp)
{
    char first[OST_INP_WORD], last[OST_INP_WORD];
    OstInpJoin *join = inp->join_count > 0 ? &inp->join[inp->join_count - 1] : NULL;
    if (join && inp->block == OST_INP_KINEMATIC_NODES)
        ost_inp_word(inp->lines, join->on);
    ost_inp_word(inp->lines, first);
    ost_inp_word(inp->lines, last);
    const int from = atoi(first), to = last[0] ? atoi(last) : from;
    for (int d = from > 0 ? from : 1; join && d <= to && d <= 6; d++)
        if (!strchr(join->directions, '0' + d))
            ost_append(join->directions, sizeof join->directions, "%d", d);
}

OstStatus ost_inp_begin_orientation(OstInp *inp, const OstInpKeyword *keyword)
{
    const char *system = ost_inp_value(keyword, "SYSTEM"), *by = ost_inp_value(keyword, "DEFINITION");
    OST_TRY(OST_RESIZE(inp->ctx, &inp->orientation, inp->orientation_count + 1));
    OstInpOrientation *last = &inp->orientation[inp->orientation_count++];
    *last = (OstInpOrientation){.is_cylinder = system && toupper((unsigned char)system[0]) == 'C'};
    ost_inp_set_name(keyword, "NAME", last->name);
    last->is_plain =
        (!system || last->is_cylinder || strcasecmp(system, "RECTANGULAR") == 0 || strcasecmp(system, "R") == 0) &&
        (!by || strcasecmp(by, "COORDINATES") == 0);
    inp->block = OST_INP_ORIENTATION;
    return OST_SUCCESS;
}

/* Two points or three, then the axis and degrees of a turn. What is no number, a distribution's name, is not told. */
void ost_inp_orientation_line(OstInp *inp)
{
    OstInpOrientation *last = &inp->orientation[inp->orientation_count - 1];
    char word[OST_INP_WORD], *end = NULL;
    for (int w = 0; w < 9 && !ost_lines_ended(inp->lines); w++) {
        ost_inp_word(inp->lines, word);
        if (word[0] == '\0' && *inp->lines->next == ',')
            inp->lines->next++;
        const double value = strtod(word, &end);
        last->is_plain &= end != word && *end == '\0';
        if (last->lines == 0)
            last->point[w] = value;
        else if (w == 0)
            last->about = (int)value;
        else
            last->degrees = value;
    }
    last->lines++;
}

OstStatus ost_inp_oriented(OstInp *inp, const OstInpKeyword *keyword)
{
    static const OstInpKeyword word = {.name = "ORIENTATION"};
    if (!ost_inp_value(keyword, "ORIENTATION"))
        return OST_SUCCESS;
    OST_TRY(OST_RESIZE(inp->ctx, &inp->section, inp->section_count + 1));
    OstInpSection *last = &inp->section[inp->section_count++];
    *last = (OstInpSection){.set = ""};
    ost_inp_set_name(keyword, "ELSET", last->set);
    ost_inp_set_name(keyword, "ORIENTATION", last->orientation);
    return ost_inp_pass(inp, &word);
}

/* --- in the end --- */

/* The boundary's name, which has the instance's before it where there are several; "..." if nothing was read of it. */
static const char *boundary_name(const OstInp *inp, const char *word, char text[OST_YAML_NAME])
{
    static const OstSetKind kinds[] = {OST_SET_OF_FACES, OST_SET_OF_FREE, OST_SET_OF_CELLS, OST_SET_OF_NODES};
    const char *name = NULL;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds && !name; k++) {
        const int set = ost_inp_find_set(inp, kinds[k], word);
        name = set >= 0 && inp->cells.set[set].count > 0 ? inp->cells.set[set].name : NULL;
    }
    if (!name)
        return "...";
    return ost_yaml_name(name[0] == '"' ? name + 1 : name, text);
}

/* A reference point: a node by its number, or the first of a set. */
static const double *find_point(const OstInp *inp, const char *word)
{
    const OstMeshChunk *chunk = inp->cells.chunk;
    const int set = ost_inp_find_set(inp, OST_SET_OF_NODES, word);
    const char *dot = strrchr(word, '.');
    const OstGlobal label = set >= 0 && inp->cells.set[set].count > 0
                                ? inp->cells.set[set].item[0]
                                : ost_inp_number(inp, OST_SET_OF_NODES, word, strtoll(dot ? dot + 1 : word, NULL, 10));
    for (OstLocal n = 0; n < chunk->node_count; n++)
        if (chunk->node_label[n] == label)
            return chunk->coordinates + 3 * (size_t)n;
    return NULL;
}

static void tell_tie(OstInp *inp, const OstInpJoin *join)
{
    char on[OST_YAML_NAME], to[OST_YAML_NAME], tolerance[48] = "";
    if (join->tolerance > 0.0)
        snprintf(tolerance, sizeof tolerance, ", tolerance: %g", join->tolerance);
    ost_passed_line(&inp->passed, "\n  constraints: - {on: {boundary: %s}, tied_to: {boundary: %s}%s}",
                    boundary_name(inp, join->on, on), boundary_name(inp, join->to, to), tolerance);
}

static void tell_coupling(OstInp *inp, const OstInpJoin *join)
{
    char on[OST_YAML_NAME], at[96] = "[x, y, z]";
    const double *x = find_point(inp, join->to);
    if (x)
        snprintf(at, sizeof at, "[%.7g, %.7g, %.7g]", x[0], x[1], x[2]);
    ost_passed_point(&inp->passed, boundary_name(inp, join->on, on), at, join->kind == OST_INP_DISTRIBUTED,
                     join->directions);
}

/* e1 goes through the first point, the second lies in the plane of e1 and e2; then they turn about one of them. */
static int axes_of(const OstInpOrientation *turned, double e[3][3])
{
    const double *a = turned->point, *b = turned->point + 3, *origin = turned->point + 6;
    const double angle = turned->degrees * 3.14159265358979323846 / 180.0, c = cos(angle), s = sin(angle);
    const int i = turned->about % 3, j = (turned->about + 1) % 3; /* the two that turn, from 0 */
    for (int d = 0; d < 3; d++) {
        e[0][d] = a[d] - origin[d];
        e[1][d] = b[d] - origin[d];
    }
    ost_cross3(e[0], e[1], e[2]);
    ost_cross3(e[2], e[0], e[1]);
    for (int k = 0; k < 3; k++) {
        const double length = ost_norm3(e[k]);
        if (!(length > 0.0))
            return 0;
        for (int d = 0; d < 3; d++)
            e[k][d] = fabs(e[k][d]) < 1e-12 * length ? 0.0 : e[k][d] / length;
    }
    for (int d = 0; d < 3 && turned->about > 0; d++) {
        const double first = e[i][d], second = e[j][d];
        e[i][d] = c * first + s * second;
        e[j][d] = c * second - s * first;
    }
    return 1;
}

static void tell_axes(OstInp *inp, const OstInpOrientation *turned, const char *set)
{
    char region[OST_YAML_NAME];
    double e[3][3];
    const double *p = turned->point;
    ost_yaml_name(set[0] == '"' ? set + 1 : set, region);
    if (!turned->is_cylinder && axes_of(turned, e))
        ost_passed_line(
            &inp->passed,
            "\n  materials: - {region: %s, axes: {fixed: {e1: [%.9g, %.9g, %.9g], e2: [%.9g, %.9g, %.9g]}}, "
            "...}",
            region, e[0][0], e[0][1], e[0][2], e[1][0], e[1][1], e[1][2]);
    else if (turned->is_cylinder && turned->degrees == 0.0)
        ost_passed_line(&inp->passed,
                        "\n  materials: - {region: %s, axes: {cylindrical: {origin: [%.9g, %.9g, %.9g], axis: [%.9g, "
                        "%.9g, %.9g], order: [radial, tangential, axial]}}, ...}",
                        region, p[0], p[1], p[2], p[3] - p[0], p[4] - p[1], p[5] - p[2]);
}

/* Axes of a part that is turned with its instance, or by a distribution, are left to words; so are those of a set of
 * the same name in several parts. */
static const OstInpOrientation *plain_orientation(const OstInp *inp, const OstInpSection *section)
{
    const OstInpOrientation *turned = NULL;
    int same = 0;
    for (int o = 0; o < inp->orientation_count; o++)
        if (inp->cells.same_names(inp->orientation[o].name, section->orientation))
            turned = &inp->orientation[o];
    for (int s = 0; s < inp->section_count; s++)
        same += inp->cells.same_names(inp->section[s].set, section->set);
    for (int i = 0; i < inp->instance_count; i++)
        same += inp->instance[i].lines > 1;
    return same == 1 && turned && turned->is_plain && turned->lines > 0 && turned->about >= 0 && turned->about <= 3
               ? turned
               : NULL;
}

/* The section's set, or that of each instance: ARM-1.WOOD. */
static void tell_section(OstInp *inp, const OstInpSection *section)
{
    const OstInpOrientation *turned = plain_orientation(inp, section);
    for (int s = 0; s < inp->cells.set_count && turned; s++) {
        const OstCellSet *set = &inp->cells.set[s];
        const char *dot = inp->instance_count > 1 ? strrchr(set->name, '.') : NULL;
        if (set->kind == OST_SET_OF_CELLS && inp->cells.same_names(dot ? dot + 1 : set->name, section->set))
            tell_axes(inp, turned, set->name);
    }
}

void ost_inp_warn_passed(OstInp *inp)
{
    inp->of = -1;
    for (int s = 0; s < inp->section_count; s++)
        tell_section(inp, &inp->section[s]);
    for (int j = 0; j < inp->join_count; j++)
        if (inp->join[j].kind == OST_INP_TIED)
            tell_tie(inp, &inp->join[j]);
        else
            tell_coupling(inp, &inp->join[j]);
    ost_passed_warn(inp->ctx, inp->cells.path, &inp->passed);
}
