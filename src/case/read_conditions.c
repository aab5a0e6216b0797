/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/sections.h"
#include "case/yaml/message.h"
#include "core/error.h"
#include "core/memory.h"

#include <math.h>

static OstStatus read_component(const OstYaml *yaml, const OstYamlNode *item, int *constrained, double *value)
{
    *constrained = !ost_yaml_says(yaml, item, "free");
    if (ost_yaml_says(yaml, item, "null") || ost_yaml_says(yaml, item, "~"))
        return ost_yaml_raise_type(yaml, item, "a number or the word free", "");
    return *constrained ? ost_yaml_number(yaml, item, value) : OST_SUCCESS;
}

/* Three components, each a number or the word free. */
static OstStatus read_components(const OstYaml *yaml, const OstYamlNode *node, int constrained[3], double value[3])
{
    static const char expected[] = "a list of three, each a number or the word free";
    int count;
    OST_TRY(ost_yaml_list(yaml, node, expected, &count));
    if (count != 3)
        return ost_yaml_raise_type(yaml, node, expected, "");
    const OstYamlNode *item = ost_yaml_first(yaml, node);
    for (int i = 0; i < 3; i++, item = ost_yaml_next(yaml, item))
        OST_TRY(read_component(yaml, item, &constrained[i], &value[i]));
    return OST_SUCCESS;
}

/* Three components, each a number or the word free or exact; or the one word exact, which stands for the closed-form
 * solution of the case (assembly/closed_form.h). */
static OstStatus read_displacement(const OstYaml *yaml, const OstYamlNode *node, OstConstraint *constraint)
{
    static const char expected[] = "a list of three, each a number or the word free";
    int count;
    if (ost_yaml_says(yaml, node, "exact")) {
        for (int i = 0; i < 3; i++)
            constraint->constrained[i] = constraint->exact[i] = 1;
        return OST_SUCCESS;
    }
    OST_TRY(ost_yaml_list(yaml, node, expected, &count));
    if (count != 3)
        return ost_yaml_raise_type(yaml, node, expected, "");
    const OstYamlNode *item = ost_yaml_first(yaml, node);
    for (int i = 0; i < 3; i++, item = ost_yaml_next(yaml, item)) {
        constraint->exact[i] = constraint->constrained[i] = ost_yaml_says(yaml, item, "exact");
        if (!constraint->exact[i])
            OST_TRY(read_component(yaml, item, &constraint->constrained[i], &constraint->displacement[i]));
    }
    if (!constraint->constrained[0] && !constraint->constrained[1] && !constraint->constrained[2])
        return ost_yaml_raise(yaml, node,
                              "every component is free, so this constraint constrains nothing; leave it out");
    return OST_SUCCESS;
}

static OstStatus read_displacement_time(const OstYaml *yaml, const OstYamlNode *node, OstCase *c,
                                        OstConstraint *constraint)
{
    if (!ost_constraint_moves(constraint))
        return ost_yaml_raise(yaml, node, "'time' belongs to a displacement other than zero; leave it out here");
    return ost_read_time(yaml, node, c, &constraint->table);
}

static OstStatus read_turn(const OstYaml *yaml, const OstYamlNode *node, int *constrained, double *turn)
{
    OST_TRY(read_components(yaml, node, constrained, turn));
    for (int i = 0; i < 3; i++)
        if (fabs(turn[i]) > 6.3)
            ost_warn(yaml->ctx,
                     "%s:%d: a rotation of %.6g is in radians, and more than a whole turn; 90 degrees are 1.5708",
                     yaml->path, ost_yaml_line(node), turn[i]);
    return OST_SUCCESS;
}

