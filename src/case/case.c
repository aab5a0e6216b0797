/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/case_data.h"

#include "case/sections.h"
#include "case/verify.h"
#include "case/yaml/set.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/memory.h"
#include "core/parallel/gather.h"
#include "formats/mesh_formats.h"
#include "formats/serial/input_file.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* What messages call a case that comes from there. */
static const char standard_input[] = "stdin";

OstStatus ost_read_string(const OstYaml *yaml, const OstYamlNode *node, char **text)
{
    const char *found;
    OST_TRY(ost_yaml_text(yaml, node, &found));
    return ost_copy_string(yaml->ctx, found, text);
}

OstStatus ost_read_path(const OstYaml *yaml, const OstYamlNode *node, char **path)
{
    const char *found;
    OST_TRY(ost_yaml_text(yaml, node, &found));
    const char *slash = strrchr(yaml->path, '/');
    if (found[0] == '/' || !slash)
        return ost_copy_string(yaml->ctx, found, path);
    const size_t folder = (size_t)(slash - yaml->path) + 1;
    OST_TRY(OST_NEW(yaml->ctx, path, folder + strlen(found) + 1));
    memcpy(*path, yaml->path, folder);
    strcpy(*path + folder, found);
    return OST_SUCCESS;
}

/* Only a .veg file contains materials. */
static OstStatus check_materials(const OstYaml *yaml, const OstCase *c)
{
    if (c->material_count > 0 || (c->mesh_kind == OST_MESH_FILE && ost_has_ending(c->mesh_file, ".veg")))
        return OST_SUCCESS;
    return ost_yaml_raise(yaml, yaml->node,
                          "the case has no materials, and its mesh has none; add materials (region, "
                          "youngs_modulus, poissons_ratio)");
}

static OstStatus check_density(const OstYaml *yaml, const OstCase *c)
{
    int massive = c->material_count == 0;
    for (int i = 0; i < c->material_count; i++)
        massive |= c->materials[i].material.density > 0.0;
    if (massive || (c->mesh_kind == OST_MESH_FILE && ost_has_ending(c->mesh_file, ".veg")))
        return OST_SUCCESS;
    for (int i = 0; i < c->load_count; i++)
        if (c->loads[i].kind == OST_LOAD_GRAVITY || c->loads[i].kind == OST_LOAD_CENTRIFUGAL)
            return OST_RAISE(yaml->ctx, OST_INVALID_INPUT,
                             "%s:%d: %s acts on mass, but no material has a density above 0; state one%s", yaml->path,
                             c->loads[i].line, c->loads[i].kind == OST_LOAD_GRAVITY ? "gravity" : "a centrifugal load",
                             c->loads[i].kind == OST_LOAD_GRAVITY ? ", or state the force per volume as body_force"
                                                                  : "");
    return OST_SUCCESS;
}

/* Of a rotation the nodes tell the shortest vector alone; a longer one is known where all of it is given. */
static OstStatus check_links(const OstYaml *yaml, const OstCase *c)
{
    for (int i = 0; i < c->constraint_count; i++) {
        const OstConstraint *constraint = &c->constraints[i];
        double square = 0.0;
        for (int k = 0; k < 3 && constraint->kind == OST_CONSTRAIN_RIGID; k++)
            square += constraint->turn_constrained[k] ? constraint->rotation[k] * constraint->rotation[k] : 0.0;
        if (c->large_rotation != OST_LARGE_ROTATION_OFF && constraint->kind == OST_CONSTRAIN_RIGID &&
            ost_constraint_gives_part(constraint) && square > M_PI * M_PI)
            return OST_RAISE(
                yaml->ctx, OST_INVALID_INPUT,
                "%s:%d: a rotation that is given in part has a vector of at most half a turn (3.1416), found "
                "%.4g; give all three components, turn it by less, or say large_rotation: off",
                yaml->path, constraint->line, sqrt(square));
    }
    return OST_SUCCESS;
}