/* A point, or {at, displacement, rotation}. */
static OstStatus read_rigid(const OstYaml *yaml, const OstYamlNode *node, OstConstraint *constraint)
{
    enum { AT, DISPLACEMENT, ROTATION };
    OstYamlKey keys[] = {
        [AT] = {.name = "at", .needed = 1},
        [DISPLACEMENT] = {.name = "displacement"},
        [ROTATION] = {.name = "rotation"},
    };
    if (ost_yaml_is(yaml, node, OST_YAML_SEQUENCE))
        return ost_yaml_numbers(yaml, node, 3, constraint->point);
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(ost_yaml_numbers(yaml, keys[AT].value, 3, constraint->point));
    if (keys[DISPLACEMENT].value)
        OST_TRY(read_components(yaml, keys[DISPLACEMENT].value, constraint->constrained, constraint->displacement));
    return keys[ROTATION].value
               ? read_turn(yaml, keys[ROTATION].value, constraint->turn_constrained, constraint->rotation)
               : OST_SUCCESS;
}

static OstStatus read_strain(const OstYaml *yaml, const OstYamlNode *node, double strain[6])
{
    static const char *const names[] = {"xx", "yy", "zz", "xy", "yz", "zx"};
    OstYamlKey keys[6];
    for (int k = 0; k < 6; k++)
        keys[k] = (OstYamlKey){.name = names[k]};
    OST_TRY(ost_yaml_mapping(yaml, node, keys, 6));
    for (int k = 0; k < 6; k++)
        if (keys[k].value)
            OST_TRY(ost_yaml_number(yaml, keys[k].value, &strain[k]));
    return OST_SUCCESS;
}

/* One to three pairs of boundaries. */
static OstStatus read_pairs(const OstYaml *yaml, const OstYamlNode *node, OstConstraint *constraint)
{
    static const char expected[] = "one to three pairs of boundaries, as in [[xmin, xmax], [ymin, ymax]]";
    int count, two;
    OST_TRY(ost_yaml_list(yaml, node, expected, &count));
    if (count < 1 || count > 3)
        return ost_yaml_raise_type(yaml, node, expected, "");
    const OstYamlNode *pair = ost_yaml_first(yaml, node);
    for (int p = 0; p < count; p++, pair = ost_yaml_next(yaml, pair)) {
        OST_TRY(ost_yaml_list(yaml, pair, expected, &two));
        if (two != 2)
            return ost_yaml_raise_type(yaml, pair, expected, "");
        const OstYamlNode *name = ost_yaml_first(yaml, pair);
        OST_TRY(ost_read_string(yaml, name, &constraint->pair[p][0]));
        OST_TRY(ost_read_string(yaml, ost_yaml_next(yaml, name), &constraint->pair[p][1]));
        constraint->pair_count = p + 1;
    }
    return OST_SUCCESS;
}

enum {
    CONSTRAINT_KINDS = OST_CONSTRAIN_PERIODIC + 1,
    CONSTRAINT_ON = CONSTRAINT_KINDS,
    CONSTRAINT_TIME,
    TOLERANCE,
    STRAIN,
    CONSTRAINT_KEYS
};

/* Refuses keys that the kind of constraint does not have, and asks for those it needs. */
static OstStatus check_constraint_keys(const OstYaml *yaml, const OstYamlNode *node, const OstYamlKey *keys, int kind)
{
    const OstYamlNode *on = keys[CONSTRAINT_ON].value;
    if (kind == OST_CONSTRAIN_PERIODIC && on)
        return ost_yaml_raise(yaml, on, "'periodic' names its boundaries itself, and has no 'on'; leave it out");
    if (kind != OST_CONSTRAIN_PERIODIC && !on)
        return ost_yaml_raise(yaml, node, "'%s' needs 'on': what it constrains", keys[kind].name);
    if (kind != OST_CONSTRAIN_TIED && keys[TOLERANCE].value)
        return ost_yaml_raise(yaml, keys[TOLERANCE].value, "'tolerance' belongs to tied_to, not to '%s'",
                              keys[kind].name);
    if (kind != OST_CONSTRAIN_PERIODIC && keys[STRAIN].value)
        return ost_yaml_raise(yaml, keys[STRAIN].value, "'strain' belongs to periodic, not to '%s'", keys[kind].name);
    return OST_SUCCESS;
}