/* What moves a distributing coupling is found by superposition; estimates take it as a given force. */
static OstStatus check_distributing(const OstYaml *yaml, const OstCase *c)
{
    for (int i = 0; i < c->load_count; i++) {
        if (c->loads[i].kind == OST_LOAD_DISTRIBUTING && c->free_body)
            return OST_RAISE(yaml->ctx, OST_INVALID_INPUT,
                             "%s:%d: a distributing coupling cannot be moved on a free body, as what moves it is held "
                             "by supports; leave out 'constraints: free_body'",
                             yaml->path, c->loads[i].line);
        const OstWatch *asked = c->interest > 0 ? &c->watches[c->interest - 1] : NULL;
        if (c->loads[i].kind == OST_LOAD_DISTRIBUTING && asked && asked->kind != OST_WATCH_STRAIN_ENERGY)
            return OST_RAISE(yaml->ctx, OST_INVALID_INPUT,
                             "%s:%d: the error of '%.80s' is not known where a distributing coupling is moved, as its "
                             "force is looked for too; leave 'of' out",
                             yaml->path, c->loads[i].line, asked->name);
    }
    return OST_SUCCESS;
}

static int drives(const OstCase *c)
{
    int some = 0;
    for (int i = 0; i < c->load_count; i++)
        some |= c->loads[i].kind == OST_LOAD_DISTRIBUTING;
    return some;
}

static OstStatus check_path(const OstYaml *yaml, const OstYamlNode *path, const OstCase *c)
{
    if (path && c->verify)
        return ost_yaml_raise(yaml, path,
                              "a case with a verify section is solved at t = 1 alone; leave out one of them");
    if (path && c->asks_error)
        ost_warn(c->ctx, "%s:%d: a path is solved on the mesh as it is, and 'accuracy: {relative_error}' refines none",
                 c->path, ost_yaml_line(path));
    if (path || c->table_count == 0)
        return OST_SUCCESS;
    return OST_RAISE(yaml->ctx, OST_INVALID_INPUT,
                     "%s:%d: 'time' has a meaning along a path only, and the case has none; add one, as in path: "
                     "{steps: 10}",
                     yaml->path, c->first_table_line);
}

/* The formulas that answers are compared with are those of linear theory. */
static OstStatus settle_large_rotation(const OstYaml *yaml, const OstYamlKey *large_rotation,
                                       const OstYamlKey *formulation, OstCase *c)
{
    if (c->verify && !large_rotation->value && !formulation->value)
        c->large_rotation = OST_LARGE_ROTATION_OFF;
    if (c->large_rotation == OST_LARGE_ROTATION_ON && c->free_body)
        return ost_yaml_raise(yaml, large_rotation->value,
                              "a free body is solved linearly: nothing says how far it turns as a whole; constrain six "
                              "of its components, or leave large_rotation out");
    if (c->large_rotation == OST_LARGE_ROTATION_OFF && formulation->value)
        return ost_yaml_raise(yaml, formulation->value,
                              "formulation says how large rotations are computed, and large_rotation is off; leave out "
                              "one of them");
    return OST_SUCCESS;
}

/* Until the accuracy section gives one. */
static const double not_given = -1.0;

/* What verify measures is the discretisation error, to many digits. A quantity of interest is to be known better than
 * what solves stop by; where an accuracy of a displacement is asked for, they stop by that. */
double ost_case_stop_fraction(const OstCase *c)
{
    const int many_digits = c->verify && !c->asks_error;
    const OstWatchKind kind = c->interest == 0 ? OST_WATCH_STRAIN_ENERGY : c->watches[c->interest - 1].kind;
    const int stops = kind == OST_WATCH_STRAIN_ENERGY || (kind == OST_WATCH_DISPLACEMENT && c->asks_error);
    return many_digits || drives(c) || !stops ? 0.0 : 0.1;
}

/* Steps of a path follow each other; load cases do not. */
static OstStatus check_load_cases(const OstYaml *yaml, const OstYamlNode *cases, const OstCase *c)
{
    if (cases && c->path_steps > 0)
        return ost_yaml_raise(yaml, cases,
                              "load cases stand beside each other, and the steps of a path follow one another; leave "
                              "out 'cases' or 'path', or write a file for each case that has a path");
    if (cases && c->verify)
        return ost_yaml_raise(yaml, cases, "a formula is of one answer; leave out 'cases' or 'verify'");
    return OST_SUCCESS;
}