static OstStatus read_kind(const OstYaml *yaml, const OstYamlNode *node, OstConstraint *constraint)
{
    switch (constraint->kind) {
    case OST_CONSTRAIN_SLIDE:
        return ost_yaml_direction(yaml, node, constraint->normal);
    case OST_CONSTRAIN_RIGID:
        return read_rigid(yaml, node, constraint);
    case OST_CONSTRAIN_TIED:
        return ost_read_selection(yaml, node, &constraint->to);
    case OST_CONSTRAIN_PERIODIC:
        return read_pairs(yaml, node, constraint);
    case OST_CONSTRAIN_DISPLACEMENT:
        break;
    }
    return read_displacement(yaml, node, constraint);
}

static OstStatus read_constraint(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, OstConstraint *constraint)
{
    OstYamlKey keys[CONSTRAINT_KEYS] = {
        [OST_CONSTRAIN_DISPLACEMENT] = {.name = "displacement"},
        [OST_CONSTRAIN_SLIDE] = {.name = "slide"},
        [OST_CONSTRAIN_RIGID] = {.name = "rigid"},
        [OST_CONSTRAIN_TIED] = {.name = "tied_to"},
        [OST_CONSTRAIN_PERIODIC] = {.name = "periodic"},
        [CONSTRAINT_ON] = {.name = "on"},
        [CONSTRAINT_TIME] = {.name = "time"},
        [TOLERANCE] = {.name = "tolerance", .read = ost_read_tolerance, .into = &constraint->tolerance},
        [STRAIN] = {.name = "strain"},
    };
    int kind;
    constraint->tolerance = -1.0;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(ost_yaml_one_of(yaml, node, keys, CONSTRAINT_KINDS, &kind));
    OST_TRY(check_constraint_keys(yaml, node, keys, kind));
    constraint->kind = (OstConstraintKind)kind;
    constraint->line = ost_yaml_line(node);
    if (keys[CONSTRAINT_ON].value)
        OST_TRY(ost_read_selection(yaml, keys[CONSTRAINT_ON].value, &constraint->on));
    OST_TRY(read_kind(yaml, keys[kind].value, constraint));
    if (keys[STRAIN].value)
        OST_TRY(read_strain(yaml, keys[STRAIN].value, constraint->strain));
    return keys[CONSTRAINT_TIME].value ? read_displacement_time(yaml, keys[CONSTRAINT_TIME].value, c, constraint)
                                       : OST_SUCCESS;
}

OstStatus ost_read_constraints(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    int count;
    const int before = c->constraint_count;
    c->free_body |= ost_yaml_says(yaml, node, "free_body"); /* in place of a list */
    if (ost_yaml_says(yaml, node, "free_body"))
        return OST_SUCCESS;
    OST_TRY(ost_yaml_short_list(yaml, node, "a list of constraints (- {on: ..., displacement: ...})", &count));
    OST_TRY(OST_RESIZE(yaml->ctx, &c->constraints, before + count));
    c->constraint_count += count;
    const OstYamlNode *item = ost_yaml_first(yaml, node);
    for (int i = 0; i < count; i++, item = ost_yaml_next(yaml, item))
        OST_TRY(read_constraint(yaml, item, c, &c->constraints[before + i]));
    return OST_SUCCESS;
}

enum { LOAD_KINDS = OST_LOAD_DISTRIBUTING + 1, ON = LOAD_KINDS, SHARE, AT, REGION, FOLLOWS, TIME, LOAD_KEYS };

static OstStatus read_share(const OstYaml *yaml, const OstYamlNode *node, OstLoad *load)
{
    static const char *const words[] = {"faces", "vertices"};
    int word;
    OST_TRY(ost_yaml_word(yaml, node, "share", words, 2, &word));
    load->share = word == 0 ? OST_SHARE_FACES : OST_SHARE_VERTICES;
    return OST_SUCCESS;
}