/* The sections, in the order in which they are read. */
enum {
    TITLE,
    MESH,
    ELEMENT,
    MATERIALS,
    CONSTRAINTS,
    SPRINGS,
    LOADS,
    WATCH,
    ACCURACY,
    SOLVER,
    OUTPUT,
    PATH,
    LARGE_ROTATION,
    FORMULATION,
    BUCKLING,
    VERIFY,
    SWEEP,
    CASES,
    SECTIONS
};
static const struct {
    const char *name;
    OstStatus (*read)(const OstYaml *, const OstYamlNode *, OstCase *);
} sections[SECTIONS] = {
    [TITLE] = {.name = "title"},
    [MESH] = {.name = "mesh", .read = ost_read_mesh},
    [ELEMENT] = {.name = "element", .read = ost_read_element},
    [MATERIALS] = {.name = "materials", .read = ost_read_materials},
    [CONSTRAINTS] = {.name = "constraints", .read = ost_read_constraints},
    [SPRINGS] = {.name = "springs", .read = ost_read_springs},
    [LOADS] = {.name = "loads", .read = ost_read_loads},
    [WATCH] = {.name = "watch", .read = ost_read_watches},
    [ACCURACY] = {.name = "accuracy", .read = ost_read_accuracy},
    [SOLVER] = {.name = "solver", .read = ost_read_solver},
    [OUTPUT] = {.name = "output", .read = ost_read_output},
    [PATH] = {.name = "path", .read = ost_read_load_path},
    [LARGE_ROTATION] = {.name = "large_rotation", .read = ost_read_large_rotation},
    [FORMULATION] = {.name = "formulation", .read = ost_read_formulation},
    [BUCKLING] = {.name = "buckling", .read = ost_read_buckling},
    [VERIFY] = {.name = "verify", .read = ost_read_verify},
    [SWEEP] = {.name = "sweep", .read = ost_read_sweep},
    [CASES] = {.name = "cases"},
};

/* What sections say of each other. */
static OstStatus settle(const OstYaml *yaml, const OstYamlKey *keys, OstCase *c)
{
    if (c->free_body && c->spring_count > 0)
        return ost_yaml_raise(yaml, keys[SPRINGS].value,
                              "nothing holds a free body, and springs would; leave out these, or free_body");
    OST_TRY(check_materials(yaml, c));
    OST_TRY(settle_large_rotation(yaml, &keys[LARGE_ROTATION], &keys[FORMULATION], c));
    OST_TRY(ost_settle_buckling(yaml, keys[BUCKLING].value, c));
    OST_TRY(check_path(yaml, keys[PATH].value, c));
    OST_TRY(check_load_cases(yaml, keys[CASES].value, c));
    OST_TRY(ost_check_envelope(yaml, keys[CASES].value, keys[OUTPUT].value, c));
    OST_TRY(ost_check_probe_files(yaml, keys[OUTPUT].value, c));
    if (c->interest > 0 && c->free_body)
        return ost_yaml_raise(yaml, keys[ACCURACY].value,
                              "a free body has no error of '%.80s': how far it moves as a whole is not given; leave "
                              "'of' out",
                              c->watches[c->interest - 1].name);
    if (c->solver.algebraic_fraction == not_given)
        c->solver.algebraic_fraction = ost_case_stop_fraction(c);
    OST_TRY(check_links(yaml, c));
    OST_TRY(check_distributing(yaml, c));
    OST_TRY(ost_settle_accuracy(c));
    return check_density(yaml, c);
}

/* `number`: of the load case (from 0), or OST_EVERY_LOAD_CASE. */
static OstStatus read_sections(const OstYaml *yaml, int number, OstCase *c)
{
    OstYamlKey keys[SECTIONS];
    for (int s = 0; s < SECTIONS; s++)
        keys[s] = (OstYamlKey){.name = sections[s].name, .needed = s == MESH};
    OST_TRY(ost_yaml_mapping(yaml, yaml->node, keys, SECTIONS));
    if (keys[TITLE].value)
        OST_TRY(ost_read_string(yaml, keys[TITLE].value, &c->title));
    else
        OST_TRY(ost_copy_string(yaml->ctx, "untitled", &c->title));
    for (int s = 0; s < SECTIONS; s++)
        if (keys[s].value && sections[s].read)
            OST_TRY(sections[s].read(yaml, keys[s].value, c));
    if (keys[CASES].value)
        OST_TRY(ost_read_load_cases(yaml, keys[CASES].value, number, c));
    return settle(yaml, keys, c);
}

int ost_is_every_region(const char *name)
{
    return strcmp(name, "all") == 0;
}

const OstCaseMaterial *ost_case_material_of(const OstCase *c, const char *region)
{
    for (int i = c->material_count - 1; i >= 0; i--)
        if (ost_is_every_region(c->materials[i].region) || strcmp(c->materials[i].region, region) == 0)
            return &c->materials[i];
    return NULL;
}

OstStatus ost_case_located(const OstCase *c, OstPlace place, OstStatus status)
{
    char *text = NULL;
    if (status == OST_SUCCESS || place.line == 0)
        return status;
    OST_TRY(ost_copy_string(c->ctx, ost_error_text(c->ctx), &text));
    OST_RAISE(c->ctx, status, "%s:%d:%d: %s", c->path, place.line, place.column, text);
    OST_FREE(text);
    return status;
}

static OstStatus read_vertex_file(OstCase *c, OstSelection *selection)
{
    if (!selection->vertices_file)
        return OST_SUCCESS;
    return ost_case_located(
        c, selection->place,
        ost_vertex_list_read(c->ctx, selection->vertices_file, &selection->range_count, &selection->ranges));
}

static OstStatus read_vertex_files(OstCase *c)
{
    for (int i = 0; i < c->constraint_count; i++)
        OST_TRY(read_vertex_file(c, &c->constraints[i].on));
    for (int i = 0; i < c->constraint_count; i++)
        OST_TRY(read_vertex_file(c, &c->constraints[i].to));
    for (int i = 0; i < c->load_count; i++)
        OST_TRY(read_vertex_file(c, &c->loads[i].on));
    for (int i = 0; i < c->spring_count; i++)
        OST_TRY(read_vertex_file(c, &c->springs[i].on));
    for (int i = 0; i < c->watch_count; i++)
        OST_TRY(read_vertex_file(c, &c->watches[i].on));
    for (int i = 0; c->verify && i < c->verify->quantity_count; i++)
        OST_TRY(read_vertex_file(c, &c->verify->quantity[i].on));
    return OST_SUCCESS;
}

/* A case with its defaults. */
static OstStatus begin(OstContext *ctx, const char *path, OstCase **c)
{
    OST_TRY(OST_NEW(ctx, c, 1));
    (*c)->ctx = ctx;
    (*c)->solver = ost_solver_default_options();
    (*c)->solver.algebraic_fraction = not_given;
    (*c)->relative_error = 0.02;
    (*c)->solver.accept_attainable = 1; /* until the case asks for a residual */
    (*c)->formulation = OST_FORMULATION_CONSISTENT;
    (*c)->output_fields = OST_FIELDS_BY_DEFAULT;
    return ost_copy_string(ctx, path, &(*c)->path);
}

/* Each load case is a case of its own, of which all but its loads, supports and watches is the same. */
static OstStatus read_each_load_case(const OstYaml *yaml, OstCase *c)
{
    for (int k = 0; k < c->load_case_count; k++) {
        OstLoadCase *load_case = &c->load_cases[k];
        OST_TRY(begin(yaml->ctx, c->path, &load_case->c));
        OST_TRY(read_sections(yaml, k, load_case->c));
        load_case->c->text_hash = c->text_hash;
    }
    return OST_SUCCESS;
}

static int asks_along_material_axes(const OstCase *c)
{
    const unsigned fields = 1U << OST_FIELD_MATERIAL_STRESS | 1U << OST_FIELD_MATERIAL_STRAIN | 1U << OST_FIELD_E1 |
                            1U << OST_FIELD_E2 | 1U << OST_FIELD_E3;
    int asks = (c->output_fields & fields) != 0 || c->probe_count > 0;
    for (int i = 0; i < c->watch_count; i++)
        asks |= c->watches[i].kind == OST_WATCH_STRESS && c->watches[i].component >= OST_STRESS_MEASURE_11 &&
                c->watches[i].component <= OST_STRESS_MEASURE_31;
    return asks;
}

/* An isotropic material's axes change no answer, and are left out unless something is asked for along them. */
static void keep_axes_asked_for(OstCase *c)
{
    int asks = asks_along_material_axes(c);
    for (int k = 0; k < c->load_case_count; k++)
        asks |= asks_along_material_axes(c->load_cases[k].c);
    for (int k = -1; asks && k < c->load_case_count; k++) {
        OstCase *of = k < 0 ? c : c->load_cases[k].c;
        for (int i = 0; i < of->material_count; i++) {
            OstCaseMaterial *material = &of->materials[i];
            material->axes_asked_for = material->material.isotropic && material->axes.kind != OST_AXES_NONE;
            material->material.isotropic &= !material->axes_asked_for;
        }
    }
}