/* Refuses keys that the kind of load does not have, and asks for those it needs. */
static OstStatus check_keys(const OstYaml *yaml, const OstYamlNode *node, const OstYamlKey *keys, int kind)
{
    const int on_volume = ost_load_in_volume((OstLoadKind)kind);
    const int shares = kind == OST_LOAD_TOTAL_FORCE || kind == OST_LOAD_MOMENT || kind == OST_LOAD_DISTRIBUTING;
    if (on_volume && keys[ON].value)
        return ost_yaml_raise(yaml, keys[ON].value,
                              "'%s' acts in the volume and has no 'on'; 'region: NAME' restricts it", keys[kind].name);
    if (!on_volume && !keys[ON].value)
        return ost_yaml_raise(yaml, node, "'%s' needs 'on': where it acts", keys[kind].name);
    if (!on_volume && keys[REGION].value)
        return ost_yaml_raise(yaml, keys[REGION].value,
                              "'region' belongs to gravity, body_force and centrifugal; '%s' acts where 'on' says",
                              keys[kind].name);
    if (kind != OST_LOAD_PRESSURE && keys[FOLLOWS].value)
        return ost_yaml_raise(yaml, keys[FOLLOWS].value, "'follows' belongs to pressure, not to '%s'", keys[kind].name);
    if (!shares && keys[SHARE].value)
        return ost_yaml_raise(yaml, keys[SHARE].value,
                              "'share' belongs to total_force, moment and distributing, not to '%s'", keys[kind].name);
    if (kind == OST_LOAD_MOMENT && keys[AT].value)
        return ost_yaml_raise(yaml, keys[AT].value,
                              "a moment is the same about every point: 'at' belongs to total_force; leave it out");
    if (kind != OST_LOAD_TOTAL_FORCE && keys[AT].value)
        return ost_yaml_raise(yaml, keys[AT].value, "'at' belongs to total_force, not to '%s'", keys[kind].name);
    return OST_SUCCESS;
}

/* An axis, and how fast the body turns about it. */
static OstStatus read_centrifugal(const OstYaml *yaml, const OstYamlNode *node, OstLoad *load)
{
    enum { ORIGIN, AXIS, SPEED };
    OstYamlKey keys[] = {
        [ORIGIN] = {.name = "origin"},
        [AXIS] = {.name = "axis", .needed = 1},
        [SPEED] = {.name = "angular_velocity", .needed = 1},
    };
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    if (keys[ORIGIN].value)
        OST_TRY(ost_yaml_numbers(yaml, keys[ORIGIN].value, 3, load->origin));
    OST_TRY(ost_yaml_direction(yaml, keys[AXIS].value, load->axis));
    return ost_yaml_number(yaml, keys[SPEED].value, &load->speed);
}

/* {at, displacement, rotation}: the motion of a point that the selection has in the mean. */
static OstStatus read_distributing(const OstYaml *yaml, const OstYamlNode *node, OstLoad *load)
{
    enum { POINT, DISPLACEMENT, ROTATION };
    OstYamlKey keys[] = {
        [POINT] = {.name = "at", .needed = 1},
        [DISPLACEMENT] = {.name = "displacement"},
        [ROTATION] = {.name = "rotation"},
    };
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(ost_yaml_numbers(yaml, keys[POINT].value, 3, load->at));
    load->acts_at = 1;
    if (keys[DISPLACEMENT].value)
        OST_TRY(read_components(yaml, keys[DISPLACEMENT].value, load->moved, load->motion));
    if (keys[ROTATION].value)
        OST_TRY(read_turn(yaml, keys[ROTATION].value, load->moved + 3, load->motion + 3));
    for (int k = 0; k < 6; k++)
        if (load->moved[k])
            return OST_SUCCESS;
    return ost_yaml_raise(
        yaml, node,
        "no component of the displacement or rotation is given; a force at the point is a total_force "
        "with 'at', and a moment a 'moment'");
}

/* What acts: the value of the load's own key. */
static OstStatus read_value(const OstYaml *yaml, const OstYamlNode *node, OstLoad *load)
{
    if (load->kind == OST_LOAD_PRESSURE)
        return ost_yaml_number(yaml, node, &load->pressure);
    if (load->kind == OST_LOAD_CENTRIFUGAL)
        return read_centrifugal(yaml, node, load);
    if (load->kind == OST_LOAD_DISTRIBUTING)
        return read_distributing(yaml, node, load);
    load->exact =
        (load->kind == OST_LOAD_TRACTION || load->kind == OST_LOAD_BODY_FORCE) && ost_yaml_says(yaml, node, "exact");
    return load->exact ? OST_SUCCESS : ost_yaml_numbers(yaml, node, 3, load->vector);
}

/* Did a setting make the value, or a part of it? */
static int is_set(const OstYaml *yaml, const OstYamlNode *value)
{
    int set = 0;
    for (const OstYamlNode *node = value; node < ost_yaml_next(yaml, value); node++)
        set |= ost_yaml_setting(yaml, node) != NULL;
    return set;
}

static OstStatus read_load(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, OstLoad *load)
{
    OstYamlKey keys[LOAD_KEYS] = {
        [OST_LOAD_TOTAL_FORCE] = {.name = "total_force"},
        [OST_LOAD_POINT_FORCE] = {.name = "point_force"},
        [OST_LOAD_TRACTION] = {.name = "traction"},
        [OST_LOAD_PRESSURE] = {.name = "pressure"},
        [OST_LOAD_GRAVITY] = {.name = "gravity"},
        [OST_LOAD_BODY_FORCE] = {.name = "body_force"},
        [OST_LOAD_CENTRIFUGAL] = {.name = "centrifugal"},
        [OST_LOAD_MOMENT] = {.name = "moment"},
        [OST_LOAD_DISTRIBUTING] = {.name = "distributing"},
        [ON] = {.name = "on"},
        [SHARE] = {.name = "share"},
        [AT] = {.name = "at"},
        [REGION] = {.name = "region"},
        [FOLLOWS] = {.name = "follows"},
        [TIME] = {.name = "time"},
    };
    int kind;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, LOAD_KEYS));
    OST_TRY(ost_yaml_one_of(yaml, node, keys, LOAD_KINDS, &kind));
    OST_TRY(check_keys(yaml, node, keys, kind));
    load->kind = (OstLoadKind)kind;
    load->line = ost_yaml_line(node);
    load->chosen = is_set(yaml, keys[kind].value);
    if (keys[ON].value)
        OST_TRY(ost_read_selection(yaml, keys[ON].value, &load->on));
    if (keys[ON].value && (load->on.kind == OST_SELECT_VERTICES || load->on.kind == OST_SELECT_NEAREST))
        load->share = OST_SHARE_VERTICES;
    if (keys[SHARE].value)
        OST_TRY(read_share(yaml, keys[SHARE].value, load));
    if (keys[FOLLOWS].value)
        OST_TRY(ost_yaml_word(yaml, keys[FOLLOWS].value, "answer", (const char *const[]){"false", "true"}, 2,
                              &load->follows));
    if (keys[REGION].value) {
        OST_TRY(ost_read_string(yaml, keys[REGION].value, &load->region));
        load->region_place = ost_yaml_at(keys[REGION].value);
    }
    if (load->region && ost_is_every_region(load->region))
        OST_FREE(load->region);
    if (keys[TIME].value)
        OST_TRY(ost_read_time(yaml, keys[TIME].value, c, &load->table));
    load->acts_at = keys[AT].value != NULL;
    if (load->acts_at)
        OST_TRY(ost_yaml_numbers(yaml, keys[AT].value, 3, load->at));
    return read_value(yaml, keys[kind].value, load);
}