static OstStatus parse(OstContext *ctx, const char *path, const OstCaseText *text, OstCase **c)
{
    OstYaml *yaml = NULL;
    OST_TRY(begin(ctx, path, c));
    OST_TRY(ost_yaml_parse(ctx, (*c)->path, text->bytes, text->size, &yaml));
    OstStatus status = OST_SUCCESS;
    if (text->swept > 0)
        yaml->lasting = text->settings - text->swept + 1;
    (*c)->text_hash = ost_hash(OST_HASH_START, text->size, text->bytes);
    for (int s = 0; s < text->settings && status == OST_SUCCESS; s++) {
        status = ost_yaml_set(yaml, text->setting[s]);
        (*c)->text_hash = ost_hash((*c)->text_hash, strlen(text->setting[s]), text->setting[s]);
    }
    OST_THEN(read_sections(yaml, OST_EVERY_LOAD_CASE, *c));
    OST_THEN(read_each_load_case(yaml, *c));
    if (status == OST_SUCCESS) {
        keep_axes_asked_for(*c);
        ost_warn_arbitrary_axes(*c);
    }
    ost_yaml_destroy(&yaml);
    return status;
}

static OstStatus read_stream(OstContext *ctx, const char *path, FILE *file, char **bytes, size_t *size)
{
    size_t room = 16384;
    OST_TRY(OST_NEW(ctx, bytes, room));
    for (;;) {
        *size += fread(*bytes + *size, 1, room - *size, file);
        if (ferror(file))
            return OST_RAISE(ctx, OST_FILE_FAILED, "%s: cannot be read: %s", path, strerror(errno));
        if (*size < room)
            return OST_RESIZE(ctx, bytes, *size);
        if (*size > OST_YAML_MAX_BYTES)
            return OST_RAISE(ctx, OST_INVALID_INPUT, "%s: more than %d bytes; a case file is a page or two", path,
                             OST_YAML_MAX_BYTES);
        room *= 2;
        OST_TRY(OST_RESIZE(ctx, bytes, room));
    }
}

static OstStatus read_file(OstContext *ctx, const char *path, char **bytes, size_t *size)
{
    if (strcmp(path, "-") == 0)
        return read_stream(ctx, standard_input, stdin, bytes, size);
    FILE *file = fopen(path, "rb");
    if (!file)
        return OST_RAISE(ctx, OST_FILE_FAILED, "%s: cannot be opened: %s", path, strerror(errno));
    OstStatus status = read_stream(ctx, path, file, bytes, size);
    fclose(file);
    return status;
}

OstStatus ost_case_bytes(OstContext *ctx, const char *path, char **bytes, size_t *size)
{
    OstStatus status = OST_SUCCESS;
    *bytes = NULL;
    *size = 0;
    ost_ledger_enter(ctx, OST_LEDGER_CASE);
    if (ost_rank(ctx) == 0)
        status = read_file(ctx, path, bytes, size);
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_broadcast(ctx, sizeof *size, size));
    if (ost_rank(ctx) != 0)
        status = OST_NEW(ctx, bytes, *size);
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_broadcast(ctx, *size, *bytes));
done:
    if (status != OST_SUCCESS)
        OST_FREE(*bytes);
    ost_ledger_leave(ctx);
    return status;
}

OstStatus ost_case_make(OstContext *ctx, const char *path, const OstCaseText *text, OstCase **c)
{
    OstStatus status = OST_SUCCESS;
    *c = NULL;
    ost_ledger_enter(ctx, OST_LEDGER_CASE);
    OST_TRY_DONE(ost_agree(ctx, parse(ctx, strcmp(path, "-") == 0 ? standard_input : path, text, c)));
    OST_TRY_DONE(read_vertex_files(*c));
    for (int k = 0; k < (*c)->load_case_count; k++)
        OST_TRY_DONE(read_vertex_files((*c)->load_cases[k].c));
done:
    if (status != OST_SUCCESS)
        ost_case_destroy(c);
    ost_ledger_leave(ctx);
    return status;
}

OstStatus ost_case_parse(OstContext *ctx, const char *path, const char *text, OstCase **c)
{
    return ost_case_parse_with(ctx, path, text, 0, NULL, c);
}

OstStatus ost_case_parse_with(OstContext *ctx, const char *path, const char *text, int count,
                              const char *const *settings, OstCase **c)
{
    const OstCaseText whole = {.bytes = text, .size = strlen(text), .settings = count, .setting = settings};
    return ost_case_make(ctx, path, &whole, c);
}

OstStatus ost_case_parse_swept(OstContext *ctx, const char *path, const char *text, int count,
                               const char *const *settings, OstCase **c)
{
    const OstCaseText whole = {
        .bytes = text, .size = strlen(text), .settings = count, .swept = count, .setting = settings};
    return ost_case_make(ctx, path, &whole, c);
}