OstStatus ost_read_loads(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    int count;
    OST_TRY(ost_yaml_short_list(yaml, node, "a list of loads (- {on: ..., total_force: ...})", &count));
    const int before = c->load_count;
    OST_TRY(OST_RESIZE(yaml->ctx, &c->loads, before + count));
    c->load_count += count;
    const OstYamlNode *item = ost_yaml_first(yaml, node);
    for (int i = 0; i < count; i++, item = ost_yaml_next(yaml, item))
        OST_TRY(read_load(yaml, item, c, &c->loads[before + i]));
    return OST_SUCCESS;
}

/* --- springs --- */

static OstStatus read_stiffness(const OstYaml *yaml, const OstYamlNode *node, double *stiffness)
{
    OST_TRY(ost_yaml_number(yaml, node, stiffness));
    return *stiffness >= 0.0 && isfinite(*stiffness) ? OST_SUCCESS
                                                     : ost_yaml_raise_type(yaml, node, "a stiffness, 0 or above", "");
}

/* One number for every direction, or {normal, tangential}. */
static OstStatus read_foundation(const OstYaml *yaml, const OstYamlNode *node, OstSpring *spring)
{
    OstYamlKey keys[] = {{.name = "normal", .read = read_stiffness, .into = &spring->along},
                         {.name = "tangential", .read = read_stiffness, .into = &spring->across}};
    if (ost_yaml_is(yaml, node, OST_YAML_MAPPING))
        return ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys));
    OST_TRY(read_stiffness(yaml, node, &spring->along));
    spring->across = spring->along;
    return OST_SUCCESS;
}

static OstStatus read_spring(const OstYaml *yaml, const OstYamlNode *node, OstSpring *spring)
{
    enum { KINDS = 2, SPRING_ON = KINDS, DIRECTION };
    OstYamlKey keys[] = {
        [OST_SPRING_FOUNDATION] = {.name = "foundation"},
        [OST_SPRING_POINT] = {.name = "spring"},
        [SPRING_ON] = {.name = "on", .needed = 1},
        [DIRECTION] = {.name = "direction"},
    };
    int kind;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(ost_yaml_one_of(yaml, node, keys, KINDS, &kind));
    spring->kind = (OstSpringKind)kind;
    spring->line = ost_yaml_line(node);
    OST_TRY(ost_read_selection(yaml, keys[SPRING_ON].value, &spring->on));
    if (kind == OST_SPRING_FOUNDATION)
        OST_TRY(read_foundation(yaml, keys[kind].value, spring));
    else
        OST_TRY(read_stiffness(yaml, keys[kind].value, &spring->along));
    if (spring->along == 0.0 && spring->across == 0.0)
        return ost_yaml_raise(yaml, keys[kind].value, "the stiffness is 0, so this spring holds nothing; leave it out");
    if (!keys[DIRECTION].value) {
        if (kind == OST_SPRING_POINT)
            spring->across = spring->along;
        return OST_SUCCESS;
    }
    if (ost_yaml_is(yaml, keys[kind].value, OST_YAML_MAPPING))
        return ost_yaml_raise(yaml, keys[DIRECTION].value,
                              "'direction' and {normal, tangential} exclude each other; give one number with it");
    spring->across = 0.0;
    return ost_yaml_direction(yaml, keys[DIRECTION].value, spring->direction);
}

OstStatus ost_read_springs(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    int count;
    OST_TRY(ost_yaml_short_list(yaml, node, "a list of springs (- {on: ..., foundation: ...})", &count));
    const int before = c->spring_count;
    OST_TRY(OST_RESIZE(yaml->ctx, &c->springs, before + count));
    c->spring_count += count;
    const OstYamlNode *item = ost_yaml_first(yaml, node);
    for (int i = 0; i < count; i++, item = ost_yaml_next(yaml, item))
        OST_TRY(read_spring(yaml, item, &c->springs[before + i]));
    return OST_SUCCESS;
}