static OstStatus read_and_make(OstContext *ctx, const char *path, OstCaseText *text, OstCase **c)
{
    char *bytes = NULL;
    *c = NULL;
    OST_TRY(ost_case_bytes(ctx, path, &bytes, &text->size));
    text->bytes = bytes;
    const OstStatus status = ost_case_make(ctx, path, text, c);
    OST_FREE(bytes);
    for (int f = 0; f < ost_mesh_format_count && status == OST_INVALID_INPUT; f++)
        if (ost_has_ending(path, ost_mesh_formats[f].ending))
            return OST_RAISE(ctx, status, "%s: a mesh; expected a case, a YAML file that names it, mesh: {file: %s}",
                             path, path);
    return status;
}

OstStatus ost_case_read_with(OstContext *ctx, const char *path, int count, const char *const *settings, OstCase **c)
{
    return read_and_make(ctx, path, &(OstCaseText){.settings = count, .setting = settings}, c);
}

OstStatus ost_case_read_swept(OstContext *ctx, const char *path, int count, const char *const *settings, OstCase **c)
{
    return read_and_make(ctx, path, &(OstCaseText){.settings = count, .swept = count, .setting = settings}, c);
}

OstStatus ost_case_read(OstContext *ctx, const char *path, OstCase **c)
{
    return ost_case_read_with(ctx, path, 0, NULL, c);
}

void ost_constraint_release(OstConstraint *constraint)
{
    ost_selection_release(&constraint->on);
    ost_selection_release(&constraint->to);
    for (int p = 0; p < 3; p++)
        for (int side = 0; side < 2; side++)
            OST_FREE(constraint->pair[p][side]);
}

void ost_case_destroy(OstCase **c)
{
    if (!*c)
        return;
    for (int i = 0; i < (*c)->material_count; i++) {
        OST_FREE((*c)->materials[i].region, (*c)->materials[i].eigen_field, (*c)->materials[i].modulus.field);
        ost_axes_spec_release(&(*c)->materials[i].axes);
    }
    for (int i = 0; i < (*c)->constraint_count; i++)
        ost_constraint_release(&(*c)->constraints[i]);
    for (int i = 0; i < (*c)->load_count; i++) {
        ost_selection_release(&(*c)->loads[i].on);
        OST_FREE((*c)->loads[i].region);
    }
    for (int i = 0; i < (*c)->spring_count; i++)
        ost_selection_release(&(*c)->springs[i].on);
    OST_FREE((*c)->springs);
    for (int i = 0; i < (*c)->watch_count; i++) {
        OST_FREE((*c)->watches[i].name, (*c)->watches[i].source, (*c)->watches[i].region);
        ost_selection_release(&(*c)->watches[i].on);
    }
    OST_FREE((*c)->watches);
    ost_probes_release((*c)->probe_count, &(*c)->probes);
    for (int i = 0; i < (*c)->table_count; i++)
        ost_time_table_release(&(*c)->tables[i]);
    OST_FREE((*c)->tables, (*c)->path_times);
    ost_verify_release(&(*c)->verify);
    ost_load_cases_release(*c);
    ost_sweep_release(*c);
    OST_FREE((*c)->materials, (*c)->constraints, (*c)->loads, (*c)->path, (*c)->title, (*c)->mesh_file,
             (*c)->output_file);
    OST_FREE(*c);
}

const char *ost_case_path(const OstCase *c)
{
    return c->path;
}

const char *ost_case_title(const OstCase *c)
{
    return c->title;
}

const char *ost_case_output_file(const OstCase *c)
{
    return c->output_file;
}

/* Along axes that have turned, where rotations are large. */
unsigned ost_case_recovers(const OstCase *c)
{
    int stress = c->probe_count;
    for (int w = 0; w < c->watch_count; w++)
        stress += ost_watch_is_of_stress(&c->watches[w]);
    stress += c->envelope;
    return c->output_fields | (stress > 0 ? 1U << OST_FIELD_STRESS | 1U << OST_FIELD_MATERIAL_STRESS : 0U);
}

unsigned ost_case_output_fields(const OstCase *c)
{
    return c->output_fields;
}

const OstSolverOptions *ost_case_solver_options(const OstCase *c)
{
    return &c->solver;
}

int ost_case_watch_count(const OstCase *c)
{
    return c->watch_count;
}

int ost_case_has_path(const OstCase *c)
{
    return c->path_steps > 0;
}

int ost_case_asks_error(const OstCase *c)
{
    return c->asks_error;
}
